//! The small figures between the sentences of the chapter: their numbers, and what holds for every one of them.

use crate::words::lines;
use fastslam_widgets::{
    fastslam::ops,
    figure::Figure,
    registry,
    scene::{Mark, Rect, Role},
    vignette::KINDS,
};

fn vignette(which: &str, at: u32) -> Figure {
    let mut figure = registry::figure("fastslam-vignette").unwrap();
    assert_eq!(figure.load(&format!("which={which}&at={at}")), []);
    figure
}

fn number(which: &str, at: u32) -> f64 {
    vignette(which, at).readouts()[1].value.unwrap()
}

#[test]
fn every_place_of_a_handle_shows_or_says_another_thing_and_its_line_holds_the_number() {
    for kind in KINDS {
        let mut before = None;
        for at in 0..=kind.last {
            let figure = vignette(kind.name, at);
            let (told, number) = (figure.describe(), figure.readouts()[1].text.clone());
            assert!(told.contains(&number), "{told} has no {number}");
            assert!((20..=130).contains(&told.chars().count()), "{told}");
            let now = Some((figure.scene(560.0, 150.0).marks, told));
            assert!(before != now, "{} {at}", kind.name);
            before = now;
        }
        let mut beyond = vignette(kind.name, 0);
        let message = beyond.set("at", &(kind.last + 1).to_string()).unwrap_err().message;
        assert!(message.contains(&kind.last.to_string()), "{message}");
    }
}

#[test]
fn they_are_as_high_as_the_page_keeps_free_and_nothing_written_in_them_is_cut() {
    let words = lines("de");
    for kind in KINDS {
        for (width, at, german) in [(560.0, 0, false), (330.0, kind.last, false), (330.0, kind.last / 2, true)] {
            let mut figure = vignette(kind.name, at);
            figure.set_words(if german { &words } else { "" });
            assert_eq!(figure.height(width), 150.0, "{}", kind.name);
            for mark in figure.scene(width, 150.0).marks {
                let Mark::Text(text) = mark else { continue };
                assert!(!text.text.contains('…'), "{}: {}", kind.name, text.text);
                let picture = Rect::new(0.0, 0.0, width, 150.0);
                assert!(picture.encloses(&text.area), "{}: {}", kind.name, text.text);
            }
        }
    }
}

#[test]
fn in_german_every_line_is_another_with_the_same_number() {
    let words = lines("de");
    for kind in KINDS {
        let (english, mut german) = (vignette(kind.name, 3), vignette(kind.name, 3));
        german.set_words(&words);
        assert_ne!(german.describe(), english.describe());
        assert_ne!(german.params()[1].title, english.params()[1].title);
        assert_eq!(german.readouts()[1].text, english.readouts()[1].text);
    }
}

#[test]
fn a_comb_gives_the_heaviest_particle_the_floor_or_the_ceiling_of_its_share_and_others_die_by_its_shift() {
    // Of 8 copies the pieces expect 0.96, 0.4, 2.4, 0.16, 1.12, 1.76, 0.32 and 0.88. Those below one have none in the rest of the shifts, to
    // one of the 50 places each.
    let dead: f64 = (0..50).map(|at| number("comb", at)).sum();
    let expected = 50.0 * (0.04 + 0.6 + 0.84 + 0.68 + 0.12);
    assert!((dead - expected).abs() <= 5.0, "{dead} of {expected}");
    let gets = |at| vignette("comb", at).describe();
    let three = (0..50).filter(|at| gets(*at).contains("gets 3 copies")).count();
    assert!((0..50).all(|at| gets(at).contains("gets 3 copies") || gets(at).contains("gets 2 copies")));
    assert!(three.abs_diff(20) <= 1, "a third copy at 40 % of the shifts: {three} of 50");
}

/// α = 0.001 two-sided for each axis (Bonferroni, 11 axes): 3.9 deviations of a binomial count.
#[test]
fn every_axis_leaves_half_of_the_samples_that_were_left_and_51_leave_none() {
    assert_eq!(number("halves", 0), 2048.0);
    for axes in 0..11 {
        let (before, after) = (number("halves", axes), number("halves", axes + 1));
        assert!((after - 0.5 * before).abs() <= 3.9 * (0.25 * before).sqrt(), "axis {axes}: {before}, {after}");
    }
    assert_eq!(number("halves", 51), 0.0);
    assert!(vignette("halves", 51).describe().contains("one in 2.3 × 10¹⁵"));
}

