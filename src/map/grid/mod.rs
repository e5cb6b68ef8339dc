//! An occupancy grid that a resampling clones for nothing: two levels of copy-on-write.
//!
//! A [`Grid`] holds one shared pointer to a directory, and the directory one to each tile of 8 × 8 NDT cells. Cloning a grid copies
//! one pointer. The first write afterwards copies the directory, which is a pointer for each tile of the map's rectangle, and each
//! tile when it is first written to. Of what the map holds, a scan therefore copies only the tiles it changes. Tiles that beams have passed all
//! over, so often that none of their cells can become freer, are one and the same in all maps that come from one.
//!
//! Two layers lie over each other:
//! - *occupancy*: each cell keeps its log-odds of being occupied, updated by the inverse sensor model (*Probabilistic Robotics*, table 9.1);
//! - the *normal distributions transform* (Biber and Straßer 2003): each NDT cell, a block of `CELLS_PER_NDT` × `CELLS_PER_NDT` cells,
//!   keeps the normal distribution of the end points that fell into it.
//!
//! The first knows which cell an end point is in; the second knows where in it the wall is, and which way the wall runs. With cells as wide
//! as a wall is looked for, an NDT cell is one cell; with finer cells it must be wider, or it holds too few points to tell a direction.

mod directory;
mod drawn;
mod held;
mod image;
mod local_map;
mod model;
mod ndt_field;
mod quad;
mod ray_trace;
#[cfg(feature = "serde")]
mod saved;
mod tile;

pub(crate) use local_map::LocalMap;
pub(crate) use ndt_field::{LANES, NdtField, Nearest};
pub(crate) use tile::{MAX_DISTANCE, UNIT};
use tile::{NdtCell, TILE};

pub use directory::CellRect;
pub use drawn::{GreyMode, MapReading, PgmError};
pub use image::{MapImage, MapImageSettings};
pub use model::GridModel;
#[cfg(feature = "serde")]
pub use saved::SavedGrids;

use super::ConditionalMap;
use crate::error::SettingError;
use crate::geometry::Pose2;
use crate::sensor::Scan;
use directory::Directory;
use ray_trace::RayTrace;
use std::sync::Arc;
use tile::Tile;

/// Occupancy in cells of `cell_size`, and normal distributions in NDT cells of `CELLS_PER_NDT` × `CELLS_PER_NDT` cells, growing to
/// wherever scans reach.
///
/// Cell (i, j) covers [i s, (i + 1) s) × [j s, (j + 1) s) of the world frame.
#[derive(Clone, Debug)]
pub struct Grid<const CELLS_PER_NDT: usize = 1> {
    model: GridModel,
    /// 1 / cell_size \[1/m\].
    per_cell: f64,
    /// Side of an NDT cell \[m\].
    ndt_size: f64,
    /// 1 / ndt_size \[1/m\].
    per_ndt: f64,
    directory: Arc<Directory<CELLS_PER_NDT>>,
    /// What every tile that cannot become freer is replaced by, in this grid and in all that come from it: where beams go to and fro, that is every
    /// fourth tile.
    clear: Arc<Tile<CELLS_PER_NDT>>,
    /// Scans mapped so far.
    scans: u32,
    /// The directory as it was after so many scans, oldest first: what [`Grid::past`] is now, and what it will be.
    past: Vec<(u32, Arc<Directory<CELLS_PER_NDT>>)>,
}

impl<const CELLS_PER_NDT: usize> Grid<CELLS_PER_NDT> {
    /// Cells along a side of an NDT cell.
    const NDT: i32 = CELLS_PER_NDT as i32;

    /// Cells along a side of a tile.
    pub const TILE_CELLS: i32 = TILE * Self::NDT;

    /// An unknown world.
    pub fn new(model: GridModel) -> Self {
        let ndt_size = CELLS_PER_NDT as f64 * model.cell_size;
        let directory = Directory { rect: CellRect::default(), tiles: Vec::new() }.into();
        let [free, _] = model.log_odds_bounds.map(tile::units);
        Self {
            model,
            per_cell: 1.0 / model.cell_size,
            ndt_size,
            per_ndt: 1.0 / ndt_size,
            directory,
            clear: Tile::clear(free).into(),
            scans: 0,
            past: Vec::new(),
        }
    }

