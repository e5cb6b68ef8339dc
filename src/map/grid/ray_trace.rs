//! Which cells a scan touches: passed by a beam, or hit by its end.
//!
//! Marks are kept in blocks, a byte a cell, and only for blocks that a beam goes through: no more memory than the tiles of the map that
//! the scan is going to write to. Every other block of the rectangle around the scan costs one number.

use super::{CellRect, floor};
use crate::geometry::Pose2;
use crate::ops;
use crate::sensor::Scan;

/// What happened to a cell: nothing, a beam passed, a beam ended.
pub(super) const UNTOUCHED: u8 = 0;
pub(super) const PASSED: u8 = 1;
pub(super) const HIT: u8 = 2;

/// Farthest cell from the origin that is mapped: end points beyond it are dropped, so that an absurd pose cannot exhaust
/// memory nor overflow a cell's index.
pub(super) const FARTHEST: f64 = 32_768.0;

/// Fewest cells along a side of a block: small blocks are little memory, but a beam is soon out of them.
const BLOCK: u32 = 32;

/// The touched cells of one scan.
pub(super) struct RayTrace {
    /// The rectangle of tiles around the scan.
    window: CellRect,
    /// Cells along a side of a tile.
    tile: i32,
    /// The same rectangle in blocks, rounded up.
    blocks: CellRect,
    /// Cells along a side of a block, a multiple of a tile's.
    pub side: i32,
    /// Of the blocks, row by row: one more than the place in `cells`, or 0 for a block that no beam goes through.
    places: Vec<u32>,
    /// The blocks that beams go through, each row by row.
    cells: Vec<u8>,
    /// End points \[m\], world frame, with their cells.
    pub hits: Vec<([f64; 2], i32, i32)>,
}

/// Follows every beam from where the scan was taken to its end, through a grid whose tiles have `tile` × `tile` cells.
pub(super) fn trace(world_from_robot: &Pose2, scan: &Scan, cell_size: f64, tile: i32) -> RayTrace {
    let (sin, cos) = ops::sin_cos(world_from_robot.theta);
    let to_world =
        |&[x, y]: &[f64; 2]| [world_from_robot.x + cos * x - sin * y, world_from_robot.y + sin * x + cos * y];
    let per_cell = 1.0 / cell_size;
    let in_cells = |p: [f64; 2]| [p[0] * per_cell, p[1] * per_cell];
    let reachable = |p: &[f64; 2]| p.iter().all(|c| (c * per_cell).abs() < FARTHEST);

    let origin = to_world(&scan.origin);
    let nothing = CellRect::default();
    let side = tile * BLOCK.div_ceil(tile as u32) as i32;
    let (places, cells, hits) = (Vec::new(), Vec::new(), Vec::new());
    let mut marks = RayTrace { window: nothing, tile, blocks: nothing, side, places, cells, hits };
    if !reachable(&origin) {
        return marks;
    }
    let hits: Vec<_> = scan.hits.iter().map(to_world).filter(reachable).collect();
    let misses: Vec<_> = scan.misses.iter().map(to_world).filter(reachable).collect();
    let (mut low, mut high) = (in_cells(origin), in_cells(origin));
    for end in hits.iter().chain(&misses).map(|p| in_cells(*p)) {
        for k in 0..2 {
            low[k] = low[k].min(end[k]);
            high[k] = high[k].max(end[k]);
        }
    }
    // One cell of margin: a beam along a border may step aside by a rounding error.
    let around = |side: i32| {
        let down = |c: f64| (c.floor() as i32 - 1).div_euclid(side);
        let up = |c: f64| (c.floor() as i32 + 1).div_euclid(side) + 1;
        CellRect { i0: down(low[0]), j0: down(low[1]), i1: up(high[0]), j1: up(high[1]) }
    };
    (marks.window, marks.blocks) = (around(tile), around(side));
    marks.places = vec![0; marks.blocks.width() * marks.blocks.height()];

    for end in hits.iter().chain(&misses) {
        marks.pass(in_cells(origin), in_cells(*end));
    }
    for end in hits {
        let [i, j] = in_cells(end).map(floor);
        let Cursor { first, at, .. } = marks.enter([i, j], [1, 1]);
        marks.cells[first + at] = HIT;
        marks.hits.push((end, i, j));
    }
    marks
}

/// A cell on the way of a beam.
struct Cursor {
    /// Its block, in `places`.
    block: usize,
    /// The block's first cell, in `cells`, and this cell from there on.
    first: usize,
    at: usize,
    /// Cells that the beam goes along each axis until it is out of the block.
    room: [u32; 2],
}

impl RayTrace {
    /// The first cell of a block, in `cells`.
    fn open(&mut self, block: usize) -> usize {
        let area = (self.side * self.side) as usize;
        if self.places[block] == 0 {
            self.cells.resize(self.cells.len() + area, UNTOUCHED);
            self.places[block] = (self.cells.len() / area) as u32;
        }
        (self.places[block] as usize - 1) * area
    }

    /// A cell, for a beam that goes on in steps of ±1.
    fn enter(&mut self, cell: [i32; 2], step: [i32; 2]) -> Cursor {
        let side = self.side;
        let [bi, bj] = cell.map(|c| c.div_euclid(side));
        let block = (bj - self.blocks.j0) as usize * self.blocks.width() + (bi - self.blocks.i0) as usize;
        let [i, j] = cell.map(|c| c.rem_euclid(side));
        let room = [(i, step[0]), (j, step[1])].map(|(c, step)| (if step > 0 { side - c } else { c + 1 }) as u32);
        Cursor { block, first: self.open(block), at: (j * side + i) as usize, room }
    }

