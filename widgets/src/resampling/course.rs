//! Where a filter's particles are, and the robot.

use super::{
    filter::{Filter, NAMES, SIZE},
    model::{Moment, ResamplingModel},
};
use crate::{
    font::Weight,
    scene::{Anchor, LINE, Mark, Plane, Point, Rect, Role, Scene, clip_polyline, closed, cloud, diamond, text},
    words::resampling,
};
use fastslam::ops;

impl Filter<'_> {
    /// Where the particles are, and the robot.
    pub fn map(&self, scene: &mut Scene, wide: bool) {
        let (model, area, label) = (self.model, self.column.map, self.column.map_label);
        let Moment { report, poses, best, .. } = model.read(self.policy);
        let lines = [0.0, 1.0].map(|k| Rect::new(label.x, label.y + k * LINE, label.w, LINE));
        let (name, says) =
            if wide { (resampling::particles_name(), lines[0]) } else { (NAMES[self.policy](), lines[1]) };
        let role = if wide { Role::Muted } else { Role::Ink };
        let weight = if wide { Weight::Regular } else { Weight::SemiBold };
        let anchor = if wide { Anchor::End } else { Anchor::Start };
        scene.marks.push(text(lines[0], Anchor::Start, SIZE, weight, role, name));
        let m = self.particles();
        match (report.right, model.run().lost_from()) {
            (Some(0), _) => {
                scene.marks.push(text(says, anchor, SIZE, Weight::SemiBold, Role::Extinct, resampling::wing_lost()))
            }
            (Some(n), _) if wide => {
                let says_it = resampling::WingHas { n: &n, m: &m }.say();
                scene.marks.push(text(says, anchor, SIZE, Weight::SemiBold, Role::Accent, says_it));
            }
            (Some(n), _) => {
                let says_it = resampling::WingHasShort { n: &n, m: &m }.say();
                scene.marks.push(text(says, anchor, SIZE, Weight::Regular, Role::Accent, says_it));
            }
            (None, Some(_)) => {
                scene.marks.push(text(says, anchor, SIZE, Weight::Regular, Role::Muted, resampling::not_lost_yet()));
            }
            (None, None) => (),
        }

        let plane = whole(model, area);
        let role = Role::Muted;
        if let Some(world) = model.run().lap_world() {
            let lines = world.plan.walls.iter().map(|s| vec![plane.point(s.a), plane.point(s.b)]).collect();
            scene.marks.push(Mark::Lines { lines, width: 1.0, dash: None, role });
        }
        if let Some(log) = model.run().wings_log() {
            let diamonds = log.landmarks.iter().map(|m| diamond(plane.point([m.x, m.y]), 2.75)).collect();
            scene.marks.push(Mark::Polygons { polygons: diamonds, role: Role::Landmark });
        }
        let truth = &model.run().truth()[..=report.step as usize];
        let path: Vec<Point> = truth.iter().map(|p| plane.position(p)).collect();
        scene.marks.push(Mark::Lines { lines: vec![path], width: 1.0, dash: Some([2.0, 3.0]), role: Role::Truth });
        let noses = poses.iter().map(|pose| nose(plane.position(pose), pose.theta, 6.0));
        let noses = noses.flat_map(|line| clip_polyline(&line, &area)).collect();
        scene.marks.push(Mark::Lines { lines: noses, width: 1.0, dash: None, role: Role::Path });
        scene.marks.push(cloud(poses.iter().map(|p| plane.position(p)), &area.inset(2.0), 2.0, Role::Path));
        let outlines = plane.robot(&truth[truth.len() - 1], 9.0).into_iter().map(closed).collect();
        scene.marks.push(Mark::Lines { lines: outlines, width: 1.5, dash: None, role: Role::Truth });
        let head = plane.robot(&poses[*best], 6.0).into_iter().collect();
        scene.marks.push(Mark::Polygons { polygons: head, role: Role::Path });
        scene.marks.push(Mark::Frame { area, width: 1.0, role: Role::Frame });
    }
}

/// The whole course at a place in the figure.
fn whole(model: &ResamplingModel, area: Rect) -> Plane {
    let run = model.run();
    let mut points: Vec<[f64; 2]> = run.truth().iter().map(|pose| [pose.x, pose.y]).collect();
    points.extend(run.wings_log().iter().flat_map(|log| log.landmarks.iter().map(|m| [m.x, m.y])));
    points.extend(run.lap_world().iter().flat_map(|world| [[0.0, 0.0], world.plan.size]));
    let end = |pick: fn(f64, f64) -> f64, start| [0, 1].map(|k| points.iter().map(|p| p[k]).fold(start, pick));
    Plane::around(area, [end(f64::min, f64::INFINITY), end(f64::max, f64::NEG_INFINITY)], 6.0)
}

/// From a pose to where it looks.
fn nose([x, y]: Point, theta: f64, length: f64) -> Vec<Point> {
    let (sin, cos) = ops::sin_cos(theta);
    vec![[x, y], [x + length * cos, y - length * sin]]
}
