//! From the world to the figure: metres to css px, cells to shades.

use crate::scene::{Cells, Plane, Rect, SHARES, UNKNOWN, shade};
use fastslam::map::grid::{CellRect, Grid};
use fastslam_lab::experiment::lap::{Course, Lap};

/// The cells shown of a course: its building in the middle, and a margin for maps that drifted. As many of each course, so that where
/// the parts of the figure stand does not depend on it.
pub const fn cells(course: Course) -> CellRect {
    match course {
        // [0, 40) × [0, 30), and two cells around it.
        Course::Apartment | Course::Rooms => CellRect { i0: -2, j0: -2, i1: 42, j1: 32 },
        // [0, 36⅔) × [0, 26⅔).
        Course::Ring => CellRect { i0: -4, j0: -4, i1: 40, j1: 30 },
    }
}

/// Width over height of what is shown.
pub const ASPECT: f64 = 44.0 / 34.0;

/// Side of a cell \[m\].
const CELL: f64 = 0.3;

/// The cells of a course at a place in the figure.
pub fn plane(area: Rect, course: Course) -> Plane {
    let CellRect { i0, i1, j1, .. } = cells(course);
    Plane::from_upper_left(area, [f64::from(i0) * CELL, f64::from(j1) * CELL], area.w / (f64::from(i1 - i0) * CELL))
}

/// The shades of the cells of a course, from the upper row down.
pub fn shades(map: &Grid, course: Course) -> Cells {
    let CellRect { i0, i1, j0, j1 } = cells(course);
    Cells::of(i0..i1, j0..j1, |i, j| shade(map.log_odds(i, j)))
}

/// Shares of the weight below this are none: one more shade than nothing would be seen of them.
const NOTICED: f64 = 0.01;

/// The shade of a cell that so much of the weight, 0 to 1, holds to be a wall.
pub fn share(p: f64) -> u8 {
    SHARES + (p.min(1.0) * f64::from(255 - SHARES)).round() as u8
}

/// The cells of a course by what all universes make of them, each counting for its weight: how much of that holds each cell to be a wall,
/// and where none does, the mean of how free they hold it to be.
pub fn shares(lap: &Lap, weights: &[f64], course: Course) -> Cells {
    let CellRect { i0, i1, j0, j1 } = cells(course);
    let mut sums = vec![[0.0; 2]; cells(course).width() * cells(course).height()];
    for (particle, weight) in lap.particles().iter().zip(weights) {
        let places = (j0..j1).rev().flat_map(|j| (i0..i1).map(move |i| (i, j)));
        for ([wall, open], (i, j)) in sums.iter_mut().zip(places) {
            let log_odds = particle.map.log_odds(i, j);
            if log_odds > 0.0 {
                *wall += weight;
            } else {
                *open += weight * f64::from(shade(log_odds));
            }
        }
    }
    let shade = |[wall, open]: [f64; 2]| {
        if wall > NOTICED {
            return share(wall);
        }
        // From the shades up to unknown to those below the shares.
        (open / (1.0 - wall) * f64::from(SHARES - 1) / f64::from(UNKNOWN)).round().min(f64::from(SHARES - 1)) as u8
    };
    Cells { columns: cells(course).width(), shades: sums.into_iter().map(shade).collect() }
}

/// Means of the hits in the occupied cells of a course \[m\].
pub fn hits(map: &Grid, course: Course) -> Vec<[f64; 2]> {
    let CellRect { i0, i1, j0, j1 } = cells(course);
    let row = |j| (i0..i1).filter(move |&i| map.log_odds(i, j) > 0.0).filter_map(move |i| map.ndt_mean(i, j));
    (j0..j1).flat_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam_lab::experiment::lap::GRID;
    use strum::VariantArray;

    #[test]
    fn the_cell_is_the_one_of_the_filter() {
        assert_eq!(CELL, GRID.cell_size);
    }

    #[test]
    fn a_corner_of_the_apartment_is_two_cells_from_the_corner_of_the_view() {
        let view = plane(Rect::new(100.0, 50.0, 440.0, 340.0), Course::Apartment);
        let [x, y] = view.point([0.0, 0.0]);
        assert!((x - 120.0).abs() < 1e-9 && (y - 370.0).abs() < 1e-9);
        let [x, y] = view.point([12.0, 9.0]);
        assert!((x - 520.0).abs() < 1e-9 && (y - 70.0).abs() < 1e-9);
    }

    #[test]
    fn the_building_of_each_course_is_in_the_middle_of_as_large_a_view() {
        let area = Rect::new(100.0, 50.0, 440.0, 340.0);
        for &course in Course::VARIANTS {
            let (view, [w, h]) = (plane(area, course), course.route().plan.size);
            let [low, high] = [[0.0; 2], [w, h]].map(|corner| view.point(corner));
            let margins = [low[0] - area.x, area.right() - high[0], high[1] - area.y, area.bottom() - low[1]];
            // To a cell: the raster begins with a whole one.
            assert!(margins.iter().all(|margin| *margin > 19.9 && (margin - margins[0]).abs() <= 10.0), "{margins:?}");
            assert_eq!(cells(course).width() as f64 / cells(course).height() as f64, ASPECT);
        }
    }
}
