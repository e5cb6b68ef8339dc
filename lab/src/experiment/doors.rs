//! Six identical doors: what it is worth that every particle decides for itself which one it sees.
//!
//! A robot maps a corridor of doors that look alike and of one sign at its end. Then it is carried back with its eyes closed, and
//! told where to with a standard deviation of more than the distance of two doors. It drives to the sign again. Until it gets there,
//! an explanation that is off by a door foretells every sighting as well as the truth does.
//!
//! Everything but the association is linear and Gaussian: the sensor reports offsets, the heading is known, and the true place after
//! the ride is drawn from the very Gaussian that both filters are told. With the right associations EKF-SLAM would be the Kalman
//! filter, and exact. Where it goes wrong it has decided wrongly.
//!
//! [`Doors`] is one such run, a step at a time; [`outcomes`] are what many of them come to.

mod corridor;

use super::ProposalKind;
use crate::baseline::EkfSlam;
use corridor::{Corridor, Log, Offset};
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Association, Correspondence, Gate, Landmarks};
use fastslam::ops;
use fastslam::proposal::{Either, FromMeasurement, FromMotion, Marginal};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;

/// Number of doors, unless others are given.
pub const DOORS: u32 = 6;

/// The most doors that a corridor can have.
pub const MOST_DOORS: usize = 7;

/// From one door to the next \[m\]; the first is so far from the start.
pub const SPACING: f64 = 3.0;

/// Where the sign hangs \[m\]: two thirds of the way to where a seventh door would be, so that no explanation has a door there.
pub const SIGN: f64 = SPACING * (DOORS as f64 + 2.0 / 3.0);

/// Standard deviation of where the ride ends, as both filters are told \[m\].
pub const RIDE_STD: f64 = 4.0;

/// Where the ride is to end \[m\]: the middle of the corridor.
pub const RIDE_END: f64 = 9.0;

/// Where it may truly end \[m\]: in the corridor, with at least one door before the sign. Other draws are drawn again; one in twenty.
pub const RIDE_RANGE: core::ops::Range<f64> = 1.0..17.0;

/// How far along the corridor the sensor sees \[m\].
pub const REACH: f64 = Offset::REACH;

/// A filter that ends so near the truth \[m\] is right: the next explanation is a whole spacing away.
pub const RIGHT_WITHIN: f64 = 1.0;

/// An explanation with less than this share of the weight is given up.
pub const HELD: f64 = 0.01;

/// Explanations are told apart up to so many doors from the truth, on either side.
pub const FARTHEST: i32 = DOORS as i32;

/// Within so much of a landmark \[m\], what a filter takes a sighting for is that landmark.
const SAME: f64 = 0.5;

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct DoorsSetup {
    /// Seed of the world and of the filter.
    pub seed: u64,
    /// Number of particles M, 1 to 100 000.
    pub particles: usize,
    /// When to resample.
    pub policy: ResamplePolicy,
    /// FastSLAM 1.0 (the motion prior) or 2.0 (the measurement-aware proposal).
    pub proposal: ProposalKind,
    /// Standard deviation of where the ride ends \[m\], as both filters are told, 0 to 20.
    pub ride_std: f64,
    /// Where the ride truly ends \[m\], in [`RIDE_RANGE`]; `None` draws it from what the filters are told.
    pub end: Option<f64>,
    /// Standard deviation of the sensor \[m\], 0.01 to 1.
    pub sensor_std: f64,
    /// The gate and the price of a new landmark, of both filters.
    pub gate: Gate,
    /// Where the doors are \[m\], one to [`MOST_DOORS`] of them, from 0 to 30.
    pub doors: Vec<f64>,
}

impl Default for DoorsSetup {
    fn default() -> Self {
        Self {
            seed: 1,
            particles: 100,
            policy: ResamplePolicy::EssBelow(0.5),
            proposal: ProposalKind::Motion,
            ride_std: RIDE_STD,
            end: None,
            sensor_std: 0.1,
            gate: Gate::default(),
            doors: (0..DOORS).map(|door| SPACING * f64::from(door + 1)).collect(),
        }
    }
}

