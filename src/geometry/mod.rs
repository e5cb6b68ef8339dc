//! Poses of the plane and Gaussians over them.

mod gaussian;
mod pose;

pub use gaussian::Gaussian3;
pub use pose::{Pose2, align};
