use super::ends::end;
use super::*;
use fastslam::random::Purpose;

fn log(seed: u64) -> Log {
    Log::new(&LogSetup { seed, ..LogSetup::default() }).unwrap()
}

fn ended(log: &Log, guess: &Guess) -> (End, Iterate) {
    let first = guess.first_map().unwrap();
    let last = climb(log, first.clone(), ITERATIONS).unwrap().pop().unwrap();
    (end(log, first).unwrap(), last)
}

/// What the figure shows as it opens, and its chip.
#[test]
fn from_three_marks_the_map_is_right_and_from_two_it_converges_to_a_worse_one() {
    let log = Log::new(&LogSetup::default()).unwrap();
    let (right, map) = ended(&log, &Guess::default());
    assert!(right.again < 1e-6, "{right:?}");
    let found = doors(&map.map);
    assert_eq!(found.len(), DOORS);
    assert!(found.iter().zip(PLACES).all(|(found, door)| (found - door).abs() < 0.15), "{found:?}");
    let (fold, folded) = ended(&log, &FOLDING);
    assert!(fold.again > 0.999 && doors(&folded.map).len() == 2, "{fold:?}");
    assert!(right.log_posterior - fold.log_posterior > 5.0);
    // Both stand still: another iteration changes nothing that could be seen.
    for Iterate { map, .. } in [map, folded] {
        let twice = climb(&log, map, 1).unwrap();
        assert!((0.0..1e-4).contains(&(twice[1].log_posterior - twice[0].log_posterior)));
    }
    // None of the others gets any higher.
    let mut others = Others::default();
    while others.pending() > 0 {
        others.advance(&log).unwrap();
    }
    others.advance(&log).unwrap();
    assert_eq!(others.ends().len(), OTHERS as usize);
    assert!(others.ends().iter().all(|other| other.log_posterior < right.log_posterior + 0.1));
    assert!(others.ends().iter().any(|other| other.again > 0.5));
}

/// Over these logs: a guess of two doors is never given up, and on five sixths or more of them particles keep both answers.
fn folded_corridors_stay_folded(seeds: core::ops::RangeInclusive<u64>) {
    let (count, mut both) = (seeds.clone().count() as u32, 0);
    for seed in seeds {
        let log = log(seed);
        let (fold, _) = ended(&log, &FOLDING);
        assert!(fold.again > 0.99, "seed {seed}: {fold:?}");
        let mut cloud = Cloud::new(&log).unwrap();
        assert_eq!(cloud.shares(0), None);
        while cloud.pending(&log) > 0 {
            cloud.advance(&log);
        }
        cloud.advance(&log);
        for step in [0, 40, log.carried, log.steps()] {
            let all: f64 = cloud.shares(step).unwrap().iter().sum();
            assert!((all - 1.0).abs() < 1e-9, "seed {seed}, step {step}: {all}");
        }
        both += u32::from((0.05..=0.95).contains(&again(cloud.shares(log.carried).unwrap())));
    }
    assert!(6 * both >= 5 * count, "{both} of {count}");
}

#[test]
fn a_folded_corridor_stays_folded_and_particles_keep_both_answers() {
    folded_corridors_stay_folded(1..=6);
}

#[test]
#[ignore = "breadth: thirty seeds"]
fn thirty_folded_corridors_stay_folded_and_particles_keep_both_answers() {
    folded_corridors_stay_folded(1..=30);
}

/// Over 12 logs of all noises, from 4 guesses each: what is never to fall does not.
#[test]
fn no_iteration_lowers_the_posterior() {
    for seed in 0..12_u32 {
        let setup = LogSetup {
            odometry_std: 0.01 + 0.025 * f64::from(seed % 12),
            errors: 0.09 * f64::from(seed % 6),
            seed: seed.into(),
            ..LogSetup::default()
        };
        let log = Log::new(&setup).unwrap();
        for k in 0..4 {
            let mut stream = Stream::at(seed.into(), Purpose::TRIAL, k, 0);
            let guess = Guess { marks: core::array::from_fn(|_| LENGTH * stream.uniform()), trust: f64::from(k) / 3.0 };
            let iterates = climb(&log, guess.first_map().unwrap(), 30).unwrap();
            assert_eq!(iterates.len(), 31);
            for two in iterates.windows(2) {
                let gain = two[1].log_posterior - two[0].log_posterior;
                assert!(gain > -1e-9, "seed {seed}, guess {k}: {gain}");
            }
        }
    }
}

#[test]
fn a_log_of_perfect_wheels_and_sensor_says_door_where_one_is() {
    let log = Log::new(&LogSetup { odometry_std: 0.01, errors: 0.0, ..LogSetup::default() }).unwrap();
    assert_eq!((log.steps(), log.carried), (157, 79));
    for step in 1..=log.steps() {
        assert_eq!(log.ride.says_door(step), near_one_of(&PLACES, CORRIDOR.place(log.truth[step])), "step {step}");
    }
    assert_eq!(CORRIDOR.place(log.truth[log.carried]), CORRIDOR.place(CORRIDOR.cell(STARTS[1])));
}

#[test]
fn doors_are_runs_of_cells_and_marks_at_one_place_are_one() {
    let of = |marks| doors(&Guess { marks, trust: 1.0 }.first_map().unwrap());
    assert_eq!(of([2.5, 5.1, 5.1]).len(), 2);
    assert_eq!(of(PLACES).len(), 3);
    assert_eq!(doors(&[0.9, 0.1, 0.9, 0.1, 0.1, 0.9]).len(), 2, "a single cell does not part a door");
    let blank = Guess { trust: 0.0, ..FOLDING }.first_map().unwrap();
    assert!(blank.iter().all(|door| *door == CORRIDOR.known.mean()));
}

#[test]
fn a_setting_out_of_range_is_refused_by_name() {
    let refused = |setup| Log::new(&setup).unwrap_err().field();
    assert_eq!(refused(LogSetup { odometry_std: 0.0, ..LogSetup::default() }), "odometry_std");
    assert_eq!(refused(LogSetup { errors: 0.5, ..LogSetup::default() }), "errors");
    assert_eq!(refused(LogSetup { particles: 0, ..LogSetup::default() }), "particles");
    let guess = |marks, trust| Guess { marks, trust }.first_map().unwrap_err().field();
    assert_eq!(guess([1.0, 2.0, -0.1], 1.0), "marks");
    assert_eq!(guess([1.0, 2.0, f64::NAN], 1.0), "marks");
    assert_eq!(guess(PLACES, 1.1), "trust");
}

/// Where the third mark has to be, on the log of the figure, for the corridor to unfold: two decimetres from where it stands it folds.
#[test]
fn on_the_log_of_the_figure_two_decimetres_decide() {
    let log = Log::new(&LogSetup::default()).unwrap();
    let folds = |third| ended(&log, &Guess { marks: [2.6, 5.2, third], trust: 1.0 }).0.again > 0.5;
    assert_eq!(
        [5.2, 6.4, 7.6, 7.7, 8.0, 8.3, 8.4, 9.5].map(folds),
        [true, true, true, false, false, false, true, true]
    );
}
