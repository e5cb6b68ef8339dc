//! What is to be seen of EM mapping and of the particles, and what of it can be moved.

use super::{
    chart::chart,
    cloud::cloud,
    layout::{LIKELIHOOD, Layout, PARTICLES, PASSES},
    map::map,
    model::EmModel,
    recipe::{MARK, MARKS},
    strips,
};
use crate::{
    prediction::{GUESS, State},
    scene::{Point, Rect, Scene},
    view::{View, whole_step},
};

/// EM mapping beside particles, as it is seen.
#[derive(Default)]
pub struct EmView;

impl View for EmView {
    type Model = EmModel;
    type Layout = Layout;

    fn gist(_model: &EmModel, layout: &Layout, width: f64) -> Rect {
        if !layout.shown.has(PASSES) {
            return Rect::new(0.0, 0.0, width, layout.height);
        }
        // Product and map, and what they are worth.
        let top = layout.product.area.y - 4.0;
        let last = if layout.shown.has(LIKELIHOOD) { layout.axis.bottom() } else { layout.times.bottom() };
        Rect::new(0.0, top, width, last - top)
    }

    fn draw(&self, model: &EmModel, layout: &Layout, scene: &mut Scene) {
        if layout.shown.has(PASSES) {
            strips::strips(scene, model, layout);
            map(scene, model, layout);
            strips::guess(scene, model, layout);
        }
        if layout.shown.has(LIKELIHOOD) {
            chart(scene, model, layout);
        }
        if layout.shown.has(PARTICLES) {
            cloud(scene, model, layout);
        }
    }

    fn drag(&self, model: &mut EmModel, layout: &Layout, handle: &str, [_, y]: Point) {
        if handle == GUESS {
            model.guess_at(strips::place(&layout.product.area, y));
        } else if let Some(rank) = rank(handle) {
            model.put(rank, strips::place(&layout.guess.area, y));
        }
    }

    fn nudge(&self, model: &mut EmModel, handle: &str, [right, up]: [f64; 2]) {
        let by = MARK.2 * whole_step(right + up);
        if handle == GUESS {
            model.guess_at(by + if let State::Placed(guess) = model.state() { guess } else { strips::MIDDLE });
        } else if let Some(rank) = rank(handle) {
            model.put(rank, model.marks()[rank] + by);
        }
    }
}

/// The mark of a handle.
fn rank(handle: &str) -> Option<usize> {
    MARKS.iter().position(|name| *name == handle)
}
