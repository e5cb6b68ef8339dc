//! An occupancy grid that a resampling clones for nothing: two levels of copy-on-write.
//!
//! A [`Grid`] holds one shared pointer to a directory, and the directory one to each tile of 8 × 8 NDT cells. Cloning a grid copies
//! one pointer. The first write afterwards copies the directory, which is a pointer for each tile of the map's rectangle, and each
//! tile when it is first written to. Of what the map holds, a scan therefore copies only the tiles it changes.
//!
//! Two layers lie over each other:
//! - *occupancy*: each cell keeps its log-odds of being occupied, updated by the inverse sensor model (*Probabilistic Robotics*, table 9.1);
//! - the *normal distributions transform* (Biber and Straßer 2003): each NDT cell, a block of `CELLS_PER_NDT` × `CELLS_PER_NDT` cells,
//!   keeps the normal distribution of the end points that fell into it.
//!
//! The first knows which cell an end point is in; the second knows where in it the wall is, and which way the wall runs. With cells as wide
//! as a wall is looked for, an NDT cell is one cell; with finer cells it must be wider, or it holds too few points to tell a direction.

mod drawn;
mod image;
mod local_map;
mod quad;
mod ray_trace;
#[cfg(feature = "serde")]
mod saved;
mod tile;

pub(crate) use local_map::LocalMap;
use quad::{Corner, Quad, least};
pub(crate) use tile::{MAX_DISTANCE, UNIT};
use tile::{NdtCell, TILE};

pub use drawn::{GreyMode, MapReading, PgmError};
pub use image::{MapImage, MapImageSettings};
#[cfg(feature = "serde")]
pub use saved::SavedGrids;

use super::{ConditionalMap, Footprint};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::sensor::Scan;
use core::hash::Hasher;
use ray_trace::RayTrace;
use std::sync::Arc;
use tile::Tile;

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

    /// The least rectangle that holds both.
    fn united(self, other: Self) -> Self {
        Self {
            i0: self.i0.min(other.i0),
            j0: self.j0.min(other.j0),
            i1: self.i1.max(other.i1),
            j1: self.j1.max(other.j1),
        }
    }
}

/// How a grid learns from a scan.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GridModel {
    /// Side of a cell \[m\].
    pub cell_size: f64,
    /// Added to the log-odds of a cell that a beam ended in \[nats\].
    pub log_odds_hit: f64,
    /// Added to the log-odds of a cell that beams only passed through \[nats\], negative.
    pub log_odds_pass: f64,
    /// Where log-odds end \[nats\], free and occupied, to ±4: nearer to 0, a map changes its mind sooner (Hornung et al. 2013, OctoMap, clamp
    /// at −2 and 3.5).
    pub log_odds_bounds: [f64; 2],
    /// Standard deviation \[m\] of the two pseudo-hits that every NDT cell begins with: how far one hit alone is trusted.
    pub ndt_std: f64,
    /// How many times longer than its end points say a distribution is along the wall: 1 or more. A wall goes on from NDT cell to NDT cell,
    /// but a normal distribution in each is a string of beads: between two of them, even the right pose fits badly.
    pub ndt_stretch: f64,
    /// How many scans old [`Grid::past`] is, at the least; with 0 no past is kept but what is [marked](Grid::mark).
    pub lag: u32,
    /// How far from a hit the distance field is kept \[NDT cells\], 0 to 2: what a coarse search looks at. With 0 there is none.
    pub distance_reach: u32,
    /// Whether a distribution counts only until it is seen through: until beams have passed so often that the log-odds of all cells of its NDT
    /// cell are below 0 (after NDT-OM: Saarinen et al. 2013). Without, a place in which somebody stood once attracts scans for ever, and so
    /// does a wall that was drawn a little askew from afar.
    pub ndt_forgets: bool,
}

impl GridModel {
    /// Whether all settings are in range.
    ///
    /// # Errors
    /// Where one is not: with cells of no size there is no map, and what is felt further than two NDT cells away would be kept in no byte.
    pub fn validate(&self) -> Result<(), SettingError> {
        /// More than a byte of log-odds holds.
        const MOST: f64 = 4.0;
        /// Lengths for which single precision is no worry.
        const LENGTH: Range = Range::number(1e-6, 1e6, "m");
        let Self {
            cell_size,
            log_odds_hit,
            log_odds_pass,
            log_odds_bounds: [free, occupied],
            ndt_std,
            ndt_stretch,
            lag,
            distance_reach,
            ndt_forgets: _,
        } = *self;
        LENGTH.check("grid.cell_size", cell_size)?;
        Range::number(0.0, MOST, "nats").check("grid.log_odds_hit", log_odds_hit)?;
        Range::number(-MOST, 0.0, "nats").check("grid.log_odds_pass", log_odds_pass)?;
        Range::number(-MOST, 0.0, "nats").check("grid.log_odds_bounds", free)?;
        Range::number(0.0, MOST, "nats").check("grid.log_odds_bounds", occupied)?;
        LENGTH.check("grid.ndt_std", ndt_std)?;
        Range::number(1.0, 1e3, "").check("grid.ndt_stretch", ndt_stretch)?;
        Range::whole(0, 1_000_000).check("grid.lag", f64::from(lag))?;
        Range::whole(0, MAX_DISTANCE as u32 - 1).check("grid.distance_reach", f64::from(distance_reach)).map(drop)
    }
}

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
    /// Scans mapped so far.
    scans: u32,
    /// The directory as it was after so many scans, oldest first: what [`Grid::past`] is now, and what it will be.
    past: Vec<(u32, Arc<Directory<CELLS_PER_NDT>>)>,
}

