//! What a reader can set about the graph.

use crate::{
    field, names,
    prediction::{self, Asks, Prediction, predicts},
    recipe::{self, Field, Menu, Param},
    words::{common, graph},
};
use fastslam_lab::{
    baseline::pose_graph::Repair,
    experiment::{
        graph::{FALSE_EDGE, GraphSetup, ITERATIONS, Start},
        lap::{Course, STEPS},
    },
};

/// Beyond the last iteration of most graphs, and the most there are: a figure that is there shows the end, wherever that is.
pub const END: u32 = ITERATIONS;

/// What a reader can guess \[m\]: what the chart of the errors shows.
pub const GUESSES: [f64; 2] = [0.02, 20.0];

/// Everything that a link can say.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers, but for the false edge.
    asked: GraphSetup,
    /// Whether there is a false edge.
    wrong: bool,
    /// The poses that it says are one.
    ends: [u32; 2],
    /// How far off the reader expects the path to be at the last iteration \[m\].
    pub prediction: Prediction,
    /// Whether the building is drawn as it is.
    pub truth: bool,
    /// The iteration asked for.
    pub step: u32,
}

impl Default for Recipe {
    /// Before the first iteration, with wheels that leave a ring to be seen. The false edge would tie the corridor below the block to the
    /// one above it.
    fn default() -> Self {
        let ends = FALSE_EDGE.map(|pose| pose as u32);
        Self {
            asked: GraphSetup::opening(),
            wrong: false,
            ends,
            prediction: Prediction::default(),
            truth: true,
            step: 0,
        }
    }
}

impl Recipe {
    /// What decides the numbers.
    pub fn setup(&self) -> GraphSetup {
        let last = self.asked.lap.course.steps() as u32;
        let [i, j] = self.ends.map(|end| end.min(last) as usize);
        // An edge from a pose to itself would be none.
        let ends = if i != j {
            [i, j]
        } else if j > 0 {
            [j - 1, j]
        } else {
            [0, 1]
        };
        GraphSetup { wrong: self.wrong.then_some(ends), ..self.asked.clone() }
    }

    /// Whether there is a false edge.
    pub fn wrong(&self) -> bool {
        self.wrong
    }

    /// Puts an end of the false edge to a pose; never onto its other end.
    pub fn put_end(&mut self, end: usize, pose: u32) {
        if self.ends[1 - end] != pose {
            self.ends[end] = pose;
        }
    }

    /// The poses at the ends of the false edge.
    pub fn ends(&self) -> [u32; 2] {
        let last = self.asked.lap.course.steps() as u32;
        self.ends.map(|end| end.min(last))
    }
}

predicts!(Recipe);

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let [predict, guess, run] = prediction::rows(Asks {
            predict_help: graph::predict_help(),
            guess_help: graph::guess_help(),
            unit: "m",
            range: (GUESSES[0], GUESSES[1], 0.01),
            run: [graph::run(), graph::run_help()],
        });
        let repairs = Menu::new([
            ("squares", graph::least_squares(), Repair::LeastSquares),
            ("robust", graph::robust(), Repair::CAUCHY),
            ("switchable", graph::switchable(), Repair::SWITCHABLE),
            ("mixture", graph::mixture(), Repair::MAX_MIXTURE),
        ]);
        let starts = Menu::new([
            ("wheels", graph::start_wheels(), Start::Wheels),
            ("matches", graph::start_matches(), Start::Matches),
        ]);
        const FROM: Field<Recipe, u32> = field!(ends[0]);
        const TO: Field<Recipe, u32> = field!(ends[1]);
        let end = |name, title, field: Field<Recipe, u32>| {
            P::integer(name, title, "", (0, STEPS as u32), field, graph::end_help())
                .at_most(|recipe| recipe.asked.lap.course.steps() as f64)
                .folded()
        };
        vec![
            P::choice("repair", graph::repair(), repairs, field!(asked.repair), graph::repair_help()),
            P::toggle("wrong", graph::wrong(), field!(wrong), graph::wrong_help()).in_sight(),
            P::number(
                "odometry",
                common::odometry_noise(),
                "×",
                (0.0, 2.0, 0.05),
                field!(asked.lap.odometry_scale),
                graph::odometry_help(),
            )
            .in_sight(),
            P::seed(field!(asked.lap.seed), graph::seed_help()),
            P::choice(
                "course",
                graph::course(),
                Menu::of(Course::Ring, names::course),
                field!(asked.lap.course),
                graph::course_help(),
            ),
            P::choice("start", graph::start(), starts, field!(asked.start), graph::start_help()),
            P::flag("loops", graph::loops(), field!(asked.loops), graph::loops_help()).folded(),
            P::integer(
                "universes",
                common::universes(),
                "",
                (1, 64),
                field!(asked.lap.particles),
                common::universes_help(),
            )
            .folded(),
            P::number(
                "range-std",
                common::range_noise(),
                "m",
                (0.0, 0.2, 0.01),
                field!(asked.lap.range_std),
                graph::range_help(),
            )
            .folded(),
            end("wrong-from", graph::from(), FROM),
            end("wrong-to", graph::to(), TO),
            predict,
            guess,
            run,
            P::flag("truth", graph::truth(), field!(truth), graph::truth_help()).view().folded(),
            P::integer("step", graph::iteration_name(), "", (0, END), field!(step), graph::iteration_help()).view(),
        ]
    }

    /// Another graph is another question. Who has answered it sees the last iteration.
    fn follow(&mut self, before: &Self) {
        if self.setup() != before.setup() && self.prediction == before.prediction {
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
    fn a_false_edge_has_two_ends_on_every_course() {
        let mut recipe = Recipe { wrong: true, ..Recipe::default() };
        assert_eq!(recipe.setup().wrong, Some([14, 52]));
        for (ends, wrong) in [([110, 100], [90, 89]), ([0, 0], [0, 1]), ([7, 7], [6, 7])] {
            recipe.ends = ends;
            recipe.asked.lap.course = Course::Apartment;
            let [i, j] = recipe.setup().wrong.unwrap();
            assert!(i != j && i <= 90 && j <= 90, "{ends:?}");
            if ends[0] == ends[1] {
                assert_eq!([i, j], wrong);
            }
            assert!(recipe.setup().validate().is_ok());
        }
        recipe.put_end(0, 7);
        assert_eq!(recipe.ends, [7, 7], "where it is already");
        recipe.put_end(1, 9);
        assert_eq!(recipe.ends(), [7, 9]);
    }
}
