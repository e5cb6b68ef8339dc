//! What a reader can set about the step.

use crate::{
    field,
    recipe::{self, Field, Menu, Param},
    words::{common, proposal},
};
use fastslam_lab::{baseline::one_step::Area, experiment::proposals::ProposalsSetup};

/// Part of the world that is looked at \[m\]: what both panels show, and where a landmark can be put.
pub const WORLD: Area = Area { low: [-0.25, -0.9], high: [2.95, 0.9] };

/// Ratios of N_eff that can be guessed.
pub const RATIOS: [f64; 2] = [1.0, 30.0];

/// Most samples of each proposal.
pub const MOST: u32 = 4096;

/// How near a landmark comes to the edge of a panel \[m\].
const MARGIN: f64 = 0.15;

/// Everything that a link can say of the step.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers.
    pub setup: ProposalsSetup,
    /// Whether the reader is asked to predict.
    pub predict: bool,
    /// The ratio the reader expects at half the range noise.
    pub guess: f64,
    /// Whether it was run.
    pub run: bool,
}

impl Default for Recipe {
    fn default() -> Self {
        Self { setup: ProposalsSetup::default(), predict: false, guess: 2.0, run: false }
    }
}

impl Recipe {
    /// Another guess is another try.
    pub fn guess_at(&mut self, guess: f64) {
        let guess = guess.clamp(RATIOS[0], RATIOS[1]);
        (self.run, self.guess) = (self.run && self.guess == guess, guess);
    }
}

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        vec![
            P::number(
                "range-std",
                common::range_noise(),
                "m",
                (0.005, 0.5, 0.005),
                field!(setup.range_std),
                proposal::range_help(),
            ),
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
                "× α",
                (0.25, 2.0, 0.05),
                field!(setup.odometry_scale),
                proposal::odometry_help(),
            ),
            P::integer("samples", proposal::samples(), "", (1, MOST), field!(setup.samples), proposal::samples_help()),
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
            P::toggle(
                "predict",
                proposal::predict(),
                Field {
                    get: |recipe| recipe.predict,
                    set: |recipe, on| (recipe.predict, recipe.run) = (on, recipe.run && on),
                },
                proposal::predict_help(),
            )
            .view(),
            P::number(
                "guess",
                proposal::guess(),
                proposal::times(),
                (RATIOS[0], RATIOS[1], 0.1),
                Field { get: |recipe| recipe.guess, set: Recipe::guess_at },
                proposal::guess_help(),
            )
            .without_slider(),
            P::toggle(
                "run",
                proposal::run(),
                Field {
                    get: |recipe| recipe.run,
                    set: |recipe, on| (recipe.predict, recipe.run) = (recipe.predict || on, on),
                },
                proposal::run_help(),
            )
            .view(),
        ]
    }
}

/// What a landmark's coordinate along an axis can be \[m\].
fn within(axis: usize) -> (f64, f64, f64) {
    (WORLD.low[axis] + MARGIN, WORLD.high[axis] - MARGIN, 0.05)
}
