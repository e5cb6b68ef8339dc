//! The states of the figures whose pixels and numbers are kept: `tests/goldens.rs` compares them natively, `tests/browser` in
//! WebAssembly.

use core::{cmp::Reverse, hash::Hasher as _};
use fastslam_lab::{digest::Digest, experiment::log::Example};
use fastslam_log::write;
use fastslam_widgets::{
    figure::Figure,
    log::Layout as LogLayout,
    model::Readout,
    paint::{Canvas, Theme},
    registry,
    scene::{Mark, Role},
    view::Layout as _,
};
use std::collections::BTreeMap;

/// A figure in a state, at a size, in a theme.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    /// Names its file.
    pub name: &'static str,
    /// The figure.
    pub tag: &'static str,
    /// Its state.
    pub query: &'static str,
    /// \[css px\]
    pub width: u32,
    /// Device px per css px.
    pub dpr: f64,
    /// Colours, by the name that the page uses.
    pub theme: &'static str,
}

const LAP: &str = "fastslam-lap";
const CONDITIONING: &str = "fastslam-conditioning";
const PROPOSAL: &str = "fastslam-proposal";
const WORKED: &str = "fastslam-worked-example";
const RESAMPLING: &str = "fastslam-resampling";
const DOORS: &str = "fastslam-doors";
const UNIVERSES: &str = "fastslam-universes";
const SMOOTHING: &str = "fastslam-smoothing";
const JOINT: &str = "fastslam-joint";
const EM: &str = "fastslam-em";
const GRAPH: &str = "fastslam-graph";
const VIGNETTE: &str = "fastslam-vignette";
/// Its pictures and readouts are those of [`TINY_LOG`], mapped to its end.
pub const LOG: &str = "fastslam-log";

/// A lap of the apartment as a robot would have recorded it: what `tests/goldens.rs` simulates, and its readers open.
pub const TINY_LOG: &[u8] = include_bytes!("../golden/tiny.clf");

const fn picture(
    tag: &'static str,
    name: &'static str,
    query: &'static str,
    width: u32,
    dpr: f64,
    theme: &'static str,
) -> Picture {
    Picture { name, tag, query, width, dpr, theme }
}

