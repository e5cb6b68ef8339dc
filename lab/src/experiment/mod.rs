//! What the chapter's figures and numbers come from: a world, a filter, and a comparison with the truth.

pub mod camera;
pub mod car;
pub mod close_up;
pub mod conditioning;
pub mod doors;
pub mod em;
pub mod graph;
pub mod hill;
pub mod innovations;
pub mod joint_map;
pub mod landmarks;
pub mod lap;
pub mod log;
pub mod long_rings;
pub mod looking_back;
pub mod numbers;
pub mod policies;
pub mod policy_counts;
pub mod proposals;
pub mod ring;
pub mod smoothing;
mod summary;
pub mod table;
pub mod universes;
pub mod variants;
pub mod worked_example;

pub use summary::{ErrorSummary, median_interval, quantile};

use crate::digest::Digest;
use fastslam::error::SettingError;
use fastslam::execute::Executor;

/// The two proposals a reader chooses from.
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_proposal)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum ProposalKind {
    /// The improved proposal, which the chapter calls measurement-aware: [`FromScan`](fastslam::proposal::FromScan),
    /// [`FromMeasurement`](fastslam::proposal::FromMeasurement).
    #[strum(to_string = "aware", serialize = "improved")]
    #[cfg_attr(feature = "serde", serde(rename = "aware"))]
    Improved,
    /// The motion prior: [`FromMotion`](fastslam::proposal::FromMotion).
    Motion,
}

fn unknown_proposal(given: &str) -> SettingError {
    SettingError::unknown_word("proposal", given, <ProposalKind as strum::VariantNames>::VARIANTS)
}

/// Fingerprints of whole runs by name, which are kept with the tests and must be the same natively and in WebAssembly, with any
/// number of threads.
pub fn golden_traces(executor: &Executor) -> Vec<(&'static str, Digest)> {
    const VALID: &str = "a golden setup is valid";
    let laps = lap::golden_setups()
        .into_iter()
        .map(|(name, setup)| (name, lap::Lap::new(&setup).expect(VALID).with_executor(executor.clone()).trace()));
    let drives = landmarks::golden_runs().into_iter().map(|(name, course, setup)| {
        let run = landmarks::LandmarkRun::new(&setup, &course.tuning(), course.simulate(setup.seed).into());
        (name, run.expect(VALID).with_executor(executor.clone()).trace())
    });
    let joints = conditioning::golden_setups().into_iter();
    let joints = joints.map(|(name, setup)| (name, conditioning::Conditioning::new(&setup).expect(VALID).trace()));
    let clouds = proposals::golden_setups().into_iter();
    let clouds = clouds.map(|(name, setup)| (name, proposals::Proposals::new(&setup).expect(VALID).trace()));
    let maps = joint_map::golden_setups().into_iter();
    let maps = maps.map(|(name, setup)| {
        (name, joint_map::JointMap::new(&setup).and_then(joint_map::JointMap::trace).expect(VALID))
    });
    let policies = policies::golden_setups().into_iter().map(|(name, setup)| {
        (name, policies::Policies::new(&setup).expect(VALID).with_executor(executor.clone()).trace())
    });
    let smoothed = smoothing::golden_setups().into_iter().map(|(name, setup, sweeps)| {
        (name, smoothing::Smoothing::new(&setup).expect(VALID).with_executor(executor.clone()).trace(sweeps))
    });
    let logs = log::golden_runs().into_iter().map(|(name, run)| {
        let mut run = run.with_executor(executor.clone());
        run.by_ref().for_each(drop);
        (name, log::digest(run.mapper()))
    });
    let graphs = graph::golden_setups().into_iter();
    let graphs = graphs.map(|(name, setup, repair)| (name, graph::trace(&setup, repair).expect(VALID)));
    let em = core::iter::once(("em", em::golden().expect(VALID)));
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
