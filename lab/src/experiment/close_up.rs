//! Single scans of the apartment against single maps: what small figures of the chapter look at.

use super::lap::{FROM_SCAN, GRID, OUTLIER, TEMPER};
use crate::world::FloorPlan;
use fastslam::geometry::{Gaussian3, Pose2};
use fastslam::map::grid::{Grid, GridModel};
use fastslam::map::{ConditionalMap as _, Footprint};
use fastslam::matching::{Matcher, ScanModel};
use fastslam::motion::OdometryModel;
use fastslam::proposal::{Found, FromScan, FromScanSettings};
use fastslam::sensor::{BeamSensor, Scan};

/// The first `beams` of so many that a laser without noise has from a place of the apartment \[m\].
pub fn scan([x, y]: [f64; 2], of: usize, beams: usize) -> Scan {
    let sensor = BeamSensor::panorama(of, 8.0, 0.0);
    let plan = FloorPlan::apartment();
    let ranges: Vec<f64> = sensor.angles.iter().take(beams).map(|angle| plan.raycast([x, y], *angle)).collect();
    sensor.scan(&ranges)
}

/// A map of which nothing is known yet.
pub fn map() -> Grid {
    Grid::new(GridModel { lag: 0, ..GRID })
}

/// Maps one more scan.
pub fn see(map: &mut Grid, pose: &Pose2, scan: &Scan) {
    map.assimilate(pose, scan, &());
}

/// Memory of these maps.
pub fn footprint(maps: &[Grid]) -> Footprint {
    Grid::footprint(maps)
}

fn model(matcher: Matcher) -> ScanModel {
    ScanModel::new(matcher, TEMPER, OUTLIER)
}

/// The score of a scan at each of these poses \[nats\].
pub fn scores(matcher: Matcher, map: &Grid, scan: &Scan, poses: &[Pose2]) -> Vec<f64> {
    let model = model(matcher);
    poses.iter().map(|pose| model.log_score(map, pose, scan)).collect()
}

/// What the measurement-aware proposal finds for a motion of this Gaussian, before it draws.
pub fn find(motion: &Gaussian3, map: &Grid, scan: &Scan) -> Found {
    // Of so few beams all are looked at.
    let settings = FromScanSettings { climb_stride: 1, ..FROM_SCAN };
    let motion_noise = OdometryModel { alphas: [0.0; 4] };
    let proposal = FromScan { motion: motion_noise, score: model(Matcher::SubCell), settings };
    proposal.find(motion, map, scan)
}
