//! What a reader can set about the mapping of a log.

use crate::{
    field, policy,
    recipe::{self, Param},
};
use fastslam::{mapper::LaserMapperSettings, resampling::ResamplePolicy};

/// Everything that a link can say of the mapping of a log: the log itself is a reader's file.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers.
    pub setup: LaserMapperSettings,
    /// Of the policy "N_eff below", kept while another policy is chosen.
    pub threshold: f64,
    /// Maps a log with malformed lines without them.
    pub lenient: bool,
    /// Draws raw odometry.
    pub raw: bool,
}

impl Default for Recipe {
    fn default() -> Self {
        let setup = LaserMapperSettings::default();
        let threshold = policy::threshold(setup.policy);
        Self { setup, threshold, lenient: false, raw: false }
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
    vec![
        P::integer(
            "universes",
            "Universes M",
            "",
            (1, 256),
            field!(setup.particles),
            "How many particles the filter has: each is a path with a map of its own.",
        ),
        P::seed(field!(setup.seed), "Picks the filter's draws; the same log and seed give the same map, bit for bit."),
        P::number("cell", "Cell size", "m", (0.02, 0.2, 0.01), field!(setup.cell_size), "Side of a cell of the maps."),
        P::number(
            "max-range",
            "Longest range",
            "m",
            (1.0, 100.0, 1.0),
            field!(setup.max_range),
            "Beyond it a range only says that the way up to there is free.",
        ),
        P::number(
            "min-travel",
            "Skip scans until moved",
            "m",
            (0.0, 2.0, 0.05),
            field!(setup.min_travel),
            "A scan is passed over until the robot has driven this far, or turned by as many radians.",
        ),
        threshold,
        policy,
        P::flag(
            "lenient",
            "Skip malformed lines",
            field!(lenient),
            "Maps a log of which some lines cannot be read, without those lines.",
        )
        .view(),
        P::flag("raw", "Raw odometry", field!(raw), "Draws where the wheels alone would have led.").view(),
    ]
}
