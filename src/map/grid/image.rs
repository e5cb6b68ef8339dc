//! A map as other programs read it: a grey picture and what ROS's `map_server` has to know of it.

use super::{CellRect, Grid, floor};
use crate::error::{Range, SettingError, fixed};
use crate::geometry::Pose2;
use crate::ops;

/// Greys of occupied, free and unknown cells in a map of ROS, as `map_saver` writes them.
const OCCUPIED: u8 = 0;
const FREE: u8 = 254;
const UNKNOWN: u8 = 205;

/// `occupied_thresh` and `free_thresh` of the YAML file, as `map_saver` of ROS 1 writes them. `map_server` reads a grey as the probability
/// (255 − grey) / 255: 1 for [`OCCUPIED`], 0.004 for [`FREE`], and 0.196078 for [`UNKNOWN`], which must not be below `free_thresh`.
const READ_BY: [f64; 2] = [0.65, 0.196];

/// Longest straight leg between two poses that the robot's circle is drawn along \[m\]: over more than this, nobody knows where it drove.
const LONGEST_LEG: f64 = 2.0;

/// Rules by which a map's cells are written as occupied, free or unknown, and the ground that the robot has covered as free.
///
/// A cell that was never seen is unknown. Any other has the probability p = 1 / (1 + exp(−L)) of being occupied, where L is
/// [`Grid::log_odds`]. Of a cell that was hit by h scans and passed by n, L = h L_hit + n L_pass within the bounds of the
/// [`GridModel`](super::GridModel), so p < 1/2 says that the share of hits h / (h + n) is below −L_pass / (L_hit − L_pass): 0.31 for the
/// mapper's grid. (gmapping compares that share with 0.25.)
///
/// ```
/// use fastslam::map::grid::MapImageSettings;
/// let settings = MapImageSettings { footprint_radius: 0.35, ..MapImageSettings::default() };
/// assert!(settings.validate().is_ok());
/// let error = MapImageSettings { free_threshold: 0.7, ..settings }.validate().unwrap_err();
/// assert_eq!(error.to_string(), "free_threshold = 0.7: must be a number from 0 to 0.5");
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MapImageSettings {
    /// Cells whose probability p is above this are occupied; in [`Self::OCCUPIED_THRESHOLD`]. By default one hit is enough.
    pub occupied_threshold: f64,
    /// Cells whose probability p is below this are free; in [`Self::FREE_THRESHOLD`]. By default one pass is enough.
    pub free_threshold: f64,
    /// Radius of the circle about the robot's origin that is free wherever the robot has been, whatever its scans say \[m\]; in
    /// [`Self::FOOTPRINT_RADIUS`], 0 for none. A radius larger than the robot's erases walls that it passed closely. The default, 0.2 m, is
    /// that of a small robot with a laser.
    pub footprint_radius: f64,
}

impl Default for MapImageSettings {
    fn default() -> Self {
        Self { occupied_threshold: 0.65, free_threshold: 0.5, footprint_radius: 0.2 }
    }
}

impl MapImageSettings {
    /// Range of [`Self::occupied_threshold`].
    pub const OCCUPIED_THRESHOLD: Range = Range::number(0.5, 1.0, "");
    /// Range of [`Self::free_threshold`].
    pub const FREE_THRESHOLD: Range = Range::number(0.0, 0.5, "");
    /// Range of [`Self::footprint_radius`].
    pub const FOOTPRINT_RADIUS: Range = Range::number(0.0, 5.0, "m");

    /// Whether every setting is in its range.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] of the first that is not, by the name of its field.
    pub fn validate(&self) -> Result<(), SettingError> {
        Self::OCCUPIED_THRESHOLD.check("occupied_threshold", self.occupied_threshold)?;
        Self::FREE_THRESHOLD.check("free_threshold", self.free_threshold)?;
        Self::FOOTPRINT_RADIUS.check("footprint_radius", self.footprint_radius).map(drop)
    }

