//! What a figure shows of a lap as a graph, on its way from the log to the optimum.

use super::{GraphBuild, GraphSetup, ITERATIONS, PathError, Start, wrong_edge};
use crate::baseline::pose_graph::{Edge, EdgeKind, GraphError, Iteration, Optimizer, PoseGraph};
use crate::experiment::lap::{Lap, LapWorld};
use fastslam::error::SettingError;
use fastslam::geometry::Pose2;
use std::sync::Arc;

/// With so many of its loops closed, a path is about a decimetre from where all of them put it: enough for a first look.
pub const FIRST_LOOPS: usize = 3;

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

/// How much of a graph is solved.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Solved {
    /// Nothing.
    Not,
    /// What ties neighbours, and so many of its loops.
    InPart(usize),
    /// All of it.
    Whole,
}

/// What a figure shows of a lap as a graph: the log tied together step by step, every iteration of its optimisation, and beside it the
/// particle filter on the same log. Loops take the most time to find, so that the graph is also solved when the first of them are closed.
#[derive(Clone, Debug)]
pub struct GraphLap {
    setup: GraphSetup,
    build: GraphBuild,
    /// Of the optimisation that is under way.
    optimizer: Option<Optimizer>,
    coming: Vec<Frame>,
    /// Of the last one that has ended, from its start on.
    frames: Vec<Frame>,
    solved: Solved,
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
            return Self::in_world(setup, setup.lap.world_like(&self.setup.lap, self.build.world()));
        }
        Self::of(setup, self.build.clone(), self.universes.clone())
    }

    fn of(setup: &GraphSetup, build: GraphBuild, universes: Lap) -> Result<Self, SettingError> {
        let poses = build.world().odometry.clone();
        let error = PathError::of(&poses, &build.world().truth);
        let frames = vec![Frame { poses, cost: f64::NAN, error, wrong_weight: None }];
        let (setup, coming) = (setup.clone(), Vec::new());
        Ok(Self { setup, build, optimizer: None, coming, frames, solved: Solved::Not, universes })
    }

    /// What was asked.
    pub fn setup(&self) -> &GraphSetup {
        &self.setup
    }

    /// The truth and the log.
    pub fn world(&self) -> &LapWorld {
        self.build.world()
    }

    /// How the graph came about.
    pub fn build(&self) -> &GraphBuild {
        &self.build
    }

    /// The particle filter on the same log, as far as it is.
    pub fn universes(&self) -> &Lap {
        &self.universes
    }

    /// Every iteration, the start first. Until something is solved, the wheels' path alone, of no cost yet (not a number).
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// How much the iterations are of.
    pub fn solved(&self) -> Solved {
        self.solved
    }

    /// Whether the optimisation of the whole graph has come to its end.
    pub fn is_solved(&self) -> bool {
        self.solved == Solved::Whole
    }

    /// Steps of the log that are to be tied in, and steps at which a loop is to be looked for.
    fn left(&self) -> [usize; 2] {
        let all = self.world().controls.len();
        let searched = if self.setup.loops { self.build.searched() } else { all };
        [all - self.build.step_now(), all - searched]
    }

    /// Calls of [`Self::advance`] that are left, or about so many.
    pub fn pending(&self) -> u32 {
        let [tying, closing] = self.left();
        let solving = if self.is_solved() { 0 } else { 1 + ITERATIONS.saturating_sub(self.coming.len() as u32) };
        (tying + closing) as u32 + solving + self.universes.step_count() - self.universes.step_now()
    }

    /// A step of the log, then a loop, then an iteration, then a step of the particle filter.
    ///
    /// # Errors
    /// [`GraphError`] where the graph cannot be solved.
    pub fn advance(&mut self) -> Result<(), GraphError> {
        if self.is_solved() {
            self.universes.follow();
            return Ok(());
        }
        if self.optimizer.is_some() {
            return self.iterate();
        }
        if self.build.tie()? || self.setup.loops && self.build.close()? && !self.is_worth_a_look() {
            return Ok(());
        }
        let optimizer = Optimizer::new(self.graph()?, self.setup.repair);
        self.coming = vec![self.frame(&optimizer)];
        self.optimizer = Some(optimizer);
        Ok(())
    }

    /// Whether so many loops are closed, and no more, that what comes of them is worth a look. A false edge is judged by all loops together:
    /// with few of them it folds the path into another shape.
    fn is_worth_a_look(&self) -> bool {
        let first = self.solved == Solved::Not && self.setup.wrong.is_none() && self.left()[1] > 0;
        first && self.loops() >= FIRST_LOOPS
    }

    /// Loops that are closed.
    fn loops(&self) -> usize {
        self.build.edges().iter().filter(|edge| edge.kind == EdgeKind::Loop).count()
    }

    /// An iteration of the optimisation that is under way; after its last, all of them are there to be seen.
    fn iterate(&mut self) -> Result<(), GraphError> {
        let Some(mut optimizer) = self.optimizer.take() else { return Ok(()) };
        let Iteration { cost_before, cost_after, converged, .. } = optimizer.step()?;
        let ends = converged || self.coming.len() as u32 >= ITERATIONS;
        // The last one, which gains nothing to speak of, is none to look at.
        if !converged || cost_before - cost_after > 0.0 {
            self.coming.push(self.frame(&optimizer));
        }
        if ends {
            self.frames = core::mem::take(&mut self.coming);
            self.solved = if self.left()[1] == 0 { Solved::Whole } else { Solved::InPart(self.loops()) };
        } else {
            self.optimizer = Some(optimizer);
        }
        Ok(())
    }

    fn frame(&self, optimizer: &Optimizer) -> Frame {
        let error = PathError::of(optimizer.poses(), &self.world().truth);
        let wrong_weight = self.setup.wrong.and_then(|_| optimizer.weights().last().copied());
        Frame { poses: optimizer.poses().to_vec(), cost: optimizer.cost(), error, wrong_weight }
    }

    /// The graph as it is asked for: the log's edges, of which those of loops may be left out, and last the false one.
    ///
    /// # Errors
    /// Those of [`PoseGraph::new`].
    pub fn graph(&self) -> Result<PoseGraph, GraphError> {
        let keeps = |edge: &&Edge| self.setup.loops || edge.kind != EdgeKind::Loop;
        let mut edges: Vec<Edge> = self.build.edges().iter().filter(keeps).copied().collect();
        edges.extend(self.setup.wrong.map(wrong_edge));
        let poses = match self.setup.start {
            Start::Wheels => self.world().odometry[..self.build.chain().len()].to_vec(),
            Start::Matches => self.build.chain().to_vec(),
        };
        PoseGraph::new(poses, edges)
    }
}
