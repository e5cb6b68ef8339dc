//! One slipped wheel moves four landmarks together.

use super::{Kind, MARGIN};
use crate::{
    decimal::fixed,
    robot::{Poses, Robots},
    scene::{LINE, Plane, Rect, Role, Sample, Scene, closed, diamond, legend},
    words::{
        common,
        vignette::{self, SlipTold},
    },
};
use fastslam::{
    geometry::Pose2,
    nalgebra::Vector2,
    sensor::{LandmarkSensor as _, RangeBearing},
};

/// Where they truly are \[m\], round the figure that they form.
const LANDMARKS: [[f64; 2]; 4] = [[2.4, 0.6], [6.0, 0.6], [7.8, -0.4], [4.2, -0.6]];

/// Steps of the drive, of a metre each, straight ahead. The wheel slips in the first.
const STEPS: usize = 7;

/// The handle's place without any slip, and how far it goes from place to place \[°\].
const MIDDLE: u32 = 10;
const STEP: f64 = 0.5;

const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.1, bearing_std: 0.05, max_range: 10.0, field_of_view: core::f64::consts::TAU };

pub const KIND: Kind = Kind {
    name: "slip",
    handle: vignette::slip_handle,
    last: 2 * MIDDLE,
    value: |at| (fixed(slip(at), 1), "°"),
    number: vignette::slip_number,
    result: |at| (farthest(at), fixed(farthest(at), 2), "m"),
    told,
    draw,
};

fn slip(at: u32) -> f64 {
    STEP * (f64::from(at) - f64::from(MIDDLE))
}

/// The path that odometry tells, where the wheel slips by this angle \[rad\].
fn path(slip: f64) -> Vec<Pose2> {
    let mut path = vec![Pose2::default()];
    for step in 0..STEPS {
        let moved = Pose2::new(1.0, 0.0, if step == 0 { slip } else { 0.0 });
        path.push(path[step].compose(&moved));
    }
    path
}

/// The landmarks as they are mapped, each by what is measured of it from a pose about a metre before it.
fn mapped(at: u32) -> [[f64; 2]; 4] {
    let (driven, believed) = (path(0.0), path(slip(at).to_radians()));
    LANDMARKS.map(|[x, y]| {
        let seen_from = x as usize - 1;
        let z = SENSOR.predict(&driven[seen_from], &Vector2::new(x, y)).z;
        SENSOR.locate(&believed[seen_from], &z).into()
    })
}

fn distance([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    Vector2::new(ax - bx, ay - by).norm()
}

/// How far the landmark is moved that is moved farthest \[m\].
fn farthest(at: u32) -> f64 {
    mapped(at).into_iter().zip(LANDMARKS).map(|(a, b)| distance(a, b)).fold(0.0, f64::max)
}

/// The largest change of a distance between two of them \[m\].
fn change(at: u32) -> f64 {
    let mapped = mapped(at);
    let pairs = (0..4).flat_map(|i| (0..i).map(move |j| (i, j)));
    let change = |(i, j)| (distance(mapped[i], mapped[j]) - distance(LANDMARKS[i], LANDMARKS[j])).abs();
    pairs.map(change).fold(0.0, f64::max)
}

fn told(at: u32) -> String {
    SlipTold { slip: &fixed(slip(at).abs(), 1), far: &fixed(farthest(at), 2), change: &fixed(change(at), 2) }.say()
}

/// Where all is, dashed, and where the robot believes it is.
fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    let plane = Plane::around(area.inset(-MARGIN), [[-0.3, -1.15], [8.3, 1.15]], 4.0);
    let worlds = [
        (path(0.0), LANDMARKS, Some([4.0, 4.0]), [Role::Truth; 2]),
        (path(slip(at).to_radians()), mapped(at), None, [Role::Path, Role::Feature]),
    ];
    for (path, landmarks, dash, [of_path, of_landmarks]) in worlds {
        let corners = landmarks.map(|place| plane.point(place));
        scene.strokes(vec![closed(corners.to_vec())], 1.5, dash, of_landmarks);
        scene.strokes(plane.path(&path, 0.0), 2.0, dash, of_path);
        scene.polygons(corners.map(|corner| diamond(corner, 5.5)).to_vec(), of_landmarks);
        scene.rimmed_robot(&plane, &path[STEPS], 9.0, of_path);
    }
    let names = Rect::new(area.x, area.bottom() - LINE, area.w, LINE);
    legend(scene, &names, [(Sample::line(Role::Truth, 2.0, Some([4.0, 4.0])), common::truth())]);
}
