//! The words of drawing: each puts one mark into a scene.
//!
//! None that makes a mark is inlined: there are hundreds of calls, and what a call takes every page loads.

use super::{Anchor, Cells, Mark, Point, Rect, Role, Scene, Shading, Text};
use crate::font::{self, Weight};

/// How a line of text looks, and which end of it stays in its place.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Letters {
    /// Font size \[css px\].
    pub size: f64,
    /// Font weight.
    pub weight: Weight,
    /// Its meaning.
    pub role: Role,
    /// Where in its box.
    pub anchor: Anchor,
}

/// Letters of this size \[css px\], from the left.
pub const fn plain(size: f64, role: Role) -> Letters {
    Letters { size, weight: Weight::Regular, role, anchor: Anchor::Start }
}

/// Bold letters of this size \[css px\], from the left.
pub const fn strong(size: f64, role: Role) -> Letters {
    Letters { size, weight: Weight::SemiBold, role, anchor: Anchor::Start }
}

impl Letters {
    /// The same, centred.
    pub const fn middle(self) -> Self {
        self.at(Anchor::Middle)
    }

    /// The same, up to the right.
    pub const fn end(self) -> Self {
        self.at(Anchor::End)
    }

    /// The same, where this end of it stays in its place.
    pub const fn at(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// Width of a line of them \[css px\].
    pub fn width(&self, text: &str) -> f64 {
        font::measure(text, self.size, self.weight)
    }

    /// The first of these texts, from long to short, that is no wider than this \[css px\].
    pub fn fitting<'a, T: AsRef<str>>(&self, width: f64, texts: &'a [T]) -> Option<&'a str> {
        texts.iter().map(AsRef::as_ref).find(|text| self.width(text) <= width)
    }
}

impl Scene {
    /// A line through points.
    #[inline(never)]
    pub fn line(&mut self, points: &[Point], width: f64, role: Role) {
        self.strokes(vec![points.to_vec()], width, None, role);
    }

    /// A line of dashes: the lengths of a dash and of a gap \[css px\].
    #[inline(never)]
    pub fn dash(&mut self, points: &[Point], width: f64, dash: [f64; 2], role: Role) {
        self.strokes(vec![points.to_vec()], width, Some(dash), role);
    }

    /// Lines of one kind.
    #[inline(never)]
    pub fn lines(&mut self, lines: Vec<Vec<Point>>, width: f64, role: Role) {
        self.strokes(lines, width, None, role);
    }

    /// Lines of dashes, likewise.
    #[inline(never)]
    pub fn dashed(&mut self, lines: Vec<Vec<Point>>, width: f64, dash: [f64; 2], role: Role) {
        self.strokes(lines, width, Some(dash), role);
    }

    /// Lines of one kind, dashed or not.
    #[inline(never)]
    pub fn strokes(&mut self, lines: Vec<Vec<Point>>, width: f64, dash: Option<[f64; 2]>, role: Role) {
        self.marks.push(Mark::Lines { lines, width, dash, role });
    }

    /// A cross from corner to corner of a rectangle.
    #[inline(never)]
    pub fn cross(&mut self, Rect { x, y, w, h }: Rect, width: f64, role: Role) {
        self.lines(vec![vec![[x, y], [x + w, y + h]], vec![[x, y + h], [x + w, y]]], width, role);
    }

    /// A filled rectangle.
    #[inline(never)]
    pub fn fill(&mut self, area: Rect, role: Role) {
        self.marks.push(Mark::Fill { area, role });
    }

    /// The border of a rectangle, inside of its edges.
    #[inline(never)]
    pub fn frame(&mut self, area: Rect, width: f64, role: Role) {
        self.marks.push(Mark::Frame { area, width, role });
    }

    /// A filled disc.
    #[inline(never)]
    pub fn disc(&mut self, centre: Point, radius: f64, role: Role) {
        self.discs(vec![centre], radius, role);
    }

    /// What is grasped: a disc with a rim.
    #[inline(never)]
    pub fn knob(&mut self, at: Point, radius: f64, role: Role) {
        self.disc(at, radius + 1.5, Role::Paper);
        self.disc(at, radius, role);
    }

    /// Filled discs of one kind.
    #[inline(never)]
    pub fn discs(&mut self, centres: Vec<Point>, radius: f64, role: Role) {
        self.marks.push(Mark::Discs { centres, radius, role });
    }

    /// A filled polygon.
    #[inline(never)]
    pub fn polygon(&mut self, corners: Vec<Point>, role: Role) {
        self.polygons(vec![corners], role);
    }

    /// Filled polygons of one kind.
    #[inline(never)]
    pub fn polygons(&mut self, polygons: Vec<Vec<Point>>, role: Role) {
        self.marks.push(Mark::Polygons { polygons, role });
    }

    /// A rectangle of cells.
    #[inline(never)]
    pub fn raster(&mut self, area: Rect, cells: Cells, shading: Shading) {
        self.marks.push(Mark::Raster { area, cells, shading });
    }

    /// A line of text, shortened with "…" if it is too long for its box.
    #[inline(never)]
    pub fn text(&mut self, area: Rect, letters: Letters, text: &str) {
        let Letters { size, weight, role, anchor } = letters;
        self.marks.push(Mark::Text(Text::new(area, anchor, size, weight, role, text)));
    }

    /// The first of these texts, from long to short, that has room in its box; where none has, the last, shortened.
    pub fn fit<T: AsRef<str>>(&mut self, area: Rect, letters: Letters, texts: &[T]) {
        self.text(area, letters, letters.fitting(area.w, texts).unwrap_or(texts.last().map_or("", AsRef::as_ref)));
    }
}
