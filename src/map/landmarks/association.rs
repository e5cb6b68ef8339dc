//! Which landmark a sighting is of. Every particle decides for itself, and lives or dies by it.

use super::assignment::{Candidate, assign};
use super::{Innovation, Landmarks, Store};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::ops;
use crate::order::sorted;
use crate::sensor::{Feature, LandmarkSensor, Prediction};
use core::cmp::Ordering;
use nalgebra::{Matrix3, Vector2};
use std::collections::BTreeMap;

/// How sightings are told apart.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Correspondence {
    /// By the signature that each feature brings; a feature without one is ignored, and so is all but the first of one signature in a
    /// step, in the order of z.
    Known,
    /// By maximum likelihood.
    Unknown(Gate),
}

/// Settings of the maximum-likelihood association.
///
/// A feature may be of any landmark with νᵀ S⁻¹ ν within the gate and π = N(ν; 0, S) above p₀, or a new landmark, of the weight p₀ (PR
/// tables 13.2 and 13.3).
///
/// No landmark is given two features of one step, and the features of a step are assigned together: the product of all π and p₀ is the
/// largest that a one-to-one assignment has. Where the pose learns from each feature, as in FastSLAM 2.0, the most certain pair goes
/// first, and the others are assigned anew by what it has told.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gate {
    /// Largest νᵀ S⁻¹ ν: a quantile of χ² with two degrees of freedom.
    pub mahalanobis_squared: f64,
    /// ln p₀: log-density of a sighting \[nats, per unit of z\] below which a new landmark explains it better.
    pub log_new: f64,
    /// Whether landmarks that should have been seen and were not lose existence count, and are struck off without any.
    pub removal: bool,
    /// With `removal`: how many misses one sighting pays for, 1 or more. A sensor that sees a landmark in its view with the
    /// probability p strikes off what is there where this is below (1 − p) / p, and should be told clearly more.
    pub sighting_worth: u32,
    /// With `removal`: the most existence count that a landmark may have, so that what has gone away (a parked robot) is struck off after
    /// as many misses, however long it stood. At least `sighting_worth`.
    pub most_count: u32,
    /// Largest Δᵀ (Σ_a + Σ_b)⁻¹ Δ of two landmarks of one map that are taken for one, Δ the difference of their means: a quantile
    /// of χ² with two degrees of freedom. 0: none are. See [`Landmarks`](super::Landmarks#landmarks-that-coincide).
    pub merge_squared: f64,
}

impl Default for Gate {
    /// χ²₂,₀.₉₉ = −2 ln 0.01; p₀ = 10⁻³ per metre and radian; no removal, where a sighting would pay for one miss and counts be
    /// without a bound; no merging.
    fn default() -> Self {
        Self {
            mahalanobis_squared: -2.0 * ops::ln(0.01),
            log_new: ops::ln(1e-3),
            removal: false,
            sighting_worth: 1,
            most_count: i32::MAX as u32,
            merge_squared: 0.0,
        }
    }
}

/// Most misses that a sighting can pay for.
const WORTH: u32 = 1000;

impl Gate {
    /// Whether all settings are in range.
    ///
    /// # Errors
    /// Where a gate is not a number of 0 or more, ln p₀ is not finite, a sighting is worth nothing, or the most that may be counted is
    /// less than what one is worth.
    pub fn validate(&self) -> Result<(), SettingError> {
        Range::at_least(0.0, "").check("gate.mahalanobis_squared", self.mahalanobis_squared)?;
        Range::finite("nats").check("gate.log_new", self.log_new)?;
        Range::whole(1, WORTH).check("gate.sighting_worth", f64::from(self.sighting_worth))?;
        Range::whole(self.sighting_worth, i32::MAX as u32).check("gate.most_count", f64::from(self.most_count))?;
        Range::at_least(0.0, "").check("gate.merge_squared", self.merge_squared).map(drop)
    }

    /// What a landmark's existence count is after a sighting that has just raised it by one, or to one.
    pub fn counted(&self, count: i32) -> i32 {
        if !self.removal {
            return count;
        }
        count.saturating_add(self.sighting_worth as i32 - 1).min(self.most_count as i32)
    }
}

