//! What the past looks like afterwards: the ancestry that a filter leaves of a drive among landmarks, and paths that a smoother draws of it.
//!
//! A robot drives a figure of eight among twenty-four landmarks: [`Field::one_eight`]. FastSLAM 2.0 follows it with M particles. At the end
//! all of them descend from few, and before some step from one: the record has a single path there, whichever particle is asked. Then
//! [`Smoother`] sweeps over the whole log again and again, each time from the path that the sweep before has drawn, at first from
//! one that was traced back from the filter's particles. What the record and the draws say of every step is compared with the truth.

use super::landmarks::{Course, LandmarkLog, LandmarkMap, Tuning};
use crate::WORLD_SENSOR;
use crate::digest::Digest;
use crate::world::Field;
use core::f64::consts::PI;
use core::hash::Hasher as _;
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::genealogy::Path;
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::map::landmarks::Correspondence;
use fastslam::matching::Likelihood;
use fastslam::motion::{Floored, VelocityModel};
use fastslam::nalgebra::Matrix3;
use fastslam::order::sorted;
use fastslam::proposal::{FromMeasurement, Marginal};
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use fastslam::smoothing::{Draw, Reconnect, Settings, Smoother, Sweep, distinct, moments, traced};
use std::collections::BTreeSet;
use std::sync::Arc;

/// How many particles there may be.
pub const PARTICLES: Range = Range::whole(2, 64);

/// Steps of the drive.
pub const STEPS: u32 = 62;

/// Most sweeps.
pub const MOST: u32 = 24;

/// The sensor at scale 1: blunt enough that paths differ by what can be seen.
const SENSOR: RangeBearing = RangeBearing { range_std: 0.3, bearing_std: 0.06, max_range: 6.0, field_of_view: PI };

/// What the wheels' own noise is widened by \[m, m, rad\]: they have two numbers, a pose three.
const FLOOR: [f64; 3] = [0.03, 0.03, 0.01];

/// The filter resamples where N_eff is below this share of M. A half is never reached by two particles.
const BELOW: f64 = 0.75;

/// Looks around before the first stride.
const LOOKS: u32 = 20;

/// Updates of a map in one slice of a sweep, at least: a few milliseconds.
const SLICE: u64 = 4000;

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct SmoothingSetup {
    /// Number of particles M of the filter and of each sweep, 2 to 64.
    pub particles: u32,
    /// Factor on the noise of the wheels, 0.2 of the speed and 0.1 rad a stride at 1; 0.25 to 3.
    pub odometry_scale: f64,
    /// Factor on the noise of the sensor, 0.3 m and 0.06 rad at 1; 0.25 to 2.
    pub sensor_scale: f64,
    /// Whether a sweep gives the path a new past, as it should, or leaves it the one that it has.
    pub reconnect: bool,
    /// Picks the noise of the world, and the draws.
    pub seed: u64,
}

impl Default for SmoothingSetup {
    fn default() -> Self {
        Self { particles: 16, odometry_scale: 1.0, sensor_scale: 1.0, reconnect: true, seed: 1 }
    }
}

impl SmoothingSetup {
    fn validate(&self) -> Result<(), SettingError> {
        PARTICLES.check("particles", self.particles.into())?;
        Range::number(0.25, 3.0, "").check("odometry_scale", self.odometry_scale)?;
        Range::number(0.25, 2.0, "").check("sensor_scale", self.sensor_scale).map(drop)
    }
}

type Motion = Floored<VelocityModel>;
type Filter = Rbpf<LandmarkMap, FromMeasurement<Motion>>;

/// What a filter leaves of the past.
#[derive(Clone, Debug)]
pub struct Record {
    /// Edges that nobody descends from any more, from pose to pose, as lines.
    pub dead: Vec<Vec<[f64; 2]>>,
    /// What all particles share, from the start on.
    pub trunk: Vec<[f64; 2]>,
    /// What is left of the others: a line for each branch, from where it leaves another on.
    pub branches: Vec<Vec<[f64; 2]>>,
    /// Distinct ancestors of the particles at each step.
    pub distinct: Vec<u32>,
    /// The last step at which all particles have one ancestor.
    pub coalescence: u32,
    /// Mean and covariance of the particles' ancestors by their weights at each step.
    pub moments: Vec<(Pose2, Matrix3<f64>)>,
    /// Updates of a map: M T.
    pub updates: u64,
}

/// A filter's run, and the sweeps after it, as far as they are.
#[derive(Clone, Debug)]
pub struct Smoothing {
    setup: SmoothingSetup,
    log: Arc<LandmarkLog>,
    smoother: Smoother<LandmarkMap, FromMeasurement<Motion>>,
    filter: Filter,
    /// Of all that ever lived: nobody else holds those that died out.
    ends: Vec<Path>,
    step: usize,
    record: Option<Record>,
    /// Traced back from the filter's particles: where the first sweep begins.
    first: Vec<Pose2>,
    sweep: Option<Sweep<LandmarkMap, FromMeasurement<Motion>>>,
    draws: Vec<Draw<LandmarkMap>>,
}

