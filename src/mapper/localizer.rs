//! A robot that finds its way in a map that it does not change.

use super::agreement::AGREEMENT;
use super::closing::CLOSING;
use super::models::{MODELS, Map, score};
use super::moving::LastViews;
use super::odometer::Odometer;
use super::spread::{PoseWithCovariance, Spreads};
use super::wheels::Wheels;
use super::{Filter, LaserMapper, LaserMapperSettings, Pushed, Stamp, filter};
use crate::error::SettingError;
use crate::geometry::{Gaussian3, Pose2};
use crate::map::grid::{MapImage, MapReading};
use crate::matching::{Score, ScoredPose, hill_climb};
use crate::motion::{Displaced, Displacement, Motion};
use crate::particle::Particle;
use crate::proposal::{Fit, Search, Target};
use crate::sensor::{LaserScan, Scan};

/// The filter of a [`LaserMapper`] in a map that stays as it is: where the robot is, and nothing else.
///
/// Each particle draws its pose by looking first, as in mapping, upon one map that all share. What has changed in the building since it was mapped
/// is outvoted by what has not, and is not learnt.
#[derive(Clone, Debug)]
pub struct Localizer {
    settings: LaserMapperSettings,
    /// In the frame that the filter works in.
    map: Map,
    /// Of that frame.
    world_from_map: Pose2,
    start: Gaussian3,
    /// Beams that the search is made for.
    beams: u32,
    filter: Filter,
    odometer: Odometer,
    wheels: Wheels,
    views: LastViews,
    /// Odometry of the last scan that was taken; `None` before the first.
    last: Option<Pose2>,
    steps: u32,
    stamps: Vec<Stamp>,
    /// What the particles' last poses were drawn from; before the first scan, what is known of the start.
    spreads: Spreads,
    /// End points so far, and those of them that lay on walls.
    compared: [f64; 2],
}

impl Localizer {
    /// In the best map of a mapper. The robot is somewhere about `start`, in the frame of that map: its first scan is searched for within three standard
    /// deviations, and 12 m to each side at the most.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] where `start` is not finite.
    pub fn new(mapper: &LaserMapper, start: Gaussian3) -> Result<Self, SettingError> {
        let map = mapper.map().present();
        Self::of(map, Pose2::default(), *mapper.settings(), mapper.beams, mapper.wheels().clone(), start)
    }

    /// In a map that was drawn, as a picture of ROS's `map_server`. Start and path are in its frame, turned as its origin says. Cells are as large as those of the
    /// picture, whatever the settings say. A pose is a little less exact than in a map of a mapper: see [`Grid::drawn`](crate::map::grid::Grid::drawn).
    ///
    /// # Errors
    /// [`SettingError`] of a setting or of a value of the reading that is out of its range, or of a `start` that is not finite.
    pub fn in_drawn(
        image: &MapImage,
        reading: &MapReading,
        settings: LaserMapperSettings,
        start: Gaussian3,
    ) -> Result<Self, SettingError> {
        let settings = LaserMapperSettings { cell_size: reading.resolution, ..settings };
        settings.validate()?;
        let map = Map::drawn(settings.grid(), image, reading)?;
        let start = Displacement { mean: *start.mean(), covariance: start.covariance() };
        let back = Pose2::new(0.0, 0.0, -reading.origin.theta);
        let start = Gaussian3::new(reading.origin.between(&start.mean), Displaced.covariance(&back, &start))
            .ok_or(SettingError::Unfit { field: "start", allowed: "a place" })?;
        let beams = settings.beams.unwrap_or(MODELS.beams);
        Self::of(map, reading.origin, settings, beams, Wheels::default(), start)
    }

    /// In this map, whose frame lies so in that of the path. The start is in that of the map.
    fn of(
        mut map: Map,
        world_from_map: Pose2,
        settings: LaserMapperSettings,
        beams: u32,
        wheels: Wheels,
        start: Gaussian3,
    ) -> Result<Self, SettingError> {
        // All of it is old: there is no new ground.
        map.settle();
        Ok(Self {
            filter: filter(&settings, beams, map.clone()).start(*start.mean()).build()?,
            spreads: Spreads::about(start.mean(), &start.covariance(), settings.particles),
            settings,
            map,
            world_from_map,
            start,
            beams,
            odometer: Odometer::default(),
            wheels,
            views: LastViews::default(),
            last: None,
            steps: 0,
            stamps: Vec::new(),
            compared: [0.0; 2],
        })
    }

