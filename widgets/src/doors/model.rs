//! Both filters as a deterministic state: what was set, how far they ran, and which step of that is shown.

use super::recipe::{END, Recipe};
use crate::{
    ghost::{self, Curves},
    model::{Declared, FigureError, Model},
    told::{in_range, refused},
    words::doors,
};
use fastslam_lab::experiment::doors::{Doors, DoorsReport, DoorsSetup};

/// The figure of the doors.
pub struct DoorsModel {
    recipe: Recipe,
    run: Doors,
    /// The same before the ride, once it is that far: whoever drags the ride has the drive up to it already.
    mapped: Option<Doors>,
    /// Of every step simulated so far, from 0 on: any of them can be shown.
    reports: Vec<DoorsReport>,
    /// Of the run that is pinned: from the ride on, how many doors EKF-SLAM is off at each step.
    pinned: Curves,
}

impl Default for DoorsModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        let run = in_range(Doors::new(&recipe.setup()));
        Self { reports: vec![run.start()], recipe, run, mapped: None, pinned: Curves::new() }
    }
}

impl DoorsModel {
    /// What decides the numbers.
    pub fn setup(&self) -> &DoorsSetup {
        self.run.setup()
    }

    /// The filters, as far as they ran: at the step shown, or beyond.
    pub fn run(&self) -> &Doors {
        &self.run
    }

    /// Both filters at the step shown.
    pub fn now(&self) -> &DoorsReport {
        &self.reports[self.step() as usize]
    }

    /// Both at steps 0 to the one shown.
    pub fn history(&self) -> &[DoorsReport] {
        &self.reports[..=self.step() as usize]
    }

    /// Whether the drive is over.
    pub fn at_end(&self) -> bool {
        self.step() == self.step_count()
    }

    /// Whether the robot has been carried back.
    pub fn is_carried(&self) -> bool {
        self.step() >= self.ride()
    }

    /// The same at the step asked for, however far that is simulated.
    pub fn will_be_carried(&self) -> bool {
        self.recipe.step >= self.ride()
    }

    /// The step of the ride.
    pub fn ride(&self) -> u32 {
        self.run.events()[0]
    }

    /// How many doors a place \[m\] is off now.
    pub fn off(&self, place: f64) -> i32 {
        self.setup().off(place, self.now().truth)
    }

    /// How many doors the mean of EKF-SLAM is off now.
    pub fn ekf_off(&self) -> i32 {
        self.off(self.now().ekf_place)
    }

    /// Where the ride truly ended \[m\].
    pub fn end(&self) -> f64 {
        self.run.truth()[self.ride() as usize]
    }

    /// Curve of the run that is pinned: how many doors its EKF is off, from the ride on.
    pub fn pinned(&self) -> &[f64] {
        ghost::curve(&self.pinned, 0)
    }
}

impl Declared for DoorsModel {
    type Recipe = Recipe;
    const TITLE: &'static str = doors::TITLE;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        let setup = recipe.setup();
        if setup != *self.setup() {
            let begun = Doors::new(&setup).map_err(refused)?;
            self.run = match &self.mapped {
                Some(mapped) => begun.resumed(mapped),
                None => begun,
            };
            self.reports.truncate(self.run.step_number() as usize + 1);
            if self.run.step_number() == 0 {
                (self.mapped, self.reports) = (None, vec![self.run.start()]);
            }
        }
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for DoorsModel {
    /// Who asks for the last step stays at the end when that moves.
    fn seek(&mut self, step: u32) {
        self.recipe.step = if step >= self.step_count() { END } else { step };
    }

    fn step_count(&self) -> u32 {
        self.run.step_count()
    }

    fn step(&self) -> u32 {
        self.recipe.step.min(self.run.step_number())
    }

    fn telling(&self) -> u32 {
        END
    }

    /// Of the mapping there is little to see: both filters agree.
    fn pace(&self) -> f64 {
        if self.will_be_carried() { 1.0 } else { 4.0 }
    }

    /// It opens when all is over; what went before is the story.
    fn watch(&self) -> Option<(u32, &'static str)> {
        Some((self.ride(), doors::watch()))
    }

    fn pending(&self) -> u32 {
        self.recipe.step.min(self.step_count()).saturating_sub(self.run.step_number())
    }

    fn work(&mut self) {
        if self.pending() > 0 {
            if self.run.step_number() + 1 == self.ride() {
                self.mapped = Some(self.run.clone());
            }
            self.reports.extend(self.run.step());
        }
    }

    fn compared(&self) -> Vec<&'static str> {
        vec!["fastslam_right", "ekf_right", "alive"]
    }

    fn curves(&self) -> Curves {
        let after = self.reports.iter().skip(self.ride() as usize);
        vec![after.map(|report| f64::from(self.setup().off(report.ekf_place, report.truth))).collect()]
    }

    fn haunt(&mut self, pinned: Curves) {
        self.pinned = pinned;
    }
}
