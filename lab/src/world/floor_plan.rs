//! A floor plan of straight walls, and beams cast into it.

use fastslam::geometry::Pose2;
use fastslam::ops;
use fastslam::random::Stream;
use fastslam::sensor::BeamSensor;

/// A straight piece of wall or furniture from `a` to `b` \[m\].
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Segment {
    /// One end \[m\].
    pub a: [f64; 2],
    /// The other end \[m\].
    pub b: [f64; 2],
}

/// A place.
#[derive(Clone, PartialEq, Debug)]
pub struct FloorPlan {
    /// Extent \[m\] along x and y, from the origin.
    pub size: [f64; 2],
    /// Walls.
    pub walls: Vec<Segment>,
    /// Furniture: as solid to a beam as a wall.
    pub furniture: Vec<Segment>,
}

impl FloorPlan {
    /// Our own Apartment, 12 m × 9 m: a corridor from west to east, three rooms on each side, some furniture.
    pub fn apartment() -> Self {
        let wall = |x0, y0, x1, y1| Segment { a: [x0, y0], b: [x1, y1] };
        let walls = vec![
            wall(0.0, 0.0, 12.0, 0.0),
            wall(12.0, 0.0, 12.0, 9.0),
            wall(12.0, 9.0, 0.0, 9.0),
            wall(0.0, 9.0, 0.0, 0.0),
            // South side of the corridor, with the doors of kitchen, bath and bedroom.
            wall(0.0, 3.9, 1.9, 3.9),
            wall(2.9, 3.9, 5.1, 3.9),
            wall(6.0, 3.9, 8.3, 3.9),
            wall(9.3, 3.9, 12.0, 3.9),
            // North side, with the doors of living room and study, and the wide opening of the sun room.
            wall(0.0, 5.4, 3.3, 5.4),
            wall(4.4, 5.4, 6.2, 5.4),
            wall(7.1, 5.4, 8.9, 5.4),
            wall(11.1, 5.4, 12.0, 5.4),
            // Between the rooms.
            wall(4.2, 0.0, 4.2, 3.9),
            wall(6.9, 0.0, 6.9, 3.9),
            wall(5.3, 5.4, 5.3, 9.0),
            wall(8.3, 5.4, 8.3, 9.0),
        ];
        let mut furniture = Vec::new();
        let mut block = |x0: f64, y0: f64, x1: f64, y1: f64| {
            let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
            furniture.extend((0..4).map(|k| Segment { a: corners[k], b: corners[(k + 1) % 4] }));
        };
        block(0.0, 0.0, 0.6, 2.4); // kitchen counter
        block(2.0, 0.9, 3.1, 1.8); // kitchen table
        block(6.2, 0.0, 6.9, 1.6); // bath tub
        block(9.6, 0.0, 11.4, 2.0); // bed
        block(6.9, 2.6, 7.4, 3.9); // wardrobe
        block(0.4, 8.0, 2.8, 9.0); // sofa
        block(1.2, 6.5, 2.2, 7.1); // low table
        block(6.2, 8.2, 7.8, 9.0); // desk
        block(11.4, 7.4, 12.0, 9.0); // shelf
        block(8.3, 8.3, 9.1, 9.0); // armchair
        block(0.0, 5.0, 1.1, 5.4); // shoe rack
        block(7.3, 3.9, 8.0, 4.2); // chest of drawers
        Self { size: [12.0, 9.0], walls, furniture }
    }

