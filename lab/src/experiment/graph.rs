//! A lap as a pose graph: the log of [`LapWorld`], the same scans and the same matcher as the particle filter's, and one path.
//!
//! On the way each step is tied to the one before twice: by its wheels, and by its scan, held against a map of the last scans. Where the
//! path comes near a place of long ago, the same search holds the scan against a map of the scans of then: what it finds closes a
//! loop. How well a match knows the pose, along and across and in heading, is the fit of a Gaussian to its score
//! ([`Fit`]), as in the filter's proposal.

use super::lap::{ALPHAS, FROM_SCAN, GRID, LapSetup, LapWorld, OUTLIER};
use crate::baseline::pose_graph::{Edge, EdgeKind, GraphError, Optimizer, PoseGraph, Repair, information_of};
use crate::digest::Digest;
use fastslam::error::SettingError;
use fastslam::geometry::{Gaussian3, Pose2, align, rms};
use fastslam::map::ConditionalMap;
use fastslam::map::grid::{Grid, GridModel};
use fastslam::matching::{HillClimbSteps, ScanModel, Score as _, ScoreNear as _, hill_climb};
use fastslam::motion::{Motion as _, Odometry, OdometryModel};
use fastslam::nalgebra::{Matrix3, Vector3};
use fastslam::ops;
use fastslam::proposal::{CorrelativeSearch, Fit, FitLimits, Search, Target};
use fastslam::sensor::Scan;
use std::sync::Arc;

/// A scan is matched with a map of so many scans before it.
pub const RECENT: usize = 12;

/// Steps between two visits of a place: what is nearer in time is in the recent map, or was just before.
pub const APART: usize = 40;

/// The scans of an earlier visit: so many steps before and after the nearest one.
pub const VISIT: usize = 6;

/// How near the path must come to an earlier pose for a loop to be looked for \[m\].
const NEAR: f64 = 2.0;

/// What the drift since then may have come to, in standard deviations \[m, rad\].
const DRIFT: [f64; 2] = [0.5, 0.2];

/// A loop is closed where the score is at least so much for each hit \[nats\]: of a right match nearly all hits are on a wall.
const LEAST_SCORE: f64 = -0.75;

/// And where so many hits there are.
const LEAST_HITS: usize = 24;

/// Limits of the standard deviations of a match: along a corridor without a feature it knows nothing, and says so.
const LIMITS: FitLimits = FitLimits { least: [0.01, 0.005], most: [0.4, 0.1] };

/// The search of a loop: a lattice over the drift, and climbs from the best of it.
const SEARCH: CorrelativeSearch = CorrelativeSearch { linear: 0.2, angular: 0.06, stride: 3, climbs: 4 };

/// How the map of a match learns: as the filter's, with the distances that the lattice looks at.
const MODEL: GridModel = GridModel { distance_reach: 2, lag: 0, ..GRID };

/// Floor of the odometry's standard deviations \[m, m, rad\].
const FLOOR: [f64; 3] = FROM_SCAN.motion_floor;

/// The log of a lap on its way to a graph: a call of [`Self::step`] for each of its steps.
#[derive(Clone, Debug)]
pub struct GraphBuild {
    world: Arc<LapWorld>,
    motion: OdometryModel,
    score: ScanModel,
    /// By wheels and recent scans alone, no loop closed.
    chain: Vec<Pose2>,
    /// The same with every loop closed that was found so far: where the next one is looked for.
    bent: Vec<Pose2>,
    edges: Vec<Edge>,
}

