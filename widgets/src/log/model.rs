//! The mapping of a log as a deterministic state: what was set, which log is open, and how far it is mapped.
//!
//! A link holds the settings alone: the log is a reader's file, and no link can bring it.

use super::{
    kept::{Death, Kept, Seen},
    laid::Laid,
    opened::{LIMIT, Opened, swept},
    recipe::Recipe,
    tree::FADE,
};
use crate::decimal::write;
use crate::model::{Change, Declared, FigureError, Files, Model};
use crate::told::megabytes;
use crate::unread::{self, refused};
use crate::words::log as words;
use fastslam::{
    map::{
        Footprint,
        grid::{MapImage, MapImageSettings},
    },
    mapper::{LaserMapper, LaserMapperSettings, Replay},
    rbpf::Report,
};
use fastslam_log::{LaserLog, parse_carmen};

/// Steps back of the lineage gauge.
pub const BACK: u32 = 20;

/// Steps between two looks at the memory of all maps: a look takes as long as a step does.
const LOOK: u32 = 20;

/// The memory of no maps.
const NOTHING: Footprint = Footprint { unique: 0, dense: 0 };

/// A recorded log, mapped.
#[derive(Default)]
pub struct LogModel {
    recipe: Recipe,
    opened: Option<Opened>,
    /// The step asked for.
    asked: u32,
    /// From the first step on.
    replay: Option<Replay<LaserLog>>,
    /// Of every step that was made, from 1 on.
    history: Vec<Moment>,
    /// Of the last `FADE` steps.
    deaths: Vec<Death>,
    /// What can be gone back to.
    kept: Kept,
    /// What raw odometry alone makes of the scans that were taken.
    laid: Laid,
    /// The step that was gone back to; `None` for the newest.
    shown: Option<u32>,
    /// How many logs were opened.
    logs: u32,
}

/// What one step did.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Moment {
    /// Log of the evidence by the filter \[nats\]; −∞ where no universe explains the scan.
    pub log_evidence: f64,
    /// N_eff before resampling.
    pub ess: f64,
    /// Whether it resampled.
    pub resampled: bool,
    /// Universes without offspring.
    pub died: u32,
    /// Distinct ancestors [`BACK`] steps ago.
    pub lineage: u32,
    /// The latest step up to which all universes share one path.
    pub shared: u32,
    /// The maps' memory at its largest, up to then.
    pub peak: Footprint,
}

impl LogModel {
    /// The log, once one is open.
    pub fn log(&self) -> Option<&LaserLog> {
        self.opened.as_ref().map(|opened| &*opened.log)
    }

    /// Which log it is, of all that were opened.
    pub fn log_number(&self) -> u32 {
        self.logs
    }

    /// What was read of it.
    pub(super) fn opened(&self) -> Option<&Opened> {
        self.opened.as_ref()
    }

    /// The mapping, once it was asked for.
    pub(super) fn replay(&self) -> Option<&Replay<LaserLog>> {
        self.replay.as_ref()
    }

    /// The maps' memory at its largest.
    pub(super) fn peak(&self) -> Footprint {
        self.history().last().map_or(NOTHING, |moment| moment.peak)
    }

    /// The population after the step shown, once the mapping was asked for.
    pub(super) fn seen(&self) -> Option<&Seen> {
        self.shown.map_or_else(|| self.kept.newest(), |step| self.kept.at(step))
    }

    /// What was set.
    pub fn setup(&self) -> &LaserMapperSettings {
        &self.recipe.setup
    }

    /// The mapper after the newest step, whichever is shown, once it was asked for.
    pub fn mapper(&self) -> Option<&LaserMapper> {
        self.replay.as_ref().map(Replay::mapper)
    }

    /// Of every step up to the one shown, from 1 on.
    pub fn history(&self) -> &[Moment] {
        &self.history[..self.step() as usize]
    }

    /// Of every step that was made, whichever is shown.
    pub fn all_history(&self) -> &[Moment] {
        &self.history
    }

    /// The newest step.
    fn mapped(&self) -> u32 {
        self.history.len() as u32
    }

