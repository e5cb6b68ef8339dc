//! Marks of one point, and lines and clouds of many, that stand out from what is below them.

use super::{Point, Rect, Role, Scene};

/// Width of the paper-coloured rim that lifts a line off what is below it \[css px\], on each side.
pub const RIM: f64 = 1.25;

/// The corners of a diamond, from its middle to a corner so long \[css px\].
pub fn diamond([x, y]: Point, r: f64) -> Vec<Point> {
    vec![[x - r, y], [x, y - r], [x + r, y], [x, y + r]]
}

impl Scene {
    /// Discs of one kind about all points that lie in an area.
    pub fn cloud(&mut self, points: impl Iterator<Item = Point>, area: &Rect, radius: f64, role: Role) {
        self.discs(points.filter(|point| area.contains(*point)).collect(), radius, role);
    }

    /// Lines with a rim, so that they are seen on anything.
    pub fn rimmed(&mut self, lines: Vec<Vec<Point>>, width: f64, dash: Option<[f64; 2]>, role: Role) {
        self.lines(lines.clone(), width + 2.0 * RIM, Role::Paper);
        self.strokes(lines, width, dash, role);
    }

    /// A polygon with a rim.
    pub fn rimmed_polygon(&mut self, corners: Vec<Point>, role: Role) {
        // On to the second corner, so that it is joined at the first as at every other.
        let outline: Vec<_> = corners.iter().chain(corners.iter().take(2)).copied().collect();
        self.line(&outline, 2.0 * RIM, Role::Paper);
        self.polygon(corners, role);
    }
}
