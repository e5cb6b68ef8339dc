//! A long corridor that comes back to where it began, with doors on both sides, and people who walk about.

use super::{FloorPlan, Segment};
use fastslam::geometry::Pose2;
use fastslam::ops;
use fastslam::random::{Purpose, Stream};

/// What is drawn of a ring: its doors, one stream a wall.
const DOORS: Purpose = Purpose::new(18);

/// What is drawn of people, one stream each.
const PEOPLE: Purpose = Purpose::new(19);

/// Of the corridor \[m\].
const WIDTH: f64 = 2.2;

/// From the edge of the plan to the middle of the corridor \[m\]: room for the rooms outside.
const MARGIN: f64 = 5.0;

/// A corridor round a block, three lengths by two, `length` \[m\] round along its middle: 60 m are 18 m × 12 m.
///
/// Along both walls there is a door every 5 to 10 m, drawn by the seed. Two in three are closed, and set back by 0.2 m; the others are
/// open, on a room of 3 m × 3 m.
///
/// ```text
///      +------------------------------- ··· ---------+
///      |     +--+            +--+                    |      corridor 2.2 m wide
///      |  +--+  +------------+  +------ ··· ------+  |      + + closed door, 1 m wide, 0.2 m deep
///      |  |                                       |  |
///      |  +------  --------------+--+-- ··· ------+  |
///      |      |      |                               |      open door, and its room
///      +------+------+----------------- ··· ---------+
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LongRing {
    /// Once round \[m\], 40 or more.
    pub length: f64,
    /// Seed of its doors.
    pub seed: u64,
}

impl LongRing {
    /// Half its extent along x and y, `offset` \[m\] further out than the middle of the corridor.
    fn half(&self, offset: f64) -> [f64; 2] {
        [0.15 * self.length + offset, 0.1 * self.length + offset]
    }

    /// The middle of the block \[m\].
    fn center(&self) -> [f64; 2] {
        self.half(MARGIN)
    }

    /// Its walls.
    ///
    /// # Panics
    /// For a ring of less than 40 m, in which the rooms of two sides would meet.
    pub fn plan(&self) -> FloorPlan {
        assert!(self.length >= 40.0, "a long ring has 40 m or more");
        let ([x, y], mut walls) = (self.center(), Vec::new());
        for (wall, outward) in [1.0, -1.0].into_iter().enumerate() {
            let [a, b] = self.half(outward * 0.5 * WIDTH);
            for (side, (upright, at, from, to, out)) in [
                (false, y - b, x - a, x + a, -1.0),
                (false, y + b, x - a, x + a, 1.0),
                (true, x - a, y - b, y + b, -1.0),
                (true, x + a, y - b, y + b, 1.0),
            ]
            .into_iter()
            .enumerate()
            {
                let mut stream = Stream::at(self.seed, DOORS, side as u32, wall as u32);
                walls.extend(wall_with_doors(upright, at, [from, to], outward * out, &mut stream));
            }
        }
        FloorPlan { size: self.half(MARGIN).map(|half| 2.0 * half), walls, furniture: Vec::new() }
    }

    /// Way points \[m\] along its middle from the middle of the south side, once round to the left and on for a quarter.
    pub fn once_and_a_quarter(&self) -> Vec<[f64; 2]> {
        let ([x, y], [a, b]) = (self.center(), self.half(0.0));
        let (start, corner) = ([x, y - b], [x + a, y - b]);
        vec![start, corner, [x + a, y + b], [x - a, y + b], [x - a, y - b], start, corner, [x + a, y]]
    }

    /// The point `offset` \[m\] outside the corridor's middle after this share of a round, from the south-west corner to the left.
    fn point(&self, share: f64, offset: f64) -> [f64; 2] {
        let ([x, y], [a, b]) = (self.center(), self.half(offset));
        let along = 4.0 * (a + b) * (share - share.floor());
        let (south, east, north) = (2.0 * a, 2.0 * (a + b), 4.0 * a + 2.0 * b);
        if along < south {
            [x - a + along, y - b]
        } else if along < east {
            [x + a, y - b + along - south]
        } else if along < north {
            [x + a - (along - east), y + b]
        } else {
            [x - a, y + b - (along - north)]
        }
    }

    /// Where `count` people are \[m\] after this time \[s\]. They walk round at 0.6 to 1.4 m/s, half of them each way, 0.5 to 0.8 m to the
    /// right of the corridor's middle.
    pub fn people(&self, count: u32, time: f64) -> Vec<[f64; 2]> {
        let person = |who: u32| {
            let mut stream = Stream::at(self.seed, PEOPLE, 0, who);
            let [start, speed, offset] = core::array::from_fn(|_| stream.uniform());
            // Round to the left, the right hand is outside.
            let way = if who.is_multiple_of(2) { 1.0 } else { -1.0 };
            self.point(start + way * (0.6 + 0.8 * speed) * time / self.length, way * (0.5 + 0.3 * offset))
        };
        (0..count).map(person).collect()
    }
}

