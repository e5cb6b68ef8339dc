//! What a reader can set about the three filters.

use crate::{
    field, names,
    recipe::{self, Field, Menu, Param},
};
use fastslam::resampling::Scheme;
use fastslam_lab::{
    experiment::{
        lap::STEPS,
        policies::{PoliciesSetup, PolicyCourse},
    },
    world::Field as Landmarks,
};

/// Everything that a link can say of the three filters.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers, but for the scheme.
    asked: PoliciesSetup,
    /// How to resample; `None` is the usual scheme of the course.
    scheme: Option<Scheme>,
    /// Steps back of the second lineage gauge.
    pub back: u32,
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
        Self { asked, scheme: None, back: 10, step: 0, cursor: None }
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
        table()
    }
}

fn table() -> Vec<Param<Recipe>> {
    type P = Param<Recipe>;
    let schemes = Menu::of(PoliciesSetup::default().scheme, names::scheme);
    vec![
        P::toggle(
            "wings",
            "Loop of ambiguity",
            Field {
                get: |recipe| recipe.asked.course == PolicyCourse::Wings,
                set: |recipe, on| recipe.asked.course = if on { PolicyCourse::Wings } else { PolicyCourse::Lap },
            },
            "Drives into one of two wings that look the same, instead of round the apartment: the evidence comes late.",
        ),
        P::integer(
            "particles",
            "Particles M",
            "",
            (4, 64),
            field!(asked.particles),
            "How many particles each filter has.",
        ),
        P::seed(
            field!(asked.seed),
            "Picks the noise of the world and of the filters; all three filters have the same.",
        ),
        P::number(
            "threshold",
            "Threshold",
            "of M",
            (0.0, 1.0, 0.05),
            field!(asked.threshold),
            "Share of M below which N_eff calls for resampling in the selective filter.",
        ),
        P::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.0, 2.0, 0.05),
            field!(asked.odometry_scale),
            "Factor on the standard deviations of the odometry’s noise, in the world and in what the filters expect.",
        ),
        P::number(
            "range",
            "Range noise σ",
            "× σ",
            (0.25, 4.0, 0.05),
            field!(asked.sensor_scale),
            "Factor on the standard deviations of the sensor’s noise, in the world and in what the filters expect.",
        ),
        P::choice(
            "scheme",
            "Scheme",
            schemes.after(("usual", "usual for the course", None), Some),
            field!(scheme),
            "How the survivors are drawn. Usual is systematic round the apartment, and multinomial in the loop of ambiguity, where systematic resampling would copy nearly every particle once.",
        ),
        P::integer(
            "back",
            "Second gauge looks back",
            "steps",
            (1, 60),
            field!(back),
            "How many steps back the second lineage gauge counts distinct ancestors.",
        )
        .without_slider()
        .view(),
        P::integer("step", "Step", "", (0, 0), field!(step), "The step shown.")
            .at_most(|recipe| recipe.last_step().into())
            .view(),
        P::integer_or(
            "cursor",
            "Step read",
            ("now", "the newest"),
            |recipe| recipe.last_step().into(),
            field!(cursor),
            "The step whose values are written beside the curves; now, or −1, is the one shown.",
        )
        .view(),
    ]
}
