//! Magnifying maps: cells as blocks of whole device pixels, written straight into the picture.

use crate::scene::{Cells, UNKNOWN};
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// How the shade of a pixel is chosen where cells are smaller than pixels.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Smaller {
    /// A wall if there is one in the pixel, because walls are one cell thin. Else what is freest: unknown cells must not close an open
    /// door.
    WallThenFree,
    /// The largest shade: peaks are one cell thin.
    Largest,
}

/// Draws cells between a left, upper, right and lower edge \[device px\], which may lie outside of the picture, each in the colour of
/// its shade. What is behind a transparent one shines through.
pub fn draw(
    pixmap: &mut Pixmap,
    edges: [i32; 4],
    cells: &Cells,
    smaller: Smaller,
    colors: &[PremultipliedColorU8; 256],
) {
    let [left, top, right, bottom] = edges;
    let Some(rows @ 1..) = cells.shades.len().checked_div(cells.columns) else { return };
    let within = |edge: i32, side: u32| edge.clamp(0, side as i32) as usize;
    let [x0, x1] = [left, right].map(|x| within(x, pixmap.width()));
    let [y0, y1] = [top, bottom].map(|y| within(y, pixmap.height()));
    if x0 >= x1 || y0 >= y1 {
        return;
    }
    let across = &spans(left, right, cells.columns)[(x0 as i32 - left) as usize..];
    let down = &spans(top, bottom, rows)[(y0 as i32 - top) as usize..];
    let width = pixmap.width() as usize;
    let lines = pixmap.pixels_mut().chunks_exact_mut(width).take(y1).skip(y0);
    let covers = colors.iter().all(|color| color.is_opaque());
    // Pixels of the same cells are the same line.
    let (mut drawn, mut last) = (Vec::new(), None);
    for (line, &span) in lines.zip(down) {
        if last.replace(span) != Some(span) {
            drawn.clear();
            drawn.extend(
                across[..x1 - x0].iter().map(|&column| colors[usize::from(shade(cells, column, span, smaller))]),
            );
        }
        if covers {
            line[x0..x1].copy_from_slice(&drawn);
        } else {
            let seen = line[x0..x1].iter_mut().zip(&drawn).filter(|(_, color)| color.alpha() > 0);
            seen.for_each(|(pixel, color)| *pixel = over(*color, *pixel));
        }
    }
}

/// A colour over another, opaque one.
fn over(color: PremultipliedColorU8, behind: PremultipliedColorU8) -> PremultipliedColorU8 {
    let clear = u16::from(255 - color.alpha());
    let mix = |c: u8, b: u8| c + ((u16::from(b) * clear + 127) / 255) as u8;
    let [r, g, b] =
        [mix(color.red(), behind.red()), mix(color.green(), behind.green()), mix(color.blue(), behind.blue())];
    PremultipliedColorU8::from_rgba(r, g, b, 255).unwrap_or(behind)
}

/// The cells [first, end) that each device pixel from `start` to `end` shows, of `count` in a row.
fn spans(start: i32, end: i32, count: usize) -> Vec<(usize, usize)> {
    let size = (end - start) as usize;
    let span = |pixel: usize| {
        let below_its_middle = (2 * pixel + 1) * count / (2 * size);
        if size >= count {
            (below_its_middle, below_its_middle + 1)
        } else {
            (pixel * count / size, (pixel + 1) * count / size)
        }
    };
    (0..size).map(span).collect()
}

/// What a pixel shows of the cells in it.
fn shade(cells: &Cells, (i0, i1): (usize, usize), (j0, j1): (usize, usize), smaller: Smaller) -> u8 {
    if i1 - i0 == 1 && j1 - j0 == 1 {
        return cells.shades[j0 * cells.columns + i0];
    }
    let inside = || (j0..j1).flat_map(|j| &cells.shades[j * cells.columns + i0..j * cells.columns + i1]).copied();
    let largest = inside().max().unwrap_or(UNKNOWN);
    match smaller {
        Smaller::WallThenFree if largest <= UNKNOWN => inside().min().unwrap_or(UNKNOWN),
        _ => largest,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{FREE, OCCUPIED};

    /// The red of each pixel of a picture of this size, black but for the cells.
    fn drawn([width, height]: [u32; 2], edges: [i32; 4], columns: usize, shades: &[u8], smaller: Smaller) -> Vec<u8> {
        let colors = core::array::from_fn(|shade| PremultipliedColorU8::from_rgba(shade as u8, 0, 0, 255).unwrap());
        let mut pixmap = Pixmap::new(width, height).unwrap();
        draw(&mut pixmap, edges, &Cells { columns, shades: shades.to_vec() }, smaller, &colors);
        pixmap.pixels().iter().map(|pixel| pixel.red()).collect()
    }

    #[test]
    fn cells_become_equal_blocks() {
        let blocks = drawn([4, 4], [0, 0, 4, 4], 2, &[10, 20, 30, 40], Smaller::WallThenFree);
        assert_eq!(blocks, [10, 10, 20, 20, 10, 10, 20, 20, 30, 30, 40, 40, 30, 30, 40, 40]);
    }

    #[test]
    fn a_wall_thinner_than_a_pixel_survives() {
        let shades = &[FREE, OCCUPIED, FREE, FREE, FREE, FREE, FREE, FREE, UNKNOWN];
        let drawn = |smaller| drawn([3, 1], [0, 0, 3, 1], 9, shades, smaller);
        assert_eq!(drawn(Smaller::WallThenFree), [OCCUPIED, FREE, FREE]);
        assert_eq!(drawn(Smaller::Largest), [OCCUPIED, FREE, UNKNOWN], "the largest of each three");
    }

    #[test]
    fn what_is_behind_a_transparent_cell_shines_through() {
        let red = PremultipliedColorU8::from_rgba(200, 0, 0, 255).unwrap();
        let mut colors = [red; 256];
        colors[0] = PremultipliedColorU8::TRANSPARENT;
        colors[9] = PremultipliedColorU8::from_rgba(100, 0, 0, 128).unwrap();
        let mut pixmap = Pixmap::new(4, 1).unwrap();
        pixmap.pixels_mut().fill(PremultipliedColorU8::from_rgba(80, 7, 7, 255).unwrap());
        draw(&mut pixmap, [0, 0, 4, 1], &Cells { columns: 4, shades: vec![0, 9, 0, 255] }, Smaller::Largest, &colors);
        assert_eq!(pixmap.pixels().iter().map(|pixel| pixel.red()).collect::<Vec<_>>(), [80, 140, 80, 200]);
    }

    #[test]
    fn what_lies_outside_is_not_drawn() {
        let drawn = |edges, columns, shades: &[u8]| drawn([2, 2], edges, columns, shades, Smaller::Largest);
        assert_eq!(drawn([-5, -5, 1, 1], 1, &[9]), [9, 0, 0, 0]);
        assert_eq!(drawn([1, 1, 9, 9], 1, &[7]), [0, 0, 0, 7]);
        for edges in [[2, 0, 9, 9], [1, 1, 0, 0], [-9, -9, -3, -3]] {
            assert_eq!(drawn(edges, 1, &[7]), [0; 4], "{edges:?}");
        }
        assert_eq!(drawn([0, 0, 2, 2], 0, &[]), [0; 4], "no cells");
    }
}
