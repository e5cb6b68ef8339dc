//! The painter: a scene, a theme and a number of device pixels in, opaque RGBA out, the same bytes on every machine.
//!
//! tiny-skia fills paths with whole-number coverage, in its low-precision pipeline for solid colours. Maps and borders are
//! written straight into the pixels, on whole device pixels, which is crisper and many times faster.

mod blit;
mod theme;

pub use theme::{Rgb, Theme};

use crate::{
    font,
    scene::{Mark, Point, Rect, Role, Scene, Text},
};
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};

/// Largest width and height of a canvas \[device px\].
pub const MAX_SIDE: u32 = 8192;

/// Reusable pixels.
pub struct Canvas {
    pixels: Pixmap,
    scratch: PathBuilder,
}

impl Default for Canvas {
    fn default() -> Self {
        Self { pixels: Pixmap::new(1, 1).expect("one pixel is a size"), scratch: PathBuilder::new() }
    }
}

impl Canvas {
    /// RGBA, row by row; every pixel is opaque.
    pub fn pixels(&self) -> &[u8] {
        self.pixels.data()
    }

    /// \[device px\]
    pub fn width(&self) -> u32 {
        self.pixels.width()
    }

    /// \[device px\]
    pub fn height(&self) -> u32 {
        self.pixels.height()
    }

    /// Paints the scene over a canvas of this size \[device px\], 1 to [`MAX_SIDE`]; the scene's width fills the canvas's.
    pub fn paint(&mut self, scene: &Scene, width: u32, height: u32, theme: Theme) {
        let (width, height) = (width.clamp(1, MAX_SIDE), height.clamp(1, MAX_SIDE));
        if (self.width(), self.height()) != (width, height) {
            self.pixels = Pixmap::new(width, height).expect("a side is 1 to 8192");
        }
        let [r, g, b] = theme.color(Role::Paper);
        self.pixels.fill(Color::from_rgba8(r, g, b, 255));
        let scale = f64::from(width) / scene.width;
        let mut brush = Brush { canvas: self, scale, theme };
        for mark in &scene.marks {
            brush.mark(mark);
        }
    }
}

/// A canvas, device pixels per css px, and the colours.
struct Brush<'a> {
    canvas: &'a mut Canvas,
    scale: f64,
    theme: Theme,
}