    /// Our own building, 40 m × 24 m: rooms along the outer walls, a corridor round two inner halls, and one between them, so that
    /// there are three ways round.
    pub fn building() -> Self {
        let mut walls = Vec::new();
        // At `at` from one end to the other along x, or along y if `upright`, with a door at each of these places.
        let mut wall = |upright: bool, at: f64, from: f64, to: f64, doors: &[f64]| {
            const DOOR: f64 = 1.0;
            let place = |along: f64| if upright { [at, along] } else { [along, at] };
            let mut begin = from;
            for door in doors {
                walls.push(Segment { a: place(begin), b: place(*door) });
                begin = door + DOOR;
            }
            walls.push(Segment { a: place(begin), b: place(to) });
        };
        for (upright, at, end) in [(false, 0.0, 40.0), (false, 24.0, 40.0), (true, 0.0, 24.0), (true, 40.0, 24.0)] {
            wall(upright, at, 0.0, end, &[]);
        }
        // The rooms' side of the corridor, and between the rooms.
        wall(false, 5.0, 0.0, 40.0, &[2.0, 7.5, 11.6, 13.3, 18.0, 24.5, 30.0, 36.0]);
        wall(false, 19.0, 0.0, 40.0, &[1.5, 9.0, 14.0, 22.0, 25.6, 27.3, 32.0, 37.5]);
        wall(true, 5.0, 5.0, 19.0, &[8.0, 15.0]);
        wall(true, 35.0, 5.0, 19.0, &[6.5, 11.4, 12.7, 16.0]);
        for x in [5.5, 10.5, 16.0, 22.5, 28.0, 34.0] {
            wall(true, x, 0.0, 5.0, &[]);
        }
        for x in [7.0, 12.5, 19.5, 24.0, 30.5, 35.5] {
            wall(true, x, 19.0, 24.0, &[]);
        }
        for (y, west) in [(12.0, true), (9.5, false), (14.5, false)] {
            wall(false, y, if west { 0.0 } else { 35.0 }, if west { 5.0 } else { 40.0 }, &[]);
        }
        // The two halls inside.
        for (x0, x1, doors) in [(7.2, 19.0, [10.0, 15.5]), (21.0, 32.8, [23.0, 29.0])] {
            wall(false, 7.2, x0, x1, &doors[..1]);
            wall(false, 16.8, x0, x1, &doors[1..]);
            wall(true, x0, 7.2, 16.8, &[]);
            wall(true, x1, 7.2, 16.8, &[11.0]);
        }
        let mut furniture = Vec::new();
        let mut block = |x0: f64, y0: f64, dx: f64, dy: f64| {
            let corners = [[x0, y0], [x0 + dx, y0], [x0 + dx, y0 + dy], [x0, y0 + dy]];
            furniture.extend((0..4).map(|k| Segment { a: corners[k], b: corners[(k + 1) % 4] }));
        };
        for k in 0..7_u32 {
            let x = 0.6 + 5.6 * f64::from(k);
            block(x, 0.2, 1.4 + 0.1 * f64::from(k % 3), 0.7); // desks
            block(x + 0.9, 23.0, 1.1, 0.5 + 0.1 * f64::from(k % 4)); // shelves
        }
        for (x, y, dx, dy) in [
            (9.0, 9.5, 2.0, 1.0),
            (14.0, 12.5, 1.0, 2.2),
            (23.5, 11.0, 3.0, 0.9),
            (29.5, 13.0, 0.8, 1.6),
            (5.0, 6.9, 0.3, 0.9),
            (18.4, 5.0, 0.9, 0.25),
            (26.2, 6.95, 1.2, 0.25),
            (34.7, 8.4, 0.3, 1.1),
            (16.2, 18.7, 1.5, 0.3),
            (30.2, 16.8, 0.9, 0.25),
            (18.8, 9.0, 0.45, 0.6),
            (1.0, 6.0, 1.2, 1.2),
            (1.8, 16.5, 0.8, 1.6),
            (38.6, 6.5, 1.0, 2.0),
            (38.8, 17.0, 1.2, 1.2),
        ] {
            block(x, y, dx, dy);
        }
        Self { size: [40.0, 24.0], walls, furniture }
    }

    /// Our own rooms round a core, 12 m × 9 m: three rooms in the south, three in the north, one at each side, and a door from each to the
    /// next. The core has none.
    pub fn rooms() -> Self {
        const DOOR: f64 = 1.0;
        let mut walls = rectangle([0.0, 0.0], [12.0, 9.0]).to_vec();
        walls.extend(rectangle([3.3, 3.0], [8.7, 6.0]));
        let mut with_door = |upright: bool, at: f64, [from, to]: [f64; 2], door: f64| {
            let place = |along: f64| if upright { [at, along] } else { [along, at] };
            walls.push(Segment { a: place(from), b: place(door) });
            walls.push(Segment { a: place(door + DOOR), b: place(to) });
        };
        with_door(true, 4.0, [0.0, 3.0], 1.0);
        with_door(true, 8.0, [0.0, 3.0], 1.2);
        with_door(false, 3.0, [8.7, 12.0], 9.9);
        with_door(false, 6.0, [8.7, 12.0], 10.1);
        with_door(true, 8.0, [6.0, 9.0], 7.0);
        with_door(true, 4.0, [6.0, 9.0], 6.8);
        with_door(false, 6.0, [0.0, 3.3], 1.2);
        with_door(false, 3.0, [0.0, 3.3], 1.0);
        let furniture = [
            rectangle([0.0, 0.0], [1.2, 0.5]),   // counter
            rectangle([2.6, 2.4], [3.8, 3.0]),   // cupboard
            rectangle([4.6, 0.0], [6.2, 0.5]),   // shelf
            rectangle([6.6, 2.5], [7.4, 3.0]),   // stove
            rectangle([11.2, 0.0], [12.0, 1.0]), // wardrobe
            rectangle([11.4, 4.0], [12.0, 5.2]), // bath tub
            rectangle([8.4, 8.3], [9.8, 9.0]),   // sofa
            rectangle([11.4, 8.2], [12.0, 9.0]), // armchair
            rectangle([5.0, 8.4], [6.8, 9.0]),   // bed
            rectangle([4.2, 6.0], [5.0, 6.4]),   // chest of drawers
            rectangle([0.0, 8.2], [1.6, 9.0]),   // desk
            rectangle([0.0, 3.9], [0.6, 5.1]),   // shoe rack
        ];
        Self { size: [12.0, 9.0], walls, furniture: furniture.concat() }
    }

