//! Time from left to right, the corridor from below upwards: where the robot was, by the past alone, and by as much future as is asked for.

use super::{
    layout::Layout,
    model::EmModel,
    recipe::{FILLS, MARKS},
};
use crate::{
    decimal::{between, write},
    prediction::{Level, State, level},
    scene::{Cells, Handle, Point, Rect, Role, Scene, Shading, plain, strong},
    words::em as words,
};
use fastslam_lab::experiment::em::{CORRIDOR, HALF_DOOR, LENGTH};

/// Font size of names beside a strip \[css px\].
pub const SIZE: f64 = 11.0;

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
            // Square roots, and a half is as dark as all: that something is there at all must be seen.
            shades[(cells - 1 - cell) * columns.len() + step] = (255.0 * (2.0 * share).clamp(0.0, 1.0).sqrt()) as u8;
        }
    }
    scene.raster(area, Cells { columns: columns.len(), shades }, Shading::Correlation);
}

/// The true path, a line of dashes that hides nothing.
pub fn truth(scene: &mut Scene, model: &EmModel, area: &Rect) {
    let (steps, carried) = (model.log().steps(), model.log().carried);
    let point = |step: usize| -> Point {
        [x(area, step, steps) + 0.5 * area.w / (steps + 1) as f64, y(area, CORRIDOR.place(model.log().truth[step]))]
    };
    let lines = vec![(0..carried).map(point).collect(), (carried..=steps).map(point).collect()];
    scene.dashed(lines, 1.0, [1.5, 5.0], Role::Truth);
}

/// A line where the robot is carried.
pub fn carried(scene: &mut Scene, model: &EmModel, area: &Rect) {
    let x = x(area, model.log().carried, model.log().steps());
    scene.dash(&[[x, area.y], [x, area.bottom()]], 1.0, [1.0, 3.0], Role::Muted);
}

/// Names of places left of an area.
pub fn scale(scene: &mut Scene, area: &Rect) {
    for metres in [0, 2, 4, 6, 8, 10] {
        let middle = between(y(area, f64::from(metres)), area.y + 7.0, area.bottom() - 7.0);
        if metres % 4 != 0 && area.h < 100.0 {
            continue;
        }
        let place = Rect::new(area.x, middle - 7.0, area.w - 5.0, 14.0);
        let name = if metres == 10 && area.h >= 100.0 { "m".into() } else { metres.to_string() };
        if metres < 10 || area.h >= 100.0 {
            scene.text(place, plain(SIZE, Role::Muted).end(), &name);
        }
    }
}

/// What is shown of the path.
fn title(model: &EmModel) -> (&'static str, [String; 2]) {
    match model.future() {
        future if model.now().ticks <= FILLS || future == Some(0) => {
            (words::forward(), [words::forward_what().into(), words::forward_what_short().into()])
        }
        None => (words::product(), [words::product_what().into(), words::product_what_short().into()]),
        Some(n) => {
            let n = &n;
            (words::product(), [words::FutureWhat { n }.say(), words::FutureWhatShort { n }.say()])
        }
    }
}

/// Where the robot was by both passes, as far as they are.
pub fn strips(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let (area, steps) = (layout.product.area, model.log().steps());
    let (name, what) = title(model);
    scene.heading_fit(&layout.product.header, (name, Role::Ink), &what);
    strip(scene, area, &(0..=steps).map(|step| model.column(step)).collect::<Vec<_>>());
    carried(scene, model, &area);
    scene.frame(area, 1.0, Role::Frame);
    truth(scene, model, &area);
    // How far a pass is.
    let [forward, backward] = model.now().columns(steps + 1);
    for step in [forward, steps + 1 - backward] {
        let x = x(&area, step, steps);
        if x > area.x + 1.0 && x < area.right() - 1.0 {
            scene.line(&[[x, area.y], [x, area.bottom()]], 2.0, Role::Accent);
        }
    }
    // How far ahead of the carrying a column looks.
    if let Some(future) = model.future() {
        let from = model.log().carried;
        let ends = [from, (from + future as usize).min(steps)].map(|step| [x(&area, step, steps), area.bottom()]);
        scene.line(&ends, 4.0, Role::Accent);
    }
    times(scene, model, layout);
    answer(scene, model, &area);
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
    let log = model.log();
    let at = [x(area, log.carried, log.steps()), y(area, value)];
    let (title, text) = (words::guess_handle(), words::GuessIs { guess: &write(value) }.say());
    level(scene, area, &mut Vec::new(), Level { state, at, title, value, text, said });
}

/// When the robot was carried, and when the ride began and ended.
fn times(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let (area, times) = (&layout.product.area, &layout.times);
    let middle = x(area, model.log().carried, model.log().steps());
    let letters = plain(SIZE, Role::Muted);
    let w = letters.width(words::carried()) + 0.01;
    let place = |x: f64| Rect { x, w, ..*times };
    scene.text(place(middle - 0.5 * w), letters.middle(), words::carried());
    scene.text(place(times.x), letters, "0");
    scene.text(place(times.right() - w), letters.end(), &model.log().steps().to_string());
}

/// The marks of the first guess, each in a lane of its own so that none hides another.
pub fn guess(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let area = layout.guess.area;
    let title = Rect { x: 0.0, w: layout.guess.header.w - 8.0, ..layout.guess.header };
    scene.text(title, strong(12.5, Role::Accent), words::guess());
    scale(scene, &layout.scale);
    let lane = area.w / 3.0;
    let titles = [words::mark_1(), words::mark_2(), words::mark_3()];
    for (rank, mark) in model.marks().into_iter().enumerate() {
        let [top, bottom] = [HALF_DOOR, -HALF_DOOR].map(|to| y(&area, (mark + to).clamp(0.0, LENGTH)));
        let x = area.x + lane * rank as f64;
        scene.fill(Rect::new(x + 1.0, top, lane - 2.0, bottom - top), Role::Accent);
        let at = [x + 0.5 * lane, y(&area, mark)];
        scene.disc(at, 2.5, Role::Paper);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model as _;
    use crate::view::Layout as _;
    use fastslam_lab::experiment::em::AGAIN_BELOW;

    /// Why there is no lens here: what the forward pass leaves open is large enough to be seen.
    #[test]
    fn the_two_places_of_the_forward_pass_are_farther_apart_than_a_lens_is_for() {
        let mut model = EmModel::default();
        while model.pending() > 0 {
            model.work();
        }
        let log = model.log();
        let column = model.passes().forward(log.carried).unwrap();
        let heaviest = |old: bool| {
            let cells = (0..column.len()).filter(|cell| (CORRIDOR.place(*cell) < AGAIN_BELOW) == old);
            cells.max_by(|a, b| column[*a].total_cmp(&column[*b])).unwrap()
        };
        let [old, new] = [heaviest(true), heaviest(false)];
        for width in [322.0, 692.0, 1112.0] {
            let area = Layout::new(width).product.area;
            let [old, new] = [old, new].map(|cell| y(&area, CORRIDOR.place(cell)));
            assert!(old - new > 20.0, "{width}: {old} {new}");
        }
    }
}
