//! Exact pictures and numbers. A change that is wanted is written with `UPDATE_GOLDENS=1 cargo test -p figures`, looked at, and
//! committed.

use crate::characters;
use core::hash::Hasher as _;
use fastslam::{random::Stream, sensor::BeamSensor};
use fastslam_lab::{
    digest::Digest,
    experiment::lap::{LapSetup, LapWorld},
};
use fastslam_widgets::decimal::fixed;
use fastslam_widgets::{paint::Theme, registry};
use figures::{JOBS, LOG, PICTURES, Picture, SETUPS, example, figure, line, poster, readouts, rows};
use std::{
    collections::BTreeSet,
    env, fs,
    io::BufWriter,
    path::{Path, PathBuf},
};

fn golden(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(file)
}

/// Those that pages show in place of a figure lie with the figures: at rest, in a state of the chapter's, and vignettes, in both themes.
fn picture(name: &str) -> PathBuf {
    let of_pages = ["fastslam-", "chapter-", "vignette-"].iter().any(|of| name.starts_with(of))
        && ["-light", "-dark"].iter().any(|shade| name.ends_with(shade));
    let folder = if of_pages { "../../widgets/pictures" } else { "golden" };
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).join(format!("{name}.png"))
}

fn update() -> bool {
    env::var_os("UPDATE_GOLDENS").is_some()
}

/// RGB is enough: every pixel is opaque.
fn rgb(rgba: &[u8]) -> Vec<u8> {
    assert!(rgba.chunks_exact(4).all(|p| p[3] == 255), "a pixel is not opaque");
    rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect()
}

/// Indexed where 256 colours are enough, which a third of the bytes is.
fn write_png(path: &Path, [width, height]: [u32; 2], pixels: &[u8]) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let file = BufWriter::new(fs::File::create(path).unwrap());
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::NoFilter);
    let colors: BTreeSet<&[u8]> = pixels.chunks_exact(3).collect();
    let data = if colors.len() <= 256 {
        let palette: Vec<&[u8]> = colors.into_iter().collect();
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(palette.concat());
        pixels.chunks_exact(3).map(|pixel| palette.binary_search(&pixel).unwrap() as u8).collect()
    } else {
        encoder.set_color(png::ColorType::Rgb);
        pixels.to_vec()
    };
    encoder.write_header().unwrap().write_image_data(&data).unwrap();
}

fn read_png(path: &Path) -> Option<([u32; 2], Vec<u8>)> {
    let file = std::io::BufReader::new(fs::File::open(path).ok()?);
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().ok()?;
    let mut pixels = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut pixels).ok()?;
    Some(([info.width, info.height], pixels))
}

/// Compares a text file, or writes it.
fn same_text(file: &str, text: &str) {
    if update() {
        fs::write(golden(file), text).unwrap();
    }
    let kept = fs::read_to_string(golden(file)).unwrap_or_default();
    for (kept, now) in kept.lines().zip(text.lines()) {
        assert_eq!(kept, now, "{file}: the number changed; UPDATE_GOLDENS=1 writes it if that is wanted");
    }
    assert_eq!(kept.lines().count(), text.lines().count(), "{file}: UPDATE_GOLDENS=1 writes new lines");
}

