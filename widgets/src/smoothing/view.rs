//! What is to be seen of record and draws, and what of it can be moved.

use super::{
    chart::{AT, charts, place},
    ground::{key, maps},
    layout::{CURVES, Layout, MAPS, NARROWEST},
    model::SmoothingModel,
};
use crate::{
    panels::Panels,
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
    const NARROWEST: f64 = NARROWEST;
    const PANELS: &'static [&'static str] = &[MAPS, CURVES];

    fn layout(width: f64, panels: &Panels) -> Layout {
        Layout::of(width, panels)
    }

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
        if handle == AT {
            let Rect { x, w, .. } = place(layout, 0).area;
            model.look_at(f64::from(STEPS) * (to[0] - x) / w);
        }
    }

    fn nudge(&self, model: &mut SmoothingModel, handle: &str, [right, up]: [f64; 2]) {
        if handle == AT {
            model.look_at(f64::from(model.at()) + whole_step(right + up));
        }
    }
}
