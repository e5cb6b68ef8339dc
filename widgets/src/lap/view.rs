//! From the world to the figure: metres to css px, cells to shades.

use crate::scene::{Cells, Point, Rect, clip_polyline, robot, shade, thinned};
use fastslam::{
    geometry::Pose2,
    map::grid::{CellRect, Grid},
};

/// The cells shown: the apartment, [0, 40) × [0, 30), and two cells around it for maps that drifted.
pub const CELLS: CellRect = CellRect { i0: -2, j0: -2, i1: 42, j1: 32 };

/// Width over height of what is shown.
pub const ASPECT: f64 = 44.0 / 34.0;

/// Side of a cell \[m\].
const CELL: f64 = 0.3;

/// A map view at a place in the figure.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct View {
    /// Where it is drawn \[css px\].
    pub area: Rect,
}

impl View {
    /// Css px per metre.
    pub fn scale(&self) -> f64 {
        self.area.w / (f64::from(CELLS.i1 - CELLS.i0) * CELL)
    }

    /// A point of the world \[m\].
    pub fn point(&self, [x, y]: [f64; 2]) -> Point {
        let s = self.scale();
        [self.area.x + (x - f64::from(CELLS.i0) * CELL) * s, self.area.y + (f64::from(CELLS.j1) * CELL - y) * s]
    }

    /// The positions of a path, cut at the edge of the view. Points nearer than `least` \[css px\] to the one before are left out.
    pub fn path(&self, poses: &[Pose2], least: f64) -> Vec<Vec<Point>> {
        clip_polyline(&thinned(&mut poses.iter().map(|pose| self.point([pose.x, pose.y])), least), &self.area)
    }

    /// An arrow head of this length from centre to nose \[css px\] that points where the robot looks; `None` out of view.
    pub fn robot(&self, pose: &Pose2, length: f64) -> Option<Vec<Point>> {
        let at = self.point([pose.x, pose.y]);
        self.area.inset(1.5 * length).contains(at).then(|| robot(at, pose.theta, length))
    }
}

/// The shades of the cells shown, from the upper row down.
pub fn shades(map: &Grid) -> Cells {
    let mut shades = Vec::with_capacity(CELLS.width() * CELLS.height());
    for j in (CELLS.j0..CELLS.j1).rev() {
        shades.extend((CELLS.i0..CELLS.i1).map(|i| shade(map.log_odds(i, j))));
    }
    Cells { columns: CELLS.width(), shades }
}

/// Means of the hits in the occupied cells shown \[m\].
pub fn hits(map: &Grid) -> Vec<[f64; 2]> {
    let mut means = Vec::new();
    for j in CELLS.j0..CELLS.j1 {
        means.extend((CELLS.i0..CELLS.i1).filter(|&i| map.log_odds(i, j) > 0.0).filter_map(|i| map.ndt_mean(i, j)));
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam_lab::experiment::lap::GRID;

    #[test]
    fn the_cell_is_the_one_of_the_filter() {
        assert_eq!(CELL, GRID.cell_size);
    }

    #[test]
    fn a_corner_of_the_apartment_is_two_cells_from_the_corner_of_the_view() {
        let view = View { area: Rect::new(100.0, 50.0, 440.0, 340.0) };
        let [x, y] = view.point([0.0, 0.0]);
        assert!((x - 120.0).abs() < 1e-9 && (y - 370.0).abs() < 1e-9);
        let [x, y] = view.point([12.0, 9.0]);
        assert!((x - 520.0).abs() < 1e-9 && (y - 70.0).abs() < 1e-9);
    }

    #[test]
    fn a_robot_that_looks_up_points_up() {
        let view = View { area: Rect::new(0.0, 0.0, 440.0, 340.0) };
        let pose = Pose2::new(6.0, 4.5, core::f64::consts::FRAC_PI_2);
        let corners = view.robot(&pose, 10.0).unwrap();
        assert!(corners[1..].iter().all(|c| c[1] > corners[0][1]));
        assert_eq!(view.robot(&Pose2::new(90.0, 0.0, 0.0), 10.0), None);
    }
}
