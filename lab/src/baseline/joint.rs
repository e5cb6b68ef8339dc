//! The joint Gaussian over a path and the landmarks seen from it, in information form.
//!
//! Every motion and every sighting adds its own small block to one sparse matrix Λ, the inverse of the covariance. Two ways
//! lead from Λ to a covariance of the landmarks, and the difference between them is what FastSLAM stands on:
//!
//! - *marginalise* the path, and every landmark depends on every other: Σ_m = (Λ_mm − Λ_mx Λ_xx⁻¹ Λ_xm)⁻¹ is dense;
//! - *condition* on the path, and none depends on any other: Σ_m|x = Λ_mm⁻¹ is block diagonal, because a sighting is of one
//!   landmark and no factor has two of them.
//!
//! References: Montemerlo, Thrun, Koller, Wegbreit, *FastSLAM* (AAAI 2002); Thrun, Burgard, Fox, *Probabilistic Robotics* (2005),
//! §11.4 and §13.3.

use fastslam::nalgebra::{Cholesky, DMatrix, DMatrixView, Dyn, Matrix2, Matrix2x3, Matrix3, RowVector2, RowVector3};
use fastslam::sensor::Prediction;

/// What a reading of two landmarks depends on, linearised.
#[derive(Clone, PartialEq, Debug)]
pub struct PairPrediction {
    /// ∂z/∂x (1 × 3).
    pub h_x: RowVector3<f64>,
    /// ∂z/∂m of each landmark (1 × 2).
    pub h_m: [RowVector2<f64>; 2],
}

impl PairPrediction {
    /// The angle between two landmarks \[rad\], as the difference of their bearings.
    pub fn angle([one, two]: [&Prediction; 2]) -> Self {
        Self { h_x: two.h_x.row(1) - one.h_x.row(1), h_m: [-one.h_m.row(1), two.h_m.row(1).into()] }
    }
}

/// Λ over the poses x_1 … x_T (three numbers each; x_0 is known) and the landmarks m_1 … m_N (two each).
#[derive(Clone, PartialEq, Debug)]
pub struct Joint {
    poses: usize,
    landmarks: usize,
    /// 3 T + 2 N rows: all poses, then all landmarks.
    information: DMatrix<f64>,
}

impl Joint {
    /// Of so many poses besides the known start, and so many landmarks, of which nothing is known yet.
    pub fn new(poses: usize, landmarks: usize) -> Self {
        let size = 3 * poses + 2 * landmarks;
        Self { poses, landmarks, information: DMatrix::zeros(size, size) }
    }

    /// The motion to pose `to`, 1 to T: x_t = F x_{t−1} + noise, with F = ∂g/∂x and R_t (3 × 3, \[m, m, rad\]).
    ///
    /// # Panics
    /// For an R_t that is not positive definite, as of a robot that stands still: add a floor to its diagonal. Also for a
    /// pose that is not there.
    pub fn add_odometry(&mut self, to: usize, jacobian: &Matrix3<f64>, noise: &Matrix3<f64>) {
        let weight = Cholesky::new(*noise).expect("R_t has to be positive definite").inverse();
        let (now, carried) = (self.pose(to), weight * jacobian);
        self.add(now, now, &weight);
        if to > 1 {
            let before = self.pose(to - 1);
            self.add(before, before, &(jacobian.transpose() * carried));
            self.add(now, before, &-carried);
            self.add(before, now, &-carried.transpose());
        }
    }

    /// A sighting from pose `from`, 1 to T, of a landmark, 0 to N − 1: z = H_x x + H_m m + noise of covariance Q (2 × 2).
    ///
    /// # Panics
    /// For a Q that is not positive definite, a pose or a landmark that is not there.
    pub fn add_observation(&mut self, from: usize, landmark: usize, seen: &Prediction, noise: &Matrix2<f64>) {
        let weight = Cholesky::new(*noise).expect("Q has to be positive definite").inverse();
        let (x, m) = (self.pose(from), self.landmark(landmark));
        let (h_x, h_m): (&Matrix2x3<f64>, &Matrix2<f64>) = (&seen.h_x, &seen.h_m);
        let cross = h_x.transpose() * weight * h_m;
        self.add(x, x, &(h_x.transpose() * weight * h_x));
        self.add(m, m, &(h_m.transpose() * weight * h_m));
        self.add(x, m, &cross);
        self.add(m, x, &cross.transpose());
    }

