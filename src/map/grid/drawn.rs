//! A map that was drawn: read back from the picture and the YAML file of ROS's `map_server`.

use super::{CellRect, Grid, GridModel, MapImage, tile};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::ops;

/// What the greys between the thresholds of a [`MapReading`] are taken for.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, strum::EnumString, strum::VariantNames)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_mode)]
pub enum GreyMode {
    /// Unknown: `trinary`.
    #[default]
    Trinary,
    /// As likely occupied as they are dark, from 0 at `free_thresh` to 1 at `occupied_thresh`: `scale`. In a picture without transparency nothing is unknown then.
    Scale,
}

fn unknown_mode(given: &str) -> SettingError {
    SettingError::unknown_word("mode", given, <GreyMode as strum::VariantNames>::VARIANTS)
}

/// What the YAML file beside a picture says of it, by the names of ROS's `map_server`.
///
/// A grey g has the share of black s = (255 − g) / 255, or g / 255 where it is negated. A cell is occupied where s > `occupied_thresh`, free where
/// s < `free_thresh`, and by [`GreyMode`] in between.
///
/// Reference: `map_server`, packages `map_server` of ROS 1 (`image_loader.cpp`) and `nav2_map_server` of ROS 2 (`map_io.cpp`).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MapReading {
    /// What greys between the thresholds are.
    pub mode: GreyMode,
    /// Side of a cell \[m\], in [`Self::RESOLUTION`].
    pub resolution: f64,
    /// World frame of the lower left corner of the picture, and by how much the picture is turned to the left \[m, m, rad\].
    pub origin: Pose2,
    /// Whether white is occupied.
    pub negate: bool,
    /// Above this share of black a cell is occupied, in [`Self::SHARE`] and above [`Self::free_thresh`].
    pub occupied_thresh: f64,
    /// Below this share of black a cell is free, in [`Self::SHARE`].
    pub free_thresh: f64,
}

impl MapReading {
    /// Range of [`Self::resolution`].
    pub const RESOLUTION: Range = Range::number(0.02, 0.2, "m");
    /// Range of the coordinates of [`Self::origin`].
    pub const ORIGIN: Range = Range::number(-1e6, 1e6, "m, m, rad");
    /// Range of [`Self::occupied_thresh`] and [`Self::free_thresh`].
    pub const SHARE: Range = Range::number(0.0, 1.0, "");

    /// Whether every value is in its range.
    ///
    /// # Errors
    /// [`SettingError`] of the first that is not, by its name in the YAML file.
    pub fn validate(&self) -> Result<(), SettingError> {
        Self::RESOLUTION.check("resolution", self.resolution)?;
        for coordinate in [self.origin.x, self.origin.y, self.origin.theta] {
            Self::ORIGIN.check("origin", coordinate)?;
        }
        Self::SHARE.check("free_thresh", self.free_thresh)?;
        Self::SHARE.check("occupied_thresh", self.occupied_thresh)?;
        if self.free_thresh > self.occupied_thresh {
            return Err(SettingError::Unfit { field: "free_thresh", allowed: "at most occupied_thresh" });
        }
        Ok(())
    }

    /// Probability that a cell of this grey is occupied; `None` where nothing is known of it.
    pub fn occupied(&self, grey: u8) -> Option<f64> {
        let share = f64::from(if self.negate { grey } else { 255 - grey }) / 255.0;
        match self.mode {
            _ if share > self.occupied_thresh => Some(1.0),
            _ if share < self.free_thresh => Some(0.0),
            GreyMode::Trinary => None,
            GreyMode::Scale => {
                Some((share - self.free_thresh) / (self.occupied_thresh - self.free_thresh).max(f64::MIN_POSITIVE))
            }
        }
    }
}

/// What is wrong with a file that is to be a picture in the format PGM.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PgmError {
    /// It does not begin as one.
    #[error("expected a picture in binary PGM, which begins with P5")]
    Kind,
    /// A number of its head is not there, or not in its range.
    #[error(transparent)]
    Head(#[from] SettingError),
    /// It breaks off.
    #[error("expected {needed} bytes of greys, found {found}")]
    Short {
        /// How many there are.
        found: usize,
        /// How many there must be.
        needed: usize,
    },
}

