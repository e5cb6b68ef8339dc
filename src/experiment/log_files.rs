//! What other programs read of a mapped log: the path as TUM's benchmarks write it, the map as ROS's `map_server` does.

use super::log::LogRun;
use crate::decimal::{fixed, write};
use crate::ops;

/// Grey of occupied, free and unknown cells in a map of ROS, as `map_saver` writes them.
const OCCUPIED: u8 = 0;
const FREE: u8 = 254;
const UNKNOWN: u8 = 205;

/// From these log-odds on \[nats\] a cell is told to be occupied, or free: probabilities of 0.65 and 0.35.
const SURE: f64 = 0.62;

/// The best particle's path, a line for each pose: `time x y z qx qy qz qw`, in seconds, metres, and a unit quaternion.
pub fn trajectory(run: &LogRun) -> String {
    let mut text = String::from("# time x y z qx qy qz qw\n");
    for (time, pose) in run.path() {
        let (sin, cos) = ops::sin_cos(0.5 * pose.theta);
        let [x, y, qz, qw] = [pose.x, pose.y, sin, cos].map(|number| fixed(number, 6));
        text += &format!("{} {x} {y} 0 0 0 {qz} {qw}\n", fixed(time, 6));
    }
    text
}

/// A map as a picture: a grey for each cell, row by row from the top (largest y).
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
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

impl Picture {
    /// The best particle's map.
    pub fn of(run: &LogRun) -> Self {
        let map = run.map();
        let (bounds, cell_size) = (map.bounds(), map.cell_size());
        let mut grey = Vec::with_capacity(bounds.width() * bounds.height());
        for j in (bounds.j0..bounds.j1).rev() {
            grey.extend((bounds.i0..bounds.i1).map(|i| match map.log_odds(i, j) {
                x if x >= SURE => OCCUPIED,
                x if x <= -SURE => FREE,
                _ => UNKNOWN,
            }));
        }
        let origin = [bounds.i0, bounds.j0].map(|k| f64::from(k) * cell_size);
        Self { width: bounds.width() as u32, height: bounds.height() as u32, origin, cell_size, grey }
    }

    /// As a file in the format PGM.
    pub fn pgm(&self) -> Vec<u8> {
        let mut file = format!("P5\n{} {}\n255\n", self.width, self.height).into_bytes();
        file.extend(&self.grey);
        file
    }

    /// What `map_server` has to know of that file, which is called `image`.
    pub fn yaml(&self, image: &str) -> String {
        let [x, y] = self.origin.map(write);
        format!(
            "image: {image}\nresolution: {}\norigin: [{x}, {y}, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
            write(self.cell_size)
        )
    }
}
