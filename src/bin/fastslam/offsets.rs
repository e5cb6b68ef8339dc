//! Whether bearings or ranges of landmarks with names are off all along by a constant, and by how much.
//!
//! Two measurements of a landmark say little of it, as their own noise is taken for it. All measurements of a drive together say it: one Gaussian of the
//! pose, the landmarks and what is constant, as in EKF-SLAM, in which scale and drift of the odometry are constants, too.

use fastslam::geometry::Pose2;
use fastslam::motion::{Motion, Velocity, VelocityDiffusion};
use fastslam::nalgebra::{DMatrix, DVector, Matrix2, SMatrix, Vector2};
use fastslam::ops;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use fastslam_lab::experiment::innovations::agreeing;
use std::collections::{BTreeMap, BTreeSet};

/// Stretches of the drive of which each is asked by itself, by their scatter to know what is repeated or lost in one: halves, as the longer a stretch is, the
/// more often it meets its landmarks again from other sides.
const STRETCHES: usize = 2;

/// Standard deviations of what is constant before anything is seen: of bearings \[rad\] and ranges \[m\], the share of the speed, and the turn to the left
/// per metre ahead \[rad/m\] and per radian turned.
const BEFORE: [f64; 5] = [0.2, 0.5, 0.1, 0.05, 0.1];

/// Pose and constants.
const FIXED: usize = 3 + BEFORE.len();

/// Most landmarks of which the joint Gaussian is made.
const MOST: usize = 100;

/// Largest νᵀ S⁻¹ ν of a measurement that is used: a chance of 10⁻⁶.
const OUTLIER: f64 = 27.6;

/// Standard errors by which an offset is not zero, at least, where a word is said of it.
const SURE: f64 = 4.0;

/// Offsets of bearings \[rad\] and ranges \[m\] that are not worth a word: two degrees, and five centimetres.
const WORTH: [f64; 2] = [0.035, 0.05];

/// By how much bearings \[rad\] and ranges \[m\] are off, each 0 where that is not sure; `None` where nothing is known.
///
/// z = h(x, m) + offsets + noise. Each is the mean over the stretches, weighted by what each says beyond [`BEFORE`]. Rows of odometry are time \[s\],
/// v \[m/s\] and ω \[rad/s\], as for [`Sequence`](crate::calibration::Sequence).
pub fn offsets(
    odometry: &[[f64; 3]],
    looks: &[(f64, Vec<Feature>)],
    motion: &VelocityDiffusion,
    sensor: &RangeBearing,
) -> Option<[f64; 2]> {
    let names: BTreeSet<u32> =
        looks.iter().flat_map(|(_, seen)| seen).filter_map(|feature| feature.signature).collect();
    let looks: Vec<&(f64, Vec<Feature>)> =
        looks.iter().filter(|look| look.0 >= odometry[0][0] && look.0 <= odometry[odometry.len() - 1][0]).collect();
    if names.len() > MOST || looks.len() < STRETCHES || sensor.noise().try_inverse().is_none() {
        return None;
    }
    let [start, end] = [looks[0].0, looks[looks.len() - 1].0];
    let bound = |k: usize| start + (end - start) * k as f64 / STRETCHES as f64;
    let mut stretches = Vec::new();
    for k in 0..STRETCHES {
        let within = looks.iter().filter(|look| look.0 >= bound(k) && (look.0 < bound(k + 1) || k + 1 == STRETCHES));
        let mut joint = Joint::new(*motion, *sensor);
        let mut now = bound(k);
        for (time, features) in within {
            held(odometry, now, *time).for_each(|reported| joint.step(&reported));
            now = *time;
            features.iter().for_each(|feature| joint.see(feature));
        }
        let mean = joint.squared / f64::from(joint.count.max(1));
        if joint.count == 0 || mean > agreeing(joint.count)[1] {
            return None;
        }
        stretches.push(joint);
    }
    let off = [0, 1].map(|which| {
        // What each stretch says beyond what was taken for granted before.
        let told: Vec<[f64; 2]> = stretches
            .iter()
            .map(|joint| {
                let variance = joint.covariance[(3 + which, 3 + which)];
                let information = 1.0 / variance - 1.0 / (BEFORE[which] * BEFORE[which]);
                [joint.mean[3 + which] / variance, information.max(0.0)]
            })
            .collect();
        let all: f64 = told.iter().map(|one| one[1]).sum();
        let mean = told.iter().map(|one| one[0]).sum::<f64>() / all;
        let scatter = told.iter().filter(|one| one[1] > 0.0).map(|[sum, weight]| {
            let off = sum / weight - mean;
            weight * off * off
        });
        let std = ((scatter.sum::<f64>() / (STRETCHES - 1) as f64).max(1.0) / all).sqrt();
        if mean.abs() > WORTH[which].max(SURE * std) { mean } else { 0.0 }
    });
    Some(off)
}

