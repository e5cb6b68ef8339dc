//! Filling rectangles and magnifying maps, straight into the pixels.

use crate::{Color, Pixels, WHOLE, cover};

/// A rectangle of device pixels, upper ends exclusive; may lie partly or wholly outside of the canvas.
#[derive(Clone, Copy, Debug)]
pub struct Area {
    /// Left end.
    pub x0: i32,
    /// Upper end.
    pub y0: i32,
    /// Right end.
    pub x1: i32,
    /// Lower end.
    pub y1: i32,
}

impl Area {
    fn within(self, pixels: &Pixels) -> Option<[usize; 4]> {
        let within = |at: i32, size: usize| at.max(0).min(size as i32) as usize;
        let [x0, x1] = [self.x0, self.x1].map(|x| within(x, pixels.width));
        let [y0, y1] = [self.y0, self.y1].map(|y| within(y, pixels.height()));
        (x0 < x1 && y0 < y1).then_some([x0, y0, x1, y1])
    }
}

/// A rectangle of shades.
pub struct Cells<'a> {
    /// Number of cells in a row.
    pub columns: usize,
    /// Row by row from the top.
    pub shades: &'a [u8],
    /// In a map, the shade of the unknown: those above are walls. Where no wall lies in a pixel, it shows the least shade, what is freest:
    /// unknown cells must not close an open door.
    pub walls: Option<u8>,
}

/// One colour.
pub fn fill(pixels: &mut Pixels, area: Area, color: Color) {
    let Some([x0, y0, x1, y1]) = area.within(pixels) else { return };
    pixels.rows().take(y1).skip(y0).for_each(|row| row[x0..x1].fill(color));
}

/// A disc: a pixel is covered as far as its middle is from the edge, which is nearly its area, and quick.
pub fn disc(pixels: &mut Pixels, [x, y]: [f32; 2], radius: f32, color: Color) {
    let reach = radius + 0.5;
    let [x0, x1, y0, y1] = [x - reach, x + reach, y - reach, y + reach].map(|edge| edge.floor() as i32);
    let area = Area { x0, y0, x1: x1.saturating_add(1), y1: y1.saturating_add(1) };
    let Some([x0, y0, x1, y1]) = area.within(pixels) else { return };
    for (j, row) in pixels.rows().enumerate().take(y1).skip(y0) {
        for (i, pixel) in row.iter_mut().enumerate().take(x1).skip(x0) {
            let (dx, dy) = (i as f32 + 0.5 - x, j as f32 + 0.5 - y);
            cover(pixel, color, share(reach - (dx * dx + dy * dy).sqrt()));
        }
    }
}

/// A thin line without ends: of each column it crosses (of each row, where it is steep), it covers the pixels as its strip does.
/// The pieces of a curve share no column, so that no joint is darker.
pub fn strand(pixels: &mut Pixels, a: [f32; 2], b: [f32; 2], width: f32, color: Color) {
    let steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
    // Along the line, then across.
    let turn = |[x, y]: [f32; 2]| if steep { [y, x] } else { [x, y] };
    let [mut a, mut b] = [turn(a), turn(b)];
    if a[0] > b[0] {
        (a, b) = (b, a);
    }
    let stride = pixels.width;
    let (length, breadth) = if steep { (pixels.height(), stride) } else { (stride, pixels.height()) };
    let breadth = (breadth * WHOLE as usize) as i32;
    let slope = (b[1] - a[1]) / (b[0] - a[0]);
    let half = 0.5 * width * (1.0 + slope * slope).sqrt();
    if ![a[0], a[1], b[0], b[1], half].iter().all(|x| x.is_finite()) {
        return;
    }
    // The first whose middle is beyond.
    let [first, end] = [a[0], b[0]].map(|edge| ((edge - 0.5).ceil() as usize).min(length));
    let parts = |x: f32| (WHOLE as f32 * x) as i32;
    for i in first..end {
        let middle = a[1] + slope * (i as f32 + 0.5 - a[0]);
        let (mut from, to) = (parts(middle - half).max(0), parts(middle + half).min(breadth));
        while from < to {
            let j = from / WHOLE as i32;
            let next = ((j + 1) * WHOLE as i32).min(to);
            let at = if steep { i * stride + j as usize } else { j as usize * stride + i };
            if let Some(pixel) = pixels.colors.get_mut(at) {
                cover(pixel, color, (next - from) as u32);
            }
            from = next;
        }
    }
}

/// A share from 0 to 1, of [`WHOLE`].
fn share(share: f32) -> u32 {
    ((WHOLE as f32 * share + 0.5) as u32).min(WHOLE)
}

