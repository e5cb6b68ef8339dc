//! The map: a bar for each cell, as long as the sensor says *door* there often; and what it is to be.

use super::{layout::Layout, model::EmModel, strips};
use crate::{
    font::{self, Weight},
    scene::{Anchor, Mark, Point, Rect, Role, Scene, text},
    words::em as words,
};
use fastslam_lab::experiment::em::{CORRIDOR, DOORS, LENGTH};

/// Draws all of it.
pub fn map(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let area = layout.map.area;
    let n = &model.doors().len();
    let wordings = [words::MapOf { n, all: &DOORS }.say(), words::MapShort { n }.say(), words::MapCount { n }.say()];
    let fits = |wording: &&String| font::measure(wording, 12.5, Weight::SemiBold) <= layout.map.header.w;
    let wording = wordings.iter().find(fits).unwrap_or(&wordings[2]).clone();
    scene.marks.push(text(layout.map.header, Anchor::Start, 12.5, Weight::SemiBold, Role::Ink, wording));
    let height = area.h * CORRIDOR.cell_size / LENGTH;
    for (cell, door) in model.shown().map.iter().enumerate() {
        let top = area.bottom() - height * (cell + 1) as f64;
        let bar = Rect::new(area.x, top + 0.25, (area.w * door).max(0.5), height - 0.5);
        let role = if *door > 0.5 { Role::Posterior } else { Role::Weight(0) };
        scene.marks.push(Mark::Fill { area: bar, role });
    }
    let corner = |(cell, door): (usize, f64)| -> [Point; 2] {
        [0, 1].map(|edge| [area.x + area.w * door, area.bottom() - height * (cell + edge) as f64])
    };
    let truth = model.log().setup().true_map().into_iter().enumerate().flat_map(corner).collect();
    scene.marks.push(Mark::Lines { lines: vec![truth], width: 1.25, dash: None, role: Role::Truth });
    scene.marks.push(Mark::Frame { area, width: 1.0, role: Role::Frame });
    // How often, below.
    let below = Rect { x: area.x, w: area.w, ..layout.times };
    scene.marks.push(text(below, Anchor::Start, strips::SIZE, Weight::Regular, Role::Truth, words::truth()));
    scene.marks.push(text(below, Anchor::End, strips::SIZE, Weight::Regular, Role::Muted, "100 %"));
}
