//! The error over the iterations, on a logarithmic axis, and how far the best universe is off.

use super::{layout::Layout, model::GraphModel, recipe::GUESSES};
use crate::{
    decimal::write,
    model::Model as _,
    prediction::{Level, State, level, off_by},
    scene::{Anchor, Chart, Rect, Role, Sample, Scene, legend, plain},
    words::{common, graph as words},
};
use fastslam::ops;

/// Errors at the lower and at the upper edge \[m\].
const ENDS: [f64; 2] = GUESSES;

/// Where the guess stands before there is one \[m\].
pub const MIDDLE: f64 = 0.6;

/// Errors that have a name \[m\].
const LEVELS: [f64; 3] = [0.1, 1.0, 10.0];

/// From this width on \[css px\] the legend has one line for long names, in any language.
const ROOMY: f64 = 300.0;

/// Share of the height of an error \[m\].
fn share(error: f64) -> f64 {
    ops::ln(error.max(1e-9) / ENDS[0]) / ops::ln(ENDS[1] / ENDS[0])
}

/// The error at a height \[m\].
pub fn error(layout: &Layout, y: f64) -> f64 {
    ENDS[0] * ops::exp(ops::ln(ENDS[1] / ENDS[0]) * (layout.error.bottom() - y) / layout.error.h)
}

pub fn draw(scene: &mut Scene, model: &GraphModel, layout: &Layout) {
    scene.heading_fit(&layout.error_header, (words::error(), Role::Ink), &[words::error_unit()]);
    let chart = Chart { area: layout.error, last: model.step_count() };
    for level in LEVELS {
        let y = chart.y(share(level));
        chart.rule(scene, y);
        let name = Rect::new(layout.scale.x, y - 7.0, layout.scale.w - 6.0, 14.0);
        scene.text(name, plain(11.0, Role::Muted).end(), &write(level));
    }
    chart.edges(scene);
    chart.ghost(scene, model.pinned().iter().map(|error| share(*error)));
    let best = if layout.error_legend.w >= ROOMY { words::best_line() } else { words::best_line_short() };
    let mut items = vec![(Sample::line(Role::Ink, 1.75, None), words::graph_line().to_string())];
    if let Some(report) = model.universes() {
        scene.dash(&chart.level(share(report.rms_best)), 1.5, [4.0, 3.0], Role::Path);
    }
    items.push((Sample::line(Role::Path, 1.5, Some([4.0, 3.0])), best.into()));
    if !model.pinned().is_empty() {
        items.push((Sample::pinned(), common::pinned_mark().into()));
    }
    let curve = chart.curve((0..).zip(model.frames().iter().map(|frame| share(frame.error.rms))));
    let now = curve[model.step() as usize];
    scene.line(&curve, 1.75, Role::Ink);
    scene.disc(now, 4.0, Role::Ink);
    legend(scene, &layout.error_legend, items);
    let ends = [(Anchor::Start, 0), (Anchor::End, model.step_count())];
    for (anchor, step) in ends.into_iter().take(if model.step_count() > 0 { 2 } else { 1 }) {
        let area = Rect::new(chart.area.x, layout.axis.y + 2.0, chart.area.w, 14.0);
        scene.text(area, plain(11.0, Role::Muted).at(anchor), &step.to_string());
    }
    let area = Rect::new(chart.area.x + 20.0, layout.axis.y + 2.0, chart.area.w - 40.0, 14.0);
    scene.text(area, plain(11.0, Role::Muted).middle(), words::iterations());
    guess(scene, model, &chart);
}

/// The reader's guess across the chart, and what came.
fn guess(scene: &mut Scene, model: &GraphModel, chart: &Chart) {
    let state = model.state();
    let (value, said) = match state {
        State::Placed(guess) => (guess, [words::GuessIs { guess: &write(guess) }.say(), write(guess)]),
        State::Guessed(guess) => {
            let guess_text = &write(guess);
            let is = words::GuessedIs { guess: guess_text }.say();
            let off = model.end().map(|result| off_by(guess, result));
            (guess, [off.map_or(is.clone(), |off| words::GuessedShort { guess: guess_text, off: &off }.say()), is])
        }
        _ => (MIDDLE, [words::drag_here(), words::drag_short()].map(String::from)),
    };
    let at = [chart.area.centre()[0], chart.y(share(value))];
    let (title, text) = (words::guess_handle(), words::GuessIs { guess: &write(value) }.say());
    level(scene, &chart.area, &mut Vec::new(), Level { state, at, title, value, text, said });
}
