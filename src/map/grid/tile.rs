//! A tile of 8 × 8 NDT cells, each a block of occupancy cells: the unit that is shared and copied.

#[cfg(feature = "serde")]
use crate::save::{self, RestoreError};
use core::hash::Hasher;

/// NDT cells along a side of a tile.
pub(super) const TILE: i32 = 1 << SHIFT;

/// log₂ of [`TILE`].
pub(super) const SHIFT: i32 = 3;

/// One unit of stored log-odds \[nats\]: a byte then reaches ±3.97 nats, probabilities 0.019 to 0.981. Clamping there is what
/// lets a map change its mind; [`GridModel::log_odds_bounds`](super::GridModel::log_odds_bounds) may clamp nearer to 0.
pub(crate) const UNIT: f64 = 1.0 / 32.0;

/// Log-odds \[nats\] in units, to the nearest, as far as they reach to both sides alike.
pub(super) fn units(log_odds: f64) -> i8 {
    (log_odds / UNIT).round().clamp(-127.0, 127.0) as i8
}

/// Of an index in a tile, the part that is the column.
const MASK: usize = TILE as usize - 1;

/// Index of an NDT cell in its tile.
#[inline]
pub(super) fn local(i: i32, j: i32) -> usize {
    (((j & (TILE - 1)) << SHIFT) | (i & (TILE - 1))) as usize
}

/// Hits after which an NDT cell is settled: it stops changing, and its tile may stay shared.
const SETTLED: u32 = 64;

/// Pseudo-hits every NDT cell begins with, so that one hit is a round blob and not a point.
const PSEUDO_HITS: f32 = 2.0;

/// Distance of a place that no hit is near \[NDT cells\]: the end of the distance field.
pub(crate) const MAX_DISTANCE: usize = 3;

/// Normal distribution of the end points that fell into one NDT cell (Biber and Straßer 2003), relative to its centre.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct NdtCell {
    /// End points seen.
    pub hits: u32,
    /// Their mean (x, y) \[m\].
    pub mean: [f32; 2],
    /// Sums of squared deviations (xx, xy, yy) \[m²\].
    scatter: [f32; 3],
    /// Σ′⁻¹ (xx, xy, yy) \[m⁻²\]: Σ′ is Σ = (scatter + n₀ σ₀² I) / (hits + n₀), stretched along the wall.
    pub information: [f32; 3],
}

impl NdtCell {
    fn add(&mut self, [x, y]: [f32; 2], ndt_std: f32, stretch: f32) {
        // Welford's recurrence: mean and scatter in one pass, without cancellation.
        self.hits += 1;
        let n = self.hits as f32;
        let (dx, dy) = (x - self.mean[0], y - self.mean[1]);
        self.mean[0] += dx / n;
        self.mean[1] += dy / n;
        self.scatter[0] += dx * (x - self.mean[0]);
        self.scatter[1] += dx * (y - self.mean[1]);
        self.scatter[2] += dy * (y - self.mean[1]);
        let (prior, weight) = (PSEUDO_HITS * ndt_std * ndt_std, 1.0 / (n + PSEUDO_HITS));
        let (xx, xy, yy) =
            ((self.scatter[0] + prior) * weight, self.scatter[1] * weight, (self.scatter[2] + prior) * weight);
        // Σ′ = λ I + s² (Σ − λ I), with λ the smaller eigenvalue of Σ: across the wall nothing is stretched.
        let half = 0.5 * (xx - yy);
        let across = 0.5 * (xx + yy) - (half * half + xy * xy).sqrt();
        let (times, rest) = (stretch * stretch, (stretch * stretch - 1.0) * across);
        let (xx, xy, yy) = (times * xx - rest, times * xy, times * yy - rest);
        let det = xx * yy - xy * xy;
        self.information = [yy / det, -xy / det, xx / det];
    }
}

/// Log-odds of every occupancy cell, and the distributions of the NDT cells that were hit.
#[derive(Clone, Debug)]
pub(super) struct Tile<const CELLS_PER_NDT: usize> {
    /// In [`UNIT`]s; 0 is unknown. Row by row, as beams are marked: by row of NDT cells, row in it, NDT cell of the row, and column in that.
    log_odds: [[Row<CELLS_PER_NDT>; CELLS_PER_NDT]; TILE as usize],
    /// By NDT cell: one more than the place of its distribution in `ndt_cells`. For one that was never hit it is 256 minus its distance
    /// from the nearest that was, or 0 where none is near.
    places: [u8; NDT_CELLS],
    /// Distributions in the order in which their NDT cells were first hit: walls are few, so a tile stays small.
    ndt_cells: Vec<NdtCell>,
}

