//! What is to be seen of record and draws, and what of it can be moved.

use super::{
    chart::{AT, MIDDLE, charts, most, place},
    ground::{key, maps},
    layout::{CURVES, Layout, MAPS},
    model::SmoothingModel,
};
use crate::{
    prediction::{GUESS, State},
    scene::{Point, Rect, Scene},
    view::{View, whole_step},
};
use fastslam_lab::experiment::smoothing::STEPS;

/// The figure of the smoother, as it is seen.
#[derive(Default)]
pub struct SmoothingView;

impl View for SmoothingView {
    type Model = SmoothingModel;
    type Layout = Layout;

    fn gist(_model: &SmoothingModel, layout: &Layout, width: f64) -> Rect {
        if !layout.shown.has(CURVES) {
            return Rect::new(0.0, 0.0, width, layout.height);
        }
        Rect::new(0.0, layout.names[0].y, width, layout.axes[0].bottom() - layout.names[0].y)
    }

    fn draw(&self, model: &SmoothingModel, layout: &Layout, scene: &mut Scene) {
        if layout.shown.has(MAPS) {
            maps(scene, model, layout);
        }
        key(scene, model, layout, layout.shown.has(CURVES) && !model.pinned().is_empty());
        if layout.shown.has(CURVES) {
            charts(scene, model, layout);
        }
    }

    fn drag(&self, model: &mut SmoothingModel, layout: &Layout, handle: &str, to: Point) {
        let area = place(layout, 0).area;
        match handle {
            AT => model.look_at(f64::from(STEPS) * (to[0] - area.x) / area.w),
            GUESS => model.guess_at(most(model) * (area.bottom() - to[1]) / area.h),
            _ => (),
        }
    }

    fn nudge(&self, model: &mut SmoothingModel, handle: &str, [right, up]: [f64; 2]) {
        let by = whole_step(right + up);
        match (handle, model.state()) {
            (AT, _) => model.look_at(f64::from(model.at()) + by),
            (GUESS, State::Placed(guess)) => model.guess_at(guess + by),
            (GUESS, _) => model.guess_at(MIDDLE + by),
            _ => (),
        }
    }
}
