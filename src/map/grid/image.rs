//! A map as other programs read it: a grey picture and what ROS's `map_server` has to know of it.

use super::{CellRect, Grid};
use crate::log::fixed;
use crate::ops;

/// Grey of occupied, free and unknown cells in a map of ROS, as `map_saver` writes them.
const OCCUPIED: u8 = 0;
const FREE: u8 = 254;
const UNKNOWN: u8 = 205;

/// Probabilities from which on, and up to which, ROS takes a cell for occupied, and for free.
const THRESHOLDS: [f64; 2] = [0.65, 0.25];

/// A map as a picture: a grey for each cell, row by row from the top (largest y).
#[derive(Clone, PartialEq, Debug)]
pub struct MapImage {
    /// Cells in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// World frame of the lower left corner of the lowest row \[m\].
    pub origin: [f64; 2],
    /// Side of a cell \[m\].
    pub cell_size: f64,
    /// 0 (black) for occupied, 254 for free, 205 for unknown cells.
    pub grey: Vec<u8>,
}

impl MapImage {
    /// The part of a map of which something is known; where nothing is, a single cell.
    pub fn of<const CELLS_PER_NDT: usize>(map: &Grid<CELLS_PER_NDT>) -> Self {
        let all = map.bounds();
        let mut known: Option<CellRect> = None;
        for (i, j) in (all.j0..all.j1).flat_map(|j| (all.i0..all.i1).map(move |i| (i, j))) {
            if map.log_odds(i, j) != 0.0 {
                let CellRect { i0, j0, i1, j1 } = known.unwrap_or(CellRect { i0: i, j0: j, i1: i + 1, j1: j + 1 });
                known = Some(CellRect { i0: i0.min(i), j0: j0.min(j), i1: i1.max(i + 1), j1: j1.max(j + 1) });
            }
        }
        let cells = known.unwrap_or(CellRect { i0: 0, j0: 0, i1: 1, j1: 1 });
        let [occupied, free] = THRESHOLDS.map(|p| ops::ln(p / (1.0 - p)));
        let grey = |(i, j)| match map.log_odds(i, j) {
            x if x >= occupied => OCCUPIED,
            x if x <= free => FREE,
            _ => UNKNOWN,
        };
        let places = (cells.j0..cells.j1).rev().flat_map(|j| (cells.i0..cells.i1).map(move |i| (i, j)));
        let (cell_size, origin) = (map.cell_size(), [cells.i0, cells.j0].map(|k| f64::from(k) * map.cell_size()));
        let [width, height] = [cells.width(), cells.height()].map(|side| side as u32);
        Self { width, height, origin, cell_size, grey: places.map(grey).collect() }
    }

    /// As a file in the format PGM.
    pub fn pgm(&self) -> Vec<u8> {
        let mut file = format!("P5\n{} {}\n255\n", self.width, self.height).into_bytes();
        file.extend(&self.grey);
        file
    }

    /// What `map_server` has to know of that file, which is called `image`.
    pub fn yaml(&self, image: &str) -> String {
        let ([x, y], [occupied, free]) = (self.origin.map(|metres| fixed(metres, 6)), THRESHOLDS);
        // Quoted, because a name may hold anything.
        let image = image.replace('\\', "\\\\").replace('"', "\\\"");
        format!(
            "image: \"{image}\"\nresolution: {}\norigin: [{x}, {y}, 0.0]\nnegate: 0\noccupied_thresh: {occupied}\nfree_thresh: {free}\n",
            self.cell_size
        )
    }
}
