//! Every measured number of the chapter, and how it is made.
//!
//! A [`Recipe`] makes a group of numbers from seeds 1 to n; [`recipes`] are all there are. `fastslam-lab numbers` runs them natively and writes
//! the file that the chapter's prose takes its numbers from by key; `tests/portability` and `tests/browser` run them again and
//! compare bits; the page runs one cell of the lap table in front of the reader ([`LapCell`]).

mod em;
mod graph;
mod joint;
mod landmarks;
mod lap;
mod looking_back;
mod proposal;
mod resampling;
mod ring;
mod smoothing;
mod stores;

pub use lap::LapCell;

use super::{ErrorSummary, Fraction};
use crate::digest::Digest;
use core::hash::Hasher as _;
use fastslam::execute::Executor;
use std::collections::BTreeMap;

/// Seeds of what is counted over many.
pub const SEEDS: u32 = 200;

/// So many seeds are run again by tests, where all would take minutes.
pub const FIRST_SEEDS: u32 = 3;

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
            digest.write(key.as_bytes());
            digest.f64(*value);
        }
        self.errors.iter().for_each(|error| digest.f64(*error));
        digest
    }
}

/// The errors that recipes made \[m\], from seed 1 on, by their names.
pub type Errors = BTreeMap<String, Vec<f64>>;

type Make = dyn Fn(&Runs<'_>) -> Made + Send + Sync;

/// How a group of numbers is made.
pub struct Recipe {
    /// What its keys begin with, before a dot, or its only key.
    pub name: String,
    /// It runs seeds 1 to this one; 0 where nothing is drawn, only by the one seed of a figure, or by recipes before it.
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

    /// Makes the numbers from seeds 1 to `seeds` alone, which is to be [`Self::seeds`] for those of the chapter. `before` are the errors
    /// of the recipes that stand before this one in [`recipes`], for those that are worked out from them. `done` hears of every seed that
    /// has been run.
    pub fn make(&self, seeds: u32, executor: &Executor, before: &Errors, done: &(dyn Fn() + Sync)) -> Made {
        (self.make)(&Runs { seeds, executor, before, done })
    }

    /// Whether a key is of this recipe, if it is of no other whose name is longer.
    pub fn could_own(&self, key: &str) -> bool {
        key.strip_prefix(&self.name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
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
    before: &'a Errors,
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

    /// The same seeds, of which nobody hears: for those run several times.
    fn quietly(&self) -> Self {
        Self { done: &|| (), ..*self }
    }

    /// What is told of all seeds at once.
    fn all_done(&self) {
        (0..self.seeds).for_each(|_| (self.done)());
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
        self.number("median", ErrorSummary::of(values).median, "m", made)
    }

    /// A share, and its 95 % interval.
    fn share(&self, key: &str, fraction: &Fraction, what: &str) -> Vec<Number> {
        let ends = fraction.wilson().into_iter().zip(["low", "high"]);
        let end = |(value, end)| {
            self.number(end, value, "", format!("The {end} end of the 95 % interval (Wilson) of the share of {what}"))
        };
        [self.number(key, fraction.share(), "", format!("Share of {what}"))].into_iter().chain(ends.map(end)).collect()
    }

    /// Median, 90th percentile and worst \[m\].
    fn spread(&self, values: &[f64], what: &str) -> Vec<Number> {
        let ErrorSummary { p90, worst, .. } = ErrorSummary::of(values);
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
    let all = [
        lap::recipes(),
        ring::recipes(),
        graph::recipes(),
        resampling::recipes(),
        proposal::recipes(),
        joint::recipes(),
        smoothing::recipes(),
        looking_back::recipes(),
        landmarks::recipes(),
        em::recipes(),
        stores::recipes(),
    ];
    all.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::ProposalKind;
    use crate::experiment::table::rms_best;
    use fastslam::matching::Matcher;

    #[test]
    fn every_key_is_made_once_and_by_the_recipe_that_owns_it() {
        let recipes = recipes();
        let before = LapCell::all().map(|cell| (cell.name(), vec![0.1, 0.3, 0.2])).collect();
        let mut keys = Vec::new();
        for recipe in recipes.iter().filter(|recipe| recipe.seeds == 0 || recipe.name.starts_with("policies.wings")) {
            let made = recipe.make(recipe.seeds.min(2), &Executor::default(), &before, &|| ());
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
        let made = recipe.make(3, &Executor::default(), &Errors::new(), &|| {
            heard.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        });
        assert_eq!(heard.into_inner(), 3);
        assert_eq!(made.errors, [1, 2, 3].map(|seed| rms_best(&cell.setup(seed)).unwrap()));
        assert_eq!(made.numbers, cell.numbers(&made.errors));
    }
}
