//! A range finder: one reading per beam.

use crate::geometry::Pose2;
use crate::ops;

/// A planar range finder in the robot's centre.
#[derive(Clone, PartialEq, Debug)]
pub struct BeamSensor {
    /// Direction of each beam in the robot's frame \[rad\].
    pub angles: Vec<f64>,
    /// Longest range \[m\] that is measured: at or beyond it a reading says *nothing met*.
    pub max_range: f64,
    /// Standard deviation of a range \[m\].
    pub range_std: f64,
}

impl BeamSensor {
    /// `count` beams all around, the first straight ahead.
    pub fn panorama(count: usize, max_range: f64, range_std: f64) -> Self {
        let angles = (0..count).map(|k| core::f64::consts::TAU * k as f64 / count as f64).collect();
        Self { angles, max_range, range_std }
    }

    /// The scan of these ranges \[m\], one for each beam; readings that are not finite or not positive are dropped, readings
    /// at or beyond the longest range say that the way is free up to there.
    pub fn scan(&self, ranges: &[f64]) -> Scan {
        let mut scan = Scan::default();
        for (&angle, &range) in self.angles.iter().zip(ranges) {
            let met = range < self.max_range;
            let length = if met { range } else { self.max_range };
            if length > 0.0 && !range.is_nan() {
                let (sin, cos) = ops::sin_cos(angle);
                let end = [length * cos, length * sin];
                if met { scan.hits.push(end) } else { scan.misses.push(end) }
            }
        }
        scan
    }
}

/// A scan: where it was taken, and the end points of its beams, in the robot's frame \[m\].
///
/// The way of a beam from `origin` to its end is free. A scan of a range finder in the robot's centre has the origin (0, 0), the default.
#[derive(Clone, PartialEq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scan {
    /// Where the range finder sits: all beams begin here.
    pub origin: [f64; 2],
    /// Where beams met something.
    pub hits: Vec<[f64; 2]>,
    /// Where beams that met nothing reached their longest range.
    pub misses: Vec<[f64; 2]>,
}

impl Scan {
    /// This scan, given in the range finder's frame, in the frame of a robot on which it is mounted at `robot_from_sensor`.
    pub fn mounted(&self, robot_from_sensor: &Pose2) -> Self {
        let place = |points: &[[f64; 2]]| points.iter().map(|point| robot_from_sensor.transform(*point)).collect();
        let origin = robot_from_sensor.transform(self.origin);
        Self { origin, hits: place(&self.hits), misses: place(&self.misses) }
    }

    /// Every `stride`-th end point.
    pub fn thinned(&self, stride: usize) -> Self {
        let every = |ends: &[[f64; 2]]| ends.iter().step_by(stride.max(1)).copied().collect();
        Self { hits: every(&self.hits), misses: every(&self.misses), ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_are_sorted_into_hits_and_misses() {
        let sensor = BeamSensor::panorama(6, 5.0, 0.1);
        let scan = sensor.scan(&[1.0, 5.0, f64::INFINITY, f64::NAN, -1.0, 0.0]);
        assert_eq!((scan.hits.len(), scan.misses.len()), (1, 2));
        assert_eq!(scan.hits[0], [1.0, 0.0]);
    }
}
