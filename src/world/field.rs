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
