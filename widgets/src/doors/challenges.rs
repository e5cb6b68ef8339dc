//! States of the corridor that are worth trying.

use super::model::DoorsModel;
use crate::{
    challenge::{Challenge, Verdict},
    decimal::fixed,
    words::doors as words,
};

/// So sure \[m\] a filter is that is to be fooled.
const SURE: f64 = 0.1;

pub(super) fn challenges() -> Vec<Challenge<DoorsModel>> {
    vec![
        Challenge::new("few", words::chip_few(), "particles=25"),
        Challenge::new("short", words::chip_short(), "ride=8").with(words::goal_short(), "ride", ekf_right),
        Challenge::new("uneven", words::chip_uneven(), "door-5=16"),
        Challenge::new("fool", words::chip_fool(), "end=9").with(words::goal_fool(), "end", fooled),
    ]
}

/// Whether EKF-SLAM ends at the robot with what it was told of the ride: the reader finds out how well that has to be known.
fn ekf_right(model: &DoorsModel) -> Verdict {
    let now = model.now();
    let said = words::ChipRide { std: &fixed(model.setup().ride_std, 2), off: &model.ekf_off().abs() }.say();
    Verdict::new(model.at_end() && now.ekf_right(), &[1.0 / (1.0 + f64::from(model.ekf_off().abs()))], said)
}

/// Whether EKF-SLAM ends sure of a wrong place, and the particles at the right one.
fn fooled(model: &DoorsModel) -> Verdict {
    let now = model.now();
    let said = words::ChipOff { off: &model.ekf_off().abs(), std: &fixed(100.0 * now.ekf_std, 0) }.say();
    let fooled = model.at_end() && !now.ekf_right() && now.ekf_std < SURE && now.fastslam_right();
    let wrong = if now.ekf_right() { 0.0 } else { 1.0 };
    Verdict::new(fooled, &[wrong, SURE / now.ekf_std], said)
}
