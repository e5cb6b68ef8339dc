//! The mapping of a log as a deterministic state: what was set, which log is open, and how far it is mapped.
//!
//! A link holds the settings alone: the log is a reader's file, and no link can bring it.

use super::{
    layout::{Layout, NARROWEST},
    recipe::Recipe,
    scene,
    tree::{Death, FADE},
    view::{Frame, View},
};
use crate::decimal::{fixed, write};
use crate::{
    model::{Column, Declared, FigureError, Model, Readout, Series, unexplained},
    scene::{Point, Scene},
};
use fastslam::{
    log::{LaserLog, LogError, parse, swept_area, write_tum},
    map::{Footprint, grid::MapImage},
    mapper::{LaserMapper, LaserMapperSettings, Replay},
    rbpf::Report,
    resampling::ResamplePolicy,
};
use fastslam_lab::experiment::log::digest;
use std::sync::Arc;

/// Steps back of the lineage gauge.
pub const BACK: u32 = 20;

/// Most memory that maps and paths may take \[bytes\]: a quarter of what WebAssembly can address.
const LIMIT: f64 = 1e9;

/// What a map takes at the most: for each cell of the swept area, and for the walls in it, of which a square metre has about two
/// metres, a cell thick \[bytes\]. The tests hold mapped logs against it.
const CELL_BYTES: f64 = 4.0;
const WALL_BYTES: f64 = 2.0 * 45.0;

/// A population that resamples shares its past. What it does not share has some M log₂ M nodes (Jacob, Murray and Rubenthaler 2015), and
/// each node has written one scan: this many times as many are reckoned with.
const BUSH: f64 = 2.0;

/// Scans of which one's own area is taken.
const SAMPLES: usize = 32;

/// What a pose in the tree of all paths takes \[bytes\].
const NODE_BYTES: f64 = 56.0;

/// Steps between two looks at the memory of all maps: a look takes as long as a step does.
const LOOK: u32 = 20;

/// A recorded log, mapped.
pub struct LogModel {
    recipe: Recipe,
    opened: Option<Opened>,
    /// The step asked for.
    asked: u32,
    /// From the first step on.
    replay: Option<Replay>,
    /// Of every step, from 1 on.
    history: Vec<Moment>,
    /// Of the last `FADE` steps.
    deaths: Vec<Death>,
    /// The maps' memory at its largest.
    peak: Footprint,
    /// What the reader looks at; `None` is the whole.
    frame: Option<Frame>,
}

/// A log that was read.
struct Opened {
    log: Arc<LaserLog>,
    /// Area \[m²\] that its beams sweep up to the longest range that is set, and a single scan's.
    swept: [f64; 2],
    /// Length of the way by raw odometry \[m\].
    way: f64,
}

/// What one step did.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Moment {
    /// Log of the evidence by the filter \[nats\]; −∞ where no universe explains the scan.
    pub log_evidence: f64,
    /// N_eff before resampling.
    pub ess: f64,
    /// Whether it resampled.
    pub resampled: bool,
    /// Universes without offspring.
    pub died: u32,
    /// Distinct ancestors [`BACK`] steps ago.
    pub lineage: u32,
    /// The latest step up to which all universes share one path.
    pub shared: u32,
}

impl Default for LogModel {
    fn default() -> Self {
        Self {
            recipe: Recipe::default(),
            opened: None,
            asked: 0,
            replay: None,
            history: Vec::new(),
            deaths: Vec::new(),
            peak: Footprint { unique: 0, dense: 0 },
            frame: None,
        }
    }
}

impl Opened {
    fn new(log: LaserLog, setup: &LaserMapperSettings) -> Self {
        let way = log.scans.windows(2).map(|pair| pair[0].odometry.distance(&pair[1].odometry)).sum();
        Self { swept: swept(&log, setup.max_range), log: Arc::new(log), way }
    }

