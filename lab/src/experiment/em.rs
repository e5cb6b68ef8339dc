//! Three doors without names, seen from two rides: EM mapping from a first guess, and particles, on one log.
//!
//! A robot rides to and fro past the first two doors. Then it is carried with its eyes closed, and told where to with a standard deviation
//! of [`CARRIED_STD`]; from there it rides to and fro past two doors again. Were they the same two, or the second and a third? What it was
//! told is just between the two. Nothing but the distances of the doors, by the wheels, tells one from the other: that of the second to
//! the third is a little longer.
//!
//! [`Log`] is such a pair of rides. [`climb`] is EM mapping on it (see [`em_mapping`](crate::baseline::em_mapping)) from a first map, which
//! ends at one answer; [`Cloud`] is the filter with particles on the same log, which keeps both. Everything that the two assume is true:
//! the errors of wheels and sensor are drawn from the very model, cell by cell.

mod ends;

pub use ends::{End, FOLDING, OTHERS, Others, Outcome, outcome};

use crate::baseline::em_mapping::{
    Beta, ByWheels, Corridor, DoorCounts, DoorMap, Expectation, Kernel, Ride, Shift, log_prior,
};
use crate::digest::Digest;
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::random::Stream;
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;

/// Number of doors, and of marks of a guess.
pub const DOORS: usize = 3;

/// The middle of each door \[m\].
pub const PLACES: [f64; DOORS] = [2.9, 5.1, 7.9];

/// From the middle of a door to its edge \[m\].
pub const HALF_DOOR: f64 = 0.4;

/// The corridor: its length, and that of a cell \[m\]; and what is known of every cell beforehand.
pub const CORRIDOR: Corridor = Corridor { cells: 50, cell_size: 0.2, known: Beta { yes: 1.3, no: 1.7 } };

/// Length of the corridor \[m\].
pub const LENGTH: f64 = 10.0;

/// Where the first ride begins \[m\], as is known, and where the second does, as is not.
pub const STARTS: [f64; 2] = [1.1, 3.9];

/// What the wheels report of a step \[m\], how many of them a ride goes on before it turns, and how often it goes.
const STEP: f64 = 0.2;
const LEG: u32 = 26;
const LEGS: u32 = 3;

/// Number of the last step of a log: two rides, and the step with which the robot is carried between them.
pub const STEPS: u32 = 2 * LEG * LEGS + 1;

/// How far the robot is told to have been carried \[m\]: to the middle between the two answers.
const CARRIED: f64 = -3.6;

/// Standard deviation of where the robot is carried \[m\].
pub const CARRIED_STD: f64 = 1.5;

/// A path that has the second ride begin below this \[m\] takes its doors for the first two again.
pub const AGAIN_BELOW: f64 = 2.7;

/// How probably the sensor says *door* by a first map that is sure: off the marks, and on one of them.
const FIRST: [f64; 2] = [0.1, 0.8];

/// A cell in which the sensor says *door* more often than not is one of a door, and so many others between two such cells do not part them.
const GAP: usize = 1;

/// Most iterations.
pub const ITERATIONS: u32 = 60;

/// What decides the log, and the particles on it.
#[derive(Clone, PartialEq, Debug)]
pub struct LogSetup {
    /// Standard deviation of a step of the wheels \[m\], 0.01 to 0.3. A step is 0.2 m.
    pub odometry_std: f64,
    /// How often the sensor says *door* where there is none, and misses one where there is: 0 to 0.45.
    pub errors: f64,
    /// Picks the errors of wheels and sensor, and the draws of the particles.
    pub seed: u64,
    /// Number of particles, 1 to 5000.
    pub particles: u32,
}

impl Default for LogSetup {
    fn default() -> Self {
        Self { odometry_std: 0.05, errors: 0.05, seed: 10, particles: 1000 }
    }
}

impl LogSetup {
    fn validate(&self) -> Result<(), SettingError> {
        Range::number(0.01, 0.3, "m").check("odometry_std", self.odometry_std)?;
        Range::number(0.0, 0.45, "").check("errors", self.errors)?;
        Range::whole(1, 5000).check("particles", f64::from(self.particles)).map(drop)
    }

    /// How probably the sensor truly says *door* at a place \[m\].
    fn says_door(&self, place: f64) -> f64 {
        if near_one_of(&PLACES, place) { 1.0 - self.errors } else { self.errors }
    }

