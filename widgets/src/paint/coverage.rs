//! Filling outlines: how much of each pixel lies inside, exactly, in whole numbers.
//!
//! The method is that of FreeType's and AGG's rasterizers: every edge leaves in the cells it crosses the height it covers there
//! and the area to its left; a sweep along each row sums both to coverage. Only cells that edges cross are stored, so a long thin
//! line costs its length and not its bounding box. An outline's two passes over a common edge cancel to the last bit, and nothing
//! here depends on the platform.
//!
//! tiny-skia would do the same work with its pipeline of a hundred stages, most for gradients and blends that no figure uses:
//! 65 KB brotli on every page, against 3 KB here.

use super::{Pixels, Rgb};

/// Subdivisions of a pixel along each axis, as a power of two.
const SHIFT: i32 = 8;
const ONE: i32 = 1 << SHIFT;

/// Bits of a column in a cell's key; sides of a canvas are at most 2¹³ px.
const COLUMN_BITS: u32 = 13;

/// What the edges that cross a pixel leave there.
#[derive(Clone, Copy, Default)]
struct Cell {
    /// Row and column.
    key: u32,
    /// Signed height \[1/256 px\] of the edges inside the cell.
    cover: i32,
    /// Twice the signed area \[1/256² px²\] between those edges and the cell's left side.
    area: i32,
}

/// Collects outlines and fills them, non-zero winding. Keeps its memory from one use to the next.
#[derive(Default)]
pub struct Coverage {
    /// Columns and rows of the canvas.
    size: [i32; 2],
    start: [i32; 2],
    last: [i32; 2],
    cells: Vec<Cell>,
    sorted: Vec<Cell>,
}

