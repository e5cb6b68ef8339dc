//! The drawing: robots, what they see, the landmark before and after, and what of them is grasped.

use super::{
    hands::Grip,
    window::{SIGMAS, Thing, plane},
};
use crate::{
    decimal::write,
    robot::{Poses, robot},
    scene::{Handle, Plane, Point, Rect, Role, Sample, Scene, clip_polyline, closed, ellipse, plain, strong},
    words::worked_example,
};
use fastslam::{map::landmarks::Landmark, ops};
use fastslam_lab::experiment::worked_example::WorkedExample;

/// Radius of a knob, and of a plain grip \[css px\].
const KNOB: f64 = 8.5;
const GRIP: f64 = 5.0;

/// Robots, what they see, and the landmark before and after.
pub fn plot(scene: &mut Scene, example: &WorkedExample, area: &Rect, lit: &[&str]) {
    let plane = plane(example, *area);
    light(scene, example, &plane, lit);
    let ring = |scene: &mut Scene, landmark: &Landmark, width: f64, role: Role| {
        let mean = [landmark.mean.x, landmark.mean.y];
        scene.lines(plane.region(mean, landmark.covariance.into(), SIGMAS), width, role);
        if area.inset(3.0).contains(plane.point(mean)) {
            scene.disc(plane.point(mean), 2.5, role);
        }
    };
    ring(scene, &example.before, 2.0, Role::Feature);
    for (slot, update) in example.updates.iter().enumerate() {
        let role = Role::Series(slot as u8);
        let [from, to] = [Thing::Robot(slot), Thing::Sighting(slot)].map(|thing| plane.point(thing.place(example)));
        scene.dashed(clip_polyline(&[from, to], area), 1.25, [5.0, 4.0], role);
        ring(scene, &update.after, 1.25, role);
        scene.line(&[from, Grip::Heading(slot).at(example, &plane)], 1.5, role);
    }
    for (slot, length) in [(0, 13.0), (1, 8.0)] {
        let pose = &example.updates[slot].world_from_robot;
        scene.rimmed_polygon(robot(plane.position(pose), pose.theta, length), Role::Series(slot as u8));
        let (role, at) = (Role::Series(slot as u8), plane.point(Thing::Sighting(slot).place(example)));
        seen_at(scene, at, role);
    }
    scale(scene, &plane);
    let places = Grip::NAMED.map(|(_, grip)| grip.at(example, &plane));
    for (k, (_, grip)) in Grip::NAMED.into_iter().enumerate() {
        let [x, y] = places[k];
        // One that another covers has no name to be read.
        let open = places[k + 1..].iter().all(|[u, v]| ops::hypot(u - x, v - y) > 2.0 * KNOB);
        draw(scene, grip, example, &plane, open);
    }
    scene.frame(*area, 1.0, Role::Frame);
    for (name, grip) in Grip::NAMED {
        scene.handles.push(handle(name, grip, example, &plane));
    }
}

/// What enters the step that is pointed at, behind what is drawn of it; and the noise of the sensor, which is drawn only then.
fn light(scene: &mut Scene, example: &WorkedExample, plane: &Plane, lit: &[&str]) {
    let has = |symbol: &str| lit.contains(&symbol);
    let at = |thing: Thing| plane.point(thing.place(example));
    let (mut lines, mut discs, mut noise) = (Vec::new(), Vec::new(), Vec::new());
    if has("Σ") {
        let Landmark { mean, covariance, .. } = example.before;
        lines.extend(plane.region([mean.x, mean.y], covariance.into(), SIGMAS));
    }
    if has("μ") {
        discs.push(at(Thing::Mean));
    }
    for (slot, update) in example.updates.iter().enumerate() {
        if has("x") {
            discs.push(at(Thing::Robot(slot)));
        }
        if has("z") {
            lines.extend(clip_polyline(&[at(Thing::Robot(slot)), at(Thing::Sighting(slot))], &plane.area));
        }
        if has("Q") {
            let (sin, cos) = ops::sin_cos(update.world_from_robot.theta + update.z.y);
            let [along, across] = [example.noise.m11, update.z.x * update.z.x * example.noise.m22];
            let xy = (along - across) * sin * cos;
            let covariance =
                [[along * cos * cos + across * sin * sin, xy], [xy, along * sin * sin + across * cos * cos]];
            noise.extend(plane.region(Thing::Sighting(slot).place(example), covariance, SIGMAS));
        }
    }
    scene.lines(lines, 7.0, Role::Accent);
    scene.lines(noise, 2.5, Role::Accent);
    scene.discs(discs, KNOB + 6.0, Role::Accent);
}

