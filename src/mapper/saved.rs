//! A mapper's state between two scans.

use super::closing::{Closings, SavedClosings};
use super::models::{self, Map};
use super::moving::LastViews;
use super::odometer::Odometer;
use super::spread::{SavedSpread, Spreads};
use super::wheels::Wheels;
use super::{Filter, LaserMapper, LaserMapperSettings, Stamp};
use crate::execute::Executor;
use crate::genealogy::Path;
use crate::geometry::Pose2;
use crate::map::grid::SavedGrids;
use crate::motion::Displacement;
use crate::rbpf;
use crate::save::{self, RestoreError, SaveShared};
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// The state of a [`LaserMapper`]: all but its executor. Plain data, for any format of serde that keeps the bits of a number; nothing in it has been checked.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SavedMapper {
    version: u32,
    settings: LaserMapperSettings,
    beams: u32,
    filter: rbpf::Saved<()>,
    /// Of the particles, and of those of before that loops are found by.
    maps: SavedGrids,
    odometer: Odometer,
    wheels: Wheels,
    /// Mean, and covariance by columns.
    predicted: Option<(Pose2, [[f64; 3]; 3])>,
    spreads: Vec<SavedSpread>,
    since_mark: f64,
    views: LastViews,
    closings: SavedClosings,
    odometry: Vec<Pose2>,
    resampled: u32,
    single_lineage_since: Option<u32>,
    stamps: Vec<Stamp>,
}

/// Of the form of [`SavedMapper`] and of what is in it besides the filter.
const VERSION: u32 = 7;

impl LaserMapper {
    /// The mapper's state, with which a session goes on later. What maps share is in it once.
    ///
    /// ```
    /// # use fastslam::geometry::Pose2;
    /// # use fastslam::sensor::LaserScan;
    /// # use fastslam::mapper::{LaserMapper, LaserMapperSettings};
    /// # let scan = LaserScan { time: 0.0, odometry: Pose2::default(), robot_from_laser: Pose2::default(), first_angle: -1.5,
    /// #     angle_step: 0.5, max_range: None, ranges: vec![2.0, 3.0, 4.0, 4.0, 3.0, 2.0] };
    /// let mut mapper = LaserMapper::new(LaserMapperSettings::default())?;
    /// _ = mapper.push(&scan);
    /// let text = serde_json::to_string(&mapper.save())?;
    ///
    /// let restored = LaserMapper::restore(serde_json::from_str(&text)?)?;
    /// assert_eq!(restored.path(), mapper.path());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn save(&self) -> SavedMapper {
        let maps = self.filter.particles().iter().map(|particle| &particle.map);
        SavedMapper {
            version: VERSION,
            settings: self.settings,
            beams: self.beams,
            filter: self.filter.save_with(()),
            maps: Map::save_all(maps.chain(self.closings.maps())),
            odometer: self.odometer.clone(),
            wheels: self.wheels.clone(),
            predicted: self.predicted.map(|Displacement { mean, covariance }| (mean, covariance.into())),
            spreads: self.spreads.save(),
            since_mark: self.since_mark,
            views: self.views.clone(),
            closings: self.closings.save(),
            odometry: self.odometry.clone(),
            resampled: self.resampled,
            single_lineage_since: self.single_lineage_since,
            stamps: self.stamps.clone(),
        }
    }

    /// The mapper that was saved. It goes on with the same bits, whoever computes: by default [`Executor::default`].
    ///
    /// # Errors
    /// Where the state is not that of a mapper, with the part of it that is wrong.
    pub fn restore(saved: SavedMapper) -> Result<Self, RestoreError> {
        let SavedMapper {
            version,
            settings,
            beams,
            filter,
            maps,
            odometer,
            wheels,
            predicted,
            spreads,
            since_mark,
            views,
            closings,
            odometry,
            resampled,
            single_lineage_since,
            stamps,
        } = saved;
        if version != VERSION {
            return Err(RestoreError::Version { found: version, known: VERSION });
        }
        settings.validate()?;
        let model = settings.grid();
        let mut maps = Map::restore_all(maps)?;
        save::holds(
            maps.iter().all(|map| *map.model() == model),
            "maps",
            "of the model of a mapper with this cell size",
        )?;
        let particles = settings.particles.min(maps.len());
        let before = maps.split_off(particles);
        let filter: Filter = Filter::restore_with(filter, models::proposal(beams, settings.weight), |()| Ok(maps))?;
        save::count("particles", filter.particles().len(), settings.particles)?;
        let begins = |path: &Path| path.back().last().is_some_and(|first| first.pose() == Pose2::default());
        save::holds(filter.particles().iter().all(|one| begins(&one.path)), "paths", "from the origin on")?;
        let steps = filter.particles()[0].path.step();
        let begun = !odometry.is_empty();
        save::holds(
            !begun && steps == 0 || odometry.len() == steps as usize + 1,
            "odometry",
            "of each scan that was taken",
        )?;
        let closings = Closings::restore(closings, before, particles, begun.then_some(steps as usize))?;
        let spreads = Spreads::restore(spreads, particles)?;
        odometer.check()?;
        wheels.check()?;
        views.check()?;
        save::poses("odometry", odometry.iter().copied())?;
        save::poses("stamps", stamps.iter().map(|stamp| stamp.step_from_robot))?;
        save::finite("stamps", stamps.iter().map(|stamp| stamp.time))?;
        let are_known = begun != stamps.is_empty() && stamps.iter().all(|stamp| stamp.step <= steps);
        save::holds(are_known && stamps.is_sorted_by_key(|stamp| stamp.step), "stamps", "of steps so far, in order")?;
        let of_covariance =
            predicted.iter().flat_map(|(_, columns)| *columns.as_flattened().first_chunk::<9>().expect("3 × 3"));
        save::finite("predicted", of_covariance.chain([since_mark]))?;
        save::poses("predicted", predicted.iter().map(|(mean, _)| *mean))?;
        let predicted = predicted.map(|(mean, columns)| Displacement { mean, covariance: Matrix3::from(columns) });
        Ok(Self {
            settings,
            executor: Executor::default(),
            filter,
            beams,
            odometer,
            wheels,
            predicted,
            spreads,
            since_mark,
            views,
            closings,
            odometry,
            steps,
            resampled,
            single_lineage_since,
            stamps,
        })
    }
}
