//! Where the robot was at each scan by raw odometry, for logs that tell of scans and of odometry apart.

use super::{LaserLog, LogError, LogProblem, Remark, odometry_at};
use fastslam::geometry::Pose2;
use fastslam::mapper::match_scans;
use fastslam::sensor::LaserScan;

/// The odometry of a scan that has none of its own yet.
#[cfg(any(feature = "bags", feature = "json"))]
pub(super) const NOWHERE: Pose2 = Pose2 { x: f64::NAN, y: f64::NAN, theta: f64::NAN };

/// Odometry that stays this near to its first pose \[m, rad\] tells of no motion.
pub(super) const STILL: f64 = 1e-3;

/// So near to the first one \[m, rad\] are the poses of scans that are matched to each other where the robot stands.
const STANDING: f64 = 0.1;

/// Gives each scan without a pose the one that odometry has at its stamp, or, where there is no odometry, or odometry that never moves while
/// scans do, the one that it has when scans are matched to each other. Scans and odometry are in order.
pub(super) fn place(log: &mut LaserLog) -> Result<(), LogError> {
    if stay(log.odometry.iter().map(|(_, pose)| pose), STILL) && (log.scans.len() > 1 || log.odometry.is_empty()) {
        by_scans(log);
    } else if log.scans.iter().any(is_nowhere) {
        by_odometry(log)?;
    } else {
        return Ok(());
    }
    for pair in log.scans.windows(2) {
        let jump = pair[0].odometry.distance(&pair[1].odometry);
        if jump > LaserScan::FARTHEST_JUMP {
            return Err(LogError::whole(LogProblem::OdometryJumps { kilometres: 1e-3 * jump, time: pair[1].time }));
        }
    }
    let known = |time: f64| log.odometry.binary_search_by(|(t, _)| t.total_cmp(&time)).is_ok();
    let own: Vec<_> =
        log.scans.iter().map(|scan| (scan.time, scan.odometry)).filter(|(time, _)| !known(*time)).collect();
    log.odometry.extend(own);
    log.odometry_in_order();
    Ok(())
}

fn is_nowhere(scan: &LaserScan) -> bool {
    scan.odometry.x.is_nan()
}

/// Whether all poses are this near to the first \[m, rad\].
fn stay<'a>(mut poses: impl Iterator<Item = &'a Pose2>, near: f64) -> bool {
    poses.next().is_none_or(|first| poses.all(|pose| pose.minus(first).amax() < near))
}

/// By matching scans to each other; where they say that the robot stands, odometry that says so too is right.
fn by_scans(log: &mut LaserLog) {
    let told: Vec<Pose2> = log.scans.iter().map(|scan| scan.odometry).collect();
    log.notes.lost = match_scans(&mut log.scans);
    match log.odometry.first() {
        None => log.notes.remarks.push(Remark::NoOdometry),
        Some((_, pose)) if stay(log.scans.iter().map(|scan| &scan.odometry), STANDING) => {
            log.notes.lost.clear();
            for (scan, told) in log.scans.iter_mut().zip(told) {
                scan.odometry = if told.x.is_nan() { *pose } else { told };
            }
        }
        Some(_) => {
            log.notes.remarks.push(Remark::StillOdometry);
            log.odometry.clear();
        }
    }
}

/// By odometry: straight in x and y and along the shorter turn between its poses; before the first and after the last one that pose holds.
fn by_odometry(log: &mut LaserLog) -> Result<(), LogError> {
    let [begin, end] = [log.odometry.first(), log.odometry.last()].map(|pose| pose.map_or(f64::NAN, |(time, _)| *time));
    let [first, last] = [&log.scans[0], &log.scans[log.scans.len() - 1]].map(|scan| scan.time);
    if last < begin || end < first {
        return Err(LogError::whole(LogProblem::NoCommonTime { scans: [first, last], odometry: [begin, end] }));
    }
    let mut beyond = 0;
    for scan in log.scans.iter_mut().filter(|scan| is_nowhere(scan)) {
        let at = log.odometry.partition_point(|(time, _)| *time < scan.time);
        let exact = log.odometry.get(at).filter(|(time, _)| *time == scan.time).map(|(_, pose)| *pose);
        beyond += u32::from(!(begin..=end).contains(&scan.time));
        scan.odometry = exact.or_else(|| odometry_at(&log.odometry, scan.time)).unwrap_or_default();
    }
    if beyond > 0 {
        log.notes.remarks.push(Remark::Beyond(beyond));
    }
    Ok(())
}