    /// Memory \[bytes\] that so many universes with cells of this size take at the most.
    fn bytes(&self, setup: &LaserMapperSettings, universes: usize) -> f64 {
        let m = universes as f64;
        let map = |area: f64| area / setup.cell_size * (CELL_BYTES / setup.cell_size + WALL_BYTES);
        let [all, one] = self.swept.map(map);
        let shares = match setup.policy {
            ResamplePolicy::Never => false,
            ResamplePolicy::Always => true,
            ResamplePolicy::EssBelow(fraction) => fraction > 0.0,
        };
        // Whole numbers: the bits of M.
        let bush = BUSH * m * f64::from(usize::BITS - universes.leading_zeros());
        // Of maps and of paths: what all have, and for each node of the bush what one step adds.
        let of = |all: f64, one: f64| if shares { (m * all).min(all + bush * one) } else { m * all };
        of(all, one) + of(NODE_BYTES * self.log.scans.len() as f64, NODE_BYTES)
    }
}

/// Areas \[m²\] that all scans sweep together, and one alone, the largest of some.
fn swept(log: &LaserLog, max_range: f64) -> [f64; 2] {
    let samples = log.scans.iter().step_by(log.scans.len().div_ceil(SAMPLES));
    let one = samples.map(|scan| swept_area(core::slice::from_ref(scan), max_range)).fold(0.0, f64::max);
    [swept_area(&log.scans, max_range), one]
}

impl LogModel {
    /// Title for readers.
    pub const TITLE: &'static str = "A building from a log: map one of your own";

    /// The log, once one is open.
    pub fn log(&self) -> Option<&LaserLog> {
        self.opened.as_ref().map(|opened| &*opened.log)
    }

    /// What was set.
    pub fn setup(&self) -> &LaserMapperSettings {
        &self.recipe.setup
    }

    /// The mapper, once it was asked for.
    pub fn mapper(&self) -> Option<&LaserMapper> {
        self.replay.as_ref().map(Replay::mapper)
    }

    /// Of every step, from 1 on.
    pub fn history(&self) -> &[Moment] {
        &self.history
    }

    /// What died out in the last `FADE` steps, by step.
    pub fn deaths(&self) -> &[Death] {
        &self.deaths
    }

    /// Whether raw odometry is drawn: what there is to see before the first step.
    pub fn shows_raw(&self) -> bool {
        self.recipe.raw || self.replay.is_none()
    }

    /// The part of the world that is shown.
    pub fn view(&self, layout: &Layout) -> Option<View> {
        let whole = || match (self.mapper(), self.log()) {
            (Some(mapper), _) => Some(Frame::of_map(mapper.map())),
            (None, Some(log)) => {
                let corner = |pick: fn(f64, f64) -> f64, start: f64| {
                    let fold = |corner: [f64; 2], x, y| [pick(corner[0], x), pick(corner[1], y)];
                    log.scans.iter().fold([start; 2], |c, scan| fold(c, scan.odometry.x, scan.odometry.y))
                };
                Some(Frame::around(corner(f64::min, f64::INFINITY), corner(f64::max, f64::NEG_INFINITY)))
            }
            _ => None,
        };
        let frame = self.frame.or_else(whole)?;
        Some(View::new(layout.map, &frame))
    }

    /// Memory that the maps may take at the most \[bytes\].
    pub fn estimate(&self) -> Option<f64> {
        Some(self.opened.as_ref()?.bytes(self.setup(), self.setup().particles))
    }

    /// Forgets what was computed.
    fn restart(&mut self) {
        self.replay = None;
        self.asked = 0;
        self.history.clear();
        self.deaths.clear();
        self.peak = Footprint { unique: 0, dense: 0 };
    }

    fn look(&mut self, move_to: impl Fn(View) -> View, width: f64) {
        self.frame = self.view(&Layout::new(width)).map(|view| move_to(view).frame());
    }

    /// What the step that was just made did.
    fn note(&mut self, report: &Report<()>) {
        let Some(replay) = &self.replay else { return };
        let descent = replay.mapper().filter().descent();
        let (step, paths): (u32, Vec<_>) = (report.step, report.extinct().cloned().collect());
        self.history.push(Moment {
            log_evidence: report.log_evidence,
            ess: report.ess,
            resampled: report.resampled(),
            died: paths.len() as u32,
            lineage: descent.lineage(BACK),
            shared: descent.coalescence().unwrap_or(0),
        });
        self.deaths.retain(|death| step - death.step < FADE);
        if !paths.is_empty() {
            self.deaths.push(Death { step, paths });
        }
        if step.is_multiple_of(LOOK) || step == replay.step_count() {
            let now = replay.mapper().footprint();
            if now.unique > self.peak.unique {
                self.peak = now;
            }
        }
    }

