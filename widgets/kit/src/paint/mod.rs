//! The painter: a scene, a theme and a number of device pixels in, opaque RGBA out, the same bytes on every machine.
//!
//! tiny-skia fills and strokes. All shapes of a mark are one path, because a path costs more to begin than to go on with. Maps,
//! borders and plates lie on whole device pixels, so that they are crisp.

mod raster;
mod theme;

use raster::Smaller;
pub use theme::{Rgb, Theme};

use crate::{
    font,
    scene::{Mark, Point, Rect, Role, Scene, Shading, Text},
};
use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, PremultipliedColorU8, Stroke, StrokeDash, Transform,
};

/// Largest width and height of a canvas \[device px\]: tiny-skia would paint a larger one in tiles.
pub const MAX_SIDE: u32 = 8191;

/// Lines wider than this \[device px\] have round joints and ends: of thinner ones nobody sees them, and they cost more than the line.
const ROUND: f32 = 1.5;

/// Lines thinner than this \[device px\] are at most 1 px wide: tiny-skia draws those several times as fast, and nobody sees the difference.
const HAIRLINE: f32 = 1.25;

/// Discs of a lesser radius \[device px\] are squares of the same area, which look the same: clouds have thousands, with a quarter of
/// the edges.
const TINY: f32 = 1.5;

/// Opacity of [`Shading::Glaze`], 0 to 255: what is behind it must still be read.
const GLAZE: u8 = 180;

/// Reusable pixels.
pub struct Canvas {
    pixmap: Pixmap,
}

impl Default for Canvas {
    fn default() -> Self {
        Self { pixmap: blank([1, 1]) }
    }
}

fn blank([width, height]: [u32; 2]) -> Pixmap {
    Pixmap::new(width, height).expect("sides from 1 to MAX_SIDE")
}

impl Canvas {
    /// RGBA, row by row; every pixel is opaque.
    pub fn pixels(&self) -> &[u8] {
        self.pixmap.data()
    }

    /// Width and height \[device px\].
    pub fn size(&self) -> [u32; 2] {
        [self.pixmap.width(), self.pixmap.height()]
    }

    /// Paints the scene over a canvas of this size \[device px\], 1 to [`MAX_SIDE`]; the scene's width fills the canvas's.
    pub fn paint(&mut self, scene: &Scene, width: u32, height: u32, theme: Theme) {
        let size = [width, height].map(|side| side.clamp(1, MAX_SIDE));
        if self.size() != size {
            self.pixmap = blank(size);
        }
        self.pixmap.pixels_mut().fill(glaze(theme.color(Role::Paper), 255));
        let scale = f64::from(size[0]) / scene.width;
        let all =
            [Shading::Map, Shading::Ghost, Shading::Correlation, Shading::Share, Shading::Density, Shading::Glaze];
        let shades = all.map(|shading| {
            let colors = theme.shades(shading);
            core::array::from_fn(|shade| glaze(colors[shade], opacity(shading, shade)))
        });
        let mut brush = Brush { pixmap: &mut self.pixmap, scale, theme, shades };
        scene.marks.iter().for_each(|mark| brush.mark(mark));
    }
}

/// Of a shade, 0 to 255.
fn opacity(shading: Shading, shade: usize) -> u8 {
    match shading {
        Shading::Glaze if shade == 0 => 0,
        Shading::Glaze => GLAZE,
        Shading::Map | Shading::Ghost | Shading::Correlation | Shading::Share | Shading::Density => 255,
    }
}

/// A colour of this opacity, 0 to 255.
fn glaze(color: Rgb, alpha: u8) -> PremultipliedColorU8 {
    let [r, g, b] = color.map(|c| ((u16::from(c) * u16::from(alpha) + 127) / 255) as u8);
    PremultipliedColorU8::from_rgba(r, g, b, alpha).expect("no channel exceeds the alpha")
}

fn disc(path: &mut PathBuilder, x: f32, y: f32, radius: f32) {
    let half = 0.5 * core::f32::consts::PI.sqrt() * radius;
    match tiny_skia::Rect::from_ltrb(x - half, y - half, x + half, y + half) {
        Some(square) if radius < TINY => path.push_rect(square),
        _ => path.push_circle(x, y, radius),
    }
}

/// Pixels, device pixels per css px, and the colours.
struct Brush<'a> {
    pixmap: &'a mut Pixmap,
    scale: f64,
    theme: Theme,
    shades: [[PremultipliedColorU8; 256]; 6],
}

