//! Our fill of paths against tiny-skia's, in every golden picture.
//!
//! tiny-skia looks at 4 × 4 places in a pixel. Ours looks along the same four lines, and is exact along each. Who is right where they
//! differ is told by tiny-skia at four times the size: 16 × 16 places in a pixel.

use fastslam_widgets::paint::path::{Path, Segment};
use fastslam_widgets::paint::{Canvas, Color, Fill, Pixels, Theme};
use figures::{PICTURES, Picture, figure};
use tiny_skia::{FillRule, Mask, Paint, PathBuilder, PixmapMut, Transform};

/// Finer by this.
const CELLS_PER_NDT: u32 = 4;

/// As tiny-skia has it; none if there is nothing to fill.
fn theirs(path: &Path) -> Option<tiny_skia::Path> {
    let mut builder = PathBuilder::new();
    for &segment in path.segments() {
        match segment {
            Segment::Move([x, y]) => builder.move_to(x, y),
            Segment::Line([x, y]) => builder.line_to(x, y),
            Segment::Cubic([x1, y1], [x2, y2], [x, y]) => builder.cubic_to(x1, y1, x2, y2, x, y),
        }
    }
    builder.finish()
}

fn tiny_skia(pixels: &mut Pixels, path: &Path, [r, g, b, a]: Color) {
    let Some(path) = theirs(path) else { return };
    let [width, height] = pixels.size();
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, a);
    let mut pixels = PixmapMut::from_bytes(pixels.bytes_mut(), width, height).unwrap();
    pixels.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), None);
}

/// tiny-skia at [`CELLS_PER_NDT`] times the size, averaged.
fn fine(pixels: &mut Pixels, path: &Path, color: Color) {
    let Some(path) = theirs(path) else { return };
    let [width, height] = pixels.size();
    let bounds = path.bounds();
    let [x0, x1] = [bounds.left().floor(), bounds.right().ceil()].map(|x| x.clamp(0.0, width as f32) as u32);
    let [y0, y1] = [bounds.top().floor(), bounds.bottom().ceil()].map(|y| y.clamp(0.0, height as f32) as u32);
    let Some(mut mask) = Mask::new(CELLS_PER_NDT * (x1 - x0), CELLS_PER_NDT * (y1 - y0)) else { return };
    let larger =
        Transform::from_translate(-(x0 as f32), -(y0 as f32)).post_scale(CELLS_PER_NDT as f32, CELLS_PER_NDT as f32);
    mask.fill_path(&path, FillRule::Winding, true, larger);
    let bytes = pixels.bytes_mut();
    for (y, x) in (y0..y1).flat_map(|y| (x0..x1).map(move |x| (y, x))) {
        let [left, top] = [CELLS_PER_NDT * (x - x0), CELLS_PER_NDT * (y - y0)];
        let row = |y: u32| &mask.data()[(y * mask.width() + left) as usize..][..CELLS_PER_NDT as usize];
        let sum: u32 = (top..top + CELLS_PER_NDT).flat_map(row).map(|&share| u32::from(share)).sum();
        let share = f64::from(sum) / f64::from(255 * CELLS_PER_NDT * CELLS_PER_NDT);
        for (byte, to) in bytes[4 * (y * width + x) as usize..].iter_mut().zip(color) {
            *byte = (f64::from(*byte) + share * (f64::from(to) - f64::from(*byte))).round() as u8;
        }
    }
}

/// A golden picture, its paths filled by another.
fn painted(picture: &Picture, fill: &mut Fill<'_>) -> Vec<u8> {
    let figure = figure(picture.tag, picture.query);
    let size = picture.size(figure.height(f64::from(picture.width)));
    let [width, height] = size.map(|side| f64::from(side) / picture.dpr);
    let mut canvas = Canvas::default();
    let scene = figure.scene(width, height);
    canvas.paint_with(&scene, size[0], size[1], Theme::named(picture.theme), fill);
    canvas.pixels().to_vec()
}

/// How far two pictures are apart: the mean square difference of a channel, and the greatest.
fn apart(a: &[u8], b: &[u8]) -> (f64, u8) {
    let differences = || a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
    let squares: f64 = differences().map(|d| f64::from(d) * f64::from(d)).sum();
    (squares / a.len() as f64, differences().max().unwrap_or(0))
}

#[test]
fn our_fill_is_nearer_to_the_truth_than_tiny_skias_and_not_far_from_it() {
    for picture in PICTURES {
        let (figure, _) = picture.paint();
        let ours = figure.canvas().pixels();
        let [theirs, truth] = [painted(picture, &mut tiny_skia), painted(picture, &mut fine)];
        let [ours_from_truth, theirs_from_truth, ours_from_theirs] =
            [apart(ours, &truth), apart(&theirs, &truth), apart(ours, &theirs)];
        let told = format!("{}: {ours_from_truth:?} {theirs_from_truth:?} {ours_from_theirs:?}", picture.name);
        // Found: at most 0.64 of theirs.
        assert!(ours_from_truth.0 < 0.7 * theirs_from_truth.0, "{told}");
        // Nor is any pixel of ours further from it, but by a level or two: on edges that follow a line, either may be lucky.
        assert!(ours_from_truth.1 <= theirs_from_truth.1 + 2, "{told}");
        // tiny-skia puts an edge up to an eighth of a pixel aside, 32 levels: both of a thin line, 64; and a mark may lie on another.
        // In the mean of all pixels (most have no edge) that is three levels.
        assert!(ours_from_theirs.0 < 3.2 * 3.2 && ours_from_theirs.1 <= 80, "{told}");
    }
}
