//! One step: the two proposals, what the path ties together, and the update by hand.

use super::{Group, Number, Recipe, VALID};
use crate::experiment::conditioning::{Conditioning, ConditioningSetup};
use crate::experiment::proposal::{Proposals, ProposalsSetup};
use crate::experiment::worked_example::{Inputs, WorkedExample};

/// Samples of a block of the one-step comparison, and how many blocks: their scatter is the standard error.
const SAMPLES: u32 = 20_000;
const BLOCKS: u32 = 10;

/// All recipes of one step.
pub fn recipes() -> Vec<Recipe> {
    let default = ConditioningSetup::default;
    vec![
        proposal(),
        predicted(),
        pair(),
        conditioning("conditioning.default", default()),
        conditioning("conditioning.large", ConditioningSetup { landmarks: 24, poses: 12, ..default() }),
        worked_example(),
    ]
}

/// Mean and standard error of a number over blocks.
fn mean_and_error(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    [mean, (variance / n).sqrt()]
}

/// The default of the one-step comparison with as many samples as a block has.
fn block() -> ProposalsSetup {
    ProposalsSetup { samples: SAMPLES, ..ProposalsSetup::default() }
}

/// A number of every block, with its standard error.
fn of_blocks(group: &Group, key: &str, values: &[f64], what: &str) -> [Number; 2] {
    let [mean, error] = mean_and_error(values);
    let over = format!(
        "{} blocks (seeds) of {SAMPLES} samples of one step, lab/src/experiment/proposal.rs: {what}",
        values.len()
    );
    [
        group.number(key, mean, "", format!("Mean over {over}")),
        group.number(&format!("{key}.se"), error, "", format!("Standard error of the mean over {over}")),
    ]
}

/// What is measured of a block: shares of the samples inside the 90 % region, N_eff of 1.0 over M, and the ratio of both N_eff.
const MEASURED: [&str; 4] = [
    "share of FastSLAM 1.0's samples inside the posterior's 90 % region",
    "share of FastSLAM 2.0's samples inside the posterior's 90 % region",
    "N_eff of FastSLAM 1.0 over M",
    "N_eff of FastSLAM 2.0 over that of 1.0",
];

/// The sensors of which it is measured, by factors on the range noise.
const SENSORS: [(f64, &str); 4] = [
    (1.0, ""),
    (0.5, ", with half the range noise"),
    (0.1, ", with a tenth of the range noise"),
    (10.0, ", with ten times the range noise"),
];

fn proposal() -> Recipe {
    Recipe::new("proposal", BLOCKS, |runs| {
        let group = Group("proposal".into());
        let found = runs.over(|seed| {
            SENSORS.map(|(factor, _)| {
                let setup = block();
                let setup = ProposalsSetup { seed, range_std: factor * setup.range_std, ..setup };
                let found = Proposals::new(&setup).expect(VALID);
                let Proposals { motion, aware, .. } = &found;
                let ess = motion.ess() / f64::from(SAMPLES);
                [motion.share_inside(None), aware.share_inside(None), ess, found.ratio()]
            })
        });
        let of = |(key, sensor, measured): (&str, usize, usize)| {
            let values: Vec<f64> = found.iter().map(|block| block[sensor][measured]).collect();
            of_blocks(&group, key, &values, &format!("{}{}", MEASURED[measured], SENSORS[sensor].1))
        };
        let keys = [
            ("inside.motion", 0, 0),
            ("inside.aware", 0, 1),
            ("ess.motion", 0, 2),
            ("ratio", 0, 3),
            ("half.inside.motion", 1, 0),
            ("half.ess.motion", 1, 2),
            ("ratio_half_range", 1, 3),
            ("sharp.inside.motion", 2, 0),
            ("sharp.ess.motion", 2, 2),
            ("sharp.ratio", 2, 3),
            ("ratio_blunt", 3, 3),
        ];
        let all = "Samples of every proposal, over all blocks (seeds, from 1 on), in the comparison of one step";
        let samples = group.number("samples", f64::from(SAMPLES) * found.len() as f64, "", all);
        keys.into_iter().flat_map(of).chain([samples]).collect::<Vec<_>>().into()
    })
}

