//! Landmarks that were seen again and again, and then no more, although they should be in view.

use fastslam::geometry::Pose2;
use fastslam::nalgebra::Vector2;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};

/// Fewest looks that saw a landmark before it is missed.
const SEEN: usize = 10;

/// ln of the probability that a landmark which is there is missed as often as it was.
const BY_CHANCE: f64 = -14.0;

/// Share of range and field of view in which a landmark surely is in view.
const SURELY: f64 = 0.9;

/// A sensor that is told to see farther \[m\] is told to see everything: what is in view is not known.
const EVERYTHING: f64 = 1e5;

/// How many landmarks have gone, by a path and the map along it. Each look finds a landmark in its view by itself, as often as it was found up to the last time.
pub fn gone(
    path: &[Pose2],
    sightings: &[Vec<Feature>],
    landmarks: impl Iterator<Item = (u32, Vector2<f64>)>,
    sensor: &RangeBearing,
) -> usize {
    let views = || path.iter().skip(1).zip(sightings).filter(|(_, features)| !features.is_empty());
    let is_gone = |(name, at): &(u32, Vector2<f64>)| {
        let looks: Vec<[bool; 2]> = views()
            .map(|(pose, features)| {
                let z = sensor.predict(pose, at).z;
                let in_view = z.x < SURELY * sensor.max_range && z.y.abs() < 0.5 * SURELY * sensor.field_of_view;
                [in_view, features.iter().any(|feature| feature.signature == Some(*name))]
            })
            .collect();
        let found = |look: &[bool; 2]| look[1];
        let (Some(first), Some(last)) = (looks.iter().position(found), looks.iter().rposition(found)) else {
            return false;
        };
        let in_view = |looks: &[[bool; 2]]| looks.iter().filter(|look| look[0]).count();
        let seen = looks.iter().filter(|look| look[0] && look[1]).count();
        let found = seen as f64 / in_view(&looks[first..=last]).max(1) as f64;
        let missed = in_view(&looks[last + 1..]) as f64;
        seen >= SEEN && missed * fastslam::ops::ln((1.0 - found).max(f64::MIN_POSITIVE)) < BY_CHANCE
    };
    if sensor.max_range > EVERYTHING { 0 } else { landmarks.filter(is_gone).count() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SENSOR: RangeBearing = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 6.0, field_of_view: 1.0 };

    /// Three landmarks ahead of a robot that stands; the k-th look sees the n-th of them where this says so.
    fn counted(sensor: &RangeBearing, sees: impl Fn(usize, u32) -> bool) -> usize {
        let at = |name: u32| Vector2::new(3.0, f64::from(name) - 1.0);
        let look = |k: usize| {
            let seen = (0..3).filter(|name| sees(k, *name));
            let feature = |name| Feature { z: sensor.predict(&Pose2::default(), &at(name)).z, signature: Some(name) };
            seen.map(feature).collect()
        };
        let sightings: Vec<Vec<Feature>> = (0..200).map(look).collect();
        gone(&[Pose2::default(); 201], &sightings, (0..3).map(|name| (name, at(name))), sensor)
    }

    /// Found in every third look by chance, and no more from half of the drive on.
    #[test]
    fn landmarks_that_are_not_seen_any_more_where_they_should_be_have_gone() {
        let by_chance = |k: usize, name: u32| (7 * k + 3 * name as usize).is_multiple_of(3) || name == 2;
        assert_eq!(counted(&SENSOR, by_chance), 0);
        assert_eq!(counted(&SENSOR, |k, name| by_chance(k, name) && (name == 2 || k < 100)), 2);
        assert_eq!(
            counted(&SENSOR, |k, name| by_chance(k, name) && (name == 2 || k < 185)),
            0,
            "fifteen looks say little"
        );
        let [near, everything] = [2.0, 1e6].map(|max_range| RangeBearing { max_range, ..SENSOR });
        for sensor in [near, everything] {
            assert_eq!(
                counted(&sensor, |k, name| name == 2 || k < 100),
                0,
                "what should be in view is out of it, or not known"
            );
        }
    }
}
