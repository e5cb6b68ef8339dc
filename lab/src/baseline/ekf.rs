//! EKF-SLAM: pose and landmarks in one joint Gaussian.
//!
//! The peer that must commit: one association for all, and one linearisation. A sighting touches all (3 + 2 N)² entries of the
//! covariance, where a particle's touches four. Where motion and sensor are linear it *is* the Kalman filter, and its Gaussian the
//! posterior itself: the chain that FastSLAM must agree with in the limit of many particles.
//!
//! Reference: Thrun, Burgard, Fox, *Probabilistic Robotics* (2005), tables 10.1 and 10.2.

use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Association, Belief, Correspondence, Gate, Innovation, Landmark};
use fastslam::motion::Motion;
use fastslam::nalgebra::{DMatrix, Dyn, Matrix2, Matrix3, OMatrix, U2, Vector2};
use fastslam::sensor::{Feature, LandmarkSensor, Prediction};

/// N((x, m₁ … m_N), P) for a motion model D and a sensor Z.
#[derive(Clone, Debug)]
pub struct EkfSlam<D, Z> {
    motion: D,
    sensor: Z,
    correspondence: Correspondence,
    pose: Pose2,
    landmarks: Vec<Known>,
    /// P: the pose's three rows, then two for each landmark.
    covariance: DMatrix<f64>,
    /// One past the largest index ever given.
    len: u32,
}

/// A landmark without its covariance, which is part of P.
#[derive(Clone, Debug)]
struct Known {
    index: u32,
    mean: Vector2<f64>,
    existence_count: i32,
}

/// What one step of the joint filter did.
#[derive(Clone, PartialEq, Debug)]
pub struct EkfStep {
    /// What the features were taken to be, by all alike.
    pub associations: Vec<Association>,
    /// ln p(z_t | z₁..ₜ₋₁) = ln ∏ N(ν; 0, S), times p₀ for each new landmark \[nats\].
    pub log_evidence: f64,
}

/// P Hᵀ and its like: n × 2.
type Tall = OMatrix<f64, Dyn, U2>;

impl<D: Motion, Z: LandmarkSensor> Belief for EkfSlam<D, Z> {
    fn learns(&self) -> bool {
        true
    }

    fn can_measure(&self, z: &Vector2<f64>) -> bool {
        self.sensor.can_measure(z)
    }

    fn index_bound(&self) -> u32 {
        self.len
    }

    fn innovation(&self, feature: &Feature, index: u32, _: Option<f64>) -> Option<Innovation> {
        Some(self.innovation_of(self.row(index)?, &feature.z))
    }

    fn learn(&mut self, index: u32, innovation: &Innovation) {
        self.update(index, innovation);
    }
}

impl<D: Motion, Z: LandmarkSensor> EkfSlam<D, Z> {
    /// A robot that surely stands at `start`, with an empty map.
    pub fn new(motion: D, sensor: Z, correspondence: Correspondence, start: Pose2) -> Self {
        let covariance = DMatrix::zeros(3, 3);
        Self { motion, sensor, correspondence, pose: start, landmarks: Vec::new(), covariance, len: 0 }
    }

    /// One step: moves, corrects by every feature of a mapped landmark, each from where the one before left it, and appends what
    /// is new as seen from the corrected pose.
    pub fn step(&mut self, control: &D::Control, features: &[Feature]) -> EkfStep {
        self.predict(control);
        let correspondence = self.correspondence;
        let associated = correspondence.associate(features, self);
        if let Correspondence::Unknown(Gate { removal: true, .. }) = self.correspondence {
            self.apply_negative_information(&associated.associations);
        }
        for (index, k) in associated.founded() {
            self.append(index, &features[k].z);
        }
        EkfStep { associations: associated.associations, log_evidence: associated.log_likelihood }
    }

    /// Mean of the pose.
    pub fn pose(&self) -> &Pose2 {
        &self.pose
    }

    /// Covariance of the pose (3 × 3, \[m, m, rad\]).
    pub fn pose_covariance(&self) -> Matrix3<f64> {
        self.covariance.fixed_view::<3, 3>(0, 0).into_owned()
    }

    /// The landmark of this index with the covariance that it has by itself, the pose's noise included; `None` where there is
    /// none yet, or none any more.
    pub fn landmark(&self, index: u32) -> Option<Landmark> {
        Some(self.marginal(self.row(index)?))
    }

    /// All landmarks with their indices, in the order in which they were founded: that of P.
    pub fn iter(&self) -> impl Iterator<Item = (u32, Landmark)> {
        self.landmarks.iter().enumerate().map(|(row, known)| (known.index, self.marginal(row)))
    }

    /// P ((3 + 2 N)², \[m, rad\]): of the pose (x, y, θ), then of the landmarks in the order of [`Self::iter`].
    pub fn covariance(&self) -> &DMatrix<f64> {
        &self.covariance
    }

    /// Where the landmark of an index is kept.
    fn row(&self, index: u32) -> Option<usize> {
        self.landmarks.iter().position(|known| known.index == index)
    }

    fn marginal(&self, row: usize) -> Landmark {
        let (Known { mean, existence_count, .. }, at) = (&self.landmarks[row], 3 + 2 * row);
        Landmark {
            mean: *mean,
            covariance: self.covariance.fixed_view::<2, 2>(at, at).into_owned(),
            existence_count: *existence_count,
            apart: 0,
        }
    }