    /// Our own ring, 11 m × 8 m: a corridor 1.8 m wide round a block, which has up to two `niches` on each side: 0.5 m deep, and the only
    /// thing that tells one stretch of the corridor from the next. In the south-west corner, where the drive begins, a few
    /// pieces of furniture are there to be known again.
    ///
    /// ```text
    /// 8.0  +-----------------------------------------------+
    ///      |                                               |
    /// 6.2  |       +----+  4  +-----------+  8  +----+     |
    ///      |       |    +-----+           +-----+    |     |   1 2 3 4  niches if there is one a side
    ///      |       +--+                              |     |   5 6 7 8  the second ones
    ///      |        7 |                           +--+     |   a  block      (3.3, 1.45)–(3.7, 1.8)
    ///      |       +--+                           | 6      |   b  cupboard   (0.0, 0.0)–(0.7, 0.4)
    ///      |       +--+                           +--+     |   c  cupboard   (2.3, 0.0)–(3.2, 0.4)
    ///      |        3 |                           +--+     |   d  cupboard   (0.0, 1.6)–(0.35, 2.5)
    ///      |d      +--+ +-----+           +-----+ | 2      |   >  the start, looking east
    /// 1.8  |d      +----+  1  +-----------+  5  +-+--+     |
    ///      |           a                                   |
    ///      |b    >   c                                     |
    /// 0.0  +-----------------------------------------------+
    ///      0.0    1.8                              9.2   11.0
    /// ```
    pub fn ring(niches: usize) -> Self {
        const WIDTH: f64 = 0.9;
        const DEPTH: f64 = 0.5;
        let size = [11.0, 8.0];
        let (low, high) = ([1.8, 1.8], [9.2, 6.2]);
        let mut walls = rectangle([0.0, 0.0], size).to_vec();
        let mut side = |upright: bool, at: f64, back: f64, places: [f64; 2]| {
            let axis = usize::from(upright);
            let places = &places[..niches.min(2)];
            walls.extend(wall_with_niches(upright, [low[axis], high[axis]], [at, back], WIDTH, places));
        };
        side(false, low[1], low[1] + DEPTH, [4.6, 7.3]);
        side(true, high[0], high[0] - DEPTH, [2.7, 4.5]);
        side(false, high[1], high[1] - DEPTH, [3.4, 6.6]);
        side(true, low[0], low[0] + DEPTH, [3.0, 4.7]);
        let furniture = [
            rectangle([3.3, 1.45], [3.7, 1.8]),
            rectangle([0.0, 0.0], [0.7, 0.4]),
            rectangle([2.3, 0.0], [3.2, 0.4]),
            rectangle([0.0, 1.6], [0.35, 2.5]),
        ];
        Self { size, walls, furniture: furniture.concat() }
    }