impl Smoothing {
    /// Before the filter's first step.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(setup: &SmoothingSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        let tuning =
            Tuning { sensor: SENSOR, ..Course::Eight.tuning() }.scaled(setup.odometry_scale, setup.sensor_scale);
        let log = Field::one_eight().simulate(&tuning, &tuning.sensor, [0.0, 0.0], setup.seed);
        let proposal = FromMeasurement { motion: Floored { motion: tuning.motion, floor_stds: FLOOR } };
        let map = looked_around(&tuning, &log, setup.seed);
        let filter = Rbpf::builder(map.clone(), proposal.clone())
            .particles(setup.particles as usize)
            .seed(setup.seed)
            .policy(ResamplePolicy::EssBelow(BELOW))
            .build()?;
        let settings = Settings {
            particles: setup.particles as usize,
            seed: setup.seed,
            reconnect: if setup.reconnect { Reconnect::Whole } else { Reconnect::Never },
            executor: Executor::default(),
        };
        let (controls, sightings) = (log.controls.clone(), log.sightings.clone());
        let smoother = Smoother::new(settings, map, proposal, Pose2::default(), controls, sightings)?;
        Ok(Self {
            setup: setup.clone(),
            log: log.into(),
            smoother,
            filter,
            ends: Vec::new(),
            step: 0,
            record: None,
            first: Vec::new(),
            sweep: None,
            draws: Vec::new(),
        })
    }

    /// The same run, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        let smoother = self.smoother.with_executor(executor.clone());
        Self { smoother, filter: self.filter.with_executor(executor), ..self }
    }

    /// What was set.
    pub fn setup(&self) -> &SmoothingSetup {
        &self.setup
    }

    /// The drive.
    pub fn log(&self) -> &LandmarkLog {
        &self.log
    }

    /// What the filter has left of the past; nothing before it has come to the end.
    pub fn record(&self) -> Option<&Record> {
        self.record.as_ref()
    }

    /// Where the ancestors of the filter's particles were at a step, particle by particle; nothing before the filter has come to the end.
    pub fn ancestors(&self, step: usize) -> impl Iterator<Item = Pose2> {
        let particles = if self.record.is_some() { self.filter.particles() } else { &[] };
        particles
            .iter()
            .filter_map(move |particle| particle.path.back().find(|path| path.step() as usize == step).map(Path::pose))
    }

    /// What each sweep has drawn.
    pub fn draws(&self) -> &[Draw<LandmarkMap>] {
        &self.draws
    }

    /// Updates of a map in one sweep, for each in a run of the filter.
    pub fn cost(&self) -> f64 {
        let t = self.log.controls.len() as f64;
        if self.setup.reconnect { 0.5 * (t + 1.0) } else { 1.0 }
    }

    /// How many slices there are to do, about, until so many sweeps are done.
    pub fn pending(&self, sweeps: u32) -> u32 {
        let filter = self.log.controls.len() - self.step + usize::from(self.record.is_none());
        let left = (sweeps.min(MOST) as usize).saturating_sub(self.draws.len());
        let done = self.sweep.as_ref().map_or(0, |sweep| sweep.updates() / SLICE) as usize;
        let begun = usize::from(self.sweep.is_some() && left > 0);
        (filter + (left * self.slices()).saturating_sub(done.min(self.slices() - 1) * begun)) as u32
    }

    /// Slices in a sweep, about.
    fn slices(&self) -> usize {
        let filter = f64::from(self.setup.particles) * self.log.controls.len() as f64;
        (self.cost() * filter) as usize / SLICE as usize + 1
    }

    /// One slice: a step of the filter, or some of a sweep.
    pub fn advance(&mut self) {
        if let (Some(control), Some(features)) = (self.log.controls.get(self.step), self.log.sightings.get(self.step)) {
            let report = self.filter.step(control, features);
            self.ends.extend(report.extinct().cloned());
            self.step += 1;
        } else if self.record.is_none() {
            let mut stream = Stream::at(self.setup.seed, Purpose::TRIAL, 0, 0);
            self.first = traced(&self.filter, 1, &mut stream)[0].poses();
            self.record = Some(Record::of(&self.filter, &self.ends, self.step));
            self.ends = Vec::new();
        } else {
            self.sweep_on();
        }
    }

    fn sweep_on(&mut self) {
        let smoother = &self.smoother;
        let path = self.draws.last().map_or(&self.first, |draw| &draw.path);
        let number = self.draws.len() as u32;
        let sweep = self.sweep.get_or_insert_with(|| match smoother.begin(number, path) {
            Ok(sweep) => sweep,
            Err(_) => unreachable!("paths come from the smoother's own filter"),
        });
        let until = sweep.updates() + SLICE;
        while sweep.updates() < until {
            if let Some(draw) = smoother.advance(sweep) {
                self.draws.push(draw);
                self.sweep = None;
                return;
            }
        }
    }

    /// Does everything until so many sweeps are done.
    pub fn finish(&mut self, sweeps: u32) {
        while self.pending(sweeps) > 0 {
            self.advance();
        }
    }

    /// How many different poses the first so many draws have at each step; nothing of no draws.
    pub fn distinct(&self, sweeps: usize) -> Vec<u32> {
        distinct(&self.paths(sweeps))
    }

    /// Mean and covariance over the first so many draws at each step.
    pub fn moments(&self, sweeps: usize) -> Vec<(Pose2, Matrix3<f64>)> {
        moments(&self.paths(sweeps))
    }

    fn paths(&self, sweeps: usize) -> Vec<&[Pose2]> {
        self.draws.iter().take(sweeps).map(|draw| &draw.path[..]).collect()
    }

    /// Distance of these means from the truth at each step \[m\].
    pub fn errors(&self, moments: &[(Pose2, Matrix3<f64>)]) -> Vec<f64> {
        moments.iter().zip(&self.log.truth).map(|((mean, _), truth)| mean.distance(truth)).collect()
    }

    /// The steps that count as early: the first half of the drive.
    pub fn early(&self) -> core::ops::RangeInclusive<usize> {
        1..=self.log.controls.len() / 2
    }

    /// Root mean square of these errors over the early steps \[m\].
    pub fn early_rms(&self, errors: &[f64]) -> f64 {
        let early = errors.get(self.early()).unwrap_or_default();
        (early.iter().map(|error| error * error).sum::<f64>() / early.len() as f64).sqrt()
    }

    /// Runs so many sweeps, and returns a fingerprint of every pose of the record and of the draws, bit for bit.
    pub fn trace(mut self, sweeps: u32) -> Digest {
        self.finish(sweeps);
        let mut digest = Digest::new();
        let record = self.record.iter().flat_map(|record| record.moments.iter().map(|(mean, _)| mean));
        let poses = record.chain(self.draws.iter().flat_map(|draw| &draw.path));
        poses.flat_map(|pose| [pose.x, pose.y, pose.theta]).for_each(|x| digest.f64(x));
        for draw in &self.draws {
            digest.write(&draw.updates.to_le_bytes());
            draw.map.iter().for_each(|(_, landmark)| landmark.mean.iter().for_each(|x| digest.f64(*x)));
        }
        digest
    }
}

