//! The ring: what a filter keeps until a loop closes, what the closing leaves of it, and how noisy the price of a pose is.
//!
//! Round the block of [`Route::ring`] the robot drives through ground never seen before, of which no particle can be told from
//! another. Then the start comes in sight again: of all the maps drawn on the way, those that meet their own beginning are
//! right. For that choice there must be a choice: the measures here say how different the particles are just before the
//! closing, and how many of them it ends.

use super::hill::Hill;
use super::lap::{FROM_SCAN, Lap, LapSetup, LapWorld, Route};
use super::quantile;
use crate::world::drive;
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::map::grid::Grid;
use fastslam::motion::Motion as _;
use fastslam::motion::Odometry;
use fastslam::particle::Particle;
use fastslam::proposal::{Either, Fit, Proposal, ProposalTrace};
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::{BeamSensor, Scan};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Steps from the closing to the second look at the particles: of some 0.3 m, so about 2 m on.
pub const AFTER: u32 = 6;

/// Steps that must lie between two looks at a wall for the second to be a return.
const APART: u32 = 60;

/// The share of a scan's hits that must be known again for the loop to be closing. Less, and a beam that grazes a wall from afar
/// closes it; more, and particles have begun to be told apart before.
const KNOWN: f64 = 0.1;

/// A ring and the filter in it.
#[derive(Clone, PartialEq, Debug)]
pub struct RingSetup {
    /// The filter and the noises. The course is not used: it is the ring.
    pub lap: LapSetup,
    /// Niches on each side of the block, 0 to 2.
    pub niches: usize,
    /// Longest range of the laser \[m\].
    pub max_range: f64,
}

impl Default for RingSetup {
    /// The ring of [`Course::Ring`](super::lap::Course::Ring).
    fn default() -> Self {
        Self { lap: LapSetup::default(), niches: 2, max_range: 3.0 }
    }
}

impl RingSetup {
    /// The ring and the way round it.
    pub fn route(&self) -> Route {
        Route::ring(self.niches, self.max_range)
    }

    /// The lap at its start.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn start(&self) -> Result<Lap, SettingError> {
        Range::whole(0, 2).check("niches", self.niches as f64)?;
        Range::number(0.5, 20.0, "m").check("max_range", self.max_range)?;
        self.lap.validate()?;
        let world = LapWorld::on(&self.route(), self.lap.seed, &self.lap.motion(), self.lap.range_std);
        Lap::in_world(&self.lap, Arc::new(world))
    }
}

/// The first step at which a tenth of what the laser hits was first hit 60 steps or more before: cells of a grid of 0.3 m, seen
/// without noise from the true poses, so that it is one step for all seeds. `None` on a way that never comes back.
pub fn closing(route: &Route) -> Option<u32> {
    const CELL: f64 = 0.3;
    let sensor = BeamSensor::panorama(super::lap::BEAMS, route.max_range, 0.0);
    let mut first_seen: BTreeMap<[i64; 2], u32> = BTreeMap::new();
    (0..).zip(drive(&route.way_points, route.steps)).find_map(|(step, pose)| {
        let ranges = route.plan.ranges(&pose, &sensor, &mut Stream::at(0, Purpose::TRIAL, step, 0));
        let hits = sensor.scan(&ranges).hits;
        let known = hits.iter().filter(|hit| {
            let cell = pose.transform(**hit).map(|x| (x / CELL).floor() as i64);
            *first_seen.entry(cell).or_insert(step) + APART <= step
        });
        (known.count() as f64 >= KNOWN * hits.len() as f64 && step >= APART).then_some(step)
    })
}

