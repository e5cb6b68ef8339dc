//! Fields of landmarks, and what is driven among them.

use core::f64::consts::{PI, TAU};
use fastslam::motion::Velocity;
use fastslam::nalgebra::Vector2;
use fastslam::ops;
use fastslam::random::{Purpose, Stream};

/// Landmarks and the velocities truly driven among them, from the origin, looking along x.
#[derive(Clone, PartialEq, Debug)]
pub struct Field {
    /// \[m\]
    pub landmarks: Vec<Vector2<f64>>,
    /// One for each step.
    pub controls: Vec<Velocity>,
}

/// How far the robot drives into a wing, and out again \[steps of 1 m\].
const WINGS_DEPTH: usize = 14;

// Steps of turning about, and of spinning.
const WINGS_ABOUT: usize = 6;
const WINGS_SPINS: usize = 4;

/// The step of [`Field::two_wings`] that ends the spinning: the first at which the wings can be confused.
pub const WINGS_LOST: usize = 2 * 2 * WINGS_DEPTH + WINGS_ABOUT + WINGS_SPINS;

/// The landmark of [`Field::two_wings`] that is the sign of the first wing.
pub const WINGS_SIGN: u32 = 9;

impl Field {
    /// A look round at rest, then a figure of eight, two and a half times, among twenty-four landmarks: every one of them is left
    /// and met again. The rest anchors the gauge, as the first scans of the lap do: what is seen from the known start says
    /// later where that was.
    pub fn figure_of_eight() -> Self {
        const RADIUS: f64 = 5.0;
        const STEP: f64 = 0.5;
        const REST: usize = 20;
        let circle = (TAU * RADIUS / STEP).round();
        let arc = |turn: f64| Velocity { speed: 1.0, turn_rate: turn * TAU / (circle * STEP), duration: STEP };
        let loops = [1.0, -1.0, 1.0, -1.0, 1.0];
        let rest = Velocity { speed: 0.0, turn_rate: 0.0, duration: STEP };
        let driven = loops.iter().flat_map(|turn| core::iter::repeat_n(arc(*turn), circle as usize));
        let controls = core::iter::repeat_n(rest, REST).chain(driven).collect();
        Self { landmarks: Self::shaken(RADIUS), controls }
    }

    /// The same landmarks, and one figure of eight among them in strides of a metre: left around, then right around, and home.
    pub fn one_eight() -> Self {
        const RADIUS: f64 = 5.0;
        let circle = (TAU * RADIUS).round();
        let arc = |turn: f64| Velocity { speed: 1.0, turn_rate: turn * TAU / circle, duration: 1.0 };
        let controls = [1.0, -1.0].iter().flat_map(|turn| core::iter::repeat_n(arc(*turn), circle as usize));
        Self { landmarks: Self::shaken(RADIUS), controls: controls.collect() }
    }

    /// Twenty-four landmarks around the two circles of this radius \[m\] that are driven, and not in the robot's way.
    fn shaken(radius: f64) -> Vec<Vector2<f64>> {
        const CLEARANCE: f64 = 0.5;
        // A lattice of 4 × 6, shaken: landmarks neither in rows, nor on top of each other, nor in the robot's way.
        let clear =
            |m: &Vector2<f64>| [-radius, radius].iter().all(|y| (ops::hypot(m.x, m.y - y) - radius).abs() > CLEARANCE);
        let shaken = |k: u32| {
            let (x, y) = (3.2 * (f64::from(k / 6) - 1.5), 4.2 * (f64::from(k % 6) - 2.5));
            let shake = |attempt| {
                let mut stream = Stream::at(17, Purpose::TRIAL, attempt, k);
                let mut by = |most: f64| most * (2.0 * stream.uniform() - 1.0);
                Vector2::new(x + by(0.9), y + by(1.2))
            };
            (0..).map(shake).find(clear).expect("most of the field is clear")
        };
        (0..24).map(shaken).collect()
    }

