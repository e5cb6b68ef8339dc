//! What a reader at the wheel holds. It is no part of the recipe.

/// What a reader has in the hand.
#[derive(Clone, Copy, PartialEq, Eq, Debug, strum::EnumString)]
#[strum(serialize_all = "lowercase")]
pub enum Tool {
    /// Drives the robot.
    Wheel,
    /// Puts up walls.
    Wall,
    /// Takes walls away.
    Erase,
    /// Lifts the robot, and sets it down elsewhere.
    Lift,
}

/// A tool, and where it is.
#[derive(Clone, PartialEq, Debug)]
pub struct Hand {
    pub tool: Tool,
    /// Moved by keys, on the grid of walls \[m\].
    pub cursor: [f64; 2],
    /// Whether it is by keys that the tool is used: then it has to be said where the cursor is.
    pub keyed: bool,
    /// One end of a wall, whose other end is still to be set.
    pub begun: Option<[f64; 2]>,
}
