//! Every measured number of the chapter, and how it is made.
//!
//! A [`Recipe`] makes a group of numbers from seeds 1 to n; [`recipes`] are all there are. `fastslam numbers` runs them natively and writes
//! the file that the chapter's prose takes its numbers from by key; `tests/portability` and `tests/browser` run them again and
//! compare bits; the page runs one cell of the lap table in front of the reader ([`LapCell`]).

use super::Spread;
use super::conditioning::{Conditioning, ConditioningSetup};
use super::landmarks::{Association, Course, LandmarkRun, LandmarkSetup};
use super::lap::{BEAMS, GRID, Lap, LapSetup, LapWorld, MAX_RANGE, STEPS};
use super::policies::{PoliciesSetup, PolicyCourse};
use super::policy_counts::{PolicySummary, outcomes, summary};
use super::proposals::{Proposals, ProposalsSetup};
use super::table::{PARTICLES, rms_best};
use super::worked_example::{Inputs, WorkedExample};
use crate::digest::Digest;
use crate::execute::Executor;
use crate::geometry::rms;
use crate::matching::Matcher;
use crate::proposal::ProposalKind;
use crate::resampling::Scheme;
use std::sync::Arc;

/// Seeds of what is counted over many.
pub const SEEDS: u32 = 200;

/// So many seeds are run again by tests, where all would take minutes.
pub const FIRST_SEEDS: u32 = 3;

/// Samples of a block of the one-step comparison, and how many blocks: their scatter is the standard error.
const SAMPLES: u32 = 20_000;
const BLOCKS: u32 = 10;

const VALID: &str = "a recipe's setting is valid";

/// A measured number.
#[derive(Clone, PartialEq, Debug)]
pub struct Number {
    /// What the prose calls it by.
    pub key: String,
    /// In its unit.
    pub value: f64,
    /// Unit; empty for pure numbers.
    pub unit: &'static str,
    /// How it is made, in a sentence.
    pub made: String,
}

/// What a recipe makes.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Made {
    /// The numbers.
    pub numbers: Vec<Number>,
    /// The error of each seed \[m\], where the chapter shows them one by one.
    pub errors: Vec<f64>,
}

impl Made {
    /// A fingerprint of all keys and values.
    pub fn digest(&self) -> Digest {
        let mut digest = Digest::new();
        for Number { key, value, .. } in &self.numbers {
            digest.bytes(key.as_bytes());
            digest.f64(*value);
        }
        self.errors.iter().for_each(|error| digest.f64(*error));
        digest
    }
}

type Make = dyn Fn(&Runs<'_>) -> Made + Send + Sync;

/// How a group of numbers is made.
pub struct Recipe {
    /// What its keys begin with, before a dot.
    pub name: String,
    /// It runs seeds 1 to this one; 0 where nothing is drawn, or only by the one seed of a figure.
    pub seeds: u32,
    make: Box<Make>,
}

impl Recipe {
    fn new(name: impl Into<String>, seeds: u32, make: impl Fn(&Runs<'_>) -> Made + Send + Sync + 'static) -> Self {
        Self { name: name.into(), seeds, make: Box::new(make) }
    }

    /// A recipe without seeds.
    fn fixed(name: &str, numbers: impl Fn(&Group) -> Vec<Number> + Send + Sync + 'static) -> Self {
        let group = Group(name.to_owned());
        Self::new(name, 0, move |_| numbers(&group).into())
    }

    /// Makes the numbers from seeds 1 to `seeds` alone, which is to be [`Self::seeds`] for those of the chapter. `done` hears of every seed
    /// that has been run.
    pub fn make(&self, seeds: u32, executor: &Executor, done: &(dyn Fn() + Sync)) -> Made {
        (self.make)(&Runs { seeds, executor, done })
    }

    /// Whether a key is of this recipe, if it is of no other whose name is longer.
    pub fn could_own(&self, key: &str) -> bool {
        key.strip_prefix(&self.name).is_some_and(|rest| rest.starts_with('.'))
    }
}

/// The recipe that makes a key.
pub fn owner<'a>(recipes: &'a [Recipe], key: &str) -> Option<&'a Recipe> {
    recipes.iter().filter(|recipe| recipe.could_own(key)).max_by_key(|recipe| recipe.name.len())
}

impl From<Vec<Number>> for Made {
    fn from(numbers: Vec<Number>) -> Self {
        Self { numbers, errors: Vec::new() }
    }
}