/// What the closed form says of the same sensors.
fn predicted() -> Recipe {
    Recipe::fixed("proposal.predicted", |group| {
        let keys = [
            ["ess.motion", "ratio"],
            ["half.ess.motion", "ratio_half_range"],
            ["sharp.ess.motion", "sharp.ratio"],
            ["blunt.ess.motion", "ratio_blunt"],
        ];
        let of = |(keys, (factor, sensor)): ([&str; 2], (f64, &str))| {
            let setup = ProposalsSetup::default();
            let found = Proposals::new(&ProposalsSetup { range_std: factor * setup.range_std, ..setup }).expect(VALID);
            let values = [(found.predicted_ess, MEASURED[2]), (found.predicted_ratio(), MEASURED[3])];
            let by = "by the closed form, nothing drawn: lab/src/baseline/one_step.rs";
            let number = |(key, (value, what)): (&str, (f64, &str))| {
                group.number(key, value, "", format!("{what}{sensor}, {by}"))
            };
            keys.into_iter().zip(values).map(number).collect::<Vec<_>>()
        };
        keys.into_iter().zip(SENSORS).flat_map(of).collect()
    })
}

fn pair() -> Recipe {
    Recipe::new("proposal.pair", BLOCKS, |runs| {
        let group = Group("proposal.pair".into());
        let found = runs.over(|seed| {
            let Proposals { exact, motion, aware, .. } =
                Proposals::new(&ProposalsSetup { seed, twins: true, ..block() }).expect(VALID);
            let [m, a] = [motion, aware].map(|cloud| [0, 1].map(|candidate| cloud.share_inside(Some(candidate))));
            [exact.candidates[0], exact.candidates[1], m[0], m[1], a[0], a[1]]
        });
        let names = [
            ("posterior", "posterior probability that the sighting is of"),
            (
                "motion",
                "share of FastSLAM 1.0's samples inside the posterior's 90 % region that take the sighting to be of",
            ),
            (
                "aware",
                "share of FastSLAM 2.0's samples inside the posterior's 90 % region that take the sighting to be of",
            ),
        ];
        let mut numbers = Vec::new();
        for (k, (name, what)) in names.into_iter().enumerate() {
            for (candidate, (which, landmark)) in
                [("true", "the true landmark"), ("false", "its look-alike")].into_iter().enumerate()
            {
                let values: Vec<f64> = found.iter().map(|block| block[2 * k + candidate]).collect();
                let [mean, _] = of_blocks(&group, &format!("{name}_{which}"), &values, &format!("{what} {landmark}"));
                numbers.push(mean);
            }
        }
        numbers.into()
    })
}

fn conditioning(name: &str, setup: ConditioningSetup) -> Recipe {
    Recipe::fixed(name, move |group| {
        let known = Conditioning::new(&setup).expect(VALID).after(setup.poses);
        let of = format!(
            "after {} poses among {} landmarks, nothing drawn: lab/src/experiment/conditioning.rs",
            setup.poses, setup.landmarks
        );
        let entries = "Entries outside the 2 × 2 blocks of the map's covariance that are not 0";
        vec![
            group.number("off_block", known.marginal.off_block_nonzeros() as f64, "", format!("{entries}, {of}")),
            group.number(
                "off_block_conditioned",
                known.conditional.off_block_nonzeros() as f64,
                "",
                format!("{entries}, given the path, {of}"),
            ),
            group.number("landmarks", known.seen.len() as f64, "", format!("Landmarks seen {of}")),
            group.number("poses", known.path.len() as f64, "", format!("Poses besides the known start, {of}")),
        ]
    })
}

fn worked_example() -> Recipe {
    Recipe::fixed("worked", |group| {
        let example = WorkedExample::new(&Inputs::default());
        let [w1, w2] = [0, 1].map(|slot: usize| example.updates[slot].weight);
        let shares = example.weights.as_slice();
        let of = "the worked example: lab/src/experiment/worked_example.rs";
        vec![
            group.number("w1", w1, "1/(m·rad)", format!("Weight of the first particle in {of}")),
            group.number("w2", w2, "1/(m·rad)", format!("Weight of the second particle in {of}")),
            group.number("n1", shares[0], "", format!("Normalised weight of the first particle in {of}")),
            group.number("n2", shares[1], "", format!("Normalised weight of the second particle in {of}")),
            group.number("ess", example.ess, "", format!("N_eff in {of}")),
            group.number("ratio", w1 / w2, "", format!("First weight over second in {of}")),
        ]
    })
}
