//! Fingerprints of whole runs of every experiment, which are kept with the tests and must be the same natively and in WebAssembly, with
//! any number of threads.

use super::conditioning::{Conditioning, ConditioningSetup};
use super::graph::GraphSetup;
use super::joint::{Joint, JointSetup};
use super::landmarks::{CorrespondenceKind, Course, LandmarkRun, LandmarkSetup};
use super::lap::{self, Lap, LapSetup};
use super::log::{self, Example, Recipe};
use super::long_rings::LongRingSetup;
use super::proposal::{Proposals, ProposalsSetup};
use super::resampling::{Policies, PoliciesSetup, PolicyCourse};
use super::smoothing::{Smoothing, SmoothingSetup};
use super::{ProposalKind, em, graph};
use crate::baseline::pose_graph::Repair;
use crate::digest::Digest;
use core::f64::consts::PI;
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::mapper::{LaserMapperSettings, Replay};
use fastslam::matching::Matcher;
use fastslam::resampling::{ResamplePolicy, Scheme};
use fastslam_log::LaserLog;
use std::sync::Arc;

/// Fingerprints of whole runs by name, which are kept with the tests and must be the same natively and in WebAssembly, with any
/// number of threads.
pub fn traces(executor: &Executor) -> Vec<(&'static str, Digest)> {
    const VALID: &str = "a golden setup is valid";
    let laps = laps()
        .into_iter()
        .map(|(name, setup)| (name, Lap::new(&setup).expect(VALID).with_executor(executor.clone()).trace()));
    let drives = drives().into_iter().map(|(name, course, setup)| {
        let run = LandmarkRun::new(&setup, &course.tuning(), course.simulate(setup.seed).into());
        (name, run.expect(VALID).with_executor(executor.clone()).trace())
    });
    let joints = conditionings().into_iter();
    let joints = joints.map(|(name, setup)| (name, Conditioning::new(&setup).expect(VALID).trace()));
    let clouds = clouds().into_iter();
    let clouds = clouds.map(|(name, setup)| (name, Proposals::new(&setup).expect(VALID).trace()));
    let maps = joint_maps().into_iter();
    let maps = maps.map(|(name, setup)| (name, Joint::new(&setup).and_then(Joint::trace).expect(VALID)));
    let policies = policies()
        .into_iter()
        .map(|(name, setup)| (name, Policies::new(&setup).expect(VALID).with_executor(executor.clone()).trace()));
    let smoothed = smoothings().into_iter().map(|(name, setup, sweeps)| {
        (name, Smoothing::new(&setup).expect(VALID).with_executor(executor.clone()).trace(sweeps))
    });
    let logs = logs().into_iter().map(|(name, run)| {
        let mut run = run.with_executor(executor.clone());
        run.by_ref().for_each(drop);
        (name, log::digest(run.mapper()))
    });
    let graphs = graphs().into_iter();
    let graphs = graphs.map(|(name, setup, repair)| (name, graph::trace(&setup, repair).expect(VALID)));
    let em = core::iter::once(("em", em::trace().expect(VALID)));
    laps.chain(drives)
        .chain(joints)
        .chain(clouds)
        .chain(maps)
        .chain(policies)
        .chain(smoothed)
        .chain(logs)
        .chain(em)
        .chain(graphs)
        .collect()
}

/// Of laps; the first is the default.
pub fn laps() -> Vec<(&'static str, LapSetup)> {
    let setup = LapSetup::default;
    vec![
        ("default", setup()),
        ("motion", LapSetup { proposal: ProposalKind::Motion, ..setup() }),
        ("cell", LapSetup { matcher: Matcher::Cell, ..setup() }),
        ("motion-cell", LapSetup { proposal: ProposalKind::Motion, matcher: Matcher::Cell, particles: 40, ..setup() }),
        ("never", LapSetup { policy: ResamplePolicy::Never, seed: 7, ..setup() }),
        ("always-residual", LapSetup { policy: ResamplePolicy::Always, scheme: Scheme::Residual, ..setup() }),
        ("stratified", LapSetup { scheme: Scheme::Stratified, seed: 11, particles: 24, ..setup() }),
        ("multinomial", LapSetup { scheme: Scheme::Multinomial, seed: 12, particles: 8, ..setup() }),
        ("one", LapSetup { particles: 1, ..setup() }),
        ("quiet", LapSetup { odometry_scale: 0.0, range_std: 0.0, particles: 4, ..setup() }),
        ("ring", LapSetup { course: lap::Course::Ring, ..setup() }),
    ]
}

