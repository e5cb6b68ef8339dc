//! Laws of a run that is pinned: its curves stay behind whatever is shown, and change nothing but the picture.

use crate::common::{assert_drawn_inside, assert_texts_fit, figure, scene, state};
use fastslam_widgets::{
    figure::Figure,
    registry,
    scene::{GHOST, Mark, Rect},
};

/// A state that is pinned, and one that is shown then, with every mark that a legend has.
const RUNS: [(&str, &str, &str); 9] = [
    ("fastslam-lap", "step=30", "universes=4&step=22&truth=on&raw=on"),
    ("fastslam-resampling", "step=30", "particles=40&threshold=0.9&step=12"),
    ("fastslam-resampling", "wings=on&step=30", "step=12"),
    ("fastslam-doors", "seed=2", "step=58&particles=50"),
    ("fastslam-proposal", "range-std=0.3", "v=3&landmarks=pair&samples=64&predict=on&run=on"),
    ("fastslam-graph", "wrong=on", "repair=robust&wrong=on&step=2"),
    ("fastslam-joint", "sensor=2&particles=100", "particles=200&landmarks=6"),
    ("fastslam-em", "mark-3=5.2&particles=100", "particles=200&step=83"),
    ("fastslam-smoothing", "particles=4&step=3", "particles=6&step=2&at=20"),
];

/// How many marks are of the pinned run.
fn ghosts(figure: &Figure) -> usize {
    let drawn = |mark: &&Mark| match mark {
        Mark::Lines { role, lines, .. } => *role == GHOST && lines.iter().any(|line| line.len() > 1),
        Mark::Discs { role, centres, .. } => *role == GHOST && !centres.is_empty(),
        _ => false,
    };
    scene(figure, 800.0).marks.iter().filter(drawn).count()
}

#[test]
fn curves_of_a_pinned_run_are_drawn_whatever_is_set_until_it_is_unpinned() {
    for (tag, pinned, shown) in RUNS {
        let curves = figure(tag, pinned).model().curves();
        let mut figure = figure(tag, shown);
        let before = state(&figure);
        assert_eq!(ghosts(&figure), 0, "{tag}");
        figure.model_mut().haunt(curves.clone());
        let count = ghosts(&figure);
        assert!(count >= 2, "{tag}: a curve and its name, {count}");
        assert_eq!((figure.query(), state(&figure).1), (before.0.clone(), before.1.clone()), "{tag}");
        figure.set("seed", "9").unwrap();
        figure.model_mut().settle();
        assert!(ghosts(&figure) >= 2, "{tag}");
        figure.load(shown);
        figure.model_mut().settle();
        figure.model_mut().haunt(Vec::new());
        assert_eq!(state(&figure), before, "{tag}");
    }
}

#[test]
fn curves_are_those_of_the_whole_run_whichever_step_is_shown() {
    let mut lap = figure("fastslam-lap", "step=30");
    let curves = lap.model().curves();
    assert_eq!(curves.len(), 1, "N_eff of steps 0 to 30");
    let ess: Vec<f64> = lap.model().series().rows.iter().map(|row| row[5] / 16.0).collect();
    assert_eq!(curves[0], ess);
    lap.model_mut().seek(10);
    lap.model_mut().settle();
    assert_eq!(lap.model().curves(), curves);
}

#[test]
fn the_picture_of_a_pinned_run_fits_at_every_width() {
    for (tag, pinned, shown) in RUNS {
        let curves = figure(tag, pinned).model().curves();
        let mut figure = figure(tag, shown);
        figure.model_mut().haunt(curves.clone());
        for width in [300.0, 340.0, 380.0, 559.0, 560.0, 692.0, 728.0, 800.0, 1112.0, 1600.0] {
            let which = format!("{tag}?{shown} at {width}");
            let scene = scene(&figure, width);
            assert_texts_fit(&scene, &which);
            assert_drawn_inside(&scene, &which);
        }
    }
}

#[test]
fn numbers_that_no_run_has_do_no_harm() {
    for (tag, _, shown) in RUNS {
        let mut figure = figure(tag, shown);
        for curves in [vec![vec![0.0, -1e300, 1e300]], vec![vec![]], vec![vec![2.0], vec![], vec![9.0; 6]]] {
            figure.model_mut().haunt(curves);
            figure.paint(800, 400, 1.0, Default::default());
        }
    }
}

#[test]
fn the_gist_of_a_picture_lies_in_it_whatever_is_shown() {
    for (tag, panels) in [
        ("fastslam-lap", "all map mosaic n-eff"),
        ("fastslam-resampling", "all n-eff tree particles"),
        ("fastslam-proposal", "all motion aware ratio"),
        ("fastslam-conditioning", "all"),
        ("fastslam-doors", "all corridor history"),
        ("fastslam-em", "all passes likelihood particles"),
    ] {
        let mut figure = figure(tag, "");
        for panel in panels.split(' ') {
            figure.show(panel).unwrap();
            for width in [200.0, 340.0, 800.0, 1200.0] {
                let gist = figure.gist(width);
                let whole = Rect::new(0.0, 0.0, width, figure.height(width) + 1e-6);
                assert!(
                    whole.encloses(&gist) && gist.w > 0.3 * width && gist.h > 20.0,
                    "{tag} {panel}: {gist:?} in {whole:?}"
                );
            }
        }
    }
}

/// Five seeds are run through one figure, one after the other.
#[test]
fn what_comes_out_at_a_seed_is_the_same_whichever_seeds_were_run_before_it() {
    for (tag, setting) in [
        ("fastslam-lap", "universes=8&step=12"),
        ("fastslam-resampling", "particles=12&step=12"),
        ("fastslam-doors", "particles=50&step=50"),
        ("fastslam-proposal", "range-std=0.3"),
        ("fastslam-graph", "step=2"),
        ("fastslam-joint", "particles=100"),
        ("fastslam-em", "particles=100&step=83"),
        ("fastslam-smoothing", "particles=4&step=3"),
    ] {
        let mut aside = registry::figure(tag).unwrap();
        let mut different = 0;
        for seed in [4, 5, 6] {
            let query = format!("{setting}&seed={seed}");
            let before = state(&aside).1;
            aside.load(&query);
            aside.model_mut().settle();
            let (ran, alone) = (state(&aside), state(&figure(tag, &query)));
            assert_eq!((&ran.0, &ran.1), (&alone.0, &alone.1), "{tag}?{query}");
            different += usize::from(ran.1 != before);
        }
        assert_eq!(different, 3, "{tag}: every seed is another run");
    }
}