#[test]
fn every_picture_is_the_golden_one_to_the_last_pixel() {
    // A thread for each share of them: by one it takes longer than all other tests of this program.
    let states: Vec<&[Picture]> = PICTURES.chunk_by(Picture::is_of_the_state_of).collect();
    let shares = states.chunks(states.len().div_ceil(8));
    let painted: Vec<_> = std::thread::scope(|scope| {
        let paint = |share: &[&[Picture]]| share.iter().flat_map(|state| painted(state)).collect::<Vec<_>>();
        let threads: Vec<_> = shares.map(|share| scope.spawn(move || paint(share))).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    let (lines, wrong): (Vec<String>, Vec<Option<String>>) = painted.into_iter().unzip();
    let wrong: Vec<String> = wrong.into_iter().flatten().collect();
    assert!(wrong.is_empty(), "{LOOK}\n{}", wrong.join("\n"));
    same_text("pixels.txt", &lines.concat()); // what the browser compares
}

/// Of the pictures of one state, each one's line in the golden file, and what is wrong with its pixels.
fn painted(state: &[Picture]) -> Vec<(String, Option<String>)> {
    let mut figure = figure(state[0].tag, state[0].query);
    let painted = state.iter().map(|picture| {
        let (size, width) = (picture.paint(&mut figure), f64::from(picture.width));
        let missing = characters::missing(&figure.scene(width, figure.height(width)));
        assert_eq!(missing, "", "{}: the font lacks them", picture.name);
        let mut digest = Digest::new();
        digest.write(figure.canvas().pixels());
        (picture.line(&digest), differs(picture.name, size, figure.canvas().pixels()))
    });
    painted.collect()
}

const LOOK: &str = "look at both, then UPDATE_GOLDENS=1 if the change is wanted:";

/// Compares a picture, or writes it: what is wrong with it.
fn differs(name: &str, size: [u32; 2], pixels: &[u8]) -> Option<String> {
    let (kept, pixels) = (picture(name), rgb(pixels));
    if update() {
        write_png(&kept, size, &pixels);
    }
    if read_png(&kept).as_ref() == Some(&(size, pixels.clone())) {
        return None;
    }
    let actual = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
    write_png(&actual, size, &pixels);
    Some(format!("{} is not {}", actual.display(), kept.display()))
}

#[test]
fn the_log_at_rest_and_its_poster_are_the_example_mapped_to_its_end() {
    let (mut figure, mut wrong) = (example(), Vec::new());
    assert!(figure.describe().starts_with("All scans are mapped."));
    for (shade, theme) in [("light", Theme::Light), ("dark", Theme::Dark)] {
        let size = [800.0, figure.height(800.0)].map(|side| (1.5 * side) as u32);
        figure.paint(size[0], size[1], 1.5, theme);
        wrong.extend(differs(&format!("fastslam-log-{shade}"), size, figure.canvas().pixels()));
        let (size, pixels) = poster(&mut figure, theme);
        wrong.extend(differs(&format!("fastslam-log-poster-{shade}"), size, &pixels));
    }
    assert!(wrong.is_empty(), "{LOOK}\n{}", wrong.join("\n"));
}

/// A run in front of one that was pinned: name, figure, the pinned state, the state shown, and a width \[css px\].
const PINNED: [(&str, &str, &str, &str, f64); 9] = [
    ("lap-pinned", "fastslam-lap", "step=80", "universes=4&odometry=1.5&step=60", 800.0),
    ("resampling-pinned", "fastslam-resampling", "step=80", "threshold=0.9&particles=40&step=60", 728.0),
    ("resampling-pinned-phone", "fastslam-resampling", "wings=on&step=90", "wings=on&threshold=0.1&step=70", 340.0),
    ("doors-pinned", "fastslam-doors", "seed=2", "step=58", 728.0),
    ("proposal-pinned", "fastslam-proposal", "range-std=0.3&samples=300", "landmark-y=0.6", 800.0),
    ("graph-pinned", "fastslam-graph", "wrong=on", "repair=robust&wrong=on&step=2", 692.0),
    ("joint-pinned", "fastslam-joint", "sensor=2", "particles=400&landmarks=6", 692.0),
    ("em-pinned", "fastslam-em", "mark-3=5.2", "step=93", 800.0),
    ("smoothing-pinned", "fastslam-smoothing", "particles=4", "particles=12&at=20", 692.0),
];

#[test]
fn the_curves_of_a_pinned_run_are_behind_those_of_the_one_shown() {
    let mut wrong = Vec::new();
    for (name, tag, pinned, query, width) in PINNED {
        let curves = figure(tag, pinned).model().curves();
        let mut shown = figure(tag, query);
        shown.model_mut().haunt(curves.clone());
        for (shade, theme) in [("light", Theme::Light), ("dark", Theme::Dark)] {
            let size = [width, shown.height(width)].map(|side| side as u32);
            shown.paint(size[0], size[1], 1.0, theme);
            wrong.extend(differs(&format!("{name}-{shade}"), size, shown.canvas().pixels()));
        }
    }
    assert!(wrong.is_empty(), "{LOOK}\n{}", wrong.join("\n"));
}

#[test]
fn every_readout_of_every_step_is_the_golden_one() {
    let kept = SETUPS.iter().map(|(tag, query)| line(&format!("{tag}?{query}"), &readouts(tag, query)));
    same_text("readouts.txt", &kept.collect::<String>());
}

/// A lap of the apartment as CARMEN would have logged it: 120 beams all around, of at most 8 m, in millimetres.
fn simulated_log() -> String {
    const BEAMS: usize = 120;
    let world = LapWorld::new(7, &LapSetup::default().motion(), 0.02);
    let sensor = BeamSensor::panorama(BEAMS, 8.0, 0.02);
    let mut log = String::from("# A simulated lap, written by tests/figures.\n");
    for (k, (truth, odometry)) in world.truth.iter().zip(&world.odometry).enumerate() {
        let ranges = world.plan.ranges(truth, &sensor, &mut Stream::at(7, fastslam_lab::WORLD_SENSOR, k as u32, 9));
        let ranges: Vec<String> = ranges.iter().map(|range| fixed(range.min(sensor.max_range), 3)).collect();
        let pose = [odometry.x, odometry.y, odometry.theta].map(|x| fixed(x, 6)).join(" ");
        let step = fixed(core::f64::consts::TAU / BEAMS as f64, 9);
        let time = fixed(0.5 * k as f64, 3);
        log += &format!(
            "ROBOTLASER1 0 0 {} {step} 8 0.01 0 {BEAMS} {} 0 {pose} {pose} 0 0 0 0 0 {time} simulated {time}\n",
            fixed(core::f64::consts::TAU, 6),
            ranges.join(" ")
        );
    }
    log
}

#[test]
fn the_tiny_log_is_what_the_simulator_writes() {
    same_text("tiny.clf", &simulated_log());
}

#[test]
fn the_tiny_log_has_the_fingerprint_that_the_page_shows() {
    let readouts = figure(LOG, "cell=0.1").model().readouts();
    let digest = readouts.iter().find(|readout| readout.name == "digest").unwrap();
    same_text("log-digest.txt", &format!("{}\n", digest.text));
}

#[test]
fn every_job_gives_the_golden_rows() {
    let kept = JOBS.iter().map(|(name, query, [from, to])| {
        let found = registry::count(name, query, u64::from(*from)..u64::from(*to)).unwrap();
        line(&format!("{name}?{query}"), &rows(found.concat()))
    });
    same_text("jobs.txt", &kept.collect::<String>());
}

#[test]
fn the_page_without_javascript_shows_a_resampling() {
    for picture in &PICTURES[..2] {
        let told = figure(picture.tag, picture.query).model().describe();
        assert!(told.contains("died out"), "{told} Choose another step for {}.", picture.name);
    }
}

#[test]
fn what_stands_for_a_figure_is_its_telling_step() {
    for picture in PICTURES.iter().filter(|picture| picture.name == format!("{}-light", picture.tag)) {
        let mut telling = figure(picture.tag, "");
        let step = telling.telling("v=latest");
        if step > 0 {
            telling.model_mut().seek(step);
            telling.model_mut().settle();
        }
        assert_eq!(figure(picture.tag, picture.query).query(), telling.query(), "{}", picture.name);
    }
}
