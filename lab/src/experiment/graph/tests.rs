use super::*;
use crate::experiment::lap::{Course, Lap};
use crate::experiment::ring::median;

fn solved(setup: &GraphSetup) -> GraphLap {
    let mut lap = GraphLap::new(setup).unwrap();
    while !lap.is_solved() {
        lap.advance().unwrap();
    }
    lap
}

fn ring(seed: u64) -> GraphSetup {
    let lap = LapSetup { course: Course::Ring, seed, ..LapSetup::default() };
    GraphSetup { lap, ..GraphSetup::default() }
}

/// The claim of the figure, over seeds: wheels that are metres off are bent into a ring that is off by less than a cell.
#[test]
fn the_ring_closes_from_wherever_the_wheels_led() {
    let (mut before, mut after) = (Vec::new(), Vec::new());
    for seed in 1..=20 {
        let lap = solved(&ring(seed));
        let [first, last] = [0, lap.frames().len() - 1].map(|k| &lap.frames()[k]);
        assert!(last.error.rms < 0.3 && last.error.rms < 0.15 * first.error.rms, "seed {seed}: {:?}", last.error);
        assert!(lap.frames().is_sorted_by(|a, b| a.cost >= b.cost));
        before.push(PathError::of(lap.build().chain(), &lap.world().truth).rms);
        after.push(last.error.rms);
    }
    // What the closing alone is worth: half of what the matches of recent scans leave.
    assert!(median(after.clone()) < 0.7 * median(before.clone()), "{before:?} {after:?}");
}

/// Pose 14 is in the corridor below the block, pose 52 in the one above it.
#[test]
fn a_false_edge_folds_the_ring_and_each_repair_mends_it() {
    let repairs = [Repair::CAUCHY, Repair::SWITCHABLE, Repair::MAX_MIXTURE];
    let mut mended = [0; 3];
    for seed in 1..=12 {
        let clean = solved(&ring(seed));
        let folded = GraphSetup { wrong: Some([14, 52]), ..ring(seed) };
        let mut lap = clean.asked(&folded).unwrap();
        let mut end = |repair| {
            lap = lap.asked(&GraphSetup { repair, ..folded.clone() }).unwrap();
            while !lap.is_solved() {
                lap.advance().unwrap();
            }
            let last = lap.frames().last().unwrap();
            (last.error.rms, last.wrong_weight.unwrap())
        };
        let (rms, weight) = end(Repair::LeastSquares);
        assert!(rms > 2.0 && weight == 1.0, "seed {seed}: {rms}");
        for (repair, mended) in repairs.into_iter().zip(&mut mended) {
            let (rms, weight) = end(repair);
            assert!(weight < 1e-3, "seed {seed}, {repair:?}: {weight}");
            *mended += u32::from(rms < 0.2);
        }
    }
    // A mixture whose null component wins before the path is bent gives up right edges too.
    assert_eq!(mended[..2], [12, 12]);
    assert!((8..12).contains(&mended[2]), "{mended:?}");
}

#[test]
fn another_question_about_the_same_log_is_answered_as_if_it_were_the_first() {
    let other = GraphSetup { wrong: Some([3, 70]), start: Start::Matches, ..ring(3) };
    let lap = solved(&ring(3)).asked(&other).unwrap();
    assert_eq!(lap.build().step_now(), 110);
    let mut lap = lap;
    while lap.pending() > 0 {
        lap.advance().unwrap();
    }
    assert_eq!(lap.frames(), solved(&other).frames());
    assert_eq!(lap.universes().report().step, 110);
    let mut alone = Lap::new(&ring(3).lap).unwrap();
    while alone.step().is_some() {}
    assert_eq!(lap.universes().report().rms_best, alone.report().rms_best);
}

#[test]
fn the_graph_of_a_log_is_the_same_however_it_is_asked() {
    let run = |setup: &LapSetup| trace(setup, Repair::SWITCHABLE).unwrap().value();
    for course in [Course::Ring, Course::Apartment, Course::Rooms] {
        let setup = LapSetup { course, ..LapSetup::default() };
        assert_eq!(run(&setup), run(&LapSetup { particles: 3, ..setup.clone() }), "the filter has no part in it");
        assert_ne!(run(&setup), run(&LapSetup { seed: 4, ..setup.clone() }));
    }
}

