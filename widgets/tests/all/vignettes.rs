//! The small figures between the sentences of the chapter: their numbers, and what holds for every one of them.

use crate::words::lines;
use fastslam_widgets::{
    fastslam::ops,
    figure::Figure,
    scene::{Mark, Rect},
    vignette::KINDS,
};

fn vignette(which: &str, at: u32) -> Figure {
    let mut figure = Figure::new("fastslam-vignette").unwrap();
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
