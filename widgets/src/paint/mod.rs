//! The painter: a scene, a theme and a number of device pixels in, opaque RGBA out, the same bytes on every machine.
//!
//! Maps, borders and plates are written straight into whole device pixels, which is crisp and fast; lines, discs and glyphs are
//! paths, filled by `fastslam-raster`. All shapes of a mark go into one path, because a fill costs more to begin than to go on with;
//! clouds of samples and bundles of thin lines are written straight into pixels too.

mod theme;

pub use theme::{Rgb, Theme};

use crate::{
    font,
    scene::{Mark, Point, Rect, Role, Scene, Shading, Text, UNKNOWN},
};
pub use fastslam_raster::{Color, Pixels, path};
use fastslam_raster::{blit, fill::Filler, path::Path, stroke::Stroke};

/// Largest width and height of a canvas \[device px\].
pub const MAX_SIDE: u32 = 8191;

/// From this many on, discs are no path: 4096 would take a frame of their own.
const CLOUD: usize = 512;

/// Strands wider than this \[device px\] are a path: their joints would be seen.
const THIN: f32 = 2.5;

/// Reusable pixels.
pub struct Canvas {
    pixels: Pixels,
    filler: Filler,
    /// Memory of the last path.
    scratch: Path,
}

impl Default for Canvas {
    fn default() -> Self {
        Self { pixels: Pixels::new([1, 1]), filler: Filler::default(), scratch: Path::default() }
    }
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
        let mut filler = core::mem::take(&mut self.filler);
        self.paint_with(scene, width, height, theme, &mut |pixels, path, color| filler.fill(pixels, path, color));
        self.filler = filler;
    }

    /// The same with another fill of paths, which the tests hold ours against.
    pub fn paint_with(&mut self, scene: &Scene, width: u32, height: u32, theme: Theme, fill: &mut Fill<'_>) {
        let size = [width.clamp(1, MAX_SIDE), height.clamp(1, MAX_SIDE)];
        if self.size() != size {
            self.pixels = Pixels::new(size);
        }
        self.pixels.clear(opaque(theme.color(Role::Paper)));
        let scale = f64::from(size[0]) / scene.width;
        let shades = [Shading::Map, Shading::Ghost, Shading::Correlation, Shading::Density]
            .map(|shading| theme.shades(shading).map(opaque));
        let mut brush = Brush { canvas: self, fill, scale, theme, shades };
        scene.marks.iter().for_each(|mark| brush.mark(mark));
    }
}

/// Fills a path with a colour where its winding number is not 0.
pub type Fill<'a> = dyn FnMut(&mut Pixels, &Path, Color) + 'a;

fn opaque([r, g, b]: Rgb) -> Color {
    [r, g, b, 255]
}

/// A canvas, how its paths are filled, device pixels per css px, and the colours.
struct Brush<'a, 'f> {
    canvas: &'a mut Canvas,
    fill: &'a mut Fill<'f>,
    scale: f64,
    theme: Theme,
    shades: [[Color; 256]; 4],
}