/// The upper level: a rectangle of tiles. `None` is a tile nobody has written to.
#[derive(Clone, Debug)]
struct Directory<const CELLS_PER_NDT: usize> {
    /// In tiles.
    rect: CellRect,
    tiles: Vec<Option<Arc<Tile<CELLS_PER_NDT>>>>,
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
        Self {
            model,
            per_cell: 1.0 / model.cell_size,
            ndt_size,
            per_ndt: 1.0 / ndt_size,
            directory,
            scans: 0,
            past: Vec::new(),
        }
    }

    /// An unknown world, with the settings of this one.
    pub(crate) fn blank(&self) -> Self {
        Self::new(self.model)
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
        Self { directory: Arc::clone(directory), past: Vec::new(), ..*self }
    }

    /// The map as it is, without what is kept for [`Self::past`].
    pub(crate) fn present(&self) -> Self {
        Self { directory: Arc::clone(&self.directory), past: Vec::new(), ..*self }
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
        self.directory.tile(si >> tile::SHIFT, sj >> tile::SHIFT).map_or(0, |t| t.log_odds[tile::local(si, sj)][dj][di])
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

    /// Bytes that these grids hold together, each shared part counted once, against dense arrays of their own.
    ///
    /// Counted as on a 64-bit machine everywhere, and without the allocator's slack: the same number on every platform.
    pub fn footprint<'a>(grids: impl IntoIterator<Item = &'a Self>) -> Footprint {
        Self::footprint_of(&grids.into_iter().collect::<Vec<_>>())
    }

    fn footprint_of(grids: &[&Self]) -> Footprint {
        const POINTER: usize = 8;
        let dense: usize =
            grids.iter().map(|grid| grid.directory.tiles.len() * Tile::<CELLS_PER_NDT>::DENSE_BYTES).sum();
        let directories = distinct(grids.iter().copied().flat_map(Self::directories).collect());
        let pointers: usize = directories.iter().map(|d| d.tiles.len() * POINTER).sum();
        let tiles = distinct(directories.iter().flat_map(|d| d.tiles.iter().flatten()).collect());
        let unique = pointers + tiles.iter().map(|tile| tile.bytes()).sum::<usize>();
        Footprint { unique: unique as u64, dense: dense as u64 }
    }

    /// Puts all that these grids hold into a fingerprint: the log-odds of every cell, and every distribution, bit for bit. A tile that
    /// several of them share is read once, so that a family of maps costs what its [`Self::footprint`] is and not so many copies.
    pub fn hash_all<'a, H: Hasher + Default>(grids: impl IntoIterator<Item = &'a Self>, hasher: &mut H) {
        let mut known = std::collections::BTreeMap::new();
        for Directory { rect, tiles } in grids.into_iter().flat_map(Self::directories).map(|directory| &**directory) {
            [rect.i0, rect.j0, rect.i1, rect.j1].into_iter().for_each(|k| hasher.write(&k.to_le_bytes()));
            for tile in tiles {
                let value = |tile: &Arc<Tile<CELLS_PER_NDT>>| {
                    *known.entry(Arc::as_ptr(tile).addr()).or_insert_with(|| {
                        let mut hasher = H::default();
                        tile.hash_into(&mut hasher);
                        hasher.finish()
                    })
                };
                hasher.write(&tile.as_ref().map_or(0, value).to_le_bytes());
            }
        }
    }

    /// Of the present and of the past.
    fn directories(&self) -> impl Iterator<Item = &Arc<Directory<CELLS_PER_NDT>>> {
        core::iter::once(&self.directory).chain(self.past.iter().map(|(_, directory)| directory))
    }

    /// A tile, made its own and allocated if need be; `None` where the directory does not reach.
    fn tile_mut(&mut self, ti: i32, tj: i32) -> Option<&mut Tile<CELLS_PER_NDT>> {
        let directory = Arc::make_mut(&mut self.directory);
        let index = directory.index(ti, tj)?;
        Some(Arc::make_mut(directory.tiles[index].get_or_insert_default()))
    }
}

