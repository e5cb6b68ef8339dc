//! A filter's state.

use super::Rbpf;
use super::builder::{PARTICLES, SELECTION_TEMPER};
use crate::error::Range;
use crate::execute::Executor;
use crate::genealogy::{Path, SavedPaths};
use crate::map::ConditionalMap;
use crate::particle::Particle;
use crate::proposal::Proposal;
use crate::resampling::{ResamplePolicy, Scheme};
use crate::save::{self, RestoreError, SaveShared};
use crate::weights::{SavedWeights, Weights};
use serde::{Deserialize, Serialize};

/// The state of a filter with maps M between two steps, where T is `M::Saved`: all but its proposal and its executor. Plain data, for
/// any format of serde; nothing in it has been checked.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Saved<T> {
    version: u32,
    policy: ResamplePolicy,
    scheme: Scheme,
    selection_temper: f64,
    seed: u64,
    resamplings: u32,
    weights: SavedWeights,
    log_selected: f64,
    path_weights: SavedWeights,
    /// The step is theirs, and so are the poses.
    paths: SavedPaths,
    maps: T,
}

/// Of the form of [`Saved`] and of all that is in it.
const VERSION: u32 = 3;

impl<M: ConditionalMap + SaveShared, P: Proposal<M>> Rbpf<M, P> {
    /// The filter's state. What its particles share is in it once.
    ///
    /// ```
    /// # use fastslam::map::landmarks::{Correspondence, Landmarks};
    /// # use fastslam::motion::{Odometry, OdometryModel};
    /// # use fastslam::proposal::FromMeasurement;
    /// use fastslam::rbpf::Rbpf;
    /// # use fastslam::sensor::RangeBearing;
    /// # let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 8.0, field_of_view: 6.3 };
    /// # let map = <Landmarks<_>>::new(sensor, Correspondence::Known);
    /// # let proposal = FromMeasurement { motion: OdometryModel { alphas: [0.01, 0.001, 0.01, 0.001] } };
    /// # let ahead = Odometry { rot1: 0.0, trans: 0.5, rot2: 0.0 };
    /// # let nothing = Vec::new();
    /// let mut filter = Rbpf::builder(map, proposal.clone()).particles(50).build()?;
    /// filter.step(&ahead, &nothing);
    ///
    /// let text = serde_json::to_string(&filter.save())?;
    /// let saved = serde_json::from_str(&text)?;
    /// let mut restored: Rbpf<Landmarks<RangeBearing>, _> = Rbpf::restore(saved, proposal)?;
    /// assert_eq!(filter.step(&ahead, &nothing).weights, restored.step(&ahead, &nothing).weights);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn save(&self) -> Saved<M::Saved> {
        self.save_with(M::save_all(self.particles.iter().map(|particle| &particle.map)))
    }

    /// The filter that was saved, if this is its proposal. It goes on with the same bits, whoever computes: by default
    /// [`Executor::default`].
    ///
    /// # Errors
    /// Where the state is not that of a filter, with the part of it that is wrong; where the proposal refuses one of its settings.
    pub fn restore(saved: Saved<M::Saved>, proposal: P) -> Result<Self, RestoreError> {
        Self::restore_with(saved, proposal, M::restore_all)
    }
}

impl<M: ConditionalMap, P: Proposal<M>> Rbpf<M, P> {
    /// The state with maps that were saved by somebody who keeps more of them.
    pub(crate) fn save_with<T>(&self, maps: T) -> Saved<T> {
        Saved {
            version: VERSION,
            policy: self.policy,
            scheme: self.scheme,
            selection_temper: self.selection_temper,
            seed: self.seed,
            resamplings: self.resamplings,
            weights: self.weights.save(),
            log_selected: self.log_selected,
            path_weights: self.path_weights.save(),
            paths: Path::save_all(self.particles.iter().map(|particle| &particle.path)),
            maps,
        }
    }

    /// The filter of a state, whose maps are read by whoever saved them.
    pub(crate) fn restore_with<T>(
        saved: Saved<T>,
        proposal: P,
        read: impl FnOnce(T) -> Result<Vec<M>, RestoreError>,
    ) -> Result<Self, RestoreError> {
        let Saved {
            version,
            policy,
            scheme,
            selection_temper,
            seed,
            resamplings,
            weights,
            log_selected,
            path_weights,
            paths,
            maps,
        } = saved;
        if version != VERSION {
            return Err(RestoreError::Version { found: version, known: VERSION });
        }
        proposal.validate()?;
        policy.validate()?;
        SELECTION_TEMPER.check("selection_temper", selection_temper)?;
        Range::whole(0, u32::MAX / 2).check("resamplings", f64::from(resamplings))?;
        let paths = Path::restore_all(paths)?;
        PARTICLES.check("particles", paths.len() as f64)?;
        let step = paths[0].step();
        save::holds(paths.iter().all(|path| path.step() == step), "paths", "all of one step")?;
        let (weights, path_weights) = (Weights::restore(weights)?, Weights::restore(path_weights)?);
        save::count("weights", weights.as_slice().len(), paths.len())?;
        save::finite("log_selected", [log_selected])?;
        save::count("path_weights", path_weights.as_slice().len(), paths.len())?;
        let maps = read(maps)?;
        save::count("maps", maps.len(), paths.len())?;
        let particle = |(path, map): (Path, M)| Particle { world_from_robot: path.pose(), map, path };
        Ok(Self {
            proposal,
            policy,
            scheme,
            seed,
            selection_temper,
            executor: Executor::default(),
            step,
            resamplings,
            particles: paths.into_iter().zip(maps).map(particle).collect(),
            weights,
            log_selected,
            path_weights,
            copied: Vec::new(),
        })
    }
}
