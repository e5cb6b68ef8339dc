//! A log, pushed into a mapper.

use super::{LaserMapper, LaserMapperSettings, moved};
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
        let mapper = LaserMapper::new(settings)?;
        let bounds = taken(&settings, &log).into_iter().chain([log.scans.len()]).collect();
        let mut replay = Self { log, bounds, mapper };
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
        let mut reports = self.log.scans[start..end].iter().filter_map(|scan| self.mapper.push(scan).report());
        let report = reports.next();
        reports.for_each(drop);
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
fn taken(settings: &LaserMapperSettings, log: &LaserLog) -> Vec<usize> {
    let mut taken: Vec<usize> = Vec::new();
    for (k, scan) in log.scans.iter().enumerate() {
        let last = taken.last().map(|last| log.scans[*last].odometry);
        let takes = |moved: Option<Pose2>| moved.is_none_or(|moved| settings.takes(&moved));
        if moved(last.as_ref(), scan).is_ok_and(takes) {
            taken.push(k);
        }
    }
    taken
}
