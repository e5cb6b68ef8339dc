//! Filling rectangles and magnifying maps, straight into the pixels.

use crate::scene::{Cells, UNKNOWN};
use tiny_skia::{Pixmap, PremultipliedColorU8 as Color};

/// A rectangle of device pixels, upper ends exclusive; may lie partly or wholly outside of the canvas.
#[derive(Clone, Copy, Debug)]
pub struct Area {
    pub x0: i32,
    pub y0: i32,
    pub x1: i32,
    pub y1: i32,
}

impl Area {
    fn within(self, pixels: &Pixmap) -> Option<[usize; 4]> {
        let [x0, x1] = [self.x0, self.x1].map(|x| x.clamp(0, pixels.width() as i32) as usize);
        let [y0, y1] = [self.y0, self.y1].map(|y| y.clamp(0, pixels.height() as i32) as usize);
        (x0 < x1 && y0 < y1).then_some([x0, y0, x1, y1])
    }
}

/// One colour.
pub fn fill(pixels: &mut Pixmap, area: Area, color: Color) {
    let Some([x0, y0, x1, y1]) = area.within(pixels) else { return };
    let width = pixels.width() as usize;
    let rows = pixels.pixels_mut().chunks_exact_mut(width);
    rows.take(y1).skip(y0).for_each(|row| row[x0..x1].fill(color));
}

/// A disc: a pixel is covered as far as its middle is from the edge, which is nearly its area, and quick.
pub fn disc(pixels: &mut Pixmap, [x, y]: [f32; 2], radius: f32, color: Color) {
    let reach = radius + 0.5;
    let [x0, x1, y0, y1] = [x - reach, x + reach, y - reach, y + reach].map(|edge| edge.floor() as i32);
    let area = Area { x0, y0, x1: x1.saturating_add(1), y1: y1.saturating_add(1) };
    let Some([x0, y0, x1, y1]) = area.within(pixels) else { return };
    let width = pixels.width() as usize;
    for (j, row) in pixels.pixels_mut().chunks_exact_mut(width).enumerate().take(y1).skip(y0) {
        for (i, pixel) in row.iter_mut().enumerate().take(x1).skip(x0) {
            let (dx, dy) = (i as f32 + 0.5 - x, j as f32 + 0.5 - y);
            cover(pixel, color, reach - (dx * dx + dy * dy).sqrt());
        }
    }
}

/// A thin line without ends: of each column it crosses (of each row, where it is steep), it covers the pixels as its strip does.
/// The pieces of a curve share no column, so that no joint is darker.
pub fn strand(pixels: &mut Pixmap, a: [f32; 2], b: [f32; 2], width: f32, color: Color) {
    let steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
    // Along the line, then across.
    let turn = |[x, y]: [f32; 2]| if steep { [y, x] } else { [x, y] };
    let [mut a, mut b] = [turn(a), turn(b)];
    if a[0] > b[0] {
        (a, b) = (b, a);
    }
    let stride = pixels.width() as usize;
    let [length, breadth] = turn([pixels.width() as f32, pixels.height() as f32]);
    let slope = (b[1] - a[1]) / (b[0] - a[0]);
    let half = 0.5 * width * (1.0 + slope * slope).sqrt();
    let first = |edge: f32| (edge - 0.5).ceil().min(length) as usize; // the first whose middle is beyond
    if ![a[0], a[1], b[0], b[1], half].iter().all(|x| x.is_finite()) {
        return;
    }
    for i in first(a[0])..first(b[0]) {
        let middle = a[1] + slope * (i as f32 + 0.5 - a[0]);
        let (from, to) = ((middle - half).max(0.0), (middle + half).min(breadth));
        for j in from as usize..to.ceil() as usize {
            let at = if steep { i * stride + j } else { j * stride + i };
            let share = to.min(j as f32 + 1.0) - from.max(j as f32);
            if let Some(pixel) = pixels.pixels_mut().get_mut(at) {
                cover(pixel, color, share);
            }
        }
    }
}

/// Covers a share of a pixel, 0 to 1.
fn cover(pixel: &mut Color, color: Color, share: f32) {
    let cover = (255.0 * share.clamp(0.0, 1.0) + 0.5) as i32;
    let mix = |from: u8, to: u8| (i32::from(from) + (i32::from(to) - i32::from(from)) * cover / 255) as u8;
    let [r, g, b] = [mix(pixel.red(), color.red()), mix(pixel.green(), color.green()), mix(pixel.blue(), color.blue())];
    *pixel = Color::from_rgba(r, g, b, 255).unwrap_or(color); // opaque stays opaque
}