impl Coverage {
    /// Prepares for a canvas of this size \[px\].
    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        self.size = [width as i32, height as i32];
    }

    /// Starts a contour, at a point \[px\].
    pub fn move_to(&mut self, point: [f64; 2]) {
        self.close();
        self.start = fixed(point);
        self.last = self.start;
    }

    /// Goes on straight.
    pub fn line_to(&mut self, point: [f64; 2]) {
        let point = fixed(point);
        self.edge(self.last, point);
        self.last = point;
    }

    /// Goes back to the start of the contour.
    pub fn close(&mut self) {
        self.edge(self.last, self.start);
        self.last = self.start;
    }

    /// Fills what was outlined since the last call.
    pub fn fill(&mut self, pixels: &mut Pixels, color: Rgb) {
        self.close();
        self.sort();
        let mut cells = self.cells.iter().peekable();
        let (mut row, mut cover) = (u32::MAX, 0);
        while let Some(&Cell { key, cover: height, mut area }) = cells.next() {
            if key >> COLUMN_BITS != row {
                (row, cover) = (key >> COLUMN_BITS, 0);
            }
            cover += height;
            while let Some(same) = cells.next_if(|next| next.key == key) {
                cover += same.cover;
                area += same.area;
            }
            let column = key & ((1 << COLUMN_BITS) - 1);
            pixels.blend(row, column, column + 1, opacity(2 * ONE * cover - area), color);
            // Up to the next cell in the row; edges right of the canvas left none.
            let next = cells.peek().filter(|next| next.key >> COLUMN_BITS == row);
            let end = next.map_or(self.size[0] as u32, |next| next.key & ((1 << COLUMN_BITS) - 1));
            pixels.blend(row, column + 1, end, opacity(2 * ONE * cover), color);
        }
        self.cells.clear();
    }

    /// An edge, row by row. It is walked from its upper end in either direction, so that opposite edges cancel exactly.
    fn edge(&mut self, a: [i32; 2], b: [i32; 2]) {
        let (top, bottom, sign) = if a[1] < b[1] { (a, b, 1) } else { (b, a, -1) };
        let height = i64::from(bottom[1] - top[1]);
        if height == 0 {
            return;
        }
        let x_at = |y: i32| top[0] + (i64::from(bottom[0] - top[0]) * i64::from(y - top[1]) / height) as i32;
        let first = (top[1] >> SHIFT).max(0);
        let last = ((bottom[1] - 1) >> SHIFT).min(self.size[1] - 1);
        for row in first..=last {
            let (y0, y1) = (top[1].max(row << SHIFT), bottom[1].min((row + 1) << SHIFT));
            self.edge_in_row(row, x_at(y0), x_at(y1), (y1 - y0) * sign);
        }
    }

    /// The part of an edge in one row: between two x, over a signed height.
    fn edge_in_row(&mut self, row: i32, x0: i32, x1: i32, height: i32) {
        let (left, right) = (x0.min(x1), x0.max(x1));
        if left >> SHIFT == right >> SHIFT {
            let column = left >> SHIFT;
            return self.add(row, column, height, height * (left + right - 2 * (column << SHIFT)));
        }
        let mut done = 0;
        let mut up_to = |x: i32| {
            let total = (i64::from(height) * i64::from(x - left) / i64::from(right - left)) as i32;
            total - core::mem::replace(&mut done, total)
        };
        let first = (left >> SHIFT).max(-1);
        if first > left >> SHIFT {
            let outside = up_to((first << SHIFT).min(right));
            self.add(row, -1, outside, 0);
        }
        for column in first..=(right >> SHIFT).min(self.size[0] - 1) {
            let start = column << SHIFT;
            if right < start {
                break; // all of it lies left of the canvas
            }
            let (from, to) = (left.max(start), right.min(start + ONE));
            let part = up_to(to);
            self.add(row, column, part, part * (from + to - 2 * start));
        }
    }

    fn add(&mut self, row: i32, column: i32, cover: i32, area: i32) {
        if column >= self.size[0] {
            return; // right of the canvas: covers nothing in it
        }
        // Left of the canvas: covers all of the row.
        let (column, area) = if column < 0 { (0, 0) } else { (column, area) };
        let key = (row as u32) << COLUMN_BITS | column as u32;
        match self.cells.last_mut() {
            Some(cell) if cell.key == key => (cell.cover, cell.area) = (cell.cover + cover, cell.area + area),
            _ => self.cells.push(Cell { key, cover, area }),
        }
    }

    /// By row and column: three passes of a radix sort over the 26 bits of the keys.
    fn sort(&mut self) {
        const BITS: u32 = 9;
        self.sorted.resize(self.cells.len(), Cell::default());
        for shift in [0, BITS, 2 * BITS] {
            let digit = |cell: &Cell| (cell.key >> shift) as usize & ((1 << BITS) - 1);
            let mut starts = [0_usize; 1 << BITS];
            self.cells.iter().for_each(|cell| starts[digit(cell)] += 1);
            let mut total = 0;
            starts.iter_mut().for_each(|start| total += core::mem::replace(start, total));
            for cell in &self.cells {
                let start = &mut starts[digit(cell)];
                self.sorted[*start] = *cell;
                *start += 1;
            }
            core::mem::swap(&mut self.cells, &mut self.sorted);
        }
    }
}

/// A point \[px\] in subdivisions, far points brought near enough for 32 bits.
fn fixed(point: [f64; 2]) -> [i32; 2] {
    point.map(|x| (x.clamp(-32_768.0, 32_768.0) * f64::from(ONE) + 0.5).floor() as i32)
}

