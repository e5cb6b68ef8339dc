//! What is told of the graph in numbers and in words.

use super::{challenges, model::GraphModel};
use crate::{
    challenge::Challenge,
    decimal::{fixed, write},
    model::{Column, Model, Readout, Series, Tells},
    prediction::{State, off_by},
    told::metres,
    words::graph as words,
};
use fastslam_lab::baseline::pose_graph::{EdgeKind, Repair};
use fastslam_lab::experiment::graph::{PathError, Solved};

/// A cost \[nats\]: whole where it is large.
pub fn cost(cost: f64) -> String {
    fixed(cost, if cost < 100.0 { 1 } else { 0 })
}

/// Bytes as kilobytes.
pub fn kilobytes(bytes: u64) -> String {
    fixed(bytes as f64 / 1e3, 0)
}

/// What a repair is called.
pub fn repair(repair: Repair) -> &'static str {
    match repair {
        Repair::LeastSquares => words::least_squares(),
        Repair::Cauchy { .. } => words::robust(),
        Repair::Switchable { .. } => words::switchable(),
        Repair::MaxMixture { .. } => words::mixture(),
    }
}

/// A weight, 0 to 1, in percent.
pub fn percent(weight: f64) -> String {
    let percent = 100.0 * weight;
    if percent > 0.0 && percent < 0.1 { format!("< {}", fixed(0.1, 1)) } else { fixed(percent, 1) }
}

/// RMS error of wheels and recent matches alone \[m\], as far as the log is tied together.
pub fn matched(model: &GraphModel) -> f64 {
    let chain = model.graph().build().chain();
    PathError::of(chain, &model.world().truth[..chain.len()]).rms
}

