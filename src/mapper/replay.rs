//! A log, pushed into a mapper.

use super::{LaserMapper, LaserMapperSettings};
use crate::error::SettingError;
use crate::execute::Executor;
use crate::geometry::Pose2;
use crate::log::LaserLog;
use crate::rbpf::Report;
use std::sync::Arc;

/// A log on its way through a [`LaserMapper`]: an iterator over the steps of the filter.
///
/// A step pushes the scan that the filter takes and those after it that it passes over, so that between two steps every scan up to
/// the next one that is taken has its place on the path. Clones share the log.
///
/// ```
/// use fastslam::log::parse;
/// use fastslam::mapper::{LaserMapperSettings, Replay};
/// use std::sync::Arc;
/// // A robot a metre from a wall backs away from it. In the second message it stands where it stood.
/// let text = "FLASER 3 9 1.0 9  0 0 0    0 0 0    1 host 1\n\
///             FLASER 3 9 1.0 9  0 0 0    0 0 0    2 host 2\n\
///             FLASER 3 9 1.1 9  -0.1 0 0 -0.1 0 0 3 host 3\n";
/// let log = Arc::new(parse(text.as_bytes(), false)?);
/// let mut replay = Replay::new(LaserMapperSettings::default(), log)?;
/// assert_eq!(replay.step_count(), 1);
/// while let Some(report) = replay.next() {
///     println!("step {}: N_eff {:.1}, at {:?}", report.step, report.ess, replay.mapper().pose());
/// }
/// assert_eq!(replay.mapper().path().len(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Replay {
    log: Arc<LaserLog>,
    /// Of each scan, as far as it is believed; `None` of a scan that is refused.
    odometry: Arc<[Option<Pose2>]>,
    /// Numbers of the scans that the filter takes, the first included, and at the end how many scans there are.
    bounds: Arc<[usize]>,
    mapper: LaserMapper,
}

impl Replay {
    /// With the log's first scan mapped. What the settings do not say of the laser is read off the log
    /// ([`LaserMapperSettings::for_log`]).
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] where a setting is, by the name of its field.
    pub fn new(settings: LaserMapperSettings, log: Arc<LaserLog>) -> Result<Self, SettingError> {
        let settings = settings.for_log(&log);
        let mut mapper = LaserMapper::new(settings)?;
        let odometry: Arc<[_]> =
            log.scans.iter().map(|scan| mapper.odometer.next(scan, settings.longest()).ok()).collect();
        let bounds = taken(&settings, &odometry).into_iter().chain([log.scans.len()]).collect();
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
        self.bounds.get(self.mapper.steps() as usize + 1).copied().unwrap_or(self.log.scans.len())
    }

    /// Pushes the n-th scan that the filter takes and all up to the next.
    fn push(&mut self, n: usize) -> Option<Report<()>> {
        let [start, end] = *self.bounds.get(n..n + 2)? else { return None };
        let scans = self.log.scans[start..end].iter().zip(&self.odometry[start..end]);
        let placed = scans.filter_map(|(scan, odometry)| Some((scan, (*odometry)?)));
        let mut reports = placed.filter_map(|(scan, odometry)| self.mapper.push_from(scan, odometry).report());
        let report = reports.next();
        reports.for_each(drop);
        if end == self.log.scans.len() {
            self.mapper.finish();
        }
        report
    }
}

impl Iterator for Replay {
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

impl ExactSizeIterator for Replay {}

impl core::iter::FusedIterator for Replay {}

/// Numbers of the scans that a mapper takes, the first included.
fn taken(settings: &LaserMapperSettings, odometry: &[Option<Pose2>]) -> Vec<usize> {
    let mut last: Option<Pose2> = None;
    let mut takes = |pose: &Pose2| {
        let takes = last.is_none_or(|last| settings.takes(&last.between(pose)));
        if takes {
            last = Some(*pose);
        }
        takes
    };
    let placed = odometry.iter().enumerate().filter_map(|(k, pose)| Some((k, (*pose)?)));
    placed.filter(|(_, pose)| takes(pose)).map(|(k, _)| k).collect()
}
