//! What is to be seen, as data: marks with roles instead of colours, lengths in css px, x right and y down.
//!
//! A scene is a pure function of a model and a size. It can be tested without looking at a pixel, told in words, and
//! painted in any theme.

mod chart;
mod clip;
mod formula;
mod handle;
mod ink;
mod legend;
mod lens;
mod marker;
mod parts;
mod plane;
mod rect;
mod scale_bar;
mod shape;
mod stack;
mod text;

pub use crate::parts;
pub use chart::{Chart, GHOST};
pub use clip::{clip_polyline, joined, thinned};
pub use formula::{Formula, number};
pub use handle::Handle;
pub use ink::{Letters, plain, strong};
pub use legend::{LINE, Sample, legend};
pub use lens::lens;
pub use marker::{RIM, diamond};
pub use parts::Parts;
pub use parts::{assert_laid_out, assert_on_screens};
pub use plane::Plane;
pub use rect::Rect;
pub use rect::assert_apart;
pub use shape::{NINE_TENTHS, closed, ellipse};
pub use stack::Stack;
pub use text::{Anchor, HEADING, Text};

use core::ops::Range;
use serde::Serialize;

/// A point \[css px\].
pub type Point = [f64; 2];

/// What a mark means. Themes give each a colour.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Role {
    /// The background.
    Paper,
    /// Text and what must be seen first.
    Ink,
    /// Text of less weight.
    Muted,
    /// Lines that only part areas.
    Frame,
    /// The way of what the figure is about, and where it is now.
    Path,
    /// What truly happened: only the reader may see it.
    Truth,
    /// What was measured, before anything was made of it.
    Raw,
    /// What has just become a copy of something else.
    Copied,
    /// What has just died out.
    Extinct,
    /// What died out a while ago: from 0 (not seen any more) to 255 (as [`Role::Extinct`]).
    Fading(u8),
    /// The mean of the hits in a cell, drawn on an occupied cell.
    Hit,
    /// A border that tells a weight, from 0 (no weight) to 255 (full).
    Weight(u8),
    /// Samples of what was believed before a measurement.
    Prior,
    /// Samples of what is believed after it.
    Posterior,
    /// A thing that is observed, and what is known of it.
    Feature,
    /// One of several things that are followed side by side, from 0 on.
    Series(u8),
    /// One of three ways of doing the same that are compared, from 0 on.
    Variant(u8),
    /// One of many things that look alike, from 0 on: neighbours differ.
    Class(u8),
    /// What the reader moves or has switched on.
    Accent,
    /// A line that tells a size, from 0 (faint) to 255 (as [`Role::Ink`]).
    Level(u8),
}

/// How the cells of a raster are coloured.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shading {
    /// A map, from free over unknown to occupied.
    Map,
    /// One that died out: faded.
    Ghost,
    /// Absolute correlations, from 0 (none) to 255 (|ρ| = 1).
    Correlation,
    /// What many maps make of a cell: below [`SHARES`] from free to unknown, and from there on the share of them that have a wall in it,
    /// none to all. Where they differ most, at a half, it has the colour of disagreement.
    Share,
    /// A probability density, from 0 (nothing) to 255 (its peak), pale enough to draw on.
    Density,
    /// A glaze over what is there: where the shade is 0 that is left as it is.
    Glaze,
}

/// A rectangle of cells, row by row from the top.
#[derive(Clone, PartialEq, Debug)]
pub struct Cells {
    /// Number of cells in a row.
    pub columns: usize,
    /// Of a map, [`FREE`] to [`OCCUPIED`], [`UNKNOWN`] in the middle; else as its [`Shading`] says.
    pub shades: Vec<u8>,
}

impl Cells {
    /// Columns from left to right, and rows from the last one down to the first.
    pub fn of(columns: Range<i32>, rows: Range<i32>, shade: impl Fn(i32, i32) -> u8) -> Self {
        let mut shades = Vec::with_capacity(columns.len() * rows.len());
        for j in rows.rev() {
            shades.extend(columns.clone().map(|i| shade(i, j)));
        }
        Self { columns: columns.len(), shades }
    }

    /// One row of these shades.
    pub fn row(shades: &[u8]) -> Self {
        Self { columns: shades.len(), shades: shades.to_vec() }
    }
}