/// What one run round the ring came to.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RingRun {
    /// Its seed.
    pub seed: u64,
    /// Step at which the loop closes.
    pub closing: u32,
    /// Steps before it that resampled.
    pub resampled_before: u32,
    /// Standard deviation \[m\] of the robot's position over the weighted particles, one step before the closing.
    pub deviation_before: f64,
    /// The same [`AFTER`] steps after it.
    pub deviation_after: f64,
    /// Mean over pairs of particles of what their walls have in common, one step before the closing: intersection over union of
    /// the cells of log-odds above 0. One particle has all in common with itself.
    pub overlap_before: f64,
    /// Share of the particles alive one step before the closing that have no descendant [`AFTER`] steps after it.
    pub died: f64,
    /// Distinct ancestors at the start, one step before the closing.
    pub lineage_before: u32,
    /// The same at the end.
    pub lineage: u32,
    /// RMS error of position over the best particle's path \[m\].
    pub rms_best: f64,
    /// Error of its last position \[m\].
    pub end_best: f64,
    /// RMS error of position of raw odometry \[m\].
    pub rms_odometry: f64,
    /// Error of its last position \[m\].
    pub end_odometry: f64,
}

impl RingRun {
    /// Drives once round the ring, on the calling thread: seeds are what is spread.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn of(setup: &RingSetup) -> Result<Self, SettingError> {
        Ok(Self::driven(setup.start()?, &setup.lap, &setup.route()))
    }

    /// The same on another route that comes back to where it began.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    ///
    /// # Panics
    /// Where the route does not come back.
    pub fn on(route: &Route, setup: &LapSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        let world = LapWorld::on(route, setup.seed, &setup.motion(), setup.range_std);
        Ok(Self::driven(Lap::in_world(setup, Arc::new(world))?, setup, route))
    }

    /// A lap from its start on, of this setup and on this route.
    fn driven(lap: Lap, setup: &LapSetup, route: &Route) -> Self {
        let mut lap = lap.with_executor(Executor::Serial);
        let closing = closing(route).expect("the way comes back to where it began");
        let mut resampled_before = 0;
        for _ in 1..closing {
            resampled_before += u32::from(lap.step().is_some_and(|report| report.ancestors.is_some()));
        }
        let (deviation_before, overlap_before) = (deviation_of(&lap), overlap(&maps(&lap)));
        let lineage_before = lap.report().lineage;
        let mut resamplings = Vec::new();
        for _ in 0..=AFTER {
            resamplings.extend(lap.step().and_then(|report| report.ancestors.clone()));
        }
        let (deviation_after, died) = (deviation_of(&lap), died(setup.particles, &resamplings));
        while lap.step().is_some() {}
        let (report, world) = (lap.report(), lap.world());
        let truth = world.truth[world.truth.len() - 1];
        Self {
            seed: setup.seed,
            closing,
            resampled_before,
            deviation_before,
            deviation_after,
            overlap_before,
            died,
            lineage_before,
            lineage: report.lineage,
            rms_best: report.rms_best,
            end_best: lap.particles()[lap.best()].world_from_robot.distance(&truth),
            rms_odometry: report.rms_odometry,
            end_odometry: world.odometry[world.odometry.len() - 1].distance(&truth),
        }
    }

    /// The measures: key in JSON, what it is called in a table, value.
    pub fn measures(&self) -> [(&'static str, &'static str, f64); 11] {
        [
            ("resampled_before", "steps that resampled before", f64::from(self.resampled_before)),
            ("deviation_before", "deviation of position before [m]", self.deviation_before),
            ("deviation_after", "deviation of position after [m]", self.deviation_after),
            ("overlap_before", "overlap of walls before", self.overlap_before),
            ("died", "share of universes that died", self.died),
            ("lineage_before", "lineage before", f64::from(self.lineage_before)),
            ("lineage", "lineage at the end", f64::from(self.lineage)),
            ("rms_best", "RMS error of the best [m]", self.rms_best),
            ("end_best", "end error of the best [m]", self.end_best),
            ("rms_odometry", "RMS error of odometry [m]", self.rms_odometry),
            ("end_odometry", "end error of odometry [m]", self.end_odometry),
        ]
    }
}

fn maps(lap: &Lap) -> Vec<&Grid> {
    lap.particles().iter().map(|particle| &particle.map).collect()
}

/// Standard deviation of the robot's position over the weighted particles of a lap \[m\].
pub fn deviation_of(lap: &Lap) -> f64 {
    let poses: Vec<Pose2> = lap.particles().iter().map(|particle| particle.world_from_robot).collect();
    deviation(&poses, lap.weights())
}

