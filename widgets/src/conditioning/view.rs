//! What is to be seen of the graphical model: its graph, and beside it the covariance of the map.

use super::{
    graph::{Graph, LEVELS, SIGHTING, full_width, strength},
    layout::{GRAPH, Layout, MATRIX},
    matrix::{ENTRY, matrix},
    model::ConditioningModel,
    recipe::Given,
};
use crate::{
    scene::{LINE, Letters, Point, Rect, Role, Room, Sample, Scene, closed, ellipse, legend, plain, strong},
    view::{View, whole_step},
    words::conditioning,
};

/// Figure w17.4, as it is seen.
#[derive(Default)]
pub struct ConditioningView;

impl View for ConditioningView {
    type Model = ConditioningModel;
    type Layout = Layout;

    fn gist(_model: &ConditioningModel, layout: &Layout, width: f64) -> Rect {
        if layout.graph.h > 0.0 { layout.graph } else { Rect::new(0.0, 0.0, width, layout.height) }
    }

    fn draw(&self, model: &ConditioningModel, layout: &Layout, scene: &mut Scene) {
        if layout.panels.has(GRAPH) {
            graph(scene, model, layout);
        }
        for (parameter, area) in ["condition", "last-pose", "pairs"].into_iter().zip(layout.buttons) {
            if layout.panels.are_all() {
                scene.rooms.push(Room { parameter, area });
            }
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
    let (title, rest, role) = match model.given() {
        Given::Nothing => (conditioning::path_unknown_header(), conditioning::errors_shared(), Role::Ink),
        Given::LastPose => (conditioning::given_last(), conditioning::others_open(), Role::Ink),
        Given::Path if model.reads_pairs() => (conditioning::given_path(), conditioning::read_together(), Role::Ink),
        Given::Path if model.is_sure() => (conditioning::path_sure_header(), conditioning::no_error(), Role::Accent),
        Given::Path => (conditioning::given_path(), conditioning::stands_alone(), Role::Accent),
    };
    scene.heading_fit(&layout.graph_header, (title, role), &[rest]);
    Graph::new(model, &layout.graph).draw(scene);
    names(scene, model, layout);
}

fn names(scene: &mut Scene, model: &ConditioningModel, layout: &Layout) {
    let known = model.given() == Given::Path;
    let pose = |scene: &mut Scene, at: Point| {
        scene.disc(at, 5.5, Role::Path);
        if !known {
            scene.disc(at, 3.5, Role::Paper);
        }
    };
    let region = |scene: &mut Scene, at: Point| {
        scene.line(&closed(ellipse(at, [[16.0, 0.0], [0.0, 6.0]], 2.0)), 1.5, Role::Feature);
    };
    let full = full_width(model, &layout.graph);
    let arcs = |scene: &mut Scene, place: &Rect| {
        let (x, y) = (place.x, place.centre()[1]);
        for (x, share) in [(x, 0.25), (x + 16.0, 0.5), (x + 32.0, 1.0)] {
            let (width, role) = strength((share * LEVELS as f64) as usize, full);
            scene.line(&[[x + 1.0, y], [x + 13.0, y]], width, role);
        }
    };
    let items = [
        (Sample::at(pose), if known { conditioning::pose_known() } else { conditioning::pose_unknown() }),
        (Sample::line(Role::Path, 2.0, None), conditioning::odometry()),
        (Sample::at(|scene, at| scene.filled_diamond(at, 5.5, Role::Feature)), conditioning::landmark()),
        (Sample::line(Role::Muted, 1.0, Some(SIGHTING)), conditioning::sighting()),
        (Sample::at(region), conditioning::region()),
        (Sample::new(arcs).wide(48.0), "|ρ| = ¼, ½, 1"),
    ];
    legend(scene, &layout.legend, items);
}

fn notes(scene: &mut Scene, model: &ConditioningModel, area: &Rect) {
    let [a, b] = model.entry().map(|k| k / 2);
    let together = match (model.place(a).and(model.place(b)), model.seen_together(a, b)) {
        _ if a == b => conditioning::with_itself().into(),
        (None, _) => conditioning::not_both_seen().into(),
        (_, 0) => conditioning::no_pose_saw().into(),
        (_, 1) => conditioning::one_pose_saw().into(),
        (_, n) => conditioning::PosesSaw { n: &n }.say(),
    };
    let (off, all) = (&model.map().off_block_nonzeros(), &model.off_block());
    let off_block = conditioning::OffBlocks { off, all }.say();
    let off_block_short = conditioning::OffBlocksShort { off, all }.say();
    let size = 2 * model.drive().landmarks().len() + 3;
    let off_block_tiny = conditioning::OffBlocksTiny { off, all }.say();
    let touched = conditioning::Touched { size: &size, entries: &model.ekf_entries() }.say();
    let touched_short = conditioning::TouchedShort { entries: &model.ekf_entries() }.say();
    let entry = model.entry_text();
    let (said, told) = (strong(12.0, Role::Ink), plain(12.0, Role::Muted));
    let lines: [(&[&str], Letters); 5] = [
        (&[&entry], Letters { role: Role::Accent, ..said }),
        (&[&together], told),
        (&[&off_block, &off_block_short, &off_block_tiny], said),
        (&[conditioning::touches(), conditioning::touches_short()], told),
        (&[&touched, &touched_short], said),
    ];
    for (k, (texts, letters)) in lines.into_iter().enumerate() {
        scene.fit(Rect::new(area.x, area.y + k as f64 * LINE, area.w, LINE), letters, texts);
    }
}
