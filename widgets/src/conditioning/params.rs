//! What a reader can set about the graphical model.

use crate::model::ParamSpec;
use fastslam::error::Range;
use fastslam_lab::experiment::conditioning::{ConditioningSetup, LANDMARKS, POSES};

/// The entry named at first, counted from 0: of two landmarks that no pose sees together.
pub const ENTRY: [usize; 2] = [1, 7];

/// All parameters, for a drive of so many poses past so many landmarks.
pub fn specs(setup: &ConditioningSetup) -> Vec<ParamSpec> {
    let ConditioningSetup { landmarks, poses, odometry_scale, range_std } = ConditioningSetup::default();
    let range = |range: Range| (range.least as i64, range.most as i64);
    let entry = |name, title, default: usize, help| {
        let entries = (1, 2 * setup.landmarks as i64);
        ParamSpec::integer(name, title, "", entries, default as i64 + 1, help).without_slider().view()
    };
    vec![
        ParamSpec::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.0, 3.0, 0.05),
            odometry_scale,
            "Factor on the standard deviations of the wheels’ noise: what is not known of the path, and so couples the map.",
        ),
        ParamSpec::number(
            "range-std",
            "Range noise σ_r",
            "m",
            (0.01, 0.5, 0.01),
            range_std,
            "Standard deviation of each measured range.",
        ),
        ParamSpec::integer(
            "landmarks",
            "Landmarks N",
            "",
            range(LANDMARKS),
            landmarks as i64,
            "How many landmarks the drive comes by.",
        ),
        ParamSpec::integer(
            "poses",
            "Poses T",
            "",
            range(POSES),
            poses as i64,
            "In how many steps the same drive is made.",
        ),
        ParamSpec::toggle(
            "condition",
            "Condition on the path",
            false,
            "Takes every pose for known, as each particle does: shows the covariance of the map given the path.",
        )
        .view(),
        ParamSpec::integer(
            "step",
            "Step",
            "",
            (0, setup.poses as i64),
            poses as i64,
            "How many of the poses have been driven.",
        )
        .view(),
        entry(
            "row",
            "Row",
            ENTRY[0],
            "Row of the entry that is named: 1 is the x of the first landmark, 2 its y, 3 the x of the second.",
        ),
        entry("column", "Column", ENTRY[1], "Column of the entry that is named, counted as the rows are."),
    ]
}
