//! Paths and walls that both views of the lap draw: of one universe, and of all at once.

use super::model::LapModel;
use crate::{
    model::Model as _,
    robot::{Poses as _, Robots as _},
    scene::{Plane, Point, Role, Scene, joined},
};
use fastslam::{genealogy::Path, geometry::Pose2};
use std::collections::BTreeSet;

/// Dashes and gaps of the truth and of raw odometry \[css px\].
pub const TRUTH: [f64; 2] = [2.0, 3.0];
/// See [`TRUTH`].
pub const RAW: [f64; 2] = [7.0, 4.0];

/// The walls as they are, where the truth is shown.
pub fn true_walls(scene: &mut Scene, model: &LapModel, plane: &Plane) {
    if model.shows_truth() {
        let plan = &model.lap().world().plan;
        let walls = plan.walls.iter().chain(&plan.furniture);
        scene.rimmed(walls.map(|s| vec![plane.point(s.a), plane.point(s.b)]).collect(), 1.25, None, Role::Truth);
    }
}

/// The path as the wheels alone report it, where that is shown.
pub fn odometry(scene: &mut Scene, model: &LapModel, plane: &Plane) {
    let (world, now) = (model.lap().world(), model.step() as usize);
    if model.shows_raw() {
        scene.rimmed(plane.path(&world.odometry[..=now], 0.5), 2.0, Some(RAW), Role::Raw);
        scene.rimmed_robot(plane, &world.odometry[now], 7.0, Role::Raw);
    }
}

/// The path as it was, where the truth is shown: over the estimate, thin and dashed, so that where both agree both are seen.
pub fn true_path(scene: &mut Scene, model: &LapModel, plane: &Plane) {
    let (world, now) = (model.lap().world(), model.step() as usize);
    if model.shows_truth() {
        scene.dashed(plane.path(&world.truth[..=now], 0.5), 1.5, TRUTH, Role::Truth);
        scene.rimmed_robot(plane, &world.truth[now], 7.0, Role::Truth);
    }
}

/// A step of a path: that of another run is the same, where its numbers are.
pub type Place = (u32, [u64; 3]);

/// Paths from their ends back to what is drawn already.
pub fn branches(drawn: &mut BTreeSet<Place>, plane: &Plane, paths: &mut dyn Iterator<Item = &Path>) -> Vec<Vec<Point>> {
    let branch = |path: &Path| {
        let mut poses: Vec<Pose2> = Vec::new();
        for node in path.back() {
            let pose = node.pose();
            poses.push(pose);
            if !drawn.insert((node.step(), [pose.x, pose.y, pose.theta].map(f64::to_bits))) {
                break;
            }
        }
        plane.path(&poses, 0.5)
    };
    joined(paths, branch)
}
