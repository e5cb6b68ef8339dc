//! Filling a path: where its winding number is not 0.
//!
//! A row of pixels is looked at along `LINES` lines. On each, the crossings with the path's edges are sorted and the stretches inside
//! are found: their ends to a 64th of a pixel, so that a pixel's share is exact along the line and one of `LINES` across it. All
//! arithmetic on the way is that of IEEE or of integers, so every machine gets the same.

use crate::path::{Path, Point, Segment, dot};
use crate::{Color, Pixels, WHOLE, cover};

/// Lines in a row of pixels.
const LINES: i32 = 4;

/// Parts of a pixel along a line: its share of a whole pixel.
const PARTS: i32 = WHOLE as i32 / LINES;

/// How far a curve may be from the lines that stand for it \[px\].
const TOLERANCE: f32 = 1.0 / 16.0;

/// Fills paths; keeps its memory from one to the next.
#[derive(Default)]
pub struct Filler {
    edges: Vec<Edge>,
    /// For each line, from the path's first on, the first edge that begins there; others follow by [`Edge::next`].
    begin: Vec<u32>,
    /// The edges that cross the line, by where \[1/[`PARTS`] px\], from left to right.
    crossings: Vec<(i32, u32)>,
    /// By how much the share of each pixel of the row is greater than that of the one before.
    steps: Vec<i16>,
}

/// A straight piece of a contour, of the lines [first, last).
struct Edge {
    /// A point on it \[parts, lines\], and how much x changes from line to line.
    x: f32,
    y: f32,
    slope: f32,
    first: i32,
    last: i32,
    /// +1 if the contour runs down, −1 if up.
    winding: i32,
    next: u32,
}

/// No edge.
const NONE: u32 = u32::MAX;

impl Filler {
    /// Fills a path with a colour; one with a point that is nowhere draws nothing.
    pub fn fill(&mut self, pixels: &mut Pixels, path: &Path, color: Color) {
        let [width, height] = pixels.size().map(|side| side as i32);
        if !path.segments().iter().all(Segment::is_finite) {
            return;
        }
        self.edges.clear();
        self.outline(path, LINES * height);
        let Some((first, last)) = self.sort() else { return };
        self.crossings.clear();
        self.steps.resize(width as usize + 2, 0);
        let rows = (first / LINES) as usize..((last + LINES - 1) / LINES) as usize;
        for (row, pixels) in pixels.rows().enumerate().take(rows.end).skip(rows.start) {
            let row = row as i32 * LINES;
            // The pixels that the row's lines touch [parts].
            let (mut from, mut to) = (width * PARTS, 0);
            for line in row.max(first)..(row + LINES).min(last) {
                self.cross(line, (line - first) as usize, width * PARTS);
                let (a, b) = self.inside();
                (from, to) = (from.min(a), to.max(b));
            }
            if from < to {
                let (from, to) = ((from / PARTS) as usize, (to / PARTS) as usize + 2);
                paint(&mut pixels[from..to.min(width as usize)], &mut self.steps[from..to], color);
            }
        }
    }

    /// All contours, closed, as edges.
    fn outline(&mut self, path: &Path, lines: i32) {
        let (mut start, mut at) = ([0.0; 2], [0.0; 2]);
        for &segment in path.segments() {
            let a = at;
            match segment {
                Segment::Move(point) => {
                    self.edge(a, start, lines);
                    (start, at) = (point, point);
                }
                Segment::Line(point) => {
                    self.edge(a, point, lines);
                    at = point;
                }
                Segment::Cubic(b, c, d) => {
                    // a + 3 t (b − a) + 3 t² (a − 2 b + c) + t³ (d − a + 3 (b − c))
                    let bends = [[a, b, c], [b, c, d]].map(|[a, b, c]| [0, 1].map(|i| a[i] - b[i] - b[i] + c[i]));
                    for t in pieces(3.0 * length(bends[0]).max(length(bends[1]))) {
                        let point = [0, 1].map(|i| {
                            let twist = d[i] - a[i] + 3.0 * (b[i] - c[i]);
                            a[i] + t * (3.0 * (b[i] - a[i]) + t * (3.0 * bends[0][i] + t * twist))
                        });
                        self.edge(at, point, lines);
                        at = point;
                    }
                }
            }
        }
        self.edge(at, start, lines);
    }

