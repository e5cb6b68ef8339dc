//! What a reader moves in the picture, and what becomes of the numbers.

use super::{
    layout::Layout,
    model::WorkedExampleModel,
    recipe::VARIANCE,
    steps::{number_of, pointed, steps},
    window::{SIGMAS, Thing, nearest, plane},
};
use crate::{
    decimal::rounded,
    model::Declared,
    robot::Poses as _,
    scene::{Plane, Point},
    view::whole_step,
};
use fastslam::{geometry::Pose2, ops};
use fastslam_lab::experiment::worked_example::{Inputs, WorkedExample};

/// The threshold, on the bar of N_eff.
pub const THRESHOLD: &str = "threshold";

/// The step that is pointed at.
pub const ROW: &str = "row";

/// Lengths of the levers by which the robots are turned \[css px\].
pub const HEADINGS: [f64; 2] = [54.0, 102.0];

/// What arrow keys move a place \[m\], an angle \[rad\], a variance \[m²\] and the threshold by.
const PLACE: f64 = 0.1;
const ANGLE: f64 = 0.05;
const SPREAD: f64 = 0.01;
const SHARE: f64 = 0.05;

/// Smallest variance that a hand can give \[m²\], and largest correlation.
const LEAST: f64 = 0.001;
const CORRELATED: f64 = 0.95;

/// Of the ends of an ellipse, to the edge of the drawing \[css px\].
const EDGE: f64 = 10.0;

/// As near to the level of μ as this, the end of the ellipse is at it \[css px\].
const LEVEL: f64 = 4.0;

/// What can be grasped in the drawing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Grip {
    /// Something that stands in a place.
    Thing(Thing),
    /// Where the robot in this slot looks.
    Heading(usize),
    /// The left end of the ellipse of Σ: how far away it is tells the variance of x, and how high it is the covariance.
    Spread,
    /// The upper end of the ellipse: the variance of y.
    Height,
}

impl Grip {
    /// Each of them, by its name.
    pub const NAMED: [(&'static str, Self); 9] = [
        ("robot-1", Self::Thing(Thing::Robot(0))),
        ("heading-1", Self::Heading(0)),
        ("sighting-1", Self::Thing(Thing::Sighting(0))),
        ("robot-2", Self::Thing(Thing::Robot(1))),
        ("heading-2", Self::Heading(1)),
        ("sighting-2", Self::Thing(Thing::Sighting(1))),
        ("mean", Self::Thing(Thing::Mean)),
        ("sigma", Self::Spread),
        ("sigma-yy", Self::Height),
    ];

    fn named(name: &str) -> Option<Self> {
        Self::NAMED.into_iter().find(|(known, _)| *known == name).map(|(_, grip)| grip)
    }

    /// Names of the parameters that it moves.
    pub fn axes(self) -> &'static [&'static str] {
        match self {
            Self::Thing(Thing::Robot(0)) => &["x1", "y1"],
            Self::Thing(Thing::Robot(_)) => &["x2", "y2"],
            Self::Thing(Thing::Sighting(0)) => &["r1", "phi1"],
            Self::Thing(Thing::Sighting(_)) => &["r2", "phi2"],
            Self::Thing(Thing::Mean) => &["mu-x", "mu-y"],
            Self::Heading(0) => &["theta1"],
            Self::Heading(_) => &["theta2"],
            Self::Spread => &["sigma-xx", "sigma-xy"],
            Self::Height => &["sigma-yy"],
        }
    }

    /// Where it is \[css px\].
    pub fn at(self, example: &WorkedExample, plane: &Plane) -> Point {
        let (mean, covariance) = (example.before.mean, example.before.covariance);
        let [x_std, y_std] = [covariance.m11, covariance.m22].map(f64::sqrt);
        // The ends of an ellipse lie beside its axes, the farther the more x and y have to do with each other.
        let end = |dx: f64, dy: f64| nearest(plane.point([mean.x + dx, mean.y + dy]), &plane.area.inset(EDGE));
        match self {
            Self::Thing(thing) => {
                let ([x, y], [dx, dy]) = (plane.point(thing.place(example)), thing.knob());
                [x + dx, y + dy]
            }
            Self::Heading(slot) => lever(example, slot, plane),
            Self::Spread => end(-SIGMAS * x_std, -SIGMAS * covariance.m12 / x_std),
            Self::Height => end(SIGMAS * covariance.m12 / y_std, SIGMAS * y_std),
        }
    }
}

