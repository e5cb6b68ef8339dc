//! The last poses of a particle and what was seen from them, as long as none of it is drawn: one joint Gaussian.
//!
//! An EKF-SLAM that begins at a pose which is known and holds what is in sight only, with the poses of all its steps as Durrant-Whyte and
//! Bailey's *delayed state*: what is seen later corrects them, too.

use crate::genealogy::Path;
use crate::geometry::Pose2;
use crate::map::landmarks::{Association, Belief, Innovation, Landmark, Landmarks, Store};
use crate::motion::Motion;
use crate::random::Stream;
use crate::sensor::{Feature, LandmarkSensor, Prediction};
use nalgebra::{DMatrix, Dyn, Matrix3, OMatrix, U2, U3, Vector2, Vector3};

/// A step of which the pose is not drawn yet.
#[derive(Clone, Debug)]
pub(super) struct Step<U> {
    pub(super) control: U,
    pub(super) features: Vec<Feature>,
    pub(super) associations: Vec<Association>,
    /// Mean of the pose, by all that was seen up to now.
    pose: Pose2,
    /// First of its three rows of the covariance.
    row: usize,
}

/// A landmark that was seen from one of these poses.
#[derive(Clone, Debug)]
struct Seen {
    index: u32,
    mean: Vector2<f64>,
    existence_count: i32,
    /// First of its two rows of the covariance.
    row: usize,
}

/// N((x_{s+1} … x_t, landmarks in sight); ·) given the path to x_s.
#[derive(Clone, Debug)]
pub(super) struct Window<U> {
    /// The poses that were drawn, to x_s.
    pub(super) drawn: Path,
    /// What came after x_s, oldest first.
    pub(super) steps: Vec<Step<U>>,
    seen: Vec<Seen>,
    /// Of poses and landmarks, in the order in which they came.
    covariance: DMatrix<f64>,
}

impl<U: Clone> Window<U> {
    /// Nothing after the end of this path.
    pub(super) fn after(drawn: Path) -> Self {
        Self { drawn, steps: Vec::new(), seen: Vec::new(), covariance: DMatrix::zeros(0, 0) }
    }

    /// Mean of the newest pose.
    pub(super) fn pose(&self) -> Pose2 {
        self.steps.last().map_or_else(|| self.drawn.pose(), |step| step.pose)
    }

    /// Covariance of the newest pose (3 × 3, \[m, m, rad\]).
    pub(super) fn covariance(&self) -> Matrix3<f64> {
        let at = |step: &Step<U>| self.covariance.fixed_view::<3, 3>(step.row, step.row).into_owned();
        self.steps.last().map_or_else(Matrix3::zeros, at)
    }

    /// Means of the poses that are not drawn, by all that was seen.
    pub(super) fn poses(&self) -> impl Iterator<Item = Pose2> {
        self.steps.iter().map(|step| step.pose)
    }

    /// One step of the joint filter beside a map of what is not in sight: predicts, corrects by every feature of a mapped landmark, each
    /// from where the one before left it, and appends what is new. Returns ln p(z_t | x₁..s, z₁..t₋₁) \[nats\], of which each new landmark has
    /// p₀, and whether any feature was of a landmark in the map.
    pub(super) fn advance<D, Z, S>(
        &mut self,
        motion: &D,
        map: &Landmarks<Z, S>,
        control: &U,
        features: &[Feature],
    ) -> (f64, bool)
    where
        D: Motion<Control = U>,
        Z: LandmarkSensor,
        S: Store,
    {
        let row = self.predict(motion, control);
        let mut newest = Newest { window: self, map, row };
        let associated = map.correspondence().associate(features, &mut newest);
        for (index, k) in associated.founded() {
            self.found(map.sensor(), row, index, &features[k]);
        }
        if let Some(step) = self.steps.last_mut() {
            (step.features, step.associations) = (features.to_vec(), associated.associations);
        }
        (associated.log_likelihood, associated.informed)
    }

