//! The graph as a deterministic state: the log tied together, every iteration, and which of them is shown.

use super::recipe::{END, GUESSES, Recipe};
use crate::told::{WEIGHED_ANEW, in_range, refused};
use crate::{
    ghost::{self, Curves},
    kept::{Computes, Runs},
    model::{Change, Declared, FigureError, Model},
    prediction::{Outcome, State},
    words::graph,
};
use fastslam::{geometry::Pose2, map::grid::Grid};
use fastslam_lab::{
    baseline::pose_graph::{Edge, EdgeKind},
    experiment::{
        graph::{Frame, GraphLap, GraphSetup, Solved},
        lap::{LapWorld, StepReport},
    },
};

/// How fast iterations are played, of the usual speed: there are few, and each moves everything.
const SLOW: f64 = 0.2;

/// The figure of the pose graph.
pub struct GraphModel {
    recipe: Recipe,
    runs: Runs<Self>,
    /// The scans at the poses of the iteration shown, and which that is.
    map: (u32, Grid),
    /// Of the run that is pinned: the error of each iteration \[m\].
    pinned: Curves,
}

impl Default for GraphModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        let shown = begin(&recipe.setup());
        let map = (0, shown.build().drawn(&shown.frames()[0].poses));
        Self { recipe, runs: Runs::new(shown), map, pinned: Curves::new() }
    }
}

fn begin(setup: &GraphSetup) -> GraphLap {
    in_range(GraphLap::new(setup))
}

impl Computes for GraphModel {
    type Run = GraphLap;
    type Setup = GraphSetup;

    fn setup(run: &GraphLap) -> &GraphSetup {
        run.setup()
    }

    fn is_begun(run: &GraphLap) -> bool {
        run.solved() > Solved::Not
    }

    fn is_worth_keeping(run: &GraphLap) -> bool {
        run.is_solved()
    }
}

fn advance(lap: &mut GraphLap) {
    lap.advance().unwrap_or_else(|error| unreachable!("odometry ties all poses of a lap: {error}"));
}

impl GraphModel {
    /// What decides the numbers of what is shown.
    pub fn setup(&self) -> &GraphSetup {
        self.runs.shown().setup()
    }

    /// The graph, and the particle filter as far as it is.
    pub fn graph(&self) -> &GraphLap {
        self.runs.shown()
    }

    /// The truth and the log.
    pub fn world(&self) -> &LapWorld {
        self.runs.shown().world()
    }

    /// Every iteration, the start first; that alone while the reader is asked what comes of it.
    pub fn frames(&self) -> &[Frame] {
        let all = self.runs.shown().frames();
        if self.hides() { &all[..1] } else { all }
    }

    /// How far the reader's prediction is.
    pub fn state(&self) -> State {
        self.recipe.prediction.state()
    }

    /// Whether nothing of the iterations is to be seen yet.
    pub fn hides(&self) -> bool {
        self.recipe.prediction.hides()
    }

    /// RMS error of position at the last iteration \[m\]; nothing before that.
    pub fn end(&self) -> Option<f64> {
        self.runs.shown().frames().last().filter(|_| self.runs.shown().is_solved()).map(|frame| frame.error.rms)
    }

    /// Places a guess \[m\], or the nearest that there can be.
    pub fn guess_at(&mut self, error: f64) {
        if error.is_finite() {
            let error = (100.0 * error).round().clamp(100.0 * GUESSES[0], 100.0 * GUESSES[1]) / 100.0;
            self.change(|recipe| recipe.prediction.place(Some(error)));
        }
    }

    /// The iteration shown.
    pub fn frame(&self) -> &Frame {
        &self.frames()[self.step() as usize]
    }

    /// The poses of the iteration shown.
    pub fn poses(&self) -> &[Pose2] {
        &self.frame().poses
    }

    /// The scans at these poses.
    pub fn map(&self) -> &Grid {
        &self.map.1
    }

