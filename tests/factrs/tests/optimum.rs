//! The optimum of a graph is the one that `factrs` finds, for the same errors by derivatives and a solver of its own.

use core::fmt;
use factrs::{
    assign_symbols,
    containers::{FactorBuilder, Graph, Values},
    linalg::{ForwardProp, Numeric, VectorX},
    noise::GaussianNoise,
    optimizers::{BaseOptParams, LevenParams},
    residuals::{PriorResidual, Residual2},
    robust::Cauchy,

    core::LevenMarquardt,
    traits::{Optimizer as _, Variable},
    variables::SE2,
};
use fastslam::geometry::{Pose2, rms};
use fastslam_lab::baseline::pose_graph::{EdgeKind, Optimizer, PoseGraph, Repair, g2o, manhattan};
use fastslam_lab::experiment::graph::{GraphBuild, wrong_edge};
use fastslam_lab::experiment::lap::{Course, LapSetup};
use nalgebra::{Const, Matrix3};

assign_symbols!(X: SE2);

/// e = z⁻¹ · (x_i⁻¹ · x_j), the error of g2o. That of `factrs` itself is its inverse, in which an information means something else.
#[derive(Clone, Debug)]
struct Seen {
    i_from_j: SE2,
}

#[factrs::mark]
impl Residual2 for Seen {
    type Differ = ForwardProp<Const<6>>;
    type V1 = SE2;
    type V2 = SE2;
    type DimIn = Const<6>;
    type DimOut = Const<3>;

    fn residual2<T: Numeric>(&self, world_from_i: SE2<T>, world_from_j: SE2<T>) -> VectorX<T> {
        world_from_j.ominus(&world_from_i.compose(&self.i_from_j.cast::<T>()))
    }
}

impl fmt::Display for Seen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Seen({:?})", self.i_from_j)
    }
}

fn se2(pose: &Pose2) -> SE2 {
    SE2::new(pose.theta, pose.x, pose.y)
}

/// The poses at the optimum by `factrs`, with the first one held.
fn by_factrs(graph: &PoseGraph, cauchy: Option<f64>) -> Vec<Pose2> {
    let (mut factors, mut values) = (Graph::new(), Values::new());
    for (k, pose) in graph.poses().iter().enumerate() {
        values.insert(X(k as u32), se2(pose));
    }
    let held = PriorResidual::new(se2(&graph.poses()[0]));
    factors.add_factor(FactorBuilder::new1(held, X(0)).noise(GaussianNoise::<3>::from_scalar_sigma(1e-7)).build());
    for edge in graph.edges() {
        let o = edge.information;
        // The heading first.
        let information =
            Matrix3::new(o.m33, o.m13, o.m23, o.m13, o.m11, o.m12, o.m23, o.m12, o.m22);
        let noise = GaussianNoise::<3>::from_matrix_inf(information.as_view()).expect("it is positive definite");
        let seen = Seen { i_from_j: se2(&edge.i_from_j) };
        let factor = FactorBuilder::new2(seen, X(edge.i as u32), X(edge.j as u32)).noise(noise);
        factors.add_factor(match cauchy {
            Some(width) if edge.kind == EdgeKind::Loop => factor.robust(Cauchy::new(width)).build(),
            _ => factor.build(),
        });
    }
    let base = BaseOptParams { max_iterations: 300, error_tol_relative: 1e-9, error_tol_absolute: 1e-12, ..Default::default() };
    let mut optimizer = LevenMarquardt::new(LevenParams { base, ..Default::default() }, factors);
    let values = optimizer.optimize(values).expect("it converges");
    (0..graph.poses().len())
        .map(|k| {
            let pose: &SE2 = values.get(X(k as u32)).expect("every pose is there");
            Pose2::new(pose.x(), pose.y(), pose.theta())
        })
        .collect()
}

fn by_us(graph: &PoseGraph, repair: Repair) -> Optimizer {
    let mut optimizer = Optimizer::new(graph.clone(), repair);
    let iterations = optimizer.run(400).expect("it can be solved");
    assert!(iterations < 400);
    optimizer
}

/// \[m, rad\]. Theirs stops where a step lowers the cost by 1e-9 of it: Newton's last step is then far shorter than this.
const CLOSE: f64 = 1e-6;

fn agree(graph: &PoseGraph, what: &str) {
    let (ours, theirs) = (by_us(graph, Repair::LeastSquares), by_factrs(graph, None));
    let apart = ours.poses().iter().zip(&theirs).map(|(a, b)| a.minus(b).norm()).fold(0.0, f64::max);
    println!("{what}: {} poses, {} edges, cost {:.6}, apart by {apart:.1e}", theirs.len(), graph.edges().len(), ours.cost());
    assert!(apart < CLOSE, "{what}: {apart}");
    assert!(ours.cost() <= ours.cost_at(&theirs) * (1.0 + 1e-9), "{what}: theirs is better");
    assert!(rms(graph.poses(), &theirs) > 1e4 * CLOSE, "{what}: there was nothing to find");
}

fn of_lap(course: Course, seed: u64) -> GraphBuild {
    let mut build = GraphBuild::new(&LapSetup { course, seed, ..LapSetup::default() }).expect("a valid setup");
    while build.step().expect("it can be solved") {}
    build
}

#[test]
fn the_optimum_of_the_laps_own_graphs_is_that_of_factrs() {
    for (course, seed) in [Course::Ring, Course::Apartment].into_iter().flat_map(|course| [1, 2, 3].map(|seed| (course, seed))) {
        agree(&of_lap(course, seed).graph().expect("a graph"), &format!("{course} {seed}"));
    }
}

/// Written as g2o writes it, and read back.
#[test]
fn the_optimum_of_a_city_in_g2o_is_that_of_factrs() {
    for seed in [1, 2, 5] {
        let (graph, _) = manhattan(seed, 150).expect("a graph");
        agree(&g2o::read(&g2o::write(&graph)).expect("what was written"), &format!("city {seed}"));
    }
}

#[test]
fn the_optimum_with_a_robust_kernel_and_a_false_edge_is_that_of_factrs() {
    let Repair::Cauchy { width } = Repair::CAUCHY else { unreachable!("it is Cauchy's") };
    let build = of_lap(Course::Ring, 3);
    let mut edges = build.edges().to_vec();
    edges.push(wrong_edge([14, 52]));
    let graph = PoseGraph::new(build.chain().to_vec(), edges).expect("a graph");
    let (ours, theirs) = (by_us(&graph, Repair::CAUCHY), by_factrs(&graph, Some(width)));
    let apart = ours.poses().iter().zip(&theirs).map(|(a, b)| a.minus(b).norm()).fold(0.0, f64::max);
    println!("Cauchy: apart by {apart:.1e}, cost {} and {}", ours.cost(), ours.cost_at(&theirs));
    // A flat valley: the cost tells more than the place.
    assert!(apart < 1e-3, "{apart}");
    assert!((ours.cost() - ours.cost_at(&theirs)).abs() < 1e-6 * ours.cost());
}
