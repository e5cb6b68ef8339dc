//! The log of a lap on its way to a graph: what ties a step to the one before, and what closes a loop.

use crate::baseline::pose_graph::{Edge, EdgeKind, GraphError, Optimizer, PoseGraph, Repair, information_of};
use crate::experiment::lap::{ALPHAS, FROM_SCAN, GRID, LapSetup, LapWorld, OUTLIER};
use fastslam::error::SettingError;
use fastslam::geometry::{Gaussian3, Pose2};
use fastslam::map::ConditionalMap;
use fastslam::map::grid::{Grid, GridModel};
use fastslam::matching::{HillClimbSteps, ScanModel, Score as _, ScoreNear, hill_climb};
use fastslam::motion::{Motion as _, Odometry, OdometryModel};
use fastslam::nalgebra::{Matrix3, Vector3};
use fastslam::ops;
use fastslam::proposal::{CorrelativeSearch, Fit, FitLimits, Search, Starts, Target};
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

/// The log of a lap on its way to a graph: a call of [`Self::step`] for each of its steps. Loops can also be closed later than steps are
/// tied in, as no step depends on them: what comes of it is the same.
#[derive(Clone, Debug)]
pub struct GraphBuild {
    world: Arc<LapWorld>,
    motion: OdometryModel,
    score: ScanModel,
    /// By wheels and recent scans alone, no loop closed.
    chain: Vec<Pose2>,
    /// The same with every loop closed that was found so far: where the next one is looked for.
    bent: Vec<Pose2>,
    /// By the pose that is measured.
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

    /// Steps at which a loop was looked for.
    pub fn searched(&self) -> usize {
        self.bent.len() - 1
    }

    /// The next step of the log, and its loop; false after the last.
    ///
    /// # Errors
    /// [`GraphError::Singular`] where a closed loop cannot be solved.
    pub fn step(&mut self) -> Result<bool, GraphError> {
        let tied = self.tie()?;
        Ok(self.close()? || tied)
    }

    /// Ties the next step of the log to the one before it; false after the last.
    ///
    /// # Errors
    /// [`GraphError::NotPositiveDefinite`] where the noise of the wheels leaves nothing that could be measured.
    pub fn tie(&mut self) -> Result<bool, GraphError> {
        let k = self.step_now();
        let (Some(control), Some(scan)) = (self.world.controls.get(k).copied(), self.world.scans.get(k).cloned())
        else {
            return Ok(false);
        };
        self.roll(k, &control)?;
        self.follow(k, &control, &scan)?;
        Ok(true)
    }

    /// Looks for a loop at the next of the steps that are tied in, and closes it; false after the last of them.
    ///
    /// # Errors
    /// [`GraphError::Singular`] where a closed loop cannot be solved.
    pub fn close(&mut self) -> Result<bool, GraphError> {
        let k = self.searched();
        let [Some(here), Some(next)] = [k, k + 1].map(|pose| self.chain.get(pose)) else { return Ok(false) };
        // A loop that was closed bends what came before it, not the step to come.
        let next = self.bent[k].compose(&here.between(next));
        self.bent.push(next);
        if let Some(edge) = self.find(k + 1)? {
            let so_far = self.edges.partition_point(|other| other.j <= edge.j);
            self.edges.insert(so_far, edge);
            self.bend(so_far + 1)?;
        }
        Ok(true)
    }

    /// Pose k + 1 as the wheels see it from pose k.
    fn roll(&mut self, k: usize, control: &Odometry) -> Result<(), GraphError> {
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
        self.chain.push(pose);
        Ok(())
    }

    /// Holds the scan of pose j against those of the nearest pose of long ago: the edge between the two, where they fit.
    fn find(&self, j: usize) -> Result<Option<Edge>, GraphError> {
        let (here, scan) = (self.bent[j], &self.world.scans[j - 1]);
        let before = 0..(j + 1).saturating_sub(APART);
        let distance = |i: &usize| self.bent[*i].distance(&here);
        let Some(i) = before.min_by(|a, b| distance(a).total_cmp(&distance(b))) else { return Ok(None) };
        if distance(&i) > NEAR || scan.hits.len() < LEAST_HITS {
            return Ok(None);
        }
        let map = self.map(i.saturating_sub(VISIT)..i + VISIT + 1, &self.bent);
        let [linear, angular] = DRIFT.map(|std| std * std);
        let prior = Gaussian3::new(here, Matrix3::from_diagonal(&Vector3::new(linear, linear, angular)));
        let climb = HillClimbSteps { linear: 0.1, angular: 0.04, halvings: 3 };
        let found = prior.and_then(|prior| self.fit(&map, &prior, scan, &SEARCH, climb));
        let least = LEAST_SCORE * scan.hits.len() as f64;
        let found = found.filter(|found| self.score.log_score(&map, &found.pose, scan) >= least);
        found.map(|found| found.edge([i, j], &self.bent[i], EdgeKind::Loop, self.edges.len())).transpose()
    }

    /// Bends the path so far by the first so many edges.
    fn bend(&mut self, edges: usize) -> Result<(), GraphError> {
        let graph = PoseGraph::new(self.bent.clone(), self.edges[..edges].to_vec())?;
        let mut optimizer = Optimizer::new(graph, Repair::LeastSquares);
        optimizer.run(4)?;
        self.bent = optimizer.poses().to_vec();
        Ok(())
    }

    /// The map of all scans at these poses, in cells so fine that a reader sees what is smeared.
    ///
    /// # Panics
    /// Where there are more poses than steps.
    pub fn drawn(&self, poses: &[Pose2]) -> Grid {
        self.map_in(GridModel { cell_size: DRAWN, distance_reach: 0, ..MODEL }, 0..poses.len(), poses)
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
        Found::from(search.starts(&target), climb, prior, &target)
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
    /// Where the climbs from these starts lead.
    #[inline(never)] // a program has it once, however it searches
    fn from(
        starts: Starts,
        climb: HillClimbSteps,
        prior: &Gaussian3,
        target: &Target<'_, impl ScoreNear>,
    ) -> Option<Self> {
        let tops =
            starts.poses.into_iter().map(|start| hill_climb(start, climb, |pose, bar| target.log_posterior(pose, bar)));
        let top = tops.reduce(|best, end| if end.value > best.value { end } else { best })?;
        if top.value - prior.log_density(&top.pose) - starts.log_mean < FROM_SCAN.minimum_improvement {
            return None;
        }
        // The pose by scan and motion, its covariance by the scan alone: what the wheels say has an edge of its own.
        let pose = *Fit::around(&top.pose, &FROM_SCAN.limits, |pose| target.log_value(pose))?.gaussian.mean();
        let hill = Fit::around(&pose, &LIMITS, |pose| target.score().log_score(pose))?;
        Some(Self { pose, covariance: hill.gaussian.covariance() })
    }

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