    /// Whether raw odometry is drawn: what there is to see before the first step.
    pub fn shows_raw(&self) -> bool {
        self.recipe.raw || self.replay.is_none()
    }

    /// What raw odometry alone makes of the scans, where it is to be seen.
    pub(super) fn compared(&self) -> Option<&Laid> {
        Some(&self.laid).filter(|_| self.recipe.odometry)
    }

    /// From where the best universe has the robot after the step shown to where raw odometry has it \[m\].
    pub(super) fn apart(&self) -> Option<f64> {
        let seen = self.seen()?;
        Some(seen.paths[seen.best].pose().distance(&self.laid.odometry(seen.step)?))
    }

    /// Memory that the maps may take at the most \[bytes\].
    pub fn estimate(&self) -> Option<f64> {
        Some(self.opened.as_ref()?.bytes(self.setup(), self.setup().particles))
    }

    /// Takes a log instead of the one before.
    fn adopt_log(&mut self, log: LaserLog) -> Result<(), FigureError> {
        if log.scans.len() < 2 {
            return Err(refused(words::one_scan()));
        }
        self.opened = Some(Opened::new(log, self.setup()));
        self.logs += 1;
        self.restart();
        Ok(())
    }

    /// Forgets what was computed.
    fn restart(&mut self) {
        self.replay = None;
        self.asked = 0;
        self.history.clear();
        self.deaths.clear();
        self.kept = Kept::default();
        self.laid = Laid::default();
        self.shown = None;
    }

    /// What the step that was just made did.
    fn note(&mut self, report: &Report<()>) {
        let (Some(replay), Some(opened)) = (&self.replay, &self.opened) else { return };
        self.laid.follow(replay, &opened.log);
        let descent = replay.mapper().filter().descent();
        let (step, paths): (u32, Vec<_>) = (report.step, report.extinct().cloned().collect());
        let before = self.history.last().map_or(NOTHING, |moment| moment.peak);
        let looks = step.is_multiple_of(LOOK) || step == replay.step_count();
        let now = if looks { replay.mapper().footprint() } else { NOTHING };
        self.history.push(Moment {
            log_evidence: report.log_evidence,
            ess: report.selection_ess,
            resampled: report.resampled(),
            died: paths.len() as u32,
            lineage: descent.lineage(BACK),
            shared: descent.coalescence().unwrap_or(0),
            peak: if now.unique > before.unique { now } else { before },
        });
        self.deaths.retain(|death| step - death.step < FADE);
        if !paths.is_empty() {
            self.deaths.push(Death { step, paths });
        }
        self.kept.push(Seen::now(replay, &self.deaths));
    }
}

impl Declared for LogModel {
    type Recipe = Recipe;
    const TITLE: &'static str = words::TITLE;
    const CHANGES: &'static [Change] = &[
        Change::Default { name: "raw", was: "off" },
        Change::Told(
            "Free ground begins at the laser, and the noise of the wheels goes by the way: paths and maps differ a little.",
        ),
    ];
    const UNSAID: usize = 3;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        if recipe.setup != self.recipe.setup {
            if let Some(opened) = &mut self.opened
                && recipe.setup.max_range != self.recipe.setup.max_range
            {
                opened.swept = swept(&opened.log, recipe.setup.max_range);
            }
            self.restart();
        }
        self.recipe = recipe;
        Ok(())
    }
}

impl Files for LogModel {
    fn open(&mut self, file: &[u8]) -> Result<(), FigureError> {
        if file.is_empty() {
            return Err(refused(words::empty()));
        }
        self.adopt_log(unread::text(file, parse_carmen)?)
    }

    fn take(&mut self, read: &[u8]) -> Result<(), FigureError> {
        self.adopt_log(LaserLog::from_bytes(read).ok_or_else(|| refused(words::no_scan()))?)
    }

