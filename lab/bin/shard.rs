//! Shares of a sweep, run apart and put together again.

use crate::in_file;
use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::path::PathBuf;
use std::str::FromStr;

/// The `index`-th of `count` shares, counted from 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Shard {
    index: usize,
    count: usize,
}

impl Shard {
    /// Everything.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Its share of all that is to be run.
    pub fn of<T>(self, all: Vec<T>) -> Vec<T> {
        all.into_iter().skip(self.index - 1).step_by(self.count).collect()
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        match parts {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("must be I/N with I from 1 to N".to_owned()),
        }
    }
}

/// What a share prints, and `--merge` reads.
pub trait Share: Serialize + DeserializeOwned {
    /// The command that prints it.
    const COMMAND: &'static str;

    /// Which share it is.
    fn shard(&self) -> Shard;

    /// Whether another one is of the same sweep.
    fn same_sweep(&self, other: &Self) -> bool;
}

/// The shares of these files, if they are all of one sweep.
pub fn merge<S: Share>(files: &[PathBuf]) -> Result<Vec<S>> {
    let mut shares: Vec<S> = Vec::new();
    for path in files {
        let text = std::fs::read_to_string(path).with_context(in_file(path))?;
        let file = path.display();
        let share: S = serde_json::from_str(&text)
            .with_context(|| format!("{file}: not the output of {} --shard I/N --json", S::COMMAND))?;
        let Shard { index, count } = share.shard();
        if let Some(first) = shares.first() {
            let same = first.same_sweep(&share) && first.shard().count == count;
            ensure!(same, "{file}: a share of another sweep than the first file");
        }
        let twice = shares.iter().any(|other| other.shard() == share.shard());
        ensure!(!twice, "{file}: share {index}/{count} is there twice");
        shares.push(share);
    }
    let count = shares[0].shard().count;
    let missing: Vec<String> = (1..=count)
        .filter(|index| shares.iter().all(|share| share.shard().index != *index))
        .map(|index| format!("{index}/{count}"))
        .collect();
    ensure!(missing.is_empty(), "--merge: shares missing: {}", missing.join(", "));
    Ok(shares)
}