/// What is to be told.
pub fn remarks(
    odometry: &[[f64; 3]],
    looks: &[(f64, Vec<Feature>)],
    motion: &VelocityDiffusion,
    sensor: &RangeBearing,
) -> Vec<String> {
    let [bearing, range] = offsets(odometry, looks, motion, sensor).unwrap_or_default();
    let bearing = (bearing != 0.0).then(|| {
        format!(
            "bearings are off by {:+.1}° all along (to the left is positive), by odometry and landmarks together: check how the sensor is mounted",
            bearing.to_degrees()
        )
    });
    let range = (range != 0.0).then(|| {
        format!("ranges are off by {range:+.2} m all along, by odometry and landmarks together: check from where the sensor measures")
    });
    [bearing, range].into_iter().flatten().collect()
}

/// N((x, y, θ, offsets of bearings and ranges, shares of speed, turns per metre and per radian, m₁ … m_N), P).
struct Joint {
    motion: VelocityDiffusion,
    sensor: RangeBearing,
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
    /// Row of each landmark.
    rows: BTreeMap<u32, usize>,
    /// Sum of νᵀ S⁻¹ ν, and their number.
    squared: f64,
    count: u32,
}

impl Joint {
    fn new(motion: VelocityDiffusion, sensor: RangeBearing) -> Self {
        let std = |k: usize| if k < 3 { 0.0 } else { BEFORE[k - 3] };
        let covariance = DMatrix::from_fn(FIXED, FIXED, |i, k| if i == k { std(k) * std(k) } else { 0.0 });
        let mean = DVector::zeros(FIXED);
        Self { motion, sensor, mean, covariance, rows: BTreeMap::new(), squared: 0.0, count: 0 }
    }

    fn pose(&self) -> Pose2 {
        Pose2::new(self.mean[0], self.mean[1], self.mean[2])
    }

    fn step(&mut self, reported: &Velocity) {
        let Velocity { speed, turn_rate, duration } = *reported;
        let (ahead, turned) = (speed * duration, turn_rate * duration);
        let [share, per_metre, per_turn] = [5, 6, 7].map(|k| self.mean[k]);
        let way = ahead * (1.0 + share);
        let turn = turned * (1.0 + per_turn) + way * per_metre;
        let (sin, cos) = ops::sin_cos(self.mean[2] + 0.5 * turn);
        // Derivatives of the way and the turn by the three constants.
        let by = [[ahead, ahead * per_metre], [0.0, way], [0.0, turned]];
        let mut f = SMatrix::<f64, FIXED, FIXED>::identity();
        f[(0, 2)] = -way * sin;
        f[(1, 2)] = way * cos;
        for (k, [d_way, d_turn]) in (5..).zip(by) {
            f[(0, k)] = d_way * cos - 0.5 * way * sin * d_turn;
            f[(1, k)] = d_way * sin + 0.5 * way * cos * d_turn;
            f[(2, k)] = d_turn;
        }
        let noise = self.motion.covariance(&self.pose(), reported);
        let p = &mut self.covariance;
        let top = f * p.fixed_rows::<FIXED>(0);
        p.fixed_rows_mut::<FIXED>(0).copy_from(&top);
        let left = p.fixed_columns::<FIXED>(0) * f.transpose();
        p.fixed_columns_mut::<FIXED>(0).copy_from(&left);
        let mut pose = p.fixed_view_mut::<3, 3>(0, 0);
        pose += noise;
        self.mean[0] += way * cos;
        self.mean[1] += way * sin;
        self.mean[2] = ops::wrap_angle(self.mean[2] + turn);
    }

