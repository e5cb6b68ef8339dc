//! The lap table: errors over many seeds, for both proposals and several M.

use super::lap::{Lap, LapSetup};
use super::{ErrorSummary, quantile};
use crate::experiment::ProposalKind;
use fastslam::error::SettingError;
use fastslam::execute::Executor;
use fastslam::matching::Matcher;

/// The table's numbers of particles.
pub const PARTICLES: [usize; 5] = [4, 8, 16, 24, 40];

/// RMS error of position of the best particle's path at the end of one lap \[m\], on the calling thread: seeds are what is spread.
///
/// # Errors
/// Where a setting is out of its range.
pub fn rms_best(setup: &LapSetup) -> Result<f64, SettingError> {
    let mut lap = Lap::new(setup)?.with_executor(Executor::Serial);
    while lap.step().is_some() {}
    Ok(lap.report().rms_best)
}

/// What is kept of one lap.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LapResult {
    /// Which row it belongs to.
    pub proposal: ProposalKind,
    /// Which row it belongs to.
    pub matcher: Matcher,
    /// Which row it belongs to.
    pub particles: usize,
    /// Its seed.
    pub seed: u64,
    /// RMS error of position of the best particle \[m\].
    pub rms_best: f64,
    /// The same after the best rigid alignment \[m\].
    pub rms_best_aligned: f64,
    /// RMS error of position of raw odometry \[m\].
    pub rms_odometry: f64,
    /// Share of the steps that resampled.
    pub resampled_fraction: f64,
    /// First step at which all particles descend from one, if any did.
    pub lineage_one_step: Option<u32>,
    /// N_eff at the end.
    pub final_ess: f64,
}

impl LapResult {
    /// Runs one lap to its end.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn of(setup: &LapSetup) -> Result<Self, SettingError> {
        let mut lap = Lap::new(setup)?;
        let (mut resampled, mut lineage_one_step) = (0, None);
        while let Some(report) = lap.step() {
            resampled += u32::from(report.ancestors.is_some());
            if report.lineage == 1 {
                lineage_one_step = lineage_one_step.or(Some(report.step));
            }
        }
        let report = lap.report();
        Ok(Self {
            proposal: setup.proposal,
            matcher: setup.matcher,
            particles: setup.particles,
            seed: setup.seed,
            rms_best: report.rms_best,
            rms_best_aligned: report.rms_best_aligned,
            rms_odometry: report.rms_odometry,
            resampled_fraction: f64::from(resampled) / f64::from(lap.step_count()),
            lineage_one_step,
            final_ess: report.ess,
        })
    }
}

/// One row: a proposal and an M over many seeds.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Row {
    /// The proposal.
    pub proposal: ProposalKind,
    /// The matcher.
    pub matcher: Matcher,
    /// M.
    pub particles: usize,
    /// Number of seeds.
    pub seeds: usize,
    /// Median of the RMS error of position \[m\].
    pub rms_median: f64,
    /// 95 % confidence interval of the median \[m\].
    pub rms_median_interval: [f64; 2],
    /// Its 90th percentile \[m\].
    pub rms_p90: f64,
    /// Its worst \[m\].
    pub rms_worst: f64,
    /// Median after the best rigid alignment \[m\].
    pub rms_aligned_median: f64,
    /// Median of the RMS error of raw odometry \[m\].
    pub odometry_rms_median: f64,
    /// Mean share of the steps that resampled.
    pub resampled_fraction: f64,
    /// Median of the step at which all particles descend from one; `None` where half the laps or more never come to it.
    pub lineage_one_step_median: Option<f64>,
    /// Median N_eff at the end.
    pub final_ess_median: f64,
}

/// The rows of these results, in the order of proposal, matcher and M; results may come in any order.
pub fn rows(results: &[LapResult]) -> Vec<Row> {
    let mut rows = Vec::new();
    for proposal in [ProposalKind::Improved, ProposalKind::Motion] {
        for matcher in [Matcher::Cell, Matcher::SubCell] {
            let of = |r: &&LapResult| r.proposal == proposal && r.matcher == matcher;
            let mut counts: Vec<usize> = results.iter().filter(of).map(|r| r.particles).collect();
            counts.sort_unstable();
            counts.dedup();
            for particles in counts {
                let laps: Vec<&LapResult> = results.iter().filter(of).filter(|r| r.particles == particles).collect();
                rows.push(row(&laps));
            }
        }
    }
    rows
}

fn row(laps: &[&LapResult]) -> Row {
    let sorted = |f: &dyn Fn(&LapResult) -> f64| {
        let mut values: Vec<f64> = laps.iter().map(|lap| f(lap)).collect();
        values.sort_unstable_by(f64::total_cmp);
        values
    };
    let ErrorSummary { median, median_interval, p90, worst } = ErrorSummary::of(&sorted(&|lap| lap.rms_best));
    let lineage = quantile(&sorted(&|lap| lap.lineage_one_step.map_or(f64::INFINITY, f64::from)), 0.5);
    Row {
        proposal: laps[0].proposal,
        matcher: laps[0].matcher,
        particles: laps[0].particles,
        seeds: laps.len(),
        rms_median: median,
        rms_median_interval: median_interval,
        rms_p90: p90,
        rms_worst: worst,
        rms_aligned_median: quantile(&sorted(&|lap| lap.rms_best_aligned), 0.5),
        odometry_rms_median: quantile(&sorted(&|lap| lap.rms_odometry), 0.5),
        // Summed in sorted order: the same bits however the results were spread over shards.
        resampled_fraction: sorted(&|lap| lap.resampled_fraction).iter().sum::<f64>() / laps.len() as f64,
        lineage_one_step_median: lineage.is_finite().then_some(lineage),
        final_ess_median: quantile(&sorted(&|lap| lap.final_ess), 0.5),
    }
}