/// The shade of a cell that is surely free.
pub const FREE: u8 = 0;
/// The shade of a cell nobody looked at.
pub const UNKNOWN: u8 = 128;
/// The shade of a cell that is surely occupied.
pub const OCCUPIED: u8 = 255;

/// The first shade of [`Shading::Share`] that tells a share.
pub const SHARES: u8 = 65;

/// Log-odds \[nats\] at which a cell is drawn as surely free, and as surely occupied.
const SURE: [f64; 2] = [-1.5, 2.7];

/// The shade of a cell with these log-odds of being occupied \[nats\].
pub fn shade(log_odds: f64) -> u8 {
    // Square roots: the first looks matter more than the last, above all whether there was any.
    let (end, sure) = if log_odds < 0.0 { (FREE, SURE[0]) } else { (OCCUPIED, SURE[1]) };
    let t = (log_odds / sure).min(1.0).sqrt();
    (f64::from(UNKNOWN) + t * (f64::from(end) - f64::from(UNKNOWN))).round() as u8
}

/// Something to draw. Later marks cover earlier ones.
#[derive(Clone, PartialEq, Debug)]
pub enum Mark {
    /// A map, a matrix or a density.
    Raster {
        /// Where.
        area: Rect,
        /// What.
        cells: Cells,
        /// How.
        shading: Shading,
    },
    /// A filled rectangle.
    Fill {
        /// Where.
        area: Rect,
        /// Its meaning.
        role: Role,
    },
    /// The border of a rectangle, inside of its edges.
    Frame {
        /// Its outer edges.
        area: Rect,
        /// Thickness \[css px\].
        width: f64,
        /// Its meaning.
        role: Role,
    },
    /// Open polylines of one kind.
    Lines {
        /// Each one's points.
        lines: Vec<Vec<Point>>,
        /// Thickness \[css px\].
        width: f64,
        /// Lengths of dash and gap \[css px\]; `None` for solid.
        dash: Option<[f64; 2]>,
        /// Its meaning.
        role: Role,
    },
    /// Filled polygons of one kind.
    Polygons {
        /// Each one's corners.
        polygons: Vec<Vec<Point>>,
        /// Its meaning.
        role: Role,
    },
    /// Filled discs of one kind.
    Discs {
        /// Their centres.
        centres: Vec<Point>,
        /// \[css px\]
        radius: f64,
        /// Its meaning.
        role: Role,
    },
    /// One line of text.
    Text(Text),
}

/// A place that answers to a click or a tap.
#[derive(Clone, PartialEq, Debug)]
pub struct Region {
    /// Where.
    pub area: Rect,
    /// Argument of [`crate::view::View::pick`].
    pub target: u32,
}

/// Room that a picture leaves for the control of a parameter: beside what it changes, rather than among the others.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Room {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// Where.
    pub area: Rect,
}

/// Everything a figure shows.
#[derive(Clone, PartialEq, Debug)]
pub struct Scene {
    /// \[css px\]
    pub width: f64,
    /// \[css px\]
    pub height: f64,
    /// In the order of drawing.
    pub marks: Vec<Mark>,
    /// Disjoint.
    pub regions: Vec<Region>,
    /// What a reader can move.
    pub handles: Vec<Handle>,
    /// Where controls stand in the picture.
    pub rooms: Vec<Room>,
    /// The same in words.
    pub description: String,
}

impl Scene {
    /// Of this size \[css px\], with nothing in it yet; the same in words.
    pub fn new(width: f64, height: f64, description: String) -> Self {
        let (marks, regions, handles, rooms) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { width, height, marks, regions, handles, rooms, description }
    }

    /// What a click at this point \[css px\] picks.
    pub fn hit(&self, point: Point) -> Option<u32> {
        self.regions.iter().find(|r| r.area.contains(point)).map(|r| r.target)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shades_run_from_free_over_unknown_to_occupied() {
        assert_eq!([-4.0, 0.0, 4.0].map(shade), [FREE, UNKNOWN, OCCUPIED]);
        assert!(shade(-0.4) < UNKNOWN && shade(0.9) > UNKNOWN);
    }
}
