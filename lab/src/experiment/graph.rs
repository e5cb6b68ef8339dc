//! A lap as a pose graph: the log of [`LapWorld`](super::lap::LapWorld), the same scans and the same matcher as the particle filter's, and one path.
//!
//! On the way each step is tied to the one before twice: by its wheels, and by its scan, held against a map of the last scans. Where the
//! path comes near a place of long ago, the same search holds the scan against a map of the scans of then: what it finds closes a
//! loop. How well a match knows the pose, along and across and in heading, is the fit of a Gaussian to its score
//! ([`Fit`](fastslam::proposal::Fit)), as in the filter's proposal.

mod build;
mod lap;

pub use build::{APART, DRAWN, GraphBuild, RECENT, VISIT};
pub use lap::{FIRST_LOOPS, Frame, GraphLap, Solved};

use super::lap::LapSetup;
use crate::baseline::pose_graph::{Edge, EdgeKind, GraphError, Optimizer, Repair};
use crate::digest::Digest;
use fastslam::error::{Range, SettingError};
use fastslam::geometry::{Pose2, align, rms};
use fastslam::nalgebra::{Matrix3, Vector3};

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
        let (truth, loops) = (&build.world().truth, graph.count(EdgeKind::Loop) as u32);
        let before = PathError::of(graph.poses(), truth);
        let mut optimizer = Optimizer::new(graph, repair);
        let iterations = optimizer.run(ITERATIONS)?;
        let after = PathError::of(optimizer.poses(), truth);
        Ok(Self {
            seed: setup.seed,
            rms_before: before.rms,
            rms_after: after.rms,
            rms_after_aligned: after.aligned,
            rms_odometry: rms(&build.world().odometry, truth),
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
