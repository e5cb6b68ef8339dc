//! How well an observation fits a map, and where it fits best.
//!
//! A [`Likelihood`] judges one pose: all that [`FromMotion`](crate::proposal::FromMotion) needs. A [`Score`] can be asked about thousands of
//! poses near one place, which is what [`FromScan`](crate::proposal::FromScan) does in each step of each particle; [`ScanModel`] is the
//! one for grids.

mod hill_climb;
mod score;

pub use hill_climb::{HillClimbSteps, ScoredPose, hill_climb};
pub use score::{Kernel, Matcher, ScanModel, ScanNear};

use crate::error::SettingError;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;

/// ln p(z | x, m), and what the observation is taken to be of at x.
pub trait Likelihood<M: ConditionalMap>: Sync {
    /// The log-likelihood \[nats\] of an observation at a pose, by a map.
    fn log_likelihood(&self, map: &M, world_from_robot: &Pose2, observation: &M::Observation) -> (f64, M::Association);

    /// Whether all settings are in range: asked once, when a filter is built.
    ///
    /// # Errors
    /// Where one is not. As given here there are none.
    fn validate(&self) -> Result<(), SettingError> {
        Ok(())
    }
}

/// A likelihood that a proposal can search with, for maps in which the place alone decides what was seen.
pub trait Score<M: ConditionalMap<Association = ()>>: Likelihood<M> {
    /// The score of one observation by one map, near one place.
    type Near<'a>: ScoreNear
    where
        Self: 'a,
        M: 'a;

    /// Makes ready to be asked about many poses near `place`; far from it the answers are the same, but may take longer. Where only the
    /// better of two poses is asked for, every `stride`-th part of the observation is enough.
    fn near<'a>(&'a self, map: &'a M, place: &Pose2, observation: &'a M::Observation, stride: usize) -> Self::Near<'a>;

    /// ln p_old \[nats\]: ln p(z | x, m) by what the map knew before the last few observations, if it can tell. See
    /// [`IncrementalWeight`](crate::proposal::IncrementalWeight) for why.
    fn log_old(&self, map: &M, world_from_robot: &Pose2, observation: &M::Observation) -> f64 {
        self.log_likelihood(map, world_from_robot, observation).0
    }

    /// [`Self::log_old`] as a function of the pose, made ready for many poses near `place`; far from it the answers are the same.
    fn near_old(&self, map: &M, place: &Pose2, observation: &M::Observation) -> impl Fn(&Pose2) -> f64 {
        let _ = place;
        move |pose| self.log_old(map, pose, observation)
    }
}

/// A [`Score`] near one place. Only [`Self::log_score`] must be written; the others are where a search can be made fast.
pub trait ScoreNear {
    /// ln p(z | x, m) \[nats\], up to a constant that the pose does not change.
    fn log_score(&self, world_from_robot: &Pose2) -> f64;

    /// About the same by a part of the observation, for a climb: exact where it exceeds `floor` \[nats\]; elsewhere anything up to `floor`
    /// will do.
    fn log_score_above(&self, world_from_robot: &Pose2, floor: f64) -> f64 {
        let _ = floor;
        self.log_score(world_from_robot)
    }

    /// Roughly the same by every `stride`-th part, for a lattice of poses: the score \[nats\] at a heading \[rad\] as a function of the
    /// position \[m\].
    fn coarse(&self, theta: f64, stride: usize) -> impl Fn([f64; 2]) -> f64 {
        let _ = stride;
        move |[x, y]| self.log_score_above(&Pose2 { x, y, theta }, f64::NEG_INFINITY)
    }
}