/// By hand: H_m of a landmark 3 m straight ahead is diag(1, 1/3), so S = [[0.0744, 0.01], [0.01, 0.05/9 + 0.0036]], and the weight falls
/// off as exp(−ν² S⁻¹_rr / 2).
#[test]
fn a_weight_is_that_of_a_surprise_against_what_sensor_and_map_leave_open() {
    let inverse = 1.0 / (0.0744 - 0.01 * 0.01 / (0.05 / 9.0 + 0.0036));
    for at in [0, 12, 20, 33] {
        let off = 0.05 * (f64::from(at) - 20.0);
        let expected = 100.0 * ops::exp(-0.5 * off * off * inverse);
        assert!((number("overlap", at) - expected).abs() < 1e-9, "{at}");
    }
}

#[test]
fn a_tree_loses_the_branches_of_its_root_one_by_one_and_gets_none_back() {
    let left: Vec<f64> = (0..=24).map(|step| number("tree", step)).collect();
    assert_eq!(left[0], 12.0);
    assert!(left.is_sorted_by(|before, after| before >= after), "{left:?}");
    assert!(left[24] <= 2.0, "{left:?}");
}

/// By hand: n beams leave a Gaussian of σ/√n about a place 0.1 m from the true pose, of σ = 0.15 m. On a fine lattice its N_eff is 2 √π of
/// its deviations, in steps of the lattice (where it does not reach beyond the last particles).
#[test]
fn beams_that_share_an_error_become_sure_of_a_wrong_pose() {
    for beams in [10.0_f64, 40.0, 72.0] {
        let (at, deviation) = (beams as u32 - 1, 0.15 / beams.sqrt());
        let expected = 2.0 * core::f64::consts::PI.sqrt() * deviation / 0.01;
        assert!((number("beams", at) / expected - 1.0).abs() < 1e-3, "{beams} beams: {expected}");
    }
    let of_the_best = |at| vignette("beams", at).describe();
    assert!(of_the_best(0).contains("80 % of the best"), "exp(−½ (0.1/0.15)²): {}", of_the_best(0));
    assert!(of_the_best(9).contains("11 % of the best"), "its tenth power: {}", of_the_best(9));
    assert!(of_the_best(71).contains("< 0.01 %"), "{}", of_the_best(71));
}

/// By hand: all that was seen after the first metre is turned about its end, where the farthest landmark is 6.8 m ahead and 0.4 m aside.
#[test]
fn a_slip_turns_all_landmarks_about_the_place_where_it_happened_and_leaves_their_distances() {
    for at in [0, 9, 10, 18, 20] {
        let slip = (0.5 * (f64::from(at) - 10.0)).to_radians();
        let expected = 2.0 * (6.8_f64 * 6.8 + 0.4 * 0.4).sqrt() * ops::sin(0.5 * slip).abs();
        assert!((number("slip", at) - expected).abs() < 1e-9, "{at}");
        assert!(vignette("slip", at).describe().contains("change by 0.00 m"));
    }
}

/// By hand: poses that spread by s along an axis, weighed by a Gaussian of σ, are worth the share √2 σ √(s² + σ²/2) / (s² + σ²) of them, times
/// the density of where it is: s is 0.16 rad × 4 m along the arc and 0.08 m across it, σ is 0.05 m. Each place has some thirty in
/// it, so that the seventeen about the middle, seven of them independent, scatter by a twelfth.
#[test]
fn of_poses_drawn_before_the_scan_few_are_worth_anything_and_the_fewer_the_further_off_it_fits() {
    let axis = |s: f64| 2.0_f64.sqrt() * 0.05 * (s * s + 0.00125).sqrt() / (s * s + 0.0025);
    let expected = |at: u32| {
        let deviations = 0.08 * (f64::from(at) - 20.0) / 0.64;
        400.0 * axis(0.64) * axis(0.08) * ops::exp(-0.5 * deviations * deviations)
    };
    let (found, predicted) = (12..=28).fold((0.0, 0.0), |(a, b), at| (a + number("look", at), b + expected(at)));
    assert!((found / predicted - 1.0).abs() < 0.25, "{found} of {predicted}");
    assert!(number("look", 0) < 5.0 && number("look", 40) < 5.0);
}