    fn see(&mut self, Feature { z, signature }: &Feature) {
        let Some(name) = signature else { return };
        let off = Vector2::new(self.mean[4], self.mean[3]);
        if !self.sensor.can_measure(z) || !self.sensor.can_measure(&(z - off)) {
            return;
        }
        match self.rows.get(name) {
            Some(row) => self.update(*row, z, &off),
            None => self.found(*name, &(z - off)),
        }
    }

    fn found(&mut self, name: u32, z: &Vector2<f64>) {
        let (pose, row) = (self.pose(), self.mean.len());
        let at = self.sensor.locate(&pose, z);
        let prediction = self.sensor.predict(&pose, &at);
        let Some(g) = prediction.h_m.try_inverse() else { return };
        // By the pose and the offsets of bearing and range.
        let mut j = SMatrix::<f64, 2, 5>::zeros();
        j.fixed_columns_mut::<3>(0).copy_from(&(-g * prediction.h_x));
        j.set_column(3, &-g.column(1));
        j.set_column(4, &-g.column(0));
        let across = j * self.covariance.fixed_rows::<5>(0);
        let own = across.fixed_columns::<5>(0) * j.transpose() + g * self.sensor.noise() * g.transpose();
        self.covariance.resize_mut(row + 2, row + 2, 0.0);
        self.covariance.view_mut((row, 0), (2, row)).copy_from(&across);
        self.covariance.view_mut((0, row), (row, 2)).copy_from(&across.transpose());
        self.covariance.view_mut((row, row), (2, 2)).copy_from(&own);
        self.mean.resize_vertically_mut(row + 2, 0.0);
        self.mean[row] = at.x;
        self.mean[row + 1] = at.y;
        self.rows.insert(name, row);
    }

    fn update(&mut self, row: usize, z: &Vector2<f64>, off: &Vector2<f64>) {
        let at = Vector2::new(self.mean[row], self.mean[row + 1]);
        let prediction = self.sensor.predict(&self.pose(), &at);
        let nu = self.sensor.residual(&(z - off), &prediction.z);
        let mut h = DMatrix::zeros(2, self.mean.len());
        h.view_mut((0, 0), (2, 3)).copy_from(&prediction.h_x);
        h[(1, 3)] = 1.0;
        h[(0, 4)] = 1.0;
        h.view_mut((0, row), (2, 2)).copy_from(&prediction.h_m);
        let ph = &self.covariance * h.transpose();
        let s: Matrix2<f64> = (h * &ph).fixed_view::<2, 2>(0, 0) + self.sensor.noise();
        let Some(inverse) = s.try_inverse() else { return };
        let squared = nu.dot(&(inverse * nu));
        self.squared += squared;
        self.count += 1;
        if squared > OUTLIER {
            return;
        }
        let gain = &ph * inverse;
        self.mean += &gain * nu;
        self.covariance -= &gain * ph.transpose();
        // Rounding must not make it lopsided, which would grow.
        self.covariance = (&self.covariance + self.covariance.transpose()) * 0.5;
    }
}

