//! A lap as a pose graph: the log of [`LapWorld`], the same scans and the same matcher as the particle filter's, and one path.
//!
//! On the way each step is tied to the one before twice: by its wheels, and by its scan, held against a map of the last scans. Where the
//! path comes near a place of long ago, the same search holds the scan against a map of the scans of then: what it finds closes a
//! loop. How well a match knows the pose, along and across and in heading, is the fit of a Gaussian to its score
//! ([`Fit`]), as in the filter's proposal.

use super::lap::{ALPHAS, FROM_SCAN, GRID, Lap, LapSetup, LapWorld, OUTLIER};
use crate::baseline::pose_graph::{
    Edge, EdgeKind, GraphError, Iteration, Optimizer, PoseGraph, Repair, information_of,
};
use crate::digest::Digest;
use fastslam::error::{Range, SettingError};
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
const SEARCH: CorrelativeSearch = CorrelativeSearch { linear: 0.2, angular: 0.06, most_steps: 8, stride: 3, climbs: 4 };

/// Side of a cell of the map that is drawn \[m\].
pub const DRAWN: f64 = 0.15;

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
        let motion =
            if setup.odometry_scale > 0.0 { setup.motion() } else { OdometryModel { alphas: ALPHAS }.scaled(0.01) };
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
        let (Some(control), Some(scan)) = (self.world.controls.get(k).copied(), self.world.scans.get(k).cloned())
        else {
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
        let mut optimizer =
            Optimizer::new(PoseGraph::new(self.bent.clone(), self.edges.clone())?, Repair::LeastSquares);
        optimizer.run(4)?;
        self.bent = optimizer.poses().to_vec();
        Ok(())
    }

    /// The map of all scans at these poses, in cells so fine that a reader sees what is smeared.
    ///
    /// # Panics
    /// Where there are more poses than steps.
    pub fn drawn(&self, poses: &[Pose2]) -> Grid {
        self.map_in(GridModel { cell_size: DRAWN, ..MODEL }, 0..poses.len(), poses)
    }

    /// A map of the scans of these steps at these poses; the start's own scans among them.
    fn map(&self, steps: core::ops::Range<usize>, poses: &[Pose2]) -> Grid {
        self.map_in(MODEL, steps, poses)
    }

    fn map_in(&self, model: GridModel, steps: core::ops::Range<usize>, poses: &[Pose2]) -> Grid {
        let mut map = Grid::new(model);
        for (step, pose) in poses.iter().enumerate().take(steps.end).skip(steps.start) {
            match step.checked_sub(1) {
                Some(k) => map.assimilate(pose, &self.world.scans[k], &()),
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
        let tops =
            starts.poses.into_iter().map(|start| hill_climb(start, climb, |pose, bar| target.log_posterior(pose, bar)));
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

    /// Where wheels and the matches of recent scans lead, before any loop is closed.
    pub fn chain(&self) -> &[Pose2] {
        &self.chain
    }

    /// The edges so far.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Bytes of the one map: what the graph keeps of each step, its pose and the end points of its scan.
    pub fn bytes(&self) -> u64 {
        let number = core::mem::size_of::<f64>();
        let of = |scan: &Scan| 2 * (scan.hits.len() + scan.misses.len()) * number;
        let scans: usize = self.world.scans[..self.step_now()]
            .iter()
            .chain(self.world.start_scans.iter().map(|(_, scan)| scan))
            .map(of)
            .sum();
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

/// Where an optimisation starts.
#[derive(
    Clone,
    Copy,
    PartialEq,
    Eq,
    Debug,
    Default,
    strum::Display,
    strum::EnumString,
    strum::VariantNames,
    strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_start)]
pub enum Start {
    /// Where the wheels alone lead.
    #[default]
    Wheels,
    /// Where wheels and the matches of recent scans lead, before any loop is closed.
    Matches,
}

fn unknown_start(given: &str) -> SettingError {
    SettingError::unknown_word("start", given, <Start as strum::VariantNames>::VARIANTS)
}

/// What is asked of the graph of a lap.
#[derive(Clone, PartialEq, Debug)]
pub struct GraphSetup {
    /// The lap, and the particle filter that it is compared with.
    pub lap: LapSetup,
    /// Where the optimisation starts.
    pub start: Start,
    /// How edges that close loops are judged.
    pub repair: Repair,
    /// Whether the edges that close loops are there.
    pub loops: bool,
    /// A false edge: it says that the second of these poses is where the first one is, with the same heading.
    pub wrong: Option<[usize; 2]>,
}

impl Default for GraphSetup {
    /// The ring, from the wheels' path.
    fn default() -> Self {
        let lap = LapSetup { course: super::lap::Course::Ring, ..LapSetup::default() };
        Self { lap, start: Start::Wheels, repair: Repair::LeastSquares, loops: true, wrong: None }
    }
}

impl GraphSetup {
    /// What its figure opens with: wheels that drift by some metres, so that the ring they draw is bent and can still be seen to be one.
    pub fn opening() -> Self {
        let lap = LapSetup { seed: 5, odometry_scale: 0.5, ..Self::default().lap };
        Self { lap, ..Self::default() }
    }
}

/// The poses that the figure's false edge says are one: in the ring's corridor below the block, and in the one above it.
pub const FALSE_EDGE: [usize; 2] = [14, 52];

/// Standard deviations of a false edge \[m, m, rad\]: as sure of itself as a match is.
pub const WRONG_STDS: [f64; 3] = [0.05, 0.05, 0.02];

/// The graph at one iteration.
#[derive(Clone, PartialEq, Debug)]
pub struct Frame {
    /// Every pose.
    pub poses: Vec<Pose2>,
    /// F \[nats\].
    pub cost: f64,
    /// Against the truth.
    pub error: PathError,
    /// The share of the false edge's information that pulls, where there is one.
    pub wrong_weight: Option<f64>,
}

/// What a figure shows of a lap as a graph: the log tied together step by step, every iteration of its optimisation, and beside it the
/// particle filter on the same log.
#[derive(Clone, Debug)]
pub struct GraphLap {
    setup: GraphSetup,
    build: GraphBuild,
    optimizer: Option<Optimizer>,
    /// From the start of the optimisation to its end, or as far as it is.
    frames: Vec<Frame>,
    solved: bool,
    universes: Lap,
}

impl GraphLap {
    /// At the start of the log.
    ///
    /// # Errors
    /// Where a setting is out of its range, or a false edge leads nowhere.
    pub fn new(setup: &GraphSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        Self::in_world(setup, Arc::new(setup.lap.world()))
    }

    fn in_world(setup: &GraphSetup, world: Arc<LapWorld>) -> Result<Self, SettingError> {
        let build = GraphBuild::in_world(&setup.lap, Arc::clone(&world));
        Self::of(setup, build, Lap::in_world(&setup.lap, world)?)
    }

    /// Another question about the same log: nothing but the optimisation begins anew.
    ///
    /// # Errors
    /// Where a setting is out of its range, or a false edge leads nowhere.
    pub fn asked(&self, setup: &GraphSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        if setup.lap != self.setup.lap {
            return Self::in_world(setup, setup.lap.world_like(&self.setup.lap, &self.build.world));
        }
        Self::of(setup, self.build.clone(), self.universes.clone())
    }

    fn of(setup: &GraphSetup, build: GraphBuild, universes: Lap) -> Result<Self, SettingError> {
        let poses = build.world.odometry.clone();
        let error = PathError::of(&poses, &build.world.truth);
        let frames = vec![Frame { poses, cost: f64::NAN, error, wrong_weight: None }];
        Ok(Self { setup: setup.clone(), build, optimizer: None, frames, solved: false, universes })
    }

    /// What was asked.
    pub fn setup(&self) -> &GraphSetup {
        &self.setup
    }

    /// The truth and the log.
    pub fn world(&self) -> &LapWorld {
        &self.build.world
    }

    /// How the graph came about.
    pub fn build(&self) -> &GraphBuild {
        &self.build
    }

    /// The particle filter on the same log, as far as it is.
    pub fn universes(&self) -> &Lap {
        &self.universes
    }

    /// Every iteration so far, the start first. Until the log is tied together, the wheels' path alone, of no cost yet (not a number).
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Whether the optimisation has come to its end.
    pub fn is_solved(&self) -> bool {
        self.solved
    }

    /// Calls of [`Self::advance`] that are left, or about so many.
    pub fn pending(&self) -> u32 {
        let left = self.world().controls.len() - self.build.step_now();
        let solving = if self.solved { 0 } else { 1 + ITERATIONS.saturating_sub(self.frames.len() as u32) };
        left as u32 + solving + self.universes.step_count() - self.universes.report().step
    }

    /// A step of the log, then an iteration, then a step of the particle filter.
    ///
    /// # Errors
    /// [`GraphError`] where the graph cannot be solved.
    pub fn advance(&mut self) -> Result<(), GraphError> {
        if self.build.step_now() < self.world().controls.len() {
            return self.build.step().map(drop);
        }
        if self.solved {
            self.universes.step();
            return Ok(());
        }
        match &mut self.optimizer {
            None => {
                self.frames.clear();
                self.optimizer = Some(Optimizer::new(self.graph()?, self.setup.repair));
            }
            Some(optimizer) => {
                let Iteration { cost_before, cost_after, converged, .. } = optimizer.step()?;
                // The last one, which gains nothing to speak of, is none to look at.
                self.solved = converged || self.frames.len() as u32 >= ITERATIONS;
                if converged && cost_before - cost_after <= 0.0 {
                    return Ok(());
                }
            }
        }
        if let Some(optimizer) = &self.optimizer {
            let error = PathError::of(optimizer.poses(), &self.world().truth);
            let wrong_weight = self.setup.wrong.and_then(|_| optimizer.weights().last().copied());
            self.frames.push(Frame { poses: optimizer.poses().to_vec(), cost: optimizer.cost(), error, wrong_weight });
        }
        Ok(())
    }

    /// The graph as it is asked for: the log's edges, of which those of loops may be left out, and last the false one.
    ///
    /// # Errors
    /// Those of [`PoseGraph::new`].
    pub fn graph(&self) -> Result<PoseGraph, GraphError> {
        let keeps = |edge: &&Edge| self.setup.loops || edge.kind != EdgeKind::Loop;
        let mut edges: Vec<Edge> = self.build.edges.iter().filter(keeps).copied().collect();
        edges.extend(self.setup.wrong.map(wrong_edge));
        let poses = match self.setup.start {
            Start::Wheels => self.world().odometry[..self.build.chain.len()].to_vec(),
            Start::Matches => self.build.chain.clone(),
        };
        PoseGraph::new(poses, edges)
    }
}

impl GraphSetup {
    /// # Errors
    /// Where a setting is out of its range, or a false edge leads nowhere.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.lap.validate()?;
        self.repair.validate()?;
        for end in self.wrong.into_iter().flatten() {
            Range::whole(0, self.lap.course.steps() as u32).check("wrong", end as f64)?;
        }
        match self.wrong {
            Some([i, j]) if i == j => Err(SettingError::Unfit { field: "wrong", allowed: "two different poses" }),
            _ => Ok(()),
        }
    }
}

/// The edge that says that two poses are one.
pub fn wrong_edge([i, j]: [usize; 2]) -> Edge {
    let information = Matrix3::from_diagonal(&Vector3::from(WRONG_STDS.map(|std| 1.0 / (std * std))));
    Edge { i, j, i_from_j: Pose2::default(), information, kind: EdgeKind::Loop }
}

#[cfg(test)]
mod tests;