    /// Our own long corridors, 62 m × 42 m: corridors 2.2 m wide all round two blocks and between them, of 40 m and 60 m. All that there
    /// is to see in them are closed doors, 1 m wide and set back by 0.2 m, every 7 to 12 m on each side.
    pub fn long_corridors() -> Self {
        const DOOR: f64 = 1.0;
        const DEEP: f64 = 0.2;
        let size = [62.0, 42.0];
        let mut walls = Vec::new();
        let mut side = |upright: bool, ends: [f64; 2], at: f64, back: f64, doors: &[f64]| {
            walls.extend(wall_with_niches(upright, ends, [at, back], DOOR, doors));
        };
        side(false, [0.2, 61.8], 0.2, 0.0, &[6.1, 14.7, 25.2, 33.8, 41.3, 52.6]);
        side(false, [0.2, 61.8], 41.8, 42.0, &[8.4, 17.2, 24.6, 36.1, 45.9, 54.3]);
        side(true, [0.2, 41.8], 0.2, 0.0, &[7.3, 16.9, 25.0, 34.4]);
        side(true, [0.2, 41.8], 61.8, 62.0, &[9.2, 18.0, 29.3, 37.1]);
        for (west, east, doors) in [
            (2.4, 29.9, [[8.8, 18.1, 26.3], [5.2, 14.0, 23.7], [6.0, 15.5, 27.1], [10.4, 19.3, 30.8]]),
            (32.1, 59.6, [[36.4, 47.3, 55.0], [39.7, 48.5, 56.8], [8.1, 19.9, 29.0], [12.6, 21.4, 33.0]]),
        ] {
            side(false, [west, east], 2.4, 2.4 + DEEP, &doors[0]);
            side(false, [west, east], 39.6, 39.6 - DEEP, &doors[1]);
            side(true, [2.4, 39.6], west, west + DEEP, &doors[2]);
            side(true, [2.4, 39.6], east, east - DEEP, &doors[3]);
        }
        Self { size, walls, furniture: Vec::new() }
    }

    /// The same place after a rigid motion of the plane.
    pub fn moved(&self, motion: &Pose2) -> Self {
        let moved = |segments: &[Segment]| -> Vec<Segment> {
            segments.iter().map(|s| Segment { a: motion.transform(s.a), b: motion.transform(s.b) }).collect()
        };
        let (walls, furniture) = (moved(&self.walls), moved(&self.furniture));
        let ends = walls.iter().chain(&furniture).flat_map(|s| [s.a, s.b]);
        let size = ends.fold([0.0, 0.0], |[x, y]: [f64; 2], end| [x.max(end[0]), y.max(end[1])]);
        Self { size, walls, furniture }
    }

    /// Distance \[m\] from (x, y) along the direction \[rad\] to the nearest wall or piece of furniture; infinite for none.
    pub fn raycast(&self, origin: [f64; 2], direction: f64) -> f64 {
        let (sin, cos) = ops::sin_cos(direction);
        let mut nearest = f64::INFINITY;
        for segment in self.walls.iter().chain(&self.furniture) {
            // origin + t d = a + s e, solved by cross products.
            let e = [segment.b[0] - segment.a[0], segment.b[1] - segment.a[1]];
            let w = [segment.a[0] - origin[0], segment.a[1] - origin[1]];
            let cross = cos * e[1] - sin * e[0];
            if cross == 0.0 {
                continue; // parallel: seen edge-on
            }
            let t = (w[0] * e[1] - w[1] * e[0]) / cross;
            let s = (w[0] * sin - w[1] * cos) / cross;
            if t > 0.0 && t < nearest && (0.0..=1.0).contains(&s) {
                nearest = t;
            }
        }
        nearest
    }

    /// Ranges \[m\] that the sensor reports at a true pose, with its noise; infinite where nothing is met within its range.
    pub fn ranges(&self, world_from_robot: &Pose2, sensor: &BeamSensor, stream: &mut Stream) -> Vec<f64> {
        let origin = [world_from_robot.x, world_from_robot.y];
        let mut noisy = |angle: &f64| {
            let noise = sensor.range_std * stream.normal(); // drawn for every beam: addresses stay aligned
            let range = self.raycast(origin, world_from_robot.theta + angle);
            if range < sensor.max_range { (range + noise).max(1e-3).min(sensor.max_range) } else { f64::INFINITY }
        };
        sensor.angles.iter().map(&mut noisy).collect()
    }
}

/// A wall between two `ends` along x, or along y if `upright`, with a niche of this width from each of these places on: the wall is at
/// `at`, the niches' backs are at `back` \[m\].
fn wall_with_niches(
    upright: bool,
    ends: [f64; 2],
    [at, back]: [f64; 2],
    width: f64,
    places: &[f64],
) -> impl Iterator<Item = Segment> {
    let mut corners = vec![[ends[0], at]];
    for place in places {
        corners.extend([[*place, at], [*place, back], [place + width, back], [place + width, at]]);
    }
    corners.push([ends[1], at]);
    let point = move |[along, across]: [f64; 2]| if upright { [across, along] } else { [along, across] };
    (1..corners.len()).map(move |k| Segment { a: point(corners[k - 1]), b: point(corners[k]) })
}

/// The four sides between two opposite corners \[m\].
fn rectangle([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> [Segment; 4] {
    let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    core::array::from_fn(|k| Segment { a: corners[k], b: corners[(k + 1) % 4] })
}

#[cfg(test)]
mod tests;
