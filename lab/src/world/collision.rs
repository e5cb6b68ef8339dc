//! What stops a robot: how near its way comes to what stands there.

use super::{FloorPlan, Segment};
use fastslam::ops;

/// Half the width of the robot \[m\].
pub const ROBOT_RADIUS: f64 = 0.2;

type Point = [f64; 2];

impl FloorPlan {
    /// Distance \[m\] from the way between two points to the nearest wall or piece of furniture: 0 where it goes through one, infinite
    /// where there is none.
    pub fn clearance(&self, from: Point, to: Point) -> f64 {
        let way = Segment { a: from, b: to };
        let all = self.walls.iter().chain(&self.furniture);
        all.map(|segment| apart(&way, segment)).fold(f64::INFINITY, f64::min)
    }

    /// Whether a robot can drive from one point to another. One that stands too near a wall already can leave it, but come no nearer;
    /// one that was set down in the middle of a wall can leave it on either side.
    pub fn is_open(&self, from: Point, to: Point) -> bool {
        let here = self.clearance(from, from);
        if from == to || here == 0.0 {
            return true;
        }
        let way = self.clearance(from, to);
        way > 0.0 && way >= ROBOT_RADIUS.min(here) - 1e-9
    }
}

/// Distance of a point from a segment \[m\].
pub(super) fn distance(point: Point, segment: &Segment) -> f64 {
    let [along, to] = [minus(segment.b, segment.a), minus(point, segment.a)];
    let length = dot(along, along);
    let t = if length > 0.0 { (dot(to, along) / length).clamp(0.0, 1.0) } else { 0.0 };
    ops::hypot(to[0] - t * along[0], to[1] - t * along[1])
}

/// Distance of two segments \[m\]: 0 where they cross.
fn apart(one: &Segment, other: &Segment) -> f64 {
    let sides = |of: &Segment, by: &Segment| {
        [by.a, by.b].map(|point| cross(minus(of.b, of.a), minus(point, of.a))).iter().product::<f64>()
    };
    if sides(one, other) < 0.0 && sides(other, one) < 0.0 {
        return 0.0;
    }
    let ends = [distance(one.a, other), distance(one.b, other), distance(other.a, one), distance(other.b, one)];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn room() -> FloorPlan {
        let walls = vec![Segment { a: [2.0, -1.0], b: [2.0, 1.0] }];
        FloorPlan { size: [4.0, 2.0], walls, furniture: Vec::new() }
    }

    #[test]
    fn a_way_is_as_clear_as_its_nearest_point() {
        assert_eq!(room().clearance([0.0, 0.0], [1.5, 0.0]), 0.5);
        assert_eq!(room().clearance([1.0, 0.0], [3.0, 0.0]), 0.0, "through the wall");
        assert_eq!(room().clearance([1.0, 1.5], [3.0, 1.5]), 0.5, "past its end");
        assert_eq!(room().clearance([1.0, 0.0], [1.0, 0.0]), 1.0, "at rest");
    }

    #[test]
    fn a_robot_too_near_a_wall_can_leave_it_and_come_no_nearer() {
        let near = [1.9, 0.0];
        assert!(room().is_open(near, [1.6, 0.0]) && !room().is_open(near, [1.95, 0.0]));
        assert!(!room().is_open(near, [2.5, 0.0]), "nor go through it");
        assert!(room().is_open([1.0, 0.0], [1.7, 0.0]) && !room().is_open([1.0, 0.0], [1.9, 0.0]));
    }
}