impl DoorsSetup {
    fn validate(&self) -> Result<(), SettingError> {
        Range::whole(1, 100_000).check("particles", self.particles as f64)?;
        Range::number(0.0, 20.0, "m").check("ride_std", self.ride_std)?;
        if let Some(end) = self.end {
            Range::number(RIDE_RANGE.start, RIDE_RANGE.end, "m").check("end", end)?;
        }
        Range::number(0.01, 1.0, "m").check("sensor_std", self.sensor_std)?;
        Range::whole(1, MOST_DOORS as u32).check("doors", self.doors.len() as f64)?;
        for door in &self.doors {
            Range::number(0.0, 30.0, "m").check("doors", *door)?;
        }
        self.gate.validate()?;
        self.policy.validate()
    }

    /// Distance of two neighbouring doors in the mean \[m\]: what *off by a door* is.
    pub fn spacing(&self) -> f64 {
        let [first, last] =
            [f64::min, f64::max].map(|pick| self.doors.iter().copied().reduce(pick).unwrap_or_default());
        let spacing = (last - first) / (self.doors.len() as f64 - 1.0);
        if spacing > 0.0 && spacing.is_finite() { spacing } else { SPACING }
    }

    /// How many doors a place is from the truth \[m\]: forwards, or with a minus backwards.
    pub fn off(&self, place: f64, truth: f64) -> i32 {
        ((place - truth) / self.spacing()).round() as i32
    }

    /// How many steps the drive takes.
    pub fn step_count(&self) -> u32 {
        Log::new(self).controls.len() as u32
    }

    /// How often the likeliest door is the right one: that the ride ended less than half a spacing from where it was to end,
    /// 2 Φ(s / 2σ) − 1 for a spacing s. Whatever is drawn again because it is out of the corridor is not counted in.
    pub fn pencil(&self) -> f64 {
        ops::erf(0.5 * self.spacing() / (self.ride_std * core::f64::consts::SQRT_2))
    }
}

/// What a filter takes the landmark in view for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Belief {
    /// Nothing has been in view.
    Nothing,
    /// The landmark of this rank: a door, or behind the doors the sign.
    Landmark(u32),
    /// One that it had not mapped before the ride.
    New,
}

/// Both filters after one step.
#[derive(Clone, PartialEq, Debug)]
pub struct DoorsReport {
    /// The step, from 0 (the start) on.
    pub step: u32,
    /// Where the robot is \[m\].
    pub truth: f64,
    /// Ranks of the landmarks that are in view: doors, or behind the doors the sign.
    pub seen: Vec<u32>,
    /// Where each particle is \[m\], after resampling.
    pub places: Vec<f64>,
    /// Its weight.
    pub weights: Vec<f64>,
    /// What each takes the first landmark in view for, or took the last one that was, since the ride.
    pub beliefs: Vec<Belief>,
    /// N_eff before resampling.
    pub ess: f64,
    /// Whether the step resampled.
    pub resampled: bool,
    /// Slot of the best particle.
    pub best: usize,
    /// Mean \[m\] of the Gaussian of EKF-SLAM.
    pub ekf_place: f64,
    /// Its standard deviation \[m\].
    pub ekf_std: f64,
    /// What EKF-SLAM takes it for.
    pub ekf_belief: Belief,
}

impl DoorsReport {
    /// The share of the weight off by −[`FARTHEST`] to [`FARTHEST`] doors.
    pub fn shares(&self, setup: &DoorsSetup) -> [f64; 2 * FARTHEST as usize + 1] {
        shares(setup, &self.places, &self.weights, self.truth)
    }

    /// How many explanations hold at least [`HELD`] of the weight.
    pub fn explanations(&self, setup: &DoorsSetup) -> u32 {
        self.shares(setup).iter().filter(|share| **share >= HELD).count() as u32
    }

    /// Whether the best particle is where the robot is.
    pub fn fastslam_right(&self) -> bool {
        (self.places[self.best] - self.truth).abs() < RIGHT_WITHIN
    }

