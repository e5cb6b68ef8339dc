//! The building, and the graph in it: poses, edges, and the scans placed at the poses.

use super::{layout::Layout, model::GraphModel, told};
use crate::{
    model::{Declared as _, Model as _},
    robot::{Poses, Robots},
    scene::{
        Cells, FREE, OCCUPIED, Plane, Point, Rect, Role, Sample, Scene, Shading, UNKNOWN, clip_polyline, joined,
        legend, shade,
    },
    told::metres,
    words::{common, graph as words},
};
use fastslam_lab::{baseline::pose_graph::EdgeKind, experiment::graph::Solved};

/// Around the building, for a path that has left it \[m\].
const MARGIN: f64 = 1.7;

/// Colours of edges: of the wheels, of recent matches, of loops, and of the false one.
pub const ODOMETRY: Role = Role::Raw;
/// See [`ODOMETRY`].
pub const MATCH: Role = Role::Path;
/// See [`ODOMETRY`].
pub const LOOP: Role = Role::Copied;
/// See [`ODOMETRY`].
pub const WRONG: Role = Role::Extinct;

/// Names of the handles and of their parameters: the ends of the false edge.
pub const ENDS: [&str; 2] = ["wrong-from", "wrong-to"];

/// The building in its place.
pub fn plane(model: &GraphModel, layout: &Layout) -> Plane {
    let [w, h] = model.world().plan.size;
    Plane::around(layout.city, [[-MARGIN, -MARGIN], [w + MARGIN, h + MARGIN]], 0.0)
}

/// Where the false edge's ends are: on the true path, which does not move under the reader's hand.
pub fn ends(model: &GraphModel, plane: &Plane) -> [Point; 2] {
    model.recipe().ends().map(|pose| {
        let truth = &model.world().truth;
        plane.position(&truth[(pose as usize).min(truth.len() - 1)])
    })
}

/// The true pose nearest to a point.
pub fn nearest(model: &GraphModel, plane: &Plane, point: Point) -> Option<u32> {
    let [x, y] = plane.world(point);
    if !x.is_finite() || !y.is_finite() {
        return None;
    }
    let distance = |pose: &fastslam::geometry::Pose2| fastslam::ops::hypot(pose.x - x, pose.y - y);
    let poses = (0..).zip(&model.world().truth);
    poses.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b))).map(|(rank, _)| rank)
}

/// All of it.
pub fn draw(scene: &mut Scene, model: &GraphModel, layout: &Layout) {
    header(scene, model, layout);
    let plane = plane(model, layout);
    raster(scene, model, &plane);
    truth(scene, model, &plane);
    edges(scene, model, &plane);
    if let Some(last) = model.poses().last() {
        scene.rimmed_robot(&plane, last, 8.0, MATCH);
    }
    wrong(scene, model, &plane);
    scene.scale_bar(&plane, 1.0, f64::INFINITY);
    scene.frame(plane.area, 1.0, Role::Frame);
    names(scene, model, layout);
}

fn header(scene: &mut Scene, model: &GraphModel, layout: &Layout) {
    let (step, last) = (&model.step(), &model.step_count());
    let rms = &metres(model.frame().error.rms);
    let loops = &model.edges(EdgeKind::Loop).count();
    let strong = match model.graph().solved() {
        Solved::Not => words::tying_short().into(),
        Solved::InPart(_) => words::ClosingShort { loops }.say(),
        Solved::Whole if model.hides() => words::before_first().into(),
        Solved::Whole => words::Iteration { step, last }.say(),
    };
    let cost = told::cost(model.frame().cost);
    let rest = match (model.graph().is_solved(), layout.wide) {
        (true, true) => words::OffAndCost { rms, cost: &cost }.say(),
        _ => words::Off { rms }.say(),
    };
    scene.heading(&layout.city_header, (&strong, Role::Ink), &rest);
}

