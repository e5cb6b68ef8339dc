//! What is told of both methods in numbers and in words.

use super::{challenges, model::EmModel, recipe::FILLS};
use crate::{
    challenge::Challenge,
    decimal::{fixed, write},
    model::{Column, Readout, Series, Tells},
    prediction::State,
    words::em as words,
};
use fastslam_lab::experiment::em::{self as lab, AGAIN_BELOW, DOORS};

/// A share in percent.
pub fn percent(share: f64) -> String {
    fixed(100.0 * share, 0)
}

impl Tells for EmModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let (shown, doors) = (self.shown(), self.doors().len());
        let entropy = self.entropy().unwrap_or(f64::NAN);
        let (place, again) = self.put_down().unwrap_or((f64::NAN, f64::NAN));
        let particles = 100.0 * self.again().unwrap_or(f64::NAN);
        let ends = self.others().ends();
        let best = ends.iter().map(|end| end.log_posterior).fold(f64::NAN, f64::max);
        let (rank, nats) = (self.rank(), |x: f64| fixed(x, 1));
        vec![
            Readout::new("iteration", words::iteration(), rank.into(), rank.to_string(), "", words::iteration_help()),
            Readout::new(
                "log_posterior",
                words::log_posterior(),
                shown.log_posterior,
                nats(shown.log_posterior),
                "nats",
                words::log_posterior_help(),
            )
            .drawn(),
            Readout::new(
                "log_likelihood",
                words::log_likelihood(),
                shown.log_likelihood,
                nats(shown.log_likelihood),
                "nats",
                words::log_likelihood_help(),
            ),
            Readout::new("entropy", words::entropy(), entropy, nats(entropy), "nats", words::entropy_help()),
            Readout::new(
                "doors",
                words::doors(),
                doors as f64,
                words::OfDoors { n: &doors, all: &DOORS }.say(),
                "",
                words::doors_help(),
            )
            .drawn(),
            Readout::new("put_down", words::put_down(), place, fixed(place, 1), "m", words::put_down_help()),
            Readout::new("again_em", words::again_em(), 100.0 * again, percent(again), "%", words::again_em_help()),
            Readout::new("again", words::again(), particles, fixed(particles, 0), "%", words::again_help()).drawn(),
            Readout::new(
                "again_others",
                words::again_others(),
                ends.iter().filter(|end| end.again > 0.5).count() as f64,
                words::OfGuesses { n: &ends.iter().filter(|end| end.again > 0.5).count(), all: &ends.len() }.say(),
                "",
                words::again_others_help(),
            ),
            Readout::new("best", words::best(), best, nats(best), "nats", words::best_help()).drawn(),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("iteration", "iterations made"),
            Column::new("log_posterior", "ln p(z | m) + ln p(m), but for a constant [nats]"),
            Column::new("log_likelihood", "ln p(z | m) [nats]"),
            Column::new("doors", "doors of the map"),
        ];
        let row = |(rank, iterate): (usize, &fastslam_lab::experiment::em::Iterate)| {
            let doors = fastslam_lab::experiment::em::doors(&iterate.map).len();
            vec![rank as f64, iterate.log_posterior, iterate.log_likelihood, doors as f64]
        };
        Series { columns: COLUMNS.into(), rows: self.iterates().iter().enumerate().map(row).collect() }
    }

    fn describe(&self) -> String {
        let (now, shown) = (self.now(), self.shown());
        let (n, all) = (&(now.iteration + 1), &self.iterations());
        let doors = &self.doors().len();
        let value = &fixed(shown.log_posterior, 1);
        let em = match now.ticks {
            0 => words::Begins { doors }.say(),
            ticks if ticks <= FILLS => words::ToldForward { n, all }.say(),
            _ if !now.has_product() => words::ToldBackward { n, all }.say(),
            _ => {
                let (place, again) = self.put_down().unwrap_or_default();
                let place = &fixed(place, 1);
                let answer =
                    if again > 0.5 { words::SaysAgain { place }.say() } else { words::SaysNew { place }.say() };
                let done = if !now.has_map() {
                    words::ToldProduct { n, all }.say()
                } else if self.is_still() {
                    words::Still { n, doors, value }.say()
                } else {
                    words::Moving { n, doors, value }.say()
                };
                [done, answer].into_iter().chain(by_future(self)).collect::<Vec<_>>().join(" ")
            }
        };
        let particles =
            self.again().map(|again| words::ToldParticles { new: &percent(1.0 - again), again: &percent(again) }.say());
        judged(self).into_iter().chain([em]).chain(particles).collect::<Vec<_>>().join(" ")
    }

    fn narrate(&self) -> String {
        if let Some(judged) = judged(self) {
            return judged;
        }
        let now = self.now();
        match (now.ticks, self.put_down()) {
            (0, _) => words::NBegins { doors: &self.doors().len() }.say(),
            (ticks, _) if ticks <= FILLS => words::n_forward().into(),
            (_, Some(_)) if let Some(told) = by_future(self) => told,
            (_, Some((place, again))) if now.has_product() => {
                let place = &fixed(place, 1);
                if again > 0.5 { words::NAgain { place }.say() } else { words::NNew { place }.say() }
            }
            _ => words::n_backward().into(),
        }
    }
}

/// What is said of the prediction, if one is asked for.
fn judged(model: &EmModel) -> Option<String> {
    Some(match (model.state(), model.end()) {
        (State::Off, _) | (State::Guessed(_) | State::Waived, None) => return None,
        (State::Asked, _) => words::asks().into(),
        (State::Placed(guess), _) => words::Placed { guess: &write(guess) }.say(),
        (State::Guessed(guess), Some((place, again))) => {
            let (guess_text, place) = (&write(guess), &fixed(place, 1));
            match (guess < AGAIN_BELOW) == (again > 0.5) {
                true => words::CameAsGuessed { place, guess: guess_text }.say(),
                false => words::CameOtherwise { place, guess: guess_text }.say(),
            }
        }
        (State::Waived, Some((place, _))) => words::CameAlone { place: &fixed(place, 1) }.say(),
    })
}

/// What the readings that are asked for say of the moment in which the robot was put down, where those are not all.
fn by_future(model: &EmModel) -> Option<String> {
    let n = &model.future()?;
    let again = lab::again(&model.column(model.log().carried)?);
    Some(words::ByFuture { n, new: &percent(1.0 - again), again: &percent(again) }.say())
}