    /// A reading from pose `from`, 1 to T, of two landmarks at once: z = h_x x + h_1 m_1 + h_2 m_2 + noise of standard deviation σ.
    ///
    /// # Panics
    /// For a σ that is not positive, a pose or a landmark that is not there.
    pub fn add_pair(&mut self, from: usize, landmarks: [usize; 2], seen: &PairPrediction, std: f64) {
        assert!(std > 0.0, "σ has to be positive");
        let (x, weight) = (self.pose(from), 1.0 / (std * std));
        let [one, two] = landmarks.map(|landmark| self.landmark(landmark));
        let [h_one, h_two] = seen.h_m;
        self.add(x, x, &(seen.h_x.transpose() * weight * seen.h_x));
        for (row, h_row) in [(one, h_one), (two, h_two)] {
            let cross = seen.h_x.transpose() * weight * h_row;
            self.add(x, row, &cross);
            self.add(row, x, &cross.transpose());
            for (column, h_column) in [(one, h_one), (two, h_two)] {
                self.add(row, column, &(h_row.transpose() * weight * h_column));
            }
        }
    }

    /// Λ (3 T + 2 N rows): all poses, then all landmarks.
    pub fn information(&self) -> &DMatrix<f64> {
        &self.information
    }

    /// Covariance of the landmarks with the path marginalised out; `None` where a landmark was never sighted.
    pub fn marginal(&self) -> Option<MapCovariance> {
        let path = 0..3 * self.poses;
        let map = path.end..self.information.nrows();
        self.marginalize(map, path).map(MapCovariance)
    }

    /// Covariance of the landmarks given the path; `None` where a landmark was never sighted.
    ///
    /// Λ_mm is inverted as any other matrix: that it falls into blocks is not made use of, it is found.
    pub fn conditional(&self) -> Option<MapCovariance> {
        let map = 3 * self.poses;
        inverse(self.information.view_range(map.., map..)).map(MapCovariance)
    }

    /// Covariance of the landmarks given the last pose alone, the poses before it marginalised out; `None` where a landmark was never
    /// sighted.
    ///
    /// # Panics
    /// Without any pose.
    pub fn given_last_pose(&self) -> Option<MapCovariance> {
        let known = self.pose(self.poses);
        let map = 3 * self.poses..self.information.nrows();
        self.marginalize(map, 0..known).map(MapCovariance)
    }

    /// Covariances of the first `open` of the poses x_1 … x_T (3 × 3, \[m, m, rad\]), given the others, with the map marginalised out;
    /// `None` where a landmark was never sighted.
    pub fn path(&self, open: usize) -> Option<Vec<Matrix3<f64>>> {
        let map = 3 * self.poses..self.information.nrows();
        let all = self.marginalize(0..3 * open, map)?;
        Some((0..open).map(|t| all.fixed_view::<3, 3>(3 * t, 3 * t).into()).collect())
    }

    /// Covariance of the rows `kept` of the state with the rows `out` marginalised out: the inverse of the Schur complement.
    fn marginalize(&self, kept: core::ops::Range<usize>, out: core::ops::Range<usize>) -> Option<DMatrix<f64>> {
        let block = |rows: &core::ops::Range<usize>, columns: &core::ops::Range<usize>| {
            self.information.view_range(rows.clone(), columns.clone())
        };
        let eliminated = factor(block(&out, &out))?.solve(&block(&out, &kept));
        inverse((block(&kept, &kept) - block(&kept, &out) * eliminated).as_view())
    }

    fn pose(&self, t: usize) -> usize {
        assert!((1..=self.poses).contains(&t), "there is no pose {t}");
        3 * (t - 1)
    }

    fn landmark(&self, j: usize) -> usize {
        assert!(j < self.landmarks, "there is no landmark {j}");
        3 * self.poses + 2 * j
    }

    fn add<const R: usize, const C: usize>(
        &mut self,
        row: usize,
        column: usize,
        block: &fastslam::nalgebra::SMatrix<f64, R, C>,
    ) {
        let mut view = self.information.fixed_view_mut::<R, C>(row, column);
        view += block;
    }
}

/// Λ = L Lᵀ; `None` where it is not positive definite.
fn factor(information: DMatrixView<f64>) -> Option<Cholesky<f64, Dyn>> {
    Cholesky::new(information.into_owned())
}

