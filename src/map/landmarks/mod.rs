//! Maps of landmarks: given the path, every landmark is an independent Gaussian of its own.
//!
//! p(m | x₁..ₜ, z₁..ₜ, c₁..ₜ) = ∏ⱼ p(mⱼ | x₁..ₜ, z₁..ₜ, c₁..ₜ): a sighting touches one mean of two numbers and one covariance of
//! four, whatever the number of landmarks. Nothing larger than 3 × 3 is ever inverted.
//!
//! References: Montemerlo, Thrun, Koller, Wegbreit, *FastSLAM* (AAAI 2002; IJCAI 2003); PR tables 13.1 to 13.3.

mod association;
mod landmark;
#[cfg(feature = "serde")]
mod saved;
mod shared;
mod store;

pub use association::{Association, Correspondence, Decision, Gate};
pub use landmark::{Innovation, Landmark};
#[cfg(feature = "serde")]
pub use saved::{SavedLandmarks, SavedTrees};
pub use shared::{Balanced, Blocks, Shared};
pub use store::Store;

use super::{ConditionalMap, Footprint};
use crate::error::SettingError;
use crate::geometry::Pose2;
use crate::sensor::{Feature, LandmarkSensor};

/// The landmarks of one particle, seen by a sensor Z and kept in a store S.
#[derive(Clone, PartialEq, Debug)]
pub struct Landmarks<Z, S = Blocks> {
    sensor: Z,
    correspondence: Correspondence,
    store: S,
}

impl<Z: LandmarkSensor, S: Store> Landmarks<Z, S> {
    /// An empty map.
    pub fn new(sensor: Z, correspondence: Correspondence) -> Self {
        Self { sensor, correspondence, store: S::default() }
    }

    /// The same map with these landmarks in it, from index 0 on: for a map that is known in part, or made for an experiment.
    pub fn with(mut self, landmarks: impl IntoIterator<Item = Landmark>) -> Self {
        for (index, landmark) in (0..).zip(landmarks) {
            *self.store.entry(index) = Some(landmark);
        }
        self
    }

    /// What sees the landmarks.
    pub fn sensor(&self) -> &Z {
        &self.sensor
    }

    /// How sightings are told apart.
    pub fn correspondence(&self) -> &Correspondence {
        &self.correspondence
    }

    /// The landmark of this index; `None` where there is none yet, or none any more.
    pub fn get(&self, index: u32) -> Option<&Landmark> {
        self.store.get(index)
    }

    /// All landmarks with their indices, in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &Landmark)> {
        (0..self.store.len()).filter_map(|index| Some((index, self.store.get(index)?)))
    }

    /// Memory of these maps.
    pub fn footprint<'a>(maps: impl IntoIterator<Item = &'a Self>) -> Footprint
    where
        Self: 'a,
    {
        S::footprint(maps.into_iter().map(|map| &map.store))
    }
}

impl<Z: LandmarkSensor, S: Store> ConditionalMap for Landmarks<Z, S> {
    type Observation = Vec<Feature>;
    type Association = Vec<Association>;

    /// A first sighting makes a landmark, every further one is a Kalman update of that landmark alone. Where landmarks may be
    /// struck off, those that should have been seen and were not lose existence count.
    fn assimilate(&mut self, world_from_robot: &Pose2, features: &Vec<Feature>, associations: &Vec<Association>) {
        if let Correspondence::Unknown(Gate { removal: true, .. }) = self.correspondence {
            self.apply_negative_information(world_from_robot, associations);
        }
        for (feature, association) in features.iter().zip(associations) {
            match *association {
                Association::Matched(index) => {
                    if let Some(landmark) = self.store.entry(index) {
                        landmark.update(&self.sensor, world_from_robot, &feature.z);
                    }
                }
                Association::New(index) => {
                    *self.store.entry(index) = Some(Landmark::first(&self.sensor, world_from_robot, &feature.z));
                }
                Association::Ignored => (),
            }
        }
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.sensor.validate()?;
        match &self.correspondence {
            Correspondence::Known => Ok(()),
            Correspondence::Unknown(gate) => gate.validate(),
        }
    }
}

impl<Z: LandmarkSensor, S: Store> Landmarks<Z, S> {
    /// Takes existence count from landmarks that are surely in view and were not sighted; without any left they are struck off. What
    /// was sighted gains existence count in its update.
    fn apply_negative_information(&mut self, world_from_robot: &Pose2, associations: &[Association]) {
        for index in 0..self.store.len() {
            let Some(landmark) = self.store.get(index) else { continue };
            let missed = !associations.contains(&Association::Matched(index))
                && self.sensor.sees(world_from_robot, &landmark.mean, 3.0 * landmark.largest_std());
            if missed {
                let entry = self.store.entry(index);
                match entry {
                    Some(landmark) if landmark.existence_count > 0 => landmark.existence_count -= 1,
                    _ => *entry = None,
                }
            }
        }
    }
}