/// The first two are what readers without JavaScript see: the ring as its loop closes, just resampled. At 1.5 px per css px
/// they are sharp enough for most screens, and 80 KB each.
pub const PICTURES: &[Picture] = &[
    picture(LAP, "fastslam-lap-light", CLOSING, 800, 1.5, "light"),
    picture(LAP, "fastslam-lap-dark", CLOSING, 800, 1.5, "dark"),
    picture(LAP, "start", "course=apartment", 800, 1.0, "light"),
    picture(LAP, "overlays", "step=60&universe=9&truth=on&raw=on", 800, 1.0, "dark"),
    picture(LAP, "end-narrow", "step=90&truth=on&raw=on", 340, 2.0, "light"),
    picture(LAP, "phone", RESAMPLED, 380, 1.0, "contrast-dark"),
    picture(LAP, "tiny", RESAMPLED, 240, 1.0, "contrast-light"),
    picture(LAP, "lap-lens", "v=13&step=8", 692, 1.0, "light"),
    picture(LAP, "lap-survivors", "v=13&step=92", 692, 1.0, "dark"),
    picture(LAP, "one", "universes=1&step=30", 640, 1.0, "light"),
    picture(LAP, "motion-64", "universes=64&proposal=motion&matcher=cell&step=41", 800, 1.0, "light"),
    picture(LAP, "motion-256", "universes=256&proposal=motion&matcher=cell&step=12", 800, 1.0, "dark"),
    picture(LAP, "motion-256-narrow", "universes=256&proposal=motion&matcher=cell&step=12", 340, 1.0, "light"),
    picture(PROPOSAL, "fastslam-proposal-light", "", 800, 1.5, "light"),
    picture(PROPOSAL, "fastslam-proposal-dark", "", 800, 1.5, "dark"),
    picture(PROPOSAL, "proposal-pair", "landmarks=pair", 1000, 1.0, "light"),
    picture(PROPOSAL, "proposal-guess", "predict=on&guess=3.5&range-std=0.1", 380, 1.0, "contrast-light"),
    picture(PROPOSAL, "proposal-run", "predict=on&guess=3.5&run=on&samples=4096", 800, 1.0, "dark"),
    picture(PROPOSAL, "proposal-near", "odometry=2&landmark-x=0.9&landmark-y=-0.5&range-std=0.02", 640, 1.0, "light"),
    picture(PROPOSAL, "proposal-tiny", "landmarks=pair&samples=1&predict=on&run=on", 240, 1.0, "contrast-dark"),
    picture(WORKED, "fastslam-worked-example-light", "", 800, 1.5, "light"),
    picture(WORKED, "fastslam-worked-example-dark", "", 800, 1.5, "dark"),
    picture(WORKED, "worked-phone", "", 340, 2.0, "light"),
    picture(WORKED, "worked-poses", POSES, 728, 1.0, "light"),
    picture(WORKED, "worked-poses-narrow", POSES, 588, 1.0, "dark"),
    picture(WORKED, "worked-every-step", EVERY_STEP, 980, 1.0, "light"),
    picture(WORKED, "worked-extremes", EXTREMES, 720, 1.0, "contrast-dark"),
    picture(CONDITIONING, "fastslam-conditioning-light", "", 800, 1.5, "light"),
    picture(CONDITIONING, "fastslam-conditioning-dark", "", 800, 1.5, "dark"),
    picture(CONDITIONING, "conditioned", "condition=on", 1280, 1.0, "light"),
    picture(CONDITIONING, "conditioning-24", "landmarks=24&poses=12&step=12&row=5&column=40", 800, 1.0, "dark"),
    picture(CONDITIONING, "conditioning-half", "landmarks=12&step=4&row=3&column=3", 340, 2.0, "light"),
    picture(CONDITIONING, "conditioning-phone", "", 380, 1.0, "contrast-dark"),
    picture(CONDITIONING, "conditioning-tiny", "landmarks=24&odometry=3&condition=on", 240, 1.0, "contrast-light"),
    picture(LOG, "log-light", TINY, 800, 1.5, "light"),
    picture(LOG, "log-dark", TINY, 800, 1.5, "dark"),
    picture(LOG, "log-phone", "universes=40&cell=0.1&min-travel=0.3&raw=on", 340, 2.0, "light"),
    picture(LOG, "log-contrast", "universes=1&cell=0.2", 380, 1.0, "contrast-dark"),
    picture(LOG, "log-odometry-light", "odometry=on&raw=on", 800, 1.0, "light"),
    picture(LOG, "log-odometry-dark", "odometry=on&raw=on", 340, 2.0, "dark"),
    picture(LOG, "log-tiny", "policy=always&cell=0.1&seed=4", 240, 1.0, "contrast-light"),
    picture(RESAMPLING, "fastslam-resampling-light", COALESCED, 800, 1.5, "light"),
    picture(RESAMPLING, "fastslam-resampling-dark", COALESCED, 800, 1.5, "dark"),
    picture(RESAMPLING, "chapter-resampling-light", "v=4&wings=on&step=104", 800, 1.5, "light"),
    picture(RESAMPLING, "chapter-resampling-dark", "v=4&wings=on&step=104", 800, 1.5, "dark"),
    picture(RESAMPLING, "resampling-wings", "wings=on&step=101", 1112, 1.0, "light"),
    picture(
        RESAMPLING,
        "resampling-64",
        "wings=on&particles=64&scheme=multinomial&policy=always&step=90&cursor=70",
        800,
        1.0,
        "dark",
    ),
    picture(RESAMPLING, "resampling-start", "", 728, 1.0, "light"),
    picture(RESAMPLING, "resampling-guess", "predict=on", 340, 2.0, "light"),
    picture(RESAMPLING, "resampling-judged", "predict=on&guess=40&run=on&policy=always", 800, 1.0, "dark"),
    picture(RESAMPLING, "resampling-phone", "wings=on&step=80&cursor=70&back=3", 340, 2.0, "light"),
    picture(RESAMPLING, "resampling-contrast", "particles=8&step=30&policy=never", 380, 1.0, "contrast-dark"),
    picture(RESAMPLING, "resampling-tiny", "particles=4&threshold=1&step=12", 240, 1.0, "contrast-light"),
    picture(DOORS, "fastslam-doors-light", "", 800, 1.5, "light"),
    picture(DOORS, "fastslam-doors-dark", "", 800, 1.5, "dark"),
    picture(DOORS, "chapter-doors-light", "step=47", 800, 1.5, "light"),
    picture(DOORS, "chapter-doors-dark", "step=47", 800, 1.5, "dark"),
    picture(DOORS, "doors-before-the-sign", "step=58", 1112, 1.0, "light"),
    picture(DOORS, "doors-ride", "step=43&ride=8&proposal=aware", 728, 1.0, "dark"),
    picture(DOORS, "doors-phone", "step=46&seed=2&door-7=1.5", 340, 2.0, "light"),
    picture(DOORS, "doors-contrast", "particles=1000&door-5=16&step=52", 380, 1.0, "contrast-dark"),
    picture(DOORS, "doors-tiny", "particles=1&step=9", 240, 1.0, "contrast-light"),
    picture(UNIVERSES, "fastslam-universes-light", "", 800, 1.5, "light"),
    picture(UNIVERSES, "fastslam-universes-dark", "", 800, 1.5, "dark"),
    picture(UNIVERSES, "universes-strict", "threshold=0.05&seeds=50&universes=3", 692, 1.0, "light"),
    picture(UNIVERSES, "universes-asked", "predict=on&guess=20", 692, 1.0, "dark"),
    picture(UNIVERSES, "universes-judged", GUESSES, 340, 2.0, "light"),
    picture(UNIVERSES, "universes-phone", "proposals=motion&universes=24&odometry=2", 380, 1.0, "contrast-dark"),
    picture(UNIVERSES, "universes-tiny", "threshold=0.03&seeds=1", 240, 1.0, "contrast-light"),
    picture(JOINT, "fastslam-joint-light", "", 800, 1.5, "light"),
    picture(JOINT, "fastslam-joint-dark", "", 800, 1.5, "dark"),
    picture(JOINT, "joint-exercise", "odometry=0&landmarks=5", 692, 1.0, "light"),
    picture(JOINT, "joint-asked", "odometry=0&predict=on", 692, 1.0, "dark"),
    picture(JOINT, "joint-judged", "odometry=0&predict=on&guess=10&run=on", 340, 2.0, "light"),
    picture(JOINT, "joint-phone", "landmarks=3&particles=200&sensor=2", 340, 2.0, "light"),
    picture(GRAPH, "fastslam-graph-light", BENT, 800, 1.5, "light"),
    picture(GRAPH, "fastslam-graph-dark", BENT, 800, 1.5, "dark"),
    picture(GRAPH, "graph-folded", "wrong=on&step=60", 692, 1.0, "light"),
    picture(GRAPH, "graph-mended", "repair=switchable&wrong=on&step=60", 1112, 1.0, "dark"),
    picture(GRAPH, "graph-phone", "repair=robust&wrong=on&wrong-from=30&wrong-to=80&step=1", 340, 2.0, "light"),
    picture(GRAPH, "graph-tiny", "course=apartment&odometry=2&start=matches&universes=3", 240, 1.0, "contrast-dark"),
    picture(JOINT, "joint-tiny", "particles=1&odometry=3", 240, 1.0, "contrast-dark"),
    picture(EM, "fastslam-em-light", "", 800, 1.5, "light"),
    picture(EM, "fastslam-em-dark", "", 800, 1.5, "dark"),
    picture(EM, "em-fold", "mark-3=5.2", 692, 1.0, "light"),
    picture(EM, "em-backward", "step=6", 1112, 1.0, "dark"),
    picture(EM, "em-phone", "step=13&seed=2&sensor=20", 340, 2.0, "light"),
    picture(EM, "em-tiny", "step=0&particles=1&trust=50", 240, 1.0, "contrast-dark"),
    picture(SMOOTHING, "fastslam-smoothing-light", "", 800, 1.5, "light"),
    picture(SMOOTHING, "fastslam-smoothing-dark", "", 800, 1.5, "dark"),
    picture(SMOOTHING, "smoothing-filter", "step=0&particles=30", 1112, 1.0, "light"),
    picture(SMOOTHING, "smoothing-phone", "step=5&particles=4", 340, 2.0, "light"),
    picture(GRAPH, "graph-asked", "wrong=on&predict=on", 692, 1.0, "dark"),
    picture(GRAPH, "graph-judged", "wrong=on&predict=on&guess=0.5&run=on", 340, 2.0, "light"),
    picture(EM, "em-asked", "mark-3=5.2&predict=on", 692, 1.0, "light"),
    picture(EM, "em-judged", "mark-3=5.2&predict=on&guess=4&run=on", 340, 2.0, "light"),
    picture(SMOOTHING, "smoothing-asked", "predict=on&guess=7", 692, 1.0, "light"),
    picture(SMOOTHING, "smoothing-judged", "predict=on&guess=7&run=on", 340, 2.0, "dark"),
    picture(VIGNETTE, "vignette-comb-light", "which=comb&at=10", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-comb-dark", "which=comb&at=10", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-comb-phone", "which=comb&at=10", 340, 1.0, "contrast-dark"),
    picture(VIGNETTE, "vignette-halves-light", "which=halves&at=3", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-halves-dark", "which=halves&at=3", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-halves-phone", "which=halves&at=3", 340, 1.0, "contrast-light"),
    picture(VIGNETTE, "vignette-overlap-light", "which=overlap&at=28", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-overlap-dark", "which=overlap&at=28", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-overlap-phone", "which=overlap&at=28", 340, 1.0, "contrast-light"),
    picture(VIGNETTE, "vignette-tree-light", "which=tree&at=20", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-tree-dark", "which=tree&at=20", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-tree-phone", "which=tree&at=20", 340, 1.0, "contrast-dark"),
    picture(VIGNETTE, "vignette-beams-light", "which=beams&at=9", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-beams-dark", "which=beams&at=9", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-beams-phone", "which=beams&at=9", 340, 1.0, "contrast-dark"),
    picture(VIGNETTE, "vignette-slip-light", "which=slip&at=18", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-slip-dark", "which=slip&at=18", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-slip-phone", "which=slip&at=18", 340, 1.0, "contrast-light"),
    picture(VIGNETTE, "vignette-look-light", "which=look&at=27", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-look-dark", "which=look&at=27", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-look-phone", "which=look&at=27", 340, 1.0, "contrast-dark"),
    picture(VIGNETTE, "vignette-names-light", "which=names&at=30", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-names-dark", "which=names&at=30", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-names-phone", "which=names&at=30", 340, 1.0, "contrast-light"),
    picture(VIGNETTE, "vignette-tiles-light", "which=tiles&at=14", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-tiles-dark", "which=tiles&at=14", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-tiles-phone", "which=tiles&at=14", 340, 1.0, "contrast-dark"),
    picture(VIGNETTE, "vignette-surface-light", "which=surface&at=12", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-surface-dark", "which=surface&at=12", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-surface-phone", "which=surface&at=12", 340, 1.0, "contrast-light"),
    picture(VIGNETTE, "vignette-cells-light", "which=cells&at=68", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-cells-dark", "which=cells&at=68", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-cells-phone", "which=cells&at=68", 340, 1.0, "contrast-dark"),
    picture(VIGNETTE, "vignette-lottery-light", "which=lottery&at=19", 560, 1.5, "light"),
    picture(VIGNETTE, "vignette-lottery-dark", "which=lottery&at=19", 560, 1.5, "dark"),
    picture(VIGNETTE, "vignette-lottery-phone", "which=lottery&at=19", 340, 1.0, "contrast-light"),
    picture(SMOOTHING, "smoothing-tiny", "particles=2&odometry=3&sensor=2&at=62", 240, 1.0, "contrast-dark"),
];