    /// The log in words, before it is mapped.
    fn told(&self, opened: &Opened) -> String {
        let (log, setup) = (&opened.log, self.setup());
        let minutes = (log.scans[log.scans.len() - 1].time - log.scans[0].time) / 60.0;
        let mut text = format!(
            "{} scans of up to {} beams, over {} m by raw odometry and {} min. ",
            log.scans.len(),
            log.scans.iter().map(|scan| scan.ranges.len()).max().unwrap_or(0),
            fixed(opened.way, 0),
            fixed(minutes, 0)
        );
        let notes = &log.notes;
        let unknown: u32 = notes.unknown.iter().map(|(_, count)| count).sum();
        for (count, what) in [
            (notes.malformed, "malformed lines"),
            (unknown, "messages of other kinds"),
            (notes.rear, "scans of a rear laser"),
        ] {
            if count > 0 {
                text += &format!("Left out: {what}, {count}. ");
            }
        }
        let estimate = self.estimate().unwrap_or(0.0);
        text += &format!(
            "{} universes with cells of {} m take at most {} MB of memory.",
            setup.particles,
            write(setup.cell_size),
            megabytes(estimate)
        );
        text
    }

    fn progress(&self, replay: &Replay) -> String {
        let (step, last) = (self.history.len() as u32, replay.step_count());
        let m = self.setup().particles;
        let start =
            if step == last { "All scans are mapped".into() } else { format!("Scan {step} of {last} is mapped") };
        let Some(moment) = self.history.last() else { return "All universes start alike, with the first scan.".into() };
        let mut text = format!(
            "{start}. {}N_eff is {} of {m}; all universes share one path up to scan {}. ",
            unexplained(moment.log_evidence),
            fixed(moment.ess, 1),
            moment.shared
        );
        text += &match self.history.iter().rposition(|moment| moment.died > 0) {
            Some(last) => {
                format!("At the last resampling, at scan {}, {} of {m} died out.", last + 1, self.history[last].died)
            }
            None => "None has died out.".into(),
        };
        text
    }
}

/// In whole MB, or tenths where there are few.
fn megabytes(bytes: f64) -> String {
    let megabytes = bytes / 1e6;
    if megabytes < 10.0 { fixed(megabytes, 1) } else { fixed(megabytes, 0) }
}

/// What is wrong with a file, in a line.
fn unreadable(LogError { line, message }: &LogError) -> FigureError {
    let place = if *line > 0 { format!("line {line}: ") } else { String::new() };
    FigureError { parameter: "file".into(), message: format!("{place}{message}") }
}

impl Declared for LogModel {
    type Recipe = Recipe;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        if recipe.setup != self.recipe.setup {
            if let Some(opened) = &mut self.opened
                && recipe.setup.max_range != self.recipe.setup.max_range
            {
                opened.swept = swept(&opened.log, recipe.setup.max_range);
            }
            self.restart();
        }
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for LogModel {
    fn title(&self) -> &'static str {
        Self::TITLE
    }

    fn open(&mut self, file: &[u8]) -> Result<(), FigureError> {
        if file.is_empty() {
            return Err(unreadable(&LogError { line: 0, message: "the file is empty".into() }));
        }
        // Without its malformed lines first, to count them. Where nothing is left, the first of them tells most.
        let log = parse(file, true).map_err(|_| parse(file, false).err()).map_err(|error| {
            unreadable(&error.unwrap_or(LogError { line: 0, message: "there is no scan in it".into() }))
        })?;
        if log.scans.len() < 2 {
            return Err(unreadable(&LogError {
                line: 0,
                message: "there is one scan only, and nothing to map".into(),
            }));
        }
        self.opened = Some(Opened::new(log, self.setup()));
        self.frame = None;
        self.restart();
        Ok(())
    }

