//! What whoever reads a path and a map should know of them: each remark as the data that tell of it, so that whoever shows it can say it in the
//! words of his readers. Displayed, they are said in English.

use super::LaserMapper;
use super::scale::DrivenScale;
use crate::error::fixed;
use crate::geometry::driven;
use core::fmt;

/// What one does not see at once of a path and a map.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum Remark {
    /// The clock or the scans contradict odometry.
    Contradicted {
        /// Steps that are matched with the scans before, in place of what odometry tells.
        steps: usize,
        /// Stamp of the scan that the first of them leads to \[s\].
        time: f64,
        /// How far, by odometry, that step goes \[m\] and turns \[rad\].
        told: [f64; 2],
        /// How long it took \[s\].
        elapsed: f64,
    },
    /// The robot drives further by the scans than by odometry, or less far, throughout: the size of one of them is wrong, and the path cannot tell of which.
    OtherScale {
        /// How far it drives by the scans, per metre of odometry: the median over legs of a metre.
        times: f64,
        /// Standard error of it.
        std: f64,
    },
    /// So many scans, of which the robot moved in none.
    NeverMoved(usize),
    /// No beam met anything within the longest range that counts, or only those of one scan in twenty.
    NothingMet,
    /// The path comes back to places that it does not meet.
    OpenLoops {
        /// How many there are.
        loops: usize,
        /// Stamp of the last scan of the last of them \[s\].
        time: f64,
    },
    /// The scans by which a path that is bent is mapped again are not all of them: more than may be kept were taken.
    Thinned {
        /// How many there are.
        kept: usize,
        /// How many were taken.
        taken: usize,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Contradicted { steps, time, told: [metres, turn], elapsed } => write!(
                f,
                "steps at which the clock or the scans contradict odometry: {steps}, the first at {} s ({} m and {}° in {} s); they are matched with the scans before",
                fixed(*time, 3),
                fixed(*metres, 2),
                fixed(turn.to_degrees(), 0),
                fixed(*elapsed, 1)
            ),
            Self::OtherScale { times, std } => write!(
                f,
                "by the scans the robot drives {} ± {} times as far as by its odometry: either the scale of the ranges is off, and with it the size of the map, or that of odometry; the log does not tell which",
                fixed(*times, 3),
                fixed(*std, 3)
            ),
            Self::NeverMoved(scans) => write!(
                f,
                "only the first of {scans} scans is mapped: by odometry and by what they see, the robot never moves"
            ),
            Self::NothingMet => f.write_str(
                "the map is empty: hardly a beam met anything within the longest range that counts; are the ranges in metres?",
            ),
            Self::OpenLoops { loops, time } => write!(
                f,
                "loops that stay open: {loops}, the last of them at {} s; what is seen there contradicts the map of before",
                fixed(*time, 3)
            ),
            Self::Thinned { kept, taken } => write!(
                f,
                "of the {taken} scans that were taken {kept} are kept: where a path is bent to close a loop, it is mapped again by these"
            ),
        }
    }
}

impl LaserMapper {
    /// What whoever reads path and map should know of them.
    pub fn remarks(&self) -> Vec<Remark> {
        let unbelieved = self.unbelieved();
        let contradicted = unbelieved.first().map(|first| Remark::Contradicted {
            steps: unbelieved.len(),
            time: first.time,
            told: driven(&first.told),
            elapsed: first.elapsed,
        });
        let path = self.best().path.poses();
        let scale = DrivenScale::of(&self.odometry, &path).filter(DrivenScale::is_off);
        let other_scale = scale.map(|DrivenScale { times, std }| Remark::OtherScale { times, std });
        let scans = self.stamps.len();
        let never_moved = (self.steps == 0 && scans > 1).then_some(Remark::NeverMoved(scans));
        let nothing_met = (scans > 0 && self.closings.met_nothing()).then_some(Remark::NothingMet);
        let last = self.open_loops().last().and_then(|last| self.at_step(last.to));
        let open = last.map(|(time, _)| Remark::OpenLoops { loops: self.open_loops().count(), time });
        let [kept, taken, _] = self.closings.kept_scans();
        let thinned = (kept < taken).then_some(Remark::Thinned { kept, taken });
        [contradicted, other_scale, never_moved, nothing_met, open, thinned].into_iter().flatten().collect()
    }
}