/// What a filter does: one sighting for both particles, from two poses; and the landmark's ellipse is turned.
const POSES: &str = "x2=0.4&y2=-0.3&theta2=0.08&r2=4.1&phi2=0.05&sigma-xy=0.09&threshold=0.8";

const EVERY_STEP: &str = "x2=0.4&y2=-0.3&theta2=0.08&r2=4.1&phi2=0.05&sigma-xy=0.09&threshold=0.8&all-steps=on";

/// Numbers of every size.
const EXTREMES: &str = "x1=-99.123456&y1=-12.5&theta1=-3.1415926&x2=4.000001&y2=0.000001&sigma-xx=0.0000321&sigma-xy=-0.0000123456&bearing-std=0.00123";

/// What the figure of logs shows at rest: the example that comes with it, mapped to its end. Four pictures of one run, which takes too long
/// to be made again for each of them and in every browser.
pub fn example() -> Figure {
    let mut figure = registry::figure(LOG).expect("a tag of the registry");
    figure.open(write(&Example::new(usize::MAX).log).as_bytes()).expect("the example is a log");
    figure.model_mut().seek(u32::MAX);
    figure.model_mut().settle();
    figure
}

/// The poster of a mapped log: its map with the paths and nothing around it, without a word. Its size and its pixels, RGBA.
pub fn poster(figure: &mut Figure, theme: Theme) -> ([u32; 2], Vec<u8>) {
    const WIDTH: f64 = 560.0;
    const DPR: f64 = 1.5;
    const MARGIN: u32 = 20;
    figure.show("map").expect("a panel");
    let (mut scene, map) = (figure.scene(WIDTH, figure.height(WIDTH)), LogLayout::new(WIDTH).map.expect("a map"));
    figure.show("all").expect("all panels");
    scene.marks.retain(|mark| match mark {
        Mark::Raster { .. } | Mark::Polygons { .. } => true,
        Mark::Lines { role, .. } => *role != Role::Ink, // of the scale bar
        _ => false,
    });
    let [width, height] = [scene.width, scene.height].map(|side| (DPR * side) as u32);
    let mut canvas = Canvas::default();
    canvas.paint(&scene, width, height, theme);
    let at = |x: u32, y: u32| &canvas.pixels()[4 * (y * width + x) as usize..][..4];
    // What there is to see of the building, and a margin. The map's first corner is of the world that nobody has seen.
    let (x0, y0) = ((DPR * map.x) as u32 + 2, (DPR * map.y) as u32 + 2);
    let (x1, y1) = (width - 2, (DPR * map.bottom()) as u32 - 2);
    let seen = |x: u32, y: u32| at(x, y) != at(x0, y0);
    let columns: Vec<u32> = (x0..x1).filter(|x| (y0..y1).any(|y| seen(*x, y))).collect();
    let rows: Vec<u32> = (y0..y1).filter(|y| (x0..x1).any(|x| seen(x, *y))).collect();
    let [left, top] = [columns[0].max(x0 + MARGIN) - MARGIN, rows[0].max(y0 + MARGIN) - MARGIN];
    let [right, bottom] = [(columns[columns.len() - 1] + MARGIN).min(x1), (rows[rows.len() - 1] + MARGIN).min(y1)];
    let pixels = (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y))).flat_map(|(x, y)| at(x, y).to_vec());
    ([right - left, bottom - top], in_256_colours(pixels.collect()))
}