impl Tells for GraphModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let (frame, start) = (self.frame(), &self.frames()[0]);
        let universes = self.universes();
        let count = |kind| self.edges(kind).count() as f64;
        let whole = |x: f64| fixed(x, 0);
        let best = universes.map_or(f64::NAN, |report| report.rms_best);
        let bytes = self.graph().build().bytes();
        let maps = universes.map(|report| [report.map_bytes_unique, report.map_bytes_dense]);
        let [unique, dense] = maps.map_or([f64::NAN; 2], |bytes| bytes.map(|bytes| bytes as f64));
        let wrong = frame.wrong_weight.map_or(f64::NAN, |weight| 100.0 * weight);
        let wrong_text = frame.wrong_weight.map(percent).unwrap_or_default();
        let kilo = |x: f64| if x.is_finite() { kilobytes(x as u64) } else { String::new() };
        let length = |name, title, x: f64, help| Readout::new(name, title, x, metres(x), "m", help);
        let edges = |name, title, kind, help| Readout::new(name, title, count(kind), whole(count(kind)), "", help);
        vec![
            length("rms", words::rms(), frame.error.rms, words::rms_help()).drawn(),
            Readout::new("cost", words::cost(), frame.cost, cost(frame.cost), "nats", words::cost_help()).drawn(),
            length("rms_start", words::rms_start(), start.error.rms, words::rms_start_help()),
            length("rms_matched", words::rms_matched(), matched(self), words::rms_matched_help()),
            length("rms_aligned", words::rms_aligned(), frame.error.aligned, words::rms_aligned_help()),
            length("rms_universe", words::rms_universe(), best, words::rms_universe_help()).drawn(),
            edges("odometry_edges", words::odometry_edges(), EdgeKind::Odometry, words::odometry_edges_help()),
            edges("match_edges", words::match_edges(), EdgeKind::Match, words::match_edges_help()),
            edges("loop_edges", words::loop_edges(), EdgeKind::Loop, words::loop_edges_help()),
            Readout::new("wrong_weight", words::wrong_weight(), wrong, wrong_text, "%", words::wrong_weight_help()),
            Readout::new(
                "graph_bytes",
                words::graph_bytes(),
                bytes as f64,
                kilobytes(bytes),
                "KB",
                words::graph_bytes_help(),
            )
            .drawn(),
            Readout::new("map_bytes", words::map_bytes(), unique, kilo(unique), "KB", words::map_bytes_help()).drawn(),
            Readout::new("dense_bytes", words::dense_bytes(), dense, kilo(dense), "KB", words::dense_bytes_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("iteration", "iteration of the optimisation; 0 is where it starts"),
            Column::new("cost_nats", "cost F of the graph"),
            Column::new("rms_m", "RMS error of position over the path [m]"),
            Column::new("rms_aligned_m", "the same after the best rigid alignment [m]"),
            Column::new("wrong_weight", "share of the false edge's information that pulls"),
        ];
        let row = |(iteration, frame): (usize, &fastslam_lab::experiment::graph::Frame)| {
            let weight = frame.wrong_weight.unwrap_or(f64::NAN);
            vec![iteration as f64, frame.cost, frame.error.rms, frame.error.aligned, weight]
        };
        Series { columns: COLUMNS.into(), rows: self.frames().iter().enumerate().map(row).collect() }
    }

    fn describe(&self) -> String {
        let frame = self.frame();
        if let Some(unsolved) = unsolved(self) {
            return unsolved;
        }
        let (step, last) = (&self.step(), &self.step_count());
        let (rms, cost) = (&metres(frame.error.rms), &cost(frame.cost));
        let loops = &self.edges(EdgeKind::Loop).count();
        let told = match self.step() {
            0 if self.hides() => words::AskedStart { rms, loops }.say(),
            0 => words::ToldStart { last, rms, cost, loops }.say(),
            _ => words::Told { step, last, rms, cost, start: &metres(self.frames()[0].error.rms), loops }.say(),
        };
        let mut sentences: Vec<String> = judged(self).into_iter().chain([told]).collect();
        if let (Some([i, j]), Some(weight)) = (self.setup().wrong, frame.wrong_weight) {
            let repair = &repair(self.setup().repair);
            sentences.push(words::ToldWrong { i: &i, j: &j, repair, weight: &percent(weight) }.say());
        }
        if let Some(report) = self.universes() {
            let m = &report.weights.len();
            let maps = &kilobytes(report.map_bytes_unique);
            let graph = &kilobytes(self.graph().build().bytes());
            sentences.push(words::ToldUniverses { m, rms: &metres(report.rms_best), maps, graph }.say());
        }
        sentences.join(" ")
    }

    fn narrate(&self) -> String {
        let frame = self.frame();
        if let Some(unsolved) = unsolved(self) {
            return unsolved;
        }
        if let Some(judged) = judged(self) {
            return judged;
        }
        let rms = &metres(frame.error.rms);
        match (self.step(), self.setup().wrong, frame.wrong_weight) {
            (0, ..) => words::NStart { rms, loops: &self.edges(EdgeKind::Loop).count() }.say(),
            (_, Some([i, j]), Some(weight)) => words::NWrong { i: &i, j: &j, weight: &percent(weight), rms }.say(),
            (step, ..) => words::NTold { step: &step, rms, start: &metres(self.frames()[0].error.rms) }.say(),
        }
    }
}

/// What is said of a graph that is not solved as a whole.
fn unsolved(model: &GraphModel) -> Option<String> {
    match model.graph().solved() {
        Solved::Not => Some(words::tying().into()),
        Solved::InPart(_) => {
            let (loops, rms) = (&model.edges(EdgeKind::Loop).count(), &metres(model.frame().error.rms));
            Some(words::Closing { loops, rms }.say())
        }
        Solved::Whole => None,
    }
}

/// What is said of the prediction, if one is asked for.
fn judged(model: &GraphModel) -> Option<String> {
    Some(match (model.state(), model.end()) {
        (State::Off, _) | (State::Guessed(_) | State::Waived, None) => return None,
        (State::Asked, _) => words::asks().into(),
        (State::Placed(guess), _) => words::Placed { guess: &write(guess) }.say(),
        (State::Guessed(guess), Some(end)) => {
            words::Came { rms: &metres(end), guess: &write(guess), off: &off_by(guess, end) }.say()
        }
        (State::Waived, Some(end)) => words::CameAlone { rms: &metres(end) }.say(),
    })
}
