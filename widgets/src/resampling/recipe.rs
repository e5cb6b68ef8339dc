//! What a reader can set about the three filters.

use super::stroke;
use crate::{
    field, names,
    prediction::{self, Asks, Prediction, predicts},
    recipe::{self, Field, Menu, Param},
    words::{common, policy, resampling},
};
use fastslam::resampling::Scheme;
use fastslam_lab::{
    experiment::{
        lap::STEPS,
        resampling::{POLICIES, PoliciesSetup, PolicyCourse},
    },
    world::Field as Landmarks,
};

/// Index of the selective filter among [`POLICIES`].
pub const SELECTIVE: usize = 2;

/// Everything that a link can say of the three filters.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers, but for the scheme.
    asked: PoliciesSetup,
    /// How to resample; `None` is the usual scheme of the course.
    scheme: Option<Scheme>,
    /// The policy whose tree is shown, by its index.
    pub policy: usize,
    /// Steps back of the second lineage gauge.
    pub back: u32,
    /// The step at which the reader expects one ancestor to be left with that policy.
    pub prediction: Prediction,
    /// The step asked for.
    pub step: u32,
    /// The step whose values are written; `None` is the one shown.
    pub cursor: Option<u32>,
}

impl Default for Recipe {
    /// With this seed the second filter loses the right wing and the others keep it: what is more often so than not is for the count
    /// over many seeds to say.
    fn default() -> Self {
        let asked = PoliciesSetup { seed: 2, ..PoliciesSetup::default() };
        Self {
            asked,
            scheme: None,
            policy: SELECTIVE,
            prediction: Prediction::default(),
            back: 10,
            step: 0,
            cursor: None,
        }
    }
}

impl Recipe {
    /// The filters' setup on a course.
    pub fn on(&self, course: PolicyCourse) -> PoliciesSetup {
        let scheme = self.scheme.unwrap_or(PoliciesSetup::of(course).scheme);
        PoliciesSetup { course, scheme, ..self.asked.clone() }
    }

    /// The filters' setup.
    pub fn setup(&self) -> PoliciesSetup {
        self.on(self.asked.course)
    }

    /// Where N_eff calls for resampling in the selective filter \[share of M\].
    pub fn put_threshold(&mut self, threshold: f64) {
        self.asked.threshold = threshold;
    }

    /// The last step that may be seen: while a prediction is asked for, nothing of the run is.
    pub fn horizon(&self) -> u32 {
        if self.prediction.hides() { 0 } else { self.last_step() }
    }

    /// The last step of the course.
    pub fn last_step(&self) -> u32 {
        match self.asked.course {
            PolicyCourse::Lap => STEPS as u32,
            PolicyCourse::Wings => Landmarks::two_wings().controls.len() as u32,
        }
    }
}

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let schemes = Menu::of(PoliciesSetup::default().scheme, names::scheme);
        let policies = Menu::new([0, 1, 2].map(|policy| (POLICIES[policy], stroke::NAMES[policy](), policy)));
        let [predict, guess, run] = prediction::rows(Asks {
            predict_help: resampling::predict_help(),
            guess_help: resampling::guess_help(),
            unit: "",
            range: (1.0, 1.0, 1.0),
            run: [resampling::run(), resampling::run_help()],
        });
        vec![
            P::toggle(
                "wings",
                resampling::wings(),
                Field {
                    get: |recipe| recipe.asked.course == PolicyCourse::Wings,
                    set: |recipe, on| recipe.asked.course = if on { PolicyCourse::Wings } else { PolicyCourse::Lap },
                },
                resampling::wings_help(),
            ),
            P::integer(
                "particles",
                resampling::particles(),
                "",
                (4, 64),
                field!(asked.particles),
                resampling::particles_help(),
            )
            .in_sight(),
            P::seed(field!(asked.seed), resampling::seed_help()),
            P::number(
                "threshold",
                policy::threshold(),
                policy::of_m(),
                (0.0, 1.0, 0.05),
                field!(asked.threshold),
                resampling::threshold_help(),
            )
            .in_sight(),
            P::number(
                "odometry",
                common::odometry_noise(),
                "×",
                (0.0, 2.0, 0.05),
                field!(asked.odometry_scale),
                resampling::odometry_help(),
            ),
            P::number(
                "range",
                common::range_noise(),
                "×",
                (0.25, 4.0, 0.05),
                field!(asked.sensor_scale),
                resampling::range_help(),
            )
            .folded(),
            P::choice(
                "scheme",
                common::scheme(),
                schemes.after(("usual", resampling::usual(), None), Some),
                field!(scheme),
                resampling::scheme_help(),
            )
            .folded(),
            P::choice("policy", resampling::policy(), policies, field!(policy), resampling::policy_help()).view(),
            predict,
            guess.at_most(|recipe| recipe.last_step().into()),
            run,
            P::integer("back", resampling::back(), resampling::steps(), (1, 60), field!(back), resampling::back_help())
                .without_slider()
                .folded()
                .view(),
            P::integer("step", common::step(), "", (0, 0), field!(step), common::step_help())
                .at_most(|recipe| recipe.horizon().into())
                .view(),
            P::integer_or(
                "cursor",
                resampling::cursor(),
                ("now", resampling::newest()),
                |recipe| recipe.horizon().into(),
                field!(cursor),
                resampling::cursor_help(),
            )
            .folded()
            .view(),
        ]
    }
    /// Another run, or another policy, is another question. Who has answered it sees the whole run.
    fn follow(&mut self, before: &Self) {
        let asked = |recipe: &Self| (recipe.setup(), recipe.policy);
        if asked(self) != asked(before) && self.prediction == before.prediction {
            self.prediction.ask_anew();
        }
        if self.prediction.is_shown() && !before.prediction.is_shown() && self.step == before.step {
            self.step = self.last_step();
        }
        self.step = self.step.min(self.horizon());
    }
}

predicts!(Recipe);
