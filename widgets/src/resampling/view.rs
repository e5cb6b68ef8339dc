//! What is to be seen of the three filters: where their particles are, curves over the steps, and the tree of one ancestry.

use super::{
    charts::{Picture, error_scale},
    guess::GUESS,
    layout::{CHARTS, ESS, Layout, PARTICLES, Parts},
    model::{Moment, ResamplingModel},
    stroke,
    tree::common,
};
use crate::decimal::{fixed, rounded, write};
use crate::{
    model::Model,
    prediction::State,
    robot::robot,
    scene::{Handle, Point, Rect, Role, Sample, Scene, closed, legend},
    view::{View, whole_step},
    words::{self, resampling},
};

/// Name of the handle that chooses the step read, and of the one that moves the threshold.
pub const CURSOR: &str = "cursor";
pub const THRESHOLD: &str = "threshold";

/// What the threshold is dragged by, and an arrow key moves it: every place between is a run of three filters.
const STEP: f64 = 0.05;

/// Figure w17.2, as it is seen.
#[derive(Default)]
pub struct ResamplingView;

impl View for ResamplingView {
    type Model = ResamplingModel;
    type Layout = Layout;

    fn gist(model: &ResamplingModel, layout: &Layout, width: f64) -> Rect {
        let parts = parts(model, layout);
        let charts = parts.charts.iter().chain(&parts.ticks).filter(|chart| chart.h > 0.0);
        let bottom = charts.map(Rect::bottom).fold(0.0, f64::max);
        let first = parts.first_chart();
        // A phone's maps and tabs, where no chart is shown.
        let none = Rect::new(0.0, 0.0, width, layout.height);
        if bottom > first.y { Rect::new(first.x, first.y, first.w, bottom - first.y) } else { none }
    }

    fn draw(&self, model: &ResamplingModel, layout: &Layout, scene: &mut Scene) {
        let panels = &layout.panels;
        let parts = parts(model, layout);
        let picture = Picture { model, parts, wide: layout.wide, error_scale: error_scale(model.largest_error()) };
        if panels.has(PARTICLES) {
            picture.maps(scene);
        }
        if panels.are_all() {
            names(scene, &picture, &layout.legend);
        }
        if CHARTS.iter().any(|name| panels.has(name)) {
            picture.charts(scene, panels);
            // Before anything of the run may be seen there is one step, and nothing to choose.
            if model.step_count() > 0 {
                scene.handles.push(cursor(&picture));
            }
        }
        if panels.has(ESS) {
            scene.handles.push(threshold(&picture));
        }
    }

    fn pick(&self, model: &mut ResamplingModel, target: u32) {
        model.choose(target as usize);
    }

    fn drag(&self, model: &mut ResamplingModel, layout: &Layout, handle: &str, [x, y]: Point) {
        let parts = parts(model, layout);
        match handle {
            CURSOR => {
                let chart = parts.first_chart();
                model.look(((x - chart.x) / chart.w * f64::from(model.course_steps())).round());
            }
            GUESS => {
                let chart = parts.first_chart();
                model.guess_at((x - chart.x) / chart.w * f64::from(model.course_steps()));
            }
            THRESHOLD => {
                let chart = parts.charts[0];
                model.put_threshold(rounded(((chart.bottom() - y) / chart.h / STEP).round() * STEP, 2));
            }
            _ => (),
        }
    }

    fn nudge(&self, model: &mut ResamplingModel, handle: &str, [right, up]: [f64; 2]) {
        match handle {
            CURSOR => model.look(f64::from(model.cursor()) + whole_step(right)),
            GUESS => {
                let from = match model.state() {
                    State::Placed(guess) | State::Guessed(guess) => guess,
                    _ => f64::from(model.course_steps() / 2),
                };
                model.guess_at(from + whole_step(right + up));
            }
            THRESHOLD => model.put_threshold(rounded(model.setup().threshold + STEP * (right + up), 3)),
            _ => (),
        }
    }
}

/// Where the parts stand on the course that is driven.
fn parts<'a>(model: &ResamplingModel, layout: &'a Layout) -> &'a Parts {
    &layout.courses[usize::from(model.run().wings_log().is_some())]
}

/// Reads a step.
fn cursor(picture: &Picture) -> Handle {
    let (model, chart) = (picture.model, picture.parts.first_chart());
    Handle {
        name: CURSOR,
        title: resampling::cursor().into(),
        at: [picture.x(model.cursor()), chart.centre()[1]],
        axes: &[CURSOR],
        value: f64::from(model.cursor()),
        text: told(model),
        hover: Some(picture.parts.over_time()),
    }
}

/// Moves the threshold, at the left end of its line.
fn threshold(picture: &Picture) -> Handle {
    let threshold = picture.model.setup().threshold;
    Handle::of(
        &[THRESHOLD],
        words::policy::threshold(),
        [picture.parts.charts[0].x - 6.0, picture.threshold_y()],
        threshold,
        resampling::ShareOfM { share: &write(threshold) }.say(),
    )
}

/// What the cursor reads, in words.
fn told(model: &ResamplingModel) -> String {
    let of = |policy| {
        let Moment { report, .. } = model.read(policy);
        resampling::NEffLineage { ess: &fixed(report.ess, 1), lineage: &report.descent.lineage(report.step) }.say()
    };
    resampling::AtCursor { step: &model.cursor(), never: &of(0), always: &of(1), selective: &of(2) }.say()
}

/// What marks mean that have no name where they stand.
fn names(scene: &mut Scene, picture: &Picture, area: &Rect) {
    let role = stroke::role(picture.chosen());
    let truth = |scene: &mut Scene, [x, y]: Point| {
        scene.line(&closed(robot([x - 1.0, y], 0.0, 7.0)), 1.5, Role::Truth);
    };
    let mut items =
        vec![(Sample::at(common), resampling::common_ancestor()), (Sample::at(truth), words::common::truth())];
    if picture.model.run().wings_log().is_some() {
        let landmark = Sample::at(|scene, at| scene.filled_diamond(at, 3.5, Role::Feature));
        items.push((landmark, resampling::landmark()));
    }
    if picture.wide {
        items.push((Sample::dot(role, 2.0), resampling::particle()));
    }
    if !picture.model.pinned(0).is_empty() {
        items.push((Sample::pinned(), words::common::pinned_run()));
    }
    legend(scene, area, items);
}