/// The seeds to be run, and who runs them.
struct Runs<'a> {
    seeds: u32,
    executor: &'a Executor,
    done: &'a (dyn Fn() + Sync),
}

impl Runs<'_> {
    /// One result for each seed, in their order.
    fn over<R: Send>(&self, run: impl Fn(u64) -> R + Sync + Send) -> Vec<R> {
        let mut seeds: Vec<u64> = (1..=u64::from(self.seeds)).collect();
        self.executor.map(&mut seeds, |_, seed| {
            let result = run(*seed);
            (self.done)();
            result
        })
    }
}

/// The name before the dot.
struct Group(String);

impl Group {
    fn number(&self, key: &str, value: f64, unit: &'static str, made: impl Into<String>) -> Number {
        Number { key: format!("{}.{key}", self.0), value, unit, made: made.into() }
    }

    /// The median of what is measured \[m\].
    fn median(&self, values: &[f64], what: &str) -> Number {
        let made = format!("Median over seeds 1 to {} of {what}", values.len());
        self.number("median", Spread::of(values).median, "m", made)
    }

    /// Median, 90th percentile and worst \[m\].
    fn spread(&self, values: &[f64], what: &str) -> Vec<Number> {
        let Spread { p90, worst, .. } = Spread::of(values);
        let over = format!("over seeds 1 to {} of {what}", values.len());
        vec![
            self.median(values, what),
            self.number("p90", p90, "m", format!("90th percentile {over}")),
            self.number("worst", worst, "m", format!("Largest {over}")),
        ]
    }
}

/// Every recipe of the chapter.
pub fn recipes() -> Vec<Recipe> {
    let mut recipes: Vec<Recipe> =
        LapCell::all().map(|cell| Recipe::new(cell.name(), SEEDS, move |runs| cell.made(runs))).collect();
    recipes.extend([lap(), odometry(), memory(), policies_on_the_lap(), worked_example(), proposal(), pair()]);
    let schemes = [Scheme::Multinomial, Scheme::Residual, Scheme::Stratified, Scheme::Systematic];
    recipes.extend(schemes.map(wings));
    let default = ConditioningSetup::default;
    recipes.push(conditioning("conditioning.default", default()));
    recipes.push(conditioning("conditioning.large", ConditioningSetup { landmarks: 24, poses: 12, ..default() }));
    recipes.extend(landmarks());
    recipes
}

/// A cell of the lap table: errors over many laps.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LapCell {
    /// Its column.
    pub proposal: ProposalKind,
    /// Its column.
    pub matcher: Matcher,
    /// M, its row.
    pub particles: usize,
}

impl LapCell {
    /// All cells, column by column.
    pub fn all() -> impl Iterator<Item = Self> {
        let columns = [ProposalKind::Aware, ProposalKind::Motion]
            .into_iter()
            .flat_map(|proposal| [Matcher::Cell, Matcher::SubCell].map(|matcher| (proposal, matcher)));
        columns.flat_map(|(proposal, matcher)| PARTICLES.map(|particles| Self { proposal, matcher, particles }))
    }

    /// What its keys begin with: `lap.aware.cell.m16`.
    pub fn name(&self) -> String {
        let Self { proposal, matcher, particles } = self;
        format!("lap.{proposal}.{matcher}.m{particles}")
    }

    /// Its lap with a seed.
    pub fn setup(&self, seed: u64) -> LapSetup {
        let &Self { proposal, matcher, particles } = self;
        LapSetup { proposal, matcher, particles, seed, ..LapSetup::default() }
    }

    /// The numbers of the cell, from the errors of seeds 1 to their number.
    pub fn numbers(&self, errors: &[f64]) -> Vec<Number> {
        let Self { proposal, matcher, particles } = self;
        let group = Group(self.name());
        let what = format!(
            "the RMS position error of the best particle's path over the Apartment lap: fastslam lap --proposal {proposal} --matcher {matcher} --particles {particles} --seed N"
        );
        let [low, high] = Spread::of(errors).median_interval;
        let end = |which| {
            format!(
                "{which} end of the 95 % confidence interval of the median (order statistics) over seeds 1 to {} of {what}",
                errors.len()
            )
        };
        let mut numbers = group.spread(errors, &what);
        numbers.push(group.number("median_low", low, "m", end("Lower")));
        numbers.push(group.number("median_high", high, "m", end("Upper")));
        numbers
    }

