//! Marks of one point, and lines and clouds of many, that stand out from what is below them.

use super::{Mark, Plane, Point, Rect, Role, Scene};
use fastslam::geometry::Pose2;

/// Width of the paper-coloured rim that lifts a line off what is below it \[css px\], on each side.
pub const RIM: f64 = 1.25;

/// The corners of a diamond, from its middle to a corner so long \[css px\].
pub fn diamond([x, y]: Point, r: f64) -> Vec<Point> {
    vec![[x - r, y], [x, y - r], [x + r, y], [x, y + r]]
}

/// The lines of a cross that fills a rectangle.
pub fn cross(Rect { x, y, w, h }: Rect) -> Vec<Vec<Point>> {
    vec![vec![[x, y], [x + w, y + h]], vec![[x, y + h], [x + w, y]]]
}

/// Discs of one kind about all points that lie in an area.
pub fn cloud(points: impl Iterator<Item = Point>, area: &Rect, radius: f64, role: Role) -> Mark {
    Mark::Discs { centres: points.filter(|point| area.contains(*point)).collect(), radius, role }
}

/// Lines with a rim, so that they are seen on anything.
pub fn rimmed(scene: &mut Scene, lines: Vec<Vec<Point>>, width: f64, dash: Option<[f64; 2]>, role: Role) {
    let rim = Mark::Lines { lines: lines.clone(), width: width + 2.0 * RIM, dash: None, role: Role::Paper };
    scene.marks.extend([rim, Mark::Lines { lines, width, dash, role }]);
}

/// A polygon with a rim.
pub fn rimmed_polygon(scene: &mut Scene, corners: Vec<Point>, role: Role) {
    // On to the second corner, so that it is joined at the first as at every other.
    let outline = corners.iter().chain(corners.iter().take(2)).copied().collect();
    let rim = Mark::Lines { lines: vec![outline], width: 2.0 * RIM, dash: None, role: Role::Paper };
    scene.marks.extend([rim, Mark::Polygons { polygons: vec![corners], role }]);
}

/// A robot of this length \[css px\] with a rim; nothing where it is out of view.
pub fn rimmed_robot(scene: &mut Scene, plane: &Plane, pose: &Pose2, length: f64, role: Role) {
    if let Some(corners) = plane.robot(pose, length) {
        rimmed_polygon(scene, corners, role);
    }
}
