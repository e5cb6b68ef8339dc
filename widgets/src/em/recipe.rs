//! What a reader can set about EM mapping and the corridor.

use crate::{
    field,
    prediction::{self, Asks, Prediction, predicts},
    recipe::{self, Param},
    words::{common, em},
};
use fastslam_lab::experiment::em::{DOORS, Guess, ITERATIONS, LENGTH, LogSetup, STEPS};

/// Steps that an iteration is shown in: so many of the forward pass, so many of the backward one, their product, and the map.
pub const FILLS: u32 = 4;
/// See [`FILLS`].
pub const TICKS: u32 = 2 * FILLS + 2;

/// The last step of the longest run: a figure that is there shows the end, wherever that is.
pub const END: u32 = ITERATIONS * TICKS;

/// Where a mark can be \[m\], and what it is moved by.
pub const MARK: (f64, f64, f64) = (0.0, LENGTH, 0.1);

/// Names of the marks.
pub const MARKS: [&str; DOORS] = ["mark-1", "mark-2", "mark-3"];

/// Everything that a link can say.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// Standard deviation of a step of the wheels \[m\].
    odometry: f64,
    /// How often the sensor errs \[%\].
    sensor: f64,
    seed: u64,
    particles: u32,
    /// Where doors are guessed to be \[m\].
    marks: [f64; DOORS],
    /// How sure the first map is of that \[%\].
    trust: f64,
    /// How many iterations are made.
    pub iterations: u32,
    /// How many readings after each step tell where the robot was then.
    pub future: u32,
    /// Where the reader expects EM mapping to have the robot put down \[m\].
    pub prediction: Prediction,
    /// The step asked for.
    pub step: u32,
}

impl Default for Recipe {
    fn default() -> Self {
        let (LogSetup { odometry_std, seed, particles, .. }, Guess { marks, .. }) = Default::default();
        Self {
            odometry: odometry_std,
            sensor: 5.0,
            seed,
            particles,
            marks,
            trust: 100.0,
            iterations: 20,
            future: STEPS,
            prediction: Prediction::default(),
            step: END,
        }
    }
}

impl Recipe {
    /// What decides the log.
    pub fn log(&self) -> LogSetup {
        let Self { odometry: odometry_std, sensor, seed, particles, .. } = *self;
        LogSetup { odometry_std, errors: sensor / 100.0, seed, particles }
    }

    /// What EM mapping begins with.
    pub fn guess(&self) -> Guess {
        Guess { marks: self.marks, trust: self.trust / 100.0 }
    }

    /// Moves a mark \[m\], by its rank, to the nearest place that it can be at.
    pub fn put(&mut self, rank: usize, place: f64) {
        if let Some(mark) = self.marks.get_mut(rank) {
            // Tenths, as they are written.
            *mark = (place / MARK.2).round().clamp(0.0, LENGTH / MARK.2) / 10.0;
        }
    }
}

predicts!(Recipe);

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let [predict, guess, run] = prediction::rows(Asks {
            predict_help: em::predict_help(),
            guess_help: em::guess_help(),
            unit: "m",
            range: MARK,
            run: [em::run(), em::run_help()],
        });
        let mark = |rank: usize, title, field| {
            P::number(MARKS[rank], title, "m", MARK, field, em::mark_help()).folded().without_slider()
        };
        vec![
            P::integer("future", em::future(), em::readings(), (0, STEPS), field!(future), em::future_help())
                .in_sight()
                .view(),
            P::number("odometry", em::odometry(), "m", (0.01, 0.3, 0.01), field!(odometry), em::odometry_help())
                .in_sight(),
            P::number("sensor", em::sensor(), "%", (0.0, 45.0, 1.0), field!(sensor), em::sensor_help()),
            P::integer("iterations", em::iterations(), "", (1, ITERATIONS), field!(iterations), em::iterations_help()),
            P::seed(field!(seed), em::seed_help()),
            P::number("trust", em::trust(), "%", (0.0, 100.0, 5.0), field!(trust), em::trust_help()).folded(),
            P::integer("particles", em::particles(), "", (1, 5000), field!(particles), em::particles_help()).folded(),
            mark(0, em::mark_1(), field!(marks[0])),
            mark(1, em::mark_2(), field!(marks[1])),
            mark(2, em::mark_3(), field!(marks[2])),
            predict,
            guess,
            run,
            P::integer("step", common::step(), "", (0, END), field!(step), common::step_help()).view(),
        ]
    }

    /// Another log, another first guess or more iterations are another question. Who has answered it sees the end.
    fn follow(&mut self, before: &Self) {
        let asked = |recipe: &Self| (recipe.log(), recipe.guess(), recipe.iterations);
        if asked(self) != asked(before) && self.prediction == before.prediction {
            self.prediction.ask_anew();
        }
        if self.prediction.is_shown() && !before.prediction.is_shown() && self.step == before.step {
            self.step = END;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn untouched_it_is_the_experiment() {
        let recipe = Recipe::default();
        assert_eq!((recipe.log(), recipe.guess()), (LogSetup::default(), Guess::default()));
    }

    #[test]
    fn a_mark_is_put_to_tenths_of_a_metre_in_the_corridor() {
        let put = |place| {
            let mut recipe = Recipe::default();
            recipe.put(1, place);
            recipe.marks[1]
        };
        assert_eq!([put(3.12), put(-4.0), put(1e9), put(0.29)], [3.1, 0.0, 10.0, 0.3]);
    }
}
