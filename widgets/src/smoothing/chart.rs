//! Different poses, and the error of their mean, at every step of the drive.

use super::{
    ground::{DRAWN, RECORD},
    layout::Layout,
    model::{Account, SmoothingModel},
};
use crate::{
    decimal::{fixed, write},
    ghost::curve,
    prediction::{Level, State, level, off_by},
    scene::{Chart, Handle, LINE, Rect, Role, Scene, plain, strong},
    words::smoothing as words,
};
use fastslam_lab::experiment::smoothing::{MOST, STEPS};

/// What a reader moves along the axis.
pub const AT: &str = "at";

const SIZE: f64 = 11.0;

/// Where the guess stands before there is one, and the step at which it is grasped.
pub const MIDDLE: f64 = 12.0;
const GRIP: u32 = 20;

/// Number of poses at the upper edge of the first chart.
pub fn most(model: &SmoothingModel) -> f64 {
    f64::from(model.particles().max(MOST))
}

/// One of the charts in a layout.
pub fn place(layout: &Layout, rank: usize) -> Chart {
    Chart { area: layout.charts[rank], last: STEPS }
}

/// Draws both.
pub fn charts(scene: &mut Scene, model: &SmoothingModel, layout: &Layout) {
    let accounts = [model.before(), model.after()];
    let counts = |account: &Account| account.distinct.iter().map(|n| f64::from(*n)).collect();
    let errors = |account: &Account| account.errors.clone();
    let highest = accounts.iter().flatten().flat_map(|account| &account.errors).fold(0.1, |top: f64, x| top.max(*x));
    let tops = [most(model), round_up(highest)];
    let values: [[Option<Vec<f64>>; 2]; 2] =
        [accounts.each_ref().map(|a| a.as_ref().map(counts)), accounts.each_ref().map(|a| a.as_ref().map(errors))];
    for (rank, curves) in values.iter().enumerate() {
        let (chart, top) = (place(layout, rank), tops[rank]);
        title(scene, model, &layout.names[rank], rank);
        ticks(scene, layout, rank, top);
        chart.edges(scene);
        for pinned in [rank, rank + 2].into_iter().take(if model.hides() { 1 } else { 2 }) {
            chart.ghost(scene, curve(model.pinned(), pinned).iter().map(|x| x / top));
        }
        shared(scene, model, &chart);
        for (values, role) in curves.iter().zip([RECORD, DRAWN]) {
            if let Some(values) = values {
                scene.line(&chart.curve((0..).zip(values.iter().map(|x| x / top))), 2.0, role);
                let at = model.at();
                scene.disc([chart.x(at), chart.y(values[at as usize] / top)], 3.5, role);
            }
        }
        cursor(scene, model, &chart, rank == 0);
    }
    guess(scene, model, &place(layout, 0));
}

/// The reader's guess across the first chart, and what came.
fn guess(scene: &mut Scene, model: &SmoothingModel, chart: &Chart) {
    let state = model.state();
    let (value, said) = match state {
        State::Placed(guess) => (guess, [words::GuessIs { guess: &write(guess) }.say(), write(guess)]),
        State::Guessed(guess) => {
            let guess_text = &write(guess);
            let is = words::GuessedIs { guess: guess_text }.say();
            let off = model.first_of_all().map(|result| off_by(guess, result.into()));
            (guess, [off.map_or(is.clone(), |off| words::GuessedShort { guess: guess_text, off: &off }.say()), is])
        }
        _ => (MIDDLE, [words::drag_here(), words::drag_short()].map(String::from)),
    };
    // Of the cursor, which goes through.
    let mut taken = vec![Rect::new(chart.x(model.at()) - 3.0, chart.area.y, 6.0, chart.area.h)];
    let at = [chart.x(GRIP), chart.y(value / most(model))];
    let (title, text) = (words::guess_handle(), words::GuessIs { guess: &write(value) }.say());
    level(scene, &chart.area, &mut taken, Level { state, at, title, value, text, said });
}

/// The last step that all particles share.
fn shared(scene: &mut Scene, model: &SmoothingModel, chart: &Chart) {
    if let Some(step) = model.coalescence().filter(|step| *step > 0) {
        let x = chart.x(step);
        scene.dash(&[[x, chart.area.y], [x, chart.area.bottom()]], 1.0, [2.0, 3.0], Role::Muted);
    }
}

/// What a chart shows, and in the first one until where the record is of one pose.
fn title(scene: &mut Scene, model: &SmoothingModel, area: &Rect, rank: usize) {
    let names = match rank {
        0 => [words::chart_distinct(), words::chart_distinct_short()],
        _ => [words::chart_error(), words::chart_error_short()],
    };
    let one = model.coalescence().filter(|step| rank == 0 && *step > 0);
    let one = one.map(|step| [words::OneUntil { step: &step }.say(), words::OneUntilShort { step: &step }.say()]);
    let (title, after) = (strong(12.5, Role::Ink), plain(SIZE, Role::Muted).end());
    // The longest of both that have room together.
    let beside = |name: &'static str| {
        let more = after.fitting(area.w - title.width(name) - 12.0, one.as_ref().map_or(&[][..], |one| one))?;
        Some((name, more))
    };
    let found = names.into_iter().find_map(beside);
    let (name, more) = found.unwrap_or_else(|| (title.fitting(area.w, &names).unwrap_or_default(), ""));
    let line = Rect { h: LINE, ..*area };
    scene.text(line, title, name);
    if !more.is_empty() {
        scene.text(line, after, more);
    }
}

/// The step that is looked at.
fn cursor(scene: &mut Scene, model: &SmoothingModel, chart: &Chart, grip: bool) {
    let (x, area) = (chart.x(model.at()), chart.area);
    let line = vec![[x, area.y], [x, area.bottom() + if grip { 5.0 } else { 0.0 }]];
    scene.line(&line, 1.5, Role::Accent);
    if grip {
        let at = [x, area.bottom() + 5.0];
        scene.disc(at, 5.0, Role::Accent);
        scene.handles.push(Handle::of(
            &[AT],
            words::at(),
            at,
            model.at().into(),
            words::AtStep { at: &model.at() }.say(),
        ));
    }
}

fn ticks(scene: &mut Scene, layout: &Layout, rank: usize, top: f64) {
    let (chart, scale, axis) = (place(layout, rank), layout.scales[rank], layout.axes[rank]);
    let half = if rank == 0 { (0.5 * top).floor() } else { 0.5 * top };
    for value in [0.0, half, top] {
        let y = chart.y(value / top);
        chart.rule(scene, y);
        let area = Rect::new(scale.x, y - 7.0, scale.w - 5.0, 14.0);
        let said = if rank == 0 { write(value) } else { fixed(value, if top < 0.4 { 2 } else { 1 }) };
        scene.text(area, plain(SIZE, Role::Muted).end(), &said);
    }
    for step in [0, 20, 40, STEPS] {
        let area = Rect::new(chart.x(step) - 12.0, axis.y + 12.0, 24.0, 14.0);
        scene.text(area, plain(SIZE, Role::Muted).middle(), &step.to_string());
    }
}

/// The next number of one or two digits that halves well.
fn round_up(x: f64) -> f64 {
    const NICE: [f64; 10] = [0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.2, 1.6, 2.0];
    NICE.into_iter().find(|nice| *nice >= x).unwrap_or_else(|| (0.5 * x).ceil() * 2.0)
}
