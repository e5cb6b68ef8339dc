//! `fastslam-lab lap --method graph`: the same log as a pose graph.

use crate::{Usage, in_file, print, print_json};
use anyhow::{Context, Result};
use fastslam_lab::baseline::pose_graph::{EdgeKind, GraphError, Optimizer, PoseGraph, Repair, g2o};
use fastslam_lab::experiment::graph::{GraphBuild, ITERATIONS, PathError};
use fastslam_lab::experiment::lap::LapSetup;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// How a lap becomes a path and a map.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub enum Method {
    /// The particle filter
    Particles,
    /// A pose graph of the same log: one path, bent until its edges fit
    Graph,
}

/// How edges that close loops are judged.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub enum Judged {
    /// Least squares
    Squares,
    /// Cauchy's robust kernel
    Robust,
    /// Switchable constraints
    Switchable,
    /// Max-mixtures with a null component
    Mixture,
}

impl Judged {
    fn repair(self) -> Repair {
        match self {
            Self::Squares => Repair::LeastSquares,
            Self::Robust => Repair::CAUCHY,
            Self::Switchable => Repair::SWITCHABLE,
            Self::Mixture => Repair::MAX_MIXTURE,
        }
    }
}

/// What can be asked of a graph.
#[derive(clap::Args)]
pub struct GraphOptions {
    /// What makes a path and a map of the log
    #[arg(long, value_enum, default_value_t = Method::Particles)]
    pub method: Method,
    /// With --method graph: how edges that close loops are judged
    #[arg(long, value_enum, default_value_t = Judged::Squares)]
    repair: Judged,
    /// With --method graph: write the graph as it was before any loop was closed, in the format of g2o
    #[arg(long, value_name = "FILE")]
    g2o: Option<PathBuf>,
    /// With --method graph: optimise the graph of this file, in the format of g2o, instead of that of a lap
    #[arg(long, value_name = "FILE")]
    from_g2o: Option<PathBuf>,
}

impl GraphOptions {
    /// # Errors
    /// Where something is asked of a graph and there is none.
    pub fn only_of_graphs(&self) -> Result<()> {
        let asked = self.repair != Judged::Squares || self.g2o.is_some() || self.from_g2o.is_some();
        if asked {
            anyhow::bail!(Usage("--repair, --g2o and --from-g2o need --method graph".into()));
        }
        Ok(())
    }
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output {
    poses: usize,
    odometry_edges: usize,
    match_edges: usize,
    loop_edges: usize,
    /// \[nats\]
    cost_before: f64,
    /// \[nats\]
    cost_after: f64,
    iterations: u32,
    /// Before any loop is closed \[m\]; of a file there is no truth.
    before: Option<PathError>,
    /// At the optimum \[m\].
    after: Option<PathError>,
    /// Of the graph's poses and scans.
    bytes: Option<u64>,
    /// Poses at the optimum \[m, m, rad\].
    path: Vec<[f64; 3]>,
}

/// Runs the command.
pub fn run(setup: &LapSetup, options: &GraphOptions, as_json: bool) -> Result<()> {
    let (graph, build) = match &options.from_g2o {
        Some(path) => (read(path)?, None),
        None => {
            let build = built(setup)?;
            (build.graph()?, Some(build))
        }
    };
    if let Some(path) = &options.g2o {
        std::fs::write(path, g2o::write(&graph)).with_context(in_file(path))?;
    }
    let [odometry_edges, match_edges, loop_edges] =
        [EdgeKind::Odometry, EdgeKind::Match, EdgeKind::Loop].map(|kind| graph.count(kind));
    let error = |poses: &[_]| build.as_ref().map(|build| PathError::of(poses, &build.world().truth));
    let before = error(graph.poses());
    let mut optimizer = Optimizer::new(graph, options.repair.repair());
    let cost_before = optimizer.cost();
    let iterations = optimizer.run(ITERATIONS)?;
    let output = Output {
        poses: optimizer.poses().len(),
        odometry_edges,
        match_edges,
        loop_edges,
        cost_before,
        cost_after: optimizer.cost(),
        iterations,
        before,
        after: error(optimizer.poses()),
        bytes: build.as_ref().map(GraphBuild::bytes),
        path: optimizer.poses().iter().map(|pose| [pose.x, pose.y, pose.theta]).collect(),
    };
    if as_json { print_json(&output) } else { print(&summary(&output)) }
}

fn built(setup: &LapSetup) -> Result<GraphBuild> {
    let mut build = GraphBuild::new(setup)?;
    while build.step()? {}
    Ok(build)
}

fn read(path: &Path) -> Result<PoseGraph> {
    let text = std::fs::read_to_string(path).with_context(in_file(path))?;
    g2o::read(&text).map_err(|error| match error {
        g2o::G2oError::Graph(GraphError::NoPoses) => Usage::of_file(path, "no VERTEX_SE2 in it").into(),
        error => Usage::of_file(path, error).into(),
    })
}

fn summary(output: &Output) -> String {
    let Output { poses, odometry_edges, match_edges, loop_edges, cost_before, cost_after, iterations, .. } = output;
    let mut text = format!(
        "a graph of {poses} poses: {odometry_edges} odometry edges, {match_edges} matches, {loop_edges} loops\n\
         cost before                       {cost_before:10.1}\n\
         cost after {iterations:3} iterations         {cost_after:10.1}\n"
    );
    if let (Some(before), Some(after), Some(bytes)) = (output.before, output.after, output.bytes) {
        text += &format!(
            "RMS position error before         {:10.3} m\n\
             RMS position error after          {:10.3} m\n\
             the same after rigid alignment    {:10.3} m\n\
             poses and scans                   {:10.1} kB\n",
            before.rms,
            after.rms,
            after.aligned,
            bytes as f64 / 1e3
        );
    }
    text
}
