//! Any bytes as a log: the parser refuses or reads them, and the filter maps what was read, without a panic.
#![no_main]

use fastslam_lab::experiment::log::{LogRun, LogSetup};
use fastslam::log::{parse, parse_relations};
use libfuzzer_sys::fuzz_target;
use std::sync::Arc;

fuzz_target!(|bytes: &[u8]| {
    let _ = parse(bytes, false);
    let _ = parse_relations(bytes);
    let Ok(log) = parse(bytes, true) else { return };
    let setup = LogSetup { particles: 1, max_range: 2.0, cell_size: 0.2, ..LogSetup::default() };
    let mut run = LogRun::new(&setup, Arc::new(log)).expect("a log that was read has a scan");
    // Long logs only take time.
    for _ in 0..20 {
        if run.step().is_none() {
            break;
        }
    }
});
