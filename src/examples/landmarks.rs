//! FastSLAM 2.0 on a simulated drive: a robot circles among six trees, and maps them while it finds out where it is.
//!
//! `cargo run --release --example landmarks`

use fastslam::error::SettingError;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Correspondence, Gate, Landmarks};
use fastslam::motion::{Motion, Velocity, VelocityModel};
use fastslam::nalgebra::Vector2;
use fastslam::proposal::FromMeasurement;
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};

/// Where the trees stand \[m\]. The filter is not told.
const TREES: [(f64, f64); 6] = [(0.0, 5.0), (4.0, 2.0), (-4.0, 2.0), (6.0, 6.0), (-5.0, 7.0), (1.0, 10.0)];

fn main() -> Result<(), SettingError> {
    // The robot knows its speed to 10 cm/s and its turn rate to 0.04 rad/s; ranges to 10 cm, bearings to about one degree.
    let motion = VelocityModel { speed_std: 0.1, turn_rate_std: 0.04, alphas: [0.0; 4] };
    let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 8.0, field_of_view: 6.3 };

    // Trees look alike: every particle decides for itself which is which. One sighting in 20 000 is taken for a new tree by mistake.
    let gate = Gate { mahalanobis_squared: 20.0, ..Gate::default() };
    let map = <Landmarks<_>>::new(sensor, Correspondence::Unknown(gate));
    let mut filter = Rbpf::builder(map, FromMeasurement { motion }).particles(50).seed(1).build()?;

    // Two rounds of a circle of 4 m radius; noise of the world comes from streams of its own.
    let control = Velocity { speed: 1.0, turn_rate: 0.25, duration: 0.5 };
    let (mut truth, mut dead_reckoning) = (Pose2::default(), Pose2::default());
    for step in 1..=100 {
        let mut noise = Stream::at(3, Purpose::new(10), step, 0);
        truth = motion.sample(&truth, &control, &mut noise);
        dead_reckoning = motion.apply(&dead_reckoning, &control);
        let mut features = Vec::new();
        for (x, y) in TREES {
            let tree = Vector2::new(x, y);
            if sensor.sees(&truth, &tree, 0.0) {
                features.push(Feature { z: sensor.measure(&truth, &tree, &mut noise), signature: None });
            }
        }

        let report = filter.step(&control, &features);

        if step % 10 == 0 {
            let estimate = filter.estimate();
            println!(
                "step {step:3}: error {:.2} m, by dead reckoning {:.2} m, N_eff {:4.1} of 50",
                estimate.mean.distance(&truth),
                dead_reckoning.distance(&truth),
                report.ess,
            );
        }
    }

    let best = &filter.particles()[filter.best()];
    println!("{} trees in the best particle's map:", best.map.iter().count());
    for (index, tree) in best.map.iter() {
        println!("  {index}: ({:5.2}, {:5.2}) ± {:.2} m", tree.mean.x, tree.mean.y, tree.largest_std());
    }
    assert!(filter.estimate().mean.distance(&truth) < 0.5 * dead_reckoning.distance(&truth));
    Ok(())
}