/// By hand: the sighting is (0.9, 0.5) m from the robot, so of a door of Σ = diag(0.04, 0.01) S is H Σ Hᵀ + Q with H of the
/// door as B has it before it.
#[test]
fn each_particle_names_the_door_by_its_own_pose_and_is_weighed_for_it() {
    let names = |at| vignette("names", at).describe();
    assert!(names(0).contains("door 2, B for door 2") && number("names", 0) == 50.0, "{}", names(0));
    assert!(names(20).contains("door 2, B for a new door"), "midway between two doors: {}", names(20));
    assert!(names(40).contains("door 2, B for door 3"), "doors are 2 m apart: {}", names(40));
    assert!((number("names", 40) - 50.0).abs() < 1e-9);
    let log_weight = |ahead: f64| {
        let (dx, dy) = (0.9 - ahead, 0.5_f64);
        let (q, seen) = (dx * dx + dy * dy, 0.9_f64 * 0.9 + 0.25);
        let r = q.sqrt();
        let [rr, rb, bb] = [
            (0.04 * dx * dx + 0.01 * dy * dy) / q + 0.0225,
            (-0.04 + 0.01) * dx * dy / (q * r),
            (0.04 * dy * dy + 0.01 * dx * dx) / (q * q) + 0.0036,
        ];
        let (range, bearing) = (seen.sqrt() - r, ops::atan2(0.5, 0.9) - ops::atan2(dy, dx));
        let det = rr * bb - rb * rb;
        let squared = (bb * range * range - 2.0 * rb * range * bearing + rr * bearing * bearing) / det;
        -0.5 * (squared + ops::ln(det))
    };
    for at in [3, 6, 35] {
        let ahead = 0.05 * f64::from(at);
        let odds = ops::exp(log_weight(if at > 20 { ahead - 2.0 } else { ahead }) - log_weight(0.0));
        assert!((number("names", at) - 100.0 * odds / (1.0 + odds)).abs() < 1e-6, "{at}");
    }
}

#[test]
fn a_map_is_copied_tile_by_tile_as_beams_reach_them_and_never_before() {
    let copied: Vec<f64> = (0..=36).map(|at| number("tiles", at)).collect();
    assert_eq!(copied[0], 0.0);
    assert!(copied.is_sorted() && copied[36] > 20.0, "{copied:?}");
    let kilobytes = |at: u32| {
        let told = vignette("tiles", at).describe();
        let before = |words| told.split(words).next().unwrap().rsplit(' ').next().unwrap().parse::<f64>().unwrap();
        [before(" KB, and"), before(" KB.")]
    };
    let ([shared, dense], [written, _]) = (kilobytes(0), kilobytes(36));
    // A tile has 64 cells and as many places, three words, and 28 bytes for every cell that was hit.
    let per_tile = 1000.0 * (written - shared) / copied[36];
    assert!((152.0..152.0 + 64.0 * 28.0).contains(&per_tile), "{per_tile}");
    assert!(dense > 10.0 * written);
}

#[test]
fn the_gate_ignores_a_mode_over_an_empty_map_and_thirteen_points_stand_around_one_that_it_lets_through() {
    let points = |at| {
        let accents = |mark: &Mark| matches!(mark, Mark::Discs { role: Role::Accent, .. });
        let marks = vignette("surface", at).scene(560.0, 150.0).marks;
        marks
            .iter()
            .filter(|mark| accents(mark))
            .map(|mark| match mark {
                Mark::Discs { centres, .. } => centres.len(),
                _ => 0,
            })
            .sum::<usize>()
    };
    assert_eq!(number("surface", 0), 0.0, "every pose explains the scan equally badly");
    for at in 0..=36 {
        let (told, through) = (vignette("surface", at).describe(), number("surface", at) >= 0.5);
        assert_eq!(told.contains("a Gaussian is fitted"), through, "{told}");
        assert_eq!(points(at), if through { 13 } else { 0 }, "{told}");
    }
    assert!(number("surface", 36) > 4.0);
}

/// By hand: the end points reach from 0.02 m before to 0.02 m behind 0.69 m, in the cell from 0.6 to 0.9 m.
#[test]
fn a_score_of_cells_is_the_same_as_long_as_all_points_stay_in_theirs_and_that_of_distributions_nowhere() {
    assert!((number("cells", 60) - 0.26).abs() <= 0.011, "{}", number("cells", 60));
    for at in 54..=78 {
        assert_eq!(number("cells", at), number("cells", 60), "{at}");
    }
    let worse = |at| vignette("cells", at).describe();
    assert!(worse(60).contains("0.0 nats below"), "{}", worse(60));
    assert!(!worse(54).contains(" 0.0 nats") && !worse(66).contains(" 0.0 nats"), "6 cm are seen");
    assert!(number("cells", 0) > 0.3 && number("cells", 120) > 0.3, "where nothing is known, all is alike");
}

/// By hand: after t steps ln w has the variance t (0.8 p)², and N_eff/M = exp(−that) falls below a half at ln 2.
#[test]
fn a_score_that_scatters_by_chance_leaves_all_paths_where_it_counts_little_and_one_or_two_where_it_counts_in_full() {
    let resampled = |at| vignette("lottery", at).describe().split(' ').nth(3).unwrap().parse::<f64>().unwrap();
    for at in 0..=2 {
        assert_eq!((number("lottery", at), resampled(at)), (16.0, 0.0), "exp(−40 × 0.08²) = 0.77");
    }
    // Not after one step, where it is exp(−0.64) = 0.53 on average, but mostly after two.
    assert!((13.0..=26.0).contains(&resampled(20)), "{}", resampled(20));
    assert!(number("lottery", 20) <= 2.0);
}