/// What is known after some looks around from the start, before the first stride. They anchor the gauge: without them a map is turned as a
/// whole by the first errors of the heading, and consistent ever after.
fn looked_around(tuning: &Tuning, log: &LandmarkLog, seed: u64) -> LandmarkMap {
    let (start, mut map) = (Pose2::default(), LandmarkMap::new(tuning.sensor, Correspondence::Known));
    for look in 0..LOOKS {
        let seen: Vec<Feature> = (0..)
            .zip(&log.landmarks)
            .filter(|(_, landmark)| tuning.sensor.sees(&start, landmark, 0.0))
            .map(|(signature, landmark)| {
                // After the drive's own steps.
                let mut stream = Stream::at(seed, WORLD_SENSOR, 1000 + look, signature);
                Feature { z: tuning.sensor.measure(&start, landmark, &mut stream), signature: Some(signature) }
            })
            .collect();
        let (_, associations) = Marginal.log_likelihood(&map, &start, &seen);
        map.assimilate(&start, &seen, &associations);
    }
    map
}

impl Record {
    fn of(filter: &Filter, ends: &[Path], steps: usize) -> Self {
        let alive: Vec<Path> = filter.particles().iter().map(|particle| particle.path.clone()).collect();
        let descent = filter.descent();
        let coalescence = descent.coalescence().unwrap_or(0);
        // Every node is drawn once, by whom it is met first.
        let mut met: BTreeSet<usize> = BTreeSet::new();
        let mut branch = |path: &Path| {
            let mut line = Vec::new();
            for node in path.back() {
                line.push([node.pose().x, node.pose().y]);
                if !met.insert(node.id()) {
                    break;
                }
            }
            line.reverse();
            line
        };
        let before = |path: &Path| path.back().find(|node| node.step() == coalescence).cloned();
        let trunk = alive.first().and_then(before).map(|path| branch(&path)).unwrap_or_default();
        let lines = |paths: &[Path], branch: &mut dyn FnMut(&Path) -> Vec<[f64; 2]>| -> Vec<Vec<[f64; 2]>> {
            paths.iter().map(branch).filter(|line| line.len() > 1).collect()
        };
        let branches = lines(&alive, &mut branch);
        // From the youngest on, so that lines are long.
        let ends = sorted(ends.to_vec(), |a, b| b.step().cmp(&a.step()));
        let dead = lines(&ends, &mut branch);
        let paths: Vec<Vec<Pose2>> = alive.iter().map(Path::poses).collect();
        let weights = filter.weights().as_slice();
        Self {
            dead,
            trunk,
            branches,
            distinct: descent.widths().collect(),
            coalescence,
            moments: fastslam::smoothing::weighted_moments(&paths, weights),
            updates: (alive.len() * steps) as u64,
        }
    }
}

#[cfg(test)]
mod tests;