/// What edges say of the truth: χ² of three degrees of freedom has the mean 3, and a match that claims too much one far above it.
#[test]
fn edges_err_by_about_what_their_information_says() {
    for course in [Course::Ring, Course::Apartment, Course::Rooms] {
        let build = |seed| {
            let mut build = GraphBuild::new(&LapSetup { course, seed, ..LapSetup::default() }).unwrap();
            while build.step().unwrap() {}
            build
        };
        let builds: Vec<GraphBuild> = (1..=8).map(build).collect();
        for kind in [EdgeKind::Odometry, EdgeKind::Match, EdgeKind::Loop] {
            let mut all = Vec::new();
            for build in &builds {
                let truth = &build.world().truth;
                let edges = build.edges().iter().filter(|edge| edge.kind == kind);
                all.extend(edges.map(|edge| edge.chi_squared(&truth[edge.i], &truth[edge.j])));
            }
            assert!(all.len() > 100, "{course}, {kind}");
            let median = median(all);
            // The median of χ² with 3 degrees of freedom is 2.4.
            assert!((0.3..5.0).contains(&median), "{course}, {kind}: {median}");
        }
    }
}

#[test]
fn settings_out_of_range_are_refused() {
    let refused = |setup: GraphSetup| GraphLap::new(&setup).unwrap_err().to_string();
    assert!(refused(GraphSetup { wrong: Some([4, 111]), ..ring(1) }).starts_with("wrong = 111: must be"));
    assert_eq!(refused(GraphSetup { wrong: Some([4, 4]), ..ring(1) }), "wrong: must be two different poses");
    assert!(refused(GraphSetup { repair: Repair::Cauchy { width: 0.0 }, ..ring(1) }).contains("width"));
    assert_eq!("moon".parse::<Start>().unwrap_err().to_string(), "start = moon: must be wheels or matches");
    // Wheels without noise, eyes without noise: no matrix is singular for that.
    for scale in [0.0, 3.0] {
        let lap = LapSetup { odometry_scale: scale, range_std: 0.0, course: Course::Ring, ..LapSetup::default() };
        assert!(solved(&GraphSetup { lap, ..GraphSetup::default() }).is_solved());
    }
}

/// Seen red where a loop is bent by edges of steps after it.
#[test]
fn loops_that_are_looked_for_when_all_steps_are_tied_are_the_same() {
    for course in [Course::Ring, Course::Apartment] {
        let setup = LapSetup { course, ..LapSetup::default() };
        let [mut by_steps, mut later] = [(); 2].map(|()| GraphBuild::new(&setup).unwrap());
        while by_steps.step().unwrap() {}
        while later.tie().unwrap() {}
        assert!(later.edges().iter().all(|edge| edge.kind != EdgeKind::Loop));
        while later.close().unwrap() {}
        assert_eq!(later.edges(), by_steps.edges(), "{course}");
        assert_eq!((later.step_now(), later.searched()), (by_steps.step_now(), by_steps.searched()));
    }
}

/// What is seen first stays where it is, but for some pixels, when all loops are closed.
#[test]
fn a_first_look_has_the_first_loops_and_a_path_near_that_of_all_of_them() {
    let mut far = Vec::new();
    for seed in 1..=12 {
        let mut lap = GraphLap::new(&ring(seed)).unwrap();
        while lap.solved() == Solved::Not {
            lap.advance().unwrap();
        }
        let first = lap.frames().last().unwrap().clone();
        assert_eq!(lap.solved(), Solved::InPart(FIRST_LOOPS), "seed {seed}");
        while !lap.is_solved() {
            assert_eq!(lap.frames().last(), Some(&first), "nothing is shown of iterations on their way");
            lap.advance().unwrap();
        }
        let last = lap.frames().last().unwrap();
        far.push(first.poses.iter().zip(&last.poses).map(|(a, b)| a.distance(b)).fold(0.0, f64::max));
    }
    // Of the pose that is moved furthest: in the median less than a cell of the map that is drawn.
    assert!(far.iter().all(|far| *far < 2.0 * DRAWN) && median(far.clone()) < DRAWN, "{far:?}");
}

#[test]
fn there_is_no_first_look_at_a_false_edge_or_at_a_graph_without_loops() {
    for setup in [GraphSetup { wrong: Some([14, 52]), ..ring(3) }, GraphSetup { loops: false, ..ring(3) }] {
        let mut lap = GraphLap::new(&setup).unwrap();
        while lap.solved() == Solved::Not {
            lap.advance().unwrap();
        }
        assert_eq!(lap.solved(), Solved::Whole);
        assert_eq!(lap.build().searched() > 0, setup.loops, "loops that are left out are not looked for");
    }
}
