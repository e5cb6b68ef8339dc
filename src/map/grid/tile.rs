//! A tile of 8 × 8 surfaces, each with its square of cells: the unit that is shared and copied.

use crate::digest::Digest;

/// Surfaces along a side of a tile.
pub(super) const TILE: i32 = 1 << SHIFT;

/// log₂ of [`TILE`].
pub(super) const SHIFT: i32 = 3;

/// One unit of stored log-odds \[nats\]: a byte then reaches ±3.97 nats, probabilities 0.019 to 0.981. Clamping there is what
/// lets a map change its mind (Hornung et al. 2013, OctoMap, clamps alike).
pub(crate) const UNIT: f64 = 1.0 / 32.0;

/// Log-odds \[nats\] in units, to the nearest.
pub(super) fn units(log_odds: f64) -> i8 {
    (log_odds / UNIT).round() as i8
}

/// Index of a surface in its tile.
#[inline]
pub(super) fn local(i: i32, j: i32) -> usize {
    (((j & (TILE - 1)) << SHIFT) | (i & (TILE - 1))) as usize
}

/// Hits after which a surface is settled: it stops changing, and its tile may stay shared.
const SETTLED: u32 = 64;

/// Pseudo-hits every surface begins with, so that one hit is a round blob and not a point.
const PSEUDO_HITS: f32 = 2.0;

/// Squares away at which a surface is not felt any more.
pub(crate) const FAR: usize = 3;

/// Normal distribution of the end points in one square (Biber and Straßer 2003), relative to its centre.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Surface {
    /// End points seen.
    pub hits: u32,
    /// Their mean (x, y) \[m\].
    pub mean: [f32; 2],
    /// Sums of squared deviations (xx, xy, yy) \[m²\].
    scatter: [f32; 3],
    /// Σ′⁻¹ (xx, xy, yy) \[m⁻²\]: Σ′ is Σ = (scatter + n₀ σ₀² I) / (hits + n₀), stretched along the surface.
    pub information: [f32; 3],
}

impl Surface {
    fn add(&mut self, [x, y]: [f32; 2], surface_std: f32, stretch: f32) {
        // Welford's recurrence: mean and scatter in one pass, without cancellation.
        self.hits += 1;
        let n = self.hits as f32;
        let (dx, dy) = (x - self.mean[0], y - self.mean[1]);
        self.mean[0] += dx / n;
        self.mean[1] += dy / n;
        self.scatter[0] += dx * (x - self.mean[0]);
        self.scatter[1] += dx * (y - self.mean[1]);
        self.scatter[2] += dy * (y - self.mean[1]);
        let (prior, weight) = (PSEUDO_HITS * surface_std * surface_std, 1.0 / (n + PSEUDO_HITS));
        let (xx, xy, yy) =
            ((self.scatter[0] + prior) * weight, self.scatter[1] * weight, (self.scatter[2] + prior) * weight);
        // Σ′ = λ I + s² (Σ − λ I), with λ the smaller eigenvalue of Σ: what lies across the surface stays as it is.
        let half = 0.5 * (xx - yy);
        let across = 0.5 * (xx + yy) - (half * half + xy * xy).sqrt();
        let (times, rest) = (stretch * stretch, (stretch * stretch - 1.0) * across);
        let (xx, xy, yy) = (times * xx - rest, times * xy, times * yy - rest);
        let det = xx * yy - xy * xy;
        self.information = [yy / det, -xy / det, xx / det];
    }

    /// (p − mean)ᵀ Σ⁻¹ (p − mean) of a point relative to the centre of the cell \[m\].
    #[inline]
    pub fn mahalanobis2(&self, x: f32, y: f32) -> f32 {
        mahalanobis2(self.mean, self.information, x, y)
    }
}

/// (p − mean)ᵀ Σ⁻¹ (p − mean) by Σ⁻¹ (xx, xy, yy).
#[inline]
pub(super) fn mahalanobis2(mean: [f32; 2], [xx, xy, yy]: [f32; 3], x: f32, y: f32) -> f32 {
    let (dx, dy) = (x - mean[0], y - mean[1]);
    xx * dx * dx + 2.0 * xy * dx * dy + yy * dy * dy
}

