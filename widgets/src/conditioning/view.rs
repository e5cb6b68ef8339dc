//! What is to be seen of the graphical model: its graph, and beside it the covariance of the map.

use super::{
    graph::{Graph, LEVELS, SIGHTING, full_width, strength},
    layout::{GRAPH, Layout, MATRIX, NARROWEST},
    matrix::matrix,
    model::ConditioningModel,
};
use crate::{
    font::Weight,
    panels::Panels,
    scene::{Anchor, LINE, Mark, Point, Rect, Role, Sample, Scene, closed, diamond, ellipse, heading, legend, text},
    view::{View, whole_step},
};

/// Name of the handle that chooses an entry of the matrix.
pub const ENTRY: &str = "entry";

/// Figure w17.4, as it is seen.
#[derive(Default)]
pub struct ConditioningView;

impl View for ConditioningView {
    type Model = ConditioningModel;
    type Layout = Layout;
    const NARROWEST: f64 = NARROWEST;
    const PANELS: &'static [&'static str] = &[GRAPH, MATRIX];

    fn layout(width: f64, panels: &Panels) -> Layout {
        Layout::of(width, panels)
    }

    fn draw(&self, model: &ConditioningModel, layout: &Layout, scene: &mut Scene) {
        if layout.panels.has(GRAPH) {
            graph(scene, model, layout);
        }
        if layout.panels.has(MATRIX) {
            matrix(scene, model, layout);
            notes(scene, model, &layout.notes);
        }
    }

    fn drag(&self, model: &mut ConditioningModel, layout: &Layout, handle: &str, to: Point) {
        if handle == ENTRY {
            let area = layout.matrix;
            let cell = area.w / (2 * model.drive().landmarks().len()) as f64;
            model.choose([(to[1] - area.y) / cell, (to[0] - area.x) / cell]);
        }
    }

    fn nudge(&self, model: &mut ConditioningModel, handle: &str, [right, up]: [f64; 2]) {
        if handle == ENTRY {
            let [row, column] = model.entry().map(|k| k as f64);
            model.choose([row - whole_step(up), column + whole_step(right)]);
        }
    }
}

/// The graph, below what is known of the path.
fn graph(scene: &mut Scene, model: &ConditioningModel, layout: &Layout) {
    let (title, rest, role) = if model.conditioned() {
        ("Given the path", "every landmark stands alone", Role::Accent)
    } else {
        ("Path unknown", "its errors are shared by the map", Role::Ink)
    };
    heading(scene, &layout.graph_header, (title, role), rest);
    Graph::new(model, &layout.graph).draw(scene);
    names(scene, model, layout);
}

fn names(scene: &mut Scene, model: &ConditioningModel, layout: &Layout) {
    let known = model.conditioned();
    let pose = move |place: &Rect| {
        let disc = |(radius, role)| Mark::Discs { centres: vec![place.centre()], radius, role };
        let node = [(5.5, Role::Path), (3.5, Role::Paper)];
        node.into_iter().take(if known { 1 } else { 2 }).map(disc).collect()
    };
    let landmark = |at| Mark::Polygons { polygons: vec![diamond(at, 5.5)], role: Role::Landmark };
    let region = |at| {
        let lines = vec![closed(ellipse(at, [[16.0, 0.0], [0.0, 6.0]], 2.0))];
        Mark::Lines { lines, width: 1.5, dash: None, role: Role::Landmark }
    };
    let full = full_width(model, &layout.graph);
    let arcs = move |place: &Rect| {
        let (x, y) = (place.x, place.centre()[1]);
        let arc = |(x, share): (f64, f64)| {
            let (width, role) = strength((share * LEVELS as f64) as usize, full);
            Mark::Lines { lines: vec![vec![[x + 1.0, y], [x + 13.0, y]]], width, dash: None, role }
        };
        [(x, 0.25), (x + 16.0, 0.5), (x + 32.0, 1.0)].map(arc).into()
    };
    let items = [
        (Sample::new(pose), if known { "pose, known" } else { "pose, unknown" }),
        (Sample::line(Role::Path, 2.0, None), "odometry"),
        (Sample::at(landmark), "landmark"),
        (Sample::line(Role::Muted, 1.0, Some(SIGHTING)), "sighting"),
        (Sample::at(region), "90 % region"),
        (Sample::new(arcs).wide(48.0), "|ρ| = ¼, ½, 1"),
    ];
    legend(scene, &layout.legend, items);
}

fn notes(scene: &mut Scene, model: &ConditioningModel, area: &Rect) {
    let [a, b] = model.entry().map(|k| k / 2);
    let together = match (model.place(a).and(model.place(b)), model.seen_together(a, b)) {
        _ if a == b => "A landmark with itself: in its own block".into(),
        (None, _) => "Not both of them seen yet".into(),
        (_, 0) => "No pose saw both".into(),
        (_, 1) => "One pose saw both".into(),
        (_, n) => format!("{n} poses saw both"),
    };
    let off_block =
        format!("Off the blocks: {} of {} entries ≠ 0", model.map().off_block_nonzeros(), model.off_block());
    let size = 2 * model.drive().landmarks().len() + 3;
    let touched = format!("EKF {size}² = {}, FastSLAM 2² = 4 a particle", model.ekf_entries());
    let lines = [
        (model.entry_text(), Weight::SemiBold, Role::Accent),
        (together, Weight::Regular, Role::Muted),
        (off_block, Weight::SemiBold, Role::Ink),
        ("Entries that one sighting changes:".into(), Weight::Regular, Role::Muted),
        (touched, Weight::SemiBold, Role::Ink),
    ];
    for (k, (line, weight, role)) in lines.into_iter().enumerate() {
        let place = Rect::new(area.x, area.y + k as f64 * LINE, area.w, LINE);
        scene.marks.push(text(place, Anchor::Start, 12.0, weight, role, line));
    }
}