    /// The same for each cell: what a map is to be.
    pub fn true_map(&self) -> DoorMap {
        (0..CORRIDOR.cells as usize).map(|cell| self.says_door(CORRIDOR.place(cell))).collect()
    }
}

/// Whether a place \[m\] is before a door in the middle of one of these.
fn near_one_of(doors: &[f64], place: f64) -> bool {
    // A little more, so that the middle of a cell that is just at the edge is before the door however it was rounded.
    doors.iter().any(|door| (place - door).abs() < HALF_DOOR + 1e-9)
}

/// Where doors are guessed to be, to begin with.
#[derive(Clone, PartialEq, Debug)]
pub struct Guess {
    /// Their middles \[m\], in the corridor. Several at one place are one door.
    pub marks: [f64; DOORS],
    /// How sure of that the first map is, 0 to 1: at 0 it says the same everywhere.
    pub trust: f64,
}

impl Default for Guess {
    fn default() -> Self {
        Self { marks: [2.6, 5.2, 8.2], trust: 1.0 }
    }
}

impl Guess {
    /// The first map.
    ///
    /// # Errors
    /// Where a mark is out of the corridor, or the trust out of its range.
    pub fn first_map(&self) -> Result<DoorMap, SettingError> {
        for mark in self.marks {
            Range::number(0.0, LENGTH, "m").check("marks", mark)?;
        }
        Range::number(0.0, 1.0, "").check("trust", self.trust)?;
        let flat = CORRIDOR.known.mean();
        let of = |cell| {
            let sure = FIRST[usize::from(near_one_of(&self.marks, CORRIDOR.place(cell)))];
            flat + self.trust * (sure - flat)
        };
        Ok((0..CORRIDOR.cells as usize).map(of).collect())
    }
}

/// What wheels and sensor reported of both rides, and where the robot truly was.
#[derive(Clone, PartialEq, Debug)]
pub struct Log {
    /// What both methods read.
    pub ride: Ride,
    /// Cells of the true path, from step 0 on.
    pub truth: Vec<usize>,
    /// The step with which the robot was carried.
    pub carried: usize,
    setup: LogSetup,
}

impl Log {
    /// Draws the errors of a log. Only where the robot is carried to is not drawn.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(setup: &LogSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        let legs = (0..LEGS).flat_map(|leg| (0..LEG).map(move |_| if leg % 2 == 0 { STEP } else { -STEP }));
        let ridden: Vec<Shift> = legs.map(|by| Shift { by, std: setup.odometry_std }).collect();
        let carry = Shift { by: CARRIED, std: CARRIED_STD };
        let carried = ridden.len() + 1;
        let shifts = ridden.iter().copied().chain([carry]).chain(ridden.iter().copied());
        let (mut truth, mut log) = (vec![CORRIDOR.cell(STARTS[0])], Vec::new());
        for (step, shift) in (1..).zip(shifts) {
            let uniform = |purpose| Stream::at(setup.seed, purpose, step, 0).uniform();
            let from = truth[step as usize - 1];
            let to = if step as usize == carried {
                CORRIDOR.cell(STARTS[1])
            } else {
                Kernel::new(&CORRIDOR, &shift)?.draw(from, uniform(WORLD_ODOMETRY))
            };
            truth.push(to);
            log.push((shift, uniform(WORLD_SENSOR) < setup.says_door(CORRIDOR.place(to))));
        }
        Ok(Self { ride: Ride::new(CORRIDOR, STARTS[0], &log)?, truth, carried, setup: setup.clone() })
    }

    /// What was set.
    pub fn setup(&self) -> &LogSetup {
        &self.setup
    }

    /// Number of the last step, T.
    pub fn steps(&self) -> usize {
        self.ride.steps()
    }
}

/// A map on the way up, and what it is worth.
#[derive(Clone, PartialEq, Debug)]
pub struct Iterate {
    /// The map.
    pub map: DoorMap,
    /// ln p(z₁..T | m) \[nats\].
    pub log_likelihood: f64,
    /// ln p(z₁..T | m) + ln p(m), but for a constant \[nats\]: what never falls.
    pub log_posterior: f64,
}

/// EM mapping from a first map on: that map, and the one after each iteration.
///
/// # Errors
/// Where the first map is none of this corridor, or one of its numbers is not between 0 and 1.
pub fn climb(log: &Log, first: DoorMap, iterations: u32) -> Result<Vec<Iterate>, SettingError> {
    let mut passes = Expectation::of(first, &log.ride)?;
    let mut iterates = vec![iterate(&passes)];
    for _ in 0..iterations {
        passes.iterate(&log.ride);
        iterates.push(iterate(&passes));
    }
    Ok(iterates)
}

