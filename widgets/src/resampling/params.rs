//! What a reader can set about the three filters.

use crate::{
    model::{Choice, FigureError, ParamSpec},
    param::Value,
};
use fastslam::resampling::Scheme;
use fastslam_lab::experiment::policies::{PoliciesSetup, PolicyCourse};

/// How far back the second lineage gauge looks at first.
pub const BACK: u32 = 10;

/// What a reader set.
#[derive(Clone, PartialEq, Debug)]
pub struct Asked {
    setup: PoliciesSetup,
    /// `None` is the usual one of the course.
    scheme: Option<Scheme>,
}

impl Default for Asked {
    /// With this seed the second filter loses the right wing and the others keep it: what is more often so than not is for the count
    /// over many seeds to say.
    fn default() -> Self {
        Self { setup: PoliciesSetup { seed: 2, ..PoliciesSetup::default() }, scheme: None }
    }
}

impl Asked {
    /// Sets one value of the setup.
    ///
    /// # Errors
    /// None for a value that its parameter has checked.
    pub fn set(&mut self, name: &str, value: Value) -> Result<(), FigureError> {
        let setup = &mut self.setup;
        match (name, value) {
            ("wings", Value::Flag(on)) => setup.course = if on { PolicyCourse::Wings } else { PolicyCourse::Lap },
            ("particles", Value::Number(x)) => setup.particles = x as usize,
            ("seed", Value::Number(x)) => setup.seed = x as u64,
            ("threshold", Value::Number(x)) => setup.threshold = x,
            ("odometry", Value::Number(x)) => setup.odometry_scale = x,
            ("range", Value::Number(x)) => setup.sensor_scale = x,
            ("scheme", Value::Word(USUAL)) => self.scheme = None,
            ("scheme", Value::Word(word)) => self.scheme = Some(word.parse()?),
            _ => (),
        }
        Ok(())
    }

    /// The scheme as the menu has it.
    pub fn scheme(&self) -> String {
        self.scheme.map_or(USUAL.into(), |scheme| scheme.to_string())
    }

    /// The filters' setup on a course.
    pub fn on(&self, course: PolicyCourse) -> PoliciesSetup {
        let scheme = self.scheme.unwrap_or(PoliciesSetup::of(course).scheme);
        PoliciesSetup { course, scheme, ..self.setup.clone() }
    }

    /// The filters' setup.
    pub fn setup(&self) -> PoliciesSetup {
        self.on(self.setup.course)
    }
}

/// The scheme that [`PoliciesSetup::of`] has for the course.
pub const USUAL: &str = "usual";

const SCHEMES: &[Choice] = &[
    Choice { value: USUAL, title: "usual for the course" },
    Choice { value: "systematic", title: "systematic" },
    Choice { value: "stratified", title: "stratified" },
    Choice { value: "multinomial", title: "multinomial" },
    Choice { value: "residual", title: "residual" },
];

const NOW: &[Choice] = &[Choice { value: "now", title: "the newest" }];

/// All parameters, for a course of so many steps.
pub fn specs(steps: u32) -> Vec<ParamSpec> {
    let PoliciesSetup { particles, seed, threshold, odometry_scale, sensor_scale, .. } = Asked::default().setup;
    vec![
        ParamSpec::toggle(
            "wings",
            "Loop of ambiguity",
            false,
            "Drives into one of two wings that look the same, instead of round the apartment: the evidence comes late.",
        ),
        ParamSpec::integer(
            "particles",
            "Particles M",
            "",
            (4, 64),
            particles as i64,
            "How many particles each filter has.",
        ),
        ParamSpec::integer(
            "seed",
            "Seed",
            "",
            (0, u32::MAX.into()),
            seed as i64,
            "Picks the noise of the world and of the filters; all three filters have the same.",
        ),
        ParamSpec::number(
            "threshold",
            "Threshold",
            "of M",
            (0.0, 1.0, 0.05),
            threshold,
            "Share of M below which N_eff calls for resampling in the selective filter.",
        ),
        ParamSpec::number(
            "odometry",
            "Odometry noise σ",
            "× α",
            (0.0, 2.0, 0.05),
            odometry_scale,
            "Factor on the standard deviations of the odometry’s noise, in the world and in what the filters expect.",
        ),
        ParamSpec::number(
            "range",
            "Range noise σ",
            "× σ",
            (0.25, 4.0, 0.05),
            sensor_scale,
            "Factor on the standard deviations of the sensor’s noise, in the world and in what the filters expect.",
        ),
        ParamSpec::choice(
            "scheme",
            "Scheme",
            SCHEMES,
            USUAL,
            "How the survivors are drawn. Usual is systematic round the apartment, and multinomial in the loop of ambiguity, where systematic resampling would copy nearly every particle once.",
        ),
        ParamSpec::integer(
            "back",
            "Second gauge looks back",
            "steps",
            (1, 60),
            BACK.into(),
            "How many steps back the second lineage gauge counts distinct ancestors.",
        )
        .without_slider()
        .view(),
        ParamSpec::integer("step", "Step", "", (0, steps.into()), 0, "The step shown.").view(),
        ParamSpec::integer(
            "cursor",
            "Step read",
            "",
            (-1, steps.into()),
            -1,
            "The step whose values are written beside the curves; now, or −1, is the one shown.",
        )
        .or_words(NOW)
        .view(),
    ]
}
