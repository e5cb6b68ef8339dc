//! The truth: a place, a drive through it and what the sensors report. No filter may import this module.

mod collision;
mod drive;
mod edits;
mod field;
mod floor_plan;
mod long_ring;

pub use collision::ROBOT_RADIUS;
pub use drive::{corners_cut_short, drive};
pub use edits::{
    EditError, Edits, FORWARD, GRID, GridWall, MOST_LIFTS, MOST_STEPS, MOST_WALLS, Motion, Place, Steering, TURN, Turn,
    WallEdits, WallId,
};
pub use field::{Field, WINGS_LOST, WINGS_SIGN};
pub use floor_plan::{FloorPlan, Segment};
pub use long_ring::{LongRing, crowd, escort, until_people};
