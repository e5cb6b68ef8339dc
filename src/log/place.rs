//! Where the robot was at each scan by raw odometry, for logs that tell of scans and of odometry apart.

use super::{FARTHEST_JUMP, LaserLog, LaserScan, LogError, LogProblem, Remark, odometry_at, scan_to_scan};
#[cfg(any(feature = "bags", feature = "json"))]
use crate::geometry::Pose2;
use crate::mapper::tuning::NOTHING_MET;

/// The odometry of a scan that has none of its own yet.
#[cfg(any(feature = "bags", feature = "json"))]
pub(super) const NOWHERE: Pose2 = Pose2 { x: f64::NAN, y: f64::NAN, theta: f64::NAN };

/// Gives each scan without a pose the one that odometry has at its stamp: the very pose where there is one with that stamp, else what
/// lies between its neighbours, straight in x and y and along the shorter turn. Before the first pose and after the last one that pose
/// holds. Where there is no odometry at all, scans are matched to each other. Scans and odometry are in order.
pub(super) fn place(log: &mut LaserLog) -> Result<(), LogError> {
    let nowhere = |scan: &LaserScan| scan.odometry.x.is_nan();
    if !log.scans.iter().any(nowhere) {
        return Ok(());
    }
    let odometry = core::mem::take(&mut log.odometry);
    if let [(begin, _), .., (end, _)] | [(begin @ end, _)] = odometry[..] {
        let times = |scans: &[LaserScan]| [scans[0].time, scans[scans.len() - 1].time];
        let [first, last] = times(&log.scans);
        if last < begin || end < first {
            return Err(LogError::whole(LogProblem::NoCommonTime { scans: [first, last], odometry: [begin, end] }));
        }
        let mut beyond = 0;
        for scan in log.scans.iter_mut().filter(|scan| nowhere(scan)) {
            let at = odometry.partition_point(|(time, _)| *time < scan.time);
            let exact = odometry.get(at).filter(|(time, _)| *time == scan.time).map(|(_, pose)| *pose);
            beyond += u32::from(!(begin..=end).contains(&scan.time));
            scan.odometry = exact.or_else(|| odometry_at(&odometry, scan.time)).unwrap_or_default();
        }
        if beyond > 0 {
            log.notes.remarks.push(Remark::Beyond(beyond));
        }
    } else {
        let longest = NOTHING_MET * log.longest_reading();
        scan_to_scan::give_odometry(&mut log.scans, longest);
        log.notes.remarks.push(Remark::NoOdometry);
    }
    log.odometry = odometry;
    for pair in log.scans.windows(2) {
        let jump = pair[0].odometry.distance(&pair[1].odometry);
        if jump > FARTHEST_JUMP {
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
