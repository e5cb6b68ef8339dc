//! What the lap says: a step in words, the lines of the algorithm that led to it, the readouts and the data.

use super::{challenges, model::LapModel};
use crate::challenge::Challenge;
use crate::decimal::fixed;
use crate::model::{Column, Model, Readout, Series, Tells, TraceLine};
use crate::told::{ess_text, pose_text, unexplained};
use crate::words::{common, lap};
use fastslam::{geometry::Pose2, proposal::ProposalTrace};
use fastslam_lab::experiment::ProposalKind;
use fastslam_lab::experiment::lap::StepReport;

impl Tells for LapModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let (report, m) = (self.report(), self.recipe.setup.particles);
        let metres = |name, title, x: f64, help| Readout::new(name, title, x, fixed(x, 3), "m", help);
        let kilobytes = |name, title, bytes: u64, help| {
            let x = bytes as f64 / 1000.0;
            Readout::new(name, title, x, fixed(x, 0), "KB", help)
        };
        let (unique, dense) = (report.map_bytes_unique, report.map_bytes_dense);
        let share = 100.0 * unique as f64 / dense as f64;
        vec![
            Readout::new(
                "step",
                common::step(),
                f64::from(report.step),
                common::Of { n: &report.step, all: &self.step_count() }.say(),
                "",
                lap::step_readout_help(),
            ),
            metres("rms_best", lap::rms_best(), report.rms_best, lap::rms_best_help()),
            metres("rms_best_aligned", lap::aligned(), report.rms_best_aligned, lap::aligned_help()),
            metres("rms_odometry", lap::rms_odometry(), report.rms_odometry, lap::rms_odometry_help()),
            Readout::new("ess", "N_eff", report.ess, ess_text(report.ess, m), "", common::n_eff_help()),
            Readout::new(
                "lineage",
                common::lineage(),
                f64::from(report.lineage),
                common::Of { n: &report.lineage, all: &m }.say(),
                "",
                lap::lineage_help(),
            ),
            Readout {
                text: fixed(self.spread(), 2),
                ..metres("spread", lap::spread_title(), self.spread(), lap::spread_help())
            }
            .drawn(),
            kilobytes("map_unique", common::memory(), unique, lap::memory_help()),
            kilobytes("map_dense", common::dense(), dense, lap::dense_help()),
            Readout::new("map_share", lap::share(), share, fixed(share, 0), "%", lap::share_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("step", "step of the lap"),
            Column::new("rms_best_m", "RMS position error of the best universe's path so far [m]"),
            Column::new("rms_best_aligned_m", "the same after the best rigid alignment [m]"),
            Column::new("rms_odometry_m", "RMS position error of raw odometry so far [m]"),
            Column::new(
                "mean_increment_nats",
                "log of the weighted mean of what the universes pay for the scan [nats]: of a score, not evidence",
            ),
            Column::new("ess", "effective number of universes before resampling"),
            Column::new("best", "slot of the best universe"),
            Column::new("resampled", "1 where the step resampled"),
            Column::new("died_out", "universes without offspring at this resampling"),
            Column::new("lineage", "distinct ancestors at step 0"),
            Column::new("matched", "universes whose scan matcher was trusted"),
            Column::new("map_unique_bytes", "memory of all maps, shared tiles counted once [bytes]"),
            Column::new("map_dense_bytes", "memory of as many dense arrays [bytes]"),
        ];
        let row = |r: &StepReport| {
            vec![
                f64::from(r.step),
                r.rms_best,
                r.rms_best_aligned,
                r.rms_odometry,
                r.log_evidence,
                r.ess,
                f64::from(r.best),
                f64::from(u8::from(r.ancestors.is_some())),
                r.ancestors.as_ref().map_or(0, |a| died_out(a)) as f64,
                f64::from(r.lineage),
                f64::from(r.matched),
                r.map_bytes_unique as f64,
                r.map_bytes_dense as f64,
            ]
        };
        Series { columns: COLUMNS.into(), rows: self.simulated().iter().map(row).collect() }
    }

    fn describe(&self) -> String {
        match &self.hand {
            Some(hand) => self.told_at_the_wheel(hand),
            None => self.news().into_iter().chain([self.told(self.report())]).collect::<Vec<_>>().join(" "),
        }
    }

    fn narrate(&self) -> String {
        match &self.hand {
            Some(hand) => self.told_at_the_wheel(hand),
            None => self.news().unwrap_or_else(|| self.narrated(self.report())),
        }
    }

    /// Of the universe shown large, and of all where the line is about all.
    fn trace(&self) -> Vec<TraceLine> {
        let (report, slot) = (self.report(), self.selected() as usize);
        let [.., from, to] = self.lap().path(slot)[..] else { return Vec::new() };
        // Where the universe was before it was copied.
        let slot = report.ancestors.as_ref().map_or(slot, |ancestors| ancestors[slot] as usize);
        let m = self.recipe.setup.particles;
        let pose = |pose: &Pose2| pose_text([pose.x, pose.y, pose.theta]);
        let nats = |x: f64| format!("{} nats", fixed(x, 1));
        let predicted = self.lap().world().controls[report.step as usize - 1].apply(&from);
        let paid = nats(report.log_increments[slot]);
        let mut lines = Vec::new();
        if self.recipe.setup.proposal == ProposalKind::Improved {
            lines.extend([TraceLine::new("predict", pose(&predicted)), TraceLine::new("seed", "")]);
            let (matched, m) = (&report.matched, &m);
            match report.traces[slot] {
                ProposalTrace::Matched { mode, log_integral, .. } => lines.extend([
                    TraceLine::new("match", lap::MovedBy { pose: &pose_text(mode.minus(&predicted).into()) }.say()),
                    TraceLine::new("doubt", lap::Trusted { matched, m }.say()),
                    TraceLine::new("fit", format!("ln η̂ = {}", nats(log_integral))),
                    TraceLine::new("draw", pose(&to)),
                    TraceLine::new("pay", paid),
                ]),
                ProposalTrace::Motion => lines.extend([
                    TraceLine::new("match", ""),
                    TraceLine::new("doubt", lap::NotTrusted { matched, m }.say()),
                    TraceLine::new("fallback", pose(&to)),
                    TraceLine::new("pay", paid),
                ]),
            }
        } else {
            // What it pays, by its whole map, is no line of this box.
            lines.push(TraceLine::new("fallback", pose(&to)));
        }
        let largest = report.weights.iter().copied().fold(0.0, f64::max);
        let dead = &self.extinct().len();
        let resample = if report.ancestors.is_some() { lap::Yes { dead }.say() } else { common::no().into() };
        let kilobytes = &fixed(report.map_bytes_unique as f64 / 1000.0, 0);
        lines.extend([
            TraceLine::new("map", lap::AllMaps { kilobytes }.say()),
            TraceLine::new("extend", ""),
            TraceLine::new("normalise", lap::Largest { weight: &fixed(largest, 2) }.say()),
            TraceLine::new("ess", ess_text(report.ess, m)),
            TraceLine::new("resample", resample),
        ]);
        lines
    }
}

