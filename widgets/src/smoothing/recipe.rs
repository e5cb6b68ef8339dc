//! What a reader can set about the filter and the sweeps.

use crate::{
    field,
    prediction::{self, Asks, Prediction, predicts},
    recipe::{self, Param},
    words::{common, smoothing as words},
};
use fastslam_lab::experiment::smoothing::{MOST, STEPS, SmoothingSetup};

/// Most particles.
pub const PARTICLES: u32 = 40;

/// Everything that a link can say.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers.
    pub setup: SmoothingSetup,
    /// The step of the drive that is looked at.
    pub at: u32,
    /// How many different poses the reader expects at step 1, after all sweeps.
    pub prediction: Prediction,
    /// After how many sweeps is looked.
    pub step: u32,
}

impl Default for Recipe {
    fn default() -> Self {
        // A seed on which the sweeps do what they do on most: they take a third off the error.
        let setup = SmoothingSetup { seed: 3, ..SmoothingSetup::default() };
        Self { setup, at: 12, prediction: Prediction::default(), step: MOST }
    }
}

predicts!(Recipe);

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let [predict, guess, run] = prediction::rows(Asks {
            predict_help: words::predict_help(),
            guess_help: words::guess_help(),
            unit: "",
            range: (1.0, MOST.into(), 1.0),
            run: [words::run(), words::run_help()],
        });
        vec![
            P::integer(
                "particles",
                words::particles(),
                "",
                (2, PARTICLES),
                field!(setup.particles),
                words::particles_help(),
            )
            .in_sight(),
            P::number(
                "odometry",
                common::odometry_noise(),
                "×",
                (0.25, 3.0, 0.05),
                field!(setup.odometry_scale),
                words::odometry_help(),
            ),
            P::number(
                "sensor",
                words::sensor(),
                "×",
                (0.25, 2.0, 0.05),
                field!(setup.sensor_scale),
                words::sensor_help(),
            )
            .in_sight(),
            P::flag("reconnect", words::reconnect(), field!(setup.reconnect), words::reconnect_help()),
            P::seed(field!(setup.seed), words::seed_help()),
            predict,
            guess,
            run,
            P::integer("at", words::at(), "", (1, STEPS), field!(at), words::at_help()).view(),
            P::integer("step", words::sweeps(), "", (0, MOST), field!(step), words::sweeps_help()).view(),
        ]
    }

    /// Another drive or other sweeps are another question. Who has answered it sees all of them.
    fn follow(&mut self, before: &Self) {
        if self.setup != before.setup && self.prediction == before.prediction {
            self.prediction.ask_anew();
        }
        if self.prediction.is_shown() && !before.prediction.is_shown() && self.step == before.step {
            self.step = MOST;
        }
    }
}
