//! The painter: a scene, a theme and a number of device pixels in, opaque RGBA out, the same bytes on every machine.
//!
//! Maps, borders and plates are written straight into whole device pixels, which is crisp; lines and glyphs are outlines, filled
//! by exact coverage.

mod blit;
mod coverage;
mod outline;
mod pixels;
mod theme;

pub use pixels::Pixels;
pub use theme::{Rgb, Theme};

use crate::{
    font,
    scene::{Mark, Point, Rect, Role, Scene, Shading, Text},
};
use coverage::Coverage;

/// Largest width and height of a canvas \[device px\].
pub const MAX_SIDE: u32 = 8192;

/// Reusable pixels.
#[derive(Default)]
pub struct Canvas {
    pixels: Pixels,
    coverage: Coverage,
}

impl Canvas {
    /// RGBA, row by row; every pixel is opaque.
    pub fn pixels(&self) -> &[u8] {
        self.pixels.bytes()
    }

    /// Width and height \[device px\].
    pub fn size(&self) -> [u32; 2] {
        self.pixels.size()
    }

    /// Paints the scene over a canvas of this size \[device px\], 1 to [`MAX_SIDE`]; the scene's width fills the canvas's.
    pub fn paint(&mut self, scene: &Scene, width: u32, height: u32, theme: Theme) {
        let size = [width.clamp(1, MAX_SIDE), height.clamp(1, MAX_SIDE)];
        self.pixels.clear(size, theme.color(Role::Paper));
        self.coverage.resize(size);
        let scale = f64::from(size[0]) / scene.width;
        let shades = [Shading::Map, Shading::Ghost].map(|shading| theme.shades(shading));
        let mut brush = Brush { canvas: self, scale, theme, shades };
        scene.marks.iter().for_each(|mark| brush.mark(mark));
    }
}

/// A canvas, device pixels per css px, and the colours.
struct Brush<'a> {
    canvas: &'a mut Canvas,
    scale: f64,
    theme: Theme,
    shades: [[Rgb; 256]; 2],
}

impl Brush<'_> {
    fn mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Raster { area, cells, shading } => {
                let area = self.device(area);
                blit::raster(&mut self.canvas.pixels, area, cells, &self.shades[*shading as usize]);
            }
            Mark::Fill { area, role } => {
                let area = self.device(area);
                self.fill_rect(area, *role);
            }
            Mark::Frame { area, width, role } => self.frame(area, *width, *role),
            Mark::Lines { lines, width, dash, role } => {
                lines.iter().for_each(|line| self.line(line, *width, *dash));
                self.fill(*role);
            }
            Mark::Polygons { polygons, role } => {
                for polygon in polygons {
                    for (k, &corner) in polygon.iter().enumerate() {
                        let corner = self.at(corner);
                        if k == 0 { self.canvas.coverage.move_to(corner) } else { self.canvas.coverage.line_to(corner) }
                    }
                    self.canvas.coverage.close();
                }
                self.fill(*role);
            }
            Mark::Discs { centres, radius, role } => {
                for &centre in centres {
                    let centre = self.at(centre);
                    outline::disc(&mut self.canvas.coverage, centre, radius * self.scale);
                }
                self.fill(*role);
            }
            Mark::Text(text) => self.text(text),
        }
    }

    /// Fills what was outlined.
    fn fill(&mut self, role: Role) {
        self.canvas.coverage.fill(&mut self.canvas.pixels, self.theme.color(role));
    }

    fn line(&mut self, points: &[Point], width: f64, dash: Option<[f64; 2]>) {
        let points: Vec<Point> = points.iter().map(|&p| self.at(p)).collect();
        let width = width * self.scale;
        let round = width > 1.5; // below, nobody sees the shape of an end
        match dash {
            None => outline::stroke(&mut self.canvas.coverage, &points, width, round),
            Some(dash) => {
                for piece in outline::dashes(&points, dash.map(|d| d * self.scale)) {
                    outline::stroke(&mut self.canvas.coverage, &piece, width, false);
                }
            }
        }
    }

    fn text(&mut self, text: &Text) {
        let [x, y] = self.at(text.origin());
        // On whole device pixels, so that the same word has the same pixels wherever it stands.
        let (x, y) = ((x + 0.5).floor(), (y + 0.5).floor());
        let size = text.size * self.scale;
        let coverage = &mut self.canvas.coverage;
        let mut last = [x, y];
        font::outline(&text.text, text.weight, |pen, segment| {
            let at = |[u, v]: [f64; 2]| [x + (pen + u) * size, y - v * size];
            match segment {
                font::Segment::Move(p) => {
                    last = at(p);
                    coverage.move_to(last);
                }
                font::Segment::Line(p) => {
                    last = at(p);
                    coverage.line_to(last);
                }
                font::Segment::Quad(c, p) => {
                    outline::quad(coverage, [last, at(c), at(p)]);
                    last = at(p);
                }
                font::Segment::Cubic(c, d, p) => {
                    outline::cubic(coverage, [last, at(c), at(d), at(p)]);
                    last = at(p);
                }
                font::Segment::Close => coverage.close(),
            }
        });
        self.fill(text.role);
    }

    fn at(&self, [x, y]: Point) -> Point {
        [x * self.scale, y * self.scale]
    }

    /// Edges on whole device pixels.
    fn device(&self, area: &Rect) -> blit::Area {
        let at = |x: f64| (x * self.scale + 0.5).floor() as i32;
        blit::Area { x0: at(area.x), y0: at(area.y), x1: at(area.right()), y1: at(area.bottom()) }
    }

    fn fill_rect(&mut self, area: blit::Area, role: Role) {
        blit::fill(&mut self.canvas.pixels, area, self.theme.color(role));
    }

    fn frame(&mut self, area: &Rect, width: f64, role: Role) {
        let blit::Area { x0, y0, x1, y1 } = self.device(area);
        let d = ((width * self.scale + 0.5).floor() as i32).max(1);
        self.fill_rect(blit::Area { x0, y0, x1, y1: y0 + d }, role);
        self.fill_rect(blit::Area { x0, y0: y1 - d, x1, y1 }, role);
        self.fill_rect(blit::Area { x0, y0: y0 + d, x1: x0 + d, y1: y1 - d }, role);
        self.fill_rect(blit::Area { x0: x1 - d, y0: y0 + d, x1, y1: y1 - d }, role);
    }
}
