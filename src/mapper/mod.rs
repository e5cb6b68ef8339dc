//! A ready-made mapper for a robot with odometry and a laser: scans in, one by one, a map and a path out.
//!
//! The [first page](crate) of the crate has an example.
//!
//! [`LaserMapper`] is a Rao-Blackwellized particle filter ([`Rbpf`]) over paths. Each particle draws its next pose by looking first
//! ([`FromScan`], after Grisetti, Stachniss and Burgard 2007), and keeps a copy-on-write occupancy grid with
//! a normal distribution for each piece of wall ([`Grid`](crate::map::grid::Grid)). What moves by itself, as people who walk by or
//! along, is told from walls before a scan is matched, and left out. A loop that no particle has closed by itself is closed by bending its path
//! (`closing.rs`). It runs online and needs to know nothing of the
//! scans that will come; whoever has a whole log lets [`Replay`] push it, or fills the laser's settings in by
//! [`LaserMapperSettings::for_scans`]. [`Localizer`] finds a robot in a map that stays as it is. What is not a setting has one value for every building and robot.
//!
//! These constants were chosen by the errors of paths on three recorded logs (Intel Research Lab; ACES building; Freiburg's campus) and on simulated ones:
//! our own building, rings of 60, 120 and 240 m with people, a crowd, a yard in which few beams return. Errors on these logs are therefore
//! no test of them; no other recorded log was looked at.

mod agreement;
mod check;
mod closing;
mod innovations;
mod last_places;
mod localizer;
mod loops;
mod memory;
mod models;
mod moving;
mod odometer;
mod remark;
mod replay;
#[cfg(feature = "serde")]
mod saved;
#[cfg(feature = "serde")]
mod saved_place;
mod scale;
mod scan_to_scan;
mod settings;
mod spread;
#[cfg(test)]
mod tests;
mod wheels;

pub use check::{OdometryCheck, OdometryFault};
use closing::Closings;
pub use innovations::OdometryInnovations;
pub use localizer::Localizer;
pub use loops::{Loop, LoopEnd};
pub use memory::Memory;
pub use models::{CELLS_PER_NDT, Map};
use models::{MODELS, Proposal};
use moving::LastViews;
pub use odometer::Unbelieved;
use odometer::{Believed, Odometer};
pub use remark::Remark;
pub use replay::Replay;
#[cfg(feature = "serde")]
pub use saved::SavedMapper;
pub use scan_to_scan::match_scans;
pub use settings::LaserMapperSettings;
pub use spread::PoseWithCovariance;
use spread::Spreads;
pub use wheels::{WheelNoise, Wheels};

use crate::error::SettingError;
use crate::execute::Executor;
use crate::geometry::{Pose2, driven};
use crate::map::ConditionalMap;
use crate::matching::ScanModel;
use crate::motion::{Displaced, Displacement};
use crate::particle::Particle;
use crate::proposal::{CorrelativeSearch, FromScan};
use crate::rbpf::{Builder, Rbpf, Report};
use crate::sensor::{LaserScan, Scan};

/// The filter of a [`LaserMapper`].
pub type Filter = Rbpf<Map, FromScan<Displaced, ScanModel, CorrelativeSearch>>;

/// What became of a scan that was [pushed](LaserMapper::push).
#[derive(Clone, Debug)]
#[must_use = "a refused scan is told nowhere else"]
pub enum Pushed {
    /// The first scan: the map begins with what it saw.
    First,
    /// The robot has moved by less than [`LaserMapperSettings::min_travel`] since the last scan that was taken: this one has a place on the
    /// path, and is not mapped.
    Still,
    /// The filter has taken a step.
    Step(Report<()>),
    /// What the scan says of its time or its place cannot be: it is left out of map and path, with the reason.
    Refused(SettingError),
}

impl Pushed {
    /// What the filter's step did, if there was one.
    pub fn report(self) -> Option<Report<()>> {
        if let Self::Step(report) = self { Some(report) } else { None }
    }
}

