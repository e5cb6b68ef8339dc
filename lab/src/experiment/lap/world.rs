//! The truth of a lap, and what sensors reported of it.

use super::{BEAMS, Course, Route, START_SCANS, STEPS};
use crate::world::{Edits, FloorPlan, Motion, Steering, drive};
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use fastslam::geometry::Pose2;
use fastslam::motion::{Odometry, OdometryModel};
use fastslam::random::Stream;
use fastslam::sensor::{BeamSensor, Scan};

/// The truth of one lap, and what sensors reported of it.
#[derive(Clone, Debug)]
pub struct LapWorld {
    /// The place.
    pub plan: FloorPlan,
    /// The laser.
    pub sensor: BeamSensor,
    /// True poses of step 0 to the last.
    pub truth: Vec<Pose2>,
    /// Poses by raw odometry alone, from the same start.
    pub odometry: Vec<Pose2>,
    /// Reported controls; the k-th leads from step k to k + 1.
    pub controls: Vec<Odometry>,
    /// Scans of step 1 to the last.
    pub scans: Vec<Scan>,
    /// Scans taken at the start, with the poses they were taken from.
    pub start_scans: Vec<(Pose2, Scan)>,
    /// Steps at which a wall kept the robot where it was, in ascending order: its wheels stood.
    pub stopped: Vec<u32>,
    /// Steps at which the robot was lifted and set down elsewhere, in ascending order: its wheels did not notice.
    pub lifted: Vec<u32>,
    /// Controls without their noise.
    pub(super) felt: Vec<Odometry>,
    pub(super) noise: Noise,
}

/// What errs in a world, and by which seed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Noise {
    seed: u64,
    pub(super) motion: OdometryModel,
}

impl LapWorld {
    /// Control and scan of the step after so many; none after the last.
    pub(super) fn told(&self, made: u32) -> Option<(&Odometry, &Scan)> {
        Some((self.controls.get(made as usize)?, self.scans.get(made as usize)?))
    }

    /// The lap of the apartment that this seed and these noises give: the truth is always the same.
    pub fn new(seed: u64, motion: &OdometryModel, range_std: f64) -> Self {
        Self::on(&Course::Apartment.route(), seed, motion, range_std)
    }

    /// The same on another route.
    pub fn on(route: &Route, seed: u64, motion: &OdometryModel, range_std: f64) -> Self {
        Self::edited(route, &Edits::default(), seed, motion, range_std)
    }

    /// The same with walls and a drive of a reader's own, which fit to the route.
    pub fn edited(route: &Route, edits: &Edits, seed: u64, motion: &OdometryModel, range_std: f64) -> Self {
        let plan = edits.walls.apply(&route.plan);
        let sensor = BeamSensor::panorama(BEAMS, route.max_range, range_std);
        let way = drive(&route.way_points, route.steps);
        let mut world = Self {
            plan,
            sensor,
            truth: vec![way[0]],
            odometry: vec![way[0]],
            controls: Vec::with_capacity(STEPS),
            scans: Vec::with_capacity(STEPS),
            start_scans: Vec::new(),
            stopped: Vec::new(),
            lifted: Vec::new(),
            felt: Vec::with_capacity(STEPS),
            noise: Noise { seed, motion: *motion },
        };
        let turned = |k: u32| {
            let spacing = core::f64::consts::TAU / BEAMS as f64;
            way[0].compose(&Pose2::new(0.0, 0.0, spacing * f64::from(k) / f64::from(START_SCANS)))
        };
        world.start_scans = (0..START_SCANS).map(|k| (turned(k), world.look(&turned(k), 0, k))).collect();
        world.drive_on(&way, &edits.steering);
        world
    }

    /// The same place and noise with another drive on the same route: the steps that it has in common with the one `before` are
    /// those of this world, and only the others are computed.
    pub fn driven(&self, route: &Route, before: &Steering, steering: &Steering) -> Self {
        let mut world = self.clone();
        let kept = before.in_common(steering, route.steps).min(world.controls.len());
        world.truth.truncate(kept + 1);
        world.odometry.truncate(kept + 1);
        world.controls.truncate(kept);
        world.felt.truncate(kept);
        world.scans.truncate(kept);
        world.stopped.retain(|step| *step as usize <= kept);
        world.lifted.retain(|step| *step as usize <= kept);
        world.drive_on(&drive(&route.way_points, route.steps), steering);
        world
    }

    /// Drives the steps that are not driven yet: the course's `way` as far as that is asked for, and then motion by motion.
    fn drive_on(&mut self, way: &[Pose2], steering: &Steering) {
        let course = steering.of_course(way.len() - 1);
        while self.controls.len() < course {
            let step = self.controls.len();
            // Kept by a wall, the robot does not find the way again.
            let to = (self.truth[step] == way[step]).then(|| way[step + 1]);
            self.advance(to, Odometry::between);
        }
        while let Some(motion) = steering.motions().get(self.controls.len() - course) {
            let here = self.truth[self.controls.len()];
            let to = motion.from(&here);
            match motion {
                Motion::Lift(_) => {
                    self.lifted.push(self.controls.len() as u32 + 1);
                    self.step(to, Odometry::between(&here, &here));
                }
                // By the way round, it would be half a turn, and another.
                Motion::Back => self.advance(Some(to), |from, to| Odometry::recorded(from, to, f64::EPSILON)),
                Motion::Turn(_) | Motion::Go(_) => self.advance(Some(to), Odometry::between),
            }
        }
    }

    /// A step to a pose, if nothing is in the way.
    fn advance(&mut self, to: Option<Pose2>, wheels: impl Fn(&Pose2, &Pose2) -> Odometry) {
        let here = self.truth[self.controls.len()];
        let open = to.filter(|to| self.plan.is_open([here.x, here.y], [to.x, to.y]));
        if open.is_none() {
            self.stopped.push(self.controls.len() as u32 + 1);
        }
        let to = open.unwrap_or(here);
        self.step(to, wheels(&here, &to));
    }

    /// A step of the truth, of which the wheels feel `felt`.
    fn step(&mut self, to: Pose2, felt: Odometry) {
        let step = self.controls.len() + 1;
        self.felt.push(felt);
        self.report(&felt);
        self.truth.push(to);
        self.scans.push(self.look(&to, step, 0));
    }

    /// The next control with its noise.
    fn report(&mut self, felt: &Odometry) {
        let step = self.controls.len() + 1;
        let mut stream = Stream::at(self.noise.seed, WORLD_ODOMETRY, step as u32, 0);
        let control = self.noise.motion.perturb(felt, &mut stream);
        self.odometry.push(control.apply(&self.odometry[step - 1]));
        self.controls.push(control);
    }

    /// The same drive and scans with other odometry noise.
    pub(super) fn with_motion(&self, motion: &OdometryModel) -> Self {
        let mut world = self.clone();
        world.noise.motion = *motion;
        world.odometry.truncate(1);
        world.controls.clear();
        self.felt.iter().for_each(|felt| world.report(felt));
        world
    }

    fn look(&self, pose: &Pose2, step: usize, look: u32) -> Scan {
        let mut stream = Stream::at(self.noise.seed, WORLD_SENSOR, step as u32, look);
        self.sensor.scan(&self.plan.ranges(pose, &self.sensor, &mut stream))
    }
}
