//! Sensors: what a measurement looks like in the robot's frame.

mod beam;

pub use beam::{BeamSensor, Scan};
