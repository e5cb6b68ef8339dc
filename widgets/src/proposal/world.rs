//! The whole step, small: where the panels are in the world, and the landmark, which is moved here.

use super::{layout::Layout, model::ProposalModel, zoom};
use crate::{
    decimal::write,
    robot::{Poses, Robots},
    scene::{Handle, NINE_TENTHS, Point, Rect, Role, Scene, clip_polyline, plain, strong},
    words::proposal,
};
use fastslam_lab::experiment::proposal::{CONTROL, FROM};

/// The landmark.
pub const LANDMARK: &str = "landmark";

/// From a robot's centre to its nose \[css px\].
const ROBOT: f64 = 7.0;

/// Draws the world.
pub fn world(scene: &mut Scene, model: &ProposalModel, layout: &Layout) {
    let (found, setup, plane) = (model.proposals(), model.setup(), layout.world_plane());
    let ([caption, area], view) = (layout.world, &layout.panels[0].view);
    scene.text(caption, plain(11.5, Role::Muted), proposal::world());

    // What the panels show of it.
    let near = zoom::plane(view, setup.odometry_scale);
    let [a, b] = [[view.x, view.y], [view.right(), view.bottom()]].map(|corner| plane.point(near.world(corner)));
    let seen = [[a[0], a[1]], [b[0], a[1]], [b[0], b[1]], [a[0], b[1]], [a[0], a[1]]];
    scene.dashed(clip_polyline(&seen, &area), 1.0, [3.0, 2.0], Role::Muted);

    let straight = |a: Point, b: Point| clip_polyline(&[a, b], &area);
    scene.lines(straight(plane.position(&FROM), plane.position(&CONTROL.apply(&FROM))), 1.25, Role::Muted);
    let landmarks: Vec<Point> = found.landmarks.iter().map(|l| plane.point([l.mean.x, l.mean.y])).collect();
    scene.dashed(straight(plane.position(&found.truth), landmarks[0]), 1.25, [2.0, 4.0], Role::Feature);
    for (k, (landmark, at)) in found.landmarks.iter().zip(&landmarks).enumerate() {
        let reach = plane.region([landmark.mean.x, landmark.mean.y], landmark.covariance.into(), NINE_TENTHS);
        scene.lines(reach, 1.25, Role::Feature);
        if area.inset(5.0).contains(*at) {
            scene.filled_diamond(*at, 5.0, Role::Feature);
        }
        let [x, y] = *at;
        let name = Rect::new(x - 6.0, y - 23.0, 12.0, 14.0);
        if found.landmarks.len() > 1 && area.encloses(&name) {
            scene.text(name, strong(11.0, Role::Ink).middle(), ["A", "B"][k]);
        }
    }
    scene.rimmed_robot(&plane, &FROM, ROBOT, Role::Muted);
    scene.rimmed_robot(&plane, &found.truth, ROBOT, Role::Ink);
    scene.ring_within(&area, landmarks[0], 8.0);
    scene.frame(area, 1.0, Role::Frame);

    let [x, y] = setup.landmark;
    scene.handles.push(Handle {
        name: LANDMARK,
        title: proposal::landmark_handle().into(),
        at: plane.point([x, y]),
        axes: &["landmark-x", "landmark-y"],
        value: x,
        text: proposal::Place { x: &write(x), y: &write(y) }.say(),
        hover: None,
    });
}
