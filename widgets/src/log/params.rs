//! What a reader can set about the mapping of a log.

use crate::{model::ParamSpec, policy};
use fastslam::mapper::LaserMapperSettings;

/// Least and most of each number, and the step of its slider.
const CELL: (f64, f64, f64) = (0.02, 0.2, 0.01);
const RANGE: (f64, f64, f64) = (1.0, 100.0, 1.0);
const TRAVEL: (f64, f64, f64) = (0.0, 2.0, 0.05);

/// All parameters.
pub fn specs() -> Vec<ParamSpec> {
    let LaserMapperSettings { particles, seed, cell_size, max_range, min_travel, policy: selected, .. } =
        LaserMapperSettings::default();
    vec![
        ParamSpec::integer(
            "universes",
            "Universes M",
            "",
            (1, 256),
            particles as i64,
            "How many particles the filter has: each is a path with a map of its own.",
        ),
        ParamSpec::integer(
            "seed",
            "Seed",
            "",
            (0, u32::MAX.into()),
            seed as i64,
            "Picks the filter's draws; the same log and seed give the same map, bit for bit.",
        ),
        ParamSpec::number("cell", "Cell size", "m", CELL, cell_size, "Side of a cell of the maps."),
        ParamSpec::number(
            "max-range",
            "Longest range",
            "m",
            RANGE,
            max_range,
            "Beyond it a range only says that the way up to there is free.",
        ),
        ParamSpec::number(
            "min-travel",
            "Skip scans until moved",
            "m",
            TRAVEL,
            min_travel,
            "A scan is passed over until the robot has driven this far, or turned by as many radians.",
        ),
        ParamSpec::number(
            "threshold",
            "Threshold",
            "of M",
            (0.0, 1.0, 0.05),
            policy::threshold(selected),
            "Share of M below which N_eff calls for resampling, under the policy neff.",
        ),
        ParamSpec::choice(
            "policy",
            "Resample",
            policy::POLICIES,
            policy::name(selected),
            "When the universes are resampled.",
        ),
        ParamSpec::flag(
            "lenient",
            "Skip malformed lines",
            false,
            "Maps a log of which some lines cannot be read, without those lines.",
        )
        .view(),
        ParamSpec::flag("raw", "Raw odometry", false, "Draws where the wheels alone would have led.").view(),
    ]
}