    /// Two wings that look the same, at opposite sides of an empty hall, and a robot that loses its way in the hall.
    ///
    /// It maps the wing ahead and backs out, maps the wing behind and backs out, and then spins in the hall, where nothing is in
    /// sight, until its odometry cannot tell where it looks. It drives into the first wing once more, and up and down there:
    /// every pillar is where it would be in the other wing too. Only at the end comes the sign, which hangs left in the first
    /// wing and right in the second.
    ///
    /// Why opposite: to be lost is then a matter of the heading alone. A bearing is linear in it, so that every particle locks
    /// on to the nearer explanation, whatever its error; and half of them are nearer to either, whatever the seed.
    pub fn two_wings() -> Self {
        // In the frame of a wing: x outwards from the hall's centre. To be seen ahead from there, not from the side.
        const PILLARS: [[f64; 2]; WINGS_SIGN as usize] = [
            [3.4, -1.3],
            [4.6, 1.5],
            [5.5, -1.9],
            [8.0, 2.0],
            [5.4, 4.4],
            [7.2, 6.3],
            [11.2, 5.2],
            [11.9, 1.4],
            [9.8, -2.2],
        ];
        // In sight from 12.5 m on and beyond, with a range of 6 m: from the last steps only.
        const SIGN: [f64; 2] = [18.0, 2.0];
        let landmarks = [1.0, -1.0].into_iter().flat_map(|side| {
            let at = move |[x, y]: [f64; 2]| Vector2::new(side * x, side * y);
            PILLARS.into_iter().map(at).chain([at([SIGN[0], side * SIGN[1]])])
        });
        let go = |metres: i32| {
            let step = Velocity { speed: f64::from(metres.signum()), turn_rate: 0.0, duration: 1.0 };
            core::iter::repeat_n(step, metres.unsigned_abs() as usize)
        };
        let turn = |angle: f64, steps: usize| {
            let step = Velocity { speed: 0.0, turn_rate: angle, duration: 1.0 };
            core::iter::repeat_n(step, steps)
        };
        let depth = WINGS_DEPTH as i32;
        let map = || go(depth).chain(go(-depth));
        // Twenty turns each, and so much more that all looks but the last go across, where nothing is.
        let spins: [f64; WINGS_SPINS] = [20.25, 20.5, 20.5, 20.25];
        let controls = map()
            .chain(turn(PI / WINGS_ABOUT as f64, WINGS_ABOUT))
            .chain(map())
            .chain(spins.into_iter().flat_map(|turns| turn(TAU * turns, 1)))
            .chain(go(8))
            .chain([-4, 4, -4, 4, -4, 4].into_iter().flat_map(go))
            .chain(go(depth - 8));
        Self { landmarks: landmarks.collect(), controls: controls.collect() }
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
    use fastslam::geometry::Pose2;

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

    /// What the course of the wings rests on: before the sign, each sighting of the last drive would be the same in the other
    /// wing; while the robot spins it sees nothing.
    #[test]
    fn the_two_wings_look_the_same_up_to_the_sign() {
        let field = Field::two_wings();
        let (first, second) = field.landmarks.split_at(WINGS_SIGN as usize + 1);
        for (k, (a, b)) in first.iter().zip(second).enumerate() {
            assert_eq!(*a == -b, k != WINGS_SIGN as usize, "pillar {k}");
        }
        let mut pose = Pose2::default();
        let mut path = vec![pose];
        for control in &field.controls {
            pose = control.apply(&pose);
            path.push(pose);
        }
        assert!(path[WINGS_LOST].minus(&Pose2::default()).norm() < 1e-9, "in the hall, looking at the first wing");
        for spin in &path[WINGS_LOST - WINGS_SPINS + 1..WINGS_LOST] {
            assert!((spin.theta.abs() - PI / 2.0).abs() < 1e-9, "{spin:?}");
        }
    }
}
