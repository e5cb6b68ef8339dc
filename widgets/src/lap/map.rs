//! From the world to the figure: metres to css px, cells to shades.

use crate::scene::{Cells, Plane, Rect, shade};
use fastslam::map::grid::{CellRect, Grid};

/// The cells shown: the apartment, [0, 40) × [0, 30), and two cells around it for maps that drifted.
pub const CELLS: CellRect = CellRect { i0: -2, j0: -2, i1: 42, j1: 32 };

/// Width over height of what is shown.
pub const ASPECT: f64 = 44.0 / 34.0;

/// Side of a cell \[m\].
const CELL: f64 = 0.3;

/// The cells at a place in the figure.
pub fn plane(area: Rect) -> Plane {
    let scale = area.w / (f64::from(CELLS.i1 - CELLS.i0) * CELL);
    Plane::from_upper_left(area, [f64::from(CELLS.i0) * CELL, f64::from(CELLS.j1) * CELL], scale)
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
        let view = plane(Rect::new(100.0, 50.0, 440.0, 340.0));
        let [x, y] = view.point([0.0, 0.0]);
        assert!((x - 120.0).abs() < 1e-9 && (y - 370.0).abs() < 1e-9);
        let [x, y] = view.point([12.0, 9.0]);
        assert!((x - 520.0).abs() < 1e-9 && (y - 70.0).abs() < 1e-9);
    }
}
