//! What a reader can set about the lap.

use crate::{
    field, policy,
    recipe::{self, Menu, Param},
    words,
};
use fastslam::resampling::ResamplePolicy;
use fastslam_lab::experiment::lap::{LapSetup, STEPS};

/// Everything that a link can say of the lap.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers.
    pub setup: LapSetup,
    /// Of the policy "N_eff below", kept while another policy is chosen.
    pub threshold: f64,
    /// The step asked for.
    pub step: u32,
    /// The universe chosen for the large view; `None` is the best.
    pub universe: Option<u32>,
    /// Whether the truth is drawn.
    pub truth: bool,
    /// Whether raw odometry is drawn.
    pub raw: bool,
}

impl Default for Recipe {
    fn default() -> Self {
        let setup = LapSetup::default();
        let threshold = policy::threshold(setup.policy);
        Self { setup, threshold, step: 0, universe: None, truth: false, raw: false }
    }
}

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        table()
    }
}

impl policy::Chosen for Recipe {
    fn chosen(&self) -> (ResamplePolicy, f64) {
        (self.setup.policy, self.threshold)
    }

    fn choose(&mut self, policy: ResamplePolicy, threshold: f64) {
        (self.setup.policy, self.threshold) = (policy, threshold);
    }
}

fn table() -> Vec<Param<Recipe>> {
    type P = Param<Recipe>;
    let [policy, threshold] = policy::rows();
    let usual = LapSetup::default();
    vec![
        P::integer(
            "universes",
            "Universes M",
            "",
            (1, 256),
            field!(setup.particles),
            "How many particles the filter has: each is a path with a map of its own.",
        ),
        P::seed(
            field!(setup.seed),
            "Picks the noise of the world and of the filter; the same seed gives the same lap, bit for bit.",
        ),
        P::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.0, 2.0, 0.05),
            field!(setup.odometry_scale),
            "Factor on the standard deviations of the wheels' noise, in the world and in what the filter expects.",
        ),
        P::number(
            "range-std",
            "Range noise σ",
            "m",
            (0.01, 0.3, 0.01),
            field!(setup.range_std),
            "Standard deviation of each measured range.",
        ),
        P::choice(
            "proposal",
            "Proposal",
            Menu::of(usual.proposal, words::proposal),
            field!(setup.proposal),
            "Where new poses are drawn from: near the scan's best match, or from the motion model alone.",
        ),
        P::choice(
            "matcher",
            "Matcher",
            Menu::of(usual.matcher, words::matcher),
            field!(setup.matcher),
            "What the end of a beam is compared with: the mean of the hits in a cell, or the cell as a whole.",
        ),
        policy,
        threshold,
        P::choice(
            "scheme",
            "Scheme",
            Menu::of(usual.scheme, words::scheme),
            field!(setup.scheme),
            "How the survivors are drawn.",
        ),
        P::integer("step", "Step", "", (0, STEPS as u32), field!(step), "The step shown.").view(),
        P::integer_or(
            "universe",
            "Universe shown large",
            ("best", "the best"),
            |recipe| recipe.setup.particles as f64 - 1.0,
            field!(universe),
            "The slot shown large; best, or −1, is the one of the largest weight along its path.",
        )
        .view(),
        P::flag(
            "truth",
            "Truth",
            field!(truth),
            "Draws the true path and the walls of the apartment, which the filter never sees.",
        )
        .view(),
        P::flag("raw", "Raw odometry", field!(raw), "Draws where the wheels alone would have led.").view(),
    ]
}
