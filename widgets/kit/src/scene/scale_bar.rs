//! How long a metre is in the picture.

use super::{Letters, Plane, Point, Rect, Role, Scene, plain};
use crate::decimal::write;

/// Letters of the length.
const LENGTH: Letters = plain(9.5, Role::Ink).middle();

impl Scene {
    /// A bar from a point to the right \[css px\], with its ends turned up.
    pub fn bar(&mut self, [x, y]: Point, length: f64) {
        self.line(&[[x, y - 3.0], [x, y], [x + length, y], [x + length, y - 3.0]], 1.0, Role::Ink);
    }

    /// A bar of so many metres on a plate, in the lower right corner.
    pub fn scale_bar(&mut self, plane: &Plane, metres: f64, most: f64) {
        let length = (metres * plane.scale).min(most);
        let label = format!("{} m", write(metres));
        let width = length.max(LENGTH.width(&label)) + 8.0;
        let (right, y) = (plane.area.right() - 10.0, plane.area.bottom() - 8.0);
        let plate = Rect::new(right + 4.0 - width, y - 13.0, width, 17.0);
        self.fill(plate, Role::Paper);
        self.bar([right - length, y], length);
        self.text(Rect { h: 12.0, ..plate }, LENGTH, &label);
    }
}
