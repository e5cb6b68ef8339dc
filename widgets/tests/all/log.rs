//! Laws of the figure that maps a log, by its public face: what a page can do to it.

use crate::common::{assert_texts_fit, figure, scene, state};
use fastslam_widgets::{
    figure::Figure,
    log::{Layout, Verb},
    registry,
    scene::{Mark, Rect, Role, Scene, Shading},
    view::Layout as _,
};

const TINY: &[u8] = include_bytes!("../../../tests/figures/golden/tiny.clf");

/// Coarse and few, as most laws do not ask how good the map is.
const QUICK: &str = "v=3&universes=4&cell=0.2";

fn opened(query: &str) -> Figure {
    let mut figure = figure("fastslam-log", query);
    figure.open(TINY).unwrap();
    figure
}

fn mapped(query: &str, step: u32) -> Figure {
    let mut figure = opened(query);
    figure.model_mut().seek(step);
    figure.model_mut().settle();
    figure
}

fn look(figure: &mut Figure, look: Verb, width: f64) {
    figure.own(&look.into(), width).unwrap();
}

fn value(figure: &Figure, name: &str) -> Option<f64> {
    figure.model().readouts().into_iter().find(|r| r.name == name).unwrap().value
}

fn text(figure: &Figure, name: &str) -> String {
    figure.model().readouts().into_iter().find(|r| r.name == name).unwrap().text
}

/// Widths and numbers of the paths of a role on the map.
fn strands(scene: &Scene, role: Role) -> Vec<(f64, usize)> {
    let map = Layout::new(scene.width).map.unwrap();
    let of = |mark: &Mark| match mark {
        Mark::Lines { lines, width, role: r, .. } if *r == role => {
            let lines = lines.iter().filter(|line| map.contains(line[0])).count();
            (lines > 0).then_some((*width, lines))
        }
        _ => None,
    };
    scene.marks.iter().filter_map(of).collect()
}

/// The largest map drawn.
fn cells(scene: &Scene) -> (Rect, usize) {
    let rasters = scene.marks.iter().filter_map(|mark| match mark {
        Mark::Raster { area, cells, shading: Shading::Map } => Some((*area, cells.shades.len())),
        _ => None,
    });
    rasters.max_by_key(|(_, count)| *count).unwrap()
}

/// A log in which these lines are broken.
fn damaged(lines: &[usize]) -> Vec<u8> {
    let text = String::from_utf8(TINY.to_vec()).unwrap();
    let broken = |(k, line): (usize, &str)| {
        if lines.contains(&(k + 1)) { format!("{}\n", &line[..40]) } else { format!("{line}\n") }
    };
    text.lines().enumerate().map(broken).collect::<String>().into_bytes()
}

#[test]
fn a_log_is_mapped_to_its_end_and_told_at_every_stage() {
    let mut figure = figure("fastslam-log", QUICK);
    assert!(figure.model().describe().contains("No log is open"));
    assert_eq!(figure.ready().unwrap_err().parameter, "file");
    figure.open(TINY).unwrap();
    assert!(
        figure.model().describe().starts_with("91 scans of up to 120 beams, over "),
        "{}",
        figure.model().describe()
    );
    assert_eq!(figure.ready(), Ok(()));
    assert_eq!((figure.model().step(), figure.model().step_count()), (0, 90));
    figure.model_mut().seek(40);
    figure.model_mut().settle();
    assert!(figure.model().describe().starts_with("Scan 40 of 90 is mapped. N_eff is "));
    assert_eq!(text(&figure, "digest"), "–");
    figure.model_mut().seek(u32::MAX);
    figure.model_mut().settle();
    assert!(figure.model().describe().starts_with("All scans are mapped. "));
    assert_eq!((figure.model().step(), figure.model().pending()), (90, 0));
    assert_eq!(text(&figure, "digest").len(), 16);
}

#[test]
fn pauses_and_looks_on_the_way_change_no_bit() {
    let straight = mapped(QUICK, 90);
    let mut halting = opened(QUICK);
    for step in [1, 2, 30, 31, 90] {
        halting.model_mut().seek(step);
        halting.model_mut().settle();
        look(&mut halting, Verb::Zoom(1.5, Some([100.0, 90.0])), 800.0);
        look(&mut halting, Verb::Pan([-20.0, 5.0]), 800.0);
        let _ = state(&halting);
    }
    assert_ne!(state(&straight).2, state(&halting).2, "it is looked at elsewhere");
    look(&mut halting, Verb::Fit, 800.0);
    assert_eq!(state(&straight), state(&halting));
    // Going back on the way does not either.
    let mut looking = mapped(QUICK, 50);
    for step in [3, 49, 0] {
        looking.model_mut().seek(step);
        assert_eq!((looking.model().step(), looking.model().pending()), (step, 0));
    }
    looking.model_mut().seek(90);
    looking.model_mut().settle();
    assert_eq!(state(&straight), state(&looking));
}

