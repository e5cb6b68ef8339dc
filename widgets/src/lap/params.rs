//! What a reader can set about the lap.

use crate::{
    model::{Choice, ParamSpec},
    policy,
};
use fastslam_lab::experiment::lap::{LapSetup, STEPS};

const PROPOSALS: &[Choice] = &[
    Choice { value: "aware", title: "measurement-aware" },
    Choice { value: "motion", title: "motion model only (FastSLAM 1.0)" },
];

const MATCHERS: &[Choice] = &[
    Choice { value: "subcell", title: "sub-cell (a Gaussian per cell)" },
    Choice { value: "cell", title: "cell (occupancy)" },
];

const SCHEMES: &[Choice] = &[
    Choice { value: "systematic", title: "systematic" },
    Choice { value: "stratified", title: "stratified" },
    Choice { value: "multinomial", title: "multinomial" },
    Choice { value: "residual", title: "residual" },
];

const BEST: &[Choice] = &[Choice { value: "best", title: "the best" }];

/// All parameters, for a mosaic of `universes`.
pub fn specs(universes: usize) -> Vec<ParamSpec> {
    let LapSetup { particles, seed, proposal, matcher, policy: selected, scheme, odometry_scale, range_std, .. } =
        LapSetup::default();
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
            "Picks the noise of the world and of the filter; the same seed gives the same lap, bit for bit.",
        ),
        ParamSpec::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.0, 2.0, 0.05),
            odometry_scale,
            "Factor on the standard deviations of the wheels' noise, in the world and in what the filter expects.",
        ),
        ParamSpec::number(
            "range-std",
            "Range noise σ",
            "m",
            (0.01, 0.3, 0.01),
            range_std,
            "Standard deviation of each measured range.",
        ),
        ParamSpec::choice(
            "proposal",
            "Proposal",
            PROPOSALS,
            proposal.to_string(),
            "Where new poses are drawn from: near the scan's best match, or from the motion model alone.",
        ),
        ParamSpec::choice(
            "matcher",
            "Matcher",
            MATCHERS,
            matcher.to_string(),
            "What the end of a beam is compared with: the mean of the hits in a cell, or the cell as a whole.",
        ),
        ParamSpec::choice(
            "policy",
            "Resample",
            policy::POLICIES,
            policy::name(selected),
            "When the universes are resampled.",
        ),
        ParamSpec::number(
            "threshold",
            "Threshold",
            "of M",
            (0.0, 1.0, 0.05),
            policy::threshold(selected),
            "Share of M below which N_eff calls for resampling, under the policy neff.",
        ),
        ParamSpec::choice("scheme", "Scheme", SCHEMES, scheme.to_string(), "How the survivors are drawn."),
        ParamSpec::integer("step", "Step", "", (0, STEPS as i64), 0, "The step shown.").view(),
        ParamSpec::integer(
            "universe",
            "Universe shown large",
            "",
            (-1, universes as i64 - 1),
            -1,
            "The slot shown large; best, or −1, is the one of the largest weight along its path.",
        )
        .or_words(BEST)
        .view(),
        ParamSpec::flag(
            "truth",
            "Truth",
            false,
            "Draws the true path and the walls of the apartment, which the filter never sees.",
        )
        .view(),
        ParamSpec::flag("raw", "Raw odometry", false, "Draws where the wheels alone would have led.").view(),
    ]
}
