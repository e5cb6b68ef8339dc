//! A sensor of one's own: a camera that looks at the ceiling and measures how far ahead and how far to the left a lamp is.
//!
//! `cargo run --release --example own_sensor`

use fastslam::error::SettingError;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Correspondence, Landmarks};
use fastslam::motion::{Motion, Odometry, OdometryModel};
use fastslam::nalgebra::{Matrix2, Matrix2x3, Vector2};
use fastslam::ops;
use fastslam::proposal::FromMeasurement;
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::sensor::{Feature, LandmarkSensor, Prediction};

/// z = Rᵀ (m − (x, y)), R the rotation by the robot's heading: metres ahead and to the left.
#[derive(Clone, Copy)]
struct CeilingCamera {
    /// Standard deviation of both \[m\].
    std: f64,
}

impl LandmarkSensor for CeilingCamera {
    fn predict(&self, robot: &Pose2, lamp: &Vector2<f64>) -> Prediction {
        let (sin, cos) = ops::sin_cos(robot.theta);
        let (dx, dy) = (lamp.x - robot.x, lamp.y - robot.y);
        let z = Vector2::new(cos * dx + sin * dy, -sin * dx + cos * dy);
        let h_m = Matrix2::new(cos, sin, -sin, cos);
        // A turn to the left moves the lamp to the right, and one that is at the left ahead.
        Prediction { z, h_x: Matrix2x3::new(-cos, -sin, z.y, sin, -cos, -z.x), h_m }
    }

    fn residual(&self, z: &Vector2<f64>, predicted: &Vector2<f64>) -> Vector2<f64> {
        z - predicted // no angles, nothing to wrap
    }

    fn locate(&self, robot: &Pose2, z: &Vector2<f64>) -> Vector2<f64> {
        Vector2::from(robot.transform([z.x, z.y]))
    }

    fn noise(&self) -> Matrix2<f64> {
        Matrix2::identity() * (self.std * self.std)
    }

    fn sees(&self, robot: &Pose2, lamp: &Vector2<f64>, margin: f64) -> bool {
        (lamp - Vector2::new(robot.x, robot.y)).norm() + margin <= 3.0
    }
}

fn main() -> Result<(), SettingError> {
    // In a test, `fastslam::sensor_laws!` checks derivatives and inverse: see `fastslam::laws`.
    let camera = CeilingCamera { std: 0.05 };
    let motion = OdometryModel { alphas: [0.02, 0.005, 0.02, 0.005] };
    let map = <Landmarks<_>>::new(camera, Correspondence::Known);
    let mut filter = Rbpf::builder(map, FromMeasurement { motion }).particles(30).seed(1).build()?;

    // Lamps on a raster of 2 m; their numbers are painted on them. The robot drives a circle of 3 m radius, twice.
    let lamps: Vec<Vector2<f64>> =
        (0..25).map(|k| Vector2::new(f64::from(k % 5) * 2.0 - 4.0, f64::from(k / 5) * 2.0 - 1.0)).collect();
    let control = Odometry { rot1: 0.05, trans: 0.3, rot2: 0.05 };
    let (mut truth, mut dead_reckoning) = (Pose2::default(), Pose2::default());
    for step in 1..=126 {
        let mut noise = Stream::at(1, Purpose::new(10), step, 0);
        truth = motion.sample(&truth, &control, &mut noise);
        dead_reckoning = motion.apply(&dead_reckoning, &control);
        let seen = (0..).zip(&lamps).filter(|(_, lamp)| camera.sees(&truth, lamp, 0.0));
        let look = |(number, lamp)| {
            let error = Vector2::from(noise.normals::<2>()) * camera.std;
            Feature { z: camera.predict(&truth, lamp).z + error, signature: Some(number) }
        };
        filter.step(&control, &seen.map(look).collect::<Vec<_>>());
    }
    let errors = [filter.estimate().mean, dead_reckoning].map(|pose| pose.distance(&truth));
    println!("error after two rounds: {:.2} m, by dead reckoning {:.2} m", errors[0], errors[1]);
    assert!(errors[0] < 0.5 * errors[1]);
    Ok(())
}
