//! What a reader can set about the step.

use super::{gauge, layout::WORLD};
use crate::model::{Choice, ParamSpec};
use fastslam_lab::{baseline::one_step::Area, experiment::proposals::ProposalsSetup};

/// Most samples of each proposal.
pub const MOST: u32 = 4096;

/// The guess before there is one.
pub const GUESS: f64 = 2.0;

/// How near a landmark comes to the edge of a panel \[m\].
const MARGIN: f64 = 0.15;

const LANDMARKS: &[Choice] = &[
    Choice { value: "one", title: "one: the sighting is of it" },
    Choice { value: "pair", title: "a pair: of which is unknown" },
];

/// All parameters.
pub fn specs() -> Vec<ParamSpec> {
    let ProposalsSetup { samples, seed, range_std, bearing_std, odometry_scale, landmark, .. } =
        ProposalsSetup::default();
    let Area { low, high } = WORLD;
    let coordinate = |name, title, axis: usize, help| {
        let range = (low[axis] + MARGIN, high[axis] - MARGIN, 0.05);
        ParamSpec::number(name, title, "m", range, landmark[axis], help).without_slider()
    };
    vec![
        ParamSpec::number(
            "range-std",
            "Range noise σ",
            "m",
            (0.005, 0.5, 0.005),
            range_std,
            "Standard deviation of the measured range: sharp on the left, blunt on the right.",
        ),
        ParamSpec::number(
            "bearing-std",
            "Bearing noise σ",
            "rad",
            (0.01, 0.3, 0.01),
            bearing_std,
            "Standard deviation of the measured bearing.",
        ),
        ParamSpec::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.25, 2.0, 0.05),
            odometry_scale,
            "Factor on the standard deviations of what the wheels report.",
        ),
        ParamSpec::integer(
            "samples",
            "Samples M",
            "",
            (1, MOST.into()),
            samples.into(),
            "How many samples each proposal draws.",
        ),
        ParamSpec::integer(
            "seed",
            "Seed",
            "",
            (0, u32::MAX.into()),
            seed as i64,
            "Picks the draws of both proposals; the same seed gives the same samples, bit for bit.",
        ),
        ParamSpec::choice(
            "landmarks",
            "Landmarks",
            LANDMARKS,
            "one",
            "One landmark, or two alike: then the sighting may be of either, and every sample decides for itself.",
        ),
        coordinate("landmark-x", "Landmark x", 0, "Where the map has the landmark, ahead of the start."),
        coordinate("landmark-y", "Landmark y", 1, "Where the map has the landmark, to the left of the start."),
        ParamSpec::toggle(
            "predict",
            "Predict first",
            false,
            "Asks how many times better the aware proposal's N_eff will be at half the range noise.",
        )
        .view(),
        ParamSpec::number(
            "guess",
            "Your guess",
            "times",
            (gauge::ENDS[0], gauge::ENDS[1], 0.1),
            GUESS,
            "The ratio you expect at half the range noise; drag the marker on the scale, or type it.",
        )
        .without_slider(),
        ParamSpec::toggle(
            "run",
            "Run at half σ",
            false,
            "Runs both proposals at half the range noise, and shows guess against result.",
        )
        .view(),
    ]
}