/// The same in as many colours as a byte tells apart, which a third of the file is: the rarest ones become the nearest of the others.
fn in_256_colours(pixels: Vec<u8>) -> Vec<u8> {
    let mut counts = BTreeMap::<[u8; 4], u32>::new();
    let colours = || pixels.chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]);
    colours().for_each(|colour| *counts.entry(colour).or_default() += 1);
    let mut palette: Vec<([u8; 4], u32)> = counts.into_iter().collect();
    palette.sort_by_key(|(_, count)| Reverse(*count));
    palette.truncate(256);
    let distance =
        |a: &[u8; 4], b: &[u8; 4]| a.iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum::<u32>();
    let near = |colour| palette.iter().map(|(known, _)| known).min_by_key(|known| distance(known, &colour));
    colours().filter_map(near).flatten().copied().collect()
}

/// Cells as small as those of a large building would be more than a phone's screen has pixels.
const TINY: &str = "cell=0.1&raw=on";

/// The lap as the figure opens, at its telling step: most of the universes have just died.
const CLOSING: &str = "v=13&step=82";

/// A step of the apartment's lap at which it resampled.
const RESAMPLED: &str = "step=62";

/// Figures and setups whose readouts are kept for every step.
pub const SETUPS: &[(&str, &str)] = &[
    (LAP, "course=apartment"),
    (LAP, "v=9"),
    (LAP, "v=13"),
    (LAP, "universes=1"),
    (LAP, "universes=7&seed=5&proposal=motion&matcher=cell"),
    (LAP, "universes=24&policy=always&scheme=residual&odometry=1.5"),
    (LAP, "policy=never&range-std=0.1&scheme=multinomial"),
    (PROPOSAL, ""),
    (PROPOSAL, "landmarks=pair&seed=8"),
    (PROPOSAL, "range-std=0.005&bearing-std=0.01&samples=4096&predict=on&guess=7.5&run=on"),
    (PROPOSAL, "odometry=2&range-std=0.5&landmark-x=-0.1&landmark-y=0.3&samples=1"),
    (WORKED, ""),
    (WORKED, POSES),
    (WORKED, EXTREMES),
    (CONDITIONING, ""),
    (CONDITIONING, "condition=on&row=3&column=4"),
    (CONDITIONING, "odometry=3&range-std=0.01&landmarks=24&poses=12&row=48&column=7"),
    (CONDITIONING, "odometry=0&range-std=0.5&landmarks=3&poses=2"),
    (LOG, "cell=0.1"),
    (LOG, "universes=5&cell=0.2&max-range=4&policy=never&seed=3"),
    (RESAMPLING, ""),
    (RESAMPLING, "particles=5&seed=9&threshold=0.8&scheme=residual&odometry=2&range=3&back=4"),
    (RESAMPLING, "wings=on"),
    (RESAMPLING, "wings=on&particles=40&scheme=multinomial&odometry=0.5&range=0.25"),
    (DOORS, ""),
    (DOORS, "particles=60&seed=5&proposal=aware&ride=6&range=0.2&price=5&gate=95&door-5=16&door-7=1.5&end=4"),
    (UNIVERSES, ""),
    (UNIVERSES, "threshold=0.1&seeds=50&universes=27&bearing-std=0.01&odometry=2"),
    (UNIVERSES, GUESSES),
    (GRAPH, ""),
    (GRAPH, "repair=mixture&wrong=on&odometry=1&seed=9&start=matches&wrong-from=7&wrong-to=61&step=60"),
    (GRAPH, "repair=switchable&odometry=0&course=apartment&loops=off&universes=2&range-std=0.1&step=3"),
    (JOINT, ""),
    (JOINT, "landmarks=4&particles=2500&sensor=0.5&odometry=2&seed=7"),
    (JOINT, "landmarks=1&particles=1&sensor=5&odometry=0"),
    (EM, ""),
    (EM, "mark-3=5.2&iterations=40&step=57"),
    (EM, "odometry=0.2&sensor=30&seed=5&particles=300&trust=40&mark-1=0&mark-2=10&mark-3=4.4"),
    (SMOOTHING, "particles=8&step=6"),
    (SMOOTHING, "particles=2&odometry=3&sensor=0.25&seed=5&step=3&at=62"),
    (SMOOTHING, "particles=30&odometry=0.25&sensor=2&reconnect=off&step=4&at=1"),
];