/// Readings that each hold until the next, between two times.
pub fn held(odometry: &[[f64; 3]], from: f64, until: f64) -> impl Iterator<Item = Velocity> {
    let first = odometry.partition_point(|row| row[0] <= from).max(1) - 1;
    let begun = (first..odometry.len()).take_while(move |k| odometry[*k][0].max(from) < until);
    begun.filter_map(move |k| {
        let [time, speed, turn_rate] = odometry[k];
        let duration = odometry.get(k + 1).map_or(until, |next| next[0].min(until)) - time.max(from);
        (duration > 0.0).then_some(Velocity { speed, turn_rate, duration })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::random::{Purpose, Stream};
    use std::f64::consts::TAU;

    const SENSOR: RangeBearing = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 6.0, field_of_view: 2.0 };
    const MOTION: VelocityDiffusion = VelocityDiffusion { speed_std: 0.01, turn_rate_std: 0.02, alphas: [0.0; 4] };

    /// Worlds of landmarks: few and many at random, in pairs, in a ring, along a corridor.
    fn worlds(seed: u64) -> [Vec<Vector2<f64>>; 5] {
        let mut stream = Stream::at(seed, Purpose::TRIAL, 0, 1);
        let mut within = || 20.0 * stream.uniform() - 10.0;
        let scattered: Vec<_> = (0..40).map(|_| Vector2::new(within(), within())).collect();
        let few = scattered[..12].to_vec();
        let pairs = scattered[..10].iter().flat_map(|at| [*at, at + Vector2::new(0.3, 0.4)]).collect();
        let on_circle = |k: u32| {
            let (radius, angle) = (if k.is_multiple_of(2) { 5.0 } else { 9.0 }, TAU * f64::from(k) / 24.0);
            Vector2::new(radius * ops::cos(angle), radius * ops::sin(angle))
        };
        let corridor = (0..24).map(|k| Vector2::new(f64::from(k) - 12.0, if k % 2 == 0 { 1.2 } else { -1.2 }));
        [few, scattered, pairs, (0..24).map(on_circle).collect(), corridor.collect()]
    }

    /// What is said of a robot that drives about among landmarks for ten minutes, by these noises and with these offsets of ranges and bearings.
    fn said(seed: u64, landmarks: &[Vector2<f64>], off: [f64; 2], motion: &VelocityDiffusion) -> Vec<String> {
        let (mut odometry, mut looks, mut pose) = (Vec::new(), Vec::new(), Pose2::default());
        for k in 0..1200_u32 {
            let time = 0.5 * f64::from(k);
            let mut stream = Stream::at(seed, Purpose::TRIAL, k, 2);
            let seen = (0..).zip(landmarks).filter_map(|(name, at)| {
                let (dx, dy) = (at.x - pose.x, at.y - pose.y);
                let [a, b] = stream.normals();
                let range = ops::hypot(dx, dy) + SENSOR.range_std * a + off[0];
                let bearing = ops::wrap_angle(ops::atan2(dy, dx) - pose.theta);
                let z = Vector2::new(range, ops::wrap_angle(bearing + SENSOR.bearing_std * b + off[1]));
                (range > 0.3 && range < 6.0 && bearing.abs() < 1.0).then_some(Feature { z, signature: Some(name) })
            });
            looks.push((time, seen.collect()));
            let to_middle = ops::wrap_angle(ops::atan2(-pose.y, -pose.x) - pose.theta);
            let is_far = ops::hypot(pose.x, pose.y) > 7.0 && to_middle.abs() > 0.5;
            let turn_rate = if is_far { 0.5 } else { 0.3 * ops::sin(0.07 * f64::from(k)) };
            odometry.push([time, 0.3, turn_rate]);
            let [a, b] = stream.normals();
            let driven = Velocity {
                speed: 0.3 + motion.speed_std * a / 0.5_f64.sqrt(),
                turn_rate: turn_rate + motion.turn_rate_std * b / 0.5_f64.sqrt(),
                duration: 0.5,
            };
            pose = driven.apply(&pose);
        }
        remarks(&odometry, &looks, motion, &SENSOR)
    }

    /// Nor of a robot whose heading slips by a radian in a minute, of which the Gaussian is too sure.
    #[test]
    fn of_a_sensor_without_offsets_nothing_is_told_in_any_world() {
        let slipping = VelocityDiffusion { speed_std: 0.03, turn_rate_std: 0.12, ..MOTION };
        for seed in 1..=12 {
            for (world, landmarks) in worlds(seed).iter().enumerate() {
                for motion in [MOTION, slipping] {
                    let said = said(seed, landmarks, [0.0; 2], &motion);
                    assert_eq!(said, [""; 0], "world {world}, seed {seed}, {motion:?}");
                }
            }
        }
    }

    /// Of few landmarks, a robot may see too little for a word.
    #[test]
    fn constant_offsets_of_bearings_and_ranges_are_told_by_how_much() {
        for (off, part) in [
            ([0.0, 0.0873], "bearings are off by +"),
            ([0.0, -0.0873], "bearings are off by -"),
            ([0.3, 0.0], "ranges are off by +0."),
            ([-0.3, 0.0], "ranges are off by -0."),
        ] {
            let mut told = [0; 5];
            for seed in 1..=10 {
                for (world, landmarks) in worlds(seed).iter().enumerate() {
                    let said = said(seed, landmarks, off, &MOTION);
                    assert!(
                        said.len() < 2 && said.iter().all(|one| one.contains(part)),
                        "world {world}, seed {seed}: {off:?} {said:?}"
                    );
                    told[world] += said.len();
                }
            }
            assert!(told.iter().all(|told| *told >= 9), "{off:?}: {told:?}");
        }
    }
}
