//! The whole step, small: where the panels are in the world, and the landmark, which is moved here.

use super::{layout::Layout, model::ProposalModel, zoom};
use crate::{
    decimal::write,
    font::Weight,
    marks::{filled_diamond, ring_within},
    scene::{Anchor, Handle, Mark, NINE_TENTHS, Point, Rect, Role, Scene, clip_polyline, rimmed_robot, text},
    words::proposal,
};
use fastslam_lab::experiment::proposals::{CONTROL, FROM};

/// The landmark.
pub const LANDMARK: &str = "landmark";

/// From a robot's centre to its nose \[css px\].
const ROBOT: f64 = 7.0;

/// Draws the world.
pub fn world(scene: &mut Scene, model: &ProposalModel, layout: &Layout) {
    let (found, setup, plane) = (model.proposals(), model.setup(), layout.world_plane());
    let ([caption, area], view) = (layout.world, &layout.panels[0].view);
    scene.marks.push(text(caption, Anchor::Start, 11.5, Weight::Regular, Role::Muted, proposal::world()));

    // What the panels show of it.
    let near = zoom::plane(view, setup.odometry_scale);
    let [a, b] = [[view.x, view.y], [view.right(), view.bottom()]].map(|corner| plane.point(near.world(corner)));
    let seen = [[a[0], a[1]], [b[0], a[1]], [b[0], b[1]], [a[0], b[1]], [a[0], a[1]]];
    let seen = clip_polyline(&seen, &area);
    scene.marks.push(Mark::Lines { lines: seen, width: 1.0, dash: Some([3.0, 2.0]), role: Role::Muted });

    let straight = |a: Point, b: Point| clip_polyline(&[a, b], &area);
    let drive = straight(plane.position(&FROM), plane.position(&CONTROL.apply(&FROM)));
    scene.marks.push(Mark::Lines { lines: drive, width: 1.25, dash: None, role: Role::Muted });
    let landmarks: Vec<Point> = found.landmarks.iter().map(|l| plane.point([l.mean.x, l.mean.y])).collect();
    let sight = straight(plane.position(&found.truth), landmarks[0]);
    scene.marks.push(Mark::Lines { lines: sight, width: 1.25, dash: Some([2.0, 4.0]), role: Role::Landmark });
    for (k, (landmark, at)) in found.landmarks.iter().zip(&landmarks).enumerate() {
        let reach = plane.region([landmark.mean.x, landmark.mean.y], landmark.covariance.into(), NINE_TENTHS);
        scene.marks.push(Mark::Lines { lines: reach, width: 1.25, dash: None, role: Role::Landmark });
        if area.inset(5.0).contains(*at) {
            scene.marks.push(filled_diamond(*at, 5.0, Role::Landmark));
        }
        let [x, y] = *at;
        let name = Rect::new(x - 6.0, y - 23.0, 12.0, 14.0);
        if found.landmarks.len() > 1 && area.encloses(&name) {
            scene.marks.push(text(name, Anchor::Middle, 11.0, Weight::SemiBold, Role::Ink, ["A", "B"][k]));
        }
    }
    rimmed_robot(scene, &plane, &FROM, ROBOT, Role::Muted);
    rimmed_robot(scene, &plane, &found.truth, ROBOT, Role::Ink);
    scene.marks.push(ring_within(&area, landmarks[0], 8.0));
    scene.marks.push(Mark::Frame { area, width: 1.0, role: Role::Frame });

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
