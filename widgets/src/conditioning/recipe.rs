//! What a reader can set about the graphical model.

use crate::{
    field,
    recipe::{self, Field, Param},
    words::{common, conditioning},
};
use fastslam::error::Range;
use fastslam_lab::experiment::conditioning::{ConditioningSetup, LANDMARKS, POSES};

/// What of the path counts as known.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Given {
    /// Nothing but its start.
    Nothing,
    /// The last pose driven.
    LastPose,
    /// All of it.
    Path,
}

impl Given {
    /// After a button for `what` was pressed or let go: one of them holds at a time.
    fn switched(self, what: Self, on: bool) -> Self {
        match on {
            true => what,
            false if self == what => Self::Nothing,
            false => self,
        }
    }
}

/// Everything that a link can say of the graphical model.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// The drive.
    pub setup: ConditioningSetup,
    /// What of the path counts as known.
    pub given: Given,
    /// How many poses have been driven.
    pub step: usize,
    /// Row and column of the entry that is named, from 0 to 2 N − 1.
    pub entry: [usize; 2],
}

impl Default for Recipe {
    fn default() -> Self {
        let setup = ConditioningSetup::default();
        // The entry of two landmarks that no pose sees together.
        Self { step: setup.poses, setup, given: Given::Nothing, entry: [1, 7] }
    }
}

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let range = |range: Range| (range.least as u32, range.most as u32);
        vec![
            P::number(
                "odometry",
                common::odometry_noise(),
                "×",
                (0.0, 3.0, 0.05),
                field!(setup.odometry_scale),
                conditioning::odometry_help(),
            )
            .in_sight(),
            P::number(
                "range-std",
                conditioning::range_noise(),
                "m",
                (0.01, 0.5, 0.01),
                field!(setup.range_std),
                conditioning::range_help(),
            ),
            P::integer(
                "landmarks",
                conditioning::landmarks(),
                "",
                range(LANDMARKS),
                field!(setup.landmarks),
                conditioning::landmarks_help(),
            )
            .in_sight(),
            P::integer(
                "poses",
                conditioning::poses(),
                "",
                range(POSES),
                field!(setup.poses),
                conditioning::poses_help(),
            ),
            P::toggle(
                "condition",
                conditioning::condition(),
                Field {
                    get: |recipe| recipe.given == Given::Path,
                    set: |recipe, on| recipe.given = recipe.given.switched(Given::Path, on),
                },
                conditioning::condition_help(),
            )
            .in_sight()
            .view(),
            P::toggle(
                "last-pose",
                conditioning::last_pose(),
                Field {
                    get: |recipe| recipe.given == Given::LastPose,
                    set: |recipe, on| recipe.given = recipe.given.switched(Given::LastPose, on),
                },
                conditioning::last_pose_help(),
            )
            .in_sight()
            .view(),
            P::toggle("pairs", conditioning::pairs(), field!(setup.pairs), conditioning::pairs_help()).in_sight(),
            P::integer("step", common::step(), "", (0, 0), field!(step), conditioning::step_help())
                .at_most(|recipe| recipe.setup.poses as f64)
                .view(),
            P::integer(
                "row",
                conditioning::row(),
                "",
                (1, 1),
                Field { get: |recipe| recipe.entry[0] + 1, set: |recipe, row| recipe.entry[0] = row - 1 },
                conditioning::row_help(),
            )
            .folded()
            .at_most(entries)
            .without_slider()
            .view(),
            P::integer(
                "column",
                conditioning::column(),
                "",
                (1, 1),
                Field { get: |recipe| recipe.entry[1] + 1, set: |recipe, column| recipe.entry[1] = column - 1 },
                conditioning::column_help(),
            )
            .folded()
            .at_most(entries)
            .without_slider()
            .view(),
        ]
    }
}

/// Rows and columns of the covariance.
fn entries(recipe: &Recipe) -> f64 {
    2.0 * recipe.setup.landmarks as f64
}