/// A row of occupancy cells, by NDT cell.
type Row<const CELLS_PER_NDT: usize> = [[i8; CELLS_PER_NDT]; TILE as usize];

/// NDT cells of a tile.
const NDT_CELLS: usize = (TILE * TILE) as usize;

impl<const CELLS_PER_NDT: usize> Default for Tile<CELLS_PER_NDT> {
    fn default() -> Self {
        Self {
            log_odds: [[[[0; CELLS_PER_NDT]; TILE as usize]; CELLS_PER_NDT]; TILE as usize],
            places: [0; NDT_CELLS],
            ndt_cells: Vec::new(),
        }
    }
}

impl<const CELLS_PER_NDT: usize> Tile<CELLS_PER_NDT> {
    /// One whose cells are all as free as they can be, far from where any beam ended.
    pub fn clear(free: i8) -> Self {
        let mut tile = Self::default();
        tile.log_odds.as_flattened_mut().as_flattened_mut().as_flattened_mut().fill(free);
        tile
    }

    /// Whether it is [that one](Self::clear).
    pub fn is_clear(&self, free: i8) -> bool {
        let cells = self.log_odds.as_flattened().as_flattened().as_flattened();
        cells.iter().all(|units| *units == free) && self.places.iter().all(|place| *place == 0)
    }

    /// The same content in a dense array: for each NDT cell its occupancy cells and a distribution.
    pub const DENSE_BYTES: usize = NDT_CELLS * (CELLS_PER_NDT * CELLS_PER_NDT + size_of::<NdtCell>());

    /// Log-odds in units of the cell in the middle of an NDT cell.
    #[inline]
    pub fn middle(&self, local: usize) -> i8 {
        self.units(local, [CELLS_PER_NDT / 2; 2])
    }

    /// Log-odds in units of the occupancy cell in this column and row of an NDT cell.
    #[inline]
    pub fn units(&self, local: usize, [i, j]: [usize; 2]) -> i8 {
        self.log_odds[local >> SHIFT][j][local & MASK][i]
    }

    pub fn units_mut(&mut self, local: usize, [i, j]: [usize; 2]) -> &mut i8 {
        &mut self.log_odds[local >> SHIFT][j][local & MASK][i]
    }

    /// Log-odds in units of each row of occupancy cells.
    #[inline]
    pub fn rows(&self) -> impl Iterator<Item = &[i8]> {
        self.log_odds.as_flattened().iter().map(|row| row.as_flattened())
    }

    #[inline]
    pub fn rows_mut(&mut self) -> impl Iterator<Item = &mut [i8]> {
        self.log_odds.as_flattened_mut().iter_mut().map(|row| row.as_flattened_mut())
    }

    /// Log-odds in units of the rows of an NDT cell.
    fn block(&self, local: usize) -> impl Iterator<Item = &[i8; CELLS_PER_NDT]> {
        self.log_odds[local >> SHIFT].iter().map(move |row| &row[local & MASK])
    }

    /// Whether beams have passed all of an NDT cell: each occupancy cell of it is less likely occupied than before anything was seen.
    pub fn is_seen_through(&self, local: usize) -> bool {
        self.block(local).flatten().all(|units| *units < 0)
    }

    #[inline]
    pub fn ndt_cell(&self, local: usize) -> Option<&NdtCell> {
        // Place 0 wraps to an index past the end: one comparison serves both questions.
        self.ndt_cells.get(usize::from(self.places[local].wrapping_sub(1)))
    }

    /// The distance field \[NDT cells\]: 0 where an end point fell, [`MAX_DISTANCE`] where none fell near.
    #[inline]
    pub fn distance(&self, local: usize) -> usize {
        let place = self.places[local];
        if place == 0 {
            MAX_DISTANCE
        } else {
            usize::from(if place <= NDT_CELLS as u8 { 0 } else { place.wrapping_neg() })
        }
    }

    /// Notes that a hit is no further away than this \[NDT cells\], which is less than [`MAX_DISTANCE`].
    pub fn lower_distance(&mut self, local: usize, distance: usize) {
        if distance < self.distance(local) {
            self.places[local] = (distance as u8).wrapping_neg();
        }
    }