impl Brush<'_> {
    fn mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Raster { area, cells, shading } => {
                let smaller = match shading {
                    Shading::Map | Shading::Ghost => Smaller::WallThenFree,
                    Shading::Share | Shading::Correlation | Shading::Density | Shading::Glaze => Smaller::Largest,
                };
                raster::draw(self.pixmap, self.device(area), cells, smaller, &self.shades[*shading as usize]);
            }
            Mark::Fill { area, role } => self.fill_rect(self.device(area), *role),
            Mark::Frame { area, width, role } => self.frame(area, *width, *role),
            Mark::Lines { lines, width, dash, role } => self.lines(lines, *width, *dash, *role),
            Mark::Polygons { polygons, role } => self.fill(self.polylines(polygons), *role),
            Mark::Discs { centres, radius, role } => {
                let (radius, mut path) = ((radius * self.scale) as f32, PathBuilder::new());
                for [x, y] in centres.iter().filter_map(|&centre| self.at(centre)) {
                    disc(&mut path, x, y, radius);
                }
                self.fill(path, *role);
            }
            Mark::Text(text) => self.text(text),
        }
    }

    /// One path through the points of each; what is nowhere is left out.
    fn polylines(&self, lines: &[Vec<Point>]) -> PathBuilder {
        let mut path = PathBuilder::new();
        for line in lines {
            let Some(points) = line.iter().map(|&point| self.at(point)).collect::<Option<Vec<_>>>() else { continue };
            let Some((&[x, y], rest)) = points.split_first() else { continue };
            path.move_to(x, y);
            rest.iter().for_each(|&[x, y]| path.line_to(x, y));
        }
        path
    }

    fn lines(&mut self, lines: &[Vec<Point>], width: f64, dash: Option<[f64; 2]>, role: Role) {
        let device = (width * self.scale) as f32;
        let width = if device < HAIRLINE { device.min(1.0) } else { device };
        let dash = dash.and_then(|dash| StrokeDash::new(dash.map(|length| (length * self.scale) as f32).to_vec(), 0.0));
        let (line_cap, line_join) =
            if dash.is_none() && width > ROUND { (LineCap::Round, LineJoin::Round) } else { Default::default() };
        let stroke = Stroke { width, line_cap, line_join, dash, ..Stroke::default() };
        if let Some(path) = self.polylines(lines).finish() {
            self.pixmap.stroke_path(&path, &self.paint(role), &stroke, Transform::identity(), None);
        }
    }

    fn text(&mut self, text: &Text) {
        // On whole device pixels, so that the same word has the same pixels wherever it stands.
        let Some(origin) = self.at(text.origin().map(|c| (c * self.scale + 0.5).floor() / self.scale)) else { return };
        let mut path = PathBuilder::new();
        font::outline(&mut path, &text.text, text.weight, (text.size * self.scale) as f32, origin);
        self.fill(path, text.role);
    }

    fn paint(&self, role: Role) -> Paint<'static> {
        let [r, g, b] = self.theme.color(role);
        let mut paint = Paint::default();
        paint.set_color_rgba8(r, g, b, 255);
        paint
    }

    fn fill(&mut self, path: PathBuilder, role: Role) {
        if let Some(path) = path.finish() {
            self.pixmap.fill_path(&path, &self.paint(role), FillRule::Winding, Transform::identity(), None);
        }
    }

    /// A point \[device px\], unless it is nowhere.
    fn at(&self, point: Point) -> Option<[f32; 2]> {
        let at = point.map(|c| (c * self.scale) as f32);
        at.iter().all(|c| c.is_finite()).then_some(at)
    }

    /// Left, upper, right and lower edge, on whole device pixels.
    fn device(&self, area: &Rect) -> [i32; 4] {
        [area.x, area.y, area.right(), area.bottom()].map(|edge| (edge * self.scale + 0.5).floor() as i32)
    }

    fn fill_rect(&mut self, edges: [i32; 4], role: Role) {
        let [left, top, right, bottom] = edges.map(|edge| edge as f32);
        if let Some(rect) = tiny_skia::Rect::from_ltrb(left, top, right, bottom) {
            let paint = Paint { anti_alias: false, ..self.paint(role) };
            self.pixmap.fill_rect(rect, &paint, Transform::identity(), None);
        }
    }

    fn frame(&mut self, area: &Rect, width: f64, role: Role) {
        let [x0, y0, x1, y1] = self.device(area);
        let d = ((width * self.scale + 0.5).floor() as i32).max(1);
        let bars =
            [[x0, y0, x1, y0 + d], [x0, y1 - d, x1, y1], [x0, y0 + d, x0 + d, y1 - d], [x1 - d, y0 + d, x1, y1 - d]];
        bars.into_iter().for_each(|edges| self.fill_rect(edges, role));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Cells, OCCUPIED};

    fn painted(mark: Mark) -> Vec<u8> {
        let (marks, regions, handles) = (vec![mark], Vec::new(), Vec::new());
        let scene = Scene { marks, regions, handles, ..Scene::new(40.0, 40.0, String::new()) };
        let mut canvas = Canvas::default();
        canvas.paint(&scene, 40, 40, Theme::Light);
        canvas.pixels().to_vec()
    }

    fn lines(line: &[Point], width: f64, dash: Option<[f64; 2]>) -> Vec<u8> {
        painted(Mark::Lines { lines: vec![line.to_vec(), Vec::new()], width, dash, role: Role::Ink })
    }

    fn discs(centres: Vec<Point>, radius: f64) -> Vec<u8> {
        painted(Mark::Discs { centres, radius, role: Role::Ink })
    }

    /// How many pixels of ink there are.
    fn ink(pixels: &[u8]) -> f64 {
        let [_, full, _] = Theme::Light.color(Role::Ink);
        pixels.chunks_exact(4).map(|p| f64::from(255 - p[1])).sum::<f64>() / f64::from(255 - full)
    }

    #[test]
    fn areas_and_maps_are_painted_on_the_pixels_that_they_cover_and_on_no_others() {
        let (area, blank) = (Rect::new(10.0, 12.0, 8.0, 5.0), discs(Vec::new(), 1.0));
        let cells = Cells { columns: 2, shades: vec![OCCUPIED; 2] };
        for mark in [Mark::Fill { area, role: Role::Ink }, Mark::Raster { area, cells, shading: Shading::Map }] {
            for (k, (pixel, paper)) in painted(mark).chunks_exact(4).zip(blank.chunks_exact(4)).enumerate() {
                let [x, y] = [k % 40, k / 40];
                assert_eq!(pixel != paper, (10..18).contains(&x) && (12..17).contains(&y), "{x}, {y}");
            }
        }
    }

    #[test]
    fn a_line_of_any_width_has_the_ink_of_its_area() {
        for k in 0..24 {
            let (sin, cos) = libm::sincos(f64::from(k) * 0.27);
            let line = [-14.0, 3.0, 14.0].map(|along| [20.3 + along * cos, 19.6 + along * sin]);
            for width in [0.5, 1.0, 1.2, 1.4, 3.0] {
                let ratio = ink(&lines(&line, width, None)) / (28.0 * width);
                // Hairlines are told by columns, or rows, of which a slanted line has fewer than its length; a wide line has round ends.
                assert!((0.55..1.15).contains(&ratio), "{k}, {width}: {ratio}");
            }
        }
    }

    #[test]
    fn a_disc_of_any_radius_has_the_ink_of_its_area() {
        for radius in [0.6, 1.0, 1.4, 1.6, 2.0, 5.0] {
            for centre in [[20.0, 20.0], [11.3, 17.9], [25.61, 9.27]] {
                let ratio = ink(&discs(vec![centre], radius)) / (core::f64::consts::PI * radius * radius);
                // tiny-skia looks at 4 × 4 places in a pixel: an edge may lie an eighth of a pixel aside.
                let [least, most] = [-0.15, 0.15].map(|aside: f64| (1.0 + aside / radius) * (1.0 + aside / radius));
                assert!((least..most).contains(&ratio), "{radius} at {centre:?}: {ratio}");
            }
        }
    }

    #[test]
    fn what_is_outside_or_nowhere_is_not_drawn_and_keeps_nothing_else_from_being_drawn() {
        let blank = discs(Vec::new(), 1.0);
        for line in [[[-9.0, -9.0], [-1.5, 50.0]], [[f64::NAN, 1.0], [5.0, 5.0]], [[-1e300, 60.0], [1e300, 60.0]]] {
            for (width, dash) in [(1.0, None), (4.0, None), (1.0, Some([2.0, 3.0])), (4.0, Some([f64::NAN, 1.0]))] {
                assert_eq!(lines(&line, width, dash), blank, "{line:?}");
            }
        }
        for radius in [1.0, 5.0] {
            let alone = discs(vec![[20.0, 20.0]], radius);
            assert_eq!(discs(vec![[f64::NAN, 5.0], [20.0, 20.0], [f64::INFINITY, 5.0]], radius), alone);
        }
    }

    #[test]
    fn dashes_that_are_none_are_a_line() {
        let line = [[5.0, 5.3], [40.0, 5.3]];
        for dash in [[0.0, 0.0], [f64::NAN, 1.0], [-1.0, 3.0]] {
            assert_eq!(ink(&lines(&line, 1.0, Some(dash))), ink(&lines(&line, 1.0, None)), "{dash:?}");
        }
    }
}