    /// An unknown world, with the settings of this one.
    pub(crate) fn blank(&self) -> Self {
        Self { clear: Arc::clone(&self.clear), ..Self::new(self.model) }
    }

    /// How it learns.
    #[cfg(feature = "serde")]
    pub(crate) fn model(&self) -> &GridModel {
        &self.model
    }

    /// Bytes of a tile of which so many NDT cells were hit.
    pub fn tile_bytes(ndt_cells: usize) -> usize {
        tile::bytes::<CELLS_PER_NDT>(ndt_cells)
    }

    /// The map as it was [`GridModel::lag`] scans ago, up to one and a half times that; before that, as it was when it was
    /// [settled](Self::settle), or empty.
    ///
    /// Costs pointers only. What is kept for it are the tiles that have been written to since, as they were.
    pub fn past(&self) -> Self {
        let directory = self.past.first().map_or(&self.directory, |(_, directory)| directory);
        self.with_directory(directory)
    }

    /// The map as it is, without what is kept for [`Self::past`].
    pub(crate) fn present(&self) -> Self {
        self.with_directory(&self.directory)
    }

    fn with_directory(&self, directory: &Arc<Directory<CELLS_PER_NDT>>) -> Self {
        Self { directory: Arc::clone(directory), clear: Arc::clone(&self.clear), past: Vec::new(), ..*self }
    }

    /// From now on, [`Self::past`] is never older than what is mapped by now: for scans that were taken at known poses.
    pub fn settle(&mut self) {
        self.past = vec![(self.scans, Arc::clone(&self.directory))];
    }

    /// Keeps the map as it is for [`Self::past`], for whoever counts the age of a map otherwise than in scans: with [`GridModel::lag`] = 0,
    /// the past is the map before the last two marks, or before fewer as long as there are no more.
    pub fn mark(&mut self) {
        /// The past, and what it will be after one mark and after two.
        const KEPT: usize = 3;
        self.past.push((self.scans, Arc::clone(&self.directory)));
        self.past.drain(..self.past.len().saturating_sub(KEPT));
    }

    /// Keeps the map before another scan for [`Self::past`]: one for every half of the lag, and none that will not be asked for.
    fn remember(&mut self) {
        let lag = self.model.lag;
        if lag > 0 && self.scans.is_multiple_of(lag.div_ceil(2)) {
            self.past.push((self.scans, Arc::clone(&self.directory)));
        }
        self.scans += 1;
        while lag > 0 && self.past.get(1).is_some_and(|(scans, _)| scans + lag <= self.scans) {
            self.past.remove(0);
        }
    }

    /// Side of a cell \[m\].
    pub fn cell_size(&self) -> f64 {
        self.model.cell_size
    }

    /// The cells that have been allocated.
    pub fn bounds(&self) -> CellRect {
        let CellRect { i0, j0, i1, j1 } = self.directory.rect;
        let tile = Self::TILE_CELLS;
        CellRect { i0: i0 * tile, j0: j0 * tile, i1: i1 * tile, j1: j1 * tile }
    }

    /// Log-odds of a cell being occupied \[nats\]: 0 for a cell that nothing is known of, at most about ±4.
    pub fn log_odds(&self, i: i32, j: i32) -> f64 {
        f64::from(self.units(i, j)) * tile::UNIT
    }

    /// Mean of the end points in the NDT cell (i, j) \[m\], world frame; `None` where there are none. Its indices count NDT cells, of which
    /// [`Self::log_odds`] has `CELLS_PER_NDT` to each side.
    pub fn ndt_mean(&self, i: i32, j: i32) -> Option<[f64; 2]> {
        let ndt_cell = self.ndt_cell(i, j)?;
        let center = |k: i32| (f64::from(k) + 0.5) * self.ndt_size;
        Some([center(i) + f64::from(ndt_cell.mean[0]), center(j) + f64::from(ndt_cell.mean[1])])
    }