/// Standard deviation of weighted positions \[m\]: √(Σ w |x − x̄|²), of both axes together.
pub fn deviation(poses: &[Pose2], weights: &[f64]) -> f64 {
    let mean = |f: &dyn Fn(&Pose2) -> f64| poses.iter().zip(weights).map(|(pose, w)| w * f(pose)).sum::<f64>();
    let (x, y) = (mean(&|pose| pose.x), mean(&|pose| pose.y));
    mean(&|pose| (pose.x - x) * (pose.x - x) + (pose.y - y) * (pose.y - y)).sqrt()
}

/// Mean over all pairs of maps: cells that are walls (log-odds > 0) in both, over those that are in one at least.
pub fn overlap(maps: &[&Grid]) -> f64 {
    let walls: Vec<BTreeSet<(i32, i32)>> = maps.iter().map(|map| walls(map)).collect();
    let (mut sum, mut pairs) = (0.0, 0_u32);
    for (k, one) in walls.iter().enumerate() {
        for other in &walls[..k] {
            let both = one.intersection(other).count();
            let either = one.len() + other.len() - both;
            sum += if either == 0 { 1.0 } else { both as f64 / either as f64 };
            pairs += 1;
        }
    }
    if pairs == 0 { 1.0 } else { sum / f64::from(pairs) }
}

fn walls(map: &Grid) -> BTreeSet<(i32, i32)> {
    let cells = map.bounds();
    let all = (cells.j0..cells.j1).flat_map(|j| (cells.i0..cells.i1).map(move |i| (i, j)));
    all.filter(|&(i, j)| map.log_odds(i, j) > 0.0).collect()
}

/// Share of so many particles that have no descendant after these resamplings, each the slots that were copied.
pub fn died(count: usize, resamplings: &[Vec<u32>]) -> f64 {
    let mut origins: Vec<u32> = (0..count as u32).collect();
    for ancestors in resamplings {
        origins = ancestors.iter().map(|slot| origins[*slot as usize]).collect();
    }
    let mut survives = vec![false; count];
    origins.iter().for_each(|slot| survives[*slot as usize] = true);
    1.0 - survives.iter().filter(|survives| **survives).count() as f64 / count as f64
}

/// What the noise of prices is measured by.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct NoiseProbe {
    /// At every so many steps.
    pub every: u32,
    /// How many times each particle draws.
    pub draws: u32,
    /// Whether the n-th draw of all particles is from one stream; else each has its own, as in the filter.
    pub shared: bool,
}

impl Default for NoiseProbe {
    fn default() -> Self {
        Self { every: 10, draws: 60, shared: false }
    }
}

/// How far the price of a pose is noise, at one step.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PriceNoise {
    /// The step that was drawn for.
    pub step: u32,
    /// Standard deviation \[nats\] of one particle's log weight increment from draw to draw: the median over particles.
    pub noise: f64,
    /// The same of what the increment is above the mean of the population's in the same draw: what weights feel of it.
    pub noise_relative: f64,
    /// Standard deviation \[nats\] over the particles of their increments, each the mean of its draws: what one is better by, or its
    /// map's accident. The noise that the mean of n draws still has, 1/√n of one draw's, is in it.
    pub spread: f64,
    /// Standard deviation \[nats\] over the particles of the fit's error: ln η̂ less the logarithm of the integral that a dense
    /// lattice has. An error that all share is none. `None` where the matcher was trusted for fewer than two.
    pub fit_error: Option<f64>,
    /// Share of the draws in which the matcher was trusted.
    pub matched: f64,
}

/// Drives round the ring, and at some of the steps lets each particle draw its next pose many times, by streams that the filter does
/// not use. The run itself is not touched.
///
/// # Errors
/// Where a setting is out of its range.
///
/// # Panics
/// Where `every` is 0 or `draws` is less than 2.
pub fn price_noise(setup: &RingSetup, probe: NoiseProbe) -> Result<Vec<PriceNoise>, SettingError> {
    Ok(price_noise_on(setup.start()?, &setup.lap, probe))
}