/// Where `count` people are \[m\] who go along with a robot, in its frame: 0.7 to 1.8 m from it, each changing its place a little with
/// the time \[s\].
pub fn escort(seed: u64, count: u32, time: f64) -> Vec<[f64; 2]> {
    let person = |who: u32| {
        let mut stream = Stream::at(seed, PEOPLE, 1, who);
        let [distance, phase, rate, swing] = core::array::from_fn(|_| stream.uniform());
        let wave = ops::sin(core::f64::consts::TAU * (phase + (0.02 + 0.06 * rate) * time));
        let angle = core::f64::consts::TAU * f64::from(who) / f64::from(count) + (0.2 + 0.4 * swing) * wave;
        let (sin, cos) = ops::sin_cos(angle);
        let far = 0.9 + 0.7 * distance + 0.2 * wave;
        [far * cos, far * sin]
    };
    (0..count).map(person).collect()
}

/// Where `count` people are \[m\] who stand in the way of a robot, at the step-th pose of its way: each stays in one place for as many poses,
/// half a metre to 1.3 m beside the way, and then turns up in another. When the first comes, another is about to go.
pub fn crowd(seed: u64, count: u32, way: &[Pose2], step: u32) -> Vec<[f64; 2]> {
    /// Poses for which somebody stays.
    const STAY: u32 = 8;
    let person = |who: u32| {
        let time = step + who * STAY / count.max(1);
        let mut stream = Stream::at(seed, PEOPLE, 2 + time / STAY, who);
        // Where the robot is half-way through the stay.
        let middle = (step + STAY / 2).saturating_sub(time % STAY) as usize;
        let side = if stream.uniform() < 0.5 { 1.0 } else { -1.0 };
        let [ahead, aside] = core::array::from_fn(|_| stream.uniform());
        way[middle.min(way.len() - 1)].transform([2.4 * ahead - 0.6, side * (0.5 + 0.8 * aside)])
    };
    (0..count).map(person).collect()
}

/// How far a beam from a pose gets, `angle` \[rad\] to the left of ahead, before it meets one of these people \[m\]; infinite for none.
pub fn until_people(people: &[[f64; 2]], from: &Pose2, angle: f64) -> f64 {
    /// Of a person \[m\].
    const RADIUS: f64 = 0.22;
    let (sin, cos) = ops::sin_cos(from.theta + angle);
    let distance = |[x, y]: &[f64; 2]| {
        let (dx, dy) = (x - from.x, y - from.y);
        let (along, aside) = (cos * dx + sin * dy, cos * dy - sin * dx);
        let half = RADIUS * RADIUS - aside * aside;
        if half > 0.0 && along > 0.0 { (along - half.sqrt()).max(0.05) } else { f64::INFINITY }
    };
    people.iter().map(distance).fold(f64::INFINITY, f64::min)
}

