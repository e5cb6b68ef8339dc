//! How long a metre is in the picture.

use super::{Anchor, Mark, Plane, Rect, Role, Scene, text};
use crate::decimal::write;
use crate::font::{self, Weight};

/// A bar from a point to the right \[css px\], with its ends turned up.
pub fn bar([x, y]: [f64; 2], length: f64) -> Mark {
    let lines = vec![vec![[x, y - 3.0], [x, y], [x + length, y], [x + length, y - 3.0]]];
    Mark::Lines { lines, width: 1.0, dash: None, role: Role::Ink }
}

/// A bar of so many metres on a plate, in the lower right corner.
pub fn scale_bar(scene: &mut Scene, plane: &Plane, metres: f64, most: f64) {
    let length = (metres * plane.scale).min(most);
    let label = format!("{} m", write(metres));
    let width = length.max(font::measure(&label, 9.5, Weight::Regular)) + 8.0;
    let (right, y) = (plane.area.right() - 10.0, plane.area.bottom() - 8.0);
    let plate = Rect::new(right + 4.0 - width, y - 13.0, width, 17.0);
    scene.marks.push(Mark::Fill { area: plate, role: Role::Paper });
    scene.marks.push(bar([right - length, y], length));
    let area = Rect::new(plate.x, plate.y, plate.w, 12.0);
    scene.marks.push(text(area, Anchor::Middle, 9.5, Weight::Regular, Role::Ink, label));
}
