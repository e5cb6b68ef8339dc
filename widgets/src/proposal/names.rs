//! The legend.

use super::{
    layout::{AWARE, Layout, RATIO},
    model::ProposalModel,
};
use crate::{
    prediction::State,
    robot::robot,
    scene::{Cells, Point, Rect, Role, Sample, Scene, Shading, legend},
    words::{common, proposal},
};

/// Names what is drawn.
pub fn names(scene: &mut Scene, model: &ProposalModel, layout: &Layout) {
    let line = |role, dash| Sample::line(role, 1.75, dash);
    let density = |scene: &mut Scene, place: &Rect| {
        scene.raster(*place, Cells::row(&[90, 255, 90]), Shading::Density);
    };
    let samples = |scene: &mut Scene, [x, y]: Point| {
        scene.disc([x - 4.0, y], 1.8, Role::Prior);
        scene.disc([x + 4.0, y], 1.8, Role::Posterior);
    };
    let noise = |scene: &mut Scene, place: &Rect| {
        let (y, end) = (place.centre()[1], place.right() - 5.0);
        scene.line(&[[place.x, y], [end - 5.0, y]], 1.25, Role::Accent);
        scene.ring([end, y], 4.0);
    };
    let robots = |scene: &mut Scene, [x, y]: Point| {
        scene.polygon(robot([x - 9.0, y], 0.0, 7.0), Role::Muted);
        scene.polygon(robot([x + 8.0, y], 0.0, 7.0), Role::Ink);
    };
    let panels = |scene: &mut Scene, place: &Rect| {
        let Rect { x, y, w, h } = place.inset(1.5);
        scene.dash(&[[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]], 1.0, [3.0, 2.0], Role::Muted);
    };
    let [aware, ratio] = [AWARE, RATIO].map(|name| layout.shown.has(name));
    let mut items =
        vec![(Sample::new(density), proposal::posterior()), (line(Role::Ink, None), proposal::its_region())];
    if aware {
        items.push((line(Role::Posterior, Some([5.0, 3.0])), proposal::gaussian()));
    }
    items.extend([
        (Sample::at(samples), proposal::samples_drawn()),
        (Sample::new(noise), proposal::noise()),
        (Sample::at(robots).wide(30.0), proposal::robots()),
    ]);
    // On a phone there is room for one of them, and the reader has just pinned a run.
    if model.pinned().is_empty() || layout.legend.w > 250.0 {
        items.push((Sample::new(panels), proposal::shown_above()));
    }
    if ratio && matches!(model.state(), State::Placed(_) | State::Guessed(_)) {
        items.push((Sample::at(|scene, [x, y]| scene.pointer([x, y + 6.0], 6.0)), proposal::guess_mark()));
    }
    if ratio && model.at_half().is_some() {
        items.push((Sample::at(|scene, at| scene.filled_diamond(at, 5.5, Role::Ink)), proposal::at_half()));
    }
    if !model.pinned().is_empty() {
        items.push((Sample::pinned(), common::pinned_mark()));
    }
    legend(scene, &layout.legend, items);
}
