//! Maps given a path: what every particle keeps for itself.

pub mod grid;

use crate::geometry::Pose2;

/// A map posterior that has a closed form once the path is given: the *conditional* of Rao and Blackwell.
///
/// `Clone` is what a resampling does, so it must cost O(1): implementations share what they hold and copy on writing.
pub trait ConditionalMap: Clone + Send + Sync {
    /// What one step of the sensor yields, in the robot's frame.
    type Observation: Sync;

    /// p(m | x₁..ₜ, z₁..ₜ₋₁) → p(m | x₁..ₜ, z₁..ₜ) for an observation taken at `world_from_robot`.
    fn assimilate(&mut self, world_from_robot: &Pose2, observation: &Self::Observation);
}
