//! What is said of a log as a whole before it is mapped, and put right where it can be.

use fastslam::mapper::{LaserMapperSettings, OdometryCheck, OdometryFault};
use fastslam_log::{Beyond, LaserLog, Remark, UnitChange};

/// Says that many readings are beyond the longest range that is declared.
pub fn say_beyond(log: &LaserLog, name: &str) {
    let readings: usize = log.scans.iter().map(|scan| scan.ranges.len()).sum();
    let Beyond { count, shortest, max_range } = log.notes.beyond;
    if count as usize > readings / 10 {
        eprintln!(
            "fastslam: {name}: readings beyond range_max, {max_range:.1} m, which are not used: {count} of {readings}, the shortest of them {shortest:.1}"
        );
    }
}

/// Brings ranges to one unit where theirs changes, and says so.
pub fn bring_to_one_unit(log: &mut LaserLog, name: &str) {
    let changes = log.bring_to_one_unit();
    let Some(UnitChange { time, times }) = changes.first() else { return };
    let (long, times) = if *times > 1.0 { ("long", times.round()) } else { ("short", times.recip().round()) };
    eprintln!(
        "fastslam: {name}: ranges change their unit, {} times in all: from {time:.3} s on they are {times} times as {long}; they are brought to one unit",
        changes.len()
    );
}

/// Leaves readings out that are one number too often, and says which.
pub fn leave_constants_out(log: &mut LaserLog, name: &str) {
    for (range, count) in log.leave_constants_out() {
        eprintln!(
            "fastslam: {name}: readings of {range} m, the same to the last digit: {count}; they are no ranges, and are not used"
        );
    }
}

/// Brings all ranges to metres, if odometry proves that they are in another unit, and says so.
pub fn ranges_in_metres(log: &mut LaserLog, settings: &LaserMapperSettings, name: &str) {
    let without = |remark: &Remark| matches!(remark, Remark::NoOdometry | Remark::StillOdometry);
    if log.notes.remarks.iter().any(without) {
        return;
    }
    if let Some((metres, unit)) = OdometryCheck::unit_of_ranges(&log.scans, settings) {
        for range in log.scans.iter_mut().flat_map(|scan| &mut scan.ranges) {
            *range *= metres as f32;
        }
        eprintln!(
            "fastslam: {name}: ranges and odometry go together only if ranges are in {unit}, and not in metres: they are read as {unit}"
        );
    }
}

/// Takes the ranges from scans that repeat the one before while the robot drives, and says how many there were.
pub fn leave_repeated_out(log: &mut LaserLog, name: &str) -> usize {
    let Some((count, time)) = log.leave_repeated_out() else { return 0 };
    eprintln!(
        "fastslam: {name}: scans that repeat the one before, to the last digit, while odometry moves: {count}, the first at {time:.3} s; of these only the odometry is used"
    );
    count
}

/// Puts odometry right that scans contradict throughout, and says so: what is wrong with it. One fault may hide another, as headings in degrees hide that the
/// laser is turned.
pub fn put_right(log: &mut LaserLog, settings: &LaserMapperSettings, name: &str) -> Vec<OdometryFault> {
    const MOST: usize = 3;
    let mut faults = Vec::new();
    if log.notes.remarks.iter().any(|remark| matches!(remark, Remark::NoOdometry | Remark::StillOdometry)) {
        return faults;
    }
    while faults.len() < MOST
        && let Some(fault) = OdometryCheck::of(&log.scans, settings).and_then(|check| check.fault())
    {
        let is_unrelated = matches!(fault, OdometryFault::Unrelated { .. });
        if is_unrelated && !faults.is_empty() {
            break;
        }
        log.notes.lost = fault.put_right(&mut log.scans);
        let done = match is_unrelated {
            true => "is taken for none, and each scan is matched with those before",
            false => "is corrected by that",
        };
        eprintln!("fastslam: {name}: {fault} Odometry {done}");
        faults.push(fault);
        if is_unrelated {
            break;
        }
    }
    faults
}

/// Says that scans met nothing within the longest range that counts, if one in ten did, and how many there were.
pub fn say_blind(log: &LaserLog, settings: &LaserMapperSettings, name: &str) -> usize {
    let longest = settings.for_scans(&log.scans).no_return.unwrap_or(f64::INFINITY);
    let is_blind = |ranges: &[f32]| !ranges.iter().any(|range| *range > 0.0 && f64::from(*range) < longest);
    let blind: Vec<f64> = log.scans.iter().filter(|scan| is_blind(&scan.ranges)).map(|scan| scan.time).collect();
    if 10 * blind.len() > log.scans.len() {
        eprintln!(
            "fastslam: {name}: scans without a single range: {} of {}, the first at {:.3} s; of these only the odometry is used",
            blind.len(),
            log.scans.len(),
            blind[0]
        );
    }
    blind.len()
}
