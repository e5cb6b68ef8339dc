//! What the fuzzer does with each input. The laws of logs do the same with mutilated logs (`tests/laws/tests/all/log.rs`).

use fastslam::mapper::{LaserMapperSettings, Replay};
use fastslam_log::{parse, parse_relations};
use std::sync::Arc;

/// Any bytes as a log: the parser refuses or reads them, and the filter maps what was read, without a panic.
pub fn any_bytes(bytes: &[u8]) {
    let _ = parse(bytes, false);
    let _ = parse_relations(bytes);
    let Ok(log) = parse(bytes, true) else { return };
    let settings =
        LaserMapperSettings { particles: 1, max_range: 2.0, cell_size: 0.2, ..LaserMapperSettings::default() };
    let replay = Replay::new(settings, Arc::new(log)).expect("the settings are in their ranges");
    // Long logs only take time.
    replay.take(20).for_each(drop);
}
