//! Maps of landmarks: given the path, every landmark is an independent Gaussian of its own.
//!
//! p(m | x₁..ₜ, z₁..ₜ, c₁..ₜ) = ∏ⱼ p(mⱼ | x₁..ₜ, z₁..ₜ, c₁..ₜ): a sighting touches one mean of two numbers and one covariance of
//! four, whatever the number of landmarks. Nothing larger than 3 × 3 is ever inverted.
//!
//! References: Montemerlo, Thrun, Koller, Wegbreit, *FastSLAM* (AAAI 2002; IJCAI 2003); PR tables 13.1 to 13.3.

mod ahead;
mod assignment;
mod association;
mod landmark;
#[cfg(feature = "serde")]
mod saved;
mod shared;
mod store;

use association::has_possible_signature;
pub use association::{Associated, Association, Belief, Correspondence, Gate};
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
///
/// # Landmarks that coincide
/// Without signatures a landmark that is met again from a pose that has drifted is founded a second time. Where
/// [`Gate::merge_squared`] is above 0, a landmark that was just sighted is merged with any other that
/// - coincides with it by that gate,
/// - was not sighted in the same step, and
/// - was never sighted in one step with it while both were within the gate of each other: one look gives no landmark two features, so
///   they are two.
///
/// What remains is the product of both estimates ([`Landmark::merged`]) under the lower index. Each particle does so in its own map.
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

    /// One past the largest index in use.
    pub(crate) fn len(&self) -> u32 {
        self.store.len()
    }

    /// All landmarks with their indices, in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &Landmark)> {
        self.store.iter()
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
    type Observation = [Feature];
    type Association = Vec<Association>;

    /// A first sighting makes a landmark, every further one is a Kalman update of that landmark alone. Where landmarks may be
    /// struck off, those that should have been seen and were not lose existence count.
    fn assimilate(&mut self, world_from_robot: &Pose2, features: &[Feature], associations: &Vec<Association>) {
        let gate = match self.correspondence {
            Correspondence::Unknown(gate) => gate,
            Correspondence::Known => Gate::default(),
        };
        if gate.removal {
            self.apply_negative_information(world_from_robot, associations);
        }
        for (feature, association) in features.iter().zip(associations) {
            match *association {
                Association::Matched(index) => {
                    if let Some(landmark) = self.store.entry(index) {
                        let before = landmark.existence_count;
                        landmark.update(&self.sensor, world_from_robot, &feature.z);
                        if landmark.existence_count > before {
                            landmark.existence_count = gate.counted(landmark.existence_count);
                        }
                    }
                }
                Association::New(index) => {
                    let first = Landmark::first(&self.sensor, world_from_robot, &feature.z);
                    *self.store.entry(index) =
                        Some(Landmark { existence_count: gate.counted(first.existence_count), ..first });
                }
                Association::Ignored => (),
            }
        }
        if gate.merge_squared > 0.0 {
            self.merge_coinciding(&gate, associations);
        }
    }

    /// Features that are impossible: of a z that the sensor cannot have measured ([`LandmarkSensor::can_measure`]), or of the signature
    /// 2³² − 1.
    fn ignored(&self, features: &[Feature]) -> u32 {
        let is_possible = |f: &&Feature| has_possible_signature(f) && self.sensor.can_measure(&f.z);
        (features.len() - features.iter().filter(is_possible).count()) as u32
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
    /// Merges what was sighted with what coincides with it: see [the type](Self#landmarks-that-coincide).
    fn merge_coinciding(&mut self, gate: &Gate, associations: &[Association]) {
        // By index: the order in which features are listed decides nothing.
        let mut sighted: Vec<u32> = Vec::with_capacity(associations.len());
        for association in associations {
            if let Association::Matched(index) | Association::New(index) = *association {
                sighted.insert(sighted.partition_point(|known| *known < index), index);
            }
        }
        for (k, &a) in sighted.iter().enumerate() {
            for &b in &sighted[..k] {
                if let (Some(one), Some(other)) = (self.store.get(a), self.store.get(b))
                    && one.distance_squared(other) < gate.merge_squared
                    && !(one.is_apart_from(b) && other.is_apart_from(a))
                {
                    self.set_apart(a, b);
                    self.set_apart(b, a);
                }
            }
        }
        for mut index in sighted {
            for other in 0..self.store.len() {
                let (Some(one), Some(two)) = (self.store.get(index), self.store.get(other)) else { continue };
                let another = other != index
                    && !associations.contains(&Association::Matched(other))
                    && !associations.contains(&Association::New(other));
                if another
                    && one.distance_squared(two) < gate.merge_squared
                    && !one.is_apart_from(other)
                    && !two.is_apart_from(index)
                {
                    let mut merged = one.merged(two);
                    merged.existence_count = merged.existence_count.min(gate.most_count as i32);
                    let (kept, gone) = (index.min(other), index.max(other));
                    *self.store.entry(kept) = Some(merged);
                    *self.store.entry(gone) = None;
                    index = kept;
                }
            }
        }
    }

    fn set_apart(&mut self, of: u32, from: u32) {
        if let Some(landmark) = self.store.entry(of) {
            landmark.apart |= 1 << (from % u32::BITS);
        }
    }
}
