//! Rectangles, and dividing them.

use super::Point;
use serde::Serialize;

/// An axis-parallel rectangle \[css px\].
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Rect {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub w: f64,
    /// Height.
    pub h: f64,
}

impl Rect {
    /// By its upper left corner and its size.
    pub const fn new(x: f64, y: f64, w: f64, h: f64) -> Self {
        Self { x, y, w, h }
    }

    /// A square about its middle, from there to its edges so long \[css px\].
    pub const fn around([x, y]: Point, half: f64) -> Self {
        Self::new(x - half, y - half, 2.0 * half, 2.0 * half)
    }

    /// Right edge.
    pub fn right(&self) -> f64 {
        self.x + self.w
    }

    /// Lower edge.
    pub fn bottom(&self) -> f64 {
        self.y + self.h
    }

    /// Middle.
    pub fn centre(&self) -> Point {
        [self.x + 0.5 * self.w, self.y + 0.5 * self.h]
    }

    /// With all lengths times a factor.
    pub fn scaled(&self, by: f64) -> Self {
        Self::new(self.x * by, self.y * by, self.w * by, self.h * by)
    }

    /// Smaller by `d` on every side; never less than nothing.
    pub fn inset(&self, d: f64) -> Self {
        Self::new(self.x + d, self.y + d, (self.w - 2.0 * d).max(0.0), (self.h - 2.0 * d).max(0.0))
    }

    /// True for points inside or on the left and upper edges.
    pub fn contains(&self, [x, y]: Point) -> bool {
        self.x <= x && x < self.right() && self.y <= y && y < self.bottom()
    }

    /// True if the two share more than an edge.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.x < other.right() && other.x < self.right() && self.y < other.bottom() && other.y < self.bottom()
    }

    /// True if `other` lies inside, give or take a thousandth of a px.
    pub fn encloses(&self, other: &Self) -> bool {
        let e = 1e-3;
        self.x <= other.x + e
            && self.y <= other.y + e
            && other.right() <= self.right() + e
            && other.bottom() <= self.bottom() + e
    }
}

/// That the parts of a layout lie inside of the figure, and nowhere over each other.
pub fn assert_apart(parts: &[Rect], figure: &Rect) {
    for (k, a) in parts.iter().enumerate() {
        assert!(figure.encloses(a), "{}: part {k}", figure.w);
        assert!(parts[..k].iter().all(|b| !a.overlaps(b)), "{}: part {k}", figure.w);
    }
}