#[test]
fn all_that_is_told_goes_back_to_the_scan_that_is_shown_and_what_is_saved_does_not() {
    let mut figure = mapped(QUICK, 90);
    let (path, rows) = (figure.file("path.tum"), figure.export().rows());
    for step in [40, 41, 7, 1, 89] {
        figure.model_mut().seek(step);
        let then = mapped(QUICK, step);
        assert_eq!(figure.model().describe(), then.model().describe());
        assert_eq!(figure.model().readouts(), then.model().readouts());
        let heads = [&figure, &then].map(|figure| {
            let head = scene(figure, 800.0).marks.into_iter().find_map(|mark| match mark {
                Mark::Text(text) if text.text.starts_with("Scan ") => Some(text.text),
                _ => None,
            });
            head.unwrap()
        });
        assert_eq!(heads, [format!("Scan {step} of 90"), format!("Scan {step} of 90")]);
    }
    assert_eq!((figure.file("path.tum"), figure.export().rows()), (path, rows));
    // A setting begins anew.
    figure.set("seed", "2").unwrap();
    assert_eq!((figure.model().step(), figure.file("path.tum")), (0, None));
}

#[test]
fn raw_odometry_is_drawn_up_to_the_scan_shown_unless_it_is_left_out_as_in_older_links() {
    let drawn = |figure: &Figure| {
        let lines = scene(figure, 800.0).marks.into_iter().filter_map(|mark| match mark {
            Mark::Lines { lines, role: Role::Raw, .. } => Some(lines.concat().len()),
            _ => None,
        });
        // In the legend there is one too, of two points.
        lines.sum::<usize>() - 2
    };
    let mut figure = mapped(QUICK, 90);
    let whole = drawn(&figure);
    figure.model_mut().seek(30);
    assert!(drawn(&figure) > 10 && drawn(&figure) < whole / 2, "{} of {whole}", drawn(&figure));
    assert_eq!(figure.query(), QUICK);

    let mut older = registry::figure("fastslam-log").unwrap();
    let said = older.load("universes=4&cell=0.2");
    assert!(said.len() == 1 && said[0].parameter == "v", "{said:?}");
    older.open(TINY).unwrap();
    older.model_mut().seek(90);
    older.model_mut().settle();
    assert_eq!((older.query().as_str(), drawn(&older)), ("v=3&universes=4&cell=0.2&raw=off", 0));
}

#[test]
fn a_setting_that_changes_numbers_begins_anew_and_one_of_the_view_does_not() {
    let mut figure = mapped(QUICK, 9);
    figure.set("raw", "on").unwrap();
    assert_eq!(figure.model().step(), 9);
    for (name, value) in [
        ("universes", "5"),
        ("cell", "0.1"),
        ("policy", "never"),
        ("max-range", "5"),
        ("min-travel", "0.5"),
        ("seed", "9"),
    ] {
        let mut figure = mapped(QUICK, 9);
        figure.set(name, value).unwrap();
        assert_eq!((figure.model().step(), figure.model().pending()), (0, 0), "{name}");
    }
}

#[test]
fn files_that_are_no_logs_are_refused_with_line_and_reason_and_the_log_before_stays() {
    let mut figure = mapped(QUICK, 5);
    let before = state(&figure);
    let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR";
    let nan = b"ODOM nan 0 0 0 0 0 1 host 1\n";
    for (file, says) in [
        (&b""[..], "the file is empty"),
        (png, "line 1: "),
        (b"name,x,y\n1,2,3\n", "line 1: "),
        (nan, "line 1: ODOM: expected "),
        (b"FLASER 999999999 1 2 3\n", "line 1: FLASER: "),
        (b"ODOM 0 0 0 0 0 0 1 host 1\n", "no FLASER"),
        (b"FLASER 1 2 0 0 0 0 0 0 1 host 1\n", "one scan only"),
    ] {
        let error = figure.open(file).unwrap_err();
        assert!(error.message.contains(says), "{error}");
        assert_eq!((error.parameter.as_str(), error.message.lines().count()), ("file", 1));
        assert_eq!(state(&figure), before);
    }
}

