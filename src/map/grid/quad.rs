//! What a scan's end point is compared with: the distributions of the four NDT cells around it.

use super::tile::{NdtCell, Tile};

/// Where a point lies among the NDT cells: between the centres of four of them.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    /// The lower left of the four.
    pub i: i32,
    pub j: i32,
    /// From its centre to the point \[m\], in single precision, as distributions are kept.
    pub offset: [f32; 2],
    /// Whether the point's own cell is of the two at the right, and of the two above.
    pub own: [bool; 2],
}

/// Four NDT cells around a corner: lower left, upper left, lower right, upper right. Their distributions lie number by number side by side,
/// so that one vector instruction does the same to all four.
pub(super) struct Quad {
    /// Means relative to the centre of their own cell: x of all four, then y \[m\].
    mean: [[f32; 4]; 2],
    /// Σ′⁻¹ xx, twice xy, and yy \[m⁻²\].
    information: [[f32; 4]; 3],
    /// Log-odds of the cell in the middle of each, in units; all 0 around a distribution that was forgotten.
    units: [i8; 4],
}

impl Quad {
    /// Four of which nothing is known. A distribution infinitely far away stands for none, so that all are computed alike.
    const UNKNOWN: Self = Self { mean: [[f32::MAX; 4]; 2], information: [[1.0; 4], [0.0; 4], [1.0; 4]], units: [0; 4] };

    /// Of these places in these tiles; `None` is a tile nobody has written to. With `forgets`, a distribution that was seen
    /// through is none, and around it nothing is known: that beams ended there and that beams passed contradict each other.
    #[inline]
    pub fn of<const CELLS_PER_NDT: usize>(cells: [(Option<&Tile<CELLS_PER_NDT>>, usize); 4], forgets: bool) -> Self {
        let (mut quad, mut forgotten) = (Self::UNKNOWN, false);
        for (k, (tile, local)) in cells.into_iter().enumerate() {
            let Some(tile) = tile else { continue };
            quad.units[k] = tile.middle(local);
            let Some(&NdtCell { mean: [x, y], information: [xx, xy, yy], .. }) = tile.ndt_cell(local) else { continue };
            if forgets && tile.is_seen_through(local) {
                forgotten = true;
            } else {
                (quad.mean[0][k], quad.mean[1][k]) = (x, y);
                (quad.information[0][k], quad.information[1][k], quad.information[2][k]) = (xx, 2.0 * xy, yy);
            }
        }
        if forgotten {
            quad.units = Self::UNKNOWN.units;
        }
        quad
    }

    /// (p − mean)ᵀ Σ′⁻¹ (p − mean) of a point by each of the four, whose centres lie `size` \[m\] apart: infinite where there is no
    /// distribution.
    #[inline]
    pub fn mahalanobis2(&self, corner: &Corner, size: f32) -> [f32; 4] {
        let [x, y] = corner.offset;
        let (x, y) = ([x, x, x - size, x - size], [y, y - size, y, y - size]);
        let ([mean_x, mean_y], [xx, xy2, yy]) = (&self.mean, &self.information);
        core::array::from_fn(|k| {
            let (dx, dy) = (x[k] - mean_x[k], y[k] - mean_y[k]);
            xx[k] * dx * dx + xy2[k] * dx * dy + yy[k] * dy * dy
        })
    }

    /// Log-odds in units of the middle of the point's own NDT cell.
    #[inline]
    pub fn units_at(&self, Corner { own: [right, above], .. }: &Corner) -> i8 {
        self.units[2 * usize::from(*right) + usize::from(*above)]
    }
}

/// The least of four.
#[inline]
pub(super) fn least([a, b, c, d]: [f32; 4]) -> f32 {
    // Not `f32::min`: a call of a library on WebAssembly.
    let least = |a: f32, b: f32| if b < a { b } else { a };
    least(least(a, c), least(b, d))
}
