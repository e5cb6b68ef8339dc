use super::*;
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;

const KNOWN: Beta = Beta { yes: 1.4, no: 1.9 };

/// A small ride with noise of all kinds, one of whose steps leads anywhere, and a map that was drawn.
fn small(seed: u64, cells: u32, steps: u32) -> (Ride, DoorMap) {
    let mut stream = Stream::at(seed, Purpose::TRIAL, cells, steps);
    let corridor = Corridor { cells, cell_size: 0.2, known: KNOWN };
    let log: Vec<(Shift, bool)> = (0..steps)
        .map(|step| {
            let std = if step == steps / 2 { 0.5 } else { 0.04 + 0.1 * stream.uniform() };
            (Shift { by: 0.4 * (stream.uniform() - 0.4), std }, stream.uniform() < 0.4)
        })
        .collect();
    let map = (0..cells).map(|_| 0.05 + 0.9 * stream.uniform()).collect();
    (Ride::new(corridor, 0.1, &log).unwrap(), map)
}

/// Every path with p(x₀..T, z₁..T | m), one after the other.
fn paths(ride: &Ride, map: &[f64]) -> Vec<(Vec<usize>, f64)> {
    let mut paths = vec![(vec![ride.start()], 1.0)];
    for step in 1..=ride.steps() {
        let see: Vec<f64> = ride.likelihood(step, map).collect();
        let longer = paths.iter().flat_map(|(path, p)| {
            let here = path[path.len() - 1];
            (0..map.len())
                .map(|to| {
                    let path = path.iter().copied().chain([to]).collect();
                    (path, p * ride.kernel(step).probability(here, to) * see[to])
                })
                .collect::<Vec<_>>()
        });
        paths = longer.filter(|(_, p)| *p > 0.0).collect();
    }
    paths
}

#[track_caller]
fn close(a: f64, b: f64, of: &str) {
    assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{of}: {a} and not {b}");
}

/// All that the passes compute, against the sum over all paths: 4⁶ and 3⁸ of them.
#[test]
fn passes_and_maximum_are_those_of_all_paths_one_by_one() {
    for (seed, cells, steps) in [(1, 4, 6), (2, 4, 6), (3, 3, 8), (4, 1, 3), (5, 5, 5)] {
        let (ride, map) = small(seed, cells, steps);
        let (all, found) = (paths(&ride, &map), Expectation::of(map.clone(), &ride).unwrap());
        let total: f64 = all.iter().map(|(_, p)| p).sum();
        close(found.log_likelihood().unwrap(), ops::ln(total), "likelihood");
        let mut counts = vec![[0.0; 2]; map.len()];
        for step in 0..=ride.steps() {
            let product = found.product(step).unwrap();
            for cell in 0..map.len() {
                let here = all.iter().filter(|(path, _)| path[step] == cell);
                let share = here.map(|(_, p)| p).sum::<f64>() / total;
                close(product[cell], share, "product");
                if step > 0 {
                    counts[cell][usize::from(!ride.says_door(step))] += share;
                }
            }
        }
        let entropy: f64 = all.iter().map(|(_, p)| -p / total * ops::ln(p / total)).sum();
        close(found.path_entropy(&ride).unwrap(), entropy, "entropy");
        for (cell, door) in found.maximise(&ride).unwrap().into_iter().enumerate() {
            let [yes, no] = counts[cell];
            close(door, (yes + KNOWN.yes - 1.0) / (yes + no + KNOWN.yes + KNOWN.no - 2.0), "map");
        }
    }
}

/// A robot that has read no further than the lag reaches knows as much.
#[test]
fn a_fixed_lag_is_the_product_of_a_ride_that_ends_there() {
    let (ride, map) = small(7, 30, 40);
    let whole = Expectation::of(map.clone(), &ride).unwrap();
    let same = |found: Option<Vec<f64>>, wanted: Option<Vec<f64>>, of: &str| {
        found.unwrap().into_iter().zip(wanted.unwrap()).for_each(|(a, b)| close(a, b, of));
    };
    for step in [0, 3, 20, 40] {
        same(whole.smoothed(&ride, step, 0), whole.forward(step).map(<[f64]>::to_vec), "none");
        same(whole.smoothed(&ride, step, 40), whole.product(step), "all");
        for lag in [1, 7, 19] {
            let mut cut = ride.clone();
            cut.steps.truncate(step + lag);
            cut.readings.truncate(step + lag);
            let product = Expectation::of(map.clone(), &cut).unwrap().product(step);
            same(whole.smoothed(&ride, step, lag), product, "some");
        }
    }
    assert_eq!(Expectation::new(map, &ride).unwrap().smoothed(&ride, 0, 3), None);
}

/// α₂ and β₂ alone: the paths up to a step, and from it.
#[test]
fn a_pass_that_is_stopped_is_the_sum_over_the_paths_so_far() {
    let (ride, map) = small(6, 4, 5);
    let mut passes = Expectation::new(map.clone(), &ride).unwrap();
    (0..3).for_each(|_| passes.advance(&ride));
    assert!(passes.forward(3).is_none() && passes.product(2).is_none() && passes.maximise(&ride).is_none());
    let until = Ride { steps: ride.steps[..2].to_vec(), readings: ride.readings[..2].to_vec(), ..ride.clone() };
    let all = paths(&until, &map);
    let total: f64 = all.iter().map(|(_, p)| p).sum();
    for (cell, p) in passes.forward(2).unwrap().iter().enumerate() {
        close(*p, all.iter().filter(|(path, _)| path[2] == cell).map(|(_, p)| p).sum::<f64>() / total, "forward");
    }
    (0..4).for_each(|_| passes.retreat(&ride));
    let after = Ride { steps: ride.steps[2..].to_vec(), readings: ride.readings[2..].to_vec(), ..ride.clone() };
    let from: Vec<f64> =
        (0..4).map(|start| paths(&Ride { start, ..after.clone() }, &map).iter().map(|(_, p)| p).sum()).collect();
    for (cell, p) in passes.backward(2).unwrap().iter().enumerate() {
        close(*p, from[cell] / from.iter().sum::<f64>(), "backward");
    }
    assert!(passes.backward(1).is_none());
}

