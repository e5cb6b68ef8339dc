//! A log, pushed into a mapper.

use super::odometer::Believed;
use super::{LaserMapper, LaserMapperSettings};
use crate::error::SettingError;
use crate::execute::Executor;
use crate::geometry::Pose2;
use crate::rbpf::Report;
use crate::sensor::LaserScan;
use std::sync::Arc;

/// A log on its way through a [`LaserMapper`]: an iterator over the steps of the filter.
///
/// The log is a list of scans, or what has one, as the `LaserLog` of the crate `fastslam-log`. A step pushes the scan that the filter takes and
/// those after it that it passes over, so that between two steps every scan up to the next one that is taken has its place on the path. Clones
/// share the log.
///
/// ```
/// use fastslam::geometry::Pose2;
/// use fastslam::mapper::{LaserMapperSettings, Replay};
/// use fastslam::sensor::LaserScan;
/// use std::sync::Arc;
/// // A robot a metre from a wall backs away from it. In the second scan it stands where it stood.
/// let scan = |(time, x): (f64, f64)| LaserScan {
///     time,
///     odometry: Pose2::new(x, 0.0, 0.0),
///     robot_from_laser: Pose2::default(),
///     first_angle: -1.5,
///     angle_step: 1.5,
///     max_range: None,
///     ranges: vec![9.0, 1.0 - x as f32, 9.0],
/// };
/// let log = [(1.0, 0.0), (2.0, 0.0), (3.0, -0.1)].map(scan).to_vec();
/// let mut replay = Replay::new(LaserMapperSettings::default(), Arc::new(log))?;
/// assert_eq!(replay.step_count(), 1);
/// while let Some(report) = replay.next() {
///     println!("step {}: N_eff {:.1}, at {:?}", report.step, report.ess, replay.mapper().pose());
/// }
/// assert_eq!(replay.mapper().path().len(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Replay<L> {
    log: Arc<L>,
    /// Of each scan, as far as it is believed; `None` of a scan that is refused.
    odometry: Arc<[Option<Believed>]>,
    /// Numbers of the scans that the filter takes, the first included, and at the end how many scans there are.
    bounds: Arc<[usize]>,
    mapper: LaserMapper,
}

impl<L: AsRef<[LaserScan]>> Replay<L> {
    /// With the log's first scan mapped. What the settings do not say of the laser is read off the log
    /// ([`LaserMapperSettings::for_scans`]).
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] where a setting is, by the name of its field.
    pub fn new(settings: LaserMapperSettings, log: Arc<L>) -> Result<Self, SettingError> {
        let scans = log.as_ref().as_ref();
        let settings = settings.for_scans(scans);
        let mut mapper = LaserMapper::new(settings)?;
        let odometry: Arc<[_]> = scans.iter().map(|scan| mapper.odometer.next(scan, settings.longest()).ok()).collect();
        let bounds = taken(&settings, &odometry).into_iter().chain([scans.len()]).collect();
        let mut replay = Self { log, odometry, bounds, mapper };
        replay.push(0);
        Ok(replay)
    }

    /// The same run, computed by another executor: the results are the same.
    pub fn with_executor(self, executor: Executor) -> Self {
        Self { mapper: self.mapper.with_executor(executor), ..self }
    }

    /// The mapper as it is after the last step.
    pub fn mapper(&self) -> &LaserMapper {
        &self.mapper
    }

    /// Steps that there are in all: the scans that the filter takes, without the first.
    pub fn step_count(&self) -> u32 {
        (self.bounds.len() as u32).saturating_sub(2)
    }

    /// Scans of the log up to the last one that was pushed.
    pub fn scans(&self) -> usize {
        self.bounds.get(self.mapper.steps() as usize + 1).copied().unwrap_or_else(|| self.all().len())
    }

    /// All scans of the log.
    fn all(&self) -> &[LaserScan] {
        self.log.as_ref().as_ref()
    }

    /// Pushes the n-th scan that the filter takes and all up to the next.
    fn push(&mut self, n: usize) -> Option<Report<()>> {
        let [start, end] = *self.bounds.get(n..n + 2)? else { return None };
        let all: &[LaserScan] = self.log.as_ref().as_ref();
        let scans = all[start..end].iter().zip(&self.odometry[start..end]);
        let placed = scans.filter_map(|(scan, odometry)| Some((scan, (*odometry)?)));
        let mut reports = placed.filter_map(|(scan, odometry)| self.mapper.push_from(scan, odometry).report());
        let report = reports.next();
        reports.for_each(drop);
        if end == all.len() {
            self.mapper.finish();
        }
        report
    }
}

impl<L: AsRef<[LaserScan]>> Iterator for Replay<L> {
    type Item = Report<()>;

    /// The next step; `None` after the last.
    fn next(&mut self) -> Option<Report<()>> {
        self.push(self.mapper.steps() as usize + 1)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = (self.step_count() - self.mapper.steps()) as usize;
        (left, Some(left))
    }
}

impl<L: AsRef<[LaserScan]>> ExactSizeIterator for Replay<L> {}

impl<L: AsRef<[LaserScan]>> core::iter::FusedIterator for Replay<L> {}

/// The log is shared, so that it need not be one that can be cloned.
impl<L> Clone for Replay<L> {
    fn clone(&self) -> Self {
        let Self { log, odometry, bounds, mapper } = self;
        Self { log: log.clone(), odometry: odometry.clone(), bounds: bounds.clone(), mapper: mapper.clone() }
    }
}

/// Numbers of the scans that a mapper takes, the first included.
fn taken(settings: &LaserMapperSettings, odometry: &[Option<Believed>]) -> Vec<usize> {
    let mut last: Option<Pose2> = None;
    let mut takes = |pose: &Pose2| {
        let takes = last.is_none_or(|last| settings.takes(&last.between(pose)));
        if takes {
            last = Some(*pose);
        }
        takes
    };
    let placed = odometry.iter().enumerate().filter_map(|(k, pose)| Some((k, pose.as_ref()?.pose)));
    placed.filter(|(_, pose)| takes(pose)).map(|(k, _)| k).collect()
}