impl GraphBuild {
    /// At the start of the lap of this setup, of which the filter's own settings make no difference.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(setup: &LapSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        Ok(Self::in_world(setup, Arc::new(setup.world())))
    }

    /// The same in a world that is there.
    pub fn in_world(setup: &LapSetup, world: Arc<LapWorld>) -> Self {
        let start = vec![world.truth[0]];
        // Wheels without any noise would leave a graph whose informations cannot be compared.
        let motion = if setup.odometry_scale > 0.0 { setup.motion() } else { OdometryModel { alphas: ALPHAS }.scaled(0.01) };
        let score = ScanModel::new(setup.matcher, setup.temper, OUTLIER);
        Self { world, motion, score, chain: start.clone(), bent: start, edges: Vec::new() }
    }

    /// The truth and the log.
    pub fn world(&self) -> &Arc<LapWorld> {
        &self.world
    }

    /// Steps that are tied in.
    pub fn step_now(&self) -> usize {
        self.chain.len() - 1
    }

    /// The next step of the log; false after the last.
    ///
    /// # Errors
    /// [`GraphError::Singular`] where a closed loop cannot be solved.
    pub fn step(&mut self) -> Result<bool, GraphError> {
        let k = self.step_now();
        let (Some(control), Some(scan)) = (self.world.controls.get(k).copied(), self.world.scans.get(k).cloned()) else {
            return Ok(false);
        };
        self.tie(k, &control)?;
        self.follow(k, &control, &scan)?;
        if self.close(k + 1, &scan)? {
            self.bend()?;
        }
        Ok(true)
    }

    /// Pose k + 1 as the wheels see it from pose k.
    fn tie(&mut self, k: usize, control: &Odometry) -> Result<(), GraphError> {
        let origin = Pose2::default();
        let covariance = self.motion.covariance(&origin, control) + floor(FLOOR);
        let i_from_j = control.apply(&origin);
        // The covariance is of (x, y) in the frame of pose k, an error in that of the measurement.
        let turned = turned(&covariance, -i_from_j.theta);
        let information = information_of(&turned, self.edges.len())?;
        self.edges.push(Edge { i: k, j: k + 1, i_from_j, information, kind: EdgeKind::Odometry });
        Ok(())
    }

    /// Puts pose k + 1 to where its scan fits the last scans, or where there is no fit, to where the wheels have it.
    fn follow(&mut self, k: usize, control: &Odometry, scan: &Scan) -> Result<(), GraphError> {
        let map = self.map(k.saturating_sub(RECENT - 1)..k + 1, &self.chain);
        let prior = self.motion.gaussian(&self.chain[k], control, FLOOR);
        let here = self.chain[k];
        let found = prior.and_then(|prior| self.fit(&map, &prior, scan, &FROM_SCAN.search, FROM_SCAN.climb));
        let pose = found.as_ref().map_or(control.apply(&here), |found| found.pose);
        if let Some(found) = found {
            self.edges.push(found.edge([k, k + 1], &here, EdgeKind::Match, self.edges.len())?);
        }
        // A loop that was closed bends what came before it, not the step to come.
        let step = here.between(&pose);
        let bent = self.bent[k].compose(&step);
        self.chain.push(pose);
        self.bent.push(bent);
        Ok(())
    }

    /// Holds the scan of pose j against those of the nearest pose of long ago. Whether they fit.
    fn close(&mut self, j: usize, scan: &Scan) -> Result<bool, GraphError> {
        let here = self.bent[j];
        let before = 0..(j + 1).saturating_sub(APART);
        let distance = |i: &usize| self.bent[*i].distance(&here);
        let Some(i) = before.min_by(|a, b| distance(a).total_cmp(&distance(b))) else { return Ok(false) };
        if distance(&i) > NEAR || scan.hits.len() < LEAST_HITS {
            return Ok(false);
        }
        let map = self.map(i.saturating_sub(VISIT)..i + VISIT + 1, &self.bent);
        let [linear, angular] = DRIFT.map(|std| std * std);
        let prior = Gaussian3::new(here, Matrix3::from_diagonal(&Vector3::new(linear, linear, angular)));
        let climb = HillClimbSteps { linear: 0.1, angular: 0.04, halvings: 3 };
        let found = prior.and_then(|prior| self.fit(&map, &prior, scan, &SEARCH, climb));
        let Some(found) = found else { return Ok(false) };
        if self.score.log_score(&map, &found.pose, scan) < LEAST_SCORE * scan.hits.len() as f64 {
            return Ok(false);
        }
        self.edges.push(found.edge([i, j], &self.bent[i], EdgeKind::Loop, self.edges.len())?);
        Ok(true)
    }

    /// Bends the path so far by all loops found so far.
    fn bend(&mut self) -> Result<(), GraphError> {
        let mut optimizer = Optimizer::new(PoseGraph::new(self.bent.clone(), self.edges.clone())?, Repair::LeastSquares);
        optimizer.run(4)?;
        self.bent = optimizer.poses().to_vec();
        Ok(())
    }

    /// A map of the scans of these steps at these poses; the start's own scans among them.
    fn map(&self, steps: core::ops::Range<usize>, poses: &[Pose2]) -> Grid {
        let mut map = Grid::new(MODEL);
        for step in steps.start..steps.end.min(poses.len()) {
            match step.checked_sub(1) {
                Some(k) => map.assimilate(&poses[step], &self.world.scans[k], &()),
                None => {
                    for (pose, scan) in &self.world.start_scans {
                        map.assimilate(pose, scan, &());
                    }
                }
            }
        }
        map
    }

    /// Where the scan fits best, and how well that is known by the scan alone.
    fn fit(
        &self,
        map: &Grid,
        prior: &Gaussian3,
        scan: &Scan,
        search: &impl Search,
        climb: HillClimbSteps,
    ) -> Option<Found> {
        let near = self.score.near(map, prior.mean(), scan, FROM_SCAN.climb_stride);
        let target = Target::new(prior, near, FROM_SCAN.minimum_improvement);
        let starts = search.starts(&target);
        let tops = starts.poses.into_iter().map(|start| hill_climb(start, climb, |pose, bar| target.log_posterior(pose, bar)));
        let top = tops.reduce(|best, end| if end.value > best.value { end } else { best })?;
        if top.value - prior.log_density(&top.pose) - starts.log_mean < FROM_SCAN.minimum_improvement {
            return None;
        }
        // The pose by scan and motion, its covariance by the scan alone: what the wheels say has an edge of its own.
        let pose = *Fit::around(&top.pose, &FROM_SCAN.limits, |pose| target.log_value(pose))?.gaussian.mean();
        let hill = Fit::around(&pose, &LIMITS, |pose| target.score().log_score(pose))?;
        Some(Found { pose, covariance: hill.gaussian.covariance() })
    }

    /// The graph of the steps so far, at the poses that no loop has bent.
    ///
    /// # Errors
    /// Those of [`PoseGraph::new`].
    pub fn graph(&self) -> Result<PoseGraph, GraphError> {
        PoseGraph::new(self.chain.clone(), self.edges.clone())
    }

    /// Bytes of the one map: what the graph keeps of each step, its pose and the end points of its scan.
    pub fn bytes(&self) -> u64 {
        let number = core::mem::size_of::<f64>();
        let of = |scan: &Scan| 2 * (scan.hits.len() + scan.misses.len()) * number;
        let scans: usize = self.world.scans[..self.step_now()].iter().chain(self.world.start_scans.iter().map(|(_, scan)| scan)).map(of).sum();
        (scans + 3 * number * self.chain.len()) as u64
    }
}

