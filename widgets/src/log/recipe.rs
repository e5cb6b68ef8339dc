//! What a reader can set about the mapping of a log.

use crate::{
    field, policy,
    recipe::{self, Param},
    words::{common, log},
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
    /// Lays the same scans out along raw odometry, over the map.
    pub odometry: bool,
}

impl Default for Recipe {
    fn default() -> Self {
        let setup = LaserMapperSettings::default();
        let threshold = policy::threshold(setup.policy);
        Self { setup, threshold, lenient: false, raw: true, odometry: false }
    }
}

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let [policy, threshold] = policy::rows();
        vec![
            P::integer(
                "universes",
                common::universes(),
                "",
                (1, 256),
                field!(setup.particles),
                common::universes_help(),
            )
            .in_sight(),
            P::seed(field!(setup.seed), log::seed_help()),
            P::number("cell", log::cell(), "m", (0.02, 0.2, 0.01), field!(setup.cell_size), log::cell_help()),
            P::number(
                "max-range",
                log::max_range(),
                "m",
                (1.0, 100.0, 1.0),
                field!(setup.max_range),
                log::max_range_help(),
            )
            .folded(),
            P::number(
                "min-travel",
                log::min_travel(),
                "m",
                (0.0, 2.0, 0.05),
                field!(setup.min_travel),
                log::min_travel_help(),
            )
            .folded(),
            threshold.folded(),
            policy,
            P::flag("lenient", log::lenient(), field!(lenient), log::lenient_help()).view().folded(),
            P::flag("raw", common::raw_odometry(), field!(raw), common::raw_odometry_help()).view(),
            P::flag("odometry", log::odometry(), field!(odometry), log::odometry_help()).view(),
        ]
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