/// What a feature is taken to be.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Association {
    /// The landmark of this index, seen before.
    Matched(u32),
    /// A landmark seen for the first time, to get this index.
    New(u32),
    /// Not to be used: impossible as a measurement, without a signature where that is needed, or a second feature of one signature.
    Ignored,
}

/// The features of a step with the landmarks that they are taken to be of.
#[derive(Clone, PartialEq, Debug)]
pub struct Associated {
    /// What each feature is taken to be, in the order in which the features are listed.
    pub associations: Vec<Association>,
    /// ln p(z) of all features under these decisions \[nats\], of which each new landmark has ln p₀, or 0 where it has a name.
    pub log_likelihood: f64,
    /// Whether any feature is of a landmark in the map, and says something: see [`Innovation::is_regular`].
    pub informed: bool,
}

/// What a step's features are told apart by: a belief about the robot's pose and the landmarks, which may learn from one feature before it is
/// asked about the next.
pub trait Belief {
    /// Whether [`Self::learn`] changes anything. Where it does not, one look at all features is enough.
    fn learns(&self) -> bool;

    /// [`LandmarkSensor::can_measure`] of what measures the features.
    fn can_measure(&self, z: &Vector2<f64>) -> bool;

    /// One past the largest index of a landmark.
    fn index_bound(&self) -> u32;

    /// What a feature says of the landmark of an index; `None` where there is none, or where it surely lies beyond the gate that is asked
    /// for.
    fn innovation(&self, feature: &Feature, index: u32, gate: Option<f64>) -> Option<Innovation>;

    /// Takes in that a feature, of this innovation, is of the landmark of an index.
    fn learn(&mut self, index: u32, innovation: &Innovation);
}

impl Correspondence {
    /// Decides what the features of a step are, all together, and has the belief learn from each that is of a known landmark.
    ///
    /// The order in which they are listed decides nothing: they are looked at in the order of z and signature. What cannot be measured is
    /// ignored.
    ///
    /// A feature that can say nothing (S has no inverse) says nothing: by its signature it is of its landmark and changes neither pose,
    /// landmark nor weight; without one it is of no landmark in the map, since there is no likelihood to choose by.
    pub fn associate(&self, features: &[Feature], belief: &mut dyn Belief) -> Associated {
        let mut associated = Associated {
            associations: vec![Association::Ignored; features.len()],
            log_likelihood: 0.0,
            informed: false,
        };
        let order = in_order(features, |z| belief.can_measure(z));
        match self {
            Self::Known => associated.by_signature(features, &order, belief),
            Self::Unknown(gate) => associated.by_likelihood(gate, features, order, belief),
        }
        associated
    }
}

/// Whether a feature can have this signature, if any: the largest would leave no index for the next landmark.
pub(super) fn has_possible_signature(feature: &Feature) -> bool {
    feature.signature != Some(u32::MAX)
}

/// z number by number, and then the signature: features that are sorted so are the same sequence in whatever order they are listed.
fn canonical(a: &Feature, b: &Feature) -> Ordering {
    let by_z = a.z.x.total_cmp(&b.z.x).then(a.z.y.total_cmp(&b.z.y));
    by_z.then(a.signature.cmp(&b.signature))
}

/// Indices of the possible measurements, in an order that does not depend on how they are listed.
fn in_order(features: &[Feature], can_measure: impl Fn(&Vector2<f64>) -> bool) -> Vec<usize> {
    let is_possible = |feature: &Feature| has_possible_signature(feature) && can_measure(&feature.z);
    let possible = (0..features.len()).filter(|k| is_possible(&features[*k])).collect();
    sorted(possible, |a, b| canonical(&features[*a], &features[*b]))
}

/// Indices of the measurements with a signature, the first of each signature, and their landmarks.
fn by_name(features: &[Feature], order: &[usize]) -> Vec<(usize, u32)> {
    let mut named: Vec<(usize, u32)> = Vec::with_capacity(order.len());
    for &k in order {
        let index = features[k].signature.filter(|index| named.iter().all(|(_, taken)| taken != index));
        named.extend(index.map(|index| (k, index)));
    }
    named
}

