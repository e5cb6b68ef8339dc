//! What is told of record and draws in numbers and in words.

use super::{
    challenges,
    model::{Account, SmoothingModel},
};
use crate::{
    challenge::Challenge,
    decimal::{fixed, write},
    model::{Column, Readout, Series, Tells},
    prediction::{State, off_by},
    words::smoothing as words,
};
use fastslam_lab::experiment::smoothing::{MOST, STEPS};

/// A length \[m\] with its unit, in centimetres.
pub fn length(length: f64) -> String {
    words::Centimetres { cm: &fixed(100.0 * length, 0) }.say()
}

/// How far the poses of an account spread at a step: root of the mean squared distance from their mean \[m\].
pub fn spread(account: &Account, step: u32) -> f64 {
    let covariance = &account.moments[step as usize].1;
    (covariance.m11 + covariance.m22).sqrt()
}

impl Tells for SmoothingModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let (before, after) = (self.before(), self.after());
        let number = |x: Option<f64>| x.unwrap_or(f64::NAN);
        let whole = |name, title, x: Option<u32>, help| {
            Readout::new(name, title, number(x.map(f64::from)), x.map_or(String::new(), |x| x.to_string()), "", help)
        };
        let metres =
            |name, title, x: Option<f64>, help| Readout::new(name, title, number(x), fixed(number(x), 2), "m", help);
        let at = |account: &Option<Account>, step: u32| account.as_ref().map(|account| account.distinct[step as usize]);
        let step = self.at();
        let cost = self.run().cost();
        vec![
            whole("coalescence", words::coalescence(), self.coalescence(), words::coalescence_help()).drawn(),
            whole("distinct_before", words::distinct_before(), at(&before, step), words::distinct_before_help())
                .drawn(),
            whole("distinct_after", words::distinct_after(), at(&after, step), words::distinct_after_help()).drawn(),
            whole("first_before", words::first_before(), at(&before, 1), words::first_before_help()),
            whole("first_after", words::first_after(), at(&after, 1), words::first_after_help()),
            metres(
                "early_before",
                words::early_before(),
                before.as_ref().map(|account| account.early),
                words::early_before_help(),
            )
            .drawn(),
            metres(
                "early_after",
                words::early_after(),
                after.as_ref().map(|account| account.early),
                words::early_after_help(),
            )
            .drawn(),
            metres(
                "spread",
                words::spread(),
                after.as_ref().map(|account| spread(account, step)),
                words::spread_help(),
            ),
            whole("sweeps", words::sweeps_done(), Some(self.sweeps()), words::sweeps_done_help()).drawn(),
            Readout::new("cost", words::cost(), cost, fixed(cost, 1), "×", words::cost_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("step", "step of the drive"),
            Column::new("distinct_before", "distinct ancestors of the filter's particles"),
            Column::new("distinct_after", "different poses among the paths of the sweeps shown"),
            Column::new("error_before_m", "distance of the weighted mean of the ancestors from the truth [m]"),
            Column::new("error_after_m", "distance of the mean over the sweeps from the truth [m]"),
            Column::new("spread_before_m", "root of the mean squared distance of the ancestors from their mean [m]"),
            Column::new("spread_after_m", "the same of the poses of the sweeps [m]"),
        ];
        let accounts = [self.before(), self.after()];
        let row = |step: u32| {
            let [before, after] = accounts.each_ref().map(|account| {
                let of = |account: &Account| {
                    let k = step as usize;
                    [f64::from(account.distinct[k]), account.errors[k], spread(account, step)]
                };
                account.as_ref().map_or([f64::NAN; 3], of)
            });
            vec![step.into(), before[0], after[0], before[1], after[1], before[2], after[2]]
        };
        Series { columns: COLUMNS.into(), rows: (0..=STEPS).map(row).collect() }
    }

    fn describe(&self) -> String {
        let m = self.particles();
        let (Some(before), Some(coalescence)) = (self.before(), self.coalescence()) else {
            return words::Beginning { m: &m }.say();
        };
        let early = length(before.early);
        let mut sentences = vec![match coalescence {
            0 => words::NoneShared { m: &m, early: &early }.say(),
            step => words::Shared { m: &m, step: &step, early: &early }.say(),
        }];
        sentences.extend(judged(self));
        if self.hides() {
            return sentences.join(" ");
        }
        let at = self.at();
        let one = before.distinct[at as usize];
        sentences.push(match self.after() {
            None => words::Unswept { at: &at, n: &one }.say(),
            Some(after) => words::Swept {
                sweeps: &self.sweeps(),
                at: &at,
                n: &after.distinct[at as usize],
                was: &one,
                early: &length(after.early),
            }
            .say(),
        });
        sentences.join(" ")
    }

    fn narrate(&self) -> String {
        let m = &self.particles();
        let (Some(before), Some(coalescence)) = (self.before(), self.coalescence()) else { return self.describe() };
        if let Some(judged) = judged(self) {
            return judged;
        }
        let at = &self.at();
        let was = &before.distinct[*at as usize];
        match (self.after(), coalescence) {
            (Some(after), _) => words::NSwept { at, n: &after.distinct[*at as usize], was }.say(),
            (None, 0) => words::NNone { m }.say(),
            (None, step) => words::NOne { m, step: &step }.say(),
        }
    }
}

/// What is said of the prediction, if one is asked for.
fn judged(model: &SmoothingModel) -> Option<String> {
    let sweeps = &MOST;
    Some(match (model.state(), model.first_of_all()) {
        (State::Off, _) | (State::Guessed(_) | State::Waived, None) => return None,
        (State::Asked, _) => words::Asks { sweeps }.say(),
        (State::Placed(guess), _) => words::Placed { sweeps, guess: &write(guess) }.say(),
        (State::Guessed(guess), Some(n)) => {
            words::Came { sweeps, n: &n, guess: &write(guess), off: &off_by(guess, n.into()) }.say()
        }
        (State::Waived, Some(n)) => words::CameAlone { sweeps, n: &n }.say(),
    })
}