/// Both proposals guessed, and the depletion.
const GUESSES: &str = "predict=on&guess=8&guess-aware=8&guess-floor=40&run=on";

/// Ancestors are fewer than particles, and the last common one is not long ago.
const COALESCED: &str = "v=4&step=70";

/// After the last iteration.
const BENT: &str = "v=3&step=60";

/// Experiments over the seeds from the first to before the second, whose rows are kept.
pub const JOBS: &[(&str, &str, [u32; 2])] = &[
    ("wings", "", [1, 5]),
    ("wings", "particles=9&threshold=0.7&odometry=1.5&range=0.5&scheme=stratified", [40, 43]),
    ("doors", "", [1, 5]),
    ("doors", "ride=6&proposal=aware&range=0.2&price=5&gate=95&policy=always&door-5=16", [40, 42]),
    ("laps", "course=apartment&odometry=1&range-std=0.02", [1, 3]),
    ("graphs", "course=apartment&odometry=1", [1, 4]),
    (
        "laps",
        "course=apartment&odometry=1&universes=4&proposal=motion&matcher=cell&policy=always&range-std=0.1&step=7",
        [1, 4],
    ),
];

/// The rows of a job, as a fingerprint.
pub fn rows(rows: impl IntoIterator<Item = f64>) -> Digest {
    let mut digest = Digest::new();
    rows.into_iter().for_each(|x| digest.f64(x));
    digest
}

