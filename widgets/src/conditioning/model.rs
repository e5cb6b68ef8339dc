//! The graphical model as a deterministic state: a drive, how much of it was driven, and whether the path is known.

use super::recipe::{Given, Recipe};
use crate::model::{Change, Declared, FigureError, Model};
use crate::told::{in_range, refused};
use crate::words::conditioning;
use fastslam_lab::{
    baseline::information_matrix::MapCovariance,
    experiment::conditioning::{Conditioning, ConditioningSetup, Covariances},
};

/// Figure w17.4.
pub struct ConditioningModel {
    pub(super) recipe: Recipe,
    pub(super) drive: Conditioning,
    /// What is known after the poses driven.
    pub(super) covariances: Covariances,
}

impl Default for ConditioningModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        let drive = in_range(Conditioning::new(&recipe.setup));
        let covariances = drive.after(recipe.step);
        Self { recipe, drive, covariances }
    }
}

impl ConditioningModel {
    /// The drive.
    pub fn drive(&self) -> &Conditioning {
        &self.drive
    }

    /// What is known after the poses driven.
    pub fn covariances(&self) -> &Covariances {
        &self.covariances
    }

    /// What of the path counts as known: all of it, where the wheels make no error.
    pub fn given(&self) -> Given {
        if self.is_sure() { Given::Path } else { self.recipe.given }
    }

    /// Whether the wheels make no error.
    pub fn is_sure(&self) -> bool {
        self.setup().odometry_scale == 0.0
    }

    /// Whether a pose driven counts as known.
    pub fn knows(&self, pose: usize) -> bool {
        match self.given() {
            Given::Path => true,
            Given::LastPose => pose == 0 || pose == self.recipe.step,
            Given::Nothing => pose == 0,
        }
    }

    /// Whether each look also reads the angles between neighbours.
    pub fn reads_pairs(&self) -> bool {
        self.setup().pairs
    }

    /// The covariance of the landmarks seen that is shown.
    pub fn map(&self) -> &MapCovariance {
        match self.given() {
            Given::Path => &self.covariances.conditional,
            Given::LastPose => &self.covariances.given_last,
            Given::Nothing => &self.covariances.marginal,
        }
    }

    /// Row and column of the entry that is named, from 0 to 2 N − 1.
    pub fn entry(&self) -> [usize; 2] {
        self.recipe.entry
    }

    /// ρ of the entry that is named; `None` where one of its landmarks was not seen yet.
    pub fn correlation(&self) -> Option<f64> {
        let [row, column] = self.recipe.entry.map(|k| self.place(k / 2).map(|j| 2 * j + k % 2));
        Some(self.map().correlation(row?, column?))
    }

    /// Where a landmark stands among those seen.
    pub fn place(&self, landmark: usize) -> Option<usize> {
        self.covariances.seen.iter().position(|&j| j == landmark)
    }

    /// From how many of the poses driven both landmarks were seen.
    pub fn seen_together(&self, a: usize, b: usize) -> usize {
        (1..=self.recipe.step).filter(|&t| [a, b].iter().all(|j| self.drive.sightings(t).contains(j))).count()
    }

    /// How many entries of its covariance an EKF changes at one sighting: all of (2 N + 3)².
    pub fn ekf_entries(&self) -> usize {
        let size = 2 * self.drive.landmarks().len() + 3;
        size * size
    }

    /// How many entries of a map of the landmarks seen lie outside the blocks.
    pub fn off_block(&self) -> usize {
        let n = self.covariances.seen.len();
        4 * n * n.saturating_sub(1)
    }

    pub(super) fn setup(&self) -> &ConditioningSetup {
        self.drive.setup()
    }

    /// Names the entry of a row and a column, or the nearest there is.
    pub fn choose(&mut self, entry: [f64; 2]) {
        self.change(|recipe| {
            let last = (2 * recipe.setup.landmarks - 1) as f64;
            recipe.entry = entry.map(|k| k.max(0.0).min(last) as usize);
        });
    }
}

impl Declared for ConditioningModel {
    type Recipe = Recipe;
    const TITLE: &'static str = conditioning::TITLE;
    const CHANGES: &'static [Change] = &[Change::ToldAt {
        name: "odometry",
        value: 0.0,
        change: "Wheels without error leave the path known; a hidden floor of their noise used to couple all landmarks.",
    }];
    const UNSAID: usize = 2;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        let anew = recipe.setup != self.recipe.setup;
        if anew {
            self.drive = Conditioning::new(&recipe.setup).map_err(refused)?;
        }
        if anew || recipe.step != self.recipe.step {
            self.covariances = self.drive.after(recipe.step);
        }
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for ConditioningModel {
    fn seek(&mut self, step: u32) {
        self.change(|recipe| recipe.step = step as usize);
    }

    fn step_count(&self) -> u32 {
        self.setup().poses as u32
    }

    fn step(&self) -> u32 {
        self.recipe.step as u32
    }

    fn telling(&self) -> u32 {
        self.step_count()
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["largest", "off_block", "largest_std"]
    }
}