#[test]
fn malformed_lines_are_named_and_skipped_only_if_the_reader_says_so() {
    let mut figure = figure("fastslam-log", QUICK);
    figure.open(&damaged(&[7, 30])).unwrap();
    let error = figure.ready().unwrap_err();
    assert_eq!(error.parameter, "lenient");
    assert!(
        error.message.starts_with("line 7: ROBOTLASER1: expected ") && error.message.contains("2 malformed lines"),
        "{error}"
    );
    figure.model_mut().seek(5);
    assert_eq!(figure.model().pending(), 0, "nothing starts before");
    figure.set("lenient", "on").unwrap();
    figure.model_mut().seek(5);
    figure.model_mut().settle();
    assert_eq!((figure.model().step(), figure.model().step_count()), (5, 88));
    assert!(mapped("", 0).ready().is_ok());
}

#[test]
fn what_does_not_fit_is_refused_before_it_starts_with_parameter_and_range() {
    // So many scans, 800 m apart.
    let far = |scans: u32| -> String {
        let line = |k| format!("FLASER 2 80 80 {0} {1} 0 {0} {1} 0 {k} host {k}\n", 800 * k, 70 * (k % 9));
        (0..scans).map(line).collect()
    };
    let mut figure = opened("v=3&universes=256&cell=0.02&policy=never&max-range=80");
    figure.open(far(20).as_bytes()).unwrap();
    let error = figure.ready().unwrap_err();
    assert_eq!(error.parameter, "universes");
    assert!(
        error.message.contains("must be a whole number from 1 to ") && error.message.contains("limit is 1000 MB"),
        "{error}"
    );
    figure.model_mut().seek(9);
    assert_eq!(figure.model().pending(), 0);
    let most = error.message.split("from 1 to ").nth(1).unwrap().split(' ').next().unwrap().to_owned();
    figure.set("universes", &most).unwrap();
    assert_eq!(figure.ready(), Ok(()));
    let more = most.parse::<u32>().unwrap() + 1;
    figure.set("universes", &more.to_string()).unwrap();
    assert_eq!(figure.ready().unwrap_err().parameter, "universes");

    // Not even one map fits.
    figure.open(far(1000).as_bytes()).unwrap();
    let error = figure.ready().unwrap_err();
    assert_eq!(error.parameter, "cell");
    assert!(error.message.contains("at least 0."), "{error}");
}

fn the_estimate_is_near_what_the_maps_take(queries: &[&str]) {
    for query in queries {
        let figure = mapped(query, 90);
        let (estimate, real) = (value(&figure, "estimate").unwrap(), value(&figure, "map_unique").unwrap());
        assert!((1.0..20.0).contains(&(estimate / real)), "{query}: {estimate} MB for {real} MB");
        println!("{query}: {estimate} MB for {real} MB");
    }
}

#[test]
fn the_estimate_is_never_below_what_the_maps_take_and_not_far_above() {
    the_estimate_is_near_what_the_maps_take(&[
        "v=3&universes=1&cell=0.05",
        "v=3&universes=1&cell=0.1",
        "v=3&universes=1&cell=0.2",
        "v=3&universes=1&cell=0.1&max-range=3",
        "v=3&universes=16&cell=0.1",
        "v=3&universes=16&cell=0.1&policy=never",
        "v=3&universes=64&cell=0.2&policy=always",
    ]);
}

#[test]
#[ignore = "breadth: as many universes as there can be"]
fn the_estimate_of_256_universes_is_never_below_what_their_maps_take_and_not_far_above() {
    the_estimate_is_near_what_the_maps_take(&["v=3&universes=256&cell=0.2"]);
}

#[test]
fn all_universes_are_drawn_and_those_that_died_fade_and_go() {
    let figure = mapped("v=3&universes=24&cell=0.2&policy=never", 40);
    let seen = scene(&figure, 800.0);
    assert_eq!(strands(&seen, Role::Path).len(), 1);
    assert_eq!(strands(&seen, Role::Copied)[0].1, 23, "each has left the others at the start");
    assert_eq!(strands(&seen, Role::Extinct), []);

    // Selection by a small power of what scans say lets few of them die: of 256, one a scan.
    let figure = mapped("v=3&universes=256&cell=0.2&policy=always", 89);
    let dead = strands(&scene(&figure, 800.0), Role::Extinct);
    assert!(dead.len() > 2 && dead.windows(2).all(|pair| pair[0].0 < pair[1].0), "older ones are thinner: {dead:?}");
    let export = figure.export();
    let died_out = export.header().iter().position(|name| *name == "died_out").unwrap();
    let died = export.rows().iter().filter_map(|row| row[died_out]).sum::<f64>();
    let drawn: usize = dead.iter().map(|(_, count)| count).sum();
    assert!(died > 2.0 * drawn as f64, "{died} died, {drawn} are drawn");
}