/// A wall between two `ends` along x, or along y if `upright`, with doors away from the corridor, which is on the side against `out`.
fn wall_with_doors(upright: bool, at: f64, ends: [f64; 2], out: f64, stream: &mut Stream) -> Vec<Segment> {
    /// From a corner to a door, so that rooms of two sides do not meet \[m\].
    const CLEAR: f64 = 4.0;
    const DOOR: f64 = 1.0;
    const DEEP: f64 = 0.2;
    /// Sides of a room \[m\].
    const ROOM: f64 = 3.0;
    let mut corners = vec![[ends[0], at]];
    let mut place = ends[0] + CLEAR + 2.0 * stream.uniform();
    while place + DOOR <= ends[1] - CLEAR {
        let (deep, end) = (at + out * DEEP, place + DOOR);
        corners.extend([[place, at], [place, deep]]);
        if stream.uniform() < 1.0 / 3.0 {
            let begin = place - (ROOM - DOOR) * stream.uniform();
            let back = deep + out * ROOM;
            corners.extend([[begin, deep], [begin, back], [begin + ROOM, back], [begin + ROOM, deep]]);
        }
        corners.extend([[end, deep], [end, at]]);
        place += 5.0 + 5.0 * stream.uniform();
    }
    corners.push([ends[1], at]);
    let point = |[along, across]: [f64; 2]| if upright { [across, along] } else { [along, across] };
    corners.windows(2).map(|pair| Segment { a: point(pair[0]), b: point(pair[1]) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    const RINGS: [f64; 3] = [60.0, 120.0, 240.0];

    #[test]
    fn its_middle_is_as_long_as_it_says_and_comes_back() {
        for length in RINGS {
            let ring = LongRing { length, seed: 1 };
            let way = ring.once_and_a_quarter();
            let legs = |way: &[[f64; 2]]| -> f64 {
                way.windows(2).map(|leg| ops::hypot(leg[1][0] - leg[0][0], leg[1][1] - leg[0][1])).sum()
            };
            assert!((legs(&way[..6]) - length).abs() < 1e-9 && way[0] == way[5]);
            assert!((legs(&way) - 1.25 * length).abs() < 1e-9);
            let walked: Vec<[f64; 2]> = (0..1001).map(|k| ring.point(f64::from(k) / 1000.0, 0.0)).collect();
            // Corners are cut.
            assert!((legs(&walked) - length).abs() < 1.0 && walked[0] == walked[1000]);
        }
    }

    #[test]
    fn no_beam_leaves_the_corridor_and_both_kinds_of_doors_are_there() {
        for (length, seed) in RINGS.into_iter().flat_map(|length| (1..=5).map(move |seed| (length, seed))) {
            let ring = LongRing { length, seed };
            let plan = ring.plan();
            let [mut closed, mut open] = [0, 0];
            for k in 0..2000 {
                let from = ring.point(f64::from(k) / 2000.0, 0.0);
                for quarter in 0..4 {
                    let range = plan.raycast(from, 1e-4 + 0.5 * PI * f64::from(quarter));
                    assert!(range > 1.09 && range < 0.3 * length + 10.0, "{length} m, seed {seed}, {from:?}: {range}");
                    closed += u32::from((range - 1.3).abs() < 1e-6);
                    open += u32::from((range - 4.3).abs() < 1e-6);
                }
            }
            assert!(closed > 20 && (open > 0 || length < 100.0), "{length} m, seed {seed}: {closed}, {open}");
        }
        assert_ne!(LongRing { length: 60.0, seed: 1 }.plan(), LongRing { length: 60.0, seed: 2 }.plan());
    }

    #[test]
    fn people_walk_in_the_corridor_and_hide_what_is_behind_them() {
        let ring = LongRing { length: 60.0, seed: 3 };
        let (before, after) = (ring.people(8, 10.0), ring.people(8, 11.0));
        for (a, b) in before.iter().zip(&after) {
            let walked = ops::hypot(b[0] - a[0], b[1] - a[1]);
            assert!((0.3..1.6).contains(&walked), "{walked} m in a second");
        }
        let plan = ring.plan();
        for from in before.iter().chain(&after) {
            let nearest =
                (0..360).map(|k| plan.raycast(*from, f64::from(k).to_radians())).fold(f64::INFINITY, f64::min);
            assert!(nearest > 0.25, "{nearest} m from a wall");
        }
        let pose = Pose2::new(1.0, 2.0, 0.5 * PI);
        assert!((until_people(&[[1.0, 5.0], [1.0, 4.0]], &pose, 0.0) - 1.78).abs() < 1e-12);
        assert_eq!(until_people(&[[1.0, 5.0], [1.0, -4.0]], &pose, 0.5), f64::INFINITY);
    }

    #[test]
    fn an_escort_goes_along_and_leaves_the_robot_its_place() {
        for time in 0..200 {
            for [x, y] in escort(4, 9, f64::from(time)) {
                let far = ops::hypot(x, y);
                assert!((0.7..=1.8).contains(&far), "{far} m");
            }
        }
        assert_ne!(escort(4, 9, 0.0), escort(4, 9, 1.0));
    }

    #[test]
    fn a_crowd_stands_beside_the_way_and_is_never_the_same_for_long() {
        let way: Vec<Pose2> = (0..100).map(|k| Pose2::new(0.4 * f64::from(k), 0.0, 0.0)).collect();
        let mut stays = [0; 12];
        for step in 1..100 {
            let [before, now] = [step - 1, step].map(|step| crowd(4, 12, &way, step));
            for (who, ([x, y], was)) in now.iter().zip(&before).enumerate() {
                let here = &way[step as usize];
                assert!((0.5..=1.3).contains(&y.abs()) && (x - here.x).abs() < 4.1, "{x} {y} at {here:?}");
                stays[who] = if [*x, *y] == *was { stays[who] + 1 } else { 0 };
                assert!(stays[who] < 8);
            }
            assert!(now.iter().zip(&before).any(|(now, before)| now == before));
        }
    }
}
