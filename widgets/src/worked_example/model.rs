//! The example as a deterministic state: its inputs.

use super::recipe::Recipe;
use crate::model::{Declared, FigureError, Model};
use crate::words::worked_example;
use fastslam_lab::experiment::worked_example::WorkedExample;

/// The figure of the worked example.
pub struct WorkedExampleModel {
    pub(super) recipe: Recipe,
    pub(super) example: WorkedExample,
}

impl Default for WorkedExampleModel {
    fn default() -> Self {
        let recipe = Recipe::default();
        Self { recipe, example: WorkedExample::new(&recipe.inputs) }
    }
}

impl WorkedExampleModel {
    /// Every number of it.
    pub fn example(&self) -> &WorkedExample {
        &self.example
    }
}

impl Declared for WorkedExampleModel {
    type Recipe = Recipe;
    const TITLE: &'static str = worked_example::TITLE;

    fn recipe(&self) -> &Recipe {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Recipe) -> Result<(), FigureError> {
        *self = Self { recipe, example: WorkedExample::new(&recipe.inputs) };
        Ok(())
    }
}

impl Model for WorkedExampleModel {
    fn compared(&self) -> Vec<&'static str> {
        vec!["w1", "w2", "ess"]
    }
}
