//! What a reader can set: when a lap has ended well, whose laps are shown, how long the rule runs, and the one step of the depletion.

use super::shipped::LAPS;
use crate::{
    decimal::rounded,
    field,
    prediction::{self, Asks, Prediction, predicts},
    recipe::{self, Field, Menu, Param},
    words::{common, universes},
};
use fastslam_lab::experiment::{
    ProposalKind,
    proposal::ProposalsSetup,
    universes::{Rule, TRIED, WELL},
};

/// The step at which the last lap has come: one comes with each.
pub const LAST: u32 = LAPS as u32 - 1;

/// Largest number of universes that was tried.
pub const MOST: u32 = TRIED[TRIED.len() - 1] as u32;

/// Range noises \[m\] of the depletion's axis: those of the proposals' figure.
pub const NOISES: [f64; 2] = [0.005, 0.5];

/// Everything that a link can say.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// A lap that ends with a smaller error has ended well \[m\].
    pub threshold: f64,
    /// The only proposal that is shown, if it is one.
    pub only: Option<ProposalKind>,
    /// Four fifths of so many seeds.
    pub rule: Rule,
    /// How many laps are in the charts, but for the first.
    pub step: u32,
    /// The number of universes that is read.
    pub universes: u32,
    /// The step of the depletion, but for its range noise.
    pub setup: ProposalsSetup,
    /// The number of universes that the reader expects the motion prior to need.
    pub prediction: Prediction,
    /// The same for the measurement-aware proposal.
    pub guess_aware: Option<f64>,
    /// N_eff / M \[%\] that the reader expects of the sharpest sensor.
    pub guess_floor: Option<f64>,
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            threshold: WELL,
            only: None,
            rule: Rule { seeds: 5 },
            step: LAST,
            universes: 8,
            setup: ProposalsSetup::default(),
            prediction: Prediction::default(),
            guess_aware: None,
            guess_floor: None,
        }
    }
}

impl Recipe {
    /// Whether a proposal is shown.
    pub fn shows(&self, proposal: ProposalKind) -> bool {
        self.only.is_none_or(|only| only == proposal)
    }

    /// Rank among the numbers tried of the one that is nearest to what is read.
    pub fn rank(&self) -> usize {
        nearest(f64::from(self.universes))
    }

    fn others(&self) -> [Option<f64>; 2] {
        [self.guess_aware, self.guess_floor]
    }
}

/// Rank of the number of universes, of those tried, that is nearest on an axis where twice is as far everywhere.
pub fn nearest(universes: f64) -> usize {
    let past = |k: &usize| (TRIED[*k] * TRIED[k + 1]) as f64 <= universes * universes;
    (0..TRIED.len() - 1).rfind(past).map_or(0, |k| k + 1)
}

predicts!(Recipe);

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let threshold = Field {
            get: |recipe: &Recipe| recipe.threshold,
            set: |recipe: &mut Recipe, x| recipe.threshold = rounded(x, 3),
        };
        let only = [
            ("both", universes::both(), None),
            ("motion", universes::motion(), Some(ProposalKind::Motion)),
            ("aware", universes::aware(), Some(ProposalKind::Improved)),
        ];
        let [predict, guess, run] = prediction::rows(Asks {
            predict_help: universes::predict_help(),
            guess_help: universes::guess_help(),
            unit: "",
            range: (1.0, MOST.into(), 1.0),
            run: [universes::run(), universes::run_help()],
        });
        let also = |name, title, unit, range, field, help| {
            P::number_or(name, title, unit, range, ("none", prediction::no_guess()), field, help)
                .view()
                .without_slider()
                .only_where(prediction::is_asked)
        };
        vec![
            P::number(
                "threshold",
                universes::threshold(),
                "m",
                (0.03, 2.0, 0.01),
                threshold,
                universes::threshold_help(),
            )
            .in_sight(),
            P::integer("seeds", universes::seeds(), "", (1, 100), field!(rule.seeds), universes::seeds_help()),
            P::integer(
                "universes",
                universes::universes(),
                "",
                (1, MOST),
                field!(universes),
                universes::universes_help(),
            )
            .in_sight()
            .view(),
            P::choice("proposals", universes::proposals(), Menu::new(only), field!(only), universes::proposals_help())
                .view(),
            P::number(
                "bearing-std",
                universes::bearing(),
                "rad",
                (0.01, 0.3, 0.01),
                field!(setup.bearing_std),
                universes::bearing_help(),
            )
            .folded(),
            P::number(
                "odometry",
                common::odometry_noise(),
                "×",
                (0.25, 2.0, 0.05),
                field!(setup.odometry_scale),
                universes::odometry_help(),
            )
            .folded(),
            predict,
            guess,
            also(
                "guess-aware",
                universes::guess_aware(),
                "",
                (1.0, MOST.into(), 1.0),
                field!(guess_aware),
                universes::guess_aware_help(),
            ),
            also(
                "guess-floor",
                universes::guess_floor(),
                "%",
                (0.0, 100.0, 1.0),
                field!(guess_floor),
                universes::guess_floor_help(),
            ),
            run,
            P::integer("step", common::step(), "", (0, LAST), field!(step), universes::step_help()).view(),
        ]
    }

    /// All guesses are placed, judged and forgotten together.
    fn follow(&mut self, before: &Self) {
        let same = self.prediction == before.prediction && self.others() == before.others();
        if same && (self.threshold, &self.setup) != (before.threshold, &before.setup) {
            self.prediction.ask_anew();
            (self.guess_aware, self.guess_floor) = (None, None);
        } else if self.others() != before.others() {
            // Another guess than before is another try; one that comes with all of a link is none.
            self.prediction.run &= self.prediction != before.prediction;
        } else if !self.prediction.predict
            || (before.prediction.run && self.prediction.state() == prediction::State::Asked)
        {
            (self.guess_aware, self.guess_floor) = (None, None);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_read_is_the_nearest_that_was_tried() {
        let read = [1.0, 1.4, 1.5, 5.0, 7.0, 27.0, 28.0, 40.0, 1e9].map(|m| TRIED[nearest(m)]);
        assert_eq!(read, [1, 1, 2, 6, 8, 24, 32, 40, 40]);
        assert_eq!(TRIED[nearest(f64::NAN)], 1);
    }
}