fn drives() -> Vec<(&'static str, Course, LandmarkSetup)> {
    let setup = || LandmarkSetup { particles: 12, ..LandmarkSetup::default() };
    let motion = || LandmarkSetup { proposal: ProposalKind::Motion, ..setup() };
    let unknown = |setup| LandmarkSetup { correspondence: CorrespondenceKind::Unknown, ..setup };
    vec![
        ("eight-2.0", Course::Eight, setup()),
        ("eight-1.0", Course::Eight, motion()),
        ("eight-2.0-unknown", Course::Eight, unknown(setup())),
        ("eight-1.0-unknown", Course::Eight, unknown(motion())),
        ("tags-2.0", Course::Tags, setup()),
        ("tags-1.0-unknown", Course::Tags, unknown(motion())),
    ]
}

fn conditionings() -> Vec<(&'static str, ConditioningSetup)> {
    let default = ConditioningSetup::default();
    vec![
        ("conditioning", default.clone()),
        (
            "conditioning-large",
            ConditioningSetup { landmarks: 24, poses: 12, odometry_scale: 2.0, range_std: 0.02, ..default },
        ),
        ("conditioning-pairs", ConditioningSetup { pairs: true, ..default }),
        ("conditioning-sure", ConditioningSetup { odometry_scale: 0.0, ..default }),
    ]
}

/// Of one step.
pub(super) fn clouds() -> Vec<(&'static str, ProposalsSetup)> {
    let setup = ProposalsSetup::default;
    vec![
        ("proposals", setup()),
        ("proposals-twins", ProposalsSetup { twins: true, ..setup() }),
        ("proposals-sharp", ProposalsSetup { range_std: 0.005, bearing_std: 0.01, seed: 11, ..setup() }),
        ("proposals-loose", ProposalsSetup { odometry_scale: 2.0, range_std: 0.5, landmark: [0.4, 0.9], ..setup() }),
    ]
}

fn joint_maps() -> Vec<(&'static str, JointSetup)> {
    let setup = JointSetup::default;
    vec![
        ("joint", JointSetup { particles: 300, ..setup() }),
        ("joint-blocks", JointSetup { particles: 1500, sensor_scale: 0.5, odometry_scale: 2.0, seed: 9 }),
    ]
}

fn policies() -> Vec<(&'static str, PoliciesSetup)> {
    let wings = || PoliciesSetup::of(PolicyCourse::Wings);
    vec![
        ("policies-lap", PoliciesSetup::default()),
        ("policies-wings", wings()),
        ("policies-wings-systematic", PoliciesSetup { scheme: Scheme::Systematic, particles: 40, seed: 5, ..wings() }),
    ]
}

fn smoothings() -> Vec<(&'static str, SmoothingSetup, u32)> {
    vec![("smoothing", SmoothingSetup { particles: 6, ..SmoothingSetup::default() }, 3)]
}

/// Of logs; the last has its path bent.
pub(super) fn logs() -> Vec<(&'static str, Replay<LaserLog>)> {
    let run = |settings: LaserMapperSettings, recipe: Recipe| {
        let log = Arc::new(Example::of(&recipe, 40).log);
        Replay::new(settings, log).expect("a golden setting is valid")
    };
    let (building, hung) = (Recipe::building(), Recipe { upside_down: true, ..Recipe::building() });
    let hung = Recipe { robot_from_laser: Pose2::new(0.6, 0.4, 0.5 * PI), ..hung };
    let settings = LaserMapperSettings::default();
    vec![
        ("log", run(LaserMapperSettings { particles: 5, ..settings }, building)),
        (
            "log-sparse",
            run(
                LaserMapperSettings { particles: 3, min_travel: 0.8, cell_size: 0.1, max_range: 6.0, ..settings },
                hung,
            ),
        ),
        ("log-bent", LongRingSetup { particles: 2, ..LongRingSetup::default() }.start().expect("a ring").into_replay()),
    ]
}

fn graphs() -> Vec<(&'static str, LapSetup, Repair)> {
    vec![
        ("graph", GraphSetup::opening().lap, Repair::LeastSquares),
        ("graph-switchable", LapSetup::default(), Repair::SWITCHABLE),
    ]
}