/// The map of these passes with its log-likelihood and log posterior.
fn iterate(passes: &Expectation) -> Iterate {
    let log_likelihood = passes.log_likelihood().unwrap_or(f64::NAN);
    let log_posterior = log_likelihood + log_prior(passes.map(), CORRIDOR.known);
    Iterate { map: passes.map().clone(), log_likelihood, log_posterior }
}

/// The middles of the doors of a map \[m\]: runs of cells in which the sensor says *door* more often than not.
pub fn doors(map: &[f64]) -> Vec<f64> {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for cell in (0..map.len()).filter(|cell| map[*cell] > 0.5) {
        match runs.last_mut() {
            Some([_, last]) if cell <= *last + 1 + GAP => *last = cell,
            _ => runs.push([cell, cell]),
        }
    }
    runs.iter().map(|[first, last]| 0.5 * (CORRIDOR.place(*first) + CORRIDOR.place(*last))).collect()
}

/// The share of a distribution over the cells right after the robot was carried that takes the doors to come for the first two again.
pub fn again(put_down: &[f64]) -> f64 {
    put_down.iter().enumerate().filter(|(cell, _)| CORRIDOR.place(*cell) < AGAIN_BELOW).map(|(_, p)| p).sum()
}

/// The filter with particles on a log: the path sampled, the map computed. It keeps what it has of every step, by the paths at the end.
#[derive(Clone, Debug)]
pub struct Cloud {
    filter: Rbpf<DoorCounts, ByWheels>,
    done: usize,
    shares: Vec<Vec<f64>>,
}

impl Cloud {
    /// Before the first step.
    ///
    /// # Errors
    /// None for a log that there is.
    pub fn new(log: &Log) -> Result<Self, SettingError> {
        let start = Pose2::new(CORRIDOR.place(log.ride.start()), 0.0, 0.0);
        let filter = Rbpf::builder(DoorCounts::new(CORRIDOR), ByWheels)
            .particles(log.setup.particles as usize)
            .seed(log.setup.seed)
            .start(start)
            .policy(ResamplePolicy::EssBelow(0.5))
            .executor(Executor::Serial)
            .build()?;
        Ok(Self { filter, done: 0, shares: Vec::new() })
    }

    /// How many steps it still has to make.
    pub fn pending(&self, log: &Log) -> u32 {
        (log.steps() - self.done) as u32
    }

    /// Makes a step, while there is one.
    pub fn advance(&mut self, log: &Log) {
        if self.pending(log) == 0 {
            return;
        }
        self.done += 1;
        self.filter.step(log.ride.kernel(self.done), &log.ride.says_door(self.done));
        if self.pending(log) == 0 {
            self.shares = vec![vec![0.0; CORRIDOR.cells as usize]; log.steps() + 1];
            for (particle, weight) in self.filter.particles().iter().zip(self.filter.weights().as_slice()) {
                for path in particle.path.back() {
                    self.shares[path.step() as usize][CORRIDOR.cell(path.pose().x)] += weight;
                }
            }
        }
    }

    /// The share of the weight in each cell at a step, by the paths of all particles at the end; `None` before that.
    pub fn shares(&self, step: usize) -> Option<&[f64]> {
        self.shares.get(step).map(Vec::as_slice)
    }
}

/// Fingerprint of a whole run: every number that the figure is drawn from.
pub(super) fn trace() -> Result<Digest, SettingError> {
    let (mut digest, log) = (Digest::new(), Log::new(&LogSetup::default())?);
    for Iterate { map, log_likelihood, log_posterior } in climb(&log, Guess::default().first_map()?, 20)? {
        map.iter().chain([&log_likelihood, &log_posterior]).for_each(|x| digest.f64(*x));
        let passes = Expectation::of(map, &log.ride)?;
        digest.f64(passes.path_entropy(&log.ride).unwrap_or(f64::NAN));
        passes.product(log.carried).iter().flatten().for_each(|x| digest.f64(*x));
    }
    let mut cloud = Cloud::new(&log)?;
    while cloud.pending(&log) > 0 {
        cloud.advance(&log);
    }
    cloud.shares.iter().flatten().for_each(|x| digest.f64(*x));
    Ok(digest)
}

#[cfg(test)]
mod tests;