/// A scan that was pushed.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Stamp {
    /// When \[s\].
    time: f64,
    /// The step of the filter that took it, or the last one before it.
    step: u32,
    /// The robot as seen from where it was in that step, by raw odometry.
    step_from_robot: Pose2,
}

/// A map and a path of a robot with a laser, under way.
///
/// The first scan is the origin: its pose is (0, 0, 0) of the map's frame, and what it saw is mapped from there.
/// A clone goes its own way and shares what is mapped so far.
#[derive(Clone, Debug)]
pub struct LaserMapper {
    settings: LaserMapperSettings,
    executor: Executor,
    filter: Filter,
    /// Beams that the filter's search is made for.
    beams: u32,
    /// What odometry says, as far as it is believed.
    odometer: Odometer,
    /// What is known of the wheels.
    wheels: Wheels,
    /// What was expected of the last step.
    predicted: Option<Displacement>,
    /// What the particles' last poses were drawn from.
    spreads: Spreads,
    /// Metres driven by odometry since the particles' maps were marked for the last time.
    since_mark: f64,
    /// What was seen on the last metres of the way.
    views: LastViews,
    /// What closes the loops that were missed.
    closings: Closings,
    /// Odometry of each scan that the filter took, as it was believed.
    odometry: Vec<Pose2>,
    /// Steps of the filter: scans it took after the first.
    steps: u32,
    /// Of these, how many resampled.
    resampled: u32,
    /// The first step after which all particles descended from one.
    single_lineage_since: Option<u32>,
    /// Of every scan that has a place on the path.
    stamps: Vec<Stamp>,
}

impl LaserMapper {
    /// Before the first scan.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] where a setting is, by the name of its field.
    pub fn new(settings: LaserMapperSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        let map = Map::new(settings.grid());
        let beams = settings.beams.unwrap_or(MODELS.beams);
        Ok(Self {
            settings,
            executor: Executor::default(),
            filter: filter(&settings, beams, map).build()?,
            beams,
            odometer: Odometer::default(),
            wheels: Wheels::default(),
            predicted: None,
            spreads: Spreads::default(),
            since_mark: 0.0,
            views: LastViews::default(),
            closings: Closings::default(),
            odometry: Vec::new(),
            steps: 0,
            resampled: 0,
            single_lineage_since: (settings.particles == 1).then_some(0),
            stamps: Vec::new(),
        })
    }

