//! The map: a bar for each cell, as long as the sensor says *door* there often; and what it is to be.

use super::{layout::Layout, model::EmModel, strips};
use crate::{
    scene::{Point, Rect, Role, Scene, plain, strong},
    words::em as words,
};
use fastslam_lab::experiment::em::{CORRIDOR, DOORS, LENGTH};

/// Draws all of it.
pub fn map(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let area = layout.map.area;
    let n = &model.doors().len();
    let wordings = [words::MapOf { n, all: &DOORS }.say(), words::MapShort { n }.say(), words::MapCount { n }.say()];
    scene.fit(layout.map.header, strong(12.5, Role::Ink), &wordings);
    let height = area.h * CORRIDOR.cell_size / LENGTH;
    for (cell, door) in model.shown().map.iter().enumerate() {
        let top = area.bottom() - height * (cell + 1) as f64;
        let bar = Rect::new(area.x, top + 0.25, (area.w * door).max(0.5), height - 0.5);
        scene.fill(bar, if *door > 0.5 { Role::Posterior } else { Role::Weight(0) });
    }
    let corner = |(cell, door): (usize, f64)| -> [Point; 2] {
        [0, 1].map(|edge| [area.x + area.w * door, area.bottom() - height * (cell + edge) as f64])
    };
    let truth: Vec<Point> = model.log().setup().true_map().into_iter().enumerate().flat_map(corner).collect();
    scene.line(&truth, 1.25, Role::Truth);
    scene.frame(area, 1.0, Role::Frame);
    // How often, below.
    let below = Rect { x: area.x, w: area.w, ..layout.times };
    scene.text(below, plain(strips::SIZE, Role::Truth), words::truth());
    scene.text(below, plain(strips::SIZE, Role::Muted).end(), "100 %");
}
