//! What is to be seen of the step: both clouds on the posterior, the world they are in, and what they are worth.

use super::{
    gauge,
    knob::{Noise, Track},
    layout::{AWARE, Layout, MOTION, RATIO},
    model::ProposalModel,
    names::names,
    panel::{Drawn, panel},
    recipe::RATIOS,
    strip::{GUESS, ratio},
    world::{LANDMARK, world},
};
use crate::{
    decimal::rounded,
    model::Declared,
    scene::{Point, Rect, Role, Scene},
    view::View,
    words::proposal,
};

/// What an arrow key moves the landmark by \[m\].
const STEP: f64 = 0.05;

/// Figure w17.3, as it is seen.
#[derive(Default)]
pub struct ProposalView;

impl View for ProposalView {
    type Model = ProposalModel;
    type Layout = Layout;

    fn gist(_model: &ProposalModel, layout: &Layout, width: f64) -> Rect {
        let views = || layout.panels.iter().map(|panel| panel.view).filter(|view| view.h > 0.0);
        let Some(first) = views().next() else { return Rect::new(0.0, 0.0, width, layout.height) };
        let [right, bottom] = [Rect::right, Rect::bottom].map(|end| views().map(|view| end(&view)).fold(0.0, f64::max));
        Rect::new(first.x, first.y, right - first.x, bottom - first.y)
    }

    fn draw(&self, model: &ProposalModel, layout: &Layout, scene: &mut Scene) {
        let found = model.proposals();
        let noises = |panel: usize| Noise::ALL.into_iter().filter(|noise| panel_of(*noise, layout) == panel).collect();
        let proposals = [
            Drawn {
                name: "FastSLAM 1.0",
                what: [proposal::motion_prior(), proposal::motion_prior_short()],
                cloud: &found.motion,
                role: Role::Prior,
                noises: noises(0),
            },
            Drawn {
                name: "FastSLAM 2.0",
                what: [proposal::aware(), proposal::aware_short()],
                cloud: &found.aware,
                role: Role::Posterior,
                noises: noises(1),
            },
        ];
        for (place, drawn) in layout.panels.iter().zip(proposals).filter(|(place, _)| place.view.h > 0.0) {
            panel(scene, model, place, &drawn);
        }
        if layout.shown.has(MOTION) || layout.shown.has(AWARE) {
            world(scene, model, layout);
            names(scene, model, layout);
        }
        if layout.shown.has(RATIO) {
            ratio(scene, model, layout);
        }
    }

    fn drag(&self, model: &mut ProposalModel, layout: &Layout, handle: &str, to: Point) {
        match (handle, noise(handle)) {
            (_, Some(noise)) => {
                let view = &layout.panels[panel_of(noise, layout)].view;
                let value = Track::of(noise, model.proposals(), model.setup(), view).value(to);
                model.change(|recipe| noise.set(&mut recipe.setup, rounded(value, noise.step().1)));
            }
            (LANDMARK, _) => model.put_landmark(layout.world_plane().world(to).map(|c| rounded(c, 2))),
            (GUESS, _) => model.guess_at(rounded(gauge::ratio(&layout.axis, to[0]), 1)),
            _ => (),
        }
    }

    fn nudge(&self, model: &mut ProposalModel, handle: &str, [right, up]: [f64; 2]) {
        let setup = &model.recipe().shown();
        let ([x, y], guess) = (setup.landmark, model.recipe().prediction.guess.unwrap_or(RATIOS[0]));
        match (handle, noise(handle)) {
            (_, Some(noise)) => {
                let (step, digits) = noise.step();
                let value = rounded(noise.value(setup) + step * (right + up), digits + 1);
                model.change(|recipe| noise.set(&mut recipe.setup, value));
            }
            (LANDMARK, _) => model.put_landmark([x + STEP * right, y + STEP * up].map(|c| rounded(c, 3))),
            (GUESS, _) => model.guess_at(rounded(guess + 0.1 * (right + up), 2)),
            _ => (),
        }
    }
}

/// The noise that a handle sets.
fn noise(handle: &str) -> Option<Noise> {
    Noise::ALL.into_iter().find(|noise| noise.name() == handle)
}

/// Which panel a noise is set in: that of the wheels where only they have a say, that of the sensor where it has, if they are shown.
fn panel_of(noise: Noise, layout: &Layout) -> usize {
    match (layout.shown.has(MOTION), layout.shown.has(AWARE)) {
        (true, true) => usize::from(noise != Noise::Odometry),
        (motion, _) => usize::from(!motion),
    }
}