/// Moves what has this name to a point of the layout.
pub fn drag(model: &mut WorkedExampleModel, layout: &Layout, name: &str, to: Point) {
    if let (THRESHOLD, Some(chain)) = (name, &layout.chain) {
        let bar = chain.bar();
        return set(model, |inputs| inputs.threshold = rounded((to[0] - bar.x) / bar.w, 2));
    }
    if let (ROW, Some(chain)) = (name, &layout.chain) {
        let rank = chain.places.iter().position(|place| to[1] < place.label.bottom());
        let rank = rank.unwrap_or(chain.places.len() - 1);
        return model.change(|recipe| recipe.row = number_of(chain.steps(), rank));
    }
    let (Some(area), Some(grip)) = (layout.plot, Grip::named(name)) else { return };
    let example = model.example().clone();
    let plane = plane(&example, area);
    let at = |thing: Thing| plane.point(thing.place(&example));
    match grip {
        Grip::Thing(thing) => {
            let (knob, mut room) = (thing.knob(), thing.room(&area));
            if let Thing::Robot(slot) = thing {
                // What it sees moves with it, and stays in the drawing too.
                let ([x, y], [u, v]) = (at(thing), at(Thing::Sighting(slot)));
                let seen = Thing::Sighting(slot).room(&area);
                let [right, bottom] =
                    [room.right().min(seen.right() + x - u), room.bottom().min(seen.bottom() + y - v)];
                (room.x, room.y) = (room.x.max(seen.x + x - u), room.y.max(seen.y + y - v));
                (room.w, room.h) = (right - room.x, bottom - room.y);
            }
            let place = plane.world(nearest([to[0] - knob[0], to[1] - knob[1]], &room));
            set(model, |inputs| put(inputs, thing, place));
        }
        Grip::Heading(slot) => {
            let from = at(Thing::Robot(slot));
            let room = Thing::Sighting(slot).room(&area);
            let update = &example.updates[slot];
            let Pose2 { x, y, theta } = update.world_from_robot;
            let (sin, cos) = ops::sin_cos(update.z.y);
            // From where it is asked to look back to where it looks: the first direction that leaves what it sees in the drawing.
            let turn = ops::wrap_angle(ops::atan2(from[1] - to[1], to[0] - from[0]) - theta);
            let looks = |k: u32| rounded(ops::wrap_angle(theta + turn.signum() * 0.01 * f64::from(k)), 2);
            let sees =
                |theta: f64| plane.point(Pose2::new(x, y, theta).transform([update.z.x * cos, update.z.x * sin]));
            let steps = (turn.abs() / 0.01).round() as u32;
            if let Some(theta) = (0..=steps).rev().map(looks).find(|theta| room.contains(sees(*theta))) {
                set(model, |inputs| inputs.poses[slot][2] = theta);
            }
        }
        Grip::Spread | Grip::Height => {
            let (middle, to) = (at(Thing::Mean), nearest(to, &area.inset(EDGE)));
            let [dx, dy] = [(to[0] - middle[0]) / plane.scale, (middle[1] - to[1]) / plane.scale];
            let level = (middle[1] - to[1]).abs() < LEVEL;
            set(model, |inputs| {
                let [xx, xy, yy] = inputs.covariance;
                inputs.covariance = if grip == Grip::Height {
                    let y_std = (dy / SIGMAS).max(0.0);
                    higher([xx, xy, y_std * y_std])
                } else {
                    let x_std = (-dx / SIGMAS).max(0.0);
                    wider([x_std * x_std, if level { 0.0 } else { -dy * x_std / SIGMAS }, yy])
                };
            });
        }
    }
}

