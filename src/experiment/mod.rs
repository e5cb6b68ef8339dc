//! What the chapter's figures and numbers come from: a world, a filter, and a comparison with the truth.

pub mod conditioning;
pub mod doors;
pub mod hill;
pub mod landmarks;
pub mod lap;
pub mod log;
pub mod log_files;
pub mod numbers;
pub mod policies;
pub mod policy_counts;
pub mod proposals;
pub mod ring;
mod spread;
pub mod table;
pub mod variants;
pub mod worked_example;

pub use spread::{Spread, median_interval, quantile};

use crate::digest::Digest;
use crate::execute::Executor;

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
    let policies = policies::golden_setups().into_iter().map(|(name, setup)| {
        (name, policies::Policies::new(&setup).expect(VALID).with_executor(executor.clone()).trace())
    });
    let logs = log::golden_runs().into_iter().map(|(name, run)| {
        let mut run = run.with_executor(executor.clone());
        while run.step().is_some() {}
        (name, run.digest())
    });
    laps.chain(drives).chain(joints).chain(clouds).chain(policies).chain(logs).collect()
}