    /// Whether EKF-SLAM is.
    pub fn ekf_right(&self) -> bool {
        (self.ekf_place - self.truth).abs() < RIGHT_WITHIN
    }
}

type Map = Landmarks<Offset>;
type Proposal = Either<FromMotion<Corridor, Marginal>, FromMeasurement<Corridor>>;

/// The particles and EKF-SLAM on one log, a step at a time.
#[derive(Clone, Debug)]
pub struct Doors {
    setup: DoorsSetup,
    log: Log,
    filter: Rbpf<Map, Proposal>,
    ekf: EkfSlam<Corridor, Offset>,
    step: usize,
    /// What each particle and EKF-SLAM took the last landmark in view for.
    beliefs: Vec<Belief>,
    ekf_belief: Belief,
}

impl Doors {
    /// Before the first step.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(setup: &DoorsSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        let sensor = Offset { std: setup.sensor_std };
        let correspondence = Correspondence::Unknown(setup.gate);
        let proposal = match setup.proposal {
            ProposalKind::Motion => Either::Left(FromMotion { motion: Corridor, likelihood: Marginal }),
            ProposalKind::Improved => Either::Right(FromMeasurement { motion: Corridor }),
        };
        let filter = Rbpf::builder(Map::new(sensor, correspondence), proposal)
            .particles(setup.particles)
            .seed(setup.seed)
            .policy(setup.policy)
            .executor(Executor::Serial)
            .build()?;
        let ekf = EkfSlam::new(Corridor, sensor, correspondence, Pose2::default());
        let (beliefs, ekf_belief) = (vec![Belief::Nothing; setup.particles], Belief::Nothing);
        Ok(Self { setup: setup.clone(), log: Log::new(setup), filter, ekf, step: 0, beliefs, ekf_belief })
    }

    /// This run from where another one is, as far as both are the same: where that one has not ridden yet, and its setup differs in nothing but
    /// the ride. Else it is left as it is.
    pub fn resumed(self, other: &Self) -> Self {
        let DoorsSetup { ride_std, end, .. } = self.setup;
        let alike = self.setup == DoorsSetup { ride_std, end, ..other.setup.clone() };
        let to_ride = other.step <= other.log.ride;
        if alike && to_ride { Self { setup: self.setup, log: self.log, ..other.clone() } } else { self }
    }

    /// What was set.
    pub fn setup(&self) -> &DoorsSetup {
        &self.setup
    }

    /// Number of the last step.
    pub fn step_count(&self) -> u32 {
        self.log.controls.len() as u32
    }

    /// The step that is done.
    pub fn step_number(&self) -> u32 {
        self.step as u32
    }

    /// The step of the ride, of the first door after it, and of the sign, the second time.
    pub fn events(&self) -> [u32; 3] {
        [self.log.ride, self.log.first_door, self.log.sign].map(|index| index as u32 + 1)
    }

    /// Where the robot truly is at every step \[m\].
    pub fn truth(&self) -> &[f64] {
        &self.log.truth
    }

    /// Both filters before the first step.
    pub fn start(&self) -> DoorsReport {
        self.report(self.filter.weights().ess(), false)
    }

    /// Both filters make a step; `None` where the log has ended.
    pub fn step(&mut self) -> Option<DoorsReport> {
        let (control, features) = (self.log.controls.get(self.step)?, &self.log.sightings[self.step]);
        let report = self.filter.step(control, features);
        let ekf = self.ekf.step(control, features);
        if self.step == self.log.ride {
            // Whoever is carried with closed eyes has nothing in view any more.
            self.beliefs.fill(Belief::Nothing);
            self.ekf_belief = Belief::Nothing;
        }
        self.step += 1;
        // What a slot saw is told of the slots before resampling: the particle in it now was copied from one of them.
        let believed = self.filter.particles().iter().enumerate().map(|(slot, particle)| {
            let from = report.ancestors.as_ref().map_or(slot, |ancestors| ancestors[slot] as usize);
            let place = |index| particle.map.get(index).map(|landmark| landmark.mean.x);
            self.belief(report.associations[from].first(), place).unwrap_or(self.beliefs[from])
        });
        let believed = believed.collect();
        let place = |index| self.ekf.landmark(index).map(|landmark| landmark.mean.x);
        self.ekf_belief = self.belief(ekf.associations.first(), place).unwrap_or(self.ekf_belief);
        self.beliefs = believed;
        Some(self.report(report.ess, report.resampled()))
    }

    fn report(&self, ess: f64, resampled: bool) -> DoorsReport {
        let features = self.step.checked_sub(1).map(|index| &self.log.sightings[index]);
        DoorsReport {
            step: self.step_number(),
            truth: self.log.truth[self.step],
            seen: features.into_iter().flatten().filter_map(|feature| feature.signature).collect(),
            places: self.filter.particles().iter().map(|p| p.world_from_robot.x).collect(),
            weights: self.filter.weights().as_slice().to_vec(),
            beliefs: self.beliefs.clone(),
            ess,
            resampled,
            best: self.filter.best(),
            ekf_place: self.ekf.pose().x,
            ekf_std: self.ekf.pose_covariance().m11.max(0.0).sqrt(),
            ekf_belief: self.ekf_belief,
        }
    }

    /// What an association means: the landmark that is where the filter has mapped it, if it is one of the corridor; `None` where
    /// nothing was in view.
    fn belief(&self, association: Option<&Association>, place: impl Fn(u32) -> Option<f64>) -> Option<Belief> {
        let (index, new) = match association? {
            Association::Ignored => return None,
            Association::Matched(index) => (*index, false),
            // While it maps, whatever is new is the landmark that is there.
            Association::New(index) => (*index, self.step > self.log.ride),
        };
        let mapped = place(index).filter(|_| !new);
        let landmarks = || (0..).zip(self.setup.doors.iter().copied().chain([SIGN]));
        let near = mapped.and_then(|mapped| landmarks().find(|(_, landmark)| (landmark - mapped).abs() < SAME));
        Some(near.map_or(Belief::New, |(rank, _)| Belief::Landmark(rank)))
    }
}

