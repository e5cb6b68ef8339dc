//! What the chapter's figures and numbers come from: a world, a filter, and a comparison with the truth.

pub mod conditioning;
pub mod landmarks;
pub mod lap;
pub mod log;
pub mod log_files;
pub mod policies;
pub mod policy_counts;
pub mod proposals;
pub mod table;
pub mod worked_example;

use crate::digest::Digest;
use crate::execute::Executor;

/// Fingerprints of whole runs by name, which are kept with the tests and must be the same on every platform, with any number of
/// threads.
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
    laps.chain(drives).chain(joints).chain(clouds).chain(policies).collect()
}

/// The q-quantile of ascending values, interpolated linearly between neighbours (type 7 of Hyndman and Fan 1996).
pub fn quantile(ascending: &[f64], q: f64) -> f64 {
    let position = q * (ascending.len() - 1) as f64;
    let (low, share) = (position.floor() as usize, position - position.floor());
    let next = ascending[(low + 1).min(ascending.len() - 1)];
    if share == 0.0 || next == ascending[low] {
        ascending[low]
    } else {
        ascending[low] + share * (next - ascending[low])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_interpolate() {
        let values = [1.0, 2.0, 3.0, 5.0];
        assert_eq!([0.0, 0.5, 0.9, 1.0].map(|q| quantile(&values, q)), [1.0, 2.5, 3.0 + 2.0 * (0.9 * 3.0 - 2.0), 5.0]);
        assert_eq!(quantile(&[7.0], 0.9), 7.0);
    }
}
