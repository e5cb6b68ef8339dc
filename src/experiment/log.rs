//! A recorded log, mapped: the filter of the lap on what a real robot drove and saw.

use crate::digest::Digest;
use crate::error::ParameterError;
use crate::execute::Executor;
use crate::geometry::Pose2;
use crate::log::{LaserLog, LaserScan};
use crate::map::grid::{Grid, GridModel};
use crate::map::{ConditionalMap, Footprint};
use crate::matching::{ClimbSteps, Matcher, ScanModel};
use crate::motion::{Odometry, OdometryModel};
use crate::ops;
use crate::proposal::{FromMotion, FromScan, FromScanSettings, ProposalTrace};
use crate::rbpf::{Particle, Rbpf};
use crate::resampling::{ResamplePolicy, Scheme};
use crate::sensor::Scan;
use std::sync::Arc;

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct LogSetup {
    /// Number of particles M, 1 to 4096.
    pub particles: usize,
    /// Seed of the filter's draws.
    pub seed: u64,
    /// Side of a cell \[m\], 0.01 to 1.
    pub cell_size: f64,
    /// Ranges beyond this \[m\] are not used, 0.1 to 1000.
    pub max_range: f64,
    /// A scan is passed over until the robot has driven this far \[m\], or turned by as many radians, 0 to 10.
    pub min_travel: f64,
    /// When the particles are resampled.
    pub policy: ResamplePolicy,
}

impl Default for LogSetup {
    fn default() -> Self {
        Self {
            particles: 16,
            seed: 1,
            cell_size: 0.05,
            max_range: 30.0,
            min_travel: 0.0,
            policy: ResamplePolicy::EssBelow(0.5),
        }
    }
}

pub fn knob(name: &str, default: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

/// One step.
#[derive(Clone, Debug)]
pub struct LogStep {
    pub step: u32,
    pub ess: f64,
    pub resampled: bool,
    pub matched: u32,
}

pub type Filter = Rbpf<Grid, FromScan>;

/// A log under way.
pub struct LogRun {
    log: Arc<LaserLog>,
    /// Numbers of the scans that the filter takes, the first included.
    used: Vec<u32>,
    setup: LogSetup,
    no_return: f64,
    filter: Filter,
    step: usize,
    resampled: u32,
}

impl LogRun {
    pub fn new(setup: &LogSetup, log: Arc<LaserLog>) -> Result<Self, ParameterError> {
        let far = log.scans.iter().flat_map(|scan| &scan.ranges).copied().filter(|r| r.is_finite()).fold(0.0, f32::max);
        let no_return = 0.99 * f64::from(far);
        let used: Vec<u32> = (0..log.scans.len() as u32).collect();
        let model = GridModel {
            cell_size: setup.cell_size,
            log_odds_hit: knob("HIT", 0.9),
            log_odds_pass: knob("PASS", -0.4),
            surface_std: knob("SURF", 0.03),
        };
        let mut map = Grid::new(model);
        map.assimilate(&Pose2::default(), &end_points(&log.scans[0], no_return, setup.max_range), &());
        let motion = OdometryModel { alphas: [knob("A1", 0.04), knob("A2", 0.01), knob("A3", 0.01), knob("A4", 0.01)] };
        let likelihood = ScanModel::new(Matcher::SubCell, knob("TEMPER", 0.2), knob("OUTLIER", 0.05));
        let settings = FromScanSettings {
            motion_floor: [0.02, 0.02, 0.01],
            climb: ClimbSteps { linear: knob("LIN", 0.08), angular: knob("ANG", 0.04), halvings: 4 },
            climb_stride: 2,
            seeds: 8,
            gain: 0.5,
            probes: 12,
            probe_stds: [[0.005, 0.005, 0.003], [0.05, 0.05, 0.03]],
        };
        let proposal = FromScan { fallback: FromMotion { motion, likelihood }, settings };
        let filter =
            Rbpf::new(proposal, setup.policy, Scheme::Systematic, setup.seed, setup.particles, Pose2::default(), map);
        Ok(Self { log, used, setup: setup.clone(), no_return, filter, step: 0, resampled: 0 })
    }

    /// The same run, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { filter: self.filter.with_executor(executor), ..self }
    }

    pub fn step_count(&self) -> u32 {
        self.used.len() as u32 - 1
    }

    pub fn step(&mut self) -> Option<LogStep> {
        let to = &self.log.scans[*self.used.get(self.step + 1)? as usize];
        let from = &self.log.scans[self.used[self.step] as usize];
        let control = Odometry::between(&from.odometry, &to.odometry);
        let scan = end_points(to, self.no_return, self.setup.max_range);
        let report = self.filter.step(&control, &scan);
        self.step += 1;
        let resampled = report.ancestors.is_some();
        self.resampled += u32::from(resampled);
        Some(LogStep {
            step: report.step,
            ess: report.ess,
            resampled,
            matched: report.traces.iter().filter(|t| matches!(t, ProposalTrace::Matched { .. })).count() as u32,
        })
    }

    pub fn particles(&self) -> &[Particle<Grid>] {
        self.filter.particles()
    }

    pub fn filter(&self) -> &Filter {
        &self.filter
    }

    pub fn map(&self) -> &Grid {
        &self.particles()[self.filter.best()].map
    }

    pub fn resampled(&self) -> u32 {
        self.resampled
    }

    pub fn footprint(&self) -> Footprint {
        Grid::footprint(self.particles().iter().map(|p| &p.map))
    }

    /// The best particle's path: time \[s\] and pose.
    pub fn path(&self) -> Vec<(f64, Pose2)> {
        let path = self.filter.ancestry().path(self.particles()[self.filter.best()].node);
        path.iter().zip(&self.used).map(|(pose, k)| (self.log.scans[*k as usize].time, *pose)).collect()
    }

    pub fn digest(&self) -> Digest {
        let mut digest = Digest::new();
        self.filter.weights().as_slice().iter().for_each(|w| digest.f64(*w));
        for particle in self.particles() {
            for pose in self.filter.ancestry().path(particle.node) {
                [pose.x, pose.y, pose.theta].into_iter().for_each(|x| digest.f64(x));
            }
        }
        digest
    }
}

fn end_points(scan: &LaserScan, no_return: f64, max_range: f64) -> Scan {
    let mut ends = Scan::default();
    for (k, range) in scan.ranges.iter().enumerate() {
        let range = f64::from(*range);
        if !(range > 0.0 && range < no_return) {
            continue;
        }
        let (sin, cos) = ops::sin_cos(scan.first_angle + k as f64 * scan.angle_step);
        let length = range.min(max_range);
        let end = scan.robot_from_laser.transform([length * cos, length * sin]);
        if range < max_range { ends.hits.push(end) } else { ends.misses.push(end) }
    }
    ends
}
