//! The neighbourhood of a robot, laid flat: what a matcher looks at thousands of times in one step.

use super::tile::{FAR, SHIFT, Surface, TILE, mahalanobis2};
use super::{CellRect, Grid, Surfaces, fast_floor};

/// Farthest from the robot that is laid flat \[m\]; what lies beyond is looked up in the grid.
const RADIUS: f64 = 12.0;

/// The squares around a place, each with what is known of it, without the two levels of pointers that a grid has.
pub(crate) struct View<'a, const FINE: usize> {
    grid: &'a Grid<FINE>,
    /// In squares, one more on each side than is known of.
    rect: CellRect,
    squares: Vec<Square>,
    /// The surfaces of all these squares; the first is that of a square that was never hit.
    surfaces: Vec<Flat>,
}

#[derive(Clone, Copy)]
struct Square {
    /// Place in `surfaces`.
    surface: u16,
    /// Log-odds in units of the cell in its middle.
    units: i8,
    /// Squares to the nearest surface.
    near: u8,
}

/// What a distance is computed from.
#[derive(Clone, Copy)]
struct Flat {
    mean: [f32; 2],
    information: [f32; 3],
    /// Added to every distance: infinite for no surface, so that all are computed alike.
    base: f32,
}

impl Flat {
    const NONE: Self = Self { mean: [0.0; 2], information: [0.0; 3], base: f32::INFINITY };

    #[inline]
    fn mahalanobis2(&self, x: f32, y: f32) -> f32 {
        mahalanobis2(self.mean, self.information, x, y) + self.base
    }
}

impl<'a, const FINE: usize> View<'a, FINE> {
    /// All within `radius` \[m\] of a place, and within [`RADIUS`].
    pub fn new(grid: &'a Grid<FINE>, [x, y]: [f64; 2], radius: f64) -> Self {
        let reach = (radius.min(RADIUS) * grid.per_square) as i32 + 2;
        let (i, j) = (fast_floor(x * grid.per_square), fast_floor(y * grid.per_square));
        let known = grid.directory.rect;
        let clip = |k: i32, low: i32, high: i32| (k >> SHIFT).clamp(low, high);
        let tiles = CellRect {
            i0: clip(i.saturating_sub(reach), known.i0, known.i1),
            j0: clip(j.saturating_sub(reach), known.j0, known.j1),
            i1: clip(i.saturating_add(reach + TILE), known.i0, known.i1),
            j1: clip(j.saturating_add(reach + TILE), known.j0, known.j1),
        };
        let rect = CellRect { i0: tiles.i0 * TILE, j0: tiles.j0 * TILE, i1: tiles.i1 * TILE, j1: tiles.j1 * TILE };
        let unknown = Square { surface: 0, units: 0, near: FAR as u8 };
        let mut squares = vec![unknown; rect.width() * rect.height()];
        let mut surfaces = vec![Flat::NONE];
        for (tj, ti) in (tiles.j0..tiles.j1).flat_map(|tj| (tiles.i0..tiles.i1).map(move |ti| (tj, ti))) {
            let Some(tile) = grid.directory.tile(ti, tj) else { continue };
            let first = surfaces.len();
            let flat = |s: &Surface| Flat { mean: s.mean, information: s.information, base: 0.0 };
            surfaces.extend(tile.surfaces().iter().map(flat));
            for row in 0..TILE {
                let start = (tj * TILE + row - rect.j0) as usize * rect.width() + (ti * TILE - rect.i0) as usize;
                for (column, square) in squares[start..start + TILE as usize].iter_mut().enumerate() {
                    let local = (row << SHIFT) as usize + column;
                    let surface = tile.place(local).map_or(0, |place| first + place);
                    let units = tile.log_odds[local][FINE / 2][FINE / 2];
                    // More surfaces than fit are left out: a radius of RADIUS holds fewer in any building.
                    let surface = u16::try_from(surface).unwrap_or(0);
                    *square = Square { surface, units, near: tile.nearness(local) as u8 };
                }
            }
        }
        Self { grid, rect, squares, surfaces }
    }

    /// Squares from a point, in squares, to the nearest surface: 0 in a square that was hit, [`FAR`] where none is near.
    #[inline]
    pub fn nearness(&self, u: f64, v: f64) -> usize {
        let (i, j) = (fast_floor(u), fast_floor(v));
        let (column, row) = (i.wrapping_sub(self.rect.i0), j.wrapping_sub(self.rect.j0));
        let (width, height) = (self.rect.width(), self.rect.height());
        if (column as u32 as usize) < width && (row as u32 as usize) < height {
            usize::from(self.squares[row as usize * width + column as usize].near)
        } else {
            self.grid.nearness(i, j)
        }
    }

    /// Squares a metre.
    pub fn per_square(&self) -> f64 {
        self.grid.per_square
    }
}

impl<const FINE: usize> Surfaces for View<'_, FINE> {
    fn units_at(&self, x: f64, y: f64) -> i8 {
        self.grid.units_at(x, y)
    }

    #[inline]
    fn nearest_surface(&self, x: f64, y: f64) -> (f64, i8) {
        let (u, v) = (x * self.grid.per_square - 0.5, y * self.grid.per_square - 0.5);
        let (i, j) = (fast_floor(u), fast_floor(v));
        let (column, row) =
            (i.wrapping_sub(self.rect.i0) as u32 as usize, j.wrapping_sub(self.rect.j0) as u32 as usize);
        let width = self.rect.width();
        // Left of the first column is the largest number of 32 bits: one more must not be the first on a 32-bit machine.
        if column.saturating_add(1) >= width || row.saturating_add(1) >= self.rect.height() {
            return self.grid.nearest_surface(x, y);
        }
        let (du, dv) = (u - f64::from(i), v - f64::from(j));
        let (own_i, own_j) = (usize::from(du >= 0.5), usize::from(dv >= 0.5));
        let size = self.grid.square_size as f32;
        let (x, y) = (du as f32 * size, dv as f32 * size);
        let first = row * width + column;
        let squares = [&self.squares[first..first + 2], &self.squares[first + width..first + width + 2]];
        let d2 = |square: &Square, x: f32, y: f32| self.surfaces[usize::from(square.surface)].mahalanobis2(x, y);
        let nearest = [
            d2(&squares[0][0], x, y),
            d2(&squares[0][1], x - size, y),
            d2(&squares[1][0], x, y - size),
            d2(&squares[1][1], x - size, y - size),
        ];
        let least = |a: f32, b: f32| if b < a { b } else { a };
        let nearest = least(least(nearest[0], nearest[1]), least(nearest[2], nearest[3]));
        (f64::from(nearest), squares[own_j][own_i].units)
    }
}