/// Moves what has this name right and up, in steps.
pub fn nudge(model: &mut WorkedExampleModel, name: &str, [right, up]: [f64; 2]) {
    let along = right + up;
    if name == ROW {
        // Downwards through the table, from none on.
        let shown = steps(model.recipe().all_steps);
        let rank = pointed(model.recipe().row, shown).map_or(0.0, |rank| rank as f64 + 1.0) - whole_step(along);
        let rank = rank.max(0.0).min(shown.len() as f64) as usize;
        return model.change(|recipe| recipe.row = rank.checked_sub(1).map_or(0, |rank| number_of(shown, rank)));
    }
    let near = |x: f64| rounded(x, 4);
    set(model, |inputs| match Grip::named(name) {
        Some(Grip::Thing(thing)) => {
            let upwards = if matches!(thing, Thing::Sighting(_)) { ANGLE } else { PLACE };
            let pair = pair(inputs, thing);
            (pair[0], pair[1]) = (near(pair[0] + PLACE * right), near(pair[1] + upwards * up));
        }
        Some(Grip::Heading(slot)) => inputs.poses[slot][2] = near(inputs.poses[slot][2] + ANGLE * along),
        Some(Grip::Spread) => {
            let [xx, xy, yy] = inputs.covariance;
            inputs.covariance = wider([xx - SPREAD * right, xy - SPREAD * up, yy]);
        }
        Some(Grip::Height) => {
            let [xx, xy, yy] = inputs.covariance;
            inputs.covariance = higher([xx, xy, yy + SPREAD * along]);
        }
        None if name == THRESHOLD => inputs.threshold = near(inputs.threshold + SHARE * along),
        None => (),
    });
}

fn set(model: &mut WorkedExampleModel, change: impl FnOnce(&mut Inputs)) {
    model.change(|recipe| change(&mut recipe.inputs));
}

/// The two numbers that say where something is.
fn pair(inputs: &mut Inputs, thing: Thing) -> &mut [f64] {
    match thing {
        Thing::Robot(slot) => &mut inputs.poses[slot][..2],
        Thing::Sighting(slot) => &mut inputs.sightings[slot],
        Thing::Mean => &mut inputs.mean,
    }
}

/// Something in a place of the world \[m\].
fn put(inputs: &mut Inputs, thing: Thing, [x, y]: [f64; 2]) {
    let numbers = if let Thing::Sighting(slot) = thing {
        let [from_x, from_y, theta] = inputs.poses[slot];
        let [dx, dy] = [x - from_x, y - from_y];
        let bearing = ops::wrap_angle(ops::atan2(dy, dx) - theta);
        [rounded(ops::hypot(dx, dy), 2), rounded(bearing, 3)]
    } else {
        [rounded(x, 2), rounded(y, 2)]
    };
    pair(inputs, thing).copy_from_slice(&numbers);
}

/// Σ with another variance of x and covariance, which are brought to where it is one.
fn wider([xx, xy, yy]: [f64; 3]) -> [f64; 3] {
    let xx = rounded(xx, 3).max(LEAST).min(VARIANCE.1);
    let most = CORRELATED * (xx * yy).sqrt();
    // Towards 0, so that it does not become too large again.
    let kept = (1e3 * xy.abs().min(most) + 1e-6).floor() / 1e3;
    [xx, rounded(if xy < 0.0 { -kept } else { kept }, 3), yy]
}

/// Σ with another variance of y, which is brought to where it is one.
fn higher([xx, xy, yy]: [f64; 3]) -> [f64; 3] {
    let least = xy * xy / (xx * CORRELATED * CORRELATED);
    let yy = rounded((1e3 * yy.max(least).max(LEAST) - 1e-6).ceil() / 1e3, 3);
    [xx, xy, yy.min(VARIANCE.1)]
}

/// Where the lever ends by which a robot is turned: not so near to the robot, or to the other's, that a finger takes both, and not
/// outside of the drawing.
pub fn lever(example: &WorkedExample, slot: usize, plane: &Plane) -> Point {
    let pose = &example.updates[slot].world_from_robot;
    let from = plane.position(pose);
    let (sin, cos) = ops::sin_cos(pose.theta);
    let tip = nearest([from[0] + HEADINGS[slot] * cos, from[1] - HEADINGS[slot] * sin], &plane.area.inset(8.0));
    // As far along its direction as the edge that it meets first allows.
    let share = |k: usize, along: f64| if along == 0.0 { 1.0 } else { ((tip[k] - from[k]) / along).max(0.0) };
    let length = HEADINGS[slot] * share(0, HEADINGS[slot] * cos).min(share(1, -HEADINGS[slot] * sin));
    [from[0] + length * cos, from[1] - length * sin]
}