/// A match.
struct Found {
    pose: Pose2,
    /// (3 × 3, \[m², rad²\]), along the world's axes.
    covariance: Matrix3<f64>,
}

impl Found {
    fn edge(&self, [i, j]: [usize; 2], world_from_i: &Pose2, kind: EdgeKind, index: usize) -> Result<Edge, GraphError> {
        let information = information_of(&turned(&self.covariance, -self.pose.theta), index)?;
        Ok(Edge { i, j, i_from_j: world_from_i.between(&self.pose), information, kind })
    }
}

fn floor(stds: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::from(stds.map(|std| std * std)))
}

/// A covariance of (x, y, θ) with its axes turned by so much \[rad\].
fn turned(covariance: &Matrix3<f64>, angle: f64) -> Matrix3<f64> {
    let (sin, cos) = ops::sin_cos(angle);
    let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    turn * covariance * turn.transpose()
}

/// What a path is off by, and what of it is left after the best rigid motion \[m\].
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PathError {
    /// RMS error of position \[m\].
    pub rms: f64,
    /// The same after the best rigid alignment \[m\].
    pub aligned: f64,
}

impl PathError {
    /// Of a path against the truth.
    ///
    /// # Panics
    /// Where they are of different lengths.
    pub fn of(path: &[Pose2], truth: &[Pose2]) -> Self {
        let gauge = align(path, truth);
        let aligned: Vec<Pose2> = path.iter().map(|pose| gauge.compose(pose)).collect();
        Self { rms: rms(path, truth), aligned: rms(&aligned, truth) }
    }
}

/// What the graph of one lap came to.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GraphRun {
    /// Its seed.
    pub seed: u64,
    /// RMS error of position before any loop is closed \[m\].
    pub rms_before: f64,
    /// The same at the optimum \[m\].
    pub rms_after: f64,
    /// At the optimum, after the best rigid alignment \[m\].
    pub rms_after_aligned: f64,
    /// RMS error of position of raw odometry \[m\].
    pub rms_odometry: f64,
    /// Loops that were closed.
    pub loops: u32,
    /// Iterations to the optimum.
    pub iterations: u32,
    /// Bytes of poses and scans.
    pub bytes: u64,
}

