//! The last scan, and what follows from it of where the robot is.

use crate::geometry::Pose2;

/// A motion is extrapolated over at most this many times its own duration.
const FORESEEN: f64 = 3.0;

/// The last scan.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Last {
    pub(super) time: f64,
    /// By odometry itself.
    pub(super) told: Pose2,
    pub(super) pose: Pose2,
    /// The motion that led there.
    pub(super) motion: Pose2,
    pub(super) elapsed: f64,
    /// Whether the motion before it was about the same: only then does the next one follow from it.
    pub(super) steady: bool,
}

impl Last {
    /// Where the robot is after so long \[s\], if it goes on as it went.
    pub(super) fn ahead(&self, elapsed: f64) -> Pose2 {
        let times = if self.elapsed > 0.0 && elapsed >= 0.0 { (elapsed / self.elapsed).min(FORESEEN) } else { 1.0 };
        let Pose2 { x, y, theta } = self.motion;
        self.pose.compose(&Pose2::new(times * x, times * y, times * theta))
    }

    /// Whether the last motion is recent enough, after so long \[s\], for the robot to be expected to go on.
    pub(super) fn is_recent(&self, elapsed: f64) -> bool {
        elapsed <= FORESEEN * self.elapsed
    }

    /// Where it is without a jump of what is told: it goes on, or its heading does; it stays, or its heading does.
    pub(super) fn without_jump(&self, elapsed: f64, told: &Pose2) -> [Pose2; 4] {
        let turned_as = |pose: Pose2| Pose2 { theta: pose.theta, ..*told };
        let ahead = self.ahead(elapsed);
        [ahead, turned_as(ahead), self.pose, turned_as(self.pose)]
    }
}
