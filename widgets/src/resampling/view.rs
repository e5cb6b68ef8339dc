//! What is to be seen of the three filters: curves over the steps, the tree of their ancestry, and where their particles are.

use super::{
    filter::{Filter, SECOND, THRESHOLD, error_scale},
    layout::{CHARTS, ERROR, ESS, LINEAGE, Layout, NARROWEST, PARTICLES, TREE},
    model::{Moment, ResamplingModel},
    tree::{DEAD, common},
};
use crate::decimal::fixed;
use crate::{
    model::Model,
    panels::Panels,
    scene::{Chart, Handle, Mark, Point, Rect, Role, Sample, Scene, closed, diamond, legend, robot},
    view::{View, whole_step},
    words::{self, resampling},
};

/// Name of the handle that chooses the step read.
pub const CURSOR: &str = "cursor";

/// Figure w17.2, as it is seen.
#[derive(Default)]
pub struct ResamplingView;

impl View for ResamplingView {
    type Model = ResamplingModel;
    type Layout = Layout;
    const NARROWEST: f64 = NARROWEST;
    const PANELS: &'static [&'static str] = &[ESS, LINEAGE, ERROR, TREE, PARTICLES];

    fn layout(width: f64, panels: &Panels) -> Layout {
        Layout::of(width, panels)
    }

    fn draw(&self, model: &ResamplingModel, layout: &Layout, scene: &mut Scene) {
        let panels = &layout.panels;
        let error_scale = error_scale(model.largest_error());
        for (policy, column) in layout.columns.iter().enumerate() {
            let filter = Filter { model, policy, column, error_scale };
            filter.charts(scene, panels);
            if panels.has(PARTICLES) {
                filter.map(scene, layout.wide);
            }
        }
        if panels.are_all() {
            names(scene, model, &layout.legend);
        }
        if !CHARTS.iter().any(|name| panels.has(name)) {
            return;
        }
        let first = Chart { area: layout.first_chart(), last: model.step_count() };
        scene.handles.push(Handle {
            name: CURSOR,
            title: resampling::cursor().into(),
            at: [first.x(model.cursor()), layout.first_chart().centre()[1]],
            axes: &[CURSOR],
            value: f64::from(model.cursor()),
            text: told(model),
            hover: Some(layout.charts()),
        });
    }

    fn drag(&self, model: &mut ResamplingModel, layout: &Layout, handle: &str, to: Point) {
        if handle == CURSOR {
            let column = layout.columns.iter().rev().find(|c| c.header.x <= to[0]).unwrap_or(&layout.columns[0]);
            let chart = &column.charts[0];
            model.look(((to[0] - chart.x) / chart.w * f64::from(model.step_count())).round());
        }
    }

    fn nudge(&self, model: &mut ResamplingModel, handle: &str, [right, _]: [f64; 2]) {
        if handle == CURSOR {
            model.look(f64::from(model.cursor()) + whole_step(right));
        }
    }
}

/// What the cursor reads, in words.
fn told(model: &ResamplingModel) -> String {
    let of = |policy| {
        let Moment { report, .. } = model.read(policy);
        resampling::NEffLineage { ess: &fixed(report.ess, 1), lineage: &report.descent.lineage(report.step) }.say()
    };
    resampling::AtCursor { step: &model.cursor(), never: &of(0), always: &of(1), selective: &of(2) }.say()
}

/// What marks mean.
fn names(scene: &mut Scene, model: &ResamplingModel, area: &Rect) {
    let back = resampling::BackOrMean { back: &model.back() }.say();
    let truth = |place: &Rect| {
        let [x, y] = place.centre();
        let lines = vec![closed(robot([x - 1.0, y], 0.0, 7.0))];
        vec![Mark::Lines { lines, width: 1.5, dash: None, role: Role::Truth }]
    };
    let mut items = vec![
        (Sample::line(Role::Ink, 1.5, None), resampling::start_or_best()),
        (Sample::line(Role::Muted, 1.25, Some(SECOND)), back.as_str()),
        (Sample::line(Role::Accent, 1.0, Some(THRESHOLD)), resampling::threshold()),
        (Sample::dot(Role::Copied, 1.75), words::common::resampled()),
        (Sample::line(Role::Path, 2.0, None), resampling::lives_on()),
        (Sample::line(Role::Level(DEAD), 1.0, None), words::common::died_out()),
        (Sample::new(|place| common(place.centre()).into()), resampling::common_ancestor()),
        (Sample::dot(Role::Path, 2.0), resampling::particle()),
        (Sample::new(truth), words::common::truth()),
    ];
    if model.run().wings_log().is_some() {
        let landmark = |at| Mark::Polygons { polygons: vec![diamond(at, 3.5)], role: Role::Landmark };
        items.push((Sample::at(landmark), resampling::landmark()));
    }
    legend(scene, area, items);
}
