//! The policies of resampling over many seeds: what each keeps, loses and costs.
//!
//! [`outcomes`] is a pure function of the setting and the seeds: a range can be run in pieces, anywhere, and the pieces put
//! together in the order of their seeds.

use super::{POLICIES, Policies, PoliciesSetup, PolicyReport, RIGHT_WITHIN};
use crate::experiment::{Fraction, quantile};
use core::ops::Range;
use fastslam::error::SettingError;
use fastslam::execute::Executor;
use fastslam::ops;

/// What is kept of one filter's run.
#[derive(Clone, PartialEq, Debug)]
pub struct PolicyOutcome {
    /// N_eff at the end, before resampling.
    pub final_ess: f64,
    /// Root mean square error of position of the best particle's path \[m\].
    pub rms_best: f64,
    /// Share of the steps that resampled.
    pub resampled_fraction: f64,
    /// First step at which all particles descend from one, if any did.
    pub lineage_one_step: Option<u32>,
    /// N_eff at that step, before resampling.
    pub ess_at_lineage_one: Option<f64>,
    /// Mean N_eff up to that step, or over the whole run.
    pub ess_meanwhile: f64,
    /// Nodes of the ancestry tree at the end.
    pub tree_nodes: u32,
    /// Mean of the tree's nodes beyond one path of t + 1, over the second half of the run.
    pub tree_crown: f64,
    /// On the wings' course: whether the right explanation was alive, and whether it won.
    pub kept: Option<Kept>,
}

/// Whether a filter kept the right wing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Kept {
    /// At the step before the sign comes in sight, some particle is within [`RIGHT_WITHIN`] of the truth, looking its way.
    pub alive: bool,
    /// At the end the best particle is within [`RIGHT_WITHIN`] of the truth.
    pub settled: bool,
}

/// Runs the three filters for each of these seeds; the seed of the setting is not used. In the order of
/// [`POLICIES`], for each seed.
///
/// # Errors
/// Where a setting is out of its range.
pub fn outcomes(setup: &PoliciesSetup, seeds: Range<u64>) -> Result<Vec<[PolicyOutcome; 3]>, SettingError> {
    seeds.map(|seed| outcome(&PoliciesSetup { seed, ..setup.clone() })).collect()
}

fn outcome(setup: &PoliciesSetup) -> Result<[PolicyOutcome; 3], SettingError> {
    let mut policies = Policies::new(setup)?.with_executor(Executor::Serial);
    let mut steps = [const { Vec::new() }; 3];
    while let Some(reports) = policies.step() {
        steps.iter_mut().zip(reports).for_each(|(steps, report)| steps.push(report.clone()));
    }
    Ok(steps.map(|steps| judge(&steps, policies.evidence_at())))
}

fn judge(steps: &[PolicyReport], evidence_at: Option<u32>) -> PolicyOutcome {
    let (count, last) = (steps.len(), &steps[steps.len() - 1]);
    let lineage_one = steps.iter().position(|report| report.descent.lineage(u32::MAX) == 1);
    let meanwhile = &steps[..lineage_one.map_or(count, |k| k + 1)];
    let crowns = steps[count / 2..].iter().map(|report| f64::from(report.tree_nodes() - report.step - 1));
    PolicyOutcome {
        final_ess: last.ess,
        rms_best: last.rms_best,
        resampled_fraction: steps.iter().filter(|report| report.resampled()).count() as f64 / count as f64,
        lineage_one_step: lineage_one.map(|k| steps[k].step),
        ess_at_lineage_one: lineage_one.map(|k| steps[k].ess),
        ess_meanwhile: meanwhile.iter().map(|report| report.ess).sum::<f64>() / meanwhile.len() as f64,
        tree_nodes: last.tree_nodes(),
        tree_crown: crowns.sum::<f64>() / (count - count / 2) as f64,
        kept: evidence_at.map(|step| Kept {
            alive: steps[step as usize - 2].right.is_some_and(|right| right > 0), // the k-th report is of step k + 1
            settled: last.error_best < RIGHT_WITHIN,
        }),
    }
}