/// Measurements that update a map with [`Correspondence::Known`], in their order: index and landmark of each.
pub(super) fn known(features: &[Feature], sensor: &impl LandmarkSensor) -> Vec<(usize, u32)> {
    by_name(features, &in_order(features, |z| sensor.can_measure(z)))
}

impl Associated {
    /// The new landmarks by index, each with the number of its feature.
    pub fn founded(&self) -> BTreeMap<u32, usize> {
        let new = |(k, association): (usize, &Association)| match association {
            Association::New(index) => Some((*index, k)),
            Association::Matched(_) | Association::Ignored => None,
        };
        // Not `collect`, which sorts before: another sort.
        let mut founded = BTreeMap::new();
        founded.extend(self.associations.iter().enumerate().filter_map(new));
        founded
    }

    /// Each feature by its signature; the second of one signature is ignored.
    fn by_signature(&mut self, features: &[Feature], order: &[usize], belief: &mut dyn Belief) {
        for (k, index) in by_name(features, order) {
            match belief.innovation(&features[k], index, None) {
                Some(innovation) if innovation.is_regular() => {
                    self.accept(k, index, innovation.log_likelihood());
                    belief.learn(index, &innovation);
                }
                Some(_) => self.associations[k] = Association::Matched(index),
                None => self.associations[k] = Association::New(index),
            }
        }
    }

    /// Round by round: of all features that are left and all landmarks that are free, the one-to-one assignment of the largest likelihood.
    ///
    /// The pairs that nothing competes with go first, and what the belief learns from them decides between the others, of which the most
    /// certain goes first. What no landmark explains better than p₀ in the end is new.
    ///
    /// A function of its own in programs as well, so that scripts/unasked.mjs can leave it out of one whose landmarks all have names.
    #[inline(never)]
    fn by_likelihood(&mut self, gate: &Gate, features: &[Feature], order: Vec<usize>, belief: &mut dyn Belief) {
        let len = belief.index_bound();
        let (mut left, mut taken) = (order, Vec::new());
        loop {
            let pairs = ranked(&candidates(gate, features, &left, &taken, belief));
            let accepted = if belief.learns() { acceptable(&pairs, !taken.is_empty()) } else { pairs.len() };
            let mut learnt = false;
            for Pair { chosen: Candidate { feature, landmark, log_likelihood, .. }, .. } in &pairs[..accepted] {
                if !belief.learns() {
                    self.accept(*feature, *landmark, *log_likelihood);
                } else if let Some(innovation) = gate.admits(belief, &features[*feature], *landmark) {
                    self.accept(*feature, *landmark, innovation.log_likelihood());
                    belief.learn(*landmark, &innovation);
                    taken.push(*landmark);
                    learnt = true;
                }
            }
            left.retain(|k| self.associations[*k] == Association::Ignored);
            if !learnt {
                break;
            }
        }
        for (k, index) in left.into_iter().zip(len..) {
            self.associations[k] = Association::New(index);
            self.log_likelihood += gate.log_new;
        }
    }

    fn accept(&mut self, feature: usize, index: u32, log_likelihood: f64) {
        self.associations[feature] = Association::Matched(index);
        self.log_likelihood += log_likelihood;
        self.informed = true;
    }
}

impl Gate {
    /// What a feature says of a landmark, where that is within the gate and likelier than a new landmark.
    fn admits(&self, belief: &dyn Belief, feature: &Feature, index: u32) -> Option<Innovation> {
        let innovation = belief.innovation(feature, index, Some(self.mahalanobis_squared))?;
        let within = innovation.mahalanobis_squared < self.mahalanobis_squared;
        (innovation.is_regular() && within && innovation.log_likelihood() > self.log_new).then_some(innovation)
    }
}

/// All that the features that are left may be of, feature by feature.
fn candidates(gate: &Gate, features: &[Feature], left: &[usize], taken: &[u32], belief: &dyn Belief) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    for &feature in left {
        for landmark in (0..belief.index_bound()).filter(|index| !taken.contains(index)) {
            if let Some(innovation) = gate.admits(belief, &features[feature], landmark) {
                let log_likelihood = innovation.log_likelihood();
                candidates.push(Candidate { feature, landmark, gain: 0.0, log_likelihood });
            }
        }
    }
    let log_new = felt(gate.log_new, &candidates);
    candidates.iter_mut().for_each(|candidate| candidate.gain = candidate.log_likelihood - log_new);
    candidates
}

