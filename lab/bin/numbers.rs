//! `fastslam-lab numbers`: every measured number of the chapter, into the file that its prose takes them from.

use crate::{Usage, in_file, progress};
use anyhow::{Context, Result, bail};
use fastslam::execute::Executor;
use fastslam_lab::experiment::numbers::{Errors, FIRST_SEEDS, Number, Recipe, owner, recipes};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::to_string as json;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Measure every number of the chapter, and write them by key
///
/// Beside the file it writes the errors behind the lap table (lap-table.json) and fingerprints of what the first seeds alone come
/// to (first-seeds.json), by which tests see in seconds whether the numbers still hold.
#[derive(clap::Args)]
pub struct Arguments {
    /// The file
    #[arg(long, value_name = "FILE", default_value = "www/data/numbers.json")]
    out: PathBuf,
    /// Measure only those whose key begins so, and leave the others in the file as they are
    #[arg(long, value_name = "PREFIX")]
    only: Option<String>,
}

/// What the file says of one number.
#[derive(Serialize, Deserialize)]
struct Entry {
    value: f64,
    unit: String,
    made: String,
}

/// A file of one JSON object, whose lines are its properties.
struct Properties<T> {
    path: PathBuf,
    values: BTreeMap<String, T>,
}

impl<T: Serialize + DeserializeOwned> Properties<T> {
    /// What the file holds, where that is to be kept.
    fn read(path: PathBuf, keep: bool) -> Result<Self> {
        let values = match std::fs::read_to_string(&path) {
            Ok(text) if keep => serde_json::from_str(&text).with_context(in_file(&path))?,
            _ => BTreeMap::new(),
        };
        Ok(Self { path, values })
    }

    /// Forgets what these recipes made, and what nobody makes any more.
    fn forget(&mut self, all: &[Recipe], again: &[&Recipe]) {
        self.values.retain(|key, _| {
            let maker = all.iter().find(|recipe| recipe.name == *key).or_else(|| owner(all, key));
            maker.is_some_and(|maker| again.iter().all(|recipe| recipe.name != maker.name))
        });
    }

    /// A line for each property, so that a change of one is seen as one.
    fn write(&self) -> Result<()> {
        let line = |(key, value)| Ok(format!("{}: {}", json(key)?, json(value)?));
        let lines: Result<Vec<String>> = self.values.iter().map(line).collect();
        let text = format!("{{\n{}\n}}\n", lines.with_context(in_file(&self.path))?.join(",\n"));
        std::fs::write(&self.path, text).with_context(in_file(&self.path))
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let (all, prefix) = (recipes(), arguments.only.as_deref().unwrap_or_default());
    let asked: Vec<&Recipe> =
        all.iter().filter(|recipe| recipe.name.starts_with(prefix) || recipe.could_own(prefix)).collect();
    if asked.is_empty() {
        bail!(Usage(format!("--only {prefix}: no number begins so")));
    }
    let beside = |name: &str| arguments.out.parent().unwrap_or(Path::new("")).join(name);
    let keep = arguments.only.is_some();
    let mut numbers: Properties<Entry> = Properties::read(arguments.out.clone(), keep)?;
    let mut laps: Properties<Vec<f64>> = Properties::read(beside("lap-table.json"), keep)?;
    let mut first_seeds: Properties<String> = Properties::read(beside("first-seeds.json"), keep)?;
    numbers.forget(&all, &asked);
    laps.forget(&all, &asked);
    first_seeds.forget(&all, &asked);
    let seeds: u32 = asked.iter().map(|recipe| recipe.seeds + recipe.seeds.min(FIRST_SEEDS)).sum();
    let bar = progress(seeds as usize, "seeds");
    let mut first_errors: Errors = laps.values.iter().map(|(name, errors)| (name.clone(), first_of(errors))).collect();
    for recipe in asked {
        let make = |seeds, before: &Errors| recipe.make(seeds, &Executor::default(), before, &|| bar.inc(1));
        let made = make(recipe.seeds, &laps.values);
        let first = make(recipe.seeds.min(FIRST_SEEDS), &first_errors);
        first_seeds.values.insert(recipe.name.clone(), format!("{:016x}", first.digest().value()));
        if !made.errors.is_empty() {
            laps.values.insert(recipe.name.clone(), made.errors);
            first_errors.insert(recipe.name.clone(), first.errors);
        }
        for Number { key, value, unit, made } in made.numbers {
            numbers.values.insert(key, Entry { value, unit: unit.to_owned(), made });
        }
    }
    bar.finish_and_clear();
    numbers.write()?;
    laps.write()?;
    first_seeds.write()
}

fn first_of(errors: &[f64]) -> Vec<f64> {
    errors.iter().copied().take(FIRST_SEEDS as usize).collect()
}