#[test]
fn the_map_stays_in_its_frame_however_it_is_magnified() {
    for width in [340.0, 800.0] {
        let map = Layout::new(width).map.unwrap();
        let mut figure = mapped(QUICK, 20);
        figure.paint(width as u32, figure.height(width) as u32, 1.0, Default::default());
        let whole = cells(&scene(&figure, width));
        for _ in 0..3 {
            look(&mut figure, Verb::Zoom(2.0, None), width);
        }
        let near = cells(&scene(&figure, width));
        assert!(near.1 < whole.1 / 8, "{} of {} cells", near.1, whole.1);
        // Cells reach over the edge by one at the most, and paper lies over what does.
        let side = near.0.w / (near.0.w * near.0.h / near.1 as f64).sqrt().round();
        assert!(map.inset(-1.01 * near.0.w / side.max(1.0)).overlaps(&near.0));
        let marks = scene(&figure, width).marks;
        let last = marks.iter().rposition(|m| matches!(m, Mark::Raster { area, .. } if *area == near.0)).unwrap();
        let paper = marks[last..].iter().filter_map(|m| match m {
            Mark::Fill { area, role: Role::Paper } if !map.overlaps(area) => Some(area.w * area.h),
            _ => None,
        });
        let figure_area = width * figure.height(width);
        assert!((paper.sum::<f64>() - (figure_area - map.w * map.h)).abs() < 2.0 * width);
        // Far away nothing is left, and nothing breaks.
        look(&mut figure, Verb::Pan([1e7, -1e9]), width);
        look(&mut figure, Verb::Zoom(1e-9, Some([0.0, 0.0])), width);
        look(&mut figure, Verb::Zoom(f64::INFINITY, Some([0.0, 0.0])), width);
        look(&mut figure, Verb::Pan([f64::NAN, 0.0]), width);
        assert_texts_fit(&scene(&figure, width), "far away");
        look(&mut figure, Verb::Fit, 800.0);
        assert_eq!(cells(&scene(&figure, width)), whole);
    }
}

#[test]
fn every_text_fits_at_every_width() {
    for figure in [
        figure("fastslam-log", ""),
        opened("v=3&universes=256"),
        mapped("v=3&universes=256&cell=0.2", 3),
        mapped(QUICK, 90),
    ] {
        for width in [240.0, 300.0, 340.0, 399.0, 400.0, 559.0, 560.0, 639.0, 640.0, 800.0, 1280.0] {
            let seen = scene(&figure, width);
            let layout = Layout::new(width);
            for ink in assert_texts_fit(&seen, &format!("{width}")) {
                assert!(ink.bottom() <= layout.height + 0.01, "{width}");
            }
        }
    }
}

#[test]
fn files_hold_the_best_path_and_map() {
    let figure = mapped(QUICK, 90);
    let file = |name: &str| figure.file(name).unwrap();
    let numbers = |name: &str| -> Vec<f64> {
        file(name).as_chunks::<8>().0.iter().map(|bits| f64::from_le_bytes(*bits)).collect()
    };
    let path = numbers("path.f64");
    let poses = path.as_chunks::<4>().0;
    assert_eq!(poses.len(), 91);
    for (pose, row) in poses.iter().zip(&figure.export().rows()) {
        let told = [1, 2, 3, 4].map(|k| row[k].unwrap());
        assert!(pose.iter().zip(told).all(|(kept, told)| (kept - told).abs() < 1e-6), "{pose:?} {told:?}");
    }
    let map = numbers("map.f64");
    assert_eq!(map[0], 0.2);
    let pgm = file("map.pgm");
    let header = String::from_utf8_lossy(&pgm[..15]).into_owned();
    let size: Vec<usize> = header.lines().nth(1).unwrap().split(' ').map(|n| n.parse().unwrap()).collect();
    let cells = &pgm[pgm.len() - size[0] * size[1]..];
    for grey in [0, 205, 254] {
        assert!(cells.contains(&grey), "{grey}");
    }
    assert!(cells.iter().all(|grey| [0, 205, 254].contains(grey)));
    // The robot starts at the origin, which is free.
    let [column, row] = [1, 2].map(|k| (-map[k] / 0.2).round() as usize);
    assert_eq!(cells[(size[1] - 1 - row) * size[0] + column], 254);
    assert_eq!(figure.file("map.exe"), None);
    assert_eq!(opened(QUICK).file("map.pgm"), None);
}
