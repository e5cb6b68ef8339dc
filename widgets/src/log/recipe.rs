//! What a reader can set about the mapping of a log.

use crate::{
    field, policy,
    recipe::{self, Field, Param},
};
use fastslam::mapper::LaserMapperSettings;
use std::sync::LazyLock;

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
    fn table() -> &'static [Param<Self>] {
        static TABLE: LazyLock<Vec<Param<Recipe>>> = LazyLock::new(table);
        &TABLE
    }
}

fn table() -> Vec<Param<Recipe>> {
    type P = Param<Recipe>;
    vec![
        P::integer(
            "universes",
            "Universes M",
            "",
            (1, 256),
            field!(setup.particles),
            "How many particles the filter has: each is a path with a map of its own.",
        ),
        P::integer(
            "seed",
            "Seed",
            "",
            (0, u32::MAX),
            field!(setup.seed),
            "Picks the filter's draws; the same log and seed give the same map, bit for bit.",
        ),
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
        P::number(
            "threshold",
            "Threshold",
            "of M",
            (0.0, 1.0, 0.05),
            Field {
                get: |recipe| recipe.threshold,
                set: |recipe, threshold| {
                    recipe.threshold = threshold;
                    recipe.setup.policy = policy::kind(recipe.setup.policy).with(threshold);
                },
            },
            "Share of M below which N_eff calls for resampling, under the policy neff.",
        ),
        P::choice(
            "policy",
            "Resample",
            policy::menu(),
            Field {
                get: |recipe| policy::kind(recipe.setup.policy),
                set: |recipe, kind| recipe.setup.policy = kind.with(recipe.threshold),
            },
            "When the universes are resampled.",
        ),
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
