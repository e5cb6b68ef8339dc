//! What a reader can set about the step.

use crate::{
    field,
    prediction::{self, Asks, Prediction, predicts},
    recipe::{self, Menu, Param},
    words::{common, proposal},
};
use fastslam_lab::{baseline::one_step::Area, experiment::proposal::ProposalsSetup};

/// Part of the world that is looked at \[m\]: what both panels show, and where a landmark can be put.
pub const WORLD: Area = Area { low: [-0.25, -0.9], high: [2.95, 0.9] };

/// Ratios of N_eff that can be guessed.
pub const RATIOS: [f64; 2] = [1.0, 30.0];

/// Most samples of each proposal.
pub const MOST: u32 = 4096;

/// How near a landmark comes to the edge of a panel \[m\].
const MARGIN: f64 = 0.15;

/// Everything that a link can say of the step.
#[derive(Clone, PartialEq, Default)]
pub struct Recipe {
    /// What decides the numbers.
    pub setup: ProposalsSetup,
    /// The ratio that the reader expects at half the range noise.
    pub prediction: Prediction,
}

impl Recipe {
    /// What the figure shows: the step as it was set, or once the prediction is judged, at half the range noise.
    pub fn shown(&self) -> ProposalsSetup {
        if self.prediction.is_shown() { self.half() } else { self.setup.clone() }
    }

    /// The step at half the range noise.
    pub fn half(&self) -> ProposalsSetup {
        ProposalsSetup { range_std: 0.5 * self.setup.range_std, ..self.setup.clone() }
    }

    /// Places a guess, or the nearest that there can be.
    pub fn guess_at(&mut self, guess: f64) {
        self.prediction.place(Some(guess.clamp(RATIOS[0], RATIOS[1])));
    }
}

predicts!(Recipe);

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let mut table = vec![
            P::number(
                "range-std",
                common::range_noise(),
                "m",
                (0.005, 0.5, 0.005),
                field!(setup.range_std),
                proposal::range_help(),
            )
            .in_sight(),
            P::number(
                "bearing-std",
                proposal::bearing_noise(),
                "rad",
                (0.01, 0.3, 0.01),
                field!(setup.bearing_std),
                proposal::bearing_help(),
            ),
            P::number(
                "odometry",
                common::odometry_noise(),
                "×",
                (0.25, 2.0, 0.05),
                field!(setup.odometry_scale),
                proposal::odometry_help(),
            ),
            P::integer("samples", proposal::samples(), "", (1, MOST), field!(setup.samples), proposal::samples_help())
                .in_sight(),
            P::seed(field!(setup.seed), proposal::seed_help()),
            P::choice(
                "landmarks",
                proposal::landmarks(),
                Menu::new([("one", proposal::one(), false), ("pair", proposal::pair(), true)]),
                field!(setup.twins),
                proposal::landmarks_help(),
            ),
            P::number(
                "landmark-x",
                proposal::landmark_x(),
                "m",
                within(0),
                field!(setup.landmark[0]),
                proposal::landmark_x_help(),
            )
            .folded()
            .without_slider(),
            P::number(
                "landmark-y",
                proposal::landmark_y(),
                "m",
                within(1),
                field!(setup.landmark[1]),
                proposal::landmark_y_help(),
            )
            .folded()
            .without_slider(),
        ];
        table.extend(prediction::rows(Asks {
            predict_help: proposal::predict_help(),
            guess_help: proposal::guess_help(),
            unit: proposal::times(),
            range: (RATIOS[0], RATIOS[1], 0.1),
            run: [proposal::run(), proposal::run_help()],
        }));
        table
    }

    /// Another step is another question.
    fn follow(&mut self, before: &Self) {
        if self.setup != before.setup && self.prediction == before.prediction {
            self.prediction.ask_anew();
        }
    }
}

/// What a landmark's coordinate along an axis can be \[m\].
fn within(axis: usize) -> (f64, f64, f64) {
    (WORLD.low[axis] + MARGIN, WORLD.high[axis] - MARGIN, 0.05)
}
