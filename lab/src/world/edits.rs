//! What a reader changes about a course: its walls, and how it is driven.
//!
//! Both have a text of few letters, for links. It begins with the version of the format, and is read strictly: what was not written
//! by [`core::fmt::Display`] here is refused, and nothing is guessed.

mod steering;
mod walls;

pub use steering::{FORWARD, MOST_LIFTS, MOST_STEPS, Motion, Place, Steering, TURN, Turn};
pub use walls::{GRID, GridWall, MOST_WALLS, WallEdits, WallId};

use super::FloorPlan;
use core::fmt;

/// Walls and drive of a reader; by default neither.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Edits {
    /// Walls taken away, and walls put up.
    pub walls: WallEdits,
    /// What is driven instead of the course's own drive.
    pub steering: Steering,
}

impl Edits {
    /// Whether a place with a drive of so many steps can be changed like this.
    ///
    /// # Errors
    /// The field, and what is wrong with it.
    pub fn fit(&self, plan: &FloorPlan, steps: usize) -> Result<(), (&'static str, EditError)> {
        self.walls.fit(plan).map_err(|error| ("plan", error))?;
        self.steering.fit(plan, steps).map_err(|error| ("drive", error))
    }
}

/// Why a change of a course is refused.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EditError {
    /// It is of another version of the format, or none.
    Version,
    /// It is longer than any that can be written.
    Long,
    /// It is nothing that is written here.
    Garbled,
    /// It has more walls, steps or liftings than there may be.
    Many,
    /// It names a wall or a point that the place does not have, or an outer wall.
    Outside,
}

impl EditError {
    /// What is allowed, in words that follow *must be*.
    pub fn allowed(self) -> &'static str {
        match self {
            Self::Version => "of version 1: begin with \"1.\"",
            Self::Long => "as short as the figure writes it",
            Self::Garbled => "as the figure writes it",
            Self::Many => "of at most 60 walls of each kind, 400 steps and 8 liftings",
            Self::Outside => "inside the outer walls of the course",
        }
    }
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "must be {}", self.allowed())
    }
}

impl core::error::Error for EditError {}

/// The text after the version; `None` for an empty one, which changes nothing.
fn body(text: &str, most: usize) -> Result<Option<&str>, EditError> {
    if text.len() > most {
        return Err(EditError::Long);
    }
    if text.is_empty() {
        return Ok(None);
    }
    text.strip_prefix("1.").map(Some).ok_or(EditError::Version)
}
