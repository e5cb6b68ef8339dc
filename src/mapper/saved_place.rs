//! A scan and where it was taken, to be saved. Of its ranges, which may be infinite or none, the bits.

use crate::geometry::Pose2;
use crate::sensor::LaserScan;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// See [`LaserScan`].
#[derive(Serialize, Deserialize)]
struct SavedScan {
    time: f64,
    odometry: Pose2,
    robot_from_laser: Pose2,
    angles: [f64; 2],
    /// None of one that is not finite.
    max_range: Option<f64>,
    ranges: Vec<u32>,
}

type Place = Option<(Pose2, LaserScan)>;

pub fn serialize<S: Serializer>(place: &Place, serializer: S) -> Result<S::Ok, S::Error> {
    let saved = |(pose, scan): &(Pose2, LaserScan)| {
        let LaserScan { time, odometry, robot_from_laser, first_angle, angle_step, max_range, ranges } = scan;
        let scan = SavedScan {
            time: *time,
            odometry: *odometry,
            robot_from_laser: *robot_from_laser,
            angles: [*first_angle, *angle_step],
            max_range: max_range.filter(|range| range.is_finite()),
            ranges: ranges.iter().map(|range| range.to_bits()).collect(),
        };
        (*pose, scan)
    };
    place.as_ref().map(saved).serialize(serializer)
}

pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Place, D::Error> {
    let place = Option::<(Pose2, SavedScan)>::deserialize(deserializer)?;
    Ok(place.map(|(pose, saved)| {
        let SavedScan { time, odometry, robot_from_laser, angles: [first_angle, angle_step], max_range, ranges } =
            saved;
        let ranges = ranges.into_iter().map(f32::from_bits).collect();
        (pose, LaserScan { time, odometry, robot_from_laser, first_angle, angle_step, max_range, ranges })
    }))
}
