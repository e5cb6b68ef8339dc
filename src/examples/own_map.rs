//! A map of one's own, with its score: floor colours. The robot sees only the tile under it, and knows it has been here before.
//!
//! `cargo run --release --example own_map`

use fastslam::error::SettingError;
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::matching::Likelihood;
use fastslam::motion::{Motion, Odometry, OdometryModel};
use fastslam::ops;
use fastslam::proposal::FromMotion;
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use std::collections::BTreeMap;
use std::sync::Arc;

/// How often each tile of 25 cm was seen dark, and how often light. Clones share it until they write: a resampling clones all maps.
#[derive(Clone, Default)]
struct Floor(Arc<BTreeMap<[i32; 2], [f64; 2]>>);

/// What the sensor under the robot says of four spots, 20 cm ahead, left, behind and right: dark or light.
type Spots = [bool; 4];
const SPOTS: [[f64; 2]; 4] = [[0.2, 0.0], [0.0, 0.2], [-0.2, 0.0], [0.0, -0.2]];

fn tile(robot: &Pose2, spot: [f64; 2]) -> [i32; 2] {
    robot.transform(spot).map(|metres| (4.0 * metres).floor() as i32)
}

impl ConditionalMap for Floor {
    type Observation = Spots;
    type Association = (); // the place alone decides what is seen

    fn assimilate(&mut self, robot: &Pose2, spots: &Spots, (): &()) {
        let tiles = Arc::make_mut(&mut self.0);
        for (spot, light) in SPOTS.into_iter().zip(spots) {
            tiles.entry(tile(robot, spot)).or_default()[usize::from(*light)] += 1.0;
        }
    }
}

/// ln p(z | x, m) = Σ ln (n + 1) / (n_dark + n_light + 2), n of the colour that is seen: Laplace's rule of succession.
struct Colours;

impl Likelihood<Floor> for Colours {
    fn log_likelihood(&self, map: &Floor, robot: &Pose2, spots: &Spots) -> (f64, ()) {
        let log_p = |(spot, light): ([f64; 2], &bool)| {
            let seen = map.0.get(&tile(robot, spot)).copied().unwrap_or_default();
            ops::ln((seen[usize::from(*light)] + 1.0) / (seen[0] + seen[1] + 2.0))
        };
        (SPOTS.into_iter().zip(spots).map(log_p).sum(), ())
    }
}

fn main() -> Result<(), SettingError> {
    // In a test, `fastslam::map_laws!` checks that clones never see each other's writes: see `fastslam::laws`.
    let motion = OdometryModel { alphas: [2e-4, 5e-4, 1e-3, 1e-4] };
    let proposal = FromMotion { motion, likelihood: Colours };
    let mut filter = Rbpf::builder(Floor::default(), proposal).particles(500).seed(1).build()?;

    // The floor is dark or light by lot. The robot drives a circle of 1 m radius over it, eight times.
    let light = |[i, j]: [i32; 2]| Stream::at(7, Purpose::new(11), i as u32, j as u32).uniform() < 0.5;
    let control = Odometry { rot1: 0.05, trans: 0.1, rot2: 0.05 };
    let (mut truth, mut dead_reckoning, mut worst) = (Pose2::default(), Pose2::default(), [0.0_f64; 2]);
    for step in 1..=500 {
        truth = motion.sample(&truth, &control, &mut Stream::at(1, Purpose::new(10), step, 0));
        dead_reckoning = motion.apply(&dead_reckoning, &control);
        filter.step(&control, &SPOTS.map(|spot| light(tile(&truth, spot))));
        for (worst, pose) in worst.iter_mut().zip([filter.estimate().mean, dead_reckoning]) {
            *worst = worst.max(pose.distance(&truth));
        }
    }
    println!("largest error in eight rounds: {:.2} m, by dead reckoning {:.2} m", worst[0], worst[1]);
    assert!(worst[0] < 0.5 * worst[1]);
    Ok(())
}
