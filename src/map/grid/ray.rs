//! Which cells a scan touches: passed by a beam, or hit by its end.

use super::CellRect;
use crate::geometry::Pose2;
use crate::ops;
use crate::sensor::Scan;

/// What happened to a cell: nothing, a beam passed, a beam ended.
pub(super) const UNTOUCHED: u8 = 0;
pub(super) const PASSED: u8 = 1;
pub(super) const HIT: u8 = 2;

/// Farthest cell from the origin that is mapped: end points beyond it are dropped, so that an absurd pose cannot exhaust
/// memory nor overflow a cell's index.
const FARTHEST: f64 = 32_768.0;

/// The touched cells of one scan.
pub(super) struct Marks {
    /// In cells, a multiple of tiles.
    window: CellRect,
    /// Cells along a side of a tile.
    tile: i32,
    cells: Vec<u8>,
    /// End points \[m\], world frame, with their cells.
    pub hits: Vec<([f64; 2], i32, i32)>,
}

/// Follows every beam from the robot to its end, through a grid whose tiles have `tile` × `tile` cells.
pub(super) fn trace(world_from_robot: &Pose2, scan: &Scan, cell_size: f64, tile: i32) -> Marks {
    let (sin, cos) = ops::sin_cos(world_from_robot.theta);
    let to_world =
        |&[x, y]: &[f64; 2]| [world_from_robot.x + cos * x - sin * y, world_from_robot.y + sin * x + cos * y];
    let per_cell = 1.0 / cell_size;
    let in_cells = |p: [f64; 2]| [p[0] * per_cell, p[1] * per_cell];
    let reachable = |p: &[f64; 2]| p.iter().all(|c| (c * per_cell).abs() < FARTHEST);

    let origin = [world_from_robot.x, world_from_robot.y];
    let mut marks = Marks { window: CellRect::default(), tile, cells: Vec::new(), hits: Vec::new() };
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
    let down = |c: f64| (c.floor() as i32 - 1).div_euclid(tile) * tile;
    let up = |c: f64| ((c.floor() as i32 + 1).div_euclid(tile) + 1) * tile;
    marks.window = CellRect { i0: down(low[0]), j0: down(low[1]), i1: up(high[0]), j1: up(high[1]) };
    marks.cells = vec![UNTOUCHED; marks.window.width() * marks.window.height()];

    for end in hits.iter().chain(&misses) {
        marks.pass(in_cells(origin), in_cells(*end));
    }
    for end in hits {
        let [i, j] = in_cells(end).map(|c| c.floor() as i32);
        let index = marks.index(i, j);
        marks.cells[index] = HIT;
        marks.hits.push((end, i, j));
    }
    marks
}

impl Marks {
    #[inline]
    fn index(&self, i: i32, j: i32) -> usize {
        (j - self.window.j0) as usize * self.window.width() + (i - self.window.i0) as usize
    }

    /// Marks the cells from `a` up to, but not including, the one of `b` (both in cells): the traversal of Amanatides and
    /// Woo (1987).
    fn pass(&mut self, a: [f64; 2], b: [f64; 2]) {
        let cell = a.map(|c| c.floor() as i32);
        let last = b.map(|c| c.floor() as i32);
        let direction = [b[0] - a[0], b[1] - a[1]];
        let step = direction.map(|d| if d > 0.0 { 1 } else { -1 });
        // Fraction of the beam per cell, and up to the next border, along each axis.
        let per_cell = direction.map(|d| if d == 0.0 { f64::INFINITY } else { (1.0 / d).abs() });
        let mut next: [f64; 2] = core::array::from_fn(|k| {
            let border = f64::from(cell[k]) + if step[k] > 0 { 1.0 } else { 0.0 };
            if direction[k] == 0.0 { f64::INFINITY } else { (border - a[k]) / direction[k] }
        });
        // Cells still to go along each axis: one whose last row or column is reached has nothing left to do, whatever rounding
        // says. The choice between the axes is as good as random, so it is made without a branch.
        let mut left = [0, 1].map(|k: usize| cell[k].abs_diff(last[k]));
        let stride = [step[0] as isize, step[1] as isize * self.window.width() as isize];
        let mut index = self.index(cell[0], cell[1]) as isize;
        while left[0] > 0 && left[1] > 0 {
            self.cells[index as usize] = PASSED;
            let second = next[1] < next[0];
            index += if second { stride[1] } else { stride[0] };
            next[0] += if second { 0.0 } else { per_cell[0] };
            next[1] += if second { per_cell[1] } else { 0.0 };
            left[0] -= u32::from(!second);
            left[1] -= u32::from(second);
        }
        for k in 0..2 {
            for _ in 0..left[k] {
                self.cells[index as usize] = PASSED;
                index += stride[k];
            }
        }
    }

    /// The tiles of the window; `None` where nothing was touched.
    pub fn touched_tiles(&self) -> Option<CellRect> {
        let CellRect { i0, j0, i1, j1 } = self.window;
        let tile = self.tile;
        (!self.cells.is_empty()).then_some(CellRect { i0: i0 / tile, j0: j0 / tile, i1: i1 / tile, j1: j1 / tile })
    }

    /// The marks of one row of a tile: [`UNTOUCHED`], [`PASSED`] or [`HIT`].
    pub fn row(&self, ti: i32, tj: i32, row: usize) -> &[u8] {
        let start = self.index(ti * self.tile, tj * self.tile + row as i32);
        &self.cells[start..start + self.tile as usize]
    }
}
