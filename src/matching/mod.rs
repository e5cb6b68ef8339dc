//! How well a scan fits a map, and where it fits best.

mod climb;
mod score;

pub(crate) use climb::climb;
pub use climb::{Climb, ClimbSteps};
pub use score::{Kernel, Matcher, ScanModel};