/// The figure of a tag in the state that a link names, simulated.
///
/// # Panics
/// For an unknown tag or a link that is refused.
pub fn figure(tag: &str, query: &str) -> Figure {
    let mut figure = registry::figure(tag).expect("a tag of the registry");
    // A link of before is told what has changed since.
    let refused = figure.load(query).into_iter().filter(|error| error.parameter != "v").collect::<Vec<_>>();
    assert!(refused.is_empty(), "{query}: {refused:?}");
    if tag == LOG {
        figure.open(TINY_LOG).expect("the tiny log is a log");
        figure.model_mut().seek(u32::MAX);
    }
    figure.model_mut().settle();
    figure
}

impl Picture {
    /// Width and height \[device px\] for the height that the figure wants \[css px\].
    pub fn size(&self, height: f64) -> [u32; 2] {
        [f64::from(self.width), height].map(|side| (side * self.dpr).round() as u32)
    }

    /// Its line in the golden file: all that it takes to paint it again, and the size and value of its pixels' digest.
    pub fn line(&self, pixels: &Digest) -> String {
        let Self { name, tag, query, width, dpr, theme } = self;
        line(&format!("{name} {tag}?{query} {width} {dpr} {theme}"), pixels)
    }

    /// Whether both show a figure in one state, which is simulated once.
    pub fn is_of_the_state_of(&self, other: &Self) -> bool {
        (self.tag, self.query) == (other.tag, other.query)
    }

