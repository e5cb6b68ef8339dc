//! One of the filters under way, on either course.

use super::setup::{PoliciesSetup, PolicyCourse};
use crate::experiment::ProposalKind;
use crate::experiment::landmarks::{
    AssociationSummary, CorrespondenceKind, Course, LandmarkLog, LandmarkRun, LandmarkSetup,
};
use crate::experiment::lap::{Lap, LapSetup, LapWorld};
use fastslam::error::SettingError;
use fastslam::execute::Executor;
use fastslam::genealogy::{Descent, Path};
use fastslam::geometry::Pose2;
use fastslam::proposal::Proposed;
use fastslam::resampling::ResamplePolicy;
use std::sync::Arc;

/// The world that all three filters share.
#[derive(Clone, Debug)]
pub(super) enum World {
    Lap(Arc<LapWorld>),
    Wings(Arc<LandmarkLog>),
}

impl World {
    pub(super) fn truth(&self) -> &[Pose2] {
        match self {
            Self::Lap(world) => &world.truth,
            Self::Wings(log) => &log.truth,
        }
    }

    pub(super) fn odometry(&self) -> &[Pose2] {
        match self {
            Self::Lap(world) => &world.odometry,
            Self::Wings(log) => &log.odometry,
        }
    }
}

#[derive(Clone, Debug)]
pub(super) enum Run {
    Lap(Box<Lap>),
    Wings(Box<LandmarkRun>),
}

/// The same of either filter.
macro_rules! of_filter {
    ($run:expr, $filter:ident => $value:expr) => {
        match $run {
            Run::Lap(run) => {
                let $filter = run.filter();
                $value
            }
            Run::Wings(run) => {
                let $filter = run.filter();
                $value
            }
        }
    };
}

/// What of a [`PolicyReport`](super::PolicyReport) the filter itself reports.
pub(super) struct Stepped {
    pub(super) log_evidence: f64,
    pub(super) ess: f64,
    pub(super) ancestors: Option<Vec<u32>>,
    pub(super) associations: Option<(AssociationSummary, u32)>,
}

impl Run {
    pub(super) fn with_policy(self, policy: ResamplePolicy) -> Self {
        match self {
            Self::Lap(run) => Self::Lap(Box::new(run.with_policy(policy))),
            Self::Wings(run) => Self::Wings(Box::new(run.with_policy(policy))),
        }
    }

    pub(super) fn with_executor(self, executor: Executor) -> Self {
        match self {
            Self::Lap(run) => Self::Lap(Box::new(run.with_executor(executor))),
            Self::Wings(run) => Self::Wings(Box::new(run.with_executor(executor))),
        }
    }

    /// One step; on the lap with these draws, where they are there.
    pub(super) fn step(&mut self, proposed: Option<Vec<Proposed<()>>>) -> Option<Stepped> {
        match self {
            Self::Lap(run) => run.advance_by(proposed).map(|report| Stepped {
                log_evidence: report.log_evidence,
                ess: report.ess,
                ancestors: report.ancestors,
                associations: None,
            }),
            Self::Wings(run) => run.step().map(|report| Stepped {
                log_evidence: report.log_evidence,
                ess: report.ess,
                ancestors: report.ancestors,
                associations: Some((report.best, report.answers)),
            }),
        }
    }

    pub(super) fn descent(&self) -> Descent {
        of_filter!(self, filter => filter.descent())
    }

    pub(super) fn paths(&self) -> Vec<&Path> {
        of_filter!(self, filter => filter.particles().iter().map(|p| &p.path).collect())
    }

    pub(super) fn poses(&self) -> Vec<Pose2> {
        of_filter!(self, filter => filter.particles().iter().map(|p| p.world_from_robot).collect())
    }

    pub(super) fn weights(&self) -> &[f64] {
        of_filter!(self, filter => filter.weights().as_slice())
    }

    pub(super) fn best(&self) -> usize {
        of_filter!(self, filter => filter.best())
    }
}

/// The world of a setup, and a filter in it that never resamples, before its first step.
///
/// # Errors
/// Where a setting is out of its range.
pub(super) fn begin(setup: &PoliciesSetup) -> Result<(World, Run), SettingError> {
    let &PoliciesSetup { particles, seed, scheme, odometry_scale, sensor_scale, proposal, matcher, .. } = setup;
    Ok(match setup.course {
        PolicyCourse::Lap => {
            let range_std = LapSetup::default().range_std * sensor_scale;
            let lap = LapSetup {
                particles,
                seed,
                proposal,
                matcher,
                policy: ResamplePolicy::Never,
                scheme,
                odometry_scale,
                range_std,
                ..LapSetup::default()
            };
            let world = Arc::new(lap.world());
            (World::Lap(Arc::clone(&world)), Run::Lap(Box::new(Lap::in_world(&lap, world)?)))
        }
        PolicyCourse::Wings => {
            let tuning = Course::Wings.tuning().scaled(odometry_scale, sensor_scale);
            let log = Arc::new(Course::Wings.simulate_with(&tuning, seed));
            let (proposal, correspondence) = (ProposalKind::Improved, CorrespondenceKind::Unknown);
            let policy = ResamplePolicy::Never;
            let of = LandmarkSetup { particles, seed, proposal, correspondence, policy, scheme };
            (World::Wings(Arc::clone(&log)), Run::Wings(Box::new(LandmarkRun::new(&of, &tuning, log)?)))
        }
    })
}