/// 0 to 255 for twice a signed area \[1/256² px²\]; more than once inside is inside.
fn opacity(area: i32) -> u8 {
    (area.abs() >> (SHIFT + 1)).min(255) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: Rgb = [0, 0, 0];

    /// How dark each pixel of a white canvas became, in 255ths.
    fn dark(size: [u32; 2], outline: impl FnOnce(&mut Coverage)) -> Vec<u8> {
        let mut pixels = Pixels::default();
        pixels.clear(size, [255; 3]);
        let mut coverage = Coverage::default();
        coverage.resize(size);
        outline(&mut coverage);
        coverage.fill(&mut pixels, BLACK);
        pixels.bytes().chunks_exact(4).map(|p| 255 - p[0]).collect()
    }

    fn polygon(coverage: &mut Coverage, corners: &[[f64; 2]]) {
        coverage.move_to(corners[0]);
        corners[1..].iter().for_each(|&corner| coverage.line_to(corner));
        coverage.close();
    }

    #[test]
    fn pixels_are_as_dark_as_they_are_covered() {
        let square = [[1.0, 1.0], [2.5, 1.0], [2.5, 2.25], [1.0, 2.25]];
        let expected = [0, 0, 0, 0, /**/ 0, 255, 128, 0, /**/ 0, 64, 32, 0];
        assert_eq!(dark([4, 3], |c| polygon(c, &square)), expected);
        let reversed: Vec<_> = square.into_iter().rev().collect();
        assert_eq!(dark([4, 3], |c| polygon(c, &reversed)), expected);
        // Half of a pixel, and an eighth of its neighbours.
        assert_eq!(dark([1, 1], |c| polygon(c, &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])), [128]);
        assert_eq!(dark([2, 1], |c| polygon(c, &[[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]])), [192, 64]);
    }

    #[test]
    fn neighbours_leave_no_seam_and_overlaps_no_stain() {
        let apart = |c: &mut Coverage| {
            polygon(c, &[[0.0, 0.0], [1.3, 0.0], [1.7, 2.0], [0.0, 2.0]]);
            polygon(c, &[[1.3, 0.0], [3.0, 0.0], [3.0, 2.0], [1.7, 2.0]]);
        };
        assert_eq!(dark([3, 2], apart), [255; 6]);
        let twice =
            |c: &mut Coverage| (0..2).for_each(|_| polygon(c, &[[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]]));
        assert_eq!(dark([3, 2], twice), [255; 6]);
    }

    #[test]
    fn a_hole_runs_the_other_way() {
        let ring = |c: &mut Coverage| {
            polygon(c, &[[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]]);
            polygon(c, &[[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0]]);
        };
        assert_eq!(dark([3, 3], ring), [255, 255, 255, 255, 0, 255, 255, 255, 255]);
    }

    #[test]
    fn shapes_that_leave_the_canvas_are_cut_at_its_edges() {
        for far in [1.0, 5.0, 1e9] {
            let all = [[-far, -far], [2.0 + far, -far], [2.0 + far, 2.0 + far], [-far, 2.0 + far]];
            assert_eq!(dark([2, 2], |c| polygon(c, &all)), [255; 4], "{far}");
        }
        let left = [[-9.0, 0.0], [1.5, 0.0], [1.5, 1.0], [-9.0, 1.0]];
        assert_eq!(dark([3, 1], |c| polygon(c, &left)), [255, 128, 0]);
        let slanted = [[-8.0, 0.0], [2.0, 0.0], [-8.0, 10.0]];
        assert_eq!(dark([2, 2], |c| polygon(c, &slanted)), [255, 128, 128, 0]);
        assert_eq!(dark([2, 2], |c| polygon(c, &[[5.0, 0.0], [9.0, 0.0], [9.0, 2.0], [5.0, 2.0]])), [0; 4]);
        assert_eq!(dark([2, 2], |c| polygon(c, &[[f64::NAN, 0.0], [1.0, f64::NAN], [0.0, 1.0]])).len(), 4);
    }

    #[test]
    fn the_total_of_a_disc_is_its_area() {
        let corners: Vec<[f64; 2]> = (0..256)
            .map(|k| fastslam::ops::sin_cos(core::f64::consts::TAU * f64::from(k) / 256.0))
            .map(|(sin, cos)| [20.3 + 17.0 * cos, 20.8 + 17.0 * sin])
            .collect();
        let total: f64 = dark([40, 40], |c| polygon(c, &corners)).iter().map(|&d| f64::from(d) / 255.0).sum();
        assert!((total - core::f64::consts::PI * 17.0 * 17.0).abs() < 2.0, "{total}");
    }
}
