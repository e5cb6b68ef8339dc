//! Maps of landmarks: given the path, every landmark is an independent Gaussian of its own.
//!
//! p(m | x₁..ₜ, z₁..ₜ, c₁..ₜ) = ∏ⱼ p(mⱼ | x₁..ₜ, z₁..ₜ, c₁..ₜ): a sighting touches one mean of two numbers and one covariance of
//! four, whatever the number of landmarks. Nothing larger than 3 × 3 is ever inverted.
//!
//! References: Montemerlo, Thrun, Koller, Wegbreit, *FastSLAM* (AAAI 2002; IJCAI 2003); PR tables 13.1 to 13.3.

mod association;
mod landmark;
mod shared;
mod store;

pub use association::{Correspondence, Gate, Matched, Sighted};
pub use landmark::{Innovation, Landmark};
pub use shared::{Balanced, Blocks, Shared};
pub use store::Store;

use super::{ConditionalMap, Footprint};
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
    type Association = Vec<Sighted>;

    // anchor: assimilate
    /// A first sighting makes a landmark, every further one is a Kalman update of that landmark alone. Where landmarks may be
    /// struck off, those that should have been seen and were not lose evidence.
    fn assimilate(&mut self, world_from_robot: &Pose2, features: &Vec<Feature>, sighted: &Vec<Sighted>) {
        if let Correspondence::Unknown(Gate { removal: true, .. }) = self.correspondence {
            self.doubt(world_from_robot, sighted);
        }
        for (feature, sighted) in features.iter().zip(sighted) {
            match *sighted {
                Sighted::Again(index) => {
                    if let Some(landmark) = self.store.entry(index) {
                        landmark.update(&self.sensor, world_from_robot, &feature.z);
                    }
                }
                Sighted::First(index) => {
                    *self.store.entry(index) = Some(Landmark::first(&self.sensor, world_from_robot, &feature.z));
                }
                Sighted::Nothing => (),
            }
        }
    }
    // end: assimilate
}

impl<Z: LandmarkSensor, S: Store> Landmarks<Z, S> {
    /// Takes evidence from landmarks that are surely in view and were not sighted; without any left they are struck off. What
    /// was sighted gains evidence in its update.
    fn doubt(&mut self, world_from_robot: &Pose2, sighted: &[Sighted]) {
        for index in 0..self.store.len() {
            let Some(landmark) = self.store.get(index) else { continue };
            let missed = !sighted.contains(&Sighted::Again(index))
                && self.sensor.sees(world_from_robot, &landmark.mean, 3.0 * landmark.largest_std());
            if missed {
                let entry = self.store.entry(index);
                match entry {
                    Some(landmark) if landmark.evidence > 0 => landmark.evidence -= 1,
                    _ => *entry = None,
                }
            }
        }
    }
}
