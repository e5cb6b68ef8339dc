//! What a reader can set of a run, and the filters that come of it.

use super::{LandmarkLog, Tuning};
use crate::experiment::ProposalKind;
use fastslam::error::{Range, SettingError};
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::map::landmarks::{Correspondence, Landmarks};
use fastslam::motion::{Displaced, Motion};
use fastslam::proposal::{Calibrating, DRIFT_STDS, Either, FromMeasurement, FromMotion, Marginal, Proposal};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::{ResamplePolicy, Scheme};
use fastslam::sensor::RangeBearing;

/// How many particles a run may have.
pub const PARTICLES: Range = Range::whole(1, 100_000);

/// Whether a filter may read the signatures of what it sees.
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_association)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "lowercase"))]
pub enum CorrespondenceKind {
    /// It may.
    Known,
    /// Every particle decides for itself.
    Unknown,
}

fn unknown_association(given: &str) -> SettingError {
    SettingError::unknown_word("association", given, <CorrespondenceKind as strum::VariantNames>::VARIANTS)
}

impl CorrespondenceKind {
    pub(super) fn of<D>(self, tuning: &Tuning<D>) -> Correspondence {
        match self {
            Self::Known => Correspondence::Known,
            Self::Unknown => Correspondence::Unknown(tuning.gate),
        }
    }
}

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct LandmarkSetup {
    /// Number of particles M, 1 to 100 000.
    pub particles: usize,
    /// Seed of the filter's draws.
    pub seed: u64,
    /// FastSLAM 1.0 is [`ProposalKind::Motion`], 2.0 is [`ProposalKind::Improved`].
    pub proposal: ProposalKind,
    /// Known or unknown correspondence.
    pub correspondence: CorrespondenceKind,
    /// When to resample.
    pub policy: ResamplePolicy,
    /// How to resample.
    pub scheme: Scheme,
}

impl Default for LandmarkSetup {
    fn default() -> Self {
        Self {
            particles: 100,
            seed: 1,
            proposal: ProposalKind::Improved,
            correspondence: CorrespondenceKind::Known,
            policy: ResamplePolicy::EssBelow(0.5),
            scheme: Scheme::Systematic,
        }
    }
}

impl LandmarkSetup {
    /// Before the log's first step, at its start, which is known.
    pub(super) fn filter<M, P, C>(&self, map: M, proposal: P, log: &LandmarkLog<C>) -> Result<Rbpf<M, P>, SettingError>
    where
        M: ConditionalMap,
        P: Proposal<M>,
    {
        PARTICLES.check("particles", self.particles as f64)?;
        Rbpf::builder(map, proposal)
            .particles(self.particles)
            .seed(self.seed)
            .start(log.truth.first().copied().unwrap_or_default())
            .policy(self.policy)
            .scheme(self.scheme)
            .build()
    }
}

/// A particle's map.
pub type LandmarkMap = Landmarks<RangeBearing>;

/// FastSLAM 1.0 or 2.0, which takes odometry for what its motion model says.
pub type FastSlam<D> = Either<FromMotion<D, Marginal>, FromMeasurement<D>>;

impl ProposalKind {
    pub(super) fn of<D>(self, motion: D) -> FastSlam<D> {
        match self {
            Self::Motion => Either::Left(FromMotion { motion, likelihood: Marginal }),
            Self::Improved => Either::Right(FromMeasurement { motion }),
        }
    }
}

/// FastSLAM 1.0 or 2.0 in which each particle learns the drift of the odometry along its path.
pub type Learning<D> = Calibrating<D, FastSlam<Displaced>>;

/// Standard deviations of the drift before a log is read: a metre turns the robot by as much as the noise that is told of a metre, and never by more than
/// [`DRIFT_STDS`]; a turn is off by the share that stands there.
///
/// A wider prior finds as large a drift, but costs where there is none: with 0.05 rad/m, where the noise is 0.002 rad/√m, the errors of a simulated car
/// without any drift (M = 50) are up to 45 times as large. As the noise is taken by the metre, the prior is the same however a drive is cut into steps.
pub(super) fn drift_stds<D: Motion>(motion: &D, controls: &[D::Control]) -> [f64; 2] {
    let start = Pose2::default();
    let (mut variance, mut way) = (0.0, 0.0);
    for drive in controls.iter().map(|control| motion.drive(control)) {
        variance += drive.covariance(&start).m33;
        way += drive.apply(&start).x.abs();
    }
    let [a_metre, a_turn] = DRIFT_STDS;
    let after_a_metre = if way > 0.0 { (variance / way).sqrt() } else { a_metre };
    [after_a_metre.clamp(1e-6, a_metre), a_turn]
}