impl MapImage {
    /// The picture of a binary PGM file of at most 255 greys, which are stretched to 255. The file does not say where it is and how large a cell is: see [`MapReading`].
    ///
    /// # Errors
    /// Where it is no such file.
    pub fn from_pgm(file: &[u8], reading: &MapReading) -> Result<Self, PgmError> {
        let mut rest = file.strip_prefix(b"P5").ok_or(PgmError::Kind)?;
        let mut number = |field, range: Range| {
            loop {
                rest = rest.trim_ascii_start();
                if !rest.starts_with(b"#") {
                    break;
                }
                rest = &rest[rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len())..];
            }
            let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
            let (word, after) = rest.split_at(digits);
            rest = after;
            let value = core::str::from_utf8(word).ok().and_then(|word| word.parse().ok()).unwrap_or(f64::NAN);
            range.check(field, value)
        };
        let side = Range::whole(1, 65_535);
        let (width, height) = (number("width", side)? as u32, number("height", side)? as u32);
        let most = number("maxval", Range::whole(1, 255))? as u32;
        // One white space, and then the greys.
        let greys = rest.get(1..).unwrap_or_default();
        let needed = width as usize * height as usize;
        let greys = greys.get(..needed).ok_or(PgmError::Short { found: greys.len(), needed })?;
        Ok(Self {
            width,
            height,
            origin: [reading.origin.x, reading.origin.y],
            cell_size: reading.resolution,
            grey: greys.iter().map(|grey| (u32::from(*grey).min(most) * 255 / most) as u8).collect(),
        })
    }
}

impl<const CELLS_PER_NDT: usize> Grid<CELLS_PER_NDT> {
    /// A map as a picture shows it, in the frame of the picture: its origin is the lower left corner, and it is not turned.
    ///
    /// The log-odds of a cell are those of its probability, within the bounds of the model. Each cell that is more likely occupied than not counts as one end point, in
    /// its middle: where in a cell a wall is, a picture does not say. So a scan is matched to about half a cell as well as in the map that was drawn.
    ///
    /// # Errors
    /// Where model or reading are out of their ranges, or speak of cells of two sizes.
    pub fn drawn(model: GridModel, image: &MapImage, reading: &MapReading) -> Result<Self, SettingError> {
        model.validate()?;
        reading.validate()?;
        if model.cell_size != reading.resolution {
            return Err(SettingError::Unfit { field: "cell_size", allowed: "the resolution of the picture" });
        }
        let [width, height] = [image.width, image.height].map(|side| side as i32);
        let mut grid = Self::new(model);
        let tiles = |side: i32| (side - 1).div_euclid(Self::TILE_CELLS) + 1;
        grid.grow(CellRect { i0: 0, j0: 0, i1: tiles(width), j1: tiles(height) });
        let [free, occupied] = model.log_odds_bounds.map(tile::units);
        let known = |grey: u8| {
            let p = reading.occupied(grey)?;
            Some((p > 0.5, tile::units(ops::ln(p / (1.0 - p))).clamp(free, occupied)))
        };
        let half = 0.5 * grid.ndt_size;
        let by_grey: Vec<_> = (0..=255).map(known).collect();
        let [ndt_std, stretch] = [model.ndt_std, model.ndt_stretch].map(|c| c as f32);
        for (row, greys) in (0..height).rev().zip(image.grey.chunks(width.max(1) as usize)) {
            for (column, grey) in (0..width).zip(greys) {
                let Some((is_hit, units)) = by_grey[usize::from(*grey)] else { continue };
                let [i, j] = [column, row].map(|k| k.div_euclid(Self::NDT));
                let [di, dj] = [column, row].map(|k| k.rem_euclid(Self::NDT) as usize);
                let tile =
                    grid.tile_mut(i >> tile::SHIFT, j >> tile::SHIFT).expect("it was grown to cover the picture");
                let local = tile::local(i, j);
                *tile.units_mut(local, [di, dj]) = units;
                let offset = [di, dj].map(|k| ((k as f64 + 0.5) * model.cell_size - half) as f32);
                if is_hit && tile.add_hit(local, offset, ndt_std, stretch) && model.distance_reach > 0 {
                    grid.lower_distance(i, j);
                }
            }
        }
        Ok(grid)
    }
}
