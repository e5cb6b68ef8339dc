//! What a reader can set about the graphical model.

use crate::{
    field,
    recipe::{self, Field, Param},
};
use fastslam::error::Range;
use fastslam_lab::experiment::conditioning::{ConditioningSetup, LANDMARKS, POSES};

/// Everything that a link can say of the graphical model.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// The drive.
    pub setup: ConditioningSetup,
    /// Whether the path counts as known.
    pub conditioned: bool,
    /// How many poses have been driven.
    pub step: usize,
    /// Row and column of the entry that is named, from 0 to 2 N − 1.
    pub entry: [usize; 2],
}

impl Default for Recipe {
    fn default() -> Self {
        let setup = ConditioningSetup::default();
        // The entry of two landmarks that no pose sees together.
        Self { step: setup.poses, setup, conditioned: false, entry: [1, 7] }
    }
}

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        table()
    }
}

/// Rows and columns of the covariance.
fn entries(recipe: &Recipe) -> f64 {
    2.0 * recipe.setup.landmarks as f64
}

fn table() -> Vec<Param<Recipe>> {
    type P = Param<Recipe>;
    let range = |range: Range| (range.least as u32, range.most as u32);
    vec![
        P::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.0, 3.0, 0.05),
            field!(setup.odometry_scale),
            "Factor on the standard deviations of the wheels’ noise: what is not known of the path, and so couples the map.",
        ),
        P::number(
            "range-std",
            "Range noise σ_r",
            "m",
            (0.01, 0.5, 0.01),
            field!(setup.range_std),
            "Standard deviation of each measured range.",
        ),
        P::integer(
            "landmarks",
            "Landmarks N",
            "",
            range(LANDMARKS),
            field!(setup.landmarks),
            "How many landmarks the drive comes by.",
        ),
        P::integer(
            "poses",
            "Poses T",
            "",
            range(POSES),
            field!(setup.poses),
            "In how many steps the same drive is made.",
        ),
        P::toggle(
            "condition",
            "Condition on the path",
            field!(conditioned),
            "Takes every pose for known, as each particle does: shows the covariance of the map given the path.",
        )
        .view(),
        P::integer("step", "Step", "", (0, 0), field!(step), "How many of the poses have been driven.")
            .at_most(|recipe| recipe.setup.poses as f64)
            .view(),
        P::integer(
            "row",
            "Row",
            "",
            (1, 1),
            Field { get: |recipe| recipe.entry[0] + 1, set: |recipe, row| recipe.entry[0] = row - 1 },
            "Row of the entry that is named: 1 is the x of the first landmark, 2 its y, 3 the x of the second.",
        )
        .at_most(entries)
        .without_slider()
        .view(),
        P::integer(
            "column",
            "Column",
            "",
            (1, 1),
            Field { get: |recipe| recipe.entry[1] + 1, set: |recipe, column| recipe.entry[1] = column - 1 },
            "Column of the entry that is named, counted as the rows are.",
        )
        .at_most(entries)
        .without_slider()
        .view(),
    ]
}
