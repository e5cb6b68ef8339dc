//! Fields of landmarks, and what is driven among them.

use crate::motion::Velocity;
use crate::ops;
use crate::random::{Purpose, Stream};
use nalgebra::Vector2;

/// Landmarks and the velocities truly driven among them, from the origin, looking along x.
#[derive(Clone, PartialEq, Debug)]
pub struct Field {
    /// \[m\]
    pub landmarks: Vec<Vector2<f64>>,
    /// One for each step.
    pub controls: Vec<Velocity>,
}

/// Rounds of the court in [`Field::two_wings`].
const WINGS_ROUNDS: usize = 6;

/// The step of [`Field::two_wings`] after which the robot has spun: the first at which the wings can be confused.
pub const WINGS_LOST: u32 = 28 + 6 + 28 + 4;

/// The landmark of [`Field::two_wings`] that is the sign of the first wing.
pub const WINGS_SIGN: u32 = 8;

impl Field {
    /// A look round at rest, then a figure of eight, two and a half times, among twenty-four landmarks: every one of them is left
    /// and met again. The rest anchors the gauge, as the first scans of the lap do: what is seen from the known start says
    /// later where that was.
    pub fn figure_of_eight() -> Self {
        const RADIUS: f64 = 5.0;
        const STEP: f64 = 0.5;
        const CLEARANCE: f64 = 0.5;
        const REST: usize = 20;
        let circle = (core::f64::consts::TAU * RADIUS / STEP).round();
        let arc = |turn: f64| Velocity {
            speed: 1.0,
            turn_rate: turn * core::f64::consts::TAU / (circle * STEP),
            duration: STEP,
        };
        let loops = [1.0, -1.0, 1.0, -1.0, 1.0];
        let rest = Velocity { speed: 0.0, turn_rate: 0.0, duration: STEP };
        let driven = loops.iter().flat_map(|turn| core::iter::repeat_n(arc(*turn), circle as usize));
        let controls = core::iter::repeat_n(rest, REST).chain(driven).collect();
        // A lattice of 4 × 6, shaken: landmarks neither in rows, nor on top of each other, nor in the robot's way.
        let clear =
            |m: &Vector2<f64>| [-RADIUS, RADIUS].iter().all(|y| (ops::hypot(m.x, m.y - y) - RADIUS).abs() > CLEARANCE);
        let shaken = |k: u32| {
            let (x, y) = (3.2 * (f64::from(k / 6) - 1.5), 4.2 * (f64::from(k % 6) - 2.5));
            let shake = |attempt| {
                let mut stream = Stream::at(17, Purpose::Trial, attempt, k);
                let mut by = |most: f64| most * (2.0 * stream.uniform() - 1.0);
                Vector2::new(x + by(0.9), y + by(1.2))
            };
            (0..).map(shake).find(clear).expect("most of the field is clear")
        };
        let landmarks = (0..24).map(shaken);
        Self { landmarks: landmarks.collect(), controls }
    }

    /// Two wings that look the same, at opposite sides of a round hall, and a robot that loses its way in the hall.
    ///
    /// It maps the wing ahead, then the one behind, backs out into the hall each time, spins there until it no longer knows
    /// which way it looks, and drives into the first wing once more. It stays there for some rounds of the court, where every
    /// pillar is where it would be in the other wing, and only then goes on to the sign at the end, which hangs left in one wing
    /// and right in the other.
    ///
    /// The wings are opposite so that being lost is a matter of the heading alone, in which a bearing is linear: every universe
    /// locks on to the nearer explanation, and half of them, whatever the seed, on to either.
    pub fn two_wings() -> Self {
        use core::f64::consts::PI;
        // In the frame of a wing, x from the hall's centre outwards. Out of reach from the centre for who looks across.
        const PILLARS: [[f64; 2]; 8] = [
            [4.8, 1.6],
            [5.5, -1.9],
            [8.0, 2.0], // in the middle of the court
            [5.0, 3.9],
            [7.2, 6.3],
            [11.2, 5.2],
            [11.9, 1.4],
            [9.8, -2.2],
        ];
        const SIGN: [f64; 2] = [18.0, 2.0];
        let [ahead, behind] = [1.0, -1.0].map(|side| {
            let at = move |[x, y]: [f64; 2]| Vector2::new(side * x, side * y);
            let sign = at([SIGN[0], side * SIGN[1]]);
            PILLARS.into_iter().map(at).chain([sign])
        });
        let drive = |metres: f64| {
            core::iter::repeat_n(
                Velocity { speed: metres.signum(), turn_rate: 0.0, duration: 1.0 },
                metres.abs() as usize,
            )
        };
        let look_behind = core::iter::repeat_n(Velocity { speed: 0.0, turn_rate: PI / 6.0, duration: 1.0 }, 6);
        // A turn and a quarter or a half each: every look but the last goes across, where nothing is to be seen.
        let spins = [1.25, 1.5, 1.5, 1.25].map(|turns| Velocity {
            speed: 0.0,
            turn_rate: 0.5,
            duration: 2.0 * PI * turns / 0.5,
        });
        let round = core::iter::repeat_n(Velocity { speed: PI / 3.0, turn_rate: PI / 6.0, duration: 1.0 }, 12);
        let map = || drive(14.0).chain(drive(-14.0));
        let controls = map().chain(look_behind).chain(map()).chain(spins).chain(drive(8.0));
        let rounds = core::iter::repeat_n(round, WINGS_ROUNDS).flatten();
        Self { landmarks: ahead.chain(behind).collect(), controls: controls.chain(rounds).chain(drive(6.0)).collect() }
    }

    /// The eight landmarks and the drive that the FastSLAM examples of PythonRobotics simulate: three seconds at rest, then a circle at
    /// 1 m/s and 0.1 rad/s, fifty seconds in steps of 0.1 s.
    pub fn eight_tags() -> Self {
        const TAGS: [[f64; 2]; 8] = [
            [10.0, -2.0],
            [15.0, 10.0],
            [15.0, 15.0],
            [10.0, 20.0],
            [3.0, 15.0],
            [-5.0, 20.0],
            [-5.0, 5.0],
            [-10.0, 15.0],
        ];
        let control = |step: u32| {
            let (speed, turn_rate) = if step < 30 { (0.0, 0.0) } else { (1.0, 0.1) };
            Velocity { speed, turn_rate, duration: 0.1 }
        };
        Self { landmarks: TAGS.map(Vector2::from).to_vec(), controls: (0..500).map(control).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;

    #[test]
    fn the_figure_of_eight_is_closed_and_keeps_its_distance_from_landmarks() {
        let field = Field::figure_of_eight();
        let mut pose = Pose2::default();
        for control in &field.controls {
            pose = control.apply(&pose);
            let nearest = field.landmarks.iter().map(|m| pose.distance(&Pose2::new(m.x, m.y, 0.0)));
            assert!(nearest.fold(f64::INFINITY, f64::min) > 0.45, "{pose:?}");
        }
        assert!(pose.minus(&Pose2::default()).norm() < 1e-9);
    }
}
