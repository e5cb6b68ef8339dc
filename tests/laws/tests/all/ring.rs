//! What the fit of a particle is worth, and what a filter keeps until a loop closes.

use core::ops::RangeInclusive;
use fastslam_lab::experiment::lap::{Lap, LapSetup};
use fastslam_lab::experiment::ring::{NoiseProbe, PriceNoise, RingRun, RingSetup, median, price_noise, price_noise_on};

/// The ring on which universes can be told apart least: one niche a side, a laser of 2.5 m.
fn bare(seed: u64, particles: usize) -> RingSetup {
    let lap = LapSetup { seed, particles, ..LapSetup::default() };
    RingSetup { lap, niches: 1, max_range: 2.5 }
}

/// Medians over these seeds and every 18th step. Nothing in the fit is drawn; what is left is how far twenty-odd values miss the
/// integral: 0.14 nats on both courses with the curvature of the whole scan. On the ring, where nothing has been seen before, the price of a pose is the same
/// for all; it was 0.4 to 3.4 nats of noise when probes were drawn.
fn the_fits_errors_differ_little(seeds: RangeInclusive<u64>) {
    let probe = NoiseProbe { every: 18, draws: 5, shared: false };
    let rings: Vec<PriceNoise> = seeds.clone().flat_map(|seed| price_noise(&bare(seed, 8), probe).unwrap()).collect();
    let lap = |seed| {
        let setup = LapSetup { seed, particles: 8, ..LapSetup::default() };
        price_noise_on(Lap::new(&setup).unwrap(), &setup, probe)
    };
    let laps: Vec<PriceNoise> = seeds.flat_map(lap).collect();
    for (name, noises) in [("ring", &rings), ("lap", &laps)] {
        let errors: Vec<f64> = noises.iter().filter_map(|noise| noise.fit_error).collect();
        assert_eq!(errors.len(), noises.len(), "{name}: the matcher is trusted");
        let error = median(errors);
        assert!(error < 0.25, "{name}: {error:.3} nats");
    }
    let noise = median(rings.iter().map(|noise| noise.noise).collect());
    assert!(noise < 0.25, "{noise:.3} nats");
}

#[test]
fn of_two_particles_the_fits_errors_differ_by_less_than_a_quarter_of_a_nat() {
    the_fits_errors_differ_little(1..=2);
}

#[test]
#[ignore = "breadth: six seeds"]
fn of_two_particles_the_fits_errors_differ_by_less_than_a_quarter_of_a_nat_over_six_seeds() {
    the_fits_errors_differ_little(1..=6);
}

/// Medians of 20 seeds at M = 16: 7 resamplings, and a deviation that falls to a fourth, when this was written; 47, and to two thirds, when
/// every scan was weighed by the map as it is.
#[test]
fn the_closing_of_the_loop_selects_and_not_the_way_there() {
    let runs: Vec<RingRun> = (1..21).map(|seed| RingRun::of(&bare(seed, 16)).unwrap()).collect();
    let of = |f: fn(&RingRun) -> f64| median(runs.iter().map(f).collect());
    let resampled = of(|run| f64::from(run.resampled_before));
    assert!(resampled <= 10.0, "{resampled} resamplings");
    let (before, after) = (of(|run| run.deviation_before), of(|run| run.deviation_after));
    assert!(before >= 2.0 * after, "deviation of position {before:.3} m before, {after:.3} m after");
    let died = of(|run| run.died);
    assert!(died >= 0.5, "{died} died");
}

/// What must be seen where the chapter opens, as medians over seeds: before the loop closes the universes differ, and the closing ends
/// most of them. Of 50 seeds, when this was written: deviation 0.477 m, overlap 0.580, 69 % died, 0.052 m after, 0.058 m off at the end
/// where odometry is 8.36 m off.
fn universes_differ_until_the_loop_closes(seeds: impl IntoIterator<Item = u64>) {
    let run = |seed| {
        let lap = LapSetup { seed, ..LapSetup::opening() };
        RingRun::on(&lap.course.route(), &lap).unwrap()
    };
    let runs: Vec<RingRun> = seeds.into_iter().map(run).collect();
    let of = |f: fn(&RingRun) -> f64| median(runs.iter().map(f).collect());
    type Law = (&'static str, fn(&RingRun) -> f64, fn(f64) -> bool);
    let laws: [Law; 5] = [
        ("deviation of position before [m]", |run| run.deviation_before, |x| x >= 0.4),
        ("overlap of two universes' walls before", |run| run.overlap_before, |x| x <= 0.75),
        ("share that died", |run| run.died, |x| x >= 0.5),
        ("deviation of position after [m]", |run| run.deviation_after, |x| x <= 0.1),
        ("error of the best over that of odometry", |run| run.end_best / run.end_odometry, |x| x <= 0.25),
    ];
    for (name, value, law) in laws {
        let holding = runs.iter().filter(|run| law(value(run))).count();
        let each: Vec<f64> = runs.iter().map(value).collect();
        println!("{name}: median {:.3}, {holding} of {} seeds hold the law: {each:.2?}", of(value), runs.len());
    }
    for (name, value, law) in laws {
        assert!(law(of(value)), "{name}: {:.3}", of(value));
    }
    let opening = run(LapSetup::opening().seed);
    assert!(laws.iter().all(|(_, value, law)| law(value(&opening))), "the seed it opens with: {opening:?}");
}

/// The first seeds, and the one that the chapter opens with.
#[test]
fn where_the_chapter_opens_universes_differ_until_the_loop_closes_and_most_of_them_die() {
    universes_differ_until_the_loop_closes(1..=20);
}

#[test]
#[ignore = "breadth: fifty seeds"]
fn where_the_chapter_opens_universes_differ_until_the_loop_closes_on_fifty_seeds() {
    universes_differ_until_the_loop_closes(1..=50);
}
