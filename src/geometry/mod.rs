//! Poses of the plane and Gaussians over them.

mod gaussian;
mod pose;

pub use gaussian::{Gaussian3, sample_semidefinite};
pub use pose::{Pose2, align, rms};