    /// Whether it is the first hit of its NDT cell.
    pub fn add_hit(&mut self, local: usize, offset: [f32; 2], ndt_std: f32, stretch: f32) -> bool {
        let first = self.distance(local) > 0;
        if first {
            // By a few: of most tiles few NDT cells are hit.
            if self.ndt_cells.len() == self.ndt_cells.capacity() {
                self.ndt_cells.reserve_exact(2);
            }
            self.ndt_cells.push(NdtCell::default());
            self.places[local] = self.ndt_cells.len() as u8;
        }
        let ndt_cell = &mut self.ndt_cells[usize::from(self.places[local]) - 1];
        if ndt_cell.hits < SETTLED {
            ndt_cell.add(offset, ndt_std, stretch);
        }
        first
    }

    /// Puts all that it holds into a fingerprint: every cell, which NDT cells were hit or are near one that was, and what they hold.
    pub fn hash_into(&self, hasher: &mut impl Hasher) {
        let rows = (0..NDT_CELLS).flat_map(|local| self.block(local));
        rows.for_each(|row| hasher.write(&row.map(|units| units as u8)));
        hasher.write(&self.places);
        for NdtCell { hits, mean, scatter, information } in &self.ndt_cells {
            hasher.write(&hits.to_le_bytes());
            mean.iter().chain(scatter).chain(information).for_each(|x| hasher.write(&x.to_bits().to_le_bytes()));
        }
    }

    /// What it holds.
    pub fn bytes(&self) -> usize {
        bytes::<CELLS_PER_NDT>(self.ndt_cells.len())
    }
}

/// Bytes of a tile with so many distributions, as on a 64-bit machine: a byte an occupancy cell, one an NDT cell, the vector's three
/// words, and the distributions.
pub(super) fn bytes<const CELLS_PER_NDT: usize>(ndt_cells: usize) -> usize {
    NDT_CELLS * (CELLS_PER_NDT * CELLS_PER_NDT + 1) + 3 * 8 + ndt_cells * size_of::<NdtCell>()
}

/// A tile in plain numbers.
#[cfg(feature = "serde")]
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub(super) struct SavedTile {
    /// By NDT cell, then by row and column in it.
    log_odds: Vec<i8>,
    places: Vec<u8>,
    ndt_cells: Vec<NdtCell>,
}

#[cfg(feature = "serde")]
impl<const CELLS_PER_NDT: usize> Tile<CELLS_PER_NDT> {
    pub fn save(&self) -> SavedTile {
        SavedTile {
            log_odds: (0..NDT_CELLS).flat_map(|local| self.block(local)).flatten().copied().collect(),
            places: self.places.to_vec(),
            ndt_cells: self.ndt_cells.clone(),
        }
    }
}

#[cfg(feature = "serde")]
impl SavedTile {
    pub fn restore<const CELLS_PER_NDT: usize>(&self) -> Result<Tile<CELLS_PER_NDT>, RestoreError> {
        let Self { log_odds, places, ndt_cells } = self;
        let mut tile = Tile::<CELLS_PER_NDT>::default();
        save::count("maps.tiles.log_odds", log_odds.len(), NDT_CELLS * CELLS_PER_NDT * CELLS_PER_NDT)?;
        for (k, units) in log_odds.iter().enumerate() {
            let (row, i) = (k / CELLS_PER_NDT, k % CELLS_PER_NDT);
            *tile.units_mut(row / CELLS_PER_NDT, [i, row % CELLS_PER_NDT]) = *units;
        }
        save::count("maps.tiles.places", places.len(), NDT_CELLS)?;
        tile.places.copy_from_slice(places);
        // All that are no distance: see `places`.
        let mut hit: Vec<u8> =
            places.iter().copied().filter(|p| usize::from(p.wrapping_neg()) >= MAX_DISTANCE).collect();
        hit.sort_unstable();
        let each_once = hit.into_iter().map(usize::from).eq(1..=ndt_cells.len());
        save::holds(each_once, "maps.tiles.places", "the place of each distribution once, and distances")?;
        for NdtCell { hits, mean, scatter, information } in ndt_cells {
            save::holds(
                (1..=SETTLED).contains(hits),
                "maps.tiles.hits",
                "at least one, and no more than settle a cell",
            )?;
            save::finite("maps.tiles.ndt_cells", mean.iter().chain(scatter).chain(information).map(|x| f64::from(*x)))?;
        }
        tile.ndt_cells.clone_from(ndt_cells);
        Ok(tile)
    }
}