/// One policy over many seeds.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PolicySummary {
    /// Its name, of [`POLICIES`].
    pub policy: &'static str,
    /// Number of seeds.
    pub seeds: u32,
    /// Median N_eff at the end.
    pub final_ess_median: f64,
    /// Median of the root mean square error of position \[m\].
    pub rms_median: f64,
    /// Error over that of the selective filter on the same seed: 10th percentile, median, 90th percentile.
    pub error_factor: [f64; 3],
    /// Mean share of the steps that resampled.
    pub resampled_fraction: f64,
    /// Median of the step at which all particles descend from one; `None` where half the runs or more never come to it.
    pub lineage_one_step_median: Option<f64>,
    /// Median N_eff at that step, over the runs that come to it; `None` where none does.
    pub ess_at_lineage_one_median: Option<f64>,
    /// Mean N_eff up to then.
    pub ess_meanwhile: f64,
    /// Mean number of nodes of the ancestry tree at the end.
    pub tree_nodes: f64,
    /// c of t + 1 + c M ln M, fitted to the tree's nodes over the second half of the runs (Jacob, Murray, Rubenthaler 2015, who
    /// resample at every step: who does so seldom has a larger one). `None` where M is one, or where nothing was ever resampled:
    /// then nothing coalesces.
    pub tree_c: Option<f64>,
    /// Runs in which the right wing was alive before the sign; on the wings' course.
    pub alive: Option<Fraction>,
    /// Its 95 % confidence interval.
    pub alive_interval: Option<[f64; 2]>,
    /// Runs that ended in the right wing.
    pub settled: Option<Fraction>,
    /// Its 95 % confidence interval.
    pub settled_interval: Option<[f64; 2]>,
}

