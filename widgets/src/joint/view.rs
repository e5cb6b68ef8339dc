//! What is to be seen of the two filters: their estimates, their particles, and how N_eff falls.

use super::{
    chart::{LANDMARKS, chart, place},
    guess::{GUESS, MIDDLE},
    layout::{ESS, Layout, MAPS},
    model::JointModel,
    panel::{Drawn, panel},
};
use crate::{
    prediction::State,
    scene::{Point, Rect, Role, Scene, strong},
    view::{View, whole_step},
    words::joint,
};
use fastslam_lab::experiment::joint::{COMPUTED, MOST, SAMPLED};

/// The sampled map against the computed one, as it is seen.
#[derive(Default)]
pub struct JointView;

/// Colours of the sampled map, and of the computed one.
const ROLES: [Role; 2] = [Role::Prior, Role::Posterior];

impl View for JointView {
    type Model = JointModel;
    type Layout = Layout;

    fn gist(_model: &JointModel, layout: &Layout, width: f64) -> Rect {
        if !layout.shown.has(ESS) {
            return Rect::new(0.0, 0.0, width, layout.height);
        }
        Rect::new(0.0, layout.chart.y - 8.0, width, layout.axis.bottom() - layout.chart.y + 8.0)
    }

    fn draw(&self, model: &JointModel, layout: &Layout, scene: &mut Scene) {
        if layout.shown.has(MAPS) {
            let filters = [
                Drawn {
                    filter: SAMPLED,
                    name: joint::sampled(),
                    what: [joint::sampled_what(), joint::sampled_what_short()],
                    role: ROLES[0],
                },
                Drawn {
                    filter: COMPUTED,
                    name: joint::computed(),
                    what: [joint::computed_what(), joint::computed_what_short()],
                    role: ROLES[1],
                },
            ];
            for (place, drawn) in layout.panels.iter().zip(filters) {
                panel(scene, model, place, &drawn);
            }
            removed(scene, model, layout);
        }
        if layout.shown.has(ESS) {
            chart(scene, model, layout, ROLES);
        }
    }

    fn drag(&self, model: &mut JointModel, layout: &Layout, handle: &str, to: Point) {
        let Rect { x, w, .. } = place(layout).area;
        let landmarks = f64::from(MOST) * (to[0] - x) / w;
        match handle {
            LANDMARKS => model.look_after(landmarks),
            GUESS => model.guess_at(landmarks),
            _ => (),
        }
    }

    fn nudge(&self, model: &mut JointModel, handle: &str, [right, up]: [f64; 2]) {
        let by = whole_step(right + up);
        match (handle, model.state()) {
            (LANDMARKS, _) => model.look_after(f64::from(model.landmarks()) + by),
            (GUESS, State::Placed(guess)) => model.guess_at(guess + by),
            (GUESS, _) => model.guess_at(MIDDLE + by),
            _ => (),
        }
    }
}

/// The variance over the repeats: all of the sampled map's, and at its end what is left of it.
fn removed(scene: &mut Scene, model: &JointModel, layout: &Layout) {
    let [words, bar] = layout.removed;
    let wordings = match model.removed() {
        Some(share) => [joint::RemovedIs { share: &share }.say(), joint::RemovedShort { share: &share }.say()],
        None if model.hides(SAMPLED) => [joint::removed_hidden().to_string(), joint::removed_hidden().into()],
        None => [joint::removed_soon().to_string(), joint::removed_soon().into()],
    };
    scene.fit(words, strong(13.0, Role::Ink), &wordings);
    let share = model.filters().removed(model.landmarks());
    if share.is_finite() && !model.hides(SAMPLED) {
        let left = (bar.w * (1.0 - share).clamp(0.0, 1.0)).max(2.0);
        scene.fill(bar, ROLES[0]);
        scene.fill(Rect { w: left, ..bar }, ROLES[1]);
    }
}