    fn ready(&self) -> Result<(), FigureError> {
        let Some(opened) = &self.opened else {
            return Err(FigureError { parameter: "file".into(), message: "there is no log to map yet".into() });
        };
        let notes = &opened.log.notes;
        if let (false, Some(first)) = (self.recipe.lenient, &notes.first_malformed) {
            let more = if notes.malformed > 1 {
                format!(" ({} malformed lines in all)", notes.malformed)
            } else {
                String::new()
            };
            return Err(FigureError { parameter: "lenient".into(), message: unreadable(first).message + &more });
        }
        let setup = self.setup();
        let needed = opened.bytes(setup, setup.particles);
        if needed <= LIMIT {
            return Ok(());
        }
        let why = format!(
            "with cells of {} m they may take {} MB, and the limit is {} MB",
            write(setup.cell_size),
            megabytes(needed),
            megabytes(LIMIT)
        );
        let most = (1..setup.particles).rev().find(|universes| opened.bytes(setup, *universes) <= LIMIT);
        Err(match most {
            Some(most) => {
                FigureError::new("universes", setup.particles, format!("a whole number from 1 to {most} here: {why}"))
            }
            // Where not even one fits, it is the cells that are too small. Rounded up to what can be set.
            None => {
                let least = setup.cell_size * (opened.bytes(setup, 1) / LIMIT).sqrt();
                let least = write((100.0 * least).ceil() / 100.0);
                FigureError::new("cell", write(setup.cell_size), format!("at least {least} m for this log: {why}"))
            }
        })
    }

    fn file(&self, name: &str) -> Option<Vec<u8>> {
        let mapper = self.mapper()?;
        Some(match name {
            "path.tum" => write_tum(&mapper.path()).into_bytes(),
            "map.pgm" => MapImage::of(mapper.map()).pgm(),
            "map.yaml" => MapImage::of(mapper.map()).yaml("map.pgm").into_bytes(),
            _ => return None,
        })
    }

    fn zoom(&mut self, factor: f64, at: Option<Point>, width: f64) {
        self.look(|view| view.zoomed(factor, at.unwrap_or(view.area.centre())), width);
    }

    fn pan(&mut self, by: Point, width: f64) {
        self.look(|view| view.panned(by), width);
    }

    fn fit(&mut self) {
        self.frame = None;
    }

    /// Goes on to a step; to one that is past, by beginning again.
    fn seek(&mut self, step: u32) {
        let Some(opened) = self.opened.as_ref().filter(|_| self.ready().is_ok()) else { return };
        let log = opened.log.clone();
        if step < self.step() {
            self.restart();
        }
        if self.replay.is_none() && step > 0 {
            self.replay = Replay::new(*self.setup(), log).ok(); // the parameters' ranges are within the mapper's
        }
        self.asked = step.min(self.step_count());
    }

    fn step_count(&self) -> u32 {
        match (&self.replay, self.log()) {
            (Some(replay), _) => replay.step_count(),
            (None, Some(log)) => log.scans.len() as u32 - 1,
            _ => 0,
        }
    }

    fn step(&self) -> u32 {
        self.history.len() as u32
    }

    fn pending(&self) -> u32 {
        self.asked - self.step()
    }

    fn work(&mut self) {
        if self.pending() > 0
            && let Some(report) = self.replay.as_mut().and_then(Replay::next)
        {
            self.note(&report);
        }
    }

