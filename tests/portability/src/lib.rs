//! The chapter's numbers made again, to the bit: what the native tests and those in the browser share.

use fastslam::execute::Executor;
use fastslam_lab::experiment::numbers::{Errors, FIRST_SEEDS, LapCell, Made, Number, Recipe, SEEDS, owner, recipes};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, BTreeSet};

/// What the chapter's prose takes its numbers from.
pub const NUMBERS: &str = include_str!("../../../www/data/numbers.json");
const LAPS: &str = include_str!("../../../www/data/lap-table.json");
const FIRST: &str = include_str!("../../../www/data/first-seeds.json");

/// What a line of the file says.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Entry {
    /// In its unit.
    pub value: f64,
    /// Empty for pure numbers.
    pub unit: String,
    /// How it is made.
    pub made: String,
}

/// By key.
pub type Entries = BTreeMap<String, Entry>;

/// # Panics
/// Where a file was not written by `fastslam-lab numbers`.
pub fn read<T: DeserializeOwned>(text: &str) -> BTreeMap<String, T> {
    serde_json::from_str(text).expect("`npm run numbers` writes the files in www/data")
}

/// A recipe as this build makes it.
#[derive(Default)]
pub struct Remade {
    /// By its first seeds alone.
    first: Option<Made>,
    /// By all its seeds.
    whole: Option<Made>,
}

/// Which recipes are run anew, and by how many seeds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Extent {
    /// The first recipe of each group of names (all before the dot), by its first seeds.
    Groups,
    /// All recipes, by their first seeds, whose fingerprints are kept.
    FirstSeeds,
    /// All recipes, by all seeds but where these take minutes.
    AllSeeds,
}

/// Runs every recipe anew, in their order.
pub fn remake(executor: &Executor, extent: Extent) -> Vec<Remade> {
    let laps = read::<Vec<f64>>(LAPS);
    let first = |errors: &Vec<f64>| errors.iter().copied().take(FIRST_SEEDS as usize).collect();
    let first_laps: Errors = laps.iter().map(|(name, errors)| (name.clone(), first(errors))).collect();
    let mut groups = BTreeSet::new();
    let remade = recipes().into_iter().map(|recipe| {
        let is_first = groups.insert(recipe.name.split('.').next().map(str::to_owned));
        if extent == Extent::Groups && !is_first {
            return Remade::default();
        }
        let make = |seeds, before| recipe.make(seeds, executor, before, &|| ());
        let first = Some(make(recipe.seeds.min(FIRST_SEEDS), &first_laps));
        let few = if extent == Extent::AllSeeds { SEEDS - 1 } else { FIRST_SEEDS };
        let whole = (recipe.seeds <= few).then(|| make(recipe.seeds, &laps));
        Remade { first, whole }
    });
    remade.collect()
}

/// What in these files does not hold, in a line each. Where not all seeds were run, the first ones are compared by their fingerprint, and the lap
/// table is worked out anew from the errors kept of every seed; all else is compared in full.
pub fn differences(entries: &Entries, remade: &[Remade]) -> Vec<String> {
    let (laps, first_seeds) = (read::<Vec<f64>>(LAPS), read::<String>(FIRST));
    let recipes = recipes();
    let mut found: Vec<String> = entries
        .keys()
        .filter(|key| owner(&recipes, key).is_none())
        .map(|key| format!("{key}: nothing makes it"))
        .collect();
    for (recipe, Remade { first, whole }) in recipes.iter().zip(remade) {
        let Some(first) = first else { continue };
        let name = &recipe.name;
        if first_seeds.get(name) != Some(&format!("{:016x}", first.digest().value())) {
            found.push(format!("{name}: its first seeds come to other numbers, or to others than before"));
        }
        let kept = laps.get(name).map_or(&[][..], Vec::as_slice);
        let expected = if first.errors.is_empty() { 0 } else { SEEDS as usize };
        if kept.len() != expected || !same_bits(&kept[..first.errors.len()], &first.errors) {
            found.push(format!("{name}: lap-table.json has other errors"));
        } else if let Some(cell) = LapCell::all().find(|cell| cell.name() == *name) {
            compare(entries, &recipes, recipe, &cell.numbers(kept), &mut found);
        } else if let Some(whole) = whole {
            compare(entries, &recipes, recipe, &whole.numbers, &mut found);
        }
    }
    found
}

fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.iter().map(|x| x.to_bits()).eq(b.iter().map(|x| x.to_bits()))
}

/// Whether what the file has of a recipe is among these numbers. It need not have all: `npm run numbers` leaves out those that no
/// page uses, and one that a page misses fails the build of the pages.
fn compare(entries: &Entries, recipes: &[Recipe], of: &Recipe, numbers: &[Number], found: &mut Vec<String>) {
    for Number { key, value, unit, made } in numbers {
        match entries.get(key) {
            Some(kept) if kept.value.to_bits() != value.to_bits() => {
                found.push(format!("{key}: {} in the file, {value} now", kept.value));
            }
            Some(kept) if kept.unit != *unit || kept.made != *made => {
                found.push(format!("{key}: it is made otherwise now"))
            }
            _ => (),
        }
    }
    let is_left = |key: &&String| owner(recipes, key).is_some_and(|owner| owner.name == of.name);
    let left = entries.keys().filter(is_left).filter(|key| numbers.iter().all(|number| number.key != **key));
    found.extend(left.map(|key| format!("{key}: its recipe makes no such number any more")));
}

/// # Panics
/// Where the files do not hold, with what to do about it.
pub fn assert_fresh(remade: &[Remade]) {
    let found = differences(&read(NUMBERS), remade);
    assert!(
        found.is_empty(),
        "www/data is stale; if this change is wanted, `npm run numbers` writes it:\n{}",
        found.join("\n")
    );
}
