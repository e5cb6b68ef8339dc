//! Poses of the plane and Gaussians over them.

mod chain;
mod gaussian;
mod pose;

pub(crate) use chain::{Chain, Relation};
pub use gaussian::{Gaussian3, sample_semidefinite};
pub(crate) use pose::driven;
pub use pose::{Pose2, align, rms};
