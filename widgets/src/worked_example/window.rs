//! What part of the world is drawn, and where in it things may be.
//!
//! The picture has to stay where it is under the hand that moves a thing in it. So the window does not follow what is drawn: it is the
//! one of the chapter's example wherever that shows everything, else a larger one of a few, and a hand takes nothing out of it.

use crate::scene::{Plane, Point, Rect};
use fastslam_lab::experiment::worked_example::WorkedExample;

/// Standard deviations from the middle of an ellipse to its edge.
pub const SIGMAS: f64 = 2.0;

/// Corners of the window of the chapter's example \[m\]: from the robots to the far end of the landmark's ellipse.
const HOME: [[f64; 2]; 2] = [[0.0, -0.74], [4.92, 0.84]];

/// Around a thing or its knob, to the edge of the drawing \[css px\].
const MARGIN: f64 = 13.0;

/// What stands in a place, and what it is moved by.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Thing {
    /// The robot of the particle in this slot.
    Robot(usize),
    /// Where the particle in this slot sees the landmark.
    Sighting(usize),
    /// μ.
    Mean,
}

impl Thing {
    /// Each of them.
    pub const ALL: [Self; 5] = [Self::Robot(0), Self::Robot(1), Self::Sighting(0), Self::Sighting(1), Self::Mean];

    /// Where it is \[m\].
    pub fn place(self, example: &WorkedExample) -> [f64; 2] {
        match self {
            Self::Robot(slot) => {
                let pose = &example.updates[slot].world_from_robot;
                [pose.x, pose.y]
            }
            Self::Sighting(slot) => example.updates[slot].seen_at.into(),
            Self::Mean => example.before.mean.into(),
        }
    }

    /// From it to what is grasped of it \[css px\]: apart from those of all that stands in the same place, and in the chapter's example
    /// from all others, as far as a finger is wide.
    pub fn knob(self) -> Point {
        match self {
            Self::Robot(0) => [-4.0, -32.0],
            Self::Robot(_) => [-4.0, 32.0],
            Self::Sighting(0) => [42.0, 17.0],
            Self::Sighting(_) => [38.0, -12.0],
            Self::Mean => [0.0, 0.0],
        }
    }

    /// Where in a drawing it may be, so that what is grasped of it is in there too \[css px\].
    pub fn room(self, area: &Rect) -> Rect {
        let [x, y] = self.knob();
        let [left, right, above, below] = [-x, x, -y, y].map(|reach| MARGIN + reach.max(0.0));
        Rect::new(area.x + left, area.y + above, area.w - left - right, area.h - above - below)
    }
}

/// The nearest point of an area \[css px\].
pub fn nearest([x, y]: Point, area: &Rect) -> Point {
    // Not `clamp`: its panic writes both ends, which takes 20 KB.
    [x.max(area.x).min(area.right()), y.max(area.y).min(area.bottom())]
}

/// The part of the world that is drawn.
pub fn plane(example: &WorkedExample, area: Rect) -> Plane {
    let home = window(area, middle(HOME), 1.0);
    if shows(&home, example) {
        return home;
    }
    let [low, high] = HOME;
    let places = Thing::ALL.map(|thing| thing.place(example));
    let end = |k: usize, pick: fn(f64, f64) -> f64| places.iter().map(|place| place[k]).reduce(pick).unwrap_or(0.0);
    let wanted = [0, 1].map(|k| 0.5 * (end(k, f64::min) + end(k, f64::max)));
    let mut size = 1.0;
    loop {
        // By a quarter of the window at a time.
        let centre = [0, 1].map(|k| {
            let cell = 0.25 * size * (high[k] - low[k]);
            middle(HOME)[k] + cell * ((wanted[k] - middle(HOME)[k]) / cell).round()
        });
        let larger = window(area, centre, size);
        // No number that can be set is as far away as a window of 40 km.
        if shows(&larger, example) || size > 8192.0 {
            return larger;
        }
        size *= 2.0;
    }
}

fn middle([low, high]: [[f64; 2]; 2]) -> [f64; 2] {
    [0, 1].map(|k| 0.5 * (low[k] + high[k]))
}

/// The window of the example, so many times as large about another place.
fn window(area: Rect, centre: [f64; 2], size: f64) -> Plane {
    let [low, high] = HOME;
    let half = [0, 1].map(|k| 0.5 * size * (high[k] - low[k]));
    let corners = [[centre[0] - half[0], centre[1] - half[1]], [centre[0] + half[0], centre[1] + half[1]]];
    // The robots at the left have knobs.
    let room = Rect::new(area.x + 36.0, area.y + 10.0, area.w - 50.0, area.h - 20.0);
    Plane { area, ..Plane::around(room, corners, 0.0) }
}

/// Whether all things are where they may be, and the ellipse is not much larger than the drawing. What a hand puts to the edge is
/// rounded to a decimal, which may be a px outside.
fn shows(plane: &Plane, example: &WorkedExample) -> bool {
    let covariance = &example.before.covariance;
    let fits = |variance: f64, room: f64| SIGMAS * variance.sqrt() * plane.scale <= 1.5 * room;
    fits(covariance.m11, plane.area.w)
        && fits(covariance.m22, plane.area.h)
        && Thing::ALL
            .iter()
            .all(|thing| thing.room(&plane.area).inset(-1.5).contains(plane.point(thing.place(example))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Layout as _;
    use crate::worked_example::layout::Layout;
    use fastslam_lab::experiment::worked_example::Inputs;

    fn areas() -> impl Iterator<Item = Rect> {
        (330..1600).step_by(3).map(|width| Layout::new(f64::from(width)).plot.unwrap())
    }

    #[test]
    fn the_example_is_seen_through_its_own_window_at_every_width() {
        for area in areas() {
            let example = WorkedExample::new(&Inputs::default());
            assert_eq!(plane(&example, area), window(area, middle(HOME), 1.0), "{area:?}");
        }
    }

    #[test]
    fn whatever_is_typed_is_in_the_window() {
        let far = [
            Inputs { poses: [[-100.0, 100.0, 1.0], [100.0, -100.0, 2.0]], ..Inputs::default() },
            Inputs { sightings: [[200.0, 3.0], [0.0, 0.0]], ..Inputs::default() },
            Inputs { mean: [4.0, 3.0], ..Inputs::default() },
            Inputs { covariance: [100.0, 0.0, 100.0], ..Inputs::default() },
        ];
        for area in areas() {
            for inputs in &far {
                let example = WorkedExample::new(inputs);
                assert!(shows(&plane(&example, area), &example), "{inputs:?} in {area:?}");
            }
        }
    }
}