    fn made(&self, runs: &Runs<'_>) -> Made {
        let errors = runs.over(|seed| rms_best(&self.setup(seed)).expect(VALID));
        Made { numbers: self.numbers(&errors), errors }
    }
}

/// What is set on the lap.
fn lap() -> Recipe {
    Recipe::fixed("lap", |group| {
        let start = "The setting of the lap (src/experiment/lap.rs)";
        vec![
            group.number("steps", STEPS as f64, "", format!("{start}: steps after the start")),
            group.number("runs", f64::from(SEEDS), "", "Seeds of every cell of the lap table, from 1 on"),
            group.number("cell", GRID.cell_size, "m", format!("{start}: width of a cell of the maps")),
            group.number("scan.beams", BEAMS as f64, "", format!("{start}: beams of a scan")),
            group.number("scan.range", MAX_RANGE, "m", format!("{start}: longest range of a beam")),
            group.number("scan.range_std", LapSetup::default().range_std, "m", format!("{start}: σ of a range")),
            group.number(
                "particles.default",
                LapSetup::default().particles as f64,
                "",
                format!("{start}: M of the figure"),
            ),
        ]
    })
}

fn odometry() -> Recipe {
    Recipe::new("lap.odometry", SEEDS, |runs| {
        let error = |seed| {
            let setup = LapSetup::default();
            let world = LapWorld::new(seed, &setup.motion(), setup.range_std);
            rms(&world.odometry, &world.truth)
        };
        let what = "the RMS position error of raw odometry over the Apartment lap: fastslam lap --seed N";
        Group("lap.odometry".into()).spread(&runs.over(error), what).into()
    })
}

fn memory() -> Recipe {
    Recipe::fixed("memory.lap", |group| {
        let setup = LapSetup::default();
        let (lap, _) = Lap::new(&setup).expect(VALID).with_executor(Executor::Serial).run(|_| ());
        let (unique, dense) = (lap.report().map_bytes_unique as f64, lap.report().map_bytes_dense as f64);
        let of = format!("at the end of a lap: fastslam lap --particles {} --seed {}", setup.particles, setup.seed);
        vec![
            group.number("unique", unique, "bytes", format!("All maps, shared tiles counted once, {of}")),
            group.number("dense", dense, "bytes", format!("As many dense maps of the same extent, {of}")),
            group.number("ratio", dense / unique, "", format!("Dense over shared bytes {of}")),
        ]
    })
}

/// The three policies over the seeds to be run.
fn summarised(runs: &Runs<'_>, setup: &PoliciesSetup) -> [PolicySummary; 3] {
    let found = runs.over(|seed| outcomes(setup, seed..seed + 1).expect(VALID));
    summary(&found.concat(), setup.particles)
}

fn policies_on_the_lap() -> Recipe {
    Recipe::new("policies.lap", SEEDS, |runs| {
        let group = Group("policies.lap".into());
        let setup = PoliciesSetup::of(PolicyCourse::Lap);
        let policies = summarised(runs, &setup);
        let of =
            format!("over seeds 1 to {}: fastslam policies --course lap --particles {}", runs.seeds, setup.particles);
        let mut numbers = Vec::new();
        for policy in &policies {
            let mut put = |key: &str, value: Option<f64>, unit, made: &str| {
                let key = format!("{}.{key}", policy.policy);
                numbers.extend(value.map(|value| group.number(&key, value, unit, format!("{made} {of}"))));
            };
            let [_, factor, _] = policy.error_factor;
            put("ess_final_median", Some(policy.final_ess_median), "", "Median N_eff at the end of the lap");
            put("error_median", Some(policy.rms_median), "m", "Median RMS position error of the best particle's path");
            put(
                "error_factor",
                Some(factor),
                "",
                "Median of the error over that of the selective filter on the same seed,",
            );
            put("resampled_fraction", Some(policy.resampled_fraction), "", "Mean share of the steps that resampled");
            put(
                "lineage_one_step",
                policy.lineage_one_step_median,
                "",
                "Median of the first step at which all particles descend from one",
            );
            put(
                "ess_at_lineage_one",
                policy.ess_at_lineage_one_median,
                "",
                "Median N_eff at the first step at which all particles descend from one",
            );
            put("tree_nodes", Some(policy.tree_nodes), "", "Mean number of nodes of the ancestry tree at the end");
            put(
                "tree_c",
                policy.tree_c,
                "",
                "c of t + 1 + c M ln M, the mean size of the ancestry tree over the second half of the lap,",
            );
        }
        let [_, always, _] = &policies;
        let tree = "policy always, which the theorem is about,";
        let dense = (setup.particles * (STEPS + 1)) as f64;
        numbers.push(group.number(
            "tree.nodes",
            always.tree_nodes,
            "",
            format!("Mean number of nodes of the ancestry tree at the end, {tree} {of}"),
        ));
        numbers.extend(always.tree_c.map(|c| group.number("tree.c", c, "", format!("c of t + 1 + c M ln M, the mean size of the ancestry tree over the second half of the lap, {tree} {of}"))));
        numbers.push(group.number(
            "tree.dense",
            dense,
            "",
            "M (t + 1): nodes of M paths kept apart, at the end of the lap",
        ));
        numbers.into()
    })
}

