//! What a reader can set about the two filters.

use crate::{
    field,
    prediction::{self, Asks, Prediction, predicts},
    recipe::{self, Param},
    words::{common, joint},
};
use fastslam_lab::experiment::joint::{JointSetup, MOST};

/// Most particles.
pub const PARTICLES: u32 = 20_000;

/// Everything that a link can say.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers.
    pub setup: JointSetup,
    /// After how many landmarks is looked.
    pub landmarks: u32,
    /// The first landmark at which the reader expects the sampled map's particles to be worth less than one.
    pub prediction: Prediction,
}

impl Default for Recipe {
    fn default() -> Self {
        Self { setup: JointSetup::default(), landmarks: MOST, prediction: Prediction::default() }
    }
}

predicts!(Recipe);

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let [predict, guess, run] = prediction::rows(Asks {
            predict_help: joint::predict_help(),
            guess_help: joint::guess_help(),
            unit: "",
            range: (1.0, MOST.into(), 1.0),
            run: [joint::run(), joint::run_help()],
        });
        vec![
            P::integer("landmarks", joint::landmarks(), "", (1, MOST), field!(landmarks), joint::landmarks_help())
                .in_sight(),
            P::integer(
                "particles",
                joint::particles(),
                "",
                (1, PARTICLES),
                field!(setup.particles),
                joint::particles_help(),
            )
            .in_sight(),
            P::number(
                "sensor",
                joint::sensor(),
                "×",
                (0.25, 5.0, 0.05),
                field!(setup.sensor_scale),
                joint::sensor_help(),
            ),
            P::number(
                "odometry",
                common::odometry_noise(),
                "×",
                (0.0, 3.0, 0.05),
                field!(setup.odometry_scale),
                joint::odometry_help(),
            ),
            P::seed(field!(setup.seed), joint::seed_help()),
            predict,
            guess,
            run,
        ]
    }

    /// Other filters are another question.
    fn follow(&mut self, before: &Self) {
        if self.setup != before.setup && self.prediction == before.prediction {
            self.prediction.ask_anew();
        }
    }
}