impl Brush<'_, '_> {
    fn mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Raster { area, cells, shading } => {
                let area = self.device(area);
                let walls = matches!(shading, Shading::Map | Shading::Ghost).then_some(UNKNOWN);
                let cells = blit::Cells { columns: cells.columns, shades: &cells.shades, walls };
                blit::cells(&mut self.canvas.pixels, area, &cells, &self.shades[*shading as usize]);
            }
            Mark::Fill { area, role } => {
                let area = self.device(area);
                self.fill_rect(area, *role);
            }
            Mark::Frame { area, width, role } => self.frame(area, *width, *role),
            Mark::Lines { lines, width, dash, role } => {
                let stroke = self.stroke(*width, *dash);
                let mut points = Vec::new();
                self.fill(*role, |brush, path| {
                    for line in lines {
                        points.clear();
                        points.extend(line.iter().map(|&point| brush.at(point)));
                        stroke.outline(path, &points);
                    }
                });
            }
            Mark::Strands { lines, width, role } => {
                let (device, color) = ((width * self.scale) as f32, opaque(self.theme.color(*role)));
                if device > THIN {
                    let (lines, width, dash, role) = (lines.clone(), *width, None, *role);
                    return self.mark(&Mark::Lines { lines, width, dash, role });
                }
                for pair in lines.iter().flat_map(|line| line.windows(2)) {
                    let [a, b] = [pair[0], pair[1]].map(|point| self.at(point));
                    blit::strand(&mut self.canvas.pixels, a, b, device, color);
                }
            }
            Mark::Polygons { polygons, role } => self.fill(*role, |brush, path| {
                polygons.iter().for_each(|polygon| path.polygon(polygon.iter().map(|&point| brush.at(point))));
            }),
            Mark::Discs { centres, radius, role } if centres.len() >= CLOUD => {
                let (radius, color) = ((radius * self.scale) as f32, opaque(self.theme.color(*role)));
                for &centre in centres {
                    let centre = self.at(centre);
                    blit::disc(&mut self.canvas.pixels, centre, radius, color);
                }
            }
            Mark::Discs { centres, radius, role } => self.fill(*role, |brush, path| {
                let radius = (radius * brush.scale) as f32;
                centres.iter().for_each(|&centre| path.circle(brush.at(centre), radius));
            }),
            Mark::Text(text) => self.text(text),
        }
    }

    fn text(&mut self, text: &Text) {
        // On whole device pixels, so that the same word has the same pixels wherever it stands.
        let [x, y] = self.at(text.origin()).map(|c| (c + 0.5).floor());
        let size = (text.size * self.scale) as f32;
        self.fill(text.role, |_, path| {
            font::outline(&text.text, text.weight, |pen, segment| {
                path.push(segment.map(|[u, v]| [x + (pen + u) * size, y - v * size]));
            });
        });
    }

    fn stroke(&self, width: f64, dash: Option<[f64; 2]>) -> Stroke {
        let width = (width * self.scale) as f32;
        // Round where it can be seen: the arcs of thin lines are most of their edges, and edges are what filling costs.
        Stroke {
            width,
            round_ends: width > 1.5 && dash.is_none(),
            round_joints: width > 4.0,
            dash: dash.map(|dash| dash.map(|length| (length * self.scale) as f32)),
        }
    }

    /// Fills the path that is drawn.
    fn fill(&mut self, role: Role, draw: impl FnOnce(&Self, &mut Path)) {
        let mut path = core::mem::take(&mut self.canvas.scratch);
        draw(self, &mut path);
        (self.fill)(&mut self.canvas.pixels, &path, opaque(self.theme.color(role)));
        path.clear();
        self.canvas.scratch = path;
    }

    fn at(&self, point: Point) -> [f32; 2] {
        point.map(|c| (c * self.scale) as f32)
    }

    /// Edges on whole device pixels.
    fn device(&self, area: &Rect) -> blit::Area {
        let at = |x: f64| (x * self.scale + 0.5).floor() as i32;
        blit::Area { x0: at(area.x), y0: at(area.y), x1: at(area.right()), y1: at(area.bottom()) }
    }

    fn fill_rect(&mut self, area: blit::Area, role: Role) {
        blit::fill(&mut self.canvas.pixels, area, opaque(self.theme.color(role)));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn painted(mark: Mark) -> Vec<u8> {
        let (marks, regions, handles) = (vec![mark], Vec::new(), Vec::new());
        let scene = Scene { width: 40.0, height: 40.0, marks, regions, handles, description: String::new() };
        let mut canvas = Canvas::default();
        canvas.paint(&scene, 40, 40, Theme::Light);
        canvas.pixels().to_vec()
    }

    fn discs(centres: Vec<Point>) -> Vec<u8> {
        painted(Mark::Discs { centres, radius: 1.5, role: Role::Ink })
    }

    #[test]
    fn a_strand_has_the_ink_of_a_line_and_lies_where_it_does() {
        for k in 0..24 {
            let (sin, cos) = fastslam::ops::sin_cos(f64::from(k) * 0.27);
            // In two pieces, as of a curve, and one of them partly outside.
            let line = [-25.0, 3.0, 14.0].map(|along| [20.3 + along * cos, 19.6 + along * sin]).to_vec();
            for width in [1.0, 2.0] {
                let [lines, other] = [vec![line.clone()], vec![line.clone()]];
                let strand = painted(Mark::Strands { lines, width, role: Role::Ink });
                let stroke = painted(Mark::Lines { lines: other, width, dash: None, role: Role::Ink });
                let ink = |pixels: &[u8]| pixels.chunks_exact(4).map(|p| f64::from(255 - p[1])).sum::<f64>();
                let ratio = ink(&strand) / ink(&stroke);
                assert!((0.93..1.07).contains(&ratio), "{k}, {width}: {ratio}");
                // A line that lay a pixel aside would differ by all of its ink.
                let differ: f64 =
                    strand.iter().zip(&stroke).step_by(4).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>();
                assert!(differ < 0.3 * ink(&stroke), "{k}, {width}: {differ} of {}", ink(&stroke));
            }
        }
    }

    #[test]
    fn strands_outside_or_nowhere_draw_nothing() {
        let blank = painted(Mark::Discs { centres: Vec::new(), radius: 1.0, role: Role::Ink });
        for line in [
            [[-9.0, -9.0], [-1.5, 50.0]],
            [[f64::NAN, 1.0], [5.0, 5.0]],
            [[7.0, 7.0], [7.0, 7.0]],
            [[-1e300, 60.0], [1e300, 60.0]],
        ] {
            let strand = Mark::Strands { lines: vec![line.to_vec(), Vec::new()], width: 1.0, role: Role::Ink };
            assert_eq!(painted(strand), blank, "{line:?}");
        }
    }

    #[test]
    fn a_disc_of_a_cloud_looks_like_any_other() {
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            4.0 + 32.0 * f64::from(state >> 8) / f64::from(1 << 24)
        };
        for _ in 0..50 {
            let centre = [next(), next()];
            let mut cloud = vec![[-100.0, f64::NAN]; CLOUD];
            cloud[7] = centre;
            let far = discs(vec![centre]).iter().zip(discs(cloud)).map(|(a, b)| a.abs_diff(b)).max();
            assert!(far <= Some(40), "{centre:?}: {far:?} of 255");
        }
    }
}
