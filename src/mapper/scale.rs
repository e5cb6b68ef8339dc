//! How far the robot drives by the scans, of how far it drives by odometry: a unit, a gear or a wheel that is not as told.
//!
//! The path that was matched needs no other start than the mapper's own, and no scan is matched again. Where scans do not tell how far the robot went, as along a
//! corridor, the path follows odometry: the ratio is nearer to 1 than it should be, and never further.

use crate::geometry::Pose2;
use crate::order::sorted;

/// Distance by odometry \[m\] from the start of a leg to its end: errors of single matched poses, of some centimetres, are small to it.
const LEG: f64 = 1.0;

/// Fewer legs are no evidence.
const LEAST_LEGS: usize = 20;

/// Beyond this factor, or the inverse, the scale is no property of sound wheels: the radius on which a loaded tyre rolls is 2 to 4 % less than that of the free one, and those
/// of the Intel log tell of 3.4 % more than they drive.
const SOUND: f64 = 1.05;

/// Standard errors by which a scale must differ from 1.
const CLEAR: f64 = 4.0;

/// The standard error of a median of n normal values, and their standard deviation, of the median of their absolute deviations: √(π/2) / √n and 1 / Φ⁻¹(¾).
const OF_MEDIAN: f64 = 1.2533;
const OF_DEVIATION: f64 = 1.4826;

/// Median over legs of the way, of the ratio of how far they lead by the path and by odometry.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct DrivenScale {
    pub(super) times: f64,
    /// Standard error.
    pub(super) std: f64,
}

impl DrivenScale {
    /// By odometry and path at each step; `None` of a way that is too short to tell.
    pub(super) fn of<'a>(odometry: &[Pose2], path: impl IntoIterator<Item = &'a Pose2>) -> Option<Self> {
        let mut ratios = Vec::new();
        let mut from: Option<[&Pose2; 2]> = None;
        for at in odometry.iter().zip(path) {
            let [told, matched] = from.map_or([0.0; 2], |from| [from[0].distance(at.0), from[1].distance(at.1)]);
            if told >= LEG {
                ratios.push(matched / told);
            }
            if from.is_none() || told >= LEG {
                from = Some([at.0, at.1]);
            }
        }
        if ratios.len() < LEAST_LEGS {
            return None;
        }
        let roots = (ratios.len() as f64).sqrt();
        let times = median(ratios.clone());
        let off = median(ratios.iter().map(|ratio| (ratio - times).abs()).collect());
        Some(Self { times, std: OF_MEDIAN * OF_DEVIATION * off / roots })
    }

    /// Whether scans and odometry contradict each other so.
    pub(super) fn is_off(&self) -> bool {
        !(SOUND.recip()..SOUND).contains(&self.times) && (self.times - 1.0).abs() > CLEAR * self.std
    }
}

/// The upper one of two.
fn median(values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    sorted(values, f64::total_cmp)[middle]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Stream};

    /// A drive round and round of so many steps of 0.4 m, told so many times as far as it goes, and matched to within 2 cm but for every fortieth pose, which is a metre off.
    fn of(steps: u32, told: f64) -> Option<DrivenScale> {
        let step = |k: u32, way: f64| Pose2::new(way, 0.0, 0.1 * f64::from(k % 3));
        let along = |way: f64| {
            (0..steps).scan(Pose2::default(), move |at, k| {
                *at = at.compose(&step(k, way));
                Some(*at)
            })
        };
        let matched = along(0.4).zip(0..).map(|(at, k)| {
            let [x, y] = Stream::at(1, Purpose::TRIAL, k, 0).normals();
            Pose2::new(at.x + 0.02 * x + if k % 40 == 0 { 1.0 } else { 0.0 }, at.y + 0.02 * y, at.theta)
        });
        DrivenScale::of(&along(0.4 * told).collect::<Vec<_>>(), &matched.collect::<Vec<_>>())
    }

    #[test]
    fn the_scale_is_that_of_most_legs_and_within_its_error() {
        for told in [1.0, 1.2, 0.8, 1.03] {
            let scale = of(400, told).unwrap();
            assert!((scale.times - 1.0 / told).abs() < 4.0 * scale.std && scale.std < 0.01, "{told}: {scale:?}");
            assert_eq!(scale.is_off(), told == 1.2 || told == 0.8, "{told}: {scale:?}");
        }
    }

    #[test]
    fn a_short_way_tells_no_scale() {
        assert_eq!(of(40, 1.2), None);
        assert_eq!(DrivenScale::of(&[], &[]), None);
    }

    #[test]
    fn what_is_within_its_error_or_that_of_sound_wheels_is_not_off() {
        let is_off = |times, std| DrivenScale { times, std }.is_off();
        assert!(is_off(1.06, 0.01) && is_off(0.94, 0.01));
        assert!(!is_off(1.06, 0.02) && !is_off(0.94, 0.02) && !is_off(1.04, 0.001) && !is_off(0.96, 0.001));
        assert!(!is_off(f64::NAN, f64::NAN));
    }
}