    /// Log-odds in their stored units of [`UNIT`] nats.
    #[inline]
    pub(crate) fn units(&self, i: i32, j: i32) -> i8 {
        let [si, sj] = [i, j].map(|k| k.div_euclid(Self::NDT));
        let [di, dj] = [i, j].map(|k| k.rem_euclid(Self::NDT) as usize);
        self.directory.tile(si >> tile::SHIFT, sj >> tile::SHIFT).map_or(0, |t| t.units(tile::local(si, sj), [di, dj]))
    }

    /// The cell of a point \[m\].
    #[inline]
    pub(crate) fn cell_of(&self, x: f64, y: f64) -> (i32, i32) {
        (floor(x * self.per_cell), floor(y * self.per_cell))
    }

    /// The distribution of an NDT cell, relative to its centre.
    #[inline]
    fn ndt_cell(&self, i: i32, j: i32) -> Option<&NdtCell> {
        self.directory.tile(i >> tile::SHIFT, j >> tile::SHIFT)?.ndt_cell(tile::local(i, j))
    }

    /// The distance field \[NDT cells\]: 0 where an end point fell, [`MAX_DISTANCE`] where none fell near.
    pub(crate) fn distance(&self, i: i32, j: i32) -> usize {
        self.directory
            .tile(i >> tile::SHIFT, j >> tile::SHIFT)
            .map_or(MAX_DISTANCE, |tile| tile.distance(tile::local(i, j)))
    }

    /// Lowers the distance field around an NDT cell that was hit for the first time.
    fn lower_distance(&mut self, i: i32, j: i32) {
        let reach = self.model.distance_reach as i32;
        for (di, dj) in (-reach..=reach).flat_map(|dj| (-reach..=reach).map(move |di| (di, dj))) {
            let distance = di.abs().max(dj.abs()) as usize;
            let (i, j) = (i + di, j + dj);
            if distance < self.distance(i, j)
                && let Some(tile) = self.tile_mut(i >> tile::SHIFT, j >> tile::SHIFT)
            {
                tile.lower_distance(tile::local(i, j), distance);
            }
        }
    }

    /// A tile, made its own and allocated if need be; `None` where the directory does not reach.
    fn tile_mut(&mut self, ti: i32, tj: i32) -> Option<&mut Tile<CELLS_PER_NDT>> {
        let slot = Arc::make_mut(&mut self.directory).slot(ti, tj)?;
        Some(Arc::make_mut(slot.get_or_insert_default()))
    }
}

impl<const CELLS_PER_NDT: usize> ConditionalMap for Grid<CELLS_PER_NDT> {
    type Observation = Scan;
    type Association = ();

    /// Every cell is updated once a scan at the most, however many beams touch it: beams are not independent, and a wall seen
    /// at a grazing angle would be erased by the beams that pass along it. A cell that a beam ended in counts as hit.
    fn assimilate(&mut self, world_from_robot: &Pose2, scan: &Scan, (): &()) {
        self.remember();
        let trace = ray_trace::trace(world_from_robot, scan, self.model.cell_size, Self::TILE_CELLS);
        let Some(window) = trace.window() else { return };
        self.grow(window);
        self.update_cells(&trace);
        self.update_ndt_cells(&trace);
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.model.validate()
    }
}

impl<const CELLS_PER_NDT: usize> Grid<CELLS_PER_NDT> {
    /// Makes the directory cover these tiles, and those that a hit at their border is felt in.
    fn grow(&mut self, CellRect { i0, j0, i1, j1 }: CellRect) {
        let margin = i32::from(self.model.distance_reach > 0);
        let needed = CellRect { i0: i0 - margin, j0: j0 - margin, i1: i1 + margin, j1: j1 + margin };
        if !self.directory.rect.covers(needed) {
            self.directory = Arc::new(self.directory.grown(needed));
        }
    }