    fn readouts(&self) -> Vec<Readout> {
        let (m, step) = (self.setup().particles, self.step());
        let moment = self.history.last();
        let of_m = |x: Option<f64>, decimals| {
            let x = x.unwrap_or(f64::NAN);
            (x, format!("{} of {m}", fixed(x, decimals)))
        };
        let (ess, ess_text) = of_m(moment.map(|moment| moment.ess), 1);
        let (lineage, lineage_text) = of_m(moment.map(|moment| moment.lineage.into()), 0);
        let resampled = self.history.iter().filter(|moment| moment.resampled).count();
        let scan = if self.opened.is_some() { f64::from(step) } else { f64::NAN };
        let shared = moment.map_or(f64::NAN, |moment| moment.shared.into());
        let memory = |name, title, bytes: f64, help| {
            let bytes = if bytes > 0.0 { bytes } else { f64::NAN };
            Readout::new(name, title, bytes / 1e6, megabytes(bytes), "MB", help)
        };
        let done = step > 0 && step == self.step_count();
        let digest =
            self.mapper().filter(|_| done).map_or("–".into(), |mapper| format!("{:016x}", digest(mapper).value()));
        vec![
            Readout::new(
                "scan",
                "Scan",
                scan,
                format!("{step} of {}", self.step_count()),
                "",
                "Scans that are mapped, after the first, and all of them.",
            ),
            Readout::new(
                "ess",
                "N_eff",
                ess,
                ess_text,
                "",
                "Effective number of universes before resampling: M if all weigh the same, 1 if one has all the weight.",
            ),
            Readout::new(
                "lineage",
                "Lineage, 20 scans back",
                lineage,
                lineage_text,
                "",
                "Distinct ancestors of the universes 20 scans ago.",
            ),
            Readout::new(
                "shared",
                "One path up to scan",
                shared,
                fixed(shared, 0),
                "",
                "The latest scan at which all universes have one ancestor: up to there they share one path.",
            ),
            Readout::new(
                "resampled",
                "Resampled",
                if step > 0 { resampled as f64 } else { f64::NAN },
                format!("{resampled} of {step}"),
                "",
                "Scans after which the universes were resampled.",
            ),
            memory(
                "estimate",
                "Memory at most",
                self.estimate().unwrap_or(0.0),
                "What maps and paths may take, reckoned from the area that the beams sweep along raw odometry, M and the policy.",
            ),
            memory(
                "map_unique",
                "Memory of the maps",
                self.peak.unique as f64,
                "What all maps held together at the most, shared tiles counted once; looked at every 20 scans.",
            ),
            memory(
                "map_dense",
                "… as dense arrays",
                self.peak.dense as f64,
                "What the maps would have held then if each were an array of its own.",
            ),
            Readout {
                name: "digest",
                title: "Fingerprint",
                value: None,
                text: digest,
                unit: "",
                help: "Of all weights, paths and maps at the end, bit for bit: the command line gives the same for the same log and settings.",
            },
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("scan", "number of the scan, the first being 0"),
            Column::new("time_s", "its stamp in the log [s]"),
            Column::new("x_m", "best path at the end [m]"),
            Column::new("y_m", "best path at the end [m]"),
            Column::new("theta_rad", "best path at the end [rad]"),
            Column::new(
                "log_evidence_nats",
                "log of the evidence as the filter estimates it, by the matcher's score [nats]",
            ),
            Column::new("ess", "effective number of universes before resampling"),
            Column::new("resampled", "1 where the step resampled"),
            Column::new("died_out", "universes without offspring at this resampling"),
            Column::new("lineage_20", "distinct ancestors 20 scans ago"),
            Column::new("shared", "latest scan up to which all universes share one path"),
        ];
        let path = self.mapper().map(LaserMapper::path).unwrap_or_default();
        let row = |(k, (time, pose)): (usize, &(f64, fastslam::geometry::Pose2))| {
            let of =
                |value: fn(&Moment) -> f64| k.checked_sub(1).and_then(|k| self.history.get(k)).map_or(f64::NAN, value);
            vec![
                k as f64,
                *time,
                pose.x,
                pose.y,
                pose.theta,
                of(|m| m.log_evidence),
                of(|m| m.ess),
                of(|m| f64::from(u8::from(m.resampled))),
                of(|m| m.died.into()),
                of(|m| m.lineage.into()),
                of(|m| m.shared.into()),
            ]
        };
        Series { columns: COLUMNS, rows: path.iter().enumerate().map(row).collect() }
    }

    fn describe(&self) -> String {
        match (&self.replay, &self.opened) {
            (Some(replay), _) => self.progress(replay),
            (None, Some(opened)) => self.told(opened),
            _ => "No log is open yet. Run the example, or choose or drop a log of your own: a CARMEN log, as text or compressed by gzip.".into(),
        }
    }

    fn height(&self, width: f64) -> f64 {
        Layout::new(width).height * (width / width.max(NARROWEST))
    }

    fn scene(&self, width: f64, height: f64) -> Scene {
        scene::build(self, width, height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sentence_says_when_no_universe_explains_a_scan() {
        let mut model = LogModel::default();
        model.open(include_bytes!("../../../tests/figures/golden/tiny.clf")).unwrap();
        model.seek(1);
        model.settle();
        assert!(!model.describe().contains("explains"));
        model.history[0].log_evidence = f64::NEG_INFINITY;
        assert!(model.describe().contains("No universe explains this scan: the weights stay."));
    }
}
