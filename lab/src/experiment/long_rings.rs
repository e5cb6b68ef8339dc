//! The [mapper](fastslam::mapper) of logs on long loops: once round a corridor of [60, 120 or 240 m](LENGTHS), and on for a quarter. Does
//! the loop close?
//!
//! All that is hard about such a log is in it: nothing is seen again before the robot is back where it began, by when odometry's heading
//! may be off by a quarter of a turn; doors look alike; and people walk about and hide some of what there is to see. As the truth is
//! known, a path is judged as recorded buildings with reference paths are ([`LoopErrors`]).

use super::graph::PathError;
use super::log::{Example, Recipe};
use crate::world::LongRing;
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::mapper::{LaserMapper, LaserMapperSettings, Replay};
use fastslam::motion::OdometryModel;
use fastslam::proposal::IncrementalWeight;
use fastslam_log::LaserLog;
use std::sync::Arc;

/// Once round \[m\].
pub const LENGTHS: [u32; 3] = [60, 120, 240];

/// A log of a long ring and a mapper of it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LongRingSetup {
    /// Once round along the middle of the corridor \[m\], in [`Self::LENGTH`].
    pub length: u32,
    /// Number of particles M, in [`LaserMapperSettings::PARTICLES`].
    pub particles: usize,
    /// Seed of the building, of its noises, and of the filter's draws.
    pub seed: u64,
    /// What a particle pays for a scan.
    pub weight: IncrementalWeight,
}

impl Default for LongRingSetup {
    /// The shortest ring, with what [`LaserMapperSettings`] have.
    fn default() -> Self {
        let LaserMapperSettings { particles, seed, weight, .. } = LaserMapperSettings::default();
        Self { length: LENGTHS[0], particles, seed, weight }
    }
}

impl LongRingSetup {
    /// Range of [`Self::length`].
    pub const LENGTH: Range = Range::whole(40, 480);

    /// The robot: a laser of 180 beams over 180° that sees 12 m far, ± 2 cm; a scan every 0.4 m; wheels with the noise of
    /// [`Recipe::scatter`]; and somebody on foot for every 8 m of the corridor.
    pub fn recipe(&self) -> Recipe {
        let ring = LongRing { length: f64::from(self.length), seed: self.seed };
        Recipe {
            seed: self.seed,
            plan: ring.plan(),
            route: ring.once_and_a_quarter(),
            spacing: 0.4,
            beams: 180,
            max_range: 12.0,
            range_std: 0.02,
            wheels: OdometryModel { alphas: [0.0; 4] },
            scatter: 1.0,
            walkers: Some((ring, self.length / 8)),
            ..Recipe::building()
        }
    }

    /// At its start.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn start(&self) -> Result<LongRingRun, SettingError> {
        Self::LENGTH.check("length", f64::from(self.length))?;
        let Example { log, truth, .. } = Example::of(&self.recipe(), usize::MAX);
        let log = Arc::new(log);
        let settings = LaserMapperSettings {
            particles: self.particles,
            seed: self.seed,
            weight: self.weight,
            ..LaserMapperSettings::default()
        };
        Ok(LongRingRun { replay: Replay::new(settings, Arc::clone(&log))?, log, truth })
    }
}

/// What a path around a loop is off by.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LoopErrors {
    /// RMS error of position after the best rigid alignment \[m\].
    pub rms: f64,
    /// The same of the first time round alone, aligned by itself \[m\].
    pub first_lap: f64,
    /// Share of the revisits, 0 to 1, that are off by more than 0.5 m. A revisit is two poses less than 1.5 m apart, the one more than
    /// 60 scans later; it is off by how far the second is from where it should be, as seen from the first.
    pub revisits_off: f64,
}