/// The share of the weight that is off by −[`FARTHEST`] to [`FARTHEST`] doors.
fn shares(setup: &DoorsSetup, places: &[f64], weights: &[f64], truth: f64) -> [f64; 2 * FARTHEST as usize + 1] {
    let mut shares = [0.0; 2 * FARTHEST as usize + 1];
    for (x, weight) in places.iter().zip(weights) {
        let off = setup.off(*x, truth);
        if (-FARTHEST..=FARTHEST).contains(&off) {
            shares[(off + FARTHEST) as usize] += weight;
        }
    }
    shares
}

/// What one seed came to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DoorsOutcome {
    /// How many doors the particles take the first door after the ride for, those with 1 % of the weight or more.
    pub first: u32,
    /// How many explanations are left when the sign comes in sight, before it is taken into account.
    pub last: u32,
    /// Whether the best particle ends where the robot is.
    pub fastslam_right: bool,
    /// Whether EKF-SLAM does, on the same log.
    pub ekf_right: bool,
}

/// Both filters on the drive of each of these seeds; the seed of the setting is not used.
///
/// # Errors
/// Where a setting is out of its range.
pub fn outcomes(setup: &DoorsSetup, seeds: core::ops::Range<u64>) -> Result<Vec<DoorsOutcome>, SettingError> {
    seeds.map(|seed| outcome(&DoorsSetup { seed, ..setup.clone() })).collect()
}

fn outcome(setup: &DoorsSetup) -> Result<DoorsOutcome, SettingError> {
    let mut doors = Doors::new(setup)?;
    let [_, first_door, sign] = doors.events();
    let mut held = [0; 2];
    let mut last = doors.start();
    while let Some(report) = doors.step() {
        for (count, step) in held.iter_mut().zip([first_door, sign - 1]) {
            if report.step == step {
                *count = report.explanations(setup);
            }
        }
        last = report;
    }
    let [first, before_the_sign] = held;
    Ok(DoorsOutcome {
        first,
        last: before_the_sign,
        fastslam_right: last.fastslam_right(),
        ekf_right: last.ekf_right(),
    })
}

#[cfg(test)]
mod tests;
