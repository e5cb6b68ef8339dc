//! The optimum of a pose graph is the one that `factrs` finds, for the same errors by derivatives and a solver of its own.

use fastslam::geometry::rms;
use laws::graphs::{Case, apart, cities, laps, robust};

fn agree(case: &Case) {
    let (ours, theirs) = (case.solved(), case.by_factrs().poses);
    let (name, off) = (&case.name, apart(ours.poses(), &theirs));
    println!(
        "{name}: {} poses, {} edges, cost {:.6}, apart by {off:.1e}",
        theirs.len(),
        case.graph.edges().len(),
        ours.cost()
    );
    assert!(off < case.close, "{name}: {off}");
    assert!(ours.cost() <= ours.cost_at(&theirs) * (1.0 + 1e-9), "{name}: theirs is better");
    assert!(rms(case.graph.poses(), &theirs) > 1e4 * case.close, "{name}: there was nothing to find");
}

#[test]
fn the_optimum_of_the_laps_own_graphs_is_that_of_factrs() {
    laps().iter().for_each(agree);
}

#[test]
fn the_optimum_of_a_city_in_g2o_is_that_of_factrs() {
    cities().iter().for_each(agree);
}

#[test]
fn the_optimum_with_a_robust_kernel_and_a_false_edge_is_that_of_factrs() {
    let case = robust();
    let (ours, theirs) = (case.solved(), case.by_factrs().poses);
    let off = apart(ours.poses(), &theirs);
    println!("Cauchy: apart by {off:.1e}, cost {} and {}", ours.cost(), ours.cost_at(&theirs));
    assert!(off < case.close, "{off}");
    assert!((ours.cost() - ours.cost_at(&theirs)).abs() < 1e-6 * ours.cost());
}