/// ln p₀ \[nats\], but no lower than where one new landmark less outweighs all else: below that nothing would be decided otherwise, and a p₀
/// of next to nothing would leave no digits for the likelihoods.
fn felt(log_new: f64, candidates: &[Candidate]) -> f64 {
    let all = || candidates.iter().map(|candidate| candidate.log_likelihood);
    let (least, most) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    if candidates.is_empty() { log_new } else { log_new.max(least - candidates.len() as f64 * (most - least) - 1.0) }
}

/// A pair of the best assignment.
struct Pair {
    chosen: Candidate,
    /// Whether the feature has another candidate, or the landmark another feature.
    is_contested: bool,
    /// How much likelier it is than the next best use of its feature or its landmark \[nats\].
    margin: f64,
}

/// The best assignment: pairs that nothing competes with, in the order of the features, then the others, the most certain first.
fn ranked(candidates: &[Candidate]) -> Vec<Pair> {
    let judged = |chosen: Candidate| {
        let competes = |other: &&Candidate| (other.feature == chosen.feature) != (other.landmark == chosen.landmark);
        let next = candidates.iter().filter(competes).map(|other| other.gain).fold(f64::NEG_INFINITY, f64::max);
        Pair { chosen, is_contested: next > f64::NEG_INFINITY, margin: chosen.gain - next }
    };
    let first = |a: &Pair, b: &Pair| a.is_contested.cmp(&b.is_contested).then(b.margin.total_cmp(&a.margin));
    sorted(assign(candidates).into_iter().map(judged).collect(), first)
}

/// How many of these pairs are to be accepted before the others are asked about again: those that nothing competes with. Without any, one,
/// if the belief has learnt nothing yet; else all, since it will hardly learn more.
fn acceptable(pairs: &[Pair], has_learnt: bool) -> usize {
    match pairs.iter().filter(|pair| !pair.is_contested).count() {
        0 if has_learnt => pairs.len(),
        0 => pairs.len().min(1),
        free => free,
    }
}

/// A pose of this mean and covariance P (3 × 3), and a map, neither of which learns.
struct Given<'a, Z, S> {
    map: &'a Landmarks<Z, S>,
    pose: &'a Pose2,
    p: &'a Matrix3<f64>,
}

impl<Z: LandmarkSensor, S: Store> Belief for Given<'_, Z, S> {
    fn learns(&self) -> bool {
        false
    }

    fn can_measure(&self, z: &Vector2<f64>) -> bool {
        self.map.sensor.can_measure(z)
    }

    fn index_bound(&self) -> u32 {
        self.map.len()
    }

    fn innovation(&self, feature: &Feature, index: u32, gate: Option<f64>) -> Option<Innovation> {
        self.map.innovation(self.pose, self.p, feature, index, gate)
    }

    fn learn(&mut self, _: u32, _: &Innovation) {}
}

impl<Z: LandmarkSensor, S: Store> Landmarks<Z, S> {
    /// Decides what the features of a step are, for a pose of this mean and covariance P (3 × 3; zeros for a pose that is known).
    pub fn associate(&self, pose: &Pose2, p: &Matrix3<f64>, features: &[Feature]) -> Associated {
        self.correspondence.associate(features, &mut Given { map: self, pose, p })
    }

    /// What a feature says of the landmark of an index, for such a pose; `None` where there is none, or where it surely lies beyond the gate.
    pub(crate) fn innovation(
        &self,
        pose: &Pose2,
        p: &Matrix3<f64>,
        feature: &Feature,
        index: u32,
        gate: Option<f64>,
    ) -> Option<Innovation> {
        let landmark = self.get(index)?;
        let spread = landmark.covariance + p.fixed_view::<2, 2>(0, 0);
        let least = || self.sensor.least_mahalanobis_squared(pose, &landmark.mean, &spread, &feature.z);
        let beyond = gate.is_some_and(|gate| least() >= gate);
        (!beyond).then(|| {
            let of_pose = |prediction: &Prediction| prediction.h_x * p * prediction.h_x.transpose();
            landmark.innovation_with(&self.sensor, pose, &feature.z, of_pose)
        })
    }
}