    /// Paints it, its figure being in its state: width and height \[device px\].
    pub fn paint(&self, figure: &mut Figure) -> [u32; 2] {
        let size = self.size(figure.height(f64::from(self.width)));
        figure.paint(size[0], size[1], self.dpr, Theme::named(self.theme));
        size
    }
}

/// Puts one readout's bits and text into a digest, by what the page gets of it.
pub fn put_readout(digest: &mut Digest, name: &str, value: Option<f64>, text: &str) {
    digest.write(name.as_bytes());
    digest.u32(u32::from(value.is_some()));
    digest.f64(value.unwrap_or(0.0));
    digest.write(text.as_bytes());
}

/// Every readout of every step of a figure, and what is said of it, as a fingerprint: as a page shows it.
pub fn readouts(tag: &str, query: &str) -> Digest {
    let mut figure = figure(tag, query);
    let mut digest = Digest::new();
    for step in 0..=figure.model().step_count() {
        figure.model_mut().seek(step);
        figure.model_mut().settle();
        for Readout { name, value, text, .. } in figure.readouts() {
            put_readout(&mut digest, name, value, &text);
        }
        digest.write(figure.describe().as_bytes());
    }
    digest
}

/// One line of a golden file: a name, and the size and value of its digest.
pub fn line(name: &str, digest: &Digest) -> String {
    format!("{name} {} {:016x}\n", digest.size(), digest.value())
}
