//! The truth: a place, a drive through it and what the sensors report. No filter may import this module.

mod drive;
mod field;
mod floor_plan;

pub use drive::{corners_cut_short, drive};
pub use field::{Field, WINGS_LOST, WINGS_SIGN};
pub use floor_plan::{FloorPlan, Segment};
