//! What a reader can set about the three filters.

use crate::model::{Choice, ParamSpec};
use fastslam::experiment::policies::PoliciesSetup;

/// How far back the second lineage gauge looks at first.
pub const BACK: u32 = 10;

/// What is set at first. With this seed the second filter loses the right wing and the others keep it: what is more often so than not
/// is for the count over many seeds to say.
pub fn setup() -> PoliciesSetup {
    PoliciesSetup { seed: 2, ..PoliciesSetup::default() }
}

const SCHEMES: &[Choice] = &[
    Choice { value: "systematic", title: "systematic" },
    Choice { value: "stratified", title: "stratified" },
    Choice { value: "multinomial", title: "multinomial" },
    Choice { value: "residual", title: "residual" },
];

const NOW: &[Choice] = &[Choice { value: "now", title: "the newest" }];

/// All parameters, for a course of so many steps.
pub fn specs(steps: u32) -> Vec<ParamSpec> {
    let PoliciesSetup { particles, seed, threshold, scheme, odometry_scale, sensor_scale, .. } = setup();
    vec![
        ParamSpec::toggle(
            "wings",
            "Loop of ambiguity",
            false,
            "Drives into one of two wings that look the same, instead of round the apartment: the evidence comes late.",
        ),
        ParamSpec::integer(
            "particles",
            "Particles M",
            "",
            (4, 64),
            particles as i64,
            "How many particles each filter has.",
        ),
        ParamSpec::integer(
            "seed",
            "Seed",
            "",
            (0, u32::MAX.into()),
            seed as i64,
            "Picks the noise of the world and of the filters; all three filters have the same.",
        ),
        ParamSpec::number(
            "threshold",
            "Threshold",
            "of M",
            (0.0, 1.0, 0.05),
            threshold,
            "Share of M below which N_eff calls for resampling in the selective filter.",
        ),
        ParamSpec::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.0, 2.0, 0.05),
            odometry_scale,
            "Factor on the standard deviations of the odometry’s noise, in the world and in what the filters expect.",
        ),
        ParamSpec::number(
            "range",
            "Range noise σ",
            "× σ",
            (0.25, 4.0, 0.05),
            sensor_scale,
            "Factor on the standard deviations of the sensor’s noise, in the world and in what the filters expect.",
        ),
        ParamSpec::choice("scheme", "Scheme", SCHEMES, scheme.to_string(), "How the survivors are drawn."),
        ParamSpec::integer(
            "back",
            "Second gauge looks back",
            "steps",
            (1, 60),
            BACK.into(),
            "How many steps back the second lineage gauge counts distinct ancestors.",
        )
        .without_slider()
        .view(),
        ParamSpec::integer("step", "Step", "", (0, steps.into()), 0, "The step shown.").view(),
        ParamSpec::integer(
            "cursor",
            "Step read",
            "",
            (-1, steps.into()),
            -1,
            "The step whose values are written beside the curves; now, or −1, is the one shown.",
        )
        .or_words(NOW)
        .view(),
    ]
}
