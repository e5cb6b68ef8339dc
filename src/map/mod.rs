//! Maps given a path: what every particle keeps for itself.

pub mod grid;
pub mod landmarks;

use crate::error::SettingError;
use crate::geometry::Pose2;

/// A map posterior that has a closed form once the path is given: the *conditional* of Rao and Blackwell.
///
/// `Clone` is what a resampling does, so it must cost O(1): implementations share what they hold and copy on writing.
pub trait ConditionalMap: Clone + Send + Sync {
    /// What one step of the sensor yields, in the robot's frame; of several parts, a slice.
    type Observation: ?Sized + ToOwned<Owned: Sync> + Sync;

    /// What each part of an observation is taken to be of; nothing where the place alone decides, as in a grid.
    type Association: Send;

    /// p(m | x₁..ₜ, z₁..ₜ₋₁) → p(m | x₁..ₜ, z₁..ₜ) for an observation taken at `world_from_robot`.
    fn assimilate(
        &mut self,
        world_from_robot: &Pose2,
        observation: &Self::Observation,
        association: &Self::Association,
    );

    /// How many parts of an observation cannot have been measured, and are ignored by every particle. As given here, none.
    fn ignored(&self, observation: &Self::Observation) -> u32 {
        let _ = observation;
        0
    }

    /// Whether all settings are in range: asked once, when a filter is built.
    ///
    /// # Errors
    /// Where one is not. As given here there are none.
    fn validate(&self) -> Result<(), SettingError> {
        Ok(())
    }
}

/// An observation as a log holds it: a vector, where it is a slice.
pub type Observed<M> = <<M as ConditionalMap>::Observation as ToOwned>::Owned;

/// Bytes that many maps take.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Footprint {
    /// Shared parts counted once.
    pub unique: u64,
    /// If each map were kept whole and apart.
    pub dense: u64,
}