fn wings(scheme: Scheme) -> Recipe {
    let name = format!("policies.wings.{scheme}");
    Recipe::new(name.clone(), SEEDS, move |runs| {
        let setup = PoliciesSetup { scheme, ..PoliciesSetup::of(PolicyCourse::Wings) };
        let mut numbers = Vec::new();
        for policy in summarised(runs, &setup) {
            let group = Group(format!("{name}.{}", policy.policy));
            let (Some(alive), Some(settled)) = (policy.alive, policy.settled) else { continue };
            let [low, high] = alive.wilson();
            let of = format!(
                "over seeds 1 to {}: fastslam policies --course wings --scheme {scheme} --particles {}",
                runs.seeds, setup.particles
            );
            let kept = "runs that still have a particle in the right wing before the sign comes in sight,";
            numbers.push(group.number("alive", alive.share(), "", format!("Share of the {kept} {of}")));
            for (end, value) in [("low", low), ("high", high)] {
                numbers.push(group.number(
                    end,
                    value,
                    "",
                    format!("An end of the 95 % Wilson interval of the share of {kept} {of}"),
                ));
            }
            numbers.push(group.number(
                "settled",
                settled.share(),
                "",
                format!("Share of the runs whose best particle ends in the right wing, {of}"),
            ));
        }
        numbers.into()
    })
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
        "{} blocks (seeds) of {SAMPLES} samples of one step, src/experiment/proposals.rs: {what}",
        values.len()
    );
    [
        group.number(key, mean, "", format!("Mean over {over}")),
        group.number(&format!("{key}.se"), error, "", format!("Standard error of the mean over {over}")),
    ]
}