/// What these outcomes of filters of so many particles come to, in the order of [`POLICIES`].
///
/// # Panics
/// Without any outcome.
pub fn summary(outcomes: &[[PolicyOutcome; 3]], particles: usize) -> [PolicySummary; 3] {
    core::array::from_fn(|policy| {
        let sorted = |f: &dyn Fn(&[PolicyOutcome; 3]) -> f64| {
            let mut values: Vec<f64> = outcomes.iter().map(f).collect();
            values.sort_unstable_by(f64::total_cmp);
            values
        };
        let of = |f: fn(&PolicyOutcome) -> f64| sorted(&|outcome| f(&outcome[policy]));
        let mean = |f: fn(&PolicyOutcome) -> f64| of(f).iter().sum::<f64>() / outcomes.len() as f64;
        let factors = sorted(&|outcome| outcome[policy].rms_best / outcome[2].rms_best);
        let lineage = quantile(&of(|run| run.lineage_one_step.map_or(f64::INFINITY, f64::from)), 0.5);
        let mut at_lineage_one: Vec<f64> = outcomes.iter().filter_map(|run| run[policy].ess_at_lineage_one).collect();
        at_lineage_one.sort_unstable_by(f64::total_cmp);
        let kept = |f: fn(&Kept) -> bool| {
            let kept: Option<Vec<bool>> = outcomes.iter().map(|outcome| outcome[policy].kept.as_ref().map(f)).collect();
            kept.map(|kept| Fraction::of(kept.into_iter()))
        };
        let (alive, settled) = (kept(|kept| kept.alive), kept(|kept| kept.settled));
        let resampled_fraction = mean(|run| run.resampled_fraction);
        let m = particles as f64;
        PolicySummary {
            policy: POLICIES[policy],
            seeds: outcomes.len() as u32,
            final_ess_median: quantile(&of(|run| run.final_ess), 0.5),
            rms_median: quantile(&of(|run| run.rms_best), 0.5),
            error_factor: [0.1, 0.5, 0.9].map(|q| quantile(&factors, q)),
            resampled_fraction,
            lineage_one_step_median: lineage.is_finite().then_some(lineage),
            ess_at_lineage_one_median: (!at_lineage_one.is_empty()).then(|| quantile(&at_lineage_one, 0.5)),
            ess_meanwhile: mean(|run| run.ess_meanwhile),
            tree_nodes: mean(|run| f64::from(run.tree_nodes)),
            tree_c: (particles > 1 && resampled_fraction > 0.0).then(|| mean(|run| run.tree_crown) / (m * ops::ln(m))),
            alive,
            alive_interval: alive.map(|fraction| fraction.wilson()),
            settled,
            settled_interval: settled.map(|fraction| fraction.wilson()),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::resampling::PolicyCourse;
    use fastslam::resampling::Scheme;

    #[test]
    fn a_range_of_seeds_can_be_run_in_pieces() {
        let setup = PoliciesSetup { particles: 4, ..PoliciesSetup::of(PolicyCourse::Wings) };
        let whole = outcomes(&setup, 1..5).unwrap();
        let pieces = [outcomes(&setup, 1..2).unwrap(), outcomes(&setup, 2..5).unwrap()].concat();
        assert_eq!(whole, pieces);
        let [never, always, _] = summary(&whole, 4);
        assert_eq!((never.resampled_fraction, never.tree_c, always.resampled_fraction), (0.0, None, 1.0));
        assert_eq!((never.tree_nodes, never.alive.unwrap().total), (4.0 * 105.0, 4));
    }

    /// By design of the course, not of the seeds: n = 400 that it was not tuned on, M = 16. The 95 % intervals of the two
    /// policies do not even touch. (Of 200 they do for the stratified scheme: with features assigned together both policies
    /// lose the right wing less often, in 77 % and 90 % of 400 runs it was alive where it had been in 73 % and 87 %.)
    fn n_eff_keeps_the_right_wing_more_often(schemes: &[Scheme]) {
        for &scheme in schemes {
            let setup = PoliciesSetup { scheme, ..PoliciesSetup::of(PolicyCourse::Wings) };
            let [_, always, selective] = summary(&outcomes(&setup, 70_000..70_400).unwrap(), 16);
            assert!(always.alive_interval.unwrap()[1] < selective.alive_interval.unwrap()[0], "{scheme}");
            assert!(always.settled_interval.unwrap()[1] < selective.settled_interval.unwrap()[0], "{scheme}");
        }
    }

    #[test]
    fn resampling_by_n_eff_keeps_the_right_wing_more_often_than_resampling_always() {
        n_eff_keeps_the_right_wing_more_often(&[Scheme::Stratified]);
    }

    #[test]
    #[ignore = "breadth: two more schemes, 400 seeds each"]
    fn resampling_by_n_eff_keeps_the_right_wing_more_often_by_other_schemes_too() {
        n_eff_keeps_the_right_wing_more_often(&[Scheme::Residual, Scheme::Multinomial]);
    }

    /// The systematic scheme hardly disturbs equal weights, and the policies are nearer to each other. Run by run: who kept the
    /// right wing alone? A sign test at α = 0.001 one-sided, n = 400 runs.
    #[test]
    #[ignore = "breadth: 400 runs"]
    fn it_does_so_with_the_scheme_of_least_noise_too() {
        let setup = PoliciesSetup { scheme: Scheme::Systematic, ..PoliciesSetup::of(PolicyCourse::Wings) };
        let outcomes = outcomes(&setup, 70_000..70_400).unwrap();
        let alone = |policy: usize, other: usize| {
            let alive =
                |outcome: &[PolicyOutcome; 3], policy: usize| outcome[policy].kept.is_some_and(|kept| kept.alive);
            outcomes.iter().filter(|outcome| alive(outcome, policy) && !alive(outcome, other)).count() as f64
        };
        let (always, selective) = (alone(1, 2), alone(2, 1));
        assert!(selective - always > 3.09 * (selective + always).sqrt(), "{selective} against {always}");
    }

    /// What makes it a course of ambiguity: raw odometry does not know which way it looks when it is lost, and about half the
    /// particles hold the right explanation, whatever the seed. α = 0.001 two-sided, n = 100 runs.
    #[test]
    fn odometry_does_not_tell_the_wings_apart() {
        let (mut right, mut share) = (0_u32, 0.0);
        for seed in 1..=100 {
            let setup = PoliciesSetup { seed, ..PoliciesSetup::of(PolicyCourse::Wings) };
            let mut policies = Policies::new(&setup).unwrap();
            let lost = policies.lost_from().unwrap();
            while policies.step_number() < lost {
                policies.step();
            }
            let looks = |poses: &[fastslam::geometry::Pose2]| poses[lost as usize].theta;
            let turned = ops::wrap_angle(looks(policies.odometry()) - looks(policies.truth()));
            right += u32::from(turned.abs() < core::f64::consts::FRAC_PI_2);
            let never = policies.reports()[0].right.unwrap();
            assert!((1..16).contains(&never), "seed {seed}: both explanations are there, {never} of 16");
            share += f64::from(never) / 1600.0;
        }
        // 3.29 standard deviations of a coin's count.
        assert!((f64::from(right) - 50.0).abs() < 3.29 * 5.0, "{right} of 100");
        assert!((0.3..0.7).contains(&share), "{share}");
    }
}
