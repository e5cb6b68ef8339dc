//! What the lap says: a step in words, and the lines of the algorithm that led to it.

use super::model::{LapModel, died_out};
use crate::decimal::fixed;
use crate::model::{Model, TraceLine};
use crate::told::{ess_text, pose_text, unexplained};
use crate::words::{common, lap};
use fastslam::{geometry::Pose2, proposal::ProposalTrace};
use fastslam_lab::experiment::ProposalKind;
use fastslam_lab::experiment::lap::StepReport;

impl LapModel {
    /// A step in words.
    pub(super) fn told(&self, report: &StepReport) -> String {
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
    pub(super) fn narrated(&self, report: &StepReport) -> String {
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

    /// Of the universe shown large, and of all where the line is about all.
    pub(super) fn lines(&self) -> Vec<TraceLine> {
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
