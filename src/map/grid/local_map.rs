//! The part of a grid around a robot, copied into one array: a matcher looks at it thousands of times in one step.

use super::tile::{MAX_DISTANCE, NdtCell, SHIFT, TILE, mahalanobis2};
use super::{CellRect, Grid, NdtField, fast_floor};

/// Farthest from the robot that is copied \[m\]; what lies beyond is looked up in the grid.
const RADIUS: f64 = 12.0;

/// The NDT cells around a place, each with what is known of it, without the two levels of pointers that a grid has.
pub(crate) struct LocalMap<'a, const CELLS_PER_NDT: usize> {
    grid: &'a Grid<CELLS_PER_NDT>,
    /// In NDT cells.
    rect: CellRect,
    cells: Vec<FlatCell>,
    /// Distributions of these NDT cells; the first stands for all that were never hit.
    ndt_cells: Vec<Flat>,
}

#[derive(Clone, Copy)]
struct FlatCell {
    /// Place of its distribution.
    ndt_cell: u16,
    /// Log-odds in units of the cell in its middle.
    units: i8,
    /// Distance from the nearest hit \[NDT cells\].
    near: u8,
}

/// What a distance is computed from.
#[derive(Clone, Copy)]
struct Flat {
    mean: [f32; 2],
    information: [f32; 3],
    /// Added to every distance: infinite where there is no distribution, so that all are computed alike.
    base: f32,
}

impl Flat {
    const NONE: Self = Self { mean: [0.0; 2], information: [0.0; 3], base: f32::INFINITY };

    #[inline]
    fn mahalanobis2(&self, x: f32, y: f32) -> f32 {
        mahalanobis2(self.mean, self.information, x, y) + self.base
    }
}

impl<'a, const CELLS_PER_NDT: usize> LocalMap<'a, CELLS_PER_NDT> {
    /// All within `radius` \[m\] of a place, and within [`RADIUS`].
    pub fn new(grid: &'a Grid<CELLS_PER_NDT>, [x, y]: [f64; 2], radius: f64) -> Self {
        let reach = (radius.min(RADIUS) * grid.per_ndt) as i32 + 2;
        let (i, j) = (fast_floor(x * grid.per_ndt), fast_floor(y * grid.per_ndt));
        let known = grid.directory.rect;
        let clip = |k: i32, low: i32, high: i32| (k >> SHIFT).clamp(low, high);
        let tiles = CellRect {
            i0: clip(i.saturating_sub(reach), known.i0, known.i1),
            j0: clip(j.saturating_sub(reach), known.j0, known.j1),
            i1: clip(i.saturating_add(reach + TILE), known.i0, known.i1),
            j1: clip(j.saturating_add(reach + TILE), known.j0, known.j1),
        };
        let rect = CellRect { i0: tiles.i0 * TILE, j0: tiles.j0 * TILE, i1: tiles.i1 * TILE, j1: tiles.j1 * TILE };
        let unknown = FlatCell { ndt_cell: 0, units: 0, near: MAX_DISTANCE as u8 };
        let mut cells = vec![unknown; rect.width() * rect.height()];
        let mut ndt_cells = vec![Flat::NONE];
        for (tj, ti) in (tiles.j0..tiles.j1).flat_map(|tj| (tiles.i0..tiles.i1).map(move |ti| (tj, ti))) {
            let Some(tile) = grid.directory.tile(ti, tj) else { continue };
            let first = ndt_cells.len();
            let flat = |s: &NdtCell| Flat { mean: s.mean, information: s.information, base: 0.0 };
            ndt_cells.extend(tile.ndt_cells().iter().map(flat));
            for row in 0..TILE {
                let start = (tj * TILE + row - rect.j0) as usize * rect.width() + (ti * TILE - rect.i0) as usize;
                for (column, cell) in cells[start..start + TILE as usize].iter_mut().enumerate() {
                    let local = (row << SHIFT) as usize + column;
                    let ndt_cell = tile.place(local).map_or(0, |place| first + place);
                    let units = tile.log_odds[local][CELLS_PER_NDT / 2][CELLS_PER_NDT / 2];
                    // More distributions than fit are left out: a radius of RADIUS holds fewer in any building.
                    let ndt_cell = u16::try_from(ndt_cell).unwrap_or(0);
                    *cell = FlatCell { ndt_cell, units, near: tile.distance(local) as u8 };
                }
            }
        }
        Self { grid, rect, cells, ndt_cells }
    }

    /// The distance field \[NDT cells\] at a point given in NDT cells: 0 where an end point fell, [`MAX_DISTANCE`] where none fell near.
    #[inline]
    pub fn distance(&self, u: f64, v: f64) -> usize {
        let (i, j) = (fast_floor(u), fast_floor(v));
        let (column, row) = (i.wrapping_sub(self.rect.i0), j.wrapping_sub(self.rect.j0));
        let (width, height) = (self.rect.width(), self.rect.height());
        if (column as u32 as usize) < width && (row as u32 as usize) < height {
            usize::from(self.cells[row as usize * width + column as usize].near)
        } else {
            self.grid.distance(i, j)
        }
    }

    /// NDT cells a metre.
    pub fn per_ndt(&self) -> f64 {
        self.grid.per_ndt
    }
}

impl<const CELLS_PER_NDT: usize> NdtField for LocalMap<'_, CELLS_PER_NDT> {
    fn units_at(&self, x: f64, y: f64) -> i8 {
        self.grid.units_at(x, y)
    }

    #[inline]
    fn nearest_ndt(&self, x: f64, y: f64) -> (f64, i8) {
        let (u, v) = (x * self.grid.per_ndt - 0.5, y * self.grid.per_ndt - 0.5);
        let (i, j) = (fast_floor(u), fast_floor(v));
        let (column, row) =
            (i.wrapping_sub(self.rect.i0) as u32 as usize, j.wrapping_sub(self.rect.j0) as u32 as usize);
        let width = self.rect.width();
        // Left of the first column is the largest number of 32 bits: one more must not be the first on a 32-bit machine.
        if column.saturating_add(1) >= width || row.saturating_add(1) >= self.rect.height() {
            return self.grid.nearest_ndt(x, y);
        }
        let (du, dv) = (u - f64::from(i), v - f64::from(j));
        let (own_i, own_j) = (usize::from(du >= 0.5), usize::from(dv >= 0.5));
        let size = self.grid.ndt_size as f32;
        let (x, y) = (du as f32 * size, dv as f32 * size);
        let first = row * width + column;
        let cells = [&self.cells[first..first + 2], &self.cells[first + width..first + width + 2]];
        let d2 = |cell: &FlatCell, x: f32, y: f32| self.ndt_cells[usize::from(cell.ndt_cell)].mahalanobis2(x, y);
        let nearest = [
            d2(&cells[0][0], x, y),
            d2(&cells[0][1], x - size, y),
            d2(&cells[1][0], x, y - size),
            d2(&cells[1][1], x - size, y - size),
        ];
        let least = |a: f32, b: f32| if b < a { b } else { a };
        let nearest = least(least(nearest[0], nearest[1]), least(nearest[2], nearest[3]));
        (f64::from(nearest), cells[own_j][own_i].units)
    }
}
