//! What a reader can set about the step.

use crate::{
    field,
    recipe::{self, Field, Menu, Param},
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
        table()
    }
}

/// What a landmark's coordinate along an axis can be \[m\].
fn within(axis: usize) -> (f64, f64, f64) {
    (WORLD.low[axis] + MARGIN, WORLD.high[axis] - MARGIN, 0.05)
}

fn table() -> Vec<Param<Recipe>> {
    type P = Param<Recipe>;
    vec![
        P::number(
            "range-std",
            "Range noise σ",
            "m",
            (0.005, 0.5, 0.005),
            field!(setup.range_std),
            "Standard deviation of the measured range: sharp on the left, blunt on the right.",
        ),
        P::number(
            "bearing-std",
            "Bearing noise σ",
            "rad",
            (0.01, 0.3, 0.01),
            field!(setup.bearing_std),
            "Standard deviation of the measured bearing.",
        ),
        P::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.25, 2.0, 0.05),
            field!(setup.odometry_scale),
            "Factor on the standard deviations of what the wheels report.",
        ),
        P::integer(
            "samples",
            "Samples M",
            "",
            (1, MOST),
            field!(setup.samples),
            "How many samples each proposal draws.",
        ),
        P::seed(
            field!(setup.seed),
            "Picks the draws of both proposals; the same seed gives the same samples, bit for bit.",
        ),
        P::choice(
            "landmarks",
            "Landmarks",
            Menu::new([("one", "one: the sighting is of it", false), ("pair", "a pair: of which is unknown", true)]),
            field!(setup.twins),
            "One landmark, or two alike: then the sighting may be of either, and every sample decides for itself.",
        ),
        P::number(
            "landmark-x",
            "Landmark x",
            "m",
            within(0),
            field!(setup.landmark[0]),
            "Where the map has the landmark, ahead of the start.",
        )
        .without_slider(),
        P::number(
            "landmark-y",
            "Landmark y",
            "m",
            within(1),
            field!(setup.landmark[1]),
            "Where the map has the landmark, to the left of the start.",
        )
        .without_slider(),
        P::toggle(
            "predict",
            "Predict first",
            Field {
                get: |recipe| recipe.predict,
                set: |recipe, on| (recipe.predict, recipe.run) = (on, recipe.run && on),
            },
            "Asks how many times better the aware proposal's N_eff will be at half the range noise.",
        )
        .view(),
        P::number(
            "guess",
            "Your guess",
            "times",
            (RATIOS[0], RATIOS[1], 0.1),
            Field { get: |recipe| recipe.guess, set: Recipe::guess_at },
            "The ratio you expect at half the range noise; drag the marker on the scale, or type it.",
        )
        .without_slider(),
        P::toggle(
            "run",
            "Run at half σ",
            Field {
                get: |recipe| recipe.run,
                set: |recipe, on| (recipe.predict, recipe.run) = (recipe.predict || on, on),
            },
            "Runs both proposals at half the range noise, and shows guess against result.",
        )
        .view(),
    ]
}
