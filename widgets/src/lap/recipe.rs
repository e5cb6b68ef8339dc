//! What a reader can set about the lap.

use crate::{
    field,
    model::FigureError,
    names,
    param::quoted,
    policy,
    recipe::{self, Field, Menu, Param},
    words::{common, lap},
};
use fastslam::resampling::ResamplePolicy;
use fastslam_lab::{
    experiment::lap::LapSetup,
    world::{EditError, Edits, MOST_LIFTS, MOST_STEPS, MOST_WALLS, Steering, WallEdits},
};

/// Everything that a link can say of the lap.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers.
    pub setup: LapSetup,
    /// Of the policy "N_eff below", kept while another policy is chosen.
    pub threshold: f64,
    /// The step asked for.
    pub step: u32,
    /// The universe chosen for the large view; `None` is the best.
    pub universe: Option<u32>,
    /// Whether the large view shows all universes at once, unless one is chosen.
    pub overlay: bool,
    /// Whether the truth is drawn.
    pub truth: bool,
    /// Whether raw odometry is drawn.
    pub raw: bool,
}

impl Default for Recipe {
    fn default() -> Self {
        let setup = LapSetup::opening();
        let threshold = policy::threshold(setup.policy);
        Self { setup, threshold, step: 0, universe: None, overlay: true, truth: false, raw: false }
    }
}

const WALLS: Field<Recipe, WallEdits> =
    Field { get: |recipe| recipe.setup.edits.walls.clone(), set: |recipe, walls| recipe.setup.edits.walls = walls };

const DRIVE: Field<Recipe, Steering> = Field {
    get: |recipe| recipe.setup.edits.steering.clone(),
    set: |recipe, steering| recipe.setup.edits.steering = steering,
};

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let [policy, threshold] = policy::rows();
        let usual = LapSetup::opening();
        vec![
            P::integer(
                "universes",
                common::universes(),
                "",
                (1, 256),
                field!(setup.particles),
                common::universes_help(),
            )
            .in_sight(),
            P::seed(field!(setup.seed), lap::seed_help()),
            P::number(
                "odometry",
                common::odometry_noise(),
                "×",
                (0.0, 2.0, 0.05),
                field!(setup.odometry_scale),
                lap::odometry_help(),
            )
            .in_sight(),
            P::number(
                "range-std",
                common::range_noise(),
                "m",
                (0.01, 0.3, 0.01),
                field!(setup.range_std),
                lap::range_help(),
            ),
            P::choice(
                "proposal",
                lap::proposal(),
                Menu::of(usual.proposal, names::proposal),
                field!(setup.proposal),
                lap::proposal_help(),
            ),
            P::choice(
                "weight",
                lap::what_is_paid(),
                Menu::of(usual.weight, names::weight),
                field!(setup.weight),
                lap::what_is_paid_help(),
            )
            .folded(),
            P::choice(
                "matcher",
                lap::matcher(),
                Menu::of(usual.matcher, names::matcher),
                field!(setup.matcher),
                lap::matcher_help(),
            )
            .folded(),
            policy,
            threshold,
            P::choice(
                "scheme",
                common::scheme(),
                Menu::of(usual.scheme, names::scheme),
                field!(setup.scheme),
                lap::scheme_help(),
            )
            .folded(),
            P::number("temper", lap::temper(), "", (0.05, 1.0, 0.05), field!(setup.temper), lap::temper_help())
                .folded(),
            P::flag("guard", lap::guard(), field!(setup.guard), lap::guard_help()).folded(),
            P::choice(
                "course",
                lap::course(),
                Menu::of(usual.course, names::course),
                field!(setup.course),
                lap::course_help(),
            )
            .folded(),
            P::text("plan", lap::plan(), WALLS, allowed, lap::plan_help()),
            P::text("drive", lap::drive(), DRIVE, allowed, lap::drive_help()),
            P::integer("step", common::step(), "", (0, 0), field!(step), common::step_help())
                .at_most(|recipe| recipe.setup.edits.steering.steps(recipe.setup.course.steps()) as f64)
                .view(),
            P::integer_or(
                "universe",
                lap::universe(),
                ("best", lap::universe_best()),
                |recipe| recipe.setup.particles as f64 - 1.0,
                field!(universe),
                lap::universe_help(),
            )
            .view()
            .folded(),
            P::flag("overlay", lap::overlay(), field!(overlay), lap::overlay_help()).view(),
            P::flag("truth", lap::truth(), field!(truth), lap::truth_help()).view(),
            P::flag("raw", common::raw_odometry(), field!(raw), common::raw_odometry_help()).view(),
        ]
    }

    /// One is seen alone, or all at once: who chooses one sees it, and who asks for all lets go of it.
    fn follow(&mut self, before: &Self) {
        if self.universe.is_some() && self.universe != before.universe {
            self.overlay = false;
        } else if self.overlay && !before.overlay {
            self.universe = None;
        }
    }

    /// Walls and a drive are of one place: they go with it, and what does not fit into it is refused.
    fn refuse(&mut self, before: &Self) -> Vec<FigureError> {
        if self.setup.course != before.setup.course && self.setup.edits == before.setup.edits {
            self.setup.edits = Edits::default();
        }
        let mut refused = Vec::new();
        if self.setup.edits == Edits::default() {
            return refused;
        }
        let route = self.setup.course.route();
        while let Err((field, error)) = self.setup.edits.fit(&route.plan, route.steps) {
            let edits = &mut self.setup.edits;
            let text = if field == "plan" {
                core::mem::take(&mut edits.walls).to_string()
            } else {
                core::mem::take(&mut edits.steering).to_string()
            };
            refused.push(FigureError::new(field, quoted(&text), allowed(error)));
        }
        refused
    }
}

impl policy::Chosen for Recipe {
    fn chosen(&self) -> (ResamplePolicy, f64) {
        (self.setup.policy, self.threshold)
    }

    fn choose(&mut self, policy: ResamplePolicy, threshold: f64) {
        (self.setup.policy, self.threshold) = (policy, threshold);
    }
}

/// What a text of walls or of a drive must be.
pub fn allowed(error: EditError) -> String {
    match error {
        EditError::Version => lap::edit_version().into(),
        EditError::Long | EditError::Garbled => lap::edit_garbled().into(),
        EditError::Many => lap::EditMany { walls: &MOST_WALLS, steps: &MOST_STEPS, lifts: &MOST_LIFTS }.say(),
        EditError::Outside => lap::edit_outside().into(),
    }
}
