//! Dividing the mosaic: as many equal tiles as universes, as large as they fit.

use crate::scene::Rect;

/// The tiles of a mosaic, in slot order from the upper left, row by row.
#[derive(Clone, PartialEq, Debug)]
pub struct Tiles {
    /// Tiles in a row.
    pub columns: usize,
    /// Size of one \[css px\].
    pub size: [f64; 2],
    /// Between two in a row, and between two rows \[css px\].
    pub gap: [f64; 2],
    origin: [f64; 2],
}

impl Tiles {
    /// The largest `count` tiles of this aspect (width / height) that fit the area.
    pub fn fit(area: &Rect, count: usize, aspect: f64) -> Self {
        let mut best: Option<Self> = None;
        for columns in 1..=count {
            let rows = count.div_ceil(columns);
            // Wider gaps between larger tiles: about a sixteenth of the tile.
            let across = (area.w / columns as f64 / 14.0).clamp(3.0, 10.0);
            // Of the same aspect as the tiles, so that a square number of them fills an area of that aspect.
            let gap = [across, across / aspect];
            let room = |length: f64, n: usize, gap: f64| (length - gap * (n - 1) as f64) / n as f64;
            let width = room(area.w, columns, gap[0]).min(room(area.h, rows, gap[1]) * aspect);
            if best.as_ref().is_none_or(|b| width > b.size[0] + 1e-9) {
                best = Some(Self { columns, size: [width, width / aspect], gap, origin: [area.x, area.y] });
            }
        }
        best.expect("there is at least one universe")
    }

    /// The tile of a slot.
    pub fn tile(&self, slot: usize) -> Rect {
        let [w, h] = self.size;
        let (column, row) = ((slot % self.columns) as f64, (slot / self.columns) as f64);
        Rect::new(self.origin[0] + column * (w + self.gap[0]), self.origin[1] + row * (h + self.gap[1]), w, h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_fill_the_area_and_never_overlap() {
        for (w, h) in [(340.0, 263.0), (280.0, 500.0), (351.0, 272.0), (900.0, 300.0)] {
            let area = Rect::new(10.0, 20.0, w, h);
            for count in 1..=256 {
                let tiles = Tiles::fit(&area, count, 22.0 / 17.0);
                let all: Vec<Rect> = (0..count).map(|slot| tiles.tile(slot)).collect();
                assert!(all.iter().all(|t| area.encloses(t) && t.w >= 8.0), "{count} in {w} × {h}");
                for (k, a) in all.iter().enumerate() {
                    assert!(all[..k].iter().all(|b| !a.overlaps(b)), "{count} in {w} × {h}");
                }
                let used: f64 = all.iter().map(|t| (t.w + tiles.gap[0]) * (t.h + tiles.gap[1])).sum();
                assert!(used > 0.3 * w * h, "{count} in {w} × {h}: {used}");
            }
        }
    }

    #[test]
    fn square_numbers_fill_an_area_of_their_aspect() {
        let area = Rect::new(0.0, 0.0, 340.0, 263.0);
        for n in 1..=16 {
            let tiles = Tiles::fit(&area, n * n, 340.0 / 263.0);
            let last = tiles.tile(n * n - 1);
            assert_eq!(tiles.columns, n);
            assert!((last.right() - 340.0).abs() < 1e-6 && (last.bottom() - 263.0).abs() < 1e-6, "{n}: {last:?}");
        }
    }
}