/// The same on any lap at its start, of this setup.
///
/// # Panics
/// Where `every` is 0 or `draws` is less than 2.
pub fn price_noise_on(lap: Lap, setup: &LapSetup, probe: NoiseProbe) -> Vec<PriceNoise> {
    assert!(probe.every > 0 && probe.draws > 1, "a deviation needs two draws");
    let mut lap = lap.with_executor(Executor::Serial);
    let mut found = Vec::new();
    for step in 1..=lap.step_count() {
        if step % probe.every == 0 {
            found.push(noise_at(&lap, setup, probe, step));
        }
        lap.step();
    }
    found
}

/// Of the step that this lap takes next.
fn noise_at(lap: &Lap, setup: &LapSetup, probe: NoiseProbe, step: u32) -> PriceNoise {
    let proposal = setup.proposals();
    let (control, scan) = (&lap.world().controls[step as usize - 1], &lap.world().scans[step as usize - 1]);
    let mut matched = 0;
    // By particle, then by draw.
    let mut increments: Vec<Vec<f64>> = Vec::new();
    for (slot, particle) in (0..).zip(lap.particles()) {
        let own = if probe.shared { 0 } else { slot * probe.draws };
        let draws = (own..).take(probe.draws as usize).map(|address| {
            let mut stream = Stream::at(setup.seed, Purpose::TRIAL, step, address);
            let proposed = proposal.propose(particle, control, scan, &mut stream);
            matched += u32::from(matches!(proposed.trace, ProposalTrace::Matched { .. }));
            proposed.log_increment
        });
        increments.push(draws.collect());
    }
    let count = increments.len() as f64;
    let population: Vec<f64> = (0..probe.draws as usize)
        .map(|draw| increments.iter().map(|of_particle| of_particle[draw]).sum::<f64>() / count)
        .collect();
    let relative = |of_particle: &Vec<f64>| -> Vec<f64> {
        of_particle.iter().zip(&population).map(|(increment, mean)| increment - mean).collect()
    };
    let means: Vec<f64> = increments.iter().map(|of_particle| mean_and_std(of_particle).0).collect();
    let errors: Vec<f64> =
        lap.particles().iter().filter_map(|particle| fit_error(setup, particle, control, scan)).collect();
    PriceNoise {
        step,
        noise: median(increments.iter().map(|of_particle| mean_and_std(of_particle).1).collect()),
        noise_relative: median(increments.iter().map(|of_particle| mean_and_std(&relative(of_particle)).1).collect()),
        spread: mean_and_std(&means).1,
        fit_error: (errors.len() > 1).then(|| mean_and_std(&errors).1),
        matched: f64::from(matched) / (f64::from(probe.draws) * count),
    }
}

/// ln η̂ of the fit less that of a dense lattice, for a particle that sees this scan after this motion; `None` where it is not
/// drawn from a fit.
pub fn fit_error(setup: &LapSetup, particle: &Particle<Grid>, control: &Odometry, scan: &Scan) -> Option<f64> {
    /// Steps of three quarters of a standard deviation.
    const STEPS: u32 = 6;
    let Either::Right(from_scan) = setup.proposals() else { return None };
    // No draw has a part in the fit.
    let stream = &mut Stream::at(setup.seed, Purpose::TRIAL, 0, 0);
    let ProposalTrace::Matched { mode, log_integral, .. } = from_scan.propose(particle, control, scan, stream).trace
    else {
        return None;
    };
    let (motion, likelihood) = (&from_scan.motion, &from_scan.score);
    let prior = motion.gaussian(&particle.world_from_robot, control, FROM_SCAN.motion_floor)?;
    let log_target = |pose: &Pose2| likelihood.log_score(&particle.map, pose, scan) + prior.log_density(pose);
    // Where the hill is.
    let fit = Fit::around(&mode, &FROM_SCAN.limits, log_target)?;
    Some(log_integral - Hill::summed(&fit.gaussian, STEPS, log_target)?.log_integral)
}

/// The median of these values.
///
/// # Panics
/// Without any value.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    quantile(&values, 0.5)
}

/// Mean, and standard deviation with n − 1; 0 for one value.
fn mean_and_std(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    (mean, (squares / (values.len() as f64 - 1.0).max(1.0)).sqrt())
}

#[cfg(test)]
mod tests;
