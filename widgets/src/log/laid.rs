//! The same scans without a filter: laid out along raw odometry, as if the wheels had told the truth.

use fastslam::{
    geometry::Pose2,
    mapper::{LaserMapperSettings, Replay},
};
use fastslam_log::LaserLog;
use std::collections::BTreeSet;

/// Cells in which beams end that are laid out along raw odometry, in the frame of the first pose, as the maps are. They are kept in the order in
/// which they were found, so that going back to a step is to take the first so many of them.
#[derive(Default)]
pub struct Laid {
    cells: Vec<[i32; 2]>,
    found: BTreeSet<[i32; 2]>,
    /// After each step, the first being 0.
    steps: Vec<Step>,
    /// Scans of the log up to the last step's: the next step takes the next.
    scans: usize,
    /// The least and the greatest cell.
    corners: Option<[[i32; 2]; 2]>,
}

/// What there is after a step.
struct Step {
    cells: usize,
    odometry: Pose2,
}

impl Laid {
    /// The scan that a mapping has taken last, laid out too; to be called after each of its steps.
    pub fn follow(&mut self, replay: &Replay<LaserLog>, log: &LaserLog) {
        if let Some(scan) = log.scans.get(self.scans) {
            let settings: &LaserMapperSettings = replay.mapper().settings();
            let odometry = log.scans[0].odometry.between(&scan.odometry);
            let ends = scan.end_points(settings.no_return.unwrap_or(f64::INFINITY), settings.max_range);
            for end in ends.hits {
                self.mark(odometry.transform(end).map(|metres| (metres / settings.cell_size).floor() as i32));
            }
            self.steps.push(Step { cells: self.cells.len(), odometry });
        }
        self.scans = replay.scans();
    }

    fn mark(&mut self, cell: [i32; 2]) {
        if self.found.insert(cell) {
            self.cells.push(cell);
            let [low, high] = self.corners.unwrap_or([cell; 2]);
            self.corners = Some([[0, 1].map(|k| low[k].min(cell[k])), [0, 1].map(|k| high[k].max(cell[k]))]);
        }
    }

    /// The cells after a step.
    pub fn cells(&self, step: u32) -> &[[i32; 2]] {
        self.steps.get(step as usize).map_or(&[], |step| &self.cells[..step.cells])
    }

    /// Where raw odometry has the robot after a step, in the frame of the first pose.
    pub fn odometry(&self, step: u32) -> Option<Pose2> {
        self.steps.get(step as usize).map(|step| step.odometry)
    }

    /// The least and the greatest of all cells, whichever step is shown.
    pub fn corners(&self) -> Option<[[i32; 2]; 2]> {
        self.corners
    }
}