/// Log-odds of every cell, and surfaces of the squares that were hit.
#[derive(Clone, Debug)]
pub(super) struct Tile<const FINE: usize> {
    /// In [`UNIT`]s; 0 is unknown. By square, then by row and column in it.
    pub log_odds: [[[i8; FINE]; FINE]; SQUARES],
    /// One more than the place of a square's surface in `surfaces`; for a square that was never hit, 0, or 256 minus how many
    /// squares away the nearest surface is, where that is marked.
    places: [u8; SQUARES],
    /// Surfaces in the order in which squares were first hit: walls are few, so a tile stays small.
    surfaces: Vec<Surface>,
}

/// Squares of a tile.
const SQUARES: usize = (TILE * TILE) as usize;

impl<const FINE: usize> Default for Tile<FINE> {
    fn default() -> Self {
        Self { log_odds: [[[0; FINE]; FINE]; SQUARES], places: [0; SQUARES], surfaces: Vec::new() }
    }
}

impl<const FINE: usize> Tile<FINE> {
    /// The same content in a dense array of squares, each with its cells' log-odds and its surface.
    pub const DENSE_BYTES: usize = SQUARES * (FINE * FINE + size_of::<Surface>());

    /// All surfaces.
    pub fn surfaces(&self) -> &[Surface] {
        &self.surfaces
    }

    /// Which of the surfaces is that of a square.
    #[inline]
    pub fn place(&self, local: usize) -> Option<usize> {
        let place = self.places[local];
        (1..=SQUARES as u8).contains(&place).then(|| usize::from(place) - 1)
    }

    #[inline]
    pub fn surface(&self, local: usize) -> Option<&Surface> {
        // Place 0 wraps to an index past any surface: one comparison serves both questions.
        self.surfaces.get(usize::from(self.places[local].wrapping_sub(1)))
    }

    /// Squares to the nearest surface: 0 in a square that was hit, [`FAR`] where none is marked.
    #[inline]
    pub fn nearness(&self, local: usize) -> usize {
        let place = self.places[local];
        if place == 0 { FAR } else { usize::from(if place <= SQUARES as u8 { 0 } else { place.wrapping_neg() }) }
    }

    /// Marks that a surface is so many squares away, fewer than [`FAR`].
    pub fn mark_near(&mut self, local: usize, squares: usize) {
        if squares < self.nearness(local) {
            self.places[local] = (squares as u8).wrapping_neg();
        }
    }

    /// Whether it is the first hit of its square.
    pub fn add_hit(&mut self, local: usize, offset: [f32; 2], surface_std: f32, stretch: f32) -> bool {
        let first = self.nearness(local) > 0;
        if first {
            self.surfaces.push(Surface::default());
            self.places[local] = self.surfaces.len() as u8;
        }
        let surface = &mut self.surfaces[usize::from(self.places[local]) - 1];
        if surface.hits < SETTLED {
            surface.add(offset, surface_std, stretch);
        }
        first
    }

    /// Fingerprint of all that it holds: every cell, which squares have a surface or are near one, and every surface.
    pub fn digest(&self) -> Digest {
        let mut digest = Digest::new();
        self.log_odds.as_flattened().iter().for_each(|row| digest.bytes(&row.map(|units| units as u8)));
        digest.bytes(&self.places);
        for Surface { hits, mean, scatter, information } in &self.surfaces {
            digest.u32(*hits);
            mean.iter().chain(scatter).chain(information).for_each(|x| digest.u32(x.to_bits()));
        }
        digest
    }

    /// What it holds.
    pub fn bytes(&self) -> usize {
        bytes::<FINE>(self.surfaces.len())
    }
}

/// What a tile with so many surfaces holds, as on a 64-bit machine: a byte a cell, one a square, the vector's three words, and
/// the surfaces.
pub(super) fn bytes<const FINE: usize>(surfaces: usize) -> usize {
    SQUARES * (FINE * FINE + 1) + 3 * 8 + surfaces * size_of::<Surface>()
}
