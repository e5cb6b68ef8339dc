//! Which part of the world the panels show: what the motion prior reaches, whatever was drawn of it.

use crate::scene::{Plane, Rect};
use fastslam_lab::experiment::proposal::{CONTROL, FROM};

/// Half of what is seen from the left to the right \[m\]: so much, and so much more for each unit of the odometry's scale. Not quite in
/// proportion, so that noisier wheels are seen to reach farther.
pub const HALF: [f64; 2] = [0.55, 0.35];

/// What is seen from top to bottom, over what is seen from left to right, at least.
const FLAT: f64 = 0.6;

/// Css px of half of what is seen from the left to the right.
pub fn half(view: &Rect) -> f64 {
    0.5 * view.w.min(view.h / FLAT)
}

/// The part of the world in a panel, around where the odometry says the robot is. Depends on the odometry's scale and on nothing else: it
/// stays where it is while another noise or the landmark is moved.
pub fn plane(view: &Rect, odometry_scale: f64) -> Plane {
    let mean = CONTROL.apply(&FROM);
    Plane::centred(*view, [mean.x, mean.y], half(view) / (HALF[0] + HALF[1] * odometry_scale))
}
