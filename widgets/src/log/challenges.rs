//! Ways of mapping a log that are worth trying.

use super::model::LogModel;
use crate::{challenge::Challenge, words::log as words};

pub(super) fn challenges() -> Vec<Challenge<LogModel>> {
    vec![
        Challenge::new("odometry", words::chip_odometry(), "odometry=on"),
        Challenge::new("one", words::chip_one(), "universes=1"),
        Challenge::new("never", words::chip_never(), "policy=never"),
        Challenge::new("coarse", words::chip_coarse(), "cell=0.2"),
    ]
}
