//! What a scan's end point is compared with: the distributions of the four NDT cells around it.

use super::tile::{NdtCell, Tile};
use wide::{f32x4, i32x4};

/// Where points lie among the NDT cells: each between the centres of four of them.
pub(super) struct Corners {
    /// The lower left of the four, its column and its row.
    pub cell: [i32x4; 2],
    /// From its centre to the point \[m\], in single precision, as distributions are kept.
    pub offset: [f32x4; 2],
    /// Which of the four the point lies in.
    pub own: i32x4,
}

/// Four NDT cells around a corner: lower left, lower right, upper left, upper right. Their distributions lie number by number side by side,
/// so that one vector instruction does the same to all four.
#[derive(Clone)]
pub(super) struct Quad {
    /// Means relative to the centre of their own cell: x of all four, then y \[m\].
    mean: [f32x4; 2],
    /// Σ′⁻¹ xx, twice xy, and yy \[m⁻²\].
    information: [f32x4; 3],
    /// Log-odds of the cell in the middle of each, in units; all 0 around a distribution that was forgotten.
    units: [i8; 4],
}

impl Quad {
    /// Four of which nothing is known. A distribution infinitely far away stands for none, so that all are computed alike.
    pub const UNKNOWN: Self = Self {
        mean: [f32x4::new([f32::MAX; 4]); 2],
        information: [f32x4::ONE, f32x4::ZERO, f32x4::ONE],
        units: [0; 4],
    };

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
                for (lanes, number) in quad.mean.iter_mut().zip([x, y]) {
                    lanes.as_array_mut()[k] = number;
                }
                for (lanes, number) in quad.information.iter_mut().zip([xx, 2.0 * xy, yy]) {
                    lanes.as_array_mut()[k] = number;
                }
            }
        }
        if forgotten {
            quad.units = Self::UNKNOWN.units;
        }
        quad
    }

    /// Of a point, by each of the four whose centres lie so far apart \[m\]: (p − mean)ᵀ Σ′⁻¹ (p − mean), infinite where there is no
    /// distribution. And the log-odds in units of the middle of its own NDT cell.
    #[inline(always)]
    pub fn at(&self, lane: usize, corners: &Corners, apart: &Apart) -> (f32x4, i8) {
        let [x, y] = corners.offset.map(|lanes| f32x4::splat(lanes.to_array()[lane]));
        let [mean_x, mean_y] = self.mean;
        let [xx, xy2, yy] = self.information;
        let (dx, dy) = (x - apart.x - mean_x, y - apart.y - mean_y);
        (xx * dx * dx + xy2 * dx * dy + yy * dy * dy, self.units[corners.own.to_array()[lane] as usize & 3])
    }
}

/// How far the centres of four NDT cells lie from that of the lower left \[m\].
#[derive(Clone, Copy)]
pub(super) struct Apart {
    x: f32x4,
    y: f32x4,
}

impl Apart {
    /// Of cells of this size \[m\].
    #[inline]
    pub fn new(size: f32) -> Self {
        Self { x: f32x4::new([0.0, size, 0.0, size]), y: f32x4::new([0.0, 0.0, size, size]) }
    }
}

/// The least of each of four times four.
#[inline]
pub(super) fn least(four: [f32x4; 4]) -> f32x4 {
    let [a, b, c, d] = f32x4::transpose(four);
    a.fast_min(b).fast_min(c.fast_min(d))
}
