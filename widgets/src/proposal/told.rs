//! What is told of both proposals in numbers and in words.

use super::{challenges, model::ProposalModel};
use crate::challenge::Challenge;
use crate::decimal::{fixed, write};
use crate::model::{Column, Readout, Series, Tells};
use crate::prediction::{State, off_by};
use crate::words::{common, proposal};
use fastslam_lab::experiment::proposal::{Cloud, Proposals};

impl Tells for ProposalModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let Proposals { motion, aware, exact, z, .. } = &self.shown;
        let m = self.setup().samples;
        let percent = |name, title, share: f64, help| {
            let x = 100.0 * share;
            Readout::new(name, title, x, fixed(x, 1), "%", help).drawn()
        };
        let ess = |name, title, cloud: &Cloud, help| {
            let x = cloud.ess();
            Readout::new(name, title, x, common::Of { n: &fixed(x, 1), all: &m }.say(), "", help).drawn()
        };
        let times = |name, title, x: f64, help| Readout::new(name, title, x, fixed(x, 2), "×", help);
        let first = |x: f64| if self.setup().twins { x } else { f64::NAN };
        vec![
            percent(
                "inside_motion",
                proposal::inside_motion(),
                motion.share_inside(None),
                proposal::inside_motion_help(),
            ),
            percent("inside_aware", proposal::inside_aware(), aware.share_inside(None), proposal::inside_aware_help()),
            ess("ess_motion", proposal::ess_motion(), motion, proposal::ess_motion_help()),
            ess("ess_aware", proposal::ess_aware(), aware, proposal::ess_aware_help()),
            times("ratio", proposal::ratio(), self.ratio, proposal::ratio_help()).drawn(),
            times(
                "ratio_half",
                proposal::ratio_half(),
                self.at_half().unwrap_or(f64::NAN),
                proposal::ratio_half_help(),
            )
            .drawn(),
            percent("a_posterior", proposal::a_posterior(), first(exact.candidates[0]), proposal::a_posterior_help()),
            percent("a_motion", proposal::a_motion(), first(motion.share_inside(Some(0))), proposal::a_motion_help()),
            percent("a_aware", proposal::a_aware(), first(aware.share_inside(Some(0))), proposal::a_aware_help()),
            Readout::new("range", proposal::range_seen(), z.x, fixed(z.x, 2), "m", proposal::range_seen_help()),
            Readout::new("bearing", proposal::bearing_seen(), z.y, fixed(z.y, 2), "rad", proposal::bearing_seen_help()),
            times("predicted", proposal::predicted(), self.shown.predicted_ratio(), proposal::predicted_help()),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("sample", "number of the sample"),
            Column::new("motion_x_m", "x of FastSLAM 1.0's sample [m]"),
            Column::new("motion_y_m", "y of it [m]"),
            Column::new("motion_theta_rad", "heading of it [rad]"),
            Column::new("motion_weight", "normalised weight of it"),
            Column::new("motion_inside", "1 where it is in the posterior's 90 % region"),
            Column::new("motion_landmark", "landmark that it takes the sighting to be of, from 0"),
            Column::new("aware_x_m", "x of FastSLAM 2.0's sample [m]"),
            Column::new("aware_y_m", "y of it [m]"),
            Column::new("aware_theta_rad", "heading of it [rad]"),
            Column::new("aware_weight", "normalised weight of it"),
            Column::new("aware_inside", "1 where it is in the posterior's 90 % region"),
            Column::new("aware_landmark", "landmark that it takes the sighting to be of, from 0"),
        ];
        let half = |cloud: &Cloud, k: usize| {
            let (pose, inside) = (cloud.poses[k], f64::from(u8::from(cloud.inside[k])));
            [pose.x, pose.y, pose.theta, cloud.weights.as_slice()[k], inside, f64::from(cloud.candidates[k])]
        };
        let Proposals { motion, aware, .. } = &self.shown;
        let row = |k| [k as f64].into_iter().chain(half(motion, k)).chain(half(aware, k)).collect();
        Series { columns: COLUMNS.into(), rows: (0..motion.poses.len()).map(row).collect() }
    }

    fn describe(&self) -> String {
        let Proposals { motion, aware, exact, .. } = &self.shown;
        let m = self.setup().samples;
        let percent = |share: f64| format!("{} %", fixed(100.0 * share, 0));
        let told = proposal::Told {
            m: &m,
            noise: &write(self.setup().range_std),
            motion: &percent(motion.share_inside(None)),
            motion_ess: &fixed(motion.ess(), 0),
            aware: &percent(aware.share_inside(None)),
            aware_ess: &fixed(aware.ess(), 0),
            ratio: &fixed(self.shown.ratio(), 1),
        };
        // What cannot be seen at a glance comes first.
        let mut sentences = self.news();
        sentences.push(told.say());
        if self.setup().twins {
            let shares = |cloud: &Cloud| [0, 1].map(|k| percent(cloud.share_inside(Some(k))));
            let ([a, b], [c, d]) = (shares(motion), shares(aware));
            let [p, q] = [0, 1].map(|k| percent(exact.candidates[k]));
            sentences.push(proposal::EitherLandmark { p: &p, q: &q, a: &a, b: &b, c: &c, d: &d }.say());
        }
        sentences.join(" ")
    }

    fn narrate(&self) -> String {
        let [motion, aware] = [&self.shown.motion, &self.shown.aware]
            .map(|cloud| format!("{} %", fixed(100.0 * cloud.share_inside(None), 0)));
        let told = || proposal::NTold { motion: &motion, aware: &aware }.say();
        self.news().into_iter().next().unwrap_or_else(told)
    }
}

impl ProposalModel {
    /// What cannot be seen at a glance: a prediction, and what has been lost.
    fn news(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        let half = &self.half();
        match (self.state(), self.at_half()) {
            (State::Guessed(guess), Some(ratio)) => {
                let (off, ratio, guess) = (&off_by(guess, ratio), &fixed(ratio, 1), &write(guess));
                sentences.push(proposal::GuessWas { half, ratio, guess, off }.say());
            }
            (State::Waived, Some(ratio)) => {
                sentences.push(proposal::GuessWaived { half, ratio: &fixed(ratio, 1) }.say());
            }
            (State::Placed(guess), _) => sentences.push(proposal::GuessIs { guess: &write(guess) }.say()),
            (State::Asked, _) => sentences.push(proposal::NoGuess { half }.say()),
            _ => (),
        }
        sentences.extend(self.lost().map(|lost| proposal::IsLost { landmark: &["A", "B"][lost] }.say()));
        sentences
    }

    /// Half the range noise \[m\].
    pub fn half(&self) -> String {
        write(self.computed.half().range_std)
    }
}