    /// The same mapper, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { executor: executor.clone(), filter: self.filter.with_executor(executor), ..self }
    }

    /// The next scan, with the pose that raw odometry gives for it. Odometry may be in any frame, as long as it is one: only
    /// motions count. Where the clock or the scans contradict it ([`Self::unbelieved`]), the scan is matched with those before instead.
    ///
    /// A scan whose time or pose is not finite, whose pose lies further than 10 000 km from odometry's origin, or more than 1 km from
    /// that of the last scan that was not refused, is refused.
    ///
    /// Where a path is bent to close a loop, all scans so far are mapped again: [`LaserMapperSettings::remapped_per_scan`] of them a call.
    pub fn push(&mut self, scan: &LaserScan) -> Pushed {
        match self.odometer.next(scan, self.settings.longest()) {
            Ok(believed) => self.push_from(scan, believed),
            Err(reason) => Pushed::Refused(reason),
        }
    }

    /// The next scan, taken where odometry that is believed has the robot.
    fn push_from(&mut self, scan: &LaserScan, Believed { pose: odometry, doubt }: Believed) -> Pushed {
        self.closings.doubt(doubt);
        let Some(last) = self.odometry.last() else {
            self.begin(scan, odometry);
            return Pushed::First;
        };
        let moved = last.between(&odometry);
        if !self.settings.takes(&moved) {
            self.stamps.push(Stamp { time: scan.time, step: self.steps, step_from_robot: moved });
            return Pushed::Still;
        }
        let control = self.wheels.displacement(&moved);
        self.predicted = Some(control);
        let standing = self.standing(scan, odometry);
        if standing.hits.is_empty() {
            // No matching corrects what the wheels err.
            let covariance = control.covariance;
            self.closings.doubt([covariance.m11.max(covariance.m22), covariance.m33].map(f64::sqrt));
        }
        self.mark(driven(&moved)[0]);
        let report = self.filter.step(&control, &standing);
        self.spreads = Spreads::of(&report, &control);
        if self.settings.learn_wheels {
            self.wheels.learn(&moved, &report);
        }
        self.steps = report.step;
        self.resampled += u32::from(report.resampled());
        if self.single_lineage_since.is_none() && self.filter.lineage() == 1 {
            self.single_lineage_since = Some(report.step);
        }
        self.take(scan, odometry);
        if let Some(ancestors) = &report.ancestors {
            self.closings.resampled(ancestors);
        }
        self.closings.take(&standing, driven(&moved)[0], self.settings.kept_scans as usize);
        self.closings.check(&mut self.filter, self.settings.remapped());
        Pushed::Step(report)
    }

    /// Marks all maps as they are, every half of the [lag](models::ModelsConfig::lag): by odometry, as particles are compared by maps of one age.
    fn mark(&mut self, driven: f64) {
        self.since_mark += driven;
        if self.since_mark >= 0.5 * MODELS.lag {
            self.since_mark = 0.0;
            self.closings.mark();
            self.filter.revise(|_, particle| {
                let mut particle = particle.clone();
                particle.map.mark();
                (Some(particle), ())
            });
        }
    }

    /// Maps the first scan, once for all particles.
    fn begin(&mut self, scan: &LaserScan, odometry: Pose2) {
        let mut map = Map::new(self.settings.grid());
        let standing = self.standing(scan, odometry);
        map.assimilate(&Pose2::default(), &standing, &());
        map.settle();
        self.closings.take(&standing, 0.0, self.settings.kept_scans as usize);
        self.beams = self.settings.beams.unwrap_or(scan.ranges.len() as u32);
        // `new` has built one of these settings. The error is left out of what a panic would say, as a number would be written in it by std.
        let Ok(filter) = filter(&self.settings, self.beams, map).build() else { unreachable!() };
        self.filter = filter.with_executor(self.executor.clone());
        self.take(scan, odometry);
    }

    /// What the filter sees of a scan: what moves by itself is no landmark.
    fn standing(&mut self, scan: &LaserScan, odometry: Pose2) -> Scan {
        let displacement = |moved: &Pose2, driven| self.wheels.displacement_over(moved, driven);
        self.views.standing(scan, odometry, self.settings.beams_of(scan), displacement)
    }

    /// Writes down a scan that the filter took.
    fn take(&mut self, scan: &LaserScan, odometry: Pose2) {
        self.stamps.push(Stamp { time: scan.time, step: self.steps, step_from_robot: Pose2::default() });
        self.odometry.push(odometry);
    }

    /// As they were set.
    pub fn settings(&self) -> &LaserMapperSettings {
        &self.settings
    }

    /// Completes what is under way: paths that are being corrected to close a loop take over now, whatever that takes. For the end of a log.
    pub fn finish(&mut self) {
        self.closings.correct(&mut self.filter, usize::MAX);
    }

    /// The filter, for those who watch it: its particles, their weights, and what they descend from.
    pub fn filter(&self) -> &Filter {
        &self.filter
    }

    /// The steps of odometry that were not believed, as time and scans contradict them.
    pub fn unbelieved(&self) -> &[Unbelieved] {
        self.odometer.unbelieved()
    }

    /// What has been learnt of the wheels.
    pub fn wheels(&self) -> &Wheels {
        &self.wheels
    }

    /// Where the last step of the filter led by odometry, with the drift and the noise of the wheels as they were known before it; `None` before the first.
    /// What [`OdometryInnovations`] hold scans against.
    pub fn predicted(&self) -> Option<&Displacement> {
        self.predicted.as_ref()
    }

    /// Steps of the filter so far: the scans that it took, without the first.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// The best particle's map, in the frame of the first scan's pose; an unknown world before that scan.
    pub fn map(&self) -> &Map {
        &self.best().map
    }

    /// Where the best particle has the robot now, in the frame of the first scan's pose.
    pub fn pose(&self) -> Pose2 {
        let pose = self.best().world_from_robot;
        self.stamps.last().map_or(pose, |stamp| pose.compose(&stamp.step_from_robot))
    }

    /// [`Self::pose`] with the covariance of its error.
    pub fn pose_with_covariance(&self) -> PoseWithCovariance {
        self.spreads.now(&self.filter, self.stamps.last(), &self.wheels)
    }

    /// The best particle's path: a pose for each scan so far with its time \[s\], in the frame of the first. A scan that was passed
    /// over has the pose of the last one before it that was taken, moved by raw odometry. The whole path may change with every
    /// scan, as another particle becomes the best or its path is bent to close a loop.
    pub fn path(&self) -> Vec<(f64, Pose2)> {
        let poses = self.best().path.poses();
        let placed = |stamp: &Stamp| (stamp.time, poses[stamp.step as usize].compose(&stamp.step_from_robot));
        self.stamps.iter().map(placed).collect()
    }

    /// Share of the steps so far that resampled, 0 to 1.
    pub fn resampled_fraction(&self) -> f64 {
        f64::from(self.resampled) / f64::from(self.steps.max(1))
    }

    /// The first step after which all particles descended from one, if they do: there is one path only up to some scan then, and
    /// no selection undoes a mistake in it.
    pub fn single_lineage_since(&self) -> Option<u32> {
        self.single_lineage_since
    }

    /// How many times a particle's path was bent to close a loop that no particle had closed by itself.
    pub fn closings(&self) -> u32 {
        self.closings.bent()
    }

    /// The loops of the best particle's path, in the order in which they were found, with the numbers of the filter's steps.
    pub fn loops(&self) -> &[Loop] {
        self.closings.of(self.filter.best()).0
    }

    /// Those of [`Self::loops`] that stay open.
    pub fn open_loops(&self) -> impl Iterator<Item = &Loop> {
        self.loops().iter().filter(|one| one.is_open())
    }

    /// Share, 0 to 1, of what the best particle saw of places that it came back to that lies where its map of before knew the space to be free.
    pub fn disputed_fraction(&self) -> f64 {
        self.closings.of(self.filter.best()).1
    }

    /// How many end points of places that the best particle came back to were compared with its map of before: those of which
    /// [`Self::disputed_fraction`] is a share.
    pub fn seen_again(&self) -> u32 {
        self.closings.seen_again(self.filter.best()) as u32
    }

    /// The stamp of the scan \[s\] that the filter took in a step, and where the best particle has the robot then; `None` of a step that was not.
    pub fn at_step(&self, step: usize) -> Option<(f64, Pose2)> {
        let stamp = self.stamps.iter().find(|stamp| stamp.step as usize == step)?;
        Some((stamp.time, *self.best().path.poses().get(step)?))
    }

    fn best(&self) -> &Particle<Map> {
        &self.filter.particles()[self.filter.best()]
    }
}

/// The filter with this map in each particle, at the origin if nothing else is said.
fn filter(settings: &LaserMapperSettings, beams: u32, map: Map) -> Builder<Map, Proposal> {
    Rbpf::builder(map, models::proposal(beams, settings.weight))
        .particles(settings.particles)
        .seed(settings.seed)
        .policy(settings.policy)
        .selection_temper(MODELS.selection_temper)
}