/// What is grasped, as it is seen.
fn draw(scene: &mut Scene, grip: Grip, example: &WorkedExample, plane: &Plane, named: bool) {
    let at = grip.at(example, plane);
    match grip {
        Grip::Thing(Thing::Mean) => {
            scene.line(&closed(ellipse(at, [[1.0, 0.0], [0.0, 1.0]], KNOB)), 2.0, Role::Feature);
        }
        Grip::Thing(thing @ (Thing::Robot(slot) | Thing::Sighting(slot))) => {
            let role = Role::Series(slot as u8);
            scene.line(&[plane.point(thing.place(example)), at], 1.0, role);
            scene.knob(at, KNOB, role);
            if named {
                scene.text(Rect::around(at, KNOB), strong(11.5, Role::Paper).middle(), &(slot + 1).to_string());
            }
        }
        Grip::Heading(slot) => scene.knob(at, GRIP, Role::Series(slot as u8)),
        Grip::Spread | Grip::Height => scene.knob(at, GRIP, Role::Feature),
    }
}

fn handle(name: &'static str, grip: Grip, example: &WorkedExample, plane: &Plane) -> Handle {
    let covariance = &example.before.covariance;
    let place = |[x, y]: [f64; 2]| worked_example::Place { x: &write(x), y: &write(y) }.say();
    let (title, value, words) = match grip {
        Grip::Thing(Thing::Robot(slot)) => {
            let at = Thing::Robot(slot).place(example);
            (worked_example::RobotHandle { slot: &(slot + 1) }.say(), at[0], place(at))
        }
        Grip::Thing(Thing::Sighting(slot)) => {
            let z = &example.updates[slot].z;
            let words = worked_example::Polar { r: &write(z.x), phi: &write(z.y) }.say();
            (worked_example::SightingHandle { slot: &(slot + 1) }.say(), z.x, words)
        }
        Grip::Thing(Thing::Mean) => {
            let at = Thing::Mean.place(example);
            (worked_example::mean_handle().into(), at[0], place(at))
        }
        Grip::Heading(slot) => {
            let theta = example.updates[slot].world_from_robot.theta;
            let words = worked_example::Angle { theta: &write(theta) }.say();
            (worked_example::HeadingHandle { slot: &(slot + 1) }.say(), theta, words)
        }
        Grip::Spread => {
            let words = worked_example::Spread { xx: &write(covariance.m11), xy: &write(covariance.m12) }.say();
            (worked_example::spread_handle().into(), covariance.m11, words)
        }
        Grip::Height => {
            let words = worked_example::Variance { yy: &write(covariance.m22) }.say();
            (worked_example::height_handle().into(), covariance.m22, words)
        }
    };
    Handle { name, title, at: grip.at(example, plane), axes: grip.axes(), value, text: words, hover: None }
}

/// How long a metre is: the power of ten that takes up to half of the width.
fn scale(scene: &mut Scene, plane: &Plane) {
    let area = plane.area;
    let mut length = 1e-3;
    while 10.0 * length * plane.scale <= 0.5 * area.w {
        length *= 10.0;
    }
    let px = (length * plane.scale).min(area.w - 20.0);
    let (x, y) = (area.right() - 10.0 - px, area.bottom() - 7.0);
    scene.bar([x, y], px);
    let room = px.max(36.0);
    let name = Rect::new(area.right() - 10.0 - room, y - 17.0, room, 15.0);
    scene.text(name, plain(11.0, Role::Ink).end(), &format!("{} m", write(length)));
}

fn seen_at(scene: &mut Scene, at: Point, role: Role) {
    scene.cross(Rect::around(at, 4.0), 2.0, role);
}

fn landmark(scene: &mut Scene, at: Point, width: f64, role: Role) {
    scene.line(&closed(ellipse(at, [[64.0, 0.0], [0.0, 25.0]], 1.0)), width, role);
    scene.disc(at, 2.0, role);
}

/// The landmark before the sightings, in a legend.
pub fn before() -> Sample<'static> {
    let draw = |scene: &mut Scene, place: &Rect| {
        landmark(scene, [place.right() - 9.0, place.centre()[1]], 2.0, Role::Feature);
    };
    Sample::new(draw).wide(19.0)
}

/// What a particle sees, and the landmark after that.
pub fn after(role: Role) -> Sample<'static> {
    let draw = move |scene: &mut Scene, place: &Rect| {
        let (x, y) = (place.x, place.centre()[1]);
        scene.dash(&[[x, y], [x + 20.0, y]], 1.25, [5.0, 4.0], role);
        seen_at(scene, [x + 22.0, y], role);
        landmark(scene, [place.right() - 9.0, y], 1.25, role);
    };
    Sample::new(draw).wide(50.0)
}
