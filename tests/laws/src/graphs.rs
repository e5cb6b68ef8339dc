//! Pose graphs whose optimum somebody else's optimiser has found as well: `factrs`, whose derivatives are dual numbers and whose equations
//! are sparse.
//!
//! What it answered stands in `tests/factrs/optima.txt`, because building it takes minutes and switches on features of `num-traits` that may
//! change results. `cargo test` in `tests/factrs` solves the graphs anew and holds the file against that; with `UPDATE_FIXTURE=1` it writes the file.

use core::fmt::Write as _;
use core::hash::Hasher as _;
use fastslam::geometry::Pose2;
use fastslam_lab::baseline::pose_graph::{Optimizer, PoseGraph, Repair, g2o, manhattan};
use fastslam_lab::digest::Digest;
use fastslam_lab::experiment::graph::{GraphBuild, wrong_edge};
use fastslam_lab::experiment::lap::{Course, LapSetup};

/// A graph, and how loop edges count in it.
#[derive(Clone, Debug)]
pub struct Case {
    /// What the fixture calls it by.
    pub name: String,
    /// It starts where the odometry leads.
    pub graph: PoseGraph,
    /// Least squares, or Cauchy's kernel.
    pub repair: Repair,
    /// How far the two optima may be apart \[m, rad\].
    pub close: f64,
}

/// The optimum of a graph by `factrs`.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// That of the case.
    pub name: String,
    /// Fingerprint of the graph that was solved.
    pub graph: String,
    /// To ten decimals, which is four more than are compared.
    pub poses: Vec<Pose2>,
}

/// `factrs` stops where a step lowers the cost by 1e-9 of it: the last step is then far shorter than this \[m, rad\].
const CLOSE: f64 = 1e-6;

fn of_lap(course: Course, seed: u64) -> GraphBuild {
    let mut build = GraphBuild::new(&LapSetup { course, seed, ..LapSetup::default() }).expect("a valid setup");
    while build.step().expect("it can be solved") {}
    build
}

/// The graphs of three laps on each course.
pub fn laps() -> Vec<Case> {
    let seeds = [Course::Ring, Course::Apartment].into_iter().flat_map(|course| [1, 2, 3].map(|seed| (course, seed)));
    seeds
        .map(|(course, seed)| {
            let graph = of_lap(course, seed).graph().expect("a graph");
            Case { name: format!("{course}-{seed}"), graph, repair: Repair::LeastSquares, close: CLOSE }
        })
        .collect()
}

/// Three cities, written as g2o writes them and read back.
pub fn cities() -> Vec<Case> {
    [1, 2, 5]
        .map(|seed| {
            let (graph, _) = manhattan(seed, 150).expect("a graph");
            let graph = g2o::read(&g2o::write(&graph)).expect("what was written");
            Case { name: format!("city-{seed}"), graph, repair: Repair::LeastSquares, close: CLOSE }
        })
        .into()
}

/// A lap with a false-positive loop closure, and Cauchy's kernel. Its optimum lies in a flat valley: the cost says more than the place.
pub fn robust() -> Case {
    let build = of_lap(Course::Ring, 3);
    let mut edges = build.edges().to_vec();
    edges.push(wrong_edge([14, 52]));
    let graph = PoseGraph::new(build.chain().to_vec(), edges).expect("a graph");
    Case { name: "false-edge".into(), graph, repair: Repair::CAUCHY, close: 1e-3 }
}

/// Largest distance between poses of the same index \[m, rad\].
pub fn apart(a: &[Pose2], b: &[Pose2]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.minus(b).norm()).fold(0.0, f64::max)
}

impl Case {
    /// Poses and edges of the graph, as a fingerprint.
    pub fn fingerprint(&self) -> String {
        let mut digest = Digest::new();
        let mut put = |pose: &Pose2| [pose.x, pose.y, pose.theta].into_iter().for_each(|x| digest.f64(x));
        self.graph.poses().iter().for_each(&mut put);
        self.graph.edges().iter().for_each(|edge| put(&edge.i_from_j));
        for edge in self.graph.edges() {
            digest.write(edge.kind.to_string().as_bytes());
            [edge.i, edge.j].into_iter().for_each(|k| digest.u32(k as u32));
            edge.information.iter().for_each(|x| digest.f64(*x));
        }
        format!("{:016x}", digest.value())
    }

    /// The optimum by the laboratory's own optimiser.
    ///
    /// # Panics
    /// Where it does not converge in 400 iterations.
    pub fn solved(&self) -> Optimizer {
        let mut optimizer = Optimizer::new(self.graph.clone(), self.repair);
        let iterations = optimizer.run(400).expect("it can be solved");
        assert!(iterations < 400, "{}: it does not converge", self.name);
        optimizer
    }

    /// The optimum that `factrs` found, from the fixture.
    ///
    /// # Panics
    /// Where the fixture is of another graph.
    pub fn by_factrs(&self) -> Optimum {
        let optimum = read().into_iter().find(|optimum| optimum.name == self.name);
        let anew = "`UPDATE_FIXTURE=1 cargo test` in tests/factrs solves it anew";
        let optimum = optimum.unwrap_or_else(|| panic!("{} is not in tests/factrs/optima.txt: {anew}", self.name));
        assert_eq!(
            optimum.graph,
            self.fingerprint(),
            "{}: the graph is not the one that factrs solved: {anew}",
            self.name
        );
        optimum
    }
}

/// The fixture's text.
pub fn write(optima: &[(Case, Vec<Pose2>)]) -> String {
    let mut text = String::from(
        "# Optima of the pose graphs in tests/laws/src/graphs.rs by factrs 0.3, of each pose x [m], y [m] and the heading [rad].\n\
         # Written by `UPDATE_FIXTURE=1 cargo test` in tests/factrs.\n",
    );
    for (case, poses) in optima {
        writeln!(text, "{} {} {}", case.name, poses.len(), case.fingerprint()).expect("a string takes all");
        for Pose2 { x, y, theta } in poses {
            writeln!(text, "{x:.10} {y:.10} {theta:.10}").expect("a string takes all");
        }
    }
    text
}

/// All optima of the fixture.
///
/// # Panics
/// Where [`write()`] has not written it.
pub fn read() -> Vec<Optimum> {
    const WRITTEN: &str = "`write` has written it";
    let mut lines = include_str!("../../factrs/optima.txt").lines().filter(|line| !line.starts_with('#'));
    let mut optima = Vec::new();
    while let Some(header) = lines.next() {
        let [name, count, graph] = header.split(' ').collect::<Vec<_>>()[..] else { panic!("{header}") };
        let pose = |line: &str| {
            let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().expect(WRITTEN)).collect();
            Pose2 { x: numbers[0], y: numbers[1], theta: numbers[2] }
        };
        let poses = lines.by_ref().take(count.parse().expect(WRITTEN)).map(pose).collect();
        optima.push(Optimum { name: name.into(), graph: graph.into(), poses });
    }
    optima
}