/// Over 60 rides and first maps: what is the same at every step, and what never falls.
#[test]
fn forward_times_backward_sums_to_the_same_at_every_step_and_the_posterior_never_falls() {
    for seed in 0..60 {
        let (ride, mut map) = small(seed, 3 + seed as u32 % 30, 20 + seed as u32 % 50);
        let mut before = f64::NEG_INFINITY;
        for iteration in 0..25 {
            let passes = Expectation::of(map.clone(), &ride).unwrap();
            let log_likelihood = passes.log_likelihood().unwrap();
            for step in 0..=ride.steps() {
                close(passes.log_likelihood_at(step).unwrap(), log_likelihood, "sum of the products");
            }
            let entropy = passes.path_entropy(&ride).unwrap();
            assert!(entropy > -1e-9 && entropy <= ride.steps() as f64 * ops::ln(map.len() as f64) + 1e-9);
            let now = log_likelihood + log_prior(&map, KNOWN);
            assert!(now >= before - 1e-9, "seed {seed}, iteration {iteration}: {now} after {before}");
            before = now;
            map = passes.maximise(&ride).unwrap();
        }
    }
}

/// With a path that is known, one M step counts, and then nothing changes any more.
#[test]
fn without_noise_the_map_is_counted_at_once() {
    let corridor = Corridor { cells: 5, cell_size: 1.0, known: KNOWN };
    let step = |by: f64, says| (Shift { by, std: 0.0 }, says);
    let ride = Ride::new(corridor, 0.5, &[step(1.0, true), step(1.0, false), step(-1.0, true)]).unwrap();
    let once = Expectation::of(vec![0.3; 5], &ride).unwrap().maximise(&ride).unwrap();
    let expected = [KNOWN, KNOWN.after(2.0, 0.0), KNOWN.after(0.0, 1.0), KNOWN, KNOWN].map(Beta::mode);
    assert_eq!(once, expected);
    let again = Expectation::of(once.clone(), &ride).unwrap();
    assert_eq!(again.maximise(&ride).unwrap(), once);
    assert!(again.path_entropy(&ride).unwrap().abs() < 1e-12);
}

/// A ride a hundred times as long as any figure's: the scales hold.
#[test]
fn nothing_underflows_on_a_long_ride() {
    let (ride, map) = small(7, 12, 20_000);
    let passes = Expectation::of(map, &ride).unwrap();
    let log_likelihood = passes.log_likelihood().unwrap();
    assert!(log_likelihood < -5000.0 && log_likelihood.is_finite());
    for step in [0, 1, 9_999, 20_000] {
        let off = passes.log_likelihood_at(step).unwrap() - log_likelihood;
        assert!(off.abs() < 1e-6, "{step}: {off}");
    }
}

/// The same world for particles: ln p(z₁..T) with the map averaged over, from all paths one by one, and its estimate by 40 000 particles.
/// Its standard deviation over 200 seeds is 0.011 nats; five of it.
#[test]
fn the_particles_evidence_is_that_of_all_paths_with_the_map_averaged_over() {
    let (ride, _) = small(8, 4, 6);
    let corridor = *ride.corridor();
    let half = vec![0.5; 4];
    let all = paths(&ride, &half);
    let evidence: f64 = all
        .iter()
        .map(|(path, p)| {
            let mut known = [KNOWN; 4];
            let mut readings = 1.0;
            for step in 1..=ride.steps() {
                let (says, beta) = (ride.says_door(step), &mut known[path[step]]);
                readings *= 2.0 * if says { beta.mean() } else { 1.0 - beta.mean() };
                *beta = beta.after(f64::from(u8::from(says)), f64::from(u8::from(!says)));
            }
            p * readings
        })
        .sum();
    let mut filter = Rbpf::builder(DoorCounts::new(corridor), ByWheels)
        .particles(40_000)
        .seed(1)
        .start(Pose2::new(corridor.place(ride.start()), 0.0, 0.0))
        .policy(ResamplePolicy::EssBelow(0.5))
        .executor(Executor::Serial)
        .build()
        .unwrap();
    let log_evidence: f64 =
        (1..=ride.steps()).map(|t| filter.step(ride.kernel(t), &ride.says_door(t)).log_evidence).sum();
    assert!((log_evidence - ops::ln(evidence)).abs() < 0.055, "{log_evidence} and not {}", ops::ln(evidence));
}

#[test]
fn what_cannot_be_used_is_refused_by_name() {
    let corridor = Corridor { cells: 5, cell_size: 1.0, known: KNOWN };
    let refused = |start, by| Ride::new(corridor, start, &[(Shift { by, std: 0.1 }, true)]).unwrap_err().field();
    assert_eq!([refused(-1.0, 0.0), refused(f64::NAN, 0.0), refused(1.0, f64::INFINITY)], ["start", "start", "by"]);
    let ride = Ride::new(corridor, 0.5, &[]).unwrap();
    for map in [vec![0.5; 4], vec![0.0; 5], vec![f64::NAN; 5]] {
        assert_eq!(Expectation::new(map, &ride).unwrap_err().field(), "map");
    }
}