    /// The next scan, with the pose that raw odometry gives for it in any frame: see [`LaserMapper::push`].
    pub fn push(&mut self, scan: &LaserScan) -> Pushed {
        let odometry = match self.odometer.next(scan, self.settings.longest()) {
            Ok(believed) => believed.pose,
            Err(reason) => return Pushed::Refused(reason),
        };
        let moved = self.last.map(|last| last.between(&odometry));
        if let Some(moved) = moved.filter(|moved| !self.settings.takes(moved)) {
            self.stamps.push(Stamp { time: scan.time, step: self.steps, step_from_robot: moved });
            return Pushed::Still;
        }
        let displacement = |moved: &Pose2, driven| self.wheels.displacement_over(moved, driven);
        let standing = self.views.standing(scan, odometry, self.settings.beams_of(scan), displacement);
        self.last = Some(odometry);
        let pushed = match moved {
            None => {
                self.begin(&standing);
                Pushed::First
            }
            Some(moved) => {
                let control = self.wheels.displacement(&moved);
                let report = self.filter.step(&control, &standing);
                self.spreads = Spreads::of(&report, &control);
                self.wheels.learn(&moved, &report);
                self.steps = report.step;
                self.keep_map();
                Pushed::Step(report)
            }
        };
        self.stamps.push(Stamp { time: scan.time, step: self.steps, step_from_robot: Pose2::default() });
        let beams = score().log_beams(&self.map, &self.pose_in_map(), &standing);
        let on_walls = beams.iter().filter(|log| **log > AGREEMENT.on_a_wall).count();
        self.compared = [self.compared[0] + beams.len() as f64, self.compared[1] + on_walls as f64];
        pushed
    }

    /// Where the first scan fits best of all places about the start.
    fn begin(&mut self, scan: &Scan) {
        let score = score();
        let target = Target::new(&self.start, score.near(&self.map, self.start.mean(), scan, 1), 0.0);
        let climbed = |start| hill_climb(start, CLOSING.climb, |pose, floor| target.log_posterior(pose, floor));
        let tops = CLOSING.search.starts(&target).poses.into_iter().map(climbed);
        let better = |a: ScoredPose, b: ScoredPose| if b.value > a.value { b } else { a };
        if let Some(ScoredPose { pose, .. }) = tops.reduce(better) {
            let mapped = filter(&self.settings, self.beams, self.map.clone()).start(pose).build();
            self.filter = mapped.expect("`new` has built one of these settings");
            // The Gaussian of the hill, where what was seen makes one: otherwise no more is known than before.
            if let Some(fit) = Fit::around(&pose, &MODELS.from_scan.limits, |pose| target.log_value(pose)) {
                self.spreads = Spreads::about(&pose, &fit.gaussian.covariance(), self.settings.particles);
            }
        }
    }

    /// Takes what the step has written into the particles' maps out of them.
    fn keep_map(&mut self) {
        let map = &self.map;
        self.filter.revise(|_, particle| (Some(Particle { map: map.clone(), ..particle.clone() }), ()));
    }

    /// Where the best particle has the robot now, in the frame of the map.
    pub fn pose(&self) -> Pose2 {
        self.world_from_map.compose(&self.pose_in_map())
    }

    /// The same, as the filter has it.
    fn pose_in_map(&self) -> Pose2 {
        let pose = self.best().world_from_robot;
        self.stamps.last().map_or(pose, |stamp| pose.compose(&stamp.step_from_robot))
    }

    /// [`Self::pose`] with the covariance of its error in the frame of the map, as if the map had none: see [`LaserMapper::pose_with_covariance`].
    /// Before the first scan it is that of the start.
    pub fn pose_with_covariance(&self) -> PoseWithCovariance {
        let PoseWithCovariance { pose, covariance } = self.spreads.now(&self.filter, self.stamps.last(), &self.wheels);
        let in_map = Displacement { mean: pose, covariance };
        PoseWithCovariance {
            pose: Displaced.apply(&self.world_from_map, &in_map),
            covariance: Displaced.covariance(&self.world_from_map, &in_map),
        }
    }

    /// The best particle's path: see [`LaserMapper::path`].
    pub fn path(&self) -> Vec<(f64, Pose2)> {
        let poses = self.best().path.poses();
        let world = |pose: Pose2| self.world_from_map.compose(&pose);
        let placed = |stamp: &Stamp| (stamp.time, world(poses[stamp.step as usize].compose(&stamp.step_from_robot)));
        self.stamps.iter().map(placed).collect()
    }

    /// Share, 0 to 1, of what was seen so far that lay on walls of the map where the best particle had the robot: small where it is lost, or in another building.
    pub fn matched_fraction(&self) -> f64 {
        self.compared[1] / self.compared[0].max(1.0)
    }

    /// The map, as it was from the start. One that was drawn is in the frame of its picture.
    pub fn map(&self) -> &Map {
        &self.map
    }

    /// The filter, for those who watch it, in the frame of [`Self::map`].
    pub fn filter(&self) -> &Filter {
        &self.filter
    }

    fn best(&self) -> &Particle<Map> {
        &self.filter.particles()[self.filter.best()]
    }
}
