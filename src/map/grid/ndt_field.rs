//! What a scan is held against: the distributions of the end points that were seen, and the cells.

use super::quad::{Corner, Quad, least};
use super::tile::{self, TILE};
use super::{Grid, fast_floor};

/// What a scan is held against. Asking may be to its advantage: what was worked out for one point it may keep for the next.
pub(crate) trait NdtField {
    /// Log-odds of the cell of a point \[m\], in [`UNIT`](super::UNIT)s.
    fn units_at(&mut self, point: [f64; 2]) -> i8;

    /// What is known at the first `count` of these points \[m\]; of the others nothing of any meaning is said.
    fn nearest_ndt(&mut self, points: &[[f64; 2]; BLOCK], count: usize) -> Nearest;
}

/// Points that are asked about together, so that each stage of the work is done to all of them before the next one: such loops are what
/// compilers make vector instructions of. Half of the beams of a lap's climb; of 4, 6, 8, 12 and 18 the fastest in WebAssembly.
pub(crate) const BLOCK: usize = 18;

/// What is known at points, by their order.
pub(crate) struct Nearest {
    /// The smallest squared Mahalanobis distance to the distributions of the four NDT cells whose centres are nearest, infinite where
    /// none of them was hit. The four contain everything within half an NDT cell of the point.
    pub d2: [f32; BLOCK],
    /// The log-odds of the middle of the point's own NDT cell in [`UNIT`](super::UNIT)s.
    pub units: [i8; BLOCK],
}

impl<const CELLS_PER_NDT: usize> Grid<CELLS_PER_NDT> {
    /// Where a point lies \[m\].
    #[inline]
    pub(super) fn corner(&self, point: [f64; 2]) -> Corner {
        let at = point.map(|c| c * self.per_ndt - 0.5);
        let [i, j] = at.map(fast_floor);
        // In NDT cells from the centre of (i, j), 0 to 1: from one half on, the point itself lies in the next.
        let beyond = [at[0] - f64::from(i), at[1] - f64::from(j)];
        let offset = beyond.map(|c| c as f32 * self.ndt_size as f32);
        Corner { i, j, offset, own: beyond.map(|c| c >= 0.5) }
    }

    /// The four NDT cells of which (i, j) is the lower left.
    pub(super) fn quad(&self, i: i32, j: i32) -> Quad {
        let inner = |k: i32| k & (TILE - 1) != TILE - 1;
        let tile = |i: i32, j: i32| self.directory.tile(i >> tile::SHIFT, j >> tile::SHIFT);
        let forgets = self.model.ndt_forgets;
        if inner(i) && inner(j) {
            // The four lie in one tile: look it up once.
            let (tile, first) = (tile(i, j), tile::local(i, j));
            let locals = [first, first + TILE as usize, first + 1, first + TILE as usize + 1];
            Quad::of(locals.map(|local| (tile, local)), forgets)
        } else {
            let (right, above) = (i.wrapping_add(1), j.wrapping_add(1));
            let cells = [(i, j), (i, above), (right, j), (right, above)];
            Quad::of(cells.map(|(i, j)| (tile(i, j), tile::local(i, j))), forgets)
        }
    }
}

impl<const CELLS_PER_NDT: usize> NdtField for &Grid<CELLS_PER_NDT> {
    fn units_at(&mut self, [x, y]: [f64; 2]) -> i8 {
        let (i, j) = self.cell_of(x, y);
        self.units(i, j)
    }

    fn nearest_ndt(&mut self, points: &[[f64; 2]; BLOCK], count: usize) -> Nearest {
        let size = self.ndt_size as f32;
        let mut nearest = Nearest { d2: [f32::INFINITY; BLOCK], units: [0; BLOCK] };
        for (k, point) in points.iter().enumerate().take(count) {
            let corner = self.corner(*point);
            let quad = self.quad(corner.i, corner.j);
            (nearest.d2[k], nearest.units[k]) = (least(quad.mahalanobis2(&corner, size)), quad.units_at(&corner));
        }
        nearest
    }
}
