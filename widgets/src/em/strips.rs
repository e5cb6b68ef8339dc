//! Time from left to right, the corridor from below upwards: where the robot was, by one pass, by the other, by both.

use super::{layout::Layout, model::EmModel, recipe::MARKS};
use crate::{
    decimal::write,
    font::{self, Weight},
    prediction::{Level, State, level},
    scene::{Anchor, Cells, Handle, Mark, Point, Rect, Role, Scene, Shading, heading, text},
    words::em as words,
};
use fastslam_lab::experiment::em::{CORRIDOR, HALF_DOOR, LENGTH};

/// Font size of names beside a strip \[css px\].
pub const SIZE: f64 = 11.0;

/// What the reader may choose of a strip's name, from long to short.
type Names = [&'static str; 2];

/// Where a place of the corridor \[m\] is in an area \[css px\].
pub fn y(area: &Rect, place: f64) -> f64 {
    area.bottom() - area.h * place / LENGTH
}

/// What place of the corridor \[m\] is at a height \[css px\].
pub fn place(area: &Rect, y: f64) -> f64 {
    LENGTH * (area.bottom() - y) / area.h
}

/// The left edge of a step's column \[css px\].
pub fn x(area: &Rect, step: usize, steps: usize) -> f64 {
    area.x + area.w * step as f64 / (steps + 1) as f64
}

/// A strip of columns over time, each with a number from 0 to 1 for every cell; `None` where there is nothing yet.
pub fn strip(scene: &mut Scene, area: Rect, columns: &[Option<Vec<f64>>]) {
    let cells = CORRIDOR.cells as usize;
    let mut shades = vec![0; columns.len() * cells];
    for (step, column) in columns.iter().enumerate() {
        for (cell, share) in column.iter().flatten().enumerate() {
            // Square roots: that something is there at all must be seen.
            shades[(cells - 1 - cell) * columns.len() + step] = (255.0 * share.clamp(0.0, 1.0).sqrt()) as u8;
        }
    }
    let cells = Cells { columns: columns.len(), shades };
    scene.marks.push(Mark::Raster { area, cells, shading: Shading::Correlation });
}

/// The true path, a line of dashes that hides nothing.
pub fn truth(scene: &mut Scene, model: &EmModel, area: &Rect) {
    let (steps, carried) = (model.log().steps(), model.log().carried);
    let point = |step: usize| -> Point {
        [x(area, step, steps) + 0.5 * area.w / (steps + 1) as f64, y(area, CORRIDOR.place(model.log().truth[step]))]
    };
    let lines = vec![(0..carried).map(point).collect(), (carried..=steps).map(point).collect()];
    scene.marks.push(Mark::Lines { lines, width: 1.0, dash: Some([1.5, 5.0]), role: Role::Truth });
}

/// A line where the robot is carried.
pub fn carried(scene: &mut Scene, model: &EmModel, area: &Rect) {
    let x = x(area, model.log().carried, model.log().steps());
    let lines = vec![vec![[x, area.y], [x, area.bottom()]]];
    scene.marks.push(Mark::Lines { lines, width: 1.0, dash: Some([1.0, 3.0]), role: Role::Muted });
}

/// Names of places left of an area.
pub fn scale(scene: &mut Scene, area: &Rect) {
    for metres in [0, 2, 4, 6, 8, 10] {
        let middle = y(area, f64::from(metres)).clamp(area.y + 7.0, area.bottom() - 7.0);
        if metres % 4 != 0 && area.h < 100.0 {
            continue;
        }
        let place = Rect::new(area.x, middle - 7.0, area.w - 5.0, 14.0);
        let name = if metres == 10 && area.h >= 100.0 { "m".into() } else { metres.to_string() };
        if metres < 10 || area.h >= 100.0 {
            scene.marks.push(text(place, Anchor::End, SIZE, Weight::Regular, Role::Muted, name));
        }
    }
}

/// The name of a part, with as much of what it is as there is room for.
pub fn name(scene: &mut Scene, header: &Rect, strong: &str, rest: Names) {
    let used = font::measure(strong, 13.5, Weight::SemiBold) + 12.0;
    let fits = |rest: &&&str| used + font::measure(rest, 12.5, Weight::Regular) <= header.w;
    heading(scene, header, (strong, Role::Ink), rest.iter().find(fits).unwrap_or(&""));
}

/// The two passes and their product, as far as they are.
pub fn strips(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let (passes, steps, now) = (model.passes(), model.log().steps(), model.now());
    let [forward, backward] = now.columns(steps + 1);
    let of_forward = |step: usize| passes.forward(step).filter(|_| step < forward).map(<[f64]>::to_vec);
    // What explains the readings to come best is full dark: there is no more to a column of the backward pass than its proportions.
    let proportions = |column: &[f64]| {
        let most = column.iter().copied().fold(0.0, f64::max);
        column.iter().map(|p| p / most).collect()
    };
    let of_backward = |step: usize| passes.backward(step).filter(|_| step + backward > steps).map(proportions);
    let of_product = |step: usize| passes.product(step).filter(|_| now.has_product());
    let columns: [Vec<Option<Vec<f64>>>; 3] = [
        (0..=steps).map(of_forward).collect(),
        (0..=steps).map(of_backward).collect(),
        (0..=steps).map(of_product).collect(),
    ];
    let names = [
        (words::forward(), [words::forward_what(), words::forward_what_short()]),
        (words::backward(), [words::backward_what(), words::backward_what_short()]),
        (words::product(), [words::product_what(), words::product_what_short()]),
    ];
    for ((part, columns), (strong, rest)) in layout.strips.iter().zip(&columns).zip(names) {
        name(scene, &part.header, strong, rest);
        strip(scene, part.area, columns);
        carried(scene, model, &part.area);
        scene.marks.push(Mark::Frame { area: part.area, width: 1.0, role: Role::Frame });
    }
    truth(scene, model, &layout.strips[2].area);
    // How far a pass is.
    for (part, step) in layout.strips.iter().zip([forward, steps + 1 - backward]) {
        let x = x(&part.area, step, steps);
        if x > part.area.x + 1.0 && x < part.area.right() - 1.0 {
            let lines = vec![vec![[x, part.area.y], [x, part.area.bottom()]]];
            scene.marks.push(Mark::Lines { lines, width: 2.0, dash: None, role: Role::Accent });
        }
    }
    times(scene, model, layout);
    answer(scene, model, &layout.strips[2].area);
}

/// Where the reader's guess stands before there is one \[m\].
pub const MIDDLE: f64 = 5.0;

/// The reader's guess of where the product will have the robot put down, and what came.
fn answer(scene: &mut Scene, model: &EmModel, area: &Rect) {
    let state = model.state();
    let (value, said) = match state {
        State::Placed(guess) => (guess, [words::GuessIs { guess: &write(guess) }.say(), write(guess)]),
        State::Guessed(guess) => (guess, [words::GuessedIs { guess: &write(guess) }.say(), write(guess)]),
        _ => (MIDDLE, [words::drag_here(), words::drag_short()].map(String::from)),
    };
    let (log, said) = (model.log(), said.each_ref().map(String::as_str));
    let at = [x(area, log.carried, log.steps()), y(area, value)];
    let (title, text) = (words::guess_handle(), words::GuessIs { guess: &write(value) }.say());
    level(scene, area, &mut Vec::new(), Level { state, at, title, value, text, said });
}

/// When the robot was carried, and when the ride began and ended.
fn times(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let (area, times) = (&layout.strips[2].area, &layout.times);
    let middle = x(area, model.log().carried, model.log().steps());
    let w = font::measure(words::carried(), SIZE, Weight::Regular) + 0.01;
    let line = |x: f64, anchor, what: String| {
        text(Rect::new(x, times.y, w, times.h), anchor, SIZE, Weight::Regular, Role::Muted, what)
    };
    scene.marks.push(line(middle - 0.5 * w, Anchor::Middle, words::carried().into()));
    scene.marks.push(line(times.x, Anchor::Start, "0".into()));
    scene.marks.push(line(times.right() - w, Anchor::End, model.log().steps().to_string()));
}

/// The marks of the first guess, each in a lane of its own so that none hides another.
pub fn guess(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let area = layout.guess.area;
    let title = Rect { x: 0.0, w: layout.guess.header.w - 8.0, ..layout.guess.header };
    scene.marks.push(text(title, Anchor::Start, 12.5, Weight::SemiBold, Role::Accent, words::guess()));
    scale(scene, &layout.scale);
    let lane = area.w / 3.0;
    let titles = [words::mark_1(), words::mark_2(), words::mark_3()];
    for (rank, mark) in model.marks().into_iter().enumerate() {
        let [top, bottom] = [HALF_DOOR, -HALF_DOOR].map(|to| y(&area, (mark + to).clamp(0.0, LENGTH)));
        let x = area.x + lane * rank as f64;
        scene.marks.push(Mark::Fill { area: Rect::new(x + 1.0, top, lane - 2.0, bottom - top), role: Role::Accent });
        let at = [x + 0.5 * lane, y(&area, mark)];
        scene.marks.push(Mark::Discs { centres: vec![at], radius: 2.5, role: Role::Paper });
        scene.handles.push(Handle {
            name: MARKS[rank],
            title: titles[rank].into(),
            at,
            axes: core::slice::from_ref(&MARKS[rank]),
            value: mark,
            text: words::Metres { place: &write(mark) }.say(),
            hover: None,
        });
    }
}