impl Brush<'_> {
    fn mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Raster { area, cells, shading } => {
                let area = self.device(area);
                blit::raster(&mut self.canvas.pixels, area, cells, &self.theme.shades(*shading));
            }
            Mark::Fill { area, role } => {
                let area = self.device(area);
                self.fill_rect(area, *role);
            }
            Mark::Frame { area, width, role } => self.frame(area, *width, *role),
            Mark::Lines { lines, width, dash, role } => {
                if let Some(path) = self.path(|brush, path| lines.iter().for_each(|l| brush.polyline(path, l))) {
                    self.stroke(&path, *width, *dash, *role);
                    self.canvas.scratch = path.clear();
                }
            }
            Mark::Polygons { polygons, role } => {
                let outline = |brush: &Self, path: &mut PathBuilder| {
                    for polygon in polygons {
                        brush.polyline(path, polygon);
                        path.close();
                    }
                };
                if let Some(path) = self.path(outline) {
                    self.fill(&path, *role);
                    self.canvas.scratch = path.clear();
                }
            }
            Mark::Discs { centres, radius, role } => {
                let outline = |brush: &Self, path: &mut PathBuilder| {
                    for &centre in centres {
                        let (x, y) = brush.at(centre);
                        path.push_circle(x, y, (radius * brush.scale) as f32);
                    }
                };
                if let Some(path) = self.path(outline) {
                    self.fill(&path, *role);
                    self.canvas.scratch = path.clear();
                }
            }
            Mark::Text(text) => self.text(text),
        }
    }

    /// Builds a path with the memory of the last one; `None` if nothing is to be drawn.
    fn path(&mut self, build: impl FnOnce(&Self, &mut PathBuilder)) -> Option<Path> {
        let mut path = core::mem::take(&mut self.canvas.scratch);
        build(self, &mut path);
        path.finish()
    }

    fn at(&self, [x, y]: Point) -> (f32, f32) {
        ((x * self.scale) as f32, (y * self.scale) as f32)
    }

    fn polyline(&self, path: &mut PathBuilder, points: &[Point]) {
        let mut points = points.iter().map(|&p| self.at(p));
        if let Some((x, y)) = points.next() {
            path.move_to(x, y);
            points.for_each(|(x, y)| path.line_to(x, y));
        }
    }

    fn text(&mut self, text: &Text) {
        let [x, y] = text.origin();
        // On whole device pixels, so that the same word has the same pixels wherever it stands.
        let (x, y) = ((x * self.scale).round() as f32, (y * self.scale).round() as f32);
        let size = (text.size * self.scale) as f32;
        let outline = |_: &Self, path: &mut PathBuilder| {
            font::outline(&text.text, text.weight, |pen, segment| {
                let at = |[u, v]: [f32; 2]| (x + (pen + u) * size, y - v * size);
                match segment {
                    font::Segment::Move(p) => {
                        let (x, y) = at(p);
                        path.move_to(x, y);
                    }
                    font::Segment::Line(p) => {
                        let (x, y) = at(p);
                        path.line_to(x, y);
                    }
                    font::Segment::Quad(c, p) => {
                        let ((x1, y1), (x, y)) = (at(c), at(p));
                        path.quad_to(x1, y1, x, y);
                    }
                    font::Segment::Cubic(c1, c2, p) => {
                        let ((x1, y1), (x2, y2), (x, y)) = (at(c1), at(c2), at(p));
                        path.cubic_to(x1, y1, x2, y2, x, y);
                    }
                    font::Segment::Close => path.close(),
                }
            });
        };
        if let Some(path) = self.path(outline) {
            self.fill(&path, text.role);
            self.canvas.scratch = path.clear();
        }
    }

    fn fill(&mut self, path: &Path, role: Role) {
        let paint = self.ink(role);
        self.canvas.pixels.fill_path(path, &paint, FillRule::Winding, Transform::identity(), None);
    }

    fn stroke(&mut self, path: &Path, width: f64, dash: Option<[f64; 2]>, role: Role) {
        let paint = self.ink(role);
        let round = width * self.scale > 1.5; // below, nobody sees the shape of an end
        let stroke = Stroke {
            width: (width * self.scale) as f32,
            line_cap: if round && dash.is_none() { LineCap::Round } else { LineCap::Butt },
            line_join: if round { LineJoin::Round } else { LineJoin::Bevel },
            dash: dash.and_then(|d| StrokeDash::new(d.map(|d| (d * self.scale) as f32).to_vec(), 0.0)),
            ..Stroke::default()
        };
        self.canvas.pixels.stroke_path(path, &paint, &stroke, Transform::identity(), None);
    }

    fn ink(&self, role: Role) -> Paint<'static> {
        let [r, g, b] = self.theme.color(role);
        let mut paint = Paint::default();
        paint.set_color_rgba8(r, g, b, 255);
        paint
    }

    /// Edges on whole device pixels.
    fn device(&self, area: &Rect) -> blit::Area {
        let at = |x: f64| (x * self.scale).round() as i32;
        blit::Area { x0: at(area.x), y0: at(area.y), x1: at(area.right()), y1: at(area.bottom()) }
    }

    fn fill_rect(&mut self, area: blit::Area, role: Role) {
        let color = self.theme.color(role);
        blit::fill(&mut self.canvas.pixels, area, color);
    }

    fn frame(&mut self, area: &Rect, width: f64, role: Role) {
        let blit::Area { x0, y0, x1, y1 } = self.device(area);
        let d = ((width * self.scale).round() as i32).max(1);
        self.fill_rect(blit::Area { x0, y0, x1, y1: y0 + d }, role);
        self.fill_rect(blit::Area { x0, y0: y1 - d, x1, y1 }, role);
        self.fill_rect(blit::Area { x0, y0: y0 + d, x1: x0 + d, y1: y1 - d }, role);
        self.fill_rect(blit::Area { x0: x1 - d, y0: y0 + d, x1, y1: y1 - d }, role);
    }
}