    /// The marks of a cursor's block, row by row.
    fn block(&mut self, cursor: &Cursor) -> &mut [u8] {
        &mut self.cells[cursor.first..][..(self.side * self.side) as usize]
    }

    /// Tells a cursor of cells that it has gone along an axis; into the next block where there is no room left.
    fn advance(&mut self, cursor: &mut Cursor, axis: usize, along: u32, step: i32) {
        cursor.room[axis] -= along;
        if cursor.room[axis] > 0 {
            return;
        }
        let (side, [cells, blocks]) = (self.side, [[1, self.side], [1, self.blocks.width() as i32]].map(|of| of[axis]));
        cursor.block = cursor.block.wrapping_add_signed((step * blocks) as isize);
        cursor.at = cursor.at.wrapping_add_signed((-step * cells * side) as isize);
        cursor.room[axis] = side as u32;
        cursor.first = self.open(cursor.block);
    }

    /// Marks the cells from `a` up to, but not including, the one of `b` (both in cells): the traversal of Amanatides and
    /// Woo (1987).
    fn pass(&mut self, a: [f64; 2], b: [f64; 2]) {
        let cell = a.map(floor);
        let last = b.map(floor);
        let direction = [b[0] - a[0], b[1] - a[1]];
        let step = direction.map(|d| if d > 0.0 { 1 } else { -1 });
        // Fraction of the beam per cell, and up to the next border, along each axis.
        let per_cell = direction.map(|d| if d == 0.0 { f64::INFINITY } else { (1.0 / d).abs() });
        let mut next: [f64; 2] = core::array::from_fn(|k| {
            let border = f64::from(cell[k]) + if step[k] > 0 { 1.0 } else { 0.0 };
            if direction[k] == 0.0 { f64::INFINITY } else { (border - a[k]) / direction[k] }
        });
        // Cells still to go along each axis: one whose last row or column is reached has nothing left to do, whatever rounding
        // says.
        let mut left = [0, 1].map(|k: usize| cell[k].abs_diff(last[k]));
        let stride = [step[0] as isize, (step[1] * self.side) as isize];
        let mut cursor = self.enter(cell, step);
        while left[0] > 0 && left[1] > 0 {
            // Up to the border of the block, or the last row or column: what changes from cell to cell is little here, which halves
            // the time. The choice between the axes is as good as random, so it is made without a branch.
            let along = [0, 1].map(|k: usize| left[k].min(cursor.room[k]));
            let [mut columns, mut rows] = along;
            let marks = self.block(&cursor);
            while columns > 0 && rows > 0 {
                marks[cursor.at] = PASSED;
                let beyond: [f64; 2] = core::array::from_fn(|k| next[k] + per_cell[k]);
                let second = next[1] < next[0];
                cursor.at = cursor.at.wrapping_add_signed(if second { stride[1] } else { stride[0] });
                next = if second { [next[0], beyond[1]] } else { [beyond[0], next[1]] };
                columns -= u32::from(!second);
                rows -= u32::from(second);
            }
            for (k, unused) in [columns, rows].into_iter().enumerate() {
                left[k] -= along[k] - unused;
                self.advance(&mut cursor, k, along[k] - unused, step[k]);
            }
        }
        for k in 0..2 {
            while left[k] > 0 {
                let along = left[k].min(cursor.room[k]);
                let marks = self.block(&cursor);
                for _ in 0..along {
                    marks[cursor.at] = PASSED;
                    cursor.at = cursor.at.wrapping_add_signed(stride[k]);
                }
                left[k] -= along;
                self.advance(&mut cursor, k, along, step[k]);
            }
        }
    }

    /// What the marks hold.
    #[cfg(test)]
    pub fn bytes(&self) -> usize {
        self.places.len() * size_of::<u32>() + self.cells.len()
    }

    /// The rectangle of tiles around the scan; `None` where nothing was touched.
    pub fn window(&self) -> Option<CellRect> {
        (!self.places.is_empty()).then_some(self.window)
    }

    /// The tiles of all blocks that beams go through, with their place (i, j) and the marks of the block from the tile's first cell
    /// on, row by row of the block: [`UNTOUCHED`], [`PASSED`] or [`HIT`].
    pub fn tiles(&self) -> impl Iterator<Item = (i32, i32, &[u8])> {
        let (side, tile) = (self.side, self.tile);
        let (area, along) = ((side * side) as usize, side / tile);
        let CellRect { i0, j0, i1, j1 } = self.blocks;
        let blocks = (j0..j1).flat_map(move |bj| (i0..i1).map(move |bi| (bi, bj))).zip(&self.places);
        blocks.filter(|(_, place)| **place > 0).flat_map(move |((bi, bj), place)| {
            let end = *place as usize * area;
            let tiles = (0..along).flat_map(move |j| (0..along).map(move |i| (i, j)));
            tiles.map(move |(i, j)| {
                let first = (j * side + i) * tile;
                (bi * along + i, bj * along + j, &self.cells[end - area + first as usize..end])
            })
        })
    }
}
