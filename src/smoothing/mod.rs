//! What the past looks like afterwards: draws of whole paths from p(x₀..T | z₁..T, u₁..T).
//!
//! A filter is judged by where the robot is now. Its record of the past is poor: whatever was resampled since descends from fewer and fewer
//! particles, and before some step all of them share one path ([`Descent::coalescence`](crate::genealogy::Descent::coalescence)). Tracing
//! the ancestors of the final particles ([`traced`]) gives paths that differ in their last steps only.
//!
//! Here is the Rao–Blackwellized particle smoother of Kok, Solin and Schön: particle Gibbs with ancestor sampling, in which each particle
//! keeps its map in closed form. A *sweep* ([`Smoother::sweep`]) takes a path and returns another one. It is a particle filter with one
//! slot less to choose for: the last slot is led along the given path x′. At every step the given path looks for a new past. It draws
//! the ancestor of x′_t among all particles i by
//!
//! w_{t−1}^i · p(x′_t | x_{t−1}^i, u_t) · p(z_t..T | x′_t..T, m^i),
//!
//! where m^i is the map that particle i has made so far. At the end one path is drawn by the weights. Whatever the number of particles, 2
//! or more, a sweep leaves p(x₀..T | z₁..T, u₁..T) as it is: paths drawn one after the other are a Markov chain whose distribution tends to
//! it. Few particles make the chain slow, not wrong.
//!
//! **What it costs.** In a model whose state is a pose alone the last factor would be the same for all particles, and backward simulation
//! would cost one density for each particle and step: O(M T). With a map it is not: what is to be seen from x′_t on depends on where
//! particle i has its walls or landmarks. So map i is shown all future observations from the poses of the given path, and pays for each:
//! M (T − t + 1) updates of a map at step t, ½ M T² in all, against the M T of the filter. Maps of landmarks factorise, so that each
//! update touches the few landmarks in sight; the number of updates is the same. [`Reconnect::Within`] looks ahead so many steps only.
//! That is no longer exact: what a map says of a place that is revisited later than that is left out of the choice. Without any look at
//! the maps, or at the motion, [`Reconnect::Never`] is the particle Gibbs sampler of Andrieu, Doucet and Holenstein, which is exact, and sticks to the
//! given path wherever its particles have one ancestor.
//!
//! **What is smoothed.** The product of the densities that the parts of the filter have: a motion that is a Gaussian in pose space
//! ([`GaussianMotion`](crate::motion::GaussianMotion)), and the likelihoods of the maps. Where a map linearises, it is the path's probability
//! by that linearised map. Where maps disagree on *which* landmark was seen, each goes by its own answer. A path that no particle comes
//! near, such as the other side of a wrong loop closure, is not found in any reasonable number of sweeps.
//!
//! **Grids.** A [`Grid`](crate::map::grid::Grid) can be swept over with a proposal that has densities, such as
//! [`FromMotion`](crate::proposal::FromMotion); [`FromScan`](crate::proposal::FromScan), whose weights are no densities of paths, does not
//! implement [`Retrace`]. The crate `fastslam-lab` has tried (`experiment::looking_back`): the price is the full ½ M T², and the path that comes
//! out is for the most part the one that was given, so that [`mapper`](crate::mapper) hands out the path of its best particle.
//!
//! References: Lindsten, Jordan, Schön, *Particle Gibbs with ancestor sampling* (JMLR 2014), algorithms 2 and 3; Kok, Solin, Schön,
//! *Rao-Blackwellized particle smoothing for simultaneous localization and mapping* (2024); Andrieu, Doucet, Holenstein, *Particle
//! Markov chain Monte Carlo methods* (JRSS B 2010).

mod draws;
mod sweep;

pub use draws::{distinct, moments, traced, weighted_moments};
pub use sweep::{Draw, Sweep};

use crate::error::{Range, SettingError};
use crate::execute::Executor;
use crate::geometry::Pose2;
use crate::map::{ConditionalMap, Observed};
use crate::proposal::Retrace;
use core::fmt::{self, Debug, Formatter};
use std::sync::Arc;

/// How the path that is given to a sweep finds its ancestors.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Reconnect {
    /// It keeps them: particle Gibbs without ancestor sampling.
    Never,
    /// By the motion and the observations of so many steps from there on, 1 or more.
    Within(u32),
    /// By the motion and all observations from there on.
    #[default]
    Whole,
}

impl Reconnect {
    /// How many of the observations are asked of which there are so many.
    fn reach(self, left: usize) -> usize {
        match self {
            Self::Never => 0,
            Self::Within(steps) => left.min(steps as usize),
            Self::Whole => left,
        }
    }
}

/// What can be set about a [`Smoother`].
#[derive(Clone, Debug)]
pub struct Settings {
    /// Number of particles M of a sweep, 2 or more; by default 20. One of them is led along the given path.
    pub particles: usize,
    /// Seed of all draws; by default 0.
    pub seed: u64,
    /// How the given path finds its ancestors; by default by all that was seen from there on.
    pub reconnect: Reconnect,
    /// Who computes. No number depends on it.
    pub executor: Executor,
}

impl Default for Settings {
    fn default() -> Self {
        Self { particles: 20, seed: 0, reconnect: Reconnect::Whole, executor: Executor::default() }
    }
}

