//! How well a scan fits a map, and where it fits best.

mod hill_climb;
mod score;

pub use hill_climb::hill_climb;
pub use hill_climb::{HillClimbSteps, ScoredPose};
pub use score::{Kernel, Matcher, ScanModel};
