//! Two particles that name one door differently: each asks its own pose and its own map.

use super::{Kind, label};
use crate::{
    decimal::fixed,
    robot::{Poses, Robots},
    scene::{Anchor, Plane, Rect, Role, Scene},
    words::vignette::{self, NamesDoor, NamesTold},
};
use fastslam::{
    geometry::Pose2,
    map::landmarks::{Association, Correspondence, Gate, Landmark, Landmarks},
    nalgebra::{Matrix2, Matrix3, Vector2},
    sensor::{Feature, LandmarkSensor as _, RangeBearing},
    weights::Weights,
};

const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.15, bearing_std: 0.06, max_range: 10.0, field_of_view: core::f64::consts::TAU };

/// Where doors are along the corridor, and how far from its middle \[m\].
const DOORS: [f64; 4] = [1.5, 3.5, 5.5, 7.5];
const WALL: f64 = 0.5;

/// Where the robot is by the first particle, and how far on it is by the second from place to place of the handle \[m\].
const ROBOT: f64 = 2.6;
const STEP: f64 = 0.05;

pub const KIND: Kind = Kind {
    name: "names",
    handle: vignette::names_handle,
    last: 40,
    value: |at| (fixed(ahead(at), 2), "m"),
    number: vignette::names_number,
    result: |at| (100.0 * share(at), percent(share(at)), "%"),
    told: |at| NamesTold { a: &name(0.0), b: &name(ahead(at)), share: &percent(share(at)) }.say(),
    draw,
};

fn ahead(at: u32) -> f64 {
    STEP * f64::from(at)
}

fn robot(ahead: f64) -> Pose2 {
    Pose2::new(ROBOT + ahead, 0.0, 0.0)
}

fn map() -> Landmarks<RangeBearing> {
    let door = |x| Landmark {
        mean: Vector2::new(x, WALL),
        covariance: Matrix2::new(0.04, 0.0, 0.0, 0.01),
        existence_count: 1,
        apart: 0,
    };
    Landmarks::new(SENSOR, Correspondence::Unknown(Gate::default())).with(DOORS.map(door))
}

/// What is seen: the second door, from where the first particle is.
fn sighting() -> Feature {
    Feature { z: SENSOR.predict(&robot(0.0), &Vector2::new(DOORS[1], WALL)).z, signature: None }
}

/// What a particle that is so far ahead takes it for, by number, and the log of its weight \[nats\].
fn decides(ahead: f64) -> (Option<usize>, f64) {
    let decided = map().associate(&robot(ahead), &Matrix3::zeros(), &[sighting()]);
    let door = match decided.associations[0] {
        Association::Matched(door) => Some(door as usize),
        Association::New(_) | Association::Ignored => None,
    };
    (door, decided.log_likelihood)
}

fn name(ahead: f64) -> String {
    decides(ahead).0.map_or_else(|| vignette::names_new().into(), |door| NamesDoor { door: &(door + 1) }.say())
}

/// The weight of the second particle, of both together.
fn share(at: u32) -> f64 {
    let (weights, _) = Weights::uniform(2).reweighted(&[decides(0.0).1, decides(ahead(at)).1]);
    weights.as_slice()[1]
}

fn percent(share: f64) -> String {
    if share < 1e-3 { "< 0.1".into() } else { fixed(100.0 * share, if share < 0.1 { 1 } else { 0 }) }
}

/// The corridor twice: above as the first particle has it, below as the second.
fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    let half = 0.5 * area.h;
    for (row, (ahead, share)) in [(0.0, 1.0 - share(at)), (ahead(at), share(at))].into_iter().enumerate() {
        let strip = Rect::new(area.x, area.y + row as f64 * half, area.w, half);
        let plane = Plane { at: [strip.x, strip.y + 20.0], ..Plane::from_upper_left(strip, [0.0, WALL], area.w / 9.0) };
        let (pose, named) = (robot(ahead), decides(ahead).0);
        let seen = SENSOR.locate(&pose, &sighting().z);
        scene.fill(Rect::new(strip.x, plane.at[1] - 2.0, strip.w, 4.0), Role::Frame);
        let mut leaf = |x: f64, role, words: &str| {
            let [middle, y] = plane.point([x, WALL]);
            scene.fill(Rect::new(middle - 0.3 * plane.scale, y - 4.0, 0.6 * plane.scale, 8.0), role);
            label(scene, Rect::new(middle - 20.0, y - 21.0, 40.0, 16.0), Anchor::Middle, role, words);
        };
        for (door, x) in DOORS.into_iter().enumerate() {
            leaf(x, if named == Some(door) { Role::Accent } else { Role::Muted }, &(door + 1).to_string());
        }
        if named.is_none() {
            leaf(seen.x, Role::Accent, vignette::names_short());
        }
        scene.dash(&[plane.position(&pose), plane.point([seen.x, seen.y])], 2.0, [4.0, 3.0], Role::Accent);
        let role = Role::Series(row as u8);
        scene.rimmed_robot(&plane, &pose, 10.0, role);
        let line = Rect::new(strip.x, plane.position(&pose)[1] - 9.0, strip.w, 18.0);
        label(scene, line, Anchor::Start, role, ["A", "B"][row]);
        label(scene, line, Anchor::End, role, &format!("{} %", percent(share)));
    }
}
