//! What many paths say together.

use crate::genealogy::Path;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::order::sorted;
use crate::proposal::Proposal;
use crate::random::Stream;
use crate::rbpf::{self, Rbpf};
use crate::resampling::Scheme;
use nalgebra::Matrix3;

/// So many paths traced back through the ancestry of a filter's present particles, drawn by their weights: a filter's own account of
/// the past. Takes one `u64` a path.
pub fn traced<M: ConditionalMap, P: Proposal<M>>(filter: &Rbpf<M, P>, paths: usize, stream: &mut Stream) -> Vec<Path> {
    let slots = Scheme::Multinomial.ancestors(filter.weights(), paths, stream);
    slots.into_iter().map(|slot| filter.particles()[slot as usize].path.clone()).collect()
}

/// How many different poses the paths, all of one length, have at each step.
pub fn distinct<P: AsRef<[Pose2]>>(paths: &[P]) -> Vec<u32> {
    at_each_step(paths)
        .map(|poses| {
            let bits = poses.map(|p| [p.x, p.y, p.theta].map(f64::to_bits)).collect();
            let mut bits: Vec<[u64; 3]> = sorted(bits, Ord::cmp);
            bits.dedup();
            bits.len() as u32
        })
        .collect()
}

/// Mean and covariance (3 × 3, \[m, m, rad\]) of the paths' poses at each step, all of one weight, as in
/// [`Estimate`](crate::rbpf::Estimate).
pub fn moments<P: AsRef<[Pose2]>>(paths: &[P]) -> Vec<(Pose2, Matrix3<f64>)> {
    weighted_moments(paths, &vec![1.0 / paths.len() as f64; paths.len()])
}

/// The same of paths with weights that sum to one, as those of a filter's particles are.
pub fn weighted_moments<P: AsRef<[Pose2]>>(paths: &[P], weights: &[f64]) -> Vec<(Pose2, Matrix3<f64>)> {
    at_each_step(paths).map(|poses| rbpf::moments(|| poses.clone().zip(weights.iter().copied()))).collect()
}

/// The poses of all paths, step by step.
fn at_each_step<P: AsRef<[Pose2]>>(paths: &[P]) -> impl Iterator<Item = impl Iterator<Item = Pose2> + Clone> {
    let steps = paths.iter().map(|path| path.as_ref().len()).min().unwrap_or(0);
    (0..steps).map(move |step| paths.iter().map(move |path| path.as_ref()[step]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_counted_and_averaged_step_by_step() {
        let path = |xs: [f64; 3]| xs.map(|x| Pose2::new(x, 0.0, 0.0));
        let paths = [path([0.0, 1.0, 2.0]), path([0.0, 1.0, 4.0]), path([0.0, 2.5, 6.0])];
        assert_eq!(distinct(&paths), [1, 2, 3]);
        let found = moments(&paths);
        assert_eq!((found[0].0.x, found[1].0.x, found[2].0.x), (0.0, 1.5, 4.0));
        assert!((found[1].1.m11 - 0.5).abs() < 1e-15 && (found[2].1.m11 - 8.0 / 3.0).abs() < 1e-15);
        assert!(distinct::<Vec<Pose2>>(&[]).is_empty());
    }
}
