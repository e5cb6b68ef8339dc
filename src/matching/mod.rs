//! How well a scan fits a map, and where it fits best.

mod climb;
mod score;

pub use climb::{Climb, ClimbSteps};
pub(crate) use climb::climb;
pub use score::{Matcher, ScanModel};