    /// Grey of a cell with these log-odds \[nats\].
    fn grey(&self) -> impl Fn(f64) -> u8 + use<> {
        // p ↦ L never falls, so log-odds are compared and no exponential is taken a cell.
        let [occupied, free] = [self.occupied_threshold, self.free_threshold].map(|p| ops::ln(p / (1.0 - p)));
        move |log_odds| match log_odds {
            x if x > occupied => OCCUPIED,
            x if x < free => FREE,
            _ => UNKNOWN,
        }
    }
}

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
    /// The part of a map that was seen, or that the robot covered on the seen part of its path (times \[s\] and poses in the map's frame); a
    /// single cell where nothing was seen.
    ///
    /// The circle of [`MapImageSettings::footprint_radius`] is free at every pose and on the straight leg from one to the next, of up to 2 m: at
    /// places half a cell apart. A cell is in the circle when its centre is.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] where a setting is, by the name of its field.
    pub fn of<const CELLS_PER_NDT: usize>(
        map: &Grid<CELLS_PER_NDT>,
        path: &[(f64, Pose2)],
        settings: &MapImageSettings,
    ) -> Result<Self, SettingError> {
        let drawing = Drawing::new(map, path, settings)?;
        Ok(drawing.strip(drawing.cells))
    }

    /// The same in strips of so many rows, at least one, from the top: of a large map the whole picture would take as much memory as the map. First the whole
    /// without its greys, whose [`Self::pgm`] is what stands before them in a file.
    ///
    /// ```
    /// use fastslam::map::grid::{Grid, MapImage, MapImageSettings};
    /// use fastslam::{geometry::Pose2, map::ConditionalMap, sensor::BeamSensor};
    /// # let model = fastslam::mapper::LaserMapperSettings::default().grid();
    /// let mut map = Grid::<4>::new(model);
    /// map.assimilate(&Pose2::default(), &BeamSensor::panorama(90, 8.0, 0.0).scan(&[5.0; 90]), &());
    /// let settings = MapImageSettings::default();
    /// let (whole, strips) = MapImage::in_strips(&map, &[], &settings, 64)?;
    /// let mut file = whole.pgm();
    /// strips.for_each(|strip| file.extend(strip.grey));
    /// assert_eq!(file, MapImage::of(&map, &[], &settings)?.pgm());
    /// # Ok::<(), fastslam::error::SettingError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Self::of`].
    pub fn in_strips<'a, const CELLS_PER_NDT: usize>(
        map: &'a Grid<CELLS_PER_NDT>,
        path: &[(f64, Pose2)],
        settings: &MapImageSettings,
        rows: u32,
    ) -> Result<(Self, impl Iterator<Item = Self> + use<'a, CELLS_PER_NDT>), SettingError> {
        let drawing = Drawing::new(map, path, settings)?;
        let (all, rows) = (drawing.cells, rows.max(1) as usize);
        let strips = (all.j0..all.j1).rev().step_by(rows).map(move |top| {
            let j0 = top.saturating_add(1).saturating_sub_unsigned(rows as u32).max(all.j0);
            drawing.strip(CellRect { j0, j1: top + 1, ..all })
        });
        Ok((Self::without_greys(all, map.cell_size()), strips))
    }

    /// One of these cells, to be drawn.
    fn without_greys(cells: CellRect, cell_size: f64) -> Self {
        Self {
            width: cells.width() as u32,
            height: cells.height() as u32,
            origin: [cells.i0, cells.j0].map(|k| f64::from(k) * cell_size),
            cell_size,
            grey: Vec::new(),
        }
    }

    /// Makes the cells free whose centres are in a circle, both in cells from the lower left corner of the picture.
    fn clear(&mut self, [x, y]: [f64; 2], radius: f64) {
        let between = |low: f64, high: f64, most: u32| {
            (low - 0.5).ceil().max(0.0) as u32..((high + 0.5).floor() as u32).min(most)
        };
        for row in between(y - radius, y + radius, self.height) {
            let dy = f64::from(row) + 0.5 - y;
            let half = (radius * radius - dy * dy).max(0.0).sqrt();
            let columns = between(x - half, x + half, self.width);
            let first = ((self.height - 1 - row) * self.width) as usize;
            if !columns.is_empty() {
                self.grey[first + columns.start as usize..first + columns.end as usize].fill(FREE);
            }
        }
    }

    /// As a file in the format PGM.
    pub fn pgm(&self) -> Vec<u8> {
        let mut file = format!("P5\n{} {}\n255\n", self.width, self.height).into_bytes();
        file.extend(&self.grey);
        file
    }

    /// What `map_server` has to know of that file, which is called `image`.
    pub fn yaml(&self, image: &str) -> String {
        let ([x, y], [occupied, free]) = (self.origin.map(|metres| fixed(metres, 6)), READ_BY);
        // Quoted, because a name may hold anything.
        let image = image.replace('\\', "\\\\").replace('"', "\\\"");
        format!(
            "image: \"{image}\"\nmode: trinary\nresolution: {}\norigin: [{x}, {y}, 0.0]\nnegate: 0\noccupied_thresh: {occupied}\nfree_thresh: {free}\n",
            self.cell_size
        )
    }
}

