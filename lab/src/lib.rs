#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! [`world`] is the truth, which a filter of [`fastslam`] never sees. [`baseline`] has what a particle filter only approximates, computed
//! without particles. [`experiment`] lets filters run in these worlds and compares them with the truth: every figure and every measured
//! number of the chapter is one of them. [`digest`] is the fingerprint by which a native run and one in a browser are found to be the same.

pub mod baseline;
pub mod digest;
pub mod experiment;
pub mod world;

use fastslam::random::Purpose;

/// Noise of the odometry that a world hands to a filter.
pub const WORLD_ODOMETRY: Purpose = Purpose::new(1);

/// Noise of the measurements that a world hands to a filter.
pub const WORLD_SENSOR: Purpose = Purpose::new(2);
