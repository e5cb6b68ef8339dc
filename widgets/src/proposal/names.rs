//! The legend.

use super::{
    layout::{AWARE, Layout, RATIO},
    model::ProposalModel,
};
use crate::{
    marks::{filled_diamond, pointer, ring},
    prediction::State,
    scene::{Cells, GHOST, Mark, Rect, Role, Sample, Scene, Shading, legend, robot},
    words::{common, proposal},
};

/// Names what is drawn.
pub fn names(scene: &mut Scene, model: &ProposalModel, layout: &Layout) {
    let line = |role, dash| Sample::line(role, 1.75, dash);
    let density = |place: &Rect| {
        let cells = Cells { columns: 3, shades: vec![90, 255, 90] };
        vec![Mark::Raster { area: *place, cells, shading: Shading::Density }]
    };
    let samples = |place: &Rect| {
        let [x, y] = place.centre();
        let dot = |(dx, role)| Mark::Discs { centres: vec![[x + dx, y]], radius: 1.8, role };
        [(-4.0, Role::Prior), (4.0, Role::Posterior)].map(dot).into()
    };
    let noise = |place: &Rect| {
        let (y, end) = (place.centre()[1], place.right() - 5.0);
        vec![
            Mark::Lines {
                lines: vec![vec![[place.x, y], [end - 5.0, y]]],
                width: 1.25,
                dash: None,
                role: Role::Accent,
            },
            ring([end, y], 4.0),
        ]
    };
    let robots = |place: &Rect| {
        let [x, y] = place.centre();
        let one = |(dx, role)| Mark::Polygons { polygons: vec![robot([x + dx, y], 0.0, 7.0)], role };
        [(-9.0, Role::Muted), (8.0, Role::Ink)].map(one).into()
    };
    let panels = |place: &Rect| {
        let Rect { x, y, w, h } = place.inset(1.5);
        let lines = vec![vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]]];
        vec![Mark::Lines { lines, width: 1.0, dash: Some([3.0, 2.0]), role: Role::Muted }]
    };
    let [aware, ratio] = [AWARE, RATIO].map(|name| layout.shown.has(name));
    let mut items =
        vec![(Sample::new(density), proposal::posterior()), (line(Role::Ink, None), proposal::its_region())];
    if aware {
        items.push((line(Role::Posterior, Some([5.0, 3.0])), proposal::gaussian()));
    }
    items.extend([
        (Sample::new(samples), proposal::samples_drawn()),
        (Sample::new(noise), proposal::noise()),
        (Sample::new(robots).wide(30.0), proposal::robots()),
    ]);
    // On a phone there is room for one of them, and the reader has just pinned a run.
    if model.pinned().is_empty() || layout.legend.w > 250.0 {
        items.push((Sample::new(panels), proposal::shown_above()));
    }
    if ratio && matches!(model.state(), State::Placed(_) | State::Guessed(_)) {
        items.push((Sample::at(|[x, y]| pointer([x, y + 6.0], 6.0)), proposal::guess_mark()));
    }
    if ratio && model.at_half().is_some() {
        items.push((Sample::at(|at| filled_diamond(at, 5.5, Role::Ink)), proposal::at_half()));
    }
    if !model.pinned().is_empty() {
        items.push((line(GHOST, None), common::pinned_mark()));
    }
    legend(scene, &layout.legend, items);
}
