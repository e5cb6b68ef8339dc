//! What is told of both filters in numbers and in words.

use super::{challenges, model::JointModel};
use crate::challenge::Challenge;
use crate::decimal::{fixed, write};
use crate::model::{Column, Readout, Series, Tells};
use crate::prediction::{State, off_by};
use crate::told::count;
use crate::words::{common, joint};
use fastslam_lab::experiment::joint::{COMPUTED, MOST, SAMPLED};

/// A share in percent, with as many decimals as tell it from all.
pub fn percent(share: f64) -> String {
    let digits = match 1.0 - share {
        0.0 => 0,
        left if left < 2e-4 => 3,
        left if left < 2e-3 => 2,
        _ => 1,
    };
    format!("{} %", fixed(100.0 * share, digits))
}

/// A length \[m\] with two digits or so.
pub fn metres(length: f64) -> String {
    fixed(length, if length < 0.01 { 4 } else { 2 })
}

/// A length \[m\] with its unit, in millimetres where it is short.
pub fn length(length: f64) -> String {
    if length < 0.01 { format!("{} mm", fixed(1e3 * length, 1)) } else { format!("{} m", fixed(length, 2)) }
}

impl Tells for JointModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let m = self.particles();
        let of_all = |x: f64| common::Of { n: &count(x), all: &m }.say();
        let particles = |name, title, x: Option<f64>, help| {
            let x = x.unwrap_or(f64::NAN);
            Readout::new(name, title, x, of_all(x), "", help)
        };
        let hidden = self.hides(SAMPLED);
        let found = [SAMPLED, COMPUTED].map(|filter| self.population(filter).filter(|_| !self.hides(filter)));
        let ess = found.map(|found| found.map(|found| found.ess));
        let left = found.map(|found| found.map(|found| f64::from(found.left)));
        let predicted =
            [SAMPLED, COMPUTED].map(|filter| (!self.hides(filter)).then(|| self.predicted(filter, self.landmarks())));
        let spread = |name, title, filter, help| {
            let x = if self.hides(filter) { f64::NAN } else { self.spread(filter) };
            Readout::new(name, title, x, metres(x), "m", help).drawn()
        };
        let removed = if hidden { f64::NAN } else { 100.0 * self.filters().removed(self.landmarks()) };
        let text = self.removed().map(|text| text.trim_end_matches([' ', '%']).to_string()).unwrap_or_default();
        let (rho, [done, _]) = (if hidden { f64::NAN } else { self.filters().log().rho() }, self.repeats());
        vec![
            particles("ess_sampled", joint::ess_sampled(), ess[0], joint::ess_sampled_help()).drawn(),
            particles("ess_computed", joint::ess_computed(), ess[1], joint::ess_computed_help()).drawn(),
            particles("predicted_sampled", joint::predicted_sampled(), predicted[0], joint::predicted_sampled_help()),
            particles(
                "predicted_computed",
                joint::predicted_computed(),
                predicted[1],
                joint::predicted_computed_help(),
            ),
            Readout::new("rho", joint::rho(), rho, fixed(rho, 3), "", joint::rho_help()),
            particles("left_sampled", joint::left_sampled(), left[0], joint::left_sampled_help()).drawn(),
            particles("left_computed", joint::left_computed(), left[1], joint::left_computed_help()).drawn(),
            spread("spread_sampled", joint::spread_sampled(), SAMPLED, joint::spread_sampled_help()),
            spread("spread_computed", joint::spread_computed(), COMPUTED, joint::spread_computed_help()),
            Readout::new("removed", joint::removed(), removed, text, "%", joint::removed_help()).drawn(),
            Readout::new("repeats", joint::repeats(), done.into(), done.to_string(), "", joint::repeats_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("landmarks", "landmarks seen"),
            Column::new("ess_sampled", "N_eff of the sampled map, first run"),
            Column::new("ess_sampled_predicted", "what it is to be by the closed form"),
            Column::new("ess_computed", "N_eff of the computed map, first run"),
            Column::new("ess_computed_predicted", "what it is to be by the closed form"),
            Column::new("left_sampled", "particles of the sampled map that a resampling would continue"),
            Column::new("left_computed", "the same of the computed map"),
            Column::new("spread_sampled_m", "standard deviation over the repeats of the first landmark's estimate [m]"),
            Column::new("spread_computed_m", "the same of the computed map [m]"),
        ];
        let row = |landmarks: u32| {
            let of =
                |filter| self.filters().population(filter, landmarks).map(|found| (found.ess, f64::from(found.left)));
            let [drawn, computed] = [SAMPLED, COMPUTED].map(|filter| of(filter).unwrap_or((f64::NAN, f64::NAN)));
            let [a, b] = [SAMPLED, COMPUTED].map(|filter| self.predicted(filter, landmarks));
            let [c, d] = [SAMPLED, COMPUTED].map(|filter| self.filters().variance(filter, landmarks).sqrt());
            vec![landmarks.into(), drawn.0, a, computed.0, b, drawn.1, computed.1, c, d]
        };
        let count = if self.hides(SAMPLED) { 0 } else { MOST };
        Series { columns: COLUMNS.into(), rows: (1..=count).map(row).collect() }
    }

    fn describe(&self) -> String {
        let judged = self.judged();
        if self.hides(SAMPLED) {
            return judged.unwrap_or_default();
        }
        let (n, m) = (self.landmarks(), self.particles());
        let [Some(sampled), Some(computed)] = [SAMPLED, COMPUTED].map(|filter| self.population(filter)) else {
            return joint::Beginning { m: &m }.say();
        };
        let [a, b] = [SAMPLED, COMPUTED].map(|filter| count(self.predicted(filter, n)));
        let told =
            joint::Told { n: &n, m: &m, sampled: &count(sampled.ess), computed: &count(computed.ess), a: &a, b: &b };
        let mut sentences: Vec<String> = judged.into_iter().chain([told.say()]).collect();
        if let Some(removed) = self.removed() {
            let [c, d] = [SAMPLED, COMPUTED].map(|filter| length(self.spread(filter)));
            let [repeats, _] = self.repeats();
            sentences.push(joint::Spread { repeats: &repeats, c: &c, d: &d, removed: &removed }.say());
        }
        sentences.join(" ")
    }

    fn narrate(&self) -> String {
        let [Some(sampled), Some(computed)] = [SAMPLED, COMPUTED].map(|filter| self.population(filter)) else {
            return self.describe();
        };
        let (n, m) = (&self.landmarks(), &self.particles());
        let told = || joint::NTold { n, m, sampled: &count(sampled.ess), computed: &count(computed.ess) }.say();
        self.judged().unwrap_or_else(told)
    }
}

impl JointModel {
    /// What is said of the prediction, if one is asked for.
    fn judged(&self) -> Option<String> {
        let m = &self.particles();
        Some(match (self.state(), self.below_one()) {
            (State::Off, _) => return None,
            (State::Asked, _) => joint::Asks { m }.say(),
            (State::Placed(guess), _) => joint::Placed { m, guess: &write(guess) }.say(),
            (State::Guessed(guess), Some(result)) => {
                joint::Came { m, result: &result, guess: &write(guess), off: &off_by(guess, result.into()) }.say()
            }
            (State::Waived, Some(result)) => joint::CameAlone { m, result: &result }.say(),
            (State::Guessed(guess), None) => joint::NeverCame { m, all: &MOST, guess: &write(guess) }.say(),
            (State::Waived, None) => joint::NeverCameAlone { m, all: &MOST }.say(),
        })
    }

    /// The share of the variance that computing removed, in words; nothing where there is none yet.
    pub fn removed(&self) -> Option<String> {
        if self.hides(SAMPLED) {
            return None;
        }
        let removed = self.filters().removed(self.landmarks());
        removed.is_finite().then(|| percent(removed))
    }
}