    /// Takes a straight piece, if it crosses a line.
    fn edge(&mut self, a: Point, b: Point, lines: i32) {
        let [a, b] = [a, b].map(|[x, y]| [x * PARTS as f32, y * LINES as f32]);
        let (winding, a, b) = if a[1] < b[1] { (1, a, b) } else { (-1, b, a) };
        // A line is looked at in its middle.
        let [first, last] = [a, b].map(|[_, y]| ((y - 0.5).ceil() as i32).max(0).min(lines));
        if first < last {
            let slope = (b[0] - a[0]) / (b[1] - a[1]);
            self.edges.push(Edge { x: a[0], y: a[1] - 0.5, slope, first, last, winding, next: NONE });
        }
    }

    /// Puts every edge with those that begin on the same line; the first line and the end of the last.
    fn sort(&mut self) -> Option<(i32, i32)> {
        let first = self.edges.iter().map(|edge| edge.first).min()?;
        let last = self.edges.iter().map(|edge| edge.last).max()?;
        self.begin.clear();
        self.begin.resize((last - first) as usize, NONE);
        for (i, edge) in self.edges.iter_mut().enumerate() {
            edge.next = core::mem::replace(&mut self.begin[(edge.first - first) as usize], i as u32);
        }
        Some((first, last))
    }

    /// Moves the crossings on to a line, and sorts them: from line to line, few change places.
    fn cross(&mut self, line: i32, offset: usize, right: i32) {
        let Self { edges, crossings, .. } = self;
        crossings.retain(|&(_, edge)| line < edges[edge as usize].last);
        let mut new = self.begin[offset];
        while let Some(edge) = edges.get(new as usize) {
            crossings.push((0, new));
            new = edge.next;
        }
        for i in 0..crossings.len() {
            let number = crossings[i].1;
            let edge = &edges[number as usize];
            // What is left or right of the canvas still winds.
            let x = ((edge.x + edge.slope * (line as f32 - edge.y) + 0.5) as i32).max(0).min(right);
            let mut place = i;
            while place > 0 && crossings[place - 1].0 > x {
                crossings[place] = crossings[place - 1];
                place -= 1;
            }
            crossings[place] = (x, number);
        }
    }

    /// Adds the stretches of a line that are inside to the shares; the ends of all \[parts\], the first after the last if there is none.
    fn inside(&mut self) -> (i32, i32) {
        let Self { edges, crossings, steps, .. } = self;
        let mut step = |x: i32, sign: i32| {
            let (pixel, part) = ((x / PARTS) as usize, x % PARTS);
            steps[pixel] += (sign * (PARTS - part)) as i16;
            steps[pixel + 1] += (sign * part) as i16;
        };
        let (mut from, mut to) = (i32::MAX, 0);
        let (mut winding, mut start) = (0, 0);
        for &(x, edge) in crossings.iter() {
            if winding == 0 {
                start = x;
            }
            winding += edges[edge as usize].winding;
            if winding == 0 && start < x {
                step(start, 1);
                step(x, -1);
                (from, to) = (from.min(start), x);
            }
        }
        (from, to)
    }
}

/// Ends of the pieces of a curve, from 0 to 1, by how much it bends \[px\]: Wang's bound on its distance from its chords.
fn pieces(bend: f32) -> impl Iterator<Item = f32> {
    let count = ((bend / (4.0 * TOLERANCE)).sqrt().ceil() as i32).clamp(1, 64);
    (1..=count).map(move |k| k as f32 / count as f32)
}

fn length(way: Point) -> f32 {
    dot(way, way).sqrt()
}

