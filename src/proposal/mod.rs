//! Where a particle's next pose is drawn from.
//!
//! A draw x from q pays ln p(z | x, m) + ln p(x | x′, u) − ln q(x), whose exponential has the mean p(z | x′, u, m), or the log of that mean
//! where it can be had. Each proposal states its own log weight increment:
//! - [`FromMotion`] draws by the motion, and pays ln p(z | x, m), or, with [`ScanAtDraw`], what the old map says of the draw;
//! - [`FromMeasurement`] draws by motion and sightings, and pays the integral, in closed form;
//! - [`FromScan`] draws by motion and scan, and pays the integral or what of it new ground has no say in: [`IncrementalWeight`];
//! - [`FromWindow`] draws late, and pays each scan's share of the window's integral;
//! - [`Calibrating`] corrects odometry by the drift that the particle has learnt, and pays what the proposal pays that it draws by.

mod calibrating;
mod fit;
mod from_measurement;
mod from_motion;
mod from_scan;
mod from_window;
mod incremental_weight;
mod retrace;
mod search;
mod window;

pub use calibrating::{Calibrated, Calibrating, DRIFT_STDS, Learnt};
pub use fit::{Fit, FitLimits};
pub use from_measurement::{FromMeasurement, Measured};
pub use from_motion::{FromMotion, Marginal};
pub use from_scan::{Found, FromScan, FromScanSettings};
pub use from_window::{Followed, FromWindow, Windowed};
pub use incremental_weight::{IncrementalWeight, ScanAtDraw};
pub use retrace::Retrace;
pub(crate) use search::SEARCH_STDS;
pub use search::{CorrelativeSearch, HeadingSeeds, Search, Starts, Target};

use crate::error::SettingError;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::particle::Particle;
use crate::random::Stream;
use nalgebra::Matrix3;

/// Draws the next pose of a particle and says what it costs.
pub trait Proposal<M: ConditionalMap>: Sync {
    /// What the robot was told, or reported, to do in a step.
    type Control: Sync;

    /// One draw for one particle.
    fn propose(
        &self,
        particle: &Particle<M>,
        control: &Self::Control,
        observation: &M::Observation,
        stream: &mut Stream,
    ) -> Proposed<M::Association>;

    /// One draw for each of several copies of this particle, from the stream of each: equal to [`Self::propose`] for each stream, but what does not
    /// depend on the draw can be computed once for all of them. The default implementation computes it for each.
    fn propose_copies(
        &self,
        particle: &Particle<M>,
        control: &Self::Control,
        observation: &M::Observation,
        streams: &mut [Stream],
    ) -> Vec<Proposed<M::Association>> {
        streams.iter_mut().map(|stream| self.propose(particle, control, observation, stream)).collect()
    }

    /// Whether a control can be driven: [`Motion::can_drive`](crate::motion::Motion::can_drive) of the proposal's motion. A step with one
    /// that cannot is taken for standing still. As given here every control can.
    fn can_drive(&self, control: &Self::Control) -> bool {
        let _ = control;
        true
    }

    /// Whether all settings are in range: asked once, when a filter is built.
    ///
    /// # Errors
    /// Where one is not. As given here there are none.
    fn validate(&self) -> Result<(), SettingError> {
        Ok(())
    }
}

/// A drawn pose with its price.
#[derive(Clone, PartialEq, Debug)]
pub struct Proposed<A> {
    /// The new pose.
    pub world_from_robot: Pose2,
    /// What the observation is taken to be of.
    pub association: A,
    /// Log weight increment \[nats\].
    pub log_increment: f64,
    /// How it came about.
    pub trace: ProposalTrace,
}

/// How a pose was found, for those who watch.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum ProposalTrace {
    /// Drawn from the motion model: by choice, because the matcher was not trusted, or because nothing seen was in the map.
    Motion,
    /// Drawn from a Gaussian around the mode that the measurement calls for.
    Matched {
        /// The mode x̂.
        mode: Pose2,
        /// Covariance of that Gaussian (3 × 3, \[m, m, rad\], in the world's frame).
        #[cfg_attr(feature = "serde", serde(skip))]
        covariance: Matrix3<f64>,
        /// ln η̂ \[nats\]: the normaliser of likelihood times motion prior, as the fit has it.
        log_integral: f64,
    },
}

/// One of two proposals, chosen at run time.
#[derive(Clone, Debug)]
pub enum Either<P, Q> {
    /// The motion prior, by custom.
    Left(P),
    /// The measurement-aware proposal.
    Right(Q),
}

impl<M: ConditionalMap, P: Proposal<M>, Q: Proposal<M, Control = P::Control>> Proposal<M> for Either<P, Q> {
    type Control = P::Control;

    fn propose(
        &self,
        particle: &Particle<M>,
        control: &P::Control,
        observation: &M::Observation,
        stream: &mut Stream,
    ) -> Proposed<M::Association> {
        match self {
            Self::Left(proposal) => proposal.propose(particle, control, observation, stream),
            Self::Right(proposal) => proposal.propose(particle, control, observation, stream),
        }
    }

    fn propose_copies(
        &self,
        particle: &Particle<M>,
        control: &P::Control,
        observation: &M::Observation,
        streams: &mut [Stream],
    ) -> Vec<Proposed<M::Association>> {
        match self {
            Self::Left(proposal) => proposal.propose_copies(particle, control, observation, streams),
            Self::Right(proposal) => proposal.propose_copies(particle, control, observation, streams),
        }
    }

    fn can_drive(&self, control: &P::Control) -> bool {
        match self {
            Self::Left(proposal) => proposal.can_drive(control),
            Self::Right(proposal) => proposal.can_drive(control),
        }
    }

    fn validate(&self) -> Result<(), SettingError> {
        match self {
            Self::Left(proposal) => proposal.validate(),
            Self::Right(proposal) => proposal.validate(),
        }
    }
}