    /// Adds the log-odds of a hit or of a pass to every cell that a beam touched (PR table 9.1), a row of a tile at a time: such loops are what
    /// compilers make vector instructions of.
    fn update_cells(&mut self, trace: &RayTrace) {
        let (hit, pass) = (tile::units(self.model.log_odds_hit), tile::units(self.model.log_odds_pass));
        let [free, occupied] = self.model.log_odds_bounds.map(tile::units);
        let side = Self::TILE_CELLS as usize;
        for (ti, tj, block) in trace.tiles() {
            let marks = || block.chunks(trace.side as usize).map(|row| &row[..side]);
            let is_touched = |row: &[u8]| row.iter().fold(ray_trace::UNTOUCHED, |any, mark| any | mark) > 0;
            // Look before writing: a tile in which nothing would change stays shared.
            let changes = match self.directory.tile(ti, tj) {
                None => marks().take(side).any(is_touched),
                Some(tile) => tile.rows().zip(marks()).any(|(cells, marks)| {
                    let changes = |(cell, mark): (&i8, &u8)| {
                        (*mark == ray_trace::HIT) | ((*mark == ray_trace::PASSED) & (*cell > free))
                    };
                    cells.iter().zip(marks).fold(false, |any, one| any | changes(one))
                }),
            };
            if !changes {
                continue;
            }
            let tile = self.tile_mut(ti, tj).expect("the directory was grown to cover the scan");
            for (cells, marks) in tile.rows_mut().zip(marks()) {
                for (cell, mark) in cells.iter_mut().zip(marks) {
                    let passed = if *mark == ray_trace::PASSED { pass } else { 0 };
                    let add = if *mark == ray_trace::HIT { hit } else { passed };
                    *cell = cell.saturating_add(add).max(free).min(occupied);
                }
            }
            if tile.is_clear(free)
                && let Some(slot) = Arc::make_mut(&mut self.directory).slot(ti, tj)
            {
                *slot = Some(Arc::clone(&self.clear));
            }
        }
    }

    /// Adds every end point to the normal distribution of its NDT cell.
    fn update_ndt_cells(&mut self, trace: &RayTrace) {
        let size = self.ndt_size;
        let [ndt_std, stretch] = [self.model.ndt_std, self.model.ndt_stretch].map(|c| c as f32);
        let ndt_cell = |&(_, i, j): &([f64; 2], i32, i32)| [i, j].map(|k| k.div_euclid(Self::NDT));
        let tile_of = |hit: &([f64; 2], i32, i32)| ndt_cell(hit).map(|k| k >> tile::SHIFT);
        // Neighbouring beams mostly end in one tile: it is made this map's own once for all of them.
        for hits in trace.hits.chunk_by(|a, b| tile_of(a) == tile_of(b)) {
            let [ti, tj] = tile_of(&hits[0]);
            let tile = self.tile_mut(ti, tj).expect("the directory was grown to cover the scan");
            let mut first_hits = Vec::new();
            for hit in hits {
                let ([x, y], [i, j]) = (hit.0, ndt_cell(hit));
                let center = |k: i32| (f64::from(k) + 0.5) * size;
                let offset = [(x - center(i)) as f32, (y - center(j)) as f32];
                if tile.add_hit(tile::local(i, j), offset, ndt_std, stretch) {
                    first_hits.push([i, j]);
                }
            }
            if self.model.distance_reach > 0 {
                first_hits.into_iter().for_each(|[i, j]| self.lower_distance(i, j));
            }
        }
    }
}

/// 1.5 · 2⁵²: adding it leaves no bits for a fraction, and the integer in the lowest bits.
const SHIFT: f64 = 6_755_399_441_055_744.0;

/// ⌊x⌋, or the integer below where x is an odd integer: the rounding of an addition does the work, in a third of the
/// instructions of [`floor`]. Beyond the range of an `i32` the answer is any number, which is a cell like any other.
#[inline]
fn fast_floor(x: f64) -> i32 {
    (x - 0.5 + SHIFT).to_bits() as i32
}

/// ⌊x⌋ as an index; saturates, and NaN gives 0. Without the call that `f64::floor` is on a plain x86-64.
#[inline]
fn floor(x: f64) -> i32 {
    let truncated = x as i32;
    truncated.saturating_sub(i32::from(f64::from(truncated) > x))
}

#[cfg(test)]
mod tests;