/// Draws of whole paths given a whole log.
///
/// ```
/// use fastslam::geometry::Pose2;
/// use fastslam::map::landmarks::{Correspondence, Landmarks};
/// use fastslam::motion::{Floored, Odometry, OdometryModel};
/// use fastslam::proposal::FromMeasurement;
/// use fastslam::rbpf::Rbpf;
/// use fastslam::sensor::{Feature, RangeBearing};
/// use fastslam::smoothing::{Settings, Smoother, distinct, moments};
/// # use fastslam::nalgebra::Vector2;
///
/// // Half a metre ahead a step, past a landmark that is 2 m ahead and 1 m to the left of the start.
/// let controls = vec![Odometry { rot1: 0.0, trans: 0.5, rot2: 0.0 }; 6];
/// let seen = |step: u32| {
///     let ahead: f64 = 2.0 - 0.5 * f64::from(step);
///     vec![Feature { z: Vector2::new(ahead.hypot(1.0), 1.0_f64.atan2(ahead)), signature: Some(0) }]
/// };
/// let observations: Vec<_> = (1..=6).map(seen).collect();
///
/// // A filter, of FastSLAM 2.0. Its motion has a density.
/// let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 8.0, field_of_view: 6.3 };
/// let odometry = OdometryModel { alphas: [0.01, 0.001, 0.01, 0.001] };
/// let proposal = FromMeasurement { motion: Floored { motion: odometry, floor_stds: [0.02, 0.02, 0.01] } };
/// let map = <Landmarks<_>>::new(sensor, Correspondence::Known);
/// let mut filter = Rbpf::builder(map.clone(), proposal.clone()).particles(20).seed(1).build()?;
/// for (control, features) in controls.iter().zip(&observations) {
///     filter.step(control, features);
/// }
///
/// // Then look back: forty paths, each from the one before, beginning with the filter's own best.
/// let smoother = Smoother::new(Settings::default(), map, proposal, Pose2::default(), controls, observations)?;
/// let mut paths = vec![filter.particles()[filter.best()].path.poses()];
/// for sweep in 0..40 {
///     paths.push(smoother.sweep(sweep, &paths[paths.len() - 1])?.path);
/// }
/// assert!(distinct(&paths)[1] > 20, "most of the poses at step 1 differ");
/// let (mean, covariance) = moments(&paths)[3];
/// assert!((mean.x - 1.5).abs() < 0.2 && covariance.m11 > 0.0);
/// # Ok::<(), fastslam::error::SettingError>(())
/// ```
#[derive(Clone)]
pub struct Smoother<M: ConditionalMap, P: Retrace<M>> {
    settings: Settings,
    map: M,
    proposal: P,
    start: Pose2,
    controls: Arc<[P::Control]>,
    observations: Arc<[Observed<M>]>,
}

impl<M: ConditionalMap, P: Retrace<M>> Debug for Smoother<M, P> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("Smoother").field("settings", &self.settings).finish_non_exhaustive()
    }
}

impl<M: ConditionalMap, P: Retrace<M> + Clone> Smoother<M, P> {
    /// Of a log: what the robot did from `start` on, step by step, and what it saw then; by particles that map by copies of `map`.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] for fewer than two particles, for a look ahead by no step, and where map or proposal refuse one of their
    /// settings; [`SettingError::Unfit`] where there is not one observation for each control.
    pub fn new(
        settings: Settings,
        map: M,
        proposal: P,
        start: Pose2,
        controls: impl Into<Arc<[P::Control]>>,
        observations: impl Into<Arc<[Observed<M>]>>,
    ) -> Result<Self, SettingError> {
        let (controls, observations) = (controls.into(), observations.into());
        Range::whole(2, u32::MAX).check("particles", settings.particles as f64)?;
        if let Reconnect::Within(steps) = settings.reconnect {
            Range::whole(1, u32::MAX).check("reconnect", steps.into())?;
        }
        map.validate()?;
        proposal.validate()?;
        [("start.x", start.x), ("start.y", start.y), ("start.theta", start.theta)]
            .into_iter()
            .try_for_each(|(field, value)| Range::finite("").check(field, value).map(drop))?;
        if controls.len() != observations.len() {
            return Err(SettingError::Unfit { field: "observations", allowed: "one for each control" });
        }
        Ok(Self { settings, map, proposal, start, controls, observations })
    }

    /// The same smoother, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { settings: Settings { executor, ..self.settings }, ..self }
    }

    /// What was set.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Number of steps T.
    pub fn step_count(&self) -> usize {
        self.controls.len()
    }

    /// One sweep: a path of T + 1 poses in, another one out, with its map. Sweeps of one `number` draw from the same streams.
    ///
    /// # Errors
    /// [`SettingError::Unfit`] where the path is not of T + 1 poses from the start on, or not one that the motion can drive.
    ///
    /// ```
    /// # use fastslam::{geometry::Pose2, map::landmarks::{Correspondence, Landmarks}, proposal::{FromMotion, Marginal}};
    /// # use fastslam::laws::linear::{Drift, Offset, drive};
    /// # use fastslam::smoothing::{Settings, Smoother};
    /// let (controls, observations): (Vec<_>, Vec<_>) = drive(1).into_iter().unzip();
    /// let map = <Landmarks<_>>::new(Offset, Correspondence::Known);
    /// let proposal = FromMotion { motion: Drift, likelihood: Marginal };
    /// let smoother = Smoother::new(Settings::default(), map, proposal, Pose2::default(), controls, observations)?;
    /// let error = smoother.sweep(0, &[Pose2::default()]).unwrap_err();
    /// assert_eq!(error.to_string(), "path: must be the start, and a pose after each control");
    /// # Ok::<(), fastslam::error::SettingError>(())
    /// ```
    pub fn sweep(&self, number: u32, path: &[Pose2]) -> Result<Draw<M>, SettingError> {
        let mut sweep = self.begin(number, path)?;
        loop {
            if let Some(draw) = self.advance(&mut sweep) {
                return Ok(draw);
            }
        }
    }
}