/// A picture to be, of which any part can be drawn.
struct Drawing<'a, const CELLS_PER_NDT: usize> {
    map: &'a Grid<CELLS_PER_NDT>,
    settings: MapImageSettings,
    cells: CellRect,
    /// Where the robot's circle is drawn \[cells\].
    robot: Vec<[f64; 2]>,
    /// Of that \[cells\].
    radius: f64,
}

impl<'a, const CELLS_PER_NDT: usize> Drawing<'a, CELLS_PER_NDT> {
    fn new(
        map: &'a Grid<CELLS_PER_NDT>,
        path: &[(f64, Pose2)],
        settings: &MapImageSettings,
    ) -> Result<Self, SettingError> {
        settings.validate()?;
        let seen = seen(map);
        let radius = settings.footprint_radius / map.cell_size();
        let robot = if radius > 0.0 { places(path, map.cell_size(), seen) } else { Vec::new() };
        let cells = robot.iter().fold(seen, |cells, at| around(cells, *at, radius));
        Ok(Self { map, settings: *settings, cells, robot, radius })
    }

    /// These cells of it.
    fn strip(&self, cells: CellRect) -> MapImage {
        let grey = self.settings.grey();
        let mut image = MapImage::without_greys(cells, self.map.cell_size());
        image.grey.reserve_exact(cells.width() * cells.height());
        for j in (cells.j0..cells.j1).rev() {
            image.grey.extend((cells.i0..cells.i1).map(|i| grey(self.map.log_odds(i, j))));
        }
        for [x, y] in &self.robot {
            image.clear([x - f64::from(cells.i0), y - f64::from(cells.j0)], self.radius);
        }
        image
    }
}

/// The rectangle of cells that were seen; a single one where none was.
fn seen<const CELLS_PER_NDT: usize>(map: &Grid<CELLS_PER_NDT>) -> CellRect {
    let all = map.bounds();
    let cells = (all.j0..all.j1).flat_map(|j| (all.i0..all.i1).map(move |i| (i, j)));
    let seen = cells.filter(|(i, j)| map.log_odds(*i, *j) != 0.0).map(|(i, j)| CellRect {
        i0: i,
        j0: j,
        i1: i + 1,
        j1: j + 1,
    });
    seen.reduce(CellRect::united).unwrap_or(CellRect { i0: 0, j0: 0, i1: 1, j1: 1 })
}

/// The rectangle grown around a circle, both in cells.
fn around(cells: CellRect, [x, y]: [f64; 2], radius: f64) -> CellRect {
    let [i0, j0] = [x, y].map(|c| floor(c - radius));
    let [i1, j1] = [x, y].map(|c| floor(c + radius) + 1);
    cells.united(CellRect { i0, j0, i1, j1 })
}

/// Places of the robot on its path \[cells\], half a cell apart. Poses outside of `seen` are left out: a path without a map says nothing of
/// where it leads.
fn places(path: &[(f64, Pose2)], cell_size: f64, seen: CellRect) -> Vec<[f64; 2]> {
    let is_seen = |[x, y]: [f64; 2]| (seen.i0..seen.i1).contains(&floor(x)) && (seen.j0..seen.j1).contains(&floor(y));
    let mut places: Vec<[f64; 2]> = Vec::new();
    let mut last: Option<[f64; 2]> = None;
    for (_, pose) in path {
        let here = [pose.x, pose.y].map(|c| c / cell_size);
        if !(here.iter().all(|c| c.is_finite()) && is_seen(here)) {
            last = None;
            continue;
        }
        if let Some(last) = last {
            let way = [here[0] - last[0], here[1] - last[1]];
            let length = ops::hypot(way[0], way[1]);
            let parts = if length * cell_size <= LONGEST_LEG { (2.0 * length).ceil() as u32 } else { 0 };
            let at = |share: f64| [last[0] + share * way[0], last[1] + share * way[1]];
            places.extend((1..parts).map(|part| at(f64::from(part) / f64::from(parts))));
        }
        if last != Some(here) {
            places.push(here);
        }
        last = Some(here);
    }
    places
}