/// Covers a row of pixels by shares, whose steps are taken out. Most pixels are wholly inside or outside: eight at a time.
fn paint(pixels: &mut [Color], steps: &mut [i16], color: Color) {
    let mut share = 0;
    for (pixels, steps) in pixels.chunks_mut(8).zip(steps.chunks_mut(8)) {
        if let Ok(&[0, 0, 0, 0, 0, 0, 0, 0]) = <&[i16; 8]>::try_from(&*steps)
            && (share == 0 || share == WHOLE as i16)
        {
            if share > 0 {
                pixels.fill(color);
            }
            continue;
        }
        for (pixel, step) in pixels.iter_mut().zip(steps.iter_mut()) {
            share += core::mem::take(step);
            match share as u32 {
                0 => {}
                WHOLE => *pixel = color,
                share => cover(pixel, color, share),
            }
        }
    }
    // Steps beyond the last pixel, at the right end of the canvas.
    if let Some(rest) = steps.get_mut(pixels.len()..) {
        rest.fill(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INK: Color = [255, 0, 0, 255];

    /// Red of a row of pixels under what is filled.
    fn filled(size: [u32; 2], row: usize, draw: impl FnOnce(&mut Path)) -> Vec<u8> {
        let mut path = Path::default();
        draw(&mut path);
        let (mut pixels, mut filler) = (Pixels::new(size), Filler::default());
        filler.fill(&mut pixels, &path, INK);
        assert!(filler.steps.iter().all(|&step| step == 0), "the next path starts from nothing");
        pixels.rows().nth(row).unwrap().iter().map(|[red, ..]| *red).collect()
    }

    fn rect(path: &mut Path, [left, top, right, bottom]: [f32; 4]) {
        path.polygon([[left, top], [right, top], [right, bottom], [left, bottom]]);
    }

    #[test]
    fn a_pixel_is_covered_by_its_share() {
        let row = filled([4, 3], 1, |path| rect(path, [0.75, 0.5, 2.25, 1.5]));
        assert_eq!(row, [32, 128, 32, 0], "half of the row, and quarters of the outer pixels");
    }

    #[test]
    fn what_is_drawn_twice_is_drawn_once_and_what_winds_back_is_a_hole() {
        let twice = filled([4, 1], 0, |path| {
            rect(path, [0.5, 0.0, 2.5, 1.0]);
            rect(path, [0.5, 0.0, 2.5, 1.0]);
        });
        assert_eq!(twice, [128, 255, 128, 0]);
        let hole = filled([4, 1], 0, |path| {
            rect(path, [0.0, 0.0, 4.0, 1.0]);
            path.polygon([[1.0, 0.0], [1.0, 1.0], [3.0, 1.0], [3.0, 0.0]]);
        });
        assert_eq!(hole, [255, 0, 0, 255]);
    }

    #[test]
    fn what_lies_outside_is_cut_off() {
        let row = filled([3, 2], 1, |path| rect(path, [-9.0, -1e30, 1.5, 1e30]));
        assert_eq!(row, [255, 128, 0]);
        for rest in [[5.0, 0.0, 9.0, 2.0], [-9.0, 0.0, -1.0, 2.0], [0.0, 2.0, 3.0, 9.0], [0.0, -9.0, 3.0, 0.0]] {
            assert_eq!(filled([3, 2], 1, |path| rect(path, rest)), [0, 0, 0], "{rest:?}");
        }
        let right = filled([3, 2], 1, |path| rect(path, [1.5, 0.0, 3.0, 2.0]));
        assert_eq!(right, [0, 128, 255], "ends with the canvas");
    }

    #[test]
    fn a_disc_has_its_area() {
        for radius in [1.5, 4.0, 7.3] {
            let ink: u32 = (0..20)
                .flat_map(|row| filled([20, 20], row, |path| path.circle([9.8, 10.3], radius)))
                .map(u32::from)
                .sum();
            let area = core::f32::consts::PI * radius * radius;
            // The smallest is crossed by twelve lines.
            assert!((ink as f32 / 255.0 / area - 1.0).abs() < 0.06, "{radius}: {} of {area}", ink as f32 / 255.0);
        }
    }

    #[test]
    fn coordinates_of_any_size_are_taken() {
        let huge = filled([3, 1], 0, |path| {
            path.push(Segment::Move([-1e30, -1e30]));
            path.push(Segment::Cubic([3e30, -3e30], [-3e30, 3e30], [1e30, 1e30]));
            path.push(Segment::Line([0.0, -2e30]));
        });
        assert_eq!(huge.len(), 3);
    }
}
