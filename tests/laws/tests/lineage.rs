//! The law of the tree of paths: its memory is what the population needs. Alone in its program, because it counts allocations.

use fastslam::resampling::{ResamplePolicy, Scheme};
use laws::{Counting, crown, drifting};

#[global_allocator]
static ALLOCATED: Counting = Counting::new();

#[test]
fn the_nodes_held_are_one_path_and_a_bush_that_does_not_grow() {
    const PARTICLES: usize = 64;
    // Allocations other than nodes: the filter's vectors, a report, and what the test's harness does meanwhile.
    const OTHERS: usize = 64;
    for (policy, scheme, most) in [
        // The first case is the one that is proven (Jacob, Murray, Rubenthaler 2015). Over 10⁵ steps the largest c are 1.7, 2.8 and
        // 2.5, their means 0.7, 1.2 and 1.2; half as much again is for other draws.
        (ResamplePolicy::Always, Scheme::Multinomial, 2.5),
        (ResamplePolicy::Always, Scheme::Systematic, 4.0),
        (ResamplePolicy::EssBelow(0.5), Scheme::Systematic, 4.0),
    ] {
        let before = ALLOCATED.blocks();
        let mut filter = drifting(policy, scheme, PARTICLES);
        for step in 1..=10_000 {
            drop(filter.step(&(), &()));
            let needed = filter.descent().size();
            let held = ALLOCATED.blocks() - before;
            assert!(held <= needed as usize + OTHERS, "{policy:?} {scheme}, step {step}: {held} held, {needed} needed");
            let c = crown(needed, step, PARTICLES);
            assert!(c <= most, "{policy:?} {scheme}, step {step}: c = {c}");
        }
        drop(filter);
        assert!(ALLOCATED.blocks() <= before + OTHERS, "{policy:?} {scheme}: the tree outlived its filter");
    }
}
