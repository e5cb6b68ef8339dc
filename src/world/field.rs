//! Fields of landmarks, and what is driven among them.

use crate::motion::Velocity;
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
    /// Two and a half times a figure of eight through twenty-four landmarks: every one of them is left and met again.
    pub fn figure_of_eight() -> Self {
        const RADIUS: f64 = 5.0;
        const STEP: f64 = 0.5;
        let circle = (core::f64::consts::TAU * RADIUS / STEP).round();
        let arc = |turn: f64| Velocity {
            speed: 1.0,
            turn_rate: turn * core::f64::consts::TAU / (circle * STEP),
            duration: STEP,
        };
        let loops = [1.0, -1.0, 1.0, -1.0, 1.0];
        let controls = loops.iter().flat_map(|turn| core::iter::repeat_n(arc(*turn), circle as usize)).collect();
        // A lattice of 4 × 6, shaken: landmarks neither in rows nor on top of each other.
        let landmarks = (0..24).map(|k| {
            let mut stream = Stream::at(17, Purpose::Trial, 0, k);
            let (row, column) = (f64::from(k / 6), f64::from(k % 6));
            let mut shaken = |at: f64, by: f64| at + by * (2.0 * stream.uniform() - 1.0);
            Vector2::new(shaken(3.2 * (row - 1.5), 0.9), shaken(4.2 * (column - 2.5), 1.2))
        });
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
            assert!(nearest.fold(f64::INFINITY, f64::min) > 0.3, "{pose:?}");
        }
        assert!(pose.minus(&Pose2::default()).norm() < 1e-9);
    }
}
