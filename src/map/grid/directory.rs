//! Rectangles of cells, and the upper level of a grid: a rectangle of tiles.

use super::tile::Tile;
use std::sync::Arc;

/// Half-open rectangle of cells: i0 ≤ i < i1 along x, j0 ≤ j < j1 along y.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct CellRect {
    /// First column.
    pub i0: i32,
    /// First row.
    pub j0: i32,
    /// One past the last column.
    pub i1: i32,
    /// One past the last row.
    pub j1: i32,
}

impl CellRect {
    /// Number of columns.
    pub fn width(&self) -> usize {
        (self.i1 - self.i0).max(0) as usize
    }

    /// Number of rows.
    pub fn height(&self) -> usize {
        (self.j1 - self.j0).max(0) as usize
    }

    /// The place of a cell in it, row by row; `None` of one outside.
    #[inline]
    pub(super) fn index(self, i: i32, j: i32) -> Option<usize> {
        // Unsigned, a column left of the first is a large number: one comparison for each axis.
        let (column, width) = (i.wrapping_sub(self.i0) as u32, (self.i1 - self.i0) as u32);
        let (row, height) = (j.wrapping_sub(self.j0) as u32, (self.j1 - self.j0) as u32);
        (column < width && row < height).then(|| (row * width + column) as usize)
    }

    /// Whether the other one is within this one.
    pub(super) fn covers(self, other: Self) -> bool {
        self.i0 <= other.i0 && self.j0 <= other.j0 && self.i1 >= other.i1 && self.j1 >= other.j1
    }

    /// The least rectangle that holds both.
    pub(super) fn united(self, other: Self) -> Self {
        Self {
            i0: self.i0.min(other.i0),
            j0: self.j0.min(other.j0),
            i1: self.i1.max(other.i1),
            j1: self.j1.max(other.j1),
        }
    }
}

/// The upper level: a rectangle of tiles. `None` is a tile nobody has written to.
#[derive(Clone, Debug)]
pub(super) struct Directory<const CELLS_PER_NDT: usize> {
    /// In tiles.
    pub(super) rect: CellRect,
    pub(super) tiles: Vec<Option<Arc<Tile<CELLS_PER_NDT>>>>,
}

impl<const CELLS_PER_NDT: usize> Directory<CELLS_PER_NDT> {
    #[inline]
    pub(super) fn index(&self, ti: i32, tj: i32) -> Option<usize> {
        self.rect.index(ti, tj)
    }

    #[inline]
    pub(super) fn tile(&self, ti: i32, tj: i32) -> Option<&Tile<CELLS_PER_NDT>> {
        self.tiles.get(self.index(ti, tj)?)?.as_deref()
    }

    /// The place of a tile; `None` where the directory does not reach.
    #[inline]
    pub(super) fn slot(&mut self, ti: i32, tj: i32) -> Option<&mut Option<Arc<Tile<CELLS_PER_NDT>>>> {
        let index = self.index(ti, tj)?;
        self.tiles.get_mut(index)
    }

    /// The directory grown so as to cover `needed` (in tiles) as well.
    pub(super) fn grown(&self, needed: CellRect) -> Self {
        let old = self.rect;
        let rect = if self.tiles.is_empty() { needed } else { old.united(needed) };
        let mut grown = Self { rect, tiles: vec![None; rect.width() * rect.height()] };
        for tj in old.j0..old.j1 {
            for ti in old.i0..old.i1 {
                let (from, to) = (self.index(ti, tj), grown.index(ti, tj));
                if let (Some(from), Some(to)) = (from, to) {
                    grown.tiles[to].clone_from(&self.tiles[from]);
                }
            }
        }
        grown
    }
}