/// Λ⁻¹, symmetric to the last bit.
fn inverse(information: DMatrixView<f64>) -> Option<DMatrix<f64>> {
    let inverse = factor(information)?.inverse();
    Some((&inverse + inverse.transpose()) * 0.5)
}

/// A covariance of N landmarks, (x, y) each \[m²\].
#[derive(Clone, PartialEq, Debug)]
pub struct MapCovariance(DMatrix<f64>);

impl MapCovariance {
    /// N.
    pub fn landmarks(&self) -> usize {
        self.0.nrows() / 2
    }

    /// All of it, 2 N × 2 N.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.0
    }

    /// Covariance of landmark `i` with landmark `j`, both from 0.
    pub fn block(&self, i: usize, j: usize) -> Matrix2<f64> {
        self.0.fixed_view::<2, 2>(2 * i, 2 * j).into()
    }

    /// ρ of two coordinates, each 2 j for the x of landmark j and 2 j + 1 for its y: Σ_ij / √(Σ_ii Σ_jj), from −1 to 1.
    pub fn correlation(&self, i: usize, j: usize) -> f64 {
        (self.0[(i, j)] / (self.0[(i, i)] * self.0[(j, j)]).sqrt()).clamp(-1.0, 1.0)
    }

    /// |ρ_ij| of two landmarks, from 0 to 1: their largest canonical correlation, which is the largest that any direction of one has
    /// with any direction of the other.
    ///
    /// The larger singular value of L_i⁻¹ Σ_ij L_j⁻ᵀ with Σ_ii = L_i L_iᵀ. It does not depend on how the axes lie, is never less
    /// than an entry of the block, and is 0 exactly where the block is.
    ///
    /// Reference: Hotelling, *Relations between two sets of variates*, Biometrika 28 (1936).
    pub fn coupling(&self, i: usize, j: usize) -> f64 {
        let whitened = whiten(&self.block(j, j), &whiten(&self.block(i, i), &self.block(i, j)).transpose());
        let squared = whitened * whitened.transpose();
        let (half_sum, half_difference) = (0.5 * (squared.m11 + squared.m22), 0.5 * (squared.m11 - squared.m22));
        let largest = half_sum + (half_difference * half_difference + squared.m12 * squared.m12).sqrt();
        largest.sqrt().min(1.0)
    }

    /// How many entries outside the 2 × 2 blocks of the diagonal are not 0.
    pub fn off_block_nonzeros(&self) -> usize {
        let size = self.0.nrows();
        let entries = (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
        entries.filter(|&(i, j)| i / 2 != j / 2 && self.0[(i, j)] != 0.0).count()
    }
}

