//! A lens over a map, for what is too small there to be told apart.

use super::{Letters, Plane, Rect, Role, Scene, clip_polyline, closed, strong};
use crate::decimal;

/// How many times larger it shows what is below it, and how far it is from the map's edges \[css px\].
const MAGNIFIED: f64 = 8.0;
/// See [`MAGNIFIED`].
const INSET: f64 = 6.0;

/// How it tells that.
const TIMES: Letters = strong(11.0, Role::Ink).middle();

/// The place \[m\] as large as can be seen, in the map's upper corner that is farther away; there, `draw` draws what is looked at.
pub fn lens(scene: &mut Scene, map: &Plane, place: [f64; 2], draw: &mut dyn FnMut(&mut Scene, Plane)) {
    let (all, [x, y]) = (map.area, map.point(place));
    let side = (0.44 * all.h).min(0.47 * all.w).min(110.0).floor();
    let left = if x < all.centre()[0] { all.right() - side - INSET } else { all.x + INSET };
    let area = Rect::new(left, all.y + INSET, side, side);
    let small = 0.5 * side / MAGNIFIED;
    let seen = [[x - small, y - small], [x + small, y - small], [x + small, y + small], [x - small, y + small]];
    scene.lines(clip_polyline(&closed(seen.to_vec()), &all), 1.0, Role::Ink);
    scene.fill(area, Role::Paper);
    draw(scene, Plane::centred(area, place, MAGNIFIED * map.scale));
    scene.frame(area, 1.5, Role::Ink);
    let label = format!("× {}", decimal::write(MAGNIFIED));
    let plate = Rect::new(area.x + 2.0, area.bottom() - 16.0, TIMES.width(&label) + 4.0, 14.0);
    scene.fill(plate, Role::Paper);
    scene.text(plate, TIMES, &label);
}