/// What a scan is held against. Asking may be to its advantage: what was worked out for one point it may keep for the next.
pub(crate) trait NdtField {
    /// Log-odds of the cell of a point \[m\], in [`UNIT`]s.
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
    /// The log-odds of the middle of the point's own NDT cell in [`UNIT`]s.
    pub units: [i8; BLOCK],
}

impl<const CELLS_PER_NDT: usize> Grid<CELLS_PER_NDT> {
    /// Where a point lies \[m\].
    #[inline]
    fn corner(&self, point: [f64; 2]) -> Corner {
        let at = point.map(|c| c * self.per_ndt - 0.5);
        let [i, j] = at.map(fast_floor);
        // In NDT cells from the centre of (i, j), 0 to 1: from one half on, the point itself lies in the next.
        let beyond = [at[0] - f64::from(i), at[1] - f64::from(j)];
        let offset = beyond.map(|c| c as f32 * self.ndt_size as f32);
        Corner { i, j, offset, own: beyond.map(|c| c >= 0.5) }
    }

    /// The four NDT cells of which (i, j) is the lower left.
    fn quad(&self, i: i32, j: i32) -> Quad {
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

/// Each shared thing once, in no order.
fn distinct<T>(mut shared: Vec<&Arc<T>>) -> Vec<&Arc<T>> {
    shared.sort_unstable_by_key(|arc| Arc::as_ptr(arc).addr());
    shared.dedup_by_key(|arc| Arc::as_ptr(arc).addr());
    shared
}

impl<const CELLS_PER_NDT: usize> Directory<CELLS_PER_NDT> {
    #[inline]
    fn index(&self, ti: i32, tj: i32) -> Option<usize> {
        let CellRect { i0, j0, i1, j1 } = self.rect;
        // Unsigned, a column left of the first is a large number: one comparison for each axis.
        let (column, width) = (ti.wrapping_sub(i0) as u32, (i1 - i0) as u32);
        let (row, height) = (tj.wrapping_sub(j0) as u32, (j1 - j0) as u32);
        (column < width && row < height).then(|| (row * width + column) as usize)
    }

    #[inline]
    fn tile(&self, ti: i32, tj: i32) -> Option<&Tile<CELLS_PER_NDT>> {
        self.tiles.get(self.index(ti, tj)?)?.as_deref()
    }

    /// The directory grown so as to cover `needed` (in tiles) as well.
    fn grown(&self, needed: CellRect) -> Self {
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
        if !covers(self.directory.rect, needed) {
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
            let rows = block.chunks(trace.side as usize).map(|row| &row[..side]).take(side).enumerate();
            let rows = rows.filter(|(_, marks)| marks.iter().fold(ray_trace::UNTOUCHED, |any, mark| any | mark) > 0);
            // Look before writing: a tile in which nothing would change stays shared.
            let before = self.directory.tile(ti, tj);
            let changes = rows.clone().any(|(row, marks)| {
                let Some(tile) = before else { return true };
                let changes = |(cell, mark): (&i8, &u8)| {
                    (*mark == ray_trace::HIT) | ((*mark == ray_trace::PASSED) & (*cell > free))
                };
                tile.row(row).as_flattened().iter().zip(marks).fold(false, |any, one| any | changes(one))
            });
            if !changes {
                continue;
            }
            let tile = self.tile_mut(ti, tj).expect("the directory was grown to cover the scan");
            for (row, marks) in rows {
                let mut cells = tile.row(row);
                for (cell, mark) in cells.as_flattened_mut().iter_mut().zip(marks) {
                    let passed = if *mark == ray_trace::PASSED { pass } else { 0 };
                    let add = if *mark == ray_trace::HIT { hit } else { passed };
                    *cell = cell.saturating_add(add).max(free).min(occupied);
                }
                tile.set_row(row, &cells);
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

/// ⌊x⌋, or the integer below where x is an odd integer: the rounding of an addition does the work, in a third of the
/// instructions of [`floor`]. Beyond the range of an `i32` the answer is any number, which is a cell like any other.
#[inline]
fn fast_floor(x: f64) -> i32 {
    /// 1.5 · 2⁵²: adding it leaves no bits for a fraction, and the integer in the lowest bits.
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (x - 0.5 + SHIFT).to_bits() as i32
}

/// ⌊x⌋ as an index; saturates, and NaN gives 0. Without the call that `f64::floor` is on a plain x86-64.
#[inline]
fn floor(x: f64) -> i32 {
    let truncated = x as i32;
    truncated.saturating_sub(i32::from(f64::from(truncated) > x))
}

fn covers(outer: CellRect, inner: CellRect) -> bool {
    outer.i0 <= inner.i0 && outer.j0 <= inner.j0 && outer.i1 >= inner.i1 && outer.j1 >= inner.j1
}

#[cfg(test)]
mod tests;
