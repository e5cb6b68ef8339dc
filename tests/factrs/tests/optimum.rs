//! Asks `factrs` for the optima that `tests/laws` compares: `optima.txt` has what it answers.

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
use fastslam::geometry::Pose2;
use fastslam_lab::baseline::pose_graph::{EdgeKind, PoseGraph, Repair};
use laws::graphs::{apart, cities, laps, read, robust, write};
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

/// To what is compared of them: two machines' sines may differ in the last bit.
#[test]
fn the_optima_kept_are_those_that_factrs_finds() {
    let cases = laps().into_iter().chain(cities()).chain([robust()]);
    let solved: Vec<_> = cases
        .map(|case| {
            let width = if let Repair::Cauchy { width } = case.repair { Some(width) } else { None };
            let poses = by_factrs(&case.graph, width);
            (case, poses)
        })
        .collect();
    if std::env::var_os("UPDATE_FIXTURE").is_some() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/optima.txt");
        return std::fs::write(file, write(&solved)).expect("the folder can be written to");
    }
    assert_eq!(read().len(), solved.len(), "UPDATE_FIXTURE=1 writes them all");
    for (case, poses) in solved {
        let off = apart(&case.by_factrs().poses, &poses);
        println!("{}: apart by {off:.1e}", case.name);
        assert!(off < case.close, "{}: {off}; UPDATE_FIXTURE=1 writes it", case.name);
    }
}
