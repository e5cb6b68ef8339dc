//! What is to be seen of the graph, and what of it can be moved.

use super::{
    chart,
    city::{self, ENDS},
    layout::Layout,
    model::GraphModel,
    universes,
};
use crate::{
    decimal::between,
    model::Declared,
    prediction::{GUESS, State},
    scene::{Point, Rect, Scene},
    view::{View, whole_step},
};

/// The figure of the pose graph, as it is seen.
#[derive(Default)]
pub struct GraphView;

impl View for GraphView {
    type Model = GraphModel;
    type Layout = Layout;

    fn gist(_model: &GraphModel, layout: &Layout, width: f64) -> Rect {
        if layout.city.h > 0.0 { layout.city } else { Rect::new(0.0, 0.0, width, layout.height) }
    }

    fn draw(&self, model: &GraphModel, layout: &Layout, scene: &mut Scene) {
        if layout.city.h > 0.0 {
            city::draw(scene, model, layout);
        }
        if layout.universes.h > 0.0 {
            universes::draw(scene, model, layout);
        }
        if layout.error.h > 0.0 {
            chart::draw(scene, model, layout);
        }
    }

    fn drag(&self, model: &mut GraphModel, layout: &Layout, handle: &str, to: Point) {
        if handle == GUESS {
            return model.guess_at(chart::error(layout, to[1]));
        }
        let pose = city::nearest(model, &city::plane(model, layout), to);
        if let (Some(end), Some(pose)) = (ENDS.iter().position(|name| *name == handle), pose) {
            model.change(|recipe| recipe.put_end(end, pose));
        }
    }

    fn nudge(&self, model: &mut GraphModel, handle: &str, [right, up]: [f64; 2]) {
        let by = whole_step(right + up);
        if handle == GUESS {
            // A tenth of it, as the axis is: at least a centimetre.
            let guess = if let State::Placed(guess) = model.state() { guess } else { chart::MIDDLE };
            return model.guess_at(guess + by * (0.1 * guess).max(0.01));
        }
        if let Some(end) = ENDS.iter().position(|name| *name == handle).filter(|_| by.is_finite()) {
            let (ends, last) = (model.recipe().ends(), model.world().truth.len() as f64 - 1.0);
            let to = |by: f64| between(f64::from(ends[end]) + by, 0.0, last) as u32;
            // Over the other end, and not onto it.
            let pose = if to(by) == ends[1 - end] { to(by + by.signum()) } else { to(by) };
            model.change(|recipe| recipe.put_end(end, pose));
        }
    }
}