/// Cells, each in the colour of its shade. A cell becomes a block of whole device pixels; where cells are smaller than
/// pixels, a pixel shows the largest shade in it, because walls and peaks are one cell thin.
pub fn cells(pixels: &mut Pixels, area: Area, cells: &Cells, colors: &[Color; 256]) {
    let Some([x0, y0, x1, y1]) = area.within(pixels) else { return };
    let Some(count @ 1..) = cells.shades.len().checked_div(cells.columns) else { return };
    let across = &spans(area.x0, area.x1, cells.columns)[(x0 as i32 - area.x0) as usize..];
    let down = &spans(area.y0, area.y1, count)[(y0 as i32 - area.y0) as usize..];
    let rows = pixels.rows().take(y1).skip(y0);
    let (mut line, mut last) = (vec![[0; 4]; x1 - x0], None);
    for (row, &span) in rows.zip(down) {
        if last.replace(span) != Some(span) {
            for (pixel, &column) in line.iter_mut().zip(across) {
                *pixel = colors[usize::from(shade(cells, column, span))];
            }
        }
        row[x0..x1].copy_from_slice(&line);
    }
}

/// The cells [first, end) that each device pixel from `start` to `end` shows, of `count` in a row.
fn spans(start: i32, end: i32, count: usize) -> Vec<(usize, usize)> {
    let size = (end - start) as usize;
    (0..size)
        .map(|pixel| {
            let first = (2 * pixel + 1) * count / (2 * size); // the cell below the pixel's middle
            if size >= count { (first, first + 1) } else { (pixel * count / size, (pixel + 1) * count / size) }
        })
        .collect()
}

/// The largest shade; of a map, a wall if there is one, else the least.
fn shade(cells: &Cells, (i0, i1): (usize, usize), (j0, j1): (usize, usize)) -> u8 {
    if i1 == i0 + 1 && j1 == j0 + 1 {
        return cells.shades[j0 * cells.columns + i0];
    }
    let (mut least, mut most) = (u8::MAX, u8::MIN);
    for j in j0..j1 {
        for &shade in &cells.shades[j * cells.columns + i0..j * cells.columns + i1] {
            (least, most) = (least.min(shade), most.max(shade));
        }
    }
    if cells.walls.is_none_or(|unknown| most > unknown) { most } else { least }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: u8 = 0;
    const UNKNOWN: u8 = 128;
    const OCCUPIED: u8 = 255;

    fn grey(shade: u8) -> Color {
        [shade, shade, shade, 255]
    }

    fn colors() -> [Color; 256] {
        core::array::from_fn(|shade| grey(shade as u8))
    }

    fn red(pixels: &Pixels) -> Vec<u8> {
        pixels.colors.iter().map(|[red, ..]| *red).collect()
    }

    #[test]
    fn cells_become_equal_blocks() {
        let mut pixels = Pixels::new([4, 4]);
        let four = Cells { columns: 2, shades: &[10, 20, 30, 40], walls: Some(UNKNOWN) };
        cells(&mut pixels, Area { x0: 0, y0: 0, x1: 4, y1: 4 }, &four, &colors());
        assert_eq!(red(&pixels), [10, 10, 20, 20, 10, 10, 20, 20, 30, 30, 40, 40, 30, 30, 40, 40]);
    }

    #[test]
    fn a_wall_thinner_than_a_pixel_survives() {
        let mut pixels = Pixels::new([3, 1]);
        let shades = &[FREE, OCCUPIED, FREE, FREE, FREE, FREE, FREE, FREE, UNKNOWN];
        let area = Area { x0: 0, y0: 0, x1: 3, y1: 1 };
        cells(&mut pixels, area, &Cells { columns: 9, shades, walls: Some(UNKNOWN) }, &colors());
        assert_eq!(red(&pixels), [OCCUPIED, FREE, FREE]);
        cells(&mut pixels, area, &Cells { columns: 9, shades, walls: None }, &colors());
        assert_eq!(red(&pixels), [OCCUPIED, FREE, UNKNOWN], "the largest of each three");
    }

    #[test]
    fn what_lies_outside_is_not_drawn() {
        let mut pixels = Pixels::new([2, 2]);
        fill(&mut pixels, Area { x0: -5, y0: -5, x1: 1, y1: 1 }, grey(9));
        fill(&mut pixels, Area { x0: 2, y0: 0, x1: 9, y1: 9 }, grey(9));
        fill(&mut pixels, Area { x0: 1, y0: 1, x1: 0, y1: 0 }, grey(9));
        let one = Cells { columns: 1, shades: &[7], walls: Some(UNKNOWN) };
        cells(&mut pixels, Area { x0: 1, y0: 1, x1: 9, y1: 9 }, &one, &colors());
        assert_eq!(red(&pixels), [9, 0, 0, 7]);
        let none = Cells { columns: 0, shades: &[], walls: None };
        cells(&mut pixels, Area { x0: 0, y0: 0, x1: 2, y1: 2 }, &none, &colors());
        assert_eq!(red(&pixels), [9, 0, 0, 7]);
    }
}