/// L⁻¹ B with Σ = L Lᵀ.
fn whiten(covariance: &Matrix2<f64>, b: &Matrix2<f64>) -> Matrix2<f64> {
    let l11 = covariance.m11.sqrt();
    let l21 = covariance.m21 / l11;
    let l22 = (covariance.m22 - l21 * l21).sqrt();
    let top = b.row(0) / l11;
    let bottom = (b.row(1) - top * l21) / l22;
    Matrix2::from_rows(&[top, bottom])
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::geometry::Pose2;
    use fastslam::map::landmarks::Landmark;
    use fastslam::motion::{Motion, Odometry, OdometryModel};
    use fastslam::nalgebra::Vector2;
    use fastslam::sensor::{LandmarkSensor, RangeBearing};

    const SENSOR: RangeBearing =
        RangeBearing { range_std: 0.1, bearing_std: 0.04, max_range: 9.0, field_of_view: core::f64::consts::TAU };
    const MAP: [[f64; 2]; 4] = [[1.0, 1.5], [2.5, -1.0], [4.0, 1.0], [5.5, -0.5]];
    /// Who is seen from where: landmarks 0 and 3 never together.
    const SIGHTINGS: [(usize, usize); 8] = [(1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 1), (3, 2), (3, 3)];

    fn path() -> Vec<Pose2> {
        [[0.0, 0.0, 0.1], [1.2, 0.2, 0.3], [2.6, 0.4, -0.2], [4.0, 0.1, 0.0]]
            .map(|[x, y, a]| Pose2::new(x, y, a))
            .into()
    }

    /// F and R_t of the motion to pose `t`, for odometry of this scale.
    fn motion(t: usize, scale: f64) -> (Matrix3<f64>, Matrix3<f64>) {
        let (from, u) = (path()[t - 1], Odometry::between(&path()[t - 1], &path()[t]));
        let model = OdometryModel { alphas: [0.1, 0.02, 0.08, 0.02] }.scaled(scale);
        let floor = Matrix3::identity() * 1e-10;
        (model.jacobian(&from, &u), model.covariance(&from, &u) + floor)
    }

    fn seen(t: usize, j: usize) -> Prediction {
        SENSOR.predict(&path()[t], &Vector2::from(MAP[j]))
    }

    fn joint(scale: f64) -> Joint {
        let mut joint = Joint::new(3, 4);
        for t in 1..=3 {
            let (jacobian, noise) = motion(t, scale);
            joint.add_odometry(t, &jacobian, &noise);
        }
        for (t, j) in SIGHTINGS {
            joint.add_observation(t, j, &seen(t, j), &SENSOR.noise());
        }
        joint
    }

    fn pairs() -> impl Iterator<Item = (usize, usize)> {
        (0..4).flat_map(|i| (0..i).map(move |j| (i, j)))
    }

    /// Gauss and Jordan's elimination with the larger pivot: shares nothing with Cholesky's.
    fn brute_inverse(m: &DMatrix<f64>) -> DMatrix<f64> {
        let n = m.nrows();
        let (mut a, mut b) = (m.clone(), DMatrix::<f64>::identity(n, n));
        for k in 0..n {
            let pivot = (k..n).max_by(|&i, &j| a[(i, k)].abs().total_cmp(&a[(j, k)].abs())).unwrap();
            a.swap_rows(k, pivot);
            b.swap_rows(k, pivot);
            let scale = a[(k, k)];
            for c in 0..n {
                a[(k, c)] /= scale;
                b[(k, c)] /= scale;
            }
            for r in (0..n).filter(|&r| r != k) {
                let factor = a[(r, k)];
                for c in 0..n {
                    a[(r, c)] -= factor * a[(k, c)];
                    b[(r, c)] -= factor * b[(k, c)];
                }
            }
        }
        b
    }

    #[test]
    fn marginals_are_blocks_of_the_inverse_of_the_whole_matrix() {
        for scale in [0.3, 1.0, 3.0] {
            let joint = joint(scale);
            let whole = brute_inverse(joint.information());
            let marginal = joint.marginal().unwrap();
            assert!((marginal.matrix() - whole.view_range(9.., 9..)).norm() < 1e-9, "{scale}");
            for (t, covariance) in joint.path(joint.poses).unwrap().iter().enumerate() {
                assert!((covariance - whole.fixed_view::<3, 3>(3 * t, 3 * t)).norm() < 1e-9, "{scale}: pose {t}");
            }
        }
    }

    /// EKF-SLAM with the Jacobians held at the truth is the same linear case: it keeps the covariance of (x_t, m) and forgets
    /// the poses before.
    #[test]
    fn the_marginal_is_the_map_covariance_of_a_kalman_filter_over_pose_and_map() {
        let (mut p, mut mapped) = (DMatrix::<f64>::zeros(11, 11), [false; 4]);
        for t in 1..=3 {
            let (jacobian, noise) = motion(t, 1.0);
            let mut f = DMatrix::<f64>::identity(11, 11);
            f.fixed_view_mut::<3, 3>(0, 0).copy_from(&jacobian);
            p = &f * p * f.transpose();
            let mut corner = p.fixed_view_mut::<3, 3>(0, 0);
            corner += noise;
            for (_, j) in SIGHTINGS.into_iter().filter(|s| s.0 == t) {
                let (Prediction { h_x, h_m, .. }, at) = (seen(t, j), 3 + 2 * j);
                let mut h = DMatrix::<f64>::zeros(2, 11);
                h.fixed_view_mut::<2, 3>(0, 0).copy_from(&h_x);
                if mapped[j] {
                    h.fixed_view_mut::<2, 2>(0, at).copy_from(&h_m);
                    let s = &h * &p * h.transpose() + SENSOR.noise();
                    let gain = &p * h.transpose() * s.try_inverse().unwrap();
                    p = (DMatrix::identity(11, 11) - gain * h) * p;
                } else {
                    // m = H_m⁻¹ (z − H_x x − noise): a linear function of what is known already.
                    mapped[j] = true;
                    let back = h_m.try_inverse().unwrap();
                    let mut g = DMatrix::<f64>::identity(11, 11);
                    g.view_mut((at, 0), (2, 11)).copy_from(&(-back * &h));
                    p = &g * p * g.transpose();
                    let mut own = p.fixed_view_mut::<2, 2>(at, at);
                    own += back * SENSOR.noise() * back.transpose();
                }
            }
        }
        assert!((joint(1.0).marginal().unwrap().matrix() - p.view_range(3.., 3..)).norm() < 1e-12);
    }

    #[test]
    fn given_the_path_every_landmark_is_a_filter_of_its_own() {
        let conditional = joint(1.0).conditional().unwrap();
        for (j, at) in MAP.into_iter().enumerate() {
            let mut alone: Option<Landmark> = None;
            for (t, _) in SIGHTINGS.into_iter().filter(|s| s.1 == j) {
                let (pose, z) = (path()[t], SENSOR.predict(&path()[t], &Vector2::from(at)).z);
                match &mut alone {
                    None => alone = Some(Landmark::first(&SENSOR, &pose, &z)),
                    Some(landmark) => landmark.update(&SENSOR, &pose, &z),
                }
            }
            let difference = conditional.block(j, j) - alone.unwrap().covariance;
            assert!(difference.norm() < 1e-9 * conditional.block(j, j).norm(), "{j}: {difference}");
        }
    }

    #[test]
    fn given_the_path_every_entry_outside_the_blocks_is_exactly_zero() {
        for scale in [0.0, 1.0, 3.0] {
            let (marginal, conditional) = (joint(scale).marginal().unwrap(), joint(scale).conditional().unwrap());
            assert_eq!((marginal.off_block_nonzeros(), conditional.off_block_nonzeros()), (4 * 3 * 4, 0));
            for (i, j) in pairs() {
                assert_eq!((conditional.block(i, j), conditional.coupling(i, j)), (Matrix2::zeros(), 0.0));
            }
        }
    }

    #[test]
    fn landmarks_never_seen_together_are_correlated_all_the_same() {
        assert!(joint(1.0).marginal().unwrap().coupling(0, 3) > 0.1);
    }

    #[test]
    fn couplings_grow_with_the_noise_of_the_odometry_and_vanish_without() {
        let at = |scale| joint(scale).marginal().unwrap();
        let maps = [0.0, 0.03, 0.1, 0.3, 1.0].map(at);
        for (i, j) in pairs() {
            assert!(maps[0].coupling(i, j) < 1e-6, "{}", maps[0].coupling(i, j));
            assert!(maps.windows(2).all(|w| w[0].coupling(i, j) < w[1].coupling(i, j)), "{i}, {j}");
        }
    }

    #[test]
    fn the_coupling_is_the_largest_correlation_of_any_two_directions() {
        let map = joint(1.0).marginal().unwrap();
        for (i, j) in pairs() {
            let direction = |k: u32| {
                let (sin, cos) = fastslam::ops::sin_cos(f64::from(k) * core::f64::consts::PI / 400.0);
                Vector2::new(cos, sin)
            };
            let variance = |k: usize, a: &Vector2<f64>| a.dot(&(map.block(k, k) * a));
            let mut largest = 0.0_f64;
            for (a, b) in (0..400).flat_map(|a| (0..400).map(move |b| (direction(a), direction(b)))) {
                let rho = a.dot(&(map.block(i, j) * b)) / (variance(i, &a) * variance(j, &b)).sqrt();
                largest = largest.max(rho.abs());
            }
            let coupling = map.coupling(i, j);
            // Directions half a degree apart miss the largest by a few in 10 000.
            assert!(largest <= coupling + 1e-12 && largest > coupling - 1e-3, "{i}, {j}: {largest}, {coupling}");
            assert!((map.coupling(j, i) - coupling).abs() < 1e-12);
            for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                assert!(map.correlation(2 * i + a, 2 * j + b).abs() <= coupling + 1e-12);
            }
        }
    }

    #[test]
    fn a_landmark_that_was_never_sighted_has_no_covariance() {
        let mut joint = Joint::new(1, 1);
        let (jacobian, noise) = motion(1, 1.0);
        joint.add_odometry(1, &jacobian, &noise);
        assert_eq!((joint.marginal(), joint.conditional(), joint.path(joint.poses)), (None, None, None));
    }
}