impl LoopErrors {
    /// Of a path against the truth, which comes back.
    ///
    /// # Panics
    /// Where they are of different lengths.
    pub fn of(path: &[Pose2], truth: &[Pose2]) -> Self {
        /// Poses nearer than this are in one place \[m\].
        const NEAR: f64 = 1.5;
        /// Scans after which a place is seen again.
        const LATER: usize = 61;
        /// Of a revisit that has not closed \[m\].
        const OFF: f64 = 0.5;
        let (mut revisits, mut off) = (0_u32, 0_u32);
        for first in 0..truth.len() {
            for second in first + LATER..truth.len() {
                if truth[first].distance(&truth[second]) < NEAR {
                    let [is, should] = [path, truth].map(|poses| poses[first].between(&poses[second]));
                    revisits += 1;
                    off += u32::from(is.distance(&should) > OFF);
                }
            }
        }
        let lap = first_lap(truth);
        Self {
            rms: PathError::of(path, truth).aligned,
            first_lap: PathError::of(&path[..lap], &truth[..lap]).aligned,
            revisits_off: f64::from(off) / f64::from(revisits.max(1)),
        }
    }
}

/// Poses of the first time round: from where it has been furthest away, the path comes back to the first pose and is nearest to it.
fn first_lap(truth: &[Pose2]) -> usize {
    let from_start = |k: &usize| truth[*k].distance(&truth[0]);
    let furthest = (0..truth.len()).max_by(|a, b| from_start(a).total_cmp(&from_start(b))).unwrap_or(0);
    (furthest..truth.len()).min_by(|a, b| from_start(a).total_cmp(&from_start(b))).map_or(0, |back| back + 1)
}

/// A log of a long ring on its way through the mapper.
#[derive(Clone, Debug)]
pub struct LongRingRun {
    replay: Replay<LaserLog>,
    log: Arc<LaserLog>,
    truth: Vec<Pose2>,
}

