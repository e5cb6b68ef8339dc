//! What a reader can set of a lap, and what a particle pays for a scan.

use super::{ALPHAS, Course, FROM_SCAN, LapWorld, OUTLIER, PARTICLES, Proposals, TEMPER};
use crate::experiment::ProposalKind;
use crate::world::Edits;
use fastslam::error::{Range, SettingError};
use fastslam::matching::{Matcher, ScanModel};
use fastslam::motion::OdometryModel;
use fastslam::proposal::{Either, FromMotion, FromScan, FromScanSettings, IncrementalWeight, ScanAtDraw};
use fastslam::resampling::{ResamplePolicy, Scheme};
use std::sync::Arc;

/// What a particle pays for a scan.
#[derive(
    Clone,
    Copy,
    PartialEq,
    Eq,
    Debug,
    Default,
    strum::Display,
    strum::EnumString,
    strum::VariantNames,
    strum::VariantArray,
)]
#[strum(serialize_all = "kebab-case", parse_err_ty = SettingError, parse_err_fn = unknown_weight)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum ScanWeight {
    /// That of the filter by name: FastSLAM 1.0 moves first and pays [`Self::Marginal`], ours looks first and pays what [`FROM_SCAN`] says.
    #[default]
    Usual,
    /// [`IncrementalWeight::Marginal`], whatever poses are drawn from.
    Marginal,
    /// [`IncrementalWeight::NewGroundFree`], whatever poses are drawn from.
    NewGroundFree,
    /// [`IncrementalWeight::OldMapAtDraw`], whatever poses are drawn from.
    OldMapAtDraw,
}

impl ScanWeight {
    /// What is paid where poses are drawn so.
    pub const fn by(self, proposal: ProposalKind) -> IncrementalWeight {
        match (self, proposal) {
            (Self::Usual, ProposalKind::Motion) | (Self::Marginal, _) => IncrementalWeight::Marginal,
            (Self::Usual, ProposalKind::Improved) => FROM_SCAN.weight,
            (Self::NewGroundFree, _) => IncrementalWeight::NewGroundFree,
            (Self::OldMapAtDraw, _) => IncrementalWeight::OldMapAtDraw,
        }
    }
}

fn unknown_weight(given: &str) -> SettingError {
    SettingError::unknown_word("weight", given, <ScanWeight as strum::VariantNames>::VARIANTS)
}

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct LapSetup {
    /// Where the lap is driven.
    pub course: Course,
    /// Number of particles M, 1 to 4096.
    pub particles: usize,
    /// Seed of the world's noise and of the filter's.
    pub seed: u64,
    /// Where new poses are drawn from.
    pub proposal: ProposalKind,
    /// What a particle pays for a scan.
    pub weight: ScanWeight,
    /// What an end point is compared with.
    pub matcher: Matcher,
    /// When to resample.
    pub policy: ResamplePolicy,
    /// How to resample.
    pub scheme: Scheme,
    /// Factor on the standard deviations of the odometry's noise, 0 to 10: of the world's, and of what the filter expects.
    pub odometry_scale: f64,
    /// Standard deviation of a range \[m\], 0 to 1.
    pub range_std: f64,
    /// κ: the share of each beam's log-likelihood that counts, 0.01 to 1.
    pub temper: f64,
    /// Whether a match that is hardly better than the average pose is doubted, and the pose drawn from the motion instead.
    pub guard: bool,
    /// What a reader has changed about the course.
    pub edits: Edits,
}

impl Default for LapSetup {
    fn default() -> Self {
        Self {
            course: Course::Apartment,
            particles: 16,
            seed: 3,
            proposal: ProposalKind::Improved,
            weight: ScanWeight::Usual,
            matcher: Matcher::SubCell,
            policy: ResamplePolicy::EssBelow(0.5),
            scheme: Scheme::Systematic,
            odometry_scale: 1.0,
            range_std: 0.02,
            temper: TEMPER,
            guard: true,
            edits: Edits::default(),
        }
    }
}

impl LapSetup {
    /// What the lap's figure opens with: an apartment's rooms, in which the universes differ until the loop closes and most of them die.
    /// The wheels are worse than those of the lap table, with which positions differ by centimetres at the closing: too little for the eye.
    pub fn opening() -> Self {
        Self { course: Course::Rooms, seed: 17, odometry_scale: 1.5, ..Self::default() }
    }

    /// Noise of the wheels.
    pub fn motion(&self) -> OdometryModel {
        OdometryModel { alphas: ALPHAS }.scaled(self.odometry_scale)
    }

    /// The world of this seed and these noises.
    pub fn world(&self) -> LapWorld {
        LapWorld::edited(&self.course.route(), &self.edits, self.seed, &self.motion(), self.range_std)
    }

    /// [`Self::world`], where that of another setup is there: what is equal in both is not computed again.
    pub fn world_like(&self, other: &Self, world: &Arc<LapWorld>) -> Arc<LapWorld> {
        let drive = |setup: &Self| (setup.course, setup.seed, setup.range_std);
        if drive(self) != drive(other) || self.edits != other.edits {
            return Arc::new(self.world());
        }
        if self.odometry_scale == other.odometry_scale {
            Arc::clone(world)
        } else {
            world.with_motion(&self.motion()).into()
        }
    }

    /// What the filter draws poses from.
    pub fn proposals(&self) -> Proposals {
        let motion = self.motion();
        let score = ScanModel::new(self.matcher, self.temper, OUTLIER);
        // The best of the search is never below its mean.
        let minimum_improvement = if self.guard { FROM_SCAN.minimum_improvement } else { 0.0 };
        let weight = self.weight.by(self.proposal);
        let settings = FromScanSettings { minimum_improvement, weight, ..FROM_SCAN };
        match self.proposal {
            ProposalKind::Motion => Either::Left(FromMotion { motion, likelihood: ScanAtDraw { score, weight } }),
            ProposalKind::Improved => Either::Right(FromScan { motion, score, settings }),
        }
    }

    /// Whether another setup differs in nothing but what is driven.
    pub fn but_for_steering(&self, other: &Self) -> bool {
        let mut same = other.clone();
        same.edits.steering = self.edits.steering.clone();
        same == *self
    }

    /// # Errors
    /// Where a setting is out of its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        PARTICLES.check("particles", self.particles as f64)?;
        Range::number(0.0, 10.0, "").check("odometry_scale", self.odometry_scale)?;
        Range::number(0.0, 1.0, "m").check("range_std", self.range_std)?;
        Range::number(0.01, 1.0, "").check("temper", self.temper)?;
        let route = self.course.route();
        self.edits
            .fit(&route.plan, route.steps)
            .map_err(|(field, error)| SettingError::Unfit { field, allowed: error.allowed() })?;
        self.policy.validate()
    }
}
