//! What a scan is held against: the distributions of the end points that were seen, and the cells.

use super::quad::{Apart, Corners, Quad, least};
use super::tile::{self, TILE};
use super::{Grid, SHIFT};
use wide::{CmpGe, f32x4, f64x4, i32x4};

/// What a scan is held against. Asking may be to its advantage: what was worked out for one point it may keep for the next.
pub(crate) trait NdtField {
    /// Log-odds of the cell of a point \[m\], in [`UNIT`](super::UNIT)s.
    fn units_at(&mut self, point: [f64; 2]) -> i8;

    /// What is known at points, given by x and by y \[m\].
    fn nearest_ndt(&mut self, points: [f64x4; 2]) -> Nearest;
}

/// Points that are asked about together: as many as one vector instruction takes.
pub(crate) const LANES: usize = 4;

/// What is known at points.
pub(crate) struct Nearest {
    /// The smallest squared Mahalanobis distance to the distributions of the four NDT cells whose centres are nearest, infinite where
    /// none of them was hit. The four contain everything within half an NDT cell of the point.
    pub d2: f32x4,
    /// The log-odds of the middle of the point's own NDT cell in [`UNIT`](super::UNIT)s.
    pub units: [i8; LANES],
}

impl<const CELLS_PER_NDT: usize> Grid<CELLS_PER_NDT> {
    /// Where points lie, given by x and by y \[m\].
    #[inline]
    pub(super) fn corners(&self, points: [f64x4; 2]) -> Corners {
        let at = points.map(|c| c * self.per_ndt - 0.5);
        let below = at.map(|c| c - 0.5 + SHIFT);
        let cell = below.map(|c| i32x4::new(c.to_array().map(|k| k.to_bits() as i32)));
        // In NDT cells from the centre of the lower left, 0 to 1: from one half on, the point itself lies in the next.
        let beyond = [0, 1].map(|k: usize| at[k] - (below[k] - SHIFT));
        let offset = beyond.map(|c| f32x4::new(c.to_array().map(|c| c as f32)) * self.ndt_size as f32);
        let [right, above] = beyond.map(|c| i32x4::new(c.cmp_ge(0.5).to_array().map(|mask| mask.to_bits() as i32)));
        Corners { cell, offset, own: (right & i32x4::splat(1)) | (above & i32x4::splat(2)) }
    }

    /// The four NDT cells of which (i, j) is the lower left.
    pub(super) fn quad(&self, i: i32, j: i32) -> Quad {
        let inner = |k: i32| k & (TILE - 1) != TILE - 1;
        let tile = |i: i32, j: i32| self.directory.tile(i >> tile::SHIFT, j >> tile::SHIFT);
        let forgets = self.model.ndt_forgets;
        if inner(i) && inner(j) {
            // The four lie in one tile: look it up once.
            let (tile, first) = (tile(i, j), tile::local(i, j));
            let locals = [first, first + 1, first + TILE as usize, first + TILE as usize + 1];
            Quad::of(locals.map(|local| (tile, local)), forgets)
        } else {
            let (right, above) = (i.wrapping_add(1), j.wrapping_add(1));
            let cells = [(i, j), (right, j), (i, above), (right, above)];
            Quad::of(cells.map(|(i, j)| (tile(i, j), tile::local(i, j))), forgets)
        }
    }
}

impl<const CELLS_PER_NDT: usize> NdtField for &Grid<CELLS_PER_NDT> {
    fn units_at(&mut self, [x, y]: [f64; 2]) -> i8 {
        let (i, j) = self.cell_of(x, y);
        self.units(i, j)
    }

    fn nearest_ndt(&mut self, points: [f64x4; 2]) -> Nearest {
        let (corners, apart) = (self.corners(points), Apart::new(self.ndt_size as f32));
        let [i, j] = corners.cell.map(i32x4::to_array);
        let found = core::array::from_fn::<_, LANES, _>(|k| self.quad(i[k], j[k]).at(k, &corners, &apart));
        Nearest { d2: least(found.map(|(d2, _)| d2)), units: found.map(|(_, units)| units) }
    }
}