    /// Appends g(x, u): G times the rows of the pose before, and R_t. Returns its first row.
    fn predict<D: Motion<Control = U>>(&mut self, motion: &D, control: &U) -> usize {
        let (from, row) = (self.pose(), self.covariance.nrows());
        let drive = motion.drive(control);
        let (g, mut own) = (drive.jacobian(&from), drive.covariance(&from));
        let mut cross = OMatrix::<f64, U3, Dyn>::zeros(row);
        if let Some(before) = self.steps.last() {
            cross = g * self.covariance.fixed_rows::<3>(before.row);
            own += g * self.covariance.fixed_view::<3, 3>(before.row, before.row) * g.transpose();
        }
        self.grow(3);
        self.covariance.view_mut((row, 0), (3, row)).copy_from(&cross);
        self.covariance.view_mut((0, row), (row, 3)).copy_from(&cross.transpose());
        self.covariance.fixed_view_mut::<3, 3>(row, row).copy_from(&own);
        let (features, associations) = (Vec::new(), Vec::new());
        self.steps.push(Step { control: control.clone(), features, associations, pose: drive.apply(&from), row });
        row
    }

    /// So many rows and columns of zeros more.
    fn grow(&mut self, by: usize) {
        let n = self.covariance.nrows() + by;
        self.covariance = core::mem::take(&mut self.covariance).resize(n, n, 0.0);
    }

    /// What a feature says of a landmark, seen from the newest pose: S = H P Hᵀ + Q.
    fn innovation<Z: LandmarkSensor, S: Store>(
        &self,
        map: &Landmarks<Z, S>,
        row: usize,
        index: u32,
        feature: &Feature,
        gate: Option<f64>,
    ) -> Option<Innovation> {
        let (pose, p) = (self.pose(), self.covariance.fixed_view::<3, 3>(row, row).into_owned());
        let Some(seen) = self.seen.iter().find(|seen| seen.index == index) else {
            return map.innovation(&pose, &p, feature, index, gate);
        };
        let landmark = Landmark {
            mean: seen.mean,
            covariance: self.covariance.fixed_view::<2, 2>(seen.row, seen.row).into_owned(),
            existence_count: seen.existence_count,
            apart: 0,
        };
        let cross = self.covariance.fixed_view::<3, 2>(row, seen.row);
        Some(landmark.innovation_with(map.sensor(), &pose, &feature.z, |Prediction { h_x, h_m, .. }| {
            let both = h_x * cross * h_m.transpose();
            h_x * p * h_x.transpose() + both + both.transpose()
        }))
    }

    /// K = P Hᵀ S⁻¹, μ ← μ + K ν, P ← P − K (P Hᵀ)ᵀ, for all poses and landmarks in sight. A landmark of the map comes in sight first,
    /// independent of all that is.
    fn update<Z, S: Store>(&mut self, map: &Landmarks<Z, S>, row: usize, index: u32, innovation: &Innovation)
    where
        Z: LandmarkSensor,
    {
        let known = self.seen.iter().find(|seen| seen.index == index).map(|seen| seen.row);
        let Some(at) = known.or_else(|| map.get(index).map(|landmark| self.take_in(index, landmark))) else { return };
        let Innovation { prediction: Prediction { h_x, h_m, .. }, residual, inverse, .. } = innovation;
        let ph: OMatrix<f64, Dyn, U2> = self.covariance.fixed_columns::<3>(row) * h_x.transpose()
            + self.covariance.fixed_columns::<2>(at) * h_m.transpose();
        let gain = &ph * inverse;
        for k in 0..2 {
            self.covariance.ger(-1.0, &gain.column(k), &ph.column(k), 1.0);
        }
        let delta = gain * residual;
        for step in &mut self.steps {
            step.pose = step.pose.plus(&delta.fixed_rows::<3>(step.row).into_owned());
        }
        for seen in &mut self.seen {
            seen.mean += delta.fixed_rows::<2>(seen.row);
        }
    }