    /// P ← G P Gᵀ + R_t, where G differs from the identity in the pose's block only.
    fn predict(&mut self, control: &D::Control) {
        let drive = self.motion.drive(control);
        let (g, noise) = (drive.jacobian(&self.pose), drive.covariance(&self.pose));
        self.pose = drive.apply(&self.pose);
        let rows = g * self.covariance.fixed_rows::<3>(0);
        self.covariance.fixed_rows_mut::<3>(0).copy_from(&rows);
        let columns = self.covariance.fixed_columns::<3>(0) * g.transpose();
        self.covariance.fixed_columns_mut::<3>(0).copy_from(&columns);
        let block = self.pose_covariance() + noise;
        self.covariance.fixed_view_mut::<3, 3>(0, 0).copy_from(&block);
        self.symmetrise();
    }

    /// S = H P Hᵀ + Q, where H is zero but for H_x and the landmark's H_m.
    fn innovation_of(&self, row: usize, z: &Vector2<f64>) -> Innovation {
        let cross = self.covariance.fixed_view::<3, 2>(0, 3 + 2 * row);
        self.marginal(row).innovation_with(&self.sensor, &self.pose, z, |Prediction { h_x, h_m, .. }| {
            let both = h_x * cross * h_m.transpose();
            h_x * self.pose_covariance() * h_x.transpose() + both + both.transpose()
        })
    }

    /// K = P Hᵀ S⁻¹, μ ← μ + K ν, and P by Joseph's form.
    fn update(&mut self, index: u32, innovation: &Innovation) {
        let Some(row) = self.row(index) else { return };
        let Innovation { prediction: Prediction { h_x, h_m, .. }, residual, inverse, .. } = innovation;
        let times_h = |p: &DMatrix<f64>| -> Tall {
            p.fixed_columns::<3>(0) * h_x.transpose() + p.fixed_columns::<2>(3 + 2 * row) * h_m.transpose()
        };
        let ph = times_h(&self.covariance);
        let gain = &ph * inverse;
        let kept = &self.covariance - &gain * ph.transpose();
        let other = times_h(&kept);
        self.covariance = kept - other * gain.transpose() + &gain * self.sensor.noise() * gain.transpose();
        self.symmetrise();

        let delta = gain * residual;
        self.pose = self.pose.plus(&delta.fixed_rows::<3>(0).into_owned());
        for (k, known) in self.landmarks.iter_mut().enumerate() {
            known.mean += delta.fixed_rows::<2>(3 + 2 * k);
        }
        let existence_count = self.landmarks[row].existence_count.saturating_add(1);
        self.landmarks[row].existence_count = self.counted(existence_count);
    }

    /// An existence count with the worth of the sighting that has just raised it by one, or to one.
    fn counted(&self, count: i32) -> i32 {
        match self.correspondence {
            Correspondence::Known => count,
            Correspondence::Unknown(gate) => gate.counted(count),
        }
    }

    /// m = h⁻¹(x, z): its covariance with everything is J times the pose's, J = −H_m⁻¹ H_x.
    fn append(&mut self, index: u32, z: &Vector2<f64>) {
        let Landmark { mean, covariance: seen, existence_count, .. } = Landmark::first(&self.sensor, &self.pose, z);
        let Prediction { h_x, h_m, .. } = self.sensor.predict(&self.pose, &mean);
        let Some(inverse) = h_m.try_inverse().filter(|_| seen.iter().all(|entry| entry.is_finite())) else { return };
        let j = -inverse * h_x;
        let rows = j * self.covariance.fixed_rows::<3>(0);
        let own: Matrix2<f64> = j * self.pose_covariance() * j.transpose() + seen;
        let n = self.covariance.nrows();
        let mut grown = core::mem::take(&mut self.covariance).resize(n + 2, n + 2, 0.0);
        grown.view_mut((n, 0), (2, n)).copy_from(&rows);
        grown.view_mut((0, n), (n, 2)).copy_from(&rows.transpose());
        grown.fixed_view_mut::<2, 2>(n, n).copy_from(&own);
        self.covariance = grown;
        self.symmetrise();
        let existence_count = self.counted(existence_count);
        self.landmarks.push(Known { index, mean, existence_count });
        self.len = self.len.max(index.saturating_add(1));
    }

    /// Takes existence count from what should have been seen and was not, and strikes off what has none left, as a particle does: its
    /// rows and columns go, which is the marginal of the others.
    fn apply_negative_information(&mut self, associations: &[Association]) {
        for row in (0..self.landmarks.len()).rev() {
            let landmark = self.marginal(row);
            let missed = !associations.contains(&Association::Matched(self.landmarks[row].index))
                && self.sensor.sees(&self.pose, &landmark.mean, 3.0 * landmark.largest_std());
            if missed && landmark.existence_count > 0 {
                self.landmarks[row].existence_count -= 1;
            } else if missed {
                self.landmarks.remove(row);
                let at = 3 + 2 * row;
                self.covariance = core::mem::take(&mut self.covariance).remove_rows(at, 2).remove_columns(at, 2);
            }
        }
    }

    /// Both off-diagonals their mean: the last bits of a product of symmetric matrices need not agree.
    fn symmetrise(&mut self) {
        for j in 0..self.covariance.ncols() {
            for i in 0..j {
                let off = 0.5 * (self.covariance[(i, j)] + self.covariance[(j, i)]);
                (self.covariance[(i, j)], self.covariance[(j, i)]) = (off, off);
            }
        }
    }
}