/// Most iterations.
pub const ITERATIONS: u32 = 60;

impl GraphRun {
    /// Builds the graph of one lap and optimises it.
    ///
    /// # Errors
    /// Where a setting is out of its range, in words.
    pub fn of(setup: &LapSetup, repair: Repair) -> Result<Self, GraphRunError> {
        let mut build = GraphBuild::new(setup)?;
        while build.step()? {}
        let graph = build.graph()?;
        let (truth, loops) = (&build.world.truth, graph.count(EdgeKind::Loop) as u32);
        let before = PathError::of(graph.poses(), truth);
        let mut optimizer = Optimizer::new(graph, repair);
        let iterations = optimizer.run(ITERATIONS)?;
        let after = PathError::of(optimizer.poses(), truth);
        Ok(Self {
            seed: setup.seed,
            rms_before: before.rms,
            rms_after: after.rms,
            rms_after_aligned: after.aligned,
            rms_odometry: rms(&build.world.odometry, truth),
            loops,
            iterations,
            bytes: build.bytes(),
        })
    }
}

/// Why a lap has no graph.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum GraphRunError {
    /// A setting is out of its range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// Its graph cannot be solved.
    #[error(transparent)]
    Graph(#[from] GraphError),
}

/// Fingerprint of every pose and cost on the way to the optimum, bit for bit.
///
/// # Errors
/// Those of [`GraphRun::of`].
pub fn trace(setup: &LapSetup, repair: Repair) -> Result<Digest, GraphRunError> {
    let mut digest = Digest::new();
    let mut build = GraphBuild::new(setup)?;
    while build.step()? {}
    let mut optimizer = Optimizer::new(build.graph()?, repair);
    for _ in 0..ITERATIONS {
        for Pose2 { x, y, theta } in optimizer.poses() {
            [x, y, theta].into_iter().for_each(|c| digest.f64(*c));
        }
        digest.f64(optimizer.cost());
        if optimizer.step()?.converged {
            break;
        }
    }
    Ok(digest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::lap::Course;

    #[test]
    fn explore() {
        for course in [Course::Ring, Course::Apartment] {
            let mut all = Vec::new();
            for seed in 1..=20 {
                let setup = LapSetup { course, seed, ..LapSetup::default() };
                let mut build = GraphBuild::new(&setup).unwrap();
                while build.step().unwrap() {}
                let truth = &build.world.truth;
                let graph = build.graph().unwrap();
                let worst = graph.edges().iter().filter(|e| e.kind == EdgeKind::Loop).map(|e| {
                    let off = e.i_from_j.minus(&truth[e.i].between(&truth[e.j]));
                    (ops::hypot(off.x, off.y), off.z.abs(), e.chi_squared(&truth[e.i], &truth[e.j]))
                }).fold((0.0_f64, 0.0_f64, 0.0_f64), |a, b| (a.0.max(b.0), a.1.max(b.1), a.2.max(b.2)));
                let chi = |kind| {
                    let of: Vec<f64> = graph.edges().iter().filter(|e| e.kind == kind).map(|e| e.chi_squared(&truth[e.i], &truth[e.j])).collect();
                    of.iter().sum::<f64>() / of.len() as f64 / 3.0
                };
                let run = GraphRun::of(&setup, Repair::LeastSquares).unwrap();
                let others = [Repair::CAUCHY, Repair::SWITCHABLE, Repair::MAX_MIXTURE].map(|r| GraphRun::of(&setup, r).unwrap().rms_after);
                println!("{course} {seed} before {:.3} after {:.3} al {:.3} odo {:.2} loops {} it {} bytes {} worst {:.2?} chi {:.2?} others {:.3?} match {}", run.rms_before, run.rms_after, run.rms_after_aligned, run.rms_odometry, run.loops, run.iterations, run.bytes, worst, [chi(EdgeKind::Odometry), chi(EdgeKind::Match), chi(EdgeKind::Loop)], others, graph.count(EdgeKind::Match));
                all.push(run.rms_after);
            }
            println!("median {:.3}", crate::experiment::ring::median(all));
        }
    }
}
