//! What is to be seen: shares over M with the rule beside them, and the depletion below.

use super::{
    depletion::depletion,
    guess::{GUESS, GUESS_AWARE, GUESS_FLOOR, MIDDLE, guesses, within},
    layout::Layout,
    model::UniversesModel,
    recipe::nearest,
    share::{self, UNIVERSES, cursor, rule, share},
};
use crate::{
    model::Declared,
    scene::{Point, Rect, Scene},
    view::{View, whole_step},
};
use fastslam_lab::experiment::universes::TRIED;

/// The figure *how many are enough*, as it is seen.
#[derive(Default)]
pub struct UniversesView;

impl View for UniversesView {
    type Model = UniversesModel;
    type Layout = Layout;

    fn gist(_model: &UniversesModel, layout: &Layout, width: f64) -> Rect {
        let part = [&layout.share, &layout.rule, &layout.depletion].into_iter().find(|part| part.is_shown());
        part.map_or(Rect::new(0.0, 0.0, width, layout.height), |part| {
            Rect::new(0.0, part.header.y, width, part.ticks.bottom() - part.header.y)
        })
    }

    fn draw(&self, model: &UniversesModel, layout: &Layout, scene: &mut Scene) {
        let mut taken = Vec::new();
        if layout.share.is_shown() {
            share(scene, model, &layout.share, &mut taken);
        }
        if layout.rule.is_shown() {
            rule(scene, model, layout, &mut taken);
        }
        if layout.share.is_shown() && !model.hides() {
            cursor(scene, model, &layout.share);
        }
        if layout.depletion.is_shown() {
            depletion(scene, model, &layout.depletion, &mut taken);
        }
        guesses(scene, model, layout, &mut taken);
    }

    fn drag(&self, model: &mut UniversesModel, layout: &Layout, handle: &str, to: Point) {
        let universes = share::universes(&layout.share.area, to[0]);
        let area = layout.depletion.area;
        let percent = (100.0 * ((area.bottom() - to[1]) / area.h).clamp(0.0, 1.0)).round();
        if !universes.is_finite() || !percent.is_finite() {
            return;
        }
        model.change(|recipe| match handle {
            UNIVERSES => recipe.universes = TRIED[nearest(universes)] as u32,
            GUESS => recipe.prediction.place(Some(within(universes))),
            GUESS_AWARE => recipe.guess_aware = Some(within(universes)),
            GUESS_FLOOR => recipe.guess_floor = Some(percent),
            _ => (),
        });
    }

    fn nudge(&self, model: &mut UniversesModel, handle: &str, [right, up]: [f64; 2]) {
        let by = whole_step(right + up);
        if !by.is_finite() {
            return;
        }
        let from = |guess: Option<f64>, middle: f64| guess.unwrap_or(middle) + by;
        model.change(|recipe| match handle {
            UNIVERSES => {
                let rank = (recipe.rank() as f64 + by).clamp(0.0, (TRIED.len() - 1) as f64);
                recipe.universes = TRIED[rank as usize] as u32;
            }
            GUESS => recipe.prediction.place(Some(within(from(recipe.prediction.guess, MIDDLE[0])))),
            GUESS_AWARE => recipe.guess_aware = Some(within(from(recipe.guess_aware, MIDDLE[1]))),
            GUESS_FLOOR => recipe.guess_floor = Some(from(recipe.guess_floor, MIDDLE[2]).clamp(0.0, 100.0)),
            _ => (),
        });
    }
}