    fn ready(&self) -> Result<(), FigureError> {
        let Some(opened) = &self.opened else {
            return Err(refused(words::no_log_yet()));
        };
        let notes = &opened.log.notes;
        if let (false, Some(first)) = (self.recipe.lenient, &notes.first_malformed) {
            let (first, n) = (unread::error(first).message, &notes.malformed);
            let message = if *n > 1 { words::ManyMalformed { first: &first, n }.say() } else { first };
            return Err(FigureError { parameter: "lenient".into(), message });
        }
        let setup = self.setup();
        let needed = opened.bytes(setup, setup.particles);
        if needed <= LIMIT {
            return Ok(());
        }
        let (cell, needed, limit) = (&write(setup.cell_size), &megabytes(needed), &megabytes(LIMIT));
        let most = (1..setup.particles).rev().find(|universes| opened.bytes(setup, *universes) <= LIMIT);
        Err(match most {
            Some(most) => {
                let allowed = words::MostUniverses { most: &most, cell, needed, limit }.say();
                FigureError::new("universes", setup.particles, allowed)
            }
            // Where not even one fits, it is the cells that are too small. Rounded up to what can be set.
            None => {
                let least = setup.cell_size * (opened.bytes(setup, 1) / LIMIT).sqrt();
                let least = write((100.0 * least).ceil() / 100.0);
                FigureError::new("cell", cell, words::LeastCell { least: &least, cell, needed, limit }.say())
            }
        })
    }

    fn file(&self, name: &str) -> Option<Vec<u8>> {
        let mapper = self.mapper()?;
        Some(match name {
            // Time [s], x [m], y [m] and heading [rad] of each pose, in the bits of the path: what another program writes files of.
            "path.f64" => mapper
                .path()
                .iter()
                .flat_map(|(time, pose)| [*time, pose.x, pose.y, pose.theta])
                .flat_map(f64::to_le_bytes)
                .collect(),
            "map.pgm" => map_image(mapper)?.pgm(),
            // Side of a cell and the world frame of the lower left corner [m], in their bits, for the same.
            "map.f64" => {
                let MapImage { cell_size, origin: [x, y], .. } = map_image(mapper)?;
                [cell_size, x, y].into_iter().flat_map(f64::to_le_bytes).collect()
            }
            _ => return None,
        })
    }
}

/// The best particle's map as ROS reads it, with the ground that the robot has covered.
fn map_image(mapper: &LaserMapper) -> Option<MapImage> {
    MapImage::of(mapper.map(), &mapper.path(), &MapImageSettings::default()).ok() // the defaults are in range
}

impl Model for LogModel {
    /// Goes on to a step; to one that is past, by showing what was kept of it, or of the next that something was kept of.
    fn seek(&mut self, step: u32) {
        let Some(opened) = self.opened.as_ref().filter(|_| self.ready().is_ok()) else { return };
        if step < self.mapped() {
            self.shown = Some(self.kept.towards(step, self.step()));
            self.asked = self.mapped();
            return;
        }
        self.shown = None;
        if self.replay.is_none() && step > 0 {
            self.replay = Replay::new(*self.setup(), opened.log.clone()).ok(); // the parameters' ranges are within the mapper's
            if let Some(replay) = &self.replay {
                self.kept.push(Seen::now(replay, &[]));
                self.laid.follow(replay, &opened.log);
            }
        }
        self.asked = step.min(self.step_count());
    }

    fn files(&self) -> Option<&dyn Files> {
        Some(self)
    }

    fn files_mut(&mut self) -> Option<&mut dyn Files> {
        Some(self)
    }

    fn step_count(&self) -> u32 {
        match (&self.replay, self.log()) {
            (Some(replay), _) => replay.step_count(),
            (None, Some(log)) => log.scans.len() as u32 - 1,
            _ => 0,
        }
    }

    fn step(&self) -> u32 {
        self.shown.unwrap_or(self.mapped())
    }

    fn pending(&self) -> u32 {
        self.asked - self.mapped()
    }

    fn work(&mut self) {
        if self.pending() > 0
            && let Some(report) = self.replay.as_mut().and_then(Replay::next)
        {
            self.note(&report);
        }
    }
}

#[cfg(test)]
mod tests;