/// The map, in its own cells: it fills the area.
fn raster(scene: &mut Scene, model: &GraphModel, plane: &Plane) {
    let map = model.map();
    let cell = map.cell_size();
    let [low, high] =
        [[plane.area.x, plane.area.bottom()], [plane.area.right(), plane.area.y]].map(|at| plane.world(at));
    // Whole cells inside: at the edges what is left is as unknown as what is beyond.
    let [i0, j0] = low.map(|c| (c / cell).ceil() as i32);
    let [i1, j1] = high.map(|c| (c / cell).floor() as i32);
    let cells = Cells::of(i0..i1, j0..j1, |i, j| shade(map.log_odds(i, j)));
    let [left, top] = plane.point([f64::from(i0) * cell, f64::from(j1) * cell]);
    let area = Rect::new(left, top, f64::from(i1 - i0) * cell * plane.scale, f64::from(j1 - j0) * cell * plane.scale);
    scene.raster(plane.area, Cells::row(&[UNKNOWN]), Shading::Map);
    scene.raster(area, cells, Shading::Map);
}

fn truth(scene: &mut Scene, model: &GraphModel, plane: &Plane) {
    if model.shows_truth() {
        let plan = &model.world().plan;
        let walls =
            plan.walls.iter().chain(&plan.furniture).map(|s| vec![plane.point(s.a), plane.point(s.b)]).collect();
        scene.lines(walls, 1.25, Role::Truth);
    }
}

/// Edges between the poses as they are now: of the wheels a broad band, of matches a line in it, of loops what ties both visits together.
fn edges(scene: &mut Scene, model: &GraphModel, plane: &Plane) {
    let poses = model.poses();
    let path = plane.path(poses, 0.5);
    let tied = |kind| {
        let ends = model.edges(kind).map(|edge| [edge.i, edge.j].map(|pose| plane.position(&poses[pose])));
        joined(ends, |ends| clip_polyline(&ends, &plane.area))
    };
    scene.lines(path, 6.0, Role::Paper);
    scene.lines(tied(EdgeKind::Odometry), 4.0, ODOMETRY);
    scene.lines(tied(EdgeKind::Match), 1.75, MATCH);
    scene.rimmed(tied(EdgeKind::Loop), 1.25, None, LOOP);
    let dots = poses.iter().map(|pose| plane.position(pose)).filter(|at| plane.area.contains(*at)).collect();
    scene.discs(dots, 1.75, Role::Ink);
}

/// What the false edge claims, between the true places; and between the poses that it pulls together.
fn wrong(scene: &mut Scene, model: &GraphModel, plane: &Plane) {
    if !model.recipe().wrong() {
        return;
    }
    let ends = ends(model, plane);
    let poses =
        model.recipe().ends().map(|pose| plane.position(&model.poses()[(pose as usize).min(model.poses().len() - 1)]));
    // As broad as it still pulls.
    let width = 1.0 + 2.0 * model.frame().wrong_weight.unwrap_or(1.0);
    scene.rimmed(clip_polyline(&poses, &plane.area), width, None, WRONG);
    scene.rimmed(clip_polyline(&ends, &plane.area), 1.75, Some([5.0, 4.0]), WRONG);
    for (k, at) in ends.into_iter().enumerate() {
        scene.disc(at, 7.25, Role::Paper);
        scene.disc(at, 6.0, WRONG);
        let pose = model.recipe().ends()[k];
        scene.handles.push(crate::scene::Handle {
            name: ENDS[k],
            title: [words::from(), words::to()][k].into(),
            at,
            axes: core::slice::from_ref(&ENDS[k]),
            value: pose.into(),
            text: words::PoseOf { pose: &pose, all: &(model.poses().len() - 1) }.say(),
            hover: None,
        });
    }
}

fn names(scene: &mut Scene, model: &GraphModel, layout: &Layout) {
    let both = |scene: &mut Scene, place: &Rect| {
        Sample::line(ODOMETRY, 4.0, None).draw(scene, place);
        Sample::line(MATCH, 1.75, None).draw(scene, place);
    };
    let name = |long: &'static str, short: &'static str| if layout.wide { long } else { short };
    let mut items = vec![(Sample::new(both), name(words::path_edges(), words::path_edges_short()))];
    items.push((Sample::line(LOOP, 1.25, None), name(words::loop_mark(), words::loop_mark_short())));
    if model.recipe().wrong() {
        items.push((Sample::line(WRONG, 3.0, None), name(words::wrong_mark(), words::wrong_mark_short())));
    }
    if model.shows_truth() {
        items.push((Sample::line(Role::Truth, 1.25, None), name(words::true_walls(), common::truth())));
    }
    if layout.wide {
        items.push((Sample::cell(OCCUPIED), common::wall()));
        items.push((Sample::cell(FREE), common::free()));
    }
    legend(scene, &layout.city_legend, items);
}