    /// A landmark of the map, to be corrected with the poses. Returns its first row.
    fn take_in(&mut self, index: u32, landmark: &Landmark) -> usize {
        let row = self.covariance.nrows();
        self.grow(2);
        self.covariance.fixed_view_mut::<2, 2>(row, row).copy_from(&landmark.covariance);
        self.seen.push(Seen { index, mean: landmark.mean, existence_count: landmark.existence_count, row });
        row
    }

    /// m = h⁻¹(x, z): its covariance with everything is J times the pose's, J = −H_m⁻¹ H_x.
    fn found<Z: LandmarkSensor>(&mut self, sensor: &Z, pose_row: usize, index: u32, feature: &Feature) {
        let first = Landmark::first(sensor, &self.pose(), &feature.z);
        let Prediction { h_x, h_m, .. } = sensor.predict(&self.pose(), &first.mean);
        let Some(inverse) = h_m.try_inverse().filter(|_| first.covariance.iter().all(|entry| entry.is_finite())) else {
            return;
        };
        let j = -inverse * h_x;
        let cross = j * self.covariance.fixed_rows::<3>(pose_row);
        let own = j * self.covariance.fixed_view::<3, 3>(pose_row, pose_row) * j.transpose();
        let row = self.take_in(index, &first);
        self.covariance.view_mut((row, 0), (2, row)).copy_from(&cross);
        self.covariance.view_mut((0, row), (row, 2)).copy_from(&cross.transpose());
        let mut block = self.covariance.fixed_view_mut::<2, 2>(row, row);
        block += own;
    }

    /// One draw of the first `count` poses together, by all that was seen. Takes six `u64`s for each.
    pub(super) fn draw(&self, count: usize, stream: &mut Stream) -> Vec<Pose2> {
        let steps = &self.steps[..count];
        let at = |k: usize| steps[k / 3].row + k % 3;
        let factor = factor(DMatrix::from_fn(3 * count, 3 * count, |i, j| self.covariance[(at(i), at(j))]));
        let normals: Vec<f64> = steps.iter().flat_map(|_| stream.normals::<3>()).collect();
        let row = |i: usize| (0..=i).map(|j| factor[(i, j)] * normals[j]).sum();
        let drawn = |(k, step): (usize, &Step<U>)| step.pose.plus(&Vector3::from_fn(|i, _| row(3 * k + i)));
        steps.iter().enumerate().map(drawn).collect()
    }
}

/// The newest pose of a window, of which the covariance has these rows, and the landmarks of the window and of the map.
struct Newest<'a, U, Z, S> {
    window: &'a mut Window<U>,
    map: &'a Landmarks<Z, S>,
    row: usize,
}

impl<U: Clone, Z: LandmarkSensor, S: Store> Belief for Newest<'_, U, Z, S> {
    fn learns(&self) -> bool {
        true
    }

    fn can_measure(&self, z: &Vector2<f64>) -> bool {
        self.map.sensor().can_measure(z)
    }

    fn index_bound(&self) -> u32 {
        self.window.seen.iter().map(|seen| seen.index + 1).fold(self.map.len(), u32::max)
    }

    fn innovation(&self, feature: &Feature, index: u32, gate: Option<f64>) -> Option<Innovation> {
        self.window.innovation(self.map, self.row, index, feature, gate)
    }

    fn learn(&mut self, index: u32, innovation: &Innovation) {
        self.window.update(self.map, self.row, index, innovation);
    }
}

/// L with Σ = L Lᵀ (n × n), which may be singular: a pivot that is nothing against its variance, as rounding leaves it, counts as zero with
/// its whole column.
fn factor(covariance: DMatrix<f64>) -> DMatrix<f64> {
    let (n, mut l) = (covariance.nrows(), covariance.clone());
    for k in 0..n {
        for j in 0..k {
            for i in k..n {
                l[(i, k)] -= l[(i, j)] * l[(k, j)];
            }
        }
        let pivot = l[(k, k)];
        let root = if pivot > 1e-10 * covariance[(k, k)] { pivot.sqrt() } else { 0.0 };
        for i in k..n {
            l[(i, k)] = if root > 0.0 { l[(i, k)] / root } else { 0.0 };
        }
    }
    l
}
