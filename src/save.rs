//! The state of a filter, written to any format of serde and read back: [`Rbpf::save`](crate::rbpf::Rbpf::save) and
//! [`Rbpf::restore`](crate::rbpf::Rbpf::restore).
//!
//! Particles share most of what they hold: the trunk of their paths, and the tiles of their maps that only one ancestor wrote. What is shared is
//! written once and is shared again when it has been read, so that a state takes what the population takes, on the disk and in memory.
//! A restored filter goes on with the same bits as the one that was saved, in any format that keeps the bits of a number. (Of
//! `serde_json` that is so with its feature `float_roundtrip`.)
//!
//! What is read may have been written by anybody. It is checked in full before anything is made of it.

use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use serde::{Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Things that share memory, saved many at once so that what they share is written once. For a map of one's own that shares nothing,
/// `Saved` can be a vector of it.
pub trait SaveShared: Sized {
    /// Plain data. What it means is this version's own matter.
    type Saved: Serialize + DeserializeOwned;

    /// What these things hold together.
    fn save_all<'a>(all: impl IntoIterator<Item = &'a Self>) -> Self::Saved
    where
        Self: 'a;

    /// The same things in the same order, sharing what they shared.
    ///
    /// # Errors
    /// Where `saved` does not describe such things. It is hostile: no value of it may panic, here or later.
    fn restore_all(saved: Self::Saved) -> Result<Vec<Self>, RestoreError>;
}

/// What is wrong with a saved state.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// It was written by another version of this crate, in a form that this one does not read.
    #[error("version = {found}: must be {known}")]
    Version {
        /// Of the state.
        found: u32,
        /// The only one that is read.
        known: u32,
    },
    /// There are too few or too many of something.
    #[error("{part}: {found} of them, where there must be {needed}")]
    Count {
        /// Of what.
        part: &'static str,
        /// How many there are.
        found: usize,
        /// How many there must be.
        needed: usize,
    },
    /// Something refers to what is not there, or to what comes after it.
    #[error("{part}: number {index} is referred to, of {count}")]
    Reference {
        /// To what.
        part: &'static str,
        /// To which of them, from 0 on.
        index: u32,
        /// How many there are to refer to.
        count: usize,
    },
    /// Things that each may be so, but not together.
    #[error("{part}: must be {needed}")]
    Inconsistent {
        /// What.
        part: &'static str,
        /// How it must be.
        needed: &'static str,
    },
    /// A number out of its range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

/// Refuses another number of things than is needed.
pub(crate) fn count(part: &'static str, found: usize, needed: usize) -> Result<(), RestoreError> {
    if found == needed { Ok(()) } else { Err(RestoreError::Count { part, found, needed }) }
}

/// Refuses what does not hold.
pub(crate) fn holds(is: bool, part: &'static str, needed: &'static str) -> Result<(), RestoreError> {
    if is { Ok(()) } else { Err(RestoreError::Inconsistent { part, needed }) }
}

/// Refuses infinities and NaN.
pub(crate) fn finite(part: &'static str, numbers: impl IntoIterator<Item = f64>) -> Result<(), RestoreError> {
    numbers.into_iter().try_for_each(|number| Ok(Range::finite("").check(part, number).map(drop)?))
}

/// Refuses poses that are not finite.
pub(crate) fn poses(part: &'static str, poses: impl IntoIterator<Item = Pose2>) -> Result<(), RestoreError> {
    finite(part, poses.into_iter().flat_map(|pose| [pose.x, pose.y, pose.theta]))
}

/// The thing of an index.
pub(crate) fn at<'a, T>(part: &'static str, things: &'a [T], index: u32) -> Result<&'a T, RestoreError> {
    things.get(index as usize).ok_or(RestoreError::Reference { part, index, count: things.len() })
}

/// Numbers shared things in the order in which they are first met.
pub(crate) struct Table<'a, T> {
    /// By address.
    indices: BTreeMap<usize, u32>,
    /// Each once.
    pub things: Vec<&'a Arc<T>>,
}

impl<T> Default for Table<'_, T> {
    fn default() -> Self {
        Self { indices: BTreeMap::new(), things: Vec::new() }
    }
}

impl<'a, T> Table<'a, T> {
    /// The number of a thing that was met.
    pub fn known(&self, thing: &Arc<T>) -> Option<u32> {
        self.indices.get(&Arc::as_ptr(thing).addr()).copied()
    }

    /// The number of a thing, whether it was met or not.
    pub fn index(&mut self, thing: &'a Arc<T>) -> u32 {
        let next = self.things.len() as u32;
        let index = *self.indices.entry(Arc::as_ptr(thing).addr()).or_insert(next);
        if index == next {
            self.things.push(thing);
        }
        index
    }
}