/// Cells, each in the colour of its shade. A cell becomes a block of whole device pixels; where cells are smaller than
/// pixels, a pixel shows the largest shade in it, because walls and peaks are one cell thin. In a map (`walls`), it shows a wall if
/// one lies in it.
pub fn raster(pixels: &mut Pixmap, area: Area, cells: &Cells, walls: bool, colors: &[Color; 256]) {
    let Some([x0, y0, x1, y1]) = area.within(pixels) else { return };
    let Some(count @ 1..) = cells.shades.len().checked_div(cells.columns) else { return };
    let across = &spans(area.x0, area.x1, cells.columns)[(x0 as i32 - area.x0) as usize..];
    let down = &spans(area.y0, area.y1, count)[(y0 as i32 - area.y0) as usize..];
    let width = pixels.width() as usize;
    let rows = pixels.pixels_mut().chunks_exact_mut(width).take(y1).skip(y0);
    let (mut line, mut last) = (vec![Color::TRANSPARENT; x1 - x0], None);
    for (row, &span) in rows.zip(down) {
        if last.replace(span) != Some(span) {
            for (pixel, &column) in line.iter_mut().zip(across) {
                *pixel = colors[usize::from(shade(cells, walls, column, span))];
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

/// The largest shade; of a map, a wall if there is one, else what is freest: unknown cells must not close an open door.
fn shade(cells: &Cells, walls: bool, (i0, i1): (usize, usize), (j0, j1): (usize, usize)) -> u8 {
    if i1 == i0 + 1 && j1 == j0 + 1 {
        return cells.shades[j0 * cells.columns + i0];
    }
    let (mut least, mut most) = (u8::MAX, u8::MIN);
    for j in j0..j1 {
        for &shade in &cells.shades[j * cells.columns + i0..j * cells.columns + i1] {
            (least, most) = (least.min(shade), most.max(shade));
        }
    }
    if most > UNKNOWN || !walls { most } else { least }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{FREE, OCCUPIED};

    fn grey(shade: u8) -> Color {
        Color::from_rgba(shade, shade, shade, 255).unwrap()
    }

    fn colors() -> [Color; 256] {
        core::array::from_fn(|shade| grey(shade as u8))
    }

    fn canvas([width, height]: [u32; 2]) -> Pixmap {
        Pixmap::new(width, height).unwrap()
    }

    fn red(pixels: &Pixmap) -> Vec<u8> {
        pixels.pixels().iter().map(|p| p.red()).collect()
    }

    #[test]
    fn cells_become_equal_blocks() {
        let mut pixels = canvas([4, 4]);
        let cells = Cells { columns: 2, shades: vec![10, 20, 30, 40] };
        raster(&mut pixels, Area { x0: 0, y0: 0, x1: 4, y1: 4 }, &cells, true, &colors());
        assert_eq!(red(&pixels), [10, 10, 20, 20, 10, 10, 20, 20, 30, 30, 40, 40, 30, 30, 40, 40]);
    }

    #[test]
    fn a_wall_thinner_than_a_pixel_survives() {
        let mut pixels = canvas([3, 1]);
        let mut shades = vec![FREE; 9];
        (shades[1], shades[8]) = (OCCUPIED, UNKNOWN);
        raster(
            &mut pixels,
            Area { x0: 0, y0: 0, x1: 3, y1: 1 },
            &Cells { columns: 9, shades: shades.clone() },
            true,
            &colors(),
        );
        assert_eq!(red(&pixels), [OCCUPIED, FREE, FREE]);
        raster(&mut pixels, Area { x0: 0, y0: 0, x1: 3, y1: 1 }, &Cells { columns: 9, shades }, false, &colors());
        assert_eq!(red(&pixels), [OCCUPIED, FREE, UNKNOWN], "the largest of each three");
    }

    #[test]
    fn what_lies_outside_is_not_drawn() {
        let mut pixels = canvas([2, 2]);
        fill(&mut pixels, Area { x0: -5, y0: -5, x1: 1, y1: 1 }, grey(9));
        fill(&mut pixels, Area { x0: 2, y0: 0, x1: 9, y1: 9 }, grey(9));
        fill(&mut pixels, Area { x0: 1, y0: 1, x1: 0, y1: 0 }, grey(9));
        let cells = Cells { columns: 1, shades: vec![7] };
        raster(&mut pixels, Area { x0: 1, y0: 1, x1: 9, y1: 9 }, &cells, true, &colors());
        assert_eq!(red(&pixels), [9, 0, 0, 7]);
        let none = Cells { columns: 0, shades: Vec::new() };
        raster(&mut pixels, Area { x0: 0, y0: 0, x1: 2, y1: 2 }, &none, false, &colors());
        assert_eq!(red(&pixels), [9, 0, 0, 7]);
    }
}