fn proposal() -> Recipe {
    Recipe::new("proposal", BLOCKS, |runs| {
        let group = Group("proposal".into());
        let default = block();
        // A blunt sensor is ten times as blunt.
        let [half, blunt] =
            [0.5, 10.0].map(|factor| ProposalsSetup { range_std: factor * default.range_std, ..block() });
        let found = runs.over(|seed| {
            let with = |setup: &ProposalsSetup| Proposals::new(&ProposalsSetup { seed, ..setup.clone() }).expect(VALID);
            let at_default = with(&default);
            let inside = [&at_default.motion, &at_default.aware].map(|cloud| cloud.share_inside(None));
            [inside[0], inside[1], at_default.ratio(), with(&half).ratio(), with(&blunt).ratio()]
        });
        let ratio = "N_eff of FastSLAM 2.0 over that of 1.0";
        let names = [
            ("inside.motion", "share of FastSLAM 1.0's samples inside the posterior's 90 % region".to_owned()),
            ("inside.aware", "share of FastSLAM 2.0's samples inside the posterior's 90 % region".to_owned()),
            ("ratio", ratio.to_owned()),
            ("ratio_half_range", format!("{ratio}, with half the range noise")),
            ("ratio_blunt", format!("{ratio}, with ten times the range noise")),
        ];
        let of = |(k, (key, what)): (usize, (&str, String))| {
            let values: Vec<f64> = found.iter().map(|block| block[k]).collect();
            of_blocks(&group, key, &values, &what)
        };
        names.into_iter().enumerate().flat_map(of).collect::<Vec<_>>().into()
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
            "after {} poses among {} landmarks, nothing drawn: src/experiment/conditioning.rs",
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
        let of = "the worked example: src/experiment/worked_example.rs";
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

/// The figure of eight among landmarks.
fn landmarks() -> Vec<Recipe> {
    const NAME: &str = "landmarks.eight";
    const COURSE: Course = Course::Eight;
    let setup = |proposal, association, particles| LandmarkSetup {
        proposal,
        association,
        particles,
        ..LandmarkSetup::default()
    };
    let run = move |setup: LandmarkSetup, seed| {
        let setup = LandmarkSetup { seed, ..setup };
        let run = LandmarkRun::new(&setup, &COURSE.tuning(), Arc::new(COURSE.simulate(seed))).expect(VALID);
        run.with_executor(Executor::Serial)
    };
    let versions = [("fastslam1", "1.0", ProposalKind::Motion), ("fastslam2", "2.0", ProposalKind::Aware)];
    let mut recipes = Vec::new();
    for association in [Association::Known, Association::Unknown] {
        for (version, number, proposal) in versions {
            for particles in [10, 100] {
                let name = format!("{NAME}.{association}.{version}.m{particles}");
                let what = format!(
                    "the RMS position error of the best particle's path at the end: fastslam landmarks --course eight --proposal {number} --association {association} --particles {particles} --seed N"
                );
                recipes.push(Recipe::new(name.clone(), SEEDS, move |runs| {
                    let errors = runs.over(|seed| {
                        let mut run = run(setup(proposal, association, particles), seed);
                        while run.step().is_some() {}
                        run.rms_best()
                    });
                    Group(name.clone()).spread(&errors, &what).into()
                }));
            }
        }
        let name = format!("{NAME}.{association}.ekf");
        recipes.push(Recipe::new(name.clone(), SEEDS, move |runs| {
            let setup = setup(ProposalKind::Aware, association, 1);
            let errors = runs.over(|seed| run(setup.clone(), seed).rms_ekf(&setup, &COURSE.tuning()));
            let what = format!("the RMS position error of EKF-SLAM as it went: fastslam landmarks --course eight --association {association} --seed N");
            Group(name.clone()).spread(&errors, &what).into()
        }));
    }
    recipes.push(Recipe::new(format!("{NAME}.odometry"), SEEDS, |runs| {
        let errors = runs.over(|seed| {
            let log = COURSE.simulate(seed);
            rms(&log.odometry, &log.truth)
        });
        let what = "the RMS position error of raw odometry: fastslam landmarks --course eight --seed N";
        Group(format!("{NAME}.odometry")).spread(&errors, what).into()
    }));
    recipes.push(Recipe::fixed(NAME, |group| {
        let log = COURSE.simulate(1);
        let of = "of the course: src/experiment/landmarks.rs";
        vec![
            group.number("landmarks", log.landmarks.len() as f64, "", format!("Landmarks {of}")),
            group.number("steps", log.controls.len() as f64, "", format!("Steps {of}")),
        ]
    }));
    recipes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_made_once_and_by_the_recipe_that_owns_it() {
        let recipes = recipes();
        let mut keys = Vec::new();
        for recipe in recipes.iter().filter(|recipe| recipe.seeds == 0 || recipe.name.starts_with("policies.wings")) {
            let made = recipe.make(recipe.seeds.min(2), &Executor::default(), &|| ());
            assert!(!made.numbers.is_empty(), "{}", recipe.name);
            for Number { key, value, made, .. } in made.numbers {
                assert_eq!(owner(&recipes, &key).map(|owner| &owner.name), Some(&recipe.name), "{key}");
                assert!(value.is_finite() && made.len() > 20, "{key}");
                keys.push(key);
            }
        }
        let count = keys.len();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), count);
        assert!(owner(&recipes, "lap.aware.cell.m160.median").is_some_and(|recipe| recipe.name == "lap"));
        assert!(owner(&recipes, "lapse").is_none());
    }

    #[test]
    fn a_cell_s_numbers_follow_from_its_errors() {
        let cell = LapCell { proposal: ProposalKind::Motion, matcher: Matcher::Cell, particles: 4 };
        let recipes = recipes();
        let recipe = recipes.iter().find(|recipe| recipe.name == cell.name()).unwrap();
        let heard = std::sync::atomic::AtomicU32::new(0);
        let made = recipe.make(3, &Executor::default(), &|| {
            heard.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        });
        assert_eq!(heard.into_inner(), 3);
        assert_eq!(made.errors, [1, 2, 3].map(|seed| rms_best(&cell.setup(seed)).unwrap()));
        assert_eq!(made.numbers, cell.numbers(&made.errors));
    }
}