impl LongRingRun {
    /// The same run, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { replay: self.replay.with_executor(executor), ..self }
    }

    /// One scan; `false` after the last.
    pub fn step(&mut self) -> bool {
        self.replay.next().is_some()
    }

    /// The run as that of any log.
    pub fn into_replay(self) -> Replay<LaserLog> {
        self.replay
    }

    /// The mapper, as far as it has come.
    pub fn mapper(&self) -> &LaserMapper {
        self.replay.mapper()
    }

    /// The log.
    pub fn log(&self) -> &LaserLog {
        &self.log
    }

    /// Where the robot was, for each scan.
    pub fn truth(&self) -> &[Pose2] {
        &self.truth
    }

    /// The best particle's path so far.
    pub fn path(&self) -> Vec<Pose2> {
        self.mapper().path().into_iter().map(|(_, pose)| pose).collect()
    }

    /// What it is off by so far.
    pub fn errors(&self) -> LoopErrors {
        let path = self.path();
        LoopErrors::of(&path, &self.truth[..path.len()])
    }

    /// What raw odometry is off by at the end.
    pub fn odometry_errors(&self) -> LoopErrors {
        let path: Vec<Pose2> = self.log.scans.iter().map(|scan| scan.odometry).collect();
        LoopErrors::of(&path, &self.truth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::ops;

    #[test]
    fn the_robot_drives_once_round_and_on_and_no_wall_is_in_its_way() {
        for length in LENGTHS {
            let setup = LongRingSetup { length, seed: 2, ..LongRingSetup::default() };
            let Recipe { plan, .. } = setup.recipe();
            let truth = Example::of(&setup.recipe(), usize::MAX).truth;
            let back = first_lap(&truth);
            assert!(truth[back - 1].distance(&truth[0]) < 0.5);
            // A fifth of the way is the second time.
            let share = back as f64 / truth.len() as f64;
            assert!((share - 0.8).abs() < 0.01, "{length} m: {share}");
            for pair in truth.windows(2) {
                let [dx, dy] = [pair[1].x - pair[0].x, pair[1].y - pair[0].y];
                let free = plan.raycast([pair[0].x, pair[0].y], ops::atan2(dy, dx));
                assert!(free > pair[0].distance(&pair[1]) + 0.1, "{length} m at {:?}", pair[0]);
            }
        }
    }

    /// Five per cent of the way along each axis, 3° a metre, 5 % of the turn.
    #[test]
    fn odometry_scatters_as_it_says() {
        let setup = LongRingSetup { length: 240, ..LongRingSetup::default() };
        let run = setup.start().unwrap();
        let mut squares = [0.0; 3];
        let scans = &run.log().scans;
        for k in 1..scans.len() {
            let driven = run.truth()[k - 1].between(&run.truth()[k]);
            let error = scans[k - 1].odometry.between(&scans[k].odometry).minus(&driven);
            let way = driven.distance(&Pose2::default());
            let heading = ops::hypot(3_f64.to_radians() * way, 0.05 * driven.theta);
            for (sum, z) in squares.iter_mut().zip([error.x / (0.05 * way), error.y / (0.05 * way), error.z / heading])
            {
                *sum += z * z;
            }
        }
        let n = (scans.len() - 1) as f64;
        for sum in squares {
            // A mean square of n standard normals has a standard deviation of √(2 / n): four of them.
            assert!((sum / n - 1.0).abs() < 4.0 * (2.0 / n).sqrt(), "{}", sum / n);
        }
    }

    /// People hide what a scan without them sees, and never reach further than it.
    #[test]
    fn people_hide_beams() {
        let setup = LongRingSetup { seed: 4, ..LongRingSetup::default() };
        let with = Example::of(&setup.recipe(), usize::MAX).log;
        let without = Example::of(&Recipe { walkers: None, ..setup.recipe() }, usize::MAX).log;
        let ranges = |log: &LaserLog| -> Vec<f32> { log.scans.iter().flat_map(|scan| scan.ranges.clone()).collect() };
        let (with, without) = (ranges(&with), ranges(&without));
        let hidden = with.iter().zip(&without).filter(|(with, without)| with < without).count() as f64;
        assert!(with.iter().zip(&without).all(|(with, without)| with <= without));
        let share = hidden / with.len() as f64;
        assert!((0.02..0.3).contains(&share), "{share}");
    }

    #[test]
    fn errors_are_those_computed_by_hand() {
        // Out for 80 m and back on the way that it came, half a metre a scan; the path believes itself 1 m further to the left on the way back.
        let at = |k: usize, left: f64| {
            let along = if k <= 80 { k as f64 } else { 160.0 - k as f64 };
            Pose2::new(0.5 * along, left, 0.0)
        };
        let truth: Vec<Pose2> = (0..161).map(|k| at(k, 0.0)).collect();
        let path: Vec<Pose2> = (0..161).map(|k| at(k, if k > 80 { 1.0 } else { 0.0 })).collect();
        assert_eq!(LoopErrors::of(&truth, &truth), LoopErrors { rms: 0.0, first_lap: 0.0, revisits_off: 0.0 });
        let errors = LoopErrors::of(&path, &truth);
        // Every place that is seen 61 scans later is off, and the alignment leaves half a metre on both sides of the middle.
        assert_eq!(errors.revisits_off, 1.0);
        assert!((errors.rms - 0.5).abs() < 0.01 && (errors.first_lap - errors.rms).abs() < 1e-12, "{errors:?}");
        assert_eq!(LoopErrors::of(&path[..50], &truth[..50]).revisits_off, 0.0);
        // Off by 0.4 m is no loop that is open.
        let near: Vec<Pose2> = (0..161).map(|k| at(k, if k > 80 { 0.4 } else { 0.0 })).collect();
        assert_eq!(LoopErrors::of(&near, &truth).revisits_off, 0.0);
    }

    #[test]
    fn settings_out_of_range_are_refused_by_name() {
        let refused = |setup: LongRingSetup| setup.start().unwrap_err().field();
        assert_eq!(refused(LongRingSetup { length: 39, ..LongRingSetup::default() }), "length");
        assert_eq!(refused(LongRingSetup { length: 481, ..LongRingSetup::default() }), "length");
        assert_eq!(refused(LongRingSetup { particles: 0, ..LongRingSetup::default() }), "particles");
    }
}