    /// The edges of the log, of the kind, that are in what is solved.
    pub fn edges(&self, kind: EdgeKind) -> impl Iterator<Item = &Edge> {
        let most = match (kind, self.graph().solved()) {
            (EdgeKind::Loop, _) if !self.setup().loops => 0,
            (EdgeKind::Loop, Solved::InPart(loops)) => loops,
            _ => usize::MAX,
        };
        self.graph().build().edges().iter().filter(move |edge| edge.kind == kind).take(most)
    }

    /// The particle filter at the end of the log; `None` while it is under way.
    pub fn universes(&self) -> Option<&StepReport> {
        let lap = self.runs.shown().universes();
        (lap.report().step == lap.step_count()).then(|| lap.report())
    }

    /// Whether the last iteration is shown.
    pub fn at_end(&self) -> bool {
        !self.hides() && self.runs.shown().is_solved() && self.step() == self.step_count()
    }

    /// Whether the building is drawn as it is.
    pub fn shows_truth(&self) -> bool {
        self.recipe.truth
    }

    /// Errors of the run that is pinned \[m\], by iteration.
    pub fn pinned(&self) -> &[f64] {
        if self.hides() { &[] } else { ghost::curve(&self.pinned, 0) }
    }

    /// Maps the scans anew if other poses are shown.
    fn place(&mut self, anew: bool) {
        let step = self.step();
        if anew || self.map.0 != step {
            self.map = (step, self.runs.shown().build().drawn(self.poses()));
        }
    }
}

impl Declared for GraphModel {
    type Recipe = Recipe;
    const TITLE: &'static str = graph::TITLE;
    const CHANGES: &'static [Change] = &[WEIGHED_ANEW, Change::Opens];
    const UNSAID: usize = 2;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        let setup = recipe.setup();
        // Of the same log, whichever is further: a graph that is not tied together yet need not be begun again.
        let of_this_log = |run: &GraphLap| run.setup().lap == setup.lap;
        let shows = self.runs.ask(&setup, of_this_log, |nearest| nearest.asked(&setup).map_err(refused))?;
        self.recipe = recipe;
        self.place(shows);
        Ok(())
    }
}

impl Model for GraphModel {
    /// Who asks for the last iteration stays at the end when that moves.
    fn seek(&mut self, step: u32) {
        if !self.hides() {
            self.recipe.step = if step >= self.step_count() { END } else { step };
            self.place(false);
        }
    }

    fn step_count(&self) -> u32 {
        self.frames().len() as u32 - 1
    }

    fn step(&self) -> u32 {
        self.recipe.step.min(self.step_count())
    }

    fn telling(&self) -> u32 {
        END
    }

    fn watch(&self) -> Option<(u32, &'static str)> {
        Some((0, graph::watch()))
    }

    fn pending(&self) -> u32 {
        self.runs.asked().pending()
    }

    fn work(&mut self) {
        if self.pending() == 0 {
            return;
        }
        let solved = self.runs.shown().solved();
        advance(self.runs.asked_mut());
        if self.runs.show_if(Self::is_begun) || self.runs.shown().solved() != solved {
            self.place(true);
        }
    }

    /// First the graph with some of its loops closed, then with all of them, and beside it the particle filter.
    fn answer(&self) -> u32 {
        match self.graph().solved() {
            Solved::InPart(_) if self.runs.refines() => 1,
            Solved::Whole if self.runs.refines() => 2,
            _ => 0,
        }
    }

    fn pace(&self) -> f64 {
        SLOW
    }

    fn prediction(&self) -> Option<Outcome> {
        self.recipe.prediction.outcome("rms_end", self.end())
    }

    /// Of the whole graph only: what it comes to by some of its loops is no difference between two settings.
    fn compared(&self) -> Vec<&'static str> {
        if self.graph().is_solved() { vec!["rms", "cost", "wrong_weight"] } else { Vec::new() }
    }

    fn curves(&self) -> Curves {
        vec![self.frames().iter().map(|frame| frame.error.rms).collect()]
    }

    fn haunt(&mut self, pinned: Curves) {
        self.pinned = pinned;
    }
}