impl LapModel {
    /// A step in words.
    fn told(&self, report: &StepReport) -> String {
        let (m, slot) = (self.recipe.setup.particles, self.selected());
        let (step, last, best) = (&report.step, &self.step_count(), &report.best);
        let shown = if self.overlaid() {
            lap::ShownOverlaid { step, last, m: &m }.say()
        } else if slot == report.best {
            lap::ShownBest { step, last, m: &m, slot: &slot }.say()
        } else {
            lap::ShownOther { step, last, m: &m, slot: &slot, best }.say()
        };
        if report.step == 0 {
            return [shown, lap::all_start().into()].join(" ");
        }
        let resampling = match &report.ancestors {
            None => lap::no_resampling().into(),
            Some(ancestors) if self.overlaid() => lap::Died { dead: &died_out(ancestors), m: &m }.say(),
            Some(ancestors) => {
                let (parent, dead) = (ancestors[slot as usize], &died_out(ancestors));
                if parent == slot {
                    lap::KeptSlot { dead, m: &m, slot: &slot }.say()
                } else {
                    lap::CopyOf { dead, m: &m, slot: &slot, parent: &parent }.say()
                }
            }
        };
        let numbers = lap::Errors {
            best: &fixed(report.rms_best, 2),
            odometry: &fixed(report.rms_odometry, 2),
            ess: &fixed(report.ess, 1),
            m: &m,
            resampling: &resampling,
        };
        let apart = self.overlaid().then(|| lap::Apart { spread: &fixed(self.spread(), 2) }.say());
        let closing = self.closing().filter(|closing| report.step >= *closing).map(|_| {
            let dead = &self.died_in_closing();
            if self.closes() { lap::Closing { dead, m: &m }.say() } else { lap::Closed { dead, m: &m }.say() }
        });
        let sentences = [Some(shown), apart, closing, unexplained(report.log_evidence), Some(numbers.say())];
        sentences.into_iter().flatten().collect::<Vec<_>>().join(" ")
    }

    /// What happens at a step, by the part of the lap that it is in.
    fn narrated(&self, report: &StepReport) -> String {
        let m = &self.recipe.setup.particles;
        if let Some(unexplained) = unexplained(report.log_evidence) {
            return unexplained;
        }
        if report.step == 0 {
            return lap::NStart { m }.say();
        }
        let best = &fixed(report.rms_best, 2);
        if *m == 1 {
            return lap::NAlone { best }.say();
        }
        if !self.overlaid() {
            let slot = self.selected();
            let weight = &fixed(100.0 * report.weights[slot as usize], 0);
            return lap::NOne { slot: &slot, weight }.say();
        }
        let (spread, dead) = (&fixed(self.spread(), 2), &self.died_in_closing());
        match self.closing() {
            Some(_) if self.closes() && *dead == 0 => lap::n_view().into(),
            Some(_) if self.closes() => lap::NClosing { dead, m, spread }.say(),
            Some(closing) if report.step < closing => lap::NApart { spread }.say(),
            Some(_) => lap::NClosed { dead, m, spread }.say(),
            None => lap::NLap { m, spread, best, odometry: &fixed(report.rms_odometry, 2) }.say(),
        }
    }
}

/// How many slots no one descends from. Ancestors are in ascending order.
fn died_out(ancestors: &[u32]) -> usize {
    let survivors = 1 + ancestors.windows(2).filter(|pair| pair[0] != pair[1]).count();
    ancestors.len() - survivors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sentence_says_when_no_universe_explains_a_scan() {
        let model = LapModel::default();
        let report = StepReport { step: 1, ..model.report().clone() };
        assert!(!model.told(&report).contains("explains"));
        let report = StepReport { log_evidence: f64::NEG_INFINITY, ..report };
        assert!(model.told(&report).contains("No universe explains this scan: the weights stay."));
    }
}
