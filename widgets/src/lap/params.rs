//! What a reader can set about the lap.

use crate::model::{Choice, Group, Kind, ParamSpec};
use fastslam::{
    decimal::write,
    experiment::lap::{LapSetup, STEPS},
    resampling::ResamplePolicy,
};

/// Threshold of the policy "N_eff below", where another policy is chosen.
pub const THRESHOLD: f64 = 0.5;

const PROPOSALS: &[Choice] = &[
    Choice { value: "aware", title: "measurement-aware" },
    Choice { value: "motion", title: "motion model only (FastSLAM 1.0)" },
];

const MATCHERS: &[Choice] =
    &[Choice { value: "subcell", title: "sub-cell (hit means)" }, Choice { value: "cell", title: "cell (occupancy)" }];

const POLICIES: &[Choice] = &[
    Choice { value: "neff", title: "N_eff below threshold" },
    Choice { value: "always", title: "at every step" },
    Choice { value: "never", title: "never" },
];

const SCHEMES: &[Choice] = &[
    Choice { value: "systematic", title: "systematic" },
    Choice { value: "stratified", title: "stratified" },
    Choice { value: "multinomial", title: "multinomial" },
    Choice { value: "residual", title: "residual" },
];

const BEST: &[Choice] = &[Choice { value: "best", title: "the best" }];

/// A policy as the parameter of its name has it: without its threshold.
pub fn policy_name(policy: ResamplePolicy) -> &'static str {
    match policy {
        ResamplePolicy::Never => "never",
        ResamplePolicy::Always => "always",
        ResamplePolicy::EssBelow(_) => "neff",
    }
}

/// All parameters, for a mosaic of `universes`.
pub fn specs(universes: usize) -> Vec<ParamSpec> {
    let LapSetup { particles, seed, proposal, matcher, policy, scheme, odometry_scale, range_std } =
        LapSetup::default();
    let threshold = if let ResamplePolicy::EssBelow(fraction) = policy { fraction } else { THRESHOLD };
    let number = |name, title, unit, (min, max, step): (f64, f64, f64), default: String, help| {
        let whole = step == 1.0;
        let kind = if whole { Kind::Integer } else { Kind::Number };
        ParamSpec { name, title, unit, kind, min, max, step, choices: &[], default, group: Group::Setup, help }
    };
    let choice = |name, title, choices, default: String, help| ParamSpec {
        kind: Kind::Choice,
        choices,
        ..number(name, title, "", (0.0, 0.0, 0.0), default, help)
    };
    let flag = |name, title, help| ParamSpec {
        kind: Kind::Flag,
        group: Group::View,
        ..number(name, title, "", (0.0, 1.0, 1.0), "off".into(), help)
    };
    let view = |spec| ParamSpec { group: Group::View, ..spec };
    vec![
        number(
            "universes",
            "Universes M",
            "",
            (1.0, 256.0, 1.0),
            particles.to_string(),
            "How many particles the filter has: each is a path with a map of its own.",
        ),
        number(
            "seed",
            "Seed",
            "",
            (0.0, f64::from(u32::MAX), 1.0),
            seed.to_string(),
            "Picks the noise of the world and of the filter; the same seed gives the same lap, bit for bit.",
        ),
        number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.0, 2.0, 0.05),
            write(odometry_scale),
            "Factor on the standard deviations of the wheels' noise, in the world and in what the filter expects.",
        ),
        number(
            "range-std",
            "Range noise σ",
            "m",
            (0.01, 0.3, 0.01),
            write(range_std),
            "Standard deviation of each measured range.",
        ),
        choice(
            "proposal",
            "Proposal",
            PROPOSALS,
            proposal.to_string(),
            "Where new poses are drawn from: near the scan's best match, or from the motion model alone.",
        ),
        choice(
            "matcher",
            "Matcher",
            MATCHERS,
            matcher.to_string(),
            "What the end of a beam is compared with: the mean of the hits in a cell, or the cell as a whole.",
        ),
        choice("policy", "Resample", POLICIES, policy_name(policy).into(), "When the universes are resampled."),
        number(
            "threshold",
            "Threshold",
            "of M",
            (0.0, 1.0, 0.05),
            write(threshold),
            "Share of M below which N_eff calls for resampling, under the policy neff.",
        ),
        choice("scheme", "Scheme", SCHEMES, scheme.to_string(), "How the survivors are drawn."),
        view(number("step", "Step", "", (0.0, STEPS as f64, 1.0), "0".into(), "The step shown.")),
        ParamSpec {
            choices: BEST,
            ..view(number(
                "universe",
                "Universe shown large",
                "",
                (-1.0, universes as f64 - 1.0, 1.0),
                "best".into(),
                "The slot shown large; best, or −1, is the one of largest weight.",
            ))
        },
        flag("truth", "Truth", "Draws the true path and the walls of the apartment, which the filter never sees."),
        flag("raw", "Raw odometry", "Draws where the wheels alone would have led."),
    ]
}
