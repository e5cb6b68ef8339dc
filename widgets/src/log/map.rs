//! From the world to the picture: which part of the building is shown, and where.

use crate::scene::{Cells, OCCUPIED, Plane, Point, Rect, shade};
use fastslam::{map::grid::CellRect, mapper::Map};

/// Least and most of the world in a view \[m\].
const LEAST: f64 = 0.5;
const MOST: f64 = 2e5;

/// A view of the whole grows by whole steps \[m\], so that a map that grows does not make it tremble.
const STEP: f64 = 2.0;

/// A part of the world, upright.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frame {
    /// Its middle \[m\].
    pub centre: [f64; 2],
    /// Width and height \[m\] that are seen at least.
    pub size: [f64; 2],
}

impl Frame {
    /// All between two corners \[m\], and some more.
    pub fn around(least: [f64; 2], most: [f64; 2]) -> Self {
        let low = least.map(|c| (c / STEP).floor() * STEP);
        let high = most.map(|c| (c / STEP).ceil() * STEP);
        let size = [0, 1].map(|k| (high[k] - low[k]).clamp(STEP, MOST));
        Self { centre: [0, 1].map(|k| 0.5 * (low[k] + high[k])), size }
    }

    /// Both of two.
    pub fn both(self, other: Self) -> Self {
        let ends = [self, other]
            .map(|Self { centre, size }| [-0.5, 0.5].map(|side| [0, 1].map(|k| centre[k] + side * size[k])));
        let [[low, high], [least, most]] = ends;
        Self::around([0, 1].map(|k| low[k].min(least[k])), [0, 1].map(|k| high[k].max(most[k])))
    }

    /// All cells that a map has.
    pub fn of_map(map: &Map) -> Self {
        let (CellRect { i0, j0, i1, j1 }, size) = (map.bounds(), map.cell_size());
        let metres = |k: i32| f64::from(k) * size;
        Self::around([metres(i0), metres(j0)], [metres(i1), metres(j1)])
    }
}

/// A frame at a place in the figure: what is seen can be magnified and moved.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MapView(pub Plane);

impl MapView {
    /// The frame, as large as it fits.
    pub fn new(area: Rect, frame: &Frame) -> Self {
        let scale = (area.w / frame.size[0]).min(area.h / frame.size[1]);
        Self(Plane::centred(area, frame.centre, scale))
    }

    /// What is seen of the world.
    pub fn frame(&self) -> Frame {
        let Plane { area, place, scale, .. } = self.0;
        Frame { centre: place, size: [area.w / scale, area.h / scale] }
    }

    /// Moved by \[css px\]: what was below the pointer goes with it.
    pub fn panned(&self, [right, down]: Point) -> Self {
        let bounded = |c: f64| c.clamp(-MOST, MOST);
        let Plane { place: [x, y], scale, .. } = self.0;
        Self(Plane { place: [x - right / scale, y + down / scale].map(bounded), ..self.0 })
    }

    /// Magnified; what was at this point \[css px\] stays there.
    pub fn zoomed(&self, factor: f64, at: Point) -> Self {
        let Plane { area, at: [cx, cy], scale, .. } = self.0;
        let least = area.w.min(area.h);
        let scale = (scale * factor).max(least / MOST).min(least / LEAST);
        let world = self.0.world(at);
        let place = [world[0] - (at[0] - cx) / scale, world[1] + (at[1] - cy) / scale];
        Self(Plane { scale, place, ..self.0 }).panned([0.0; 2])
    }

    /// The cells of a map that are seen, if there are any, and where they lie: whole cells, which may reach over the
    /// edge of the view.
    pub fn cells(&self, map: &Map) -> Option<(Rect, Cells)> {
        let (bounds, size, Plane { area, scale, .. }) = (map.bounds(), map.cell_size(), self.0);
        let ([x0, y1], [x1, y0]) = (self.0.world([area.x, area.y]), self.0.world([area.right(), area.bottom()]));
        let cell = |c: f64| (c / size).floor() as i32;
        let (i0, i1) = (cell(x0).max(bounds.i0), (cell(x1) + 1).min(bounds.i1));
        let (j0, j1) = (cell(y0).max(bounds.j0), (cell(y1) + 1).min(bounds.j1));
        if i0 >= i1 || j0 >= j1 {
            return None;
        }
        let cells = Cells::of(i0..i1, j0..j1, |i, j| shade(map.log_odds(i, j)));
        let [x, y] = self.0.point([f64::from(i0) * size, f64::from(j1) * size]);
        let side = |k: i32| f64::from(k) * size * scale;
        Some((Rect::new(x, y, side(i1 - i0), side(j1 - j0)), cells))
    }

    /// Marked cells of this size \[m\] that are seen, and where they lie, as of a map. Where they are smaller than half a css px, as many of
    /// them as make that are drawn as one: however large a log is, its picture is not.
    pub fn marked(&self, marked: &[[i32; 2]], size: f64) -> (Rect, Cells) {
        let Plane { area, scale, .. } = self.0;
        let together = (0.5 / (size * scale)).ceil().clamp(1.0, 1e6);
        let block = together * size;
        let ([x0, y1], [x1, y0]) = (self.0.world([area.x, area.y]), self.0.world([area.right(), area.bottom()]));
        let of = |metres: f64| (metres / block).floor() as i32;
        let [i0, j0, i1, j1] = [of(x0), of(y0), of(x1) + 1, of(y1) + 1];
        let (columns, rows) = ((i1 - i0) as usize, (j1 - j0) as usize);
        let mut shades = vec![0; columns * rows];
        for cell in marked {
            let [i, j] = cell.map(|k| k.div_euclid(together as i32));
            if (i0..i1).contains(&i) && (j0..j1).contains(&j) {
                shades[(j1 - 1 - j) as usize * columns + (i - i0) as usize] = OCCUPIED;
            }
        }
        let [x, y] = self.0.point([f64::from(i0) * block, f64::from(j1) * block]);
        let side = |blocks: usize| blocks as f64 * block * scale;
        (Rect::new(x, y, side(columns), side(rows)), Cells { columns, shades })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> MapView {
        MapView::new(Rect::new(10.0, 20.0, 400.0, 300.0), &Frame { centre: [3.0, -2.0], size: [40.0, 10.0] })
    }

    #[test]
    fn a_frame_is_seen_as_large_as_it_fits_and_upright() {
        assert_eq!(view().0.scale, 10.0);
        assert_eq!(view().0.point([3.0, -2.0]), [210.0, 170.0]);
        assert_eq!(view().0.point([4.0, -1.0]), [220.0, 160.0]);
        assert_eq!(view().0.world([220.0, 160.0]), [4.0, -1.0]);
    }

    #[test]
    fn what_is_below_the_pointer_stays_there() {
        let at = [50.0, 60.0];
        let world = view().0.world(at);
        for factor in [0.5, 1.0, 3.0] {
            let [x, y] = view().zoomed(factor, at).0.point(world);
            assert!((x - at[0]).abs() < 1e-9 && (y - at[1]).abs() < 1e-9, "{factor}");
        }
        let [x, y] = view().panned([7.0, -3.0]).0.point(world);
        assert!((x - 57.0).abs() < 1e-9 && (y - 57.0).abs() < 1e-9);
    }

    #[test]
    fn no_view_is_nearer_than_half_a_metre_or_farther_than_the_world() {
        let near = (0..99).fold(view(), |view, _| view.zoomed(9.0, [11.0, 21.0]));
        assert_eq!(near.0.scale, 300.0 / LEAST);
        let far = (0..99).fold(view(), |view, _| view.zoomed(0.1, [11.0, 21.0]).panned([1e9, 1e9]));
        assert!(far.0.place.iter().all(|c| c.abs() <= MOST) && far.0.scale == 300.0 / MOST);
    }

    #[test]
    fn marked_cells_lie_where_those_of_a_map_would_and_blocks_of_them_where_they_are_too_small() {
        // Ten px a metre: a cell of 0.2 m is 2 px wide, one of 0.02 m is 0.2, so that three make one.
        for (size, block) in [(0.2, 0.2), (0.02, 0.06)] {
            let cell = [7.0, 4.0].map(|metres| (metres / size) as i32); // beside the middle
            let (area, cells) = view().marked(&[cell, [9_000_000; 2], cell], size);
            let at = cells.shades.iter().position(|shade| *shade > 0).unwrap();
            assert_eq!(cells.shades.iter().filter(|shade| **shade > 0).count(), 1, "one is out of view");
            let rows = cells.shades.len() / cells.columns;
            let [w, h] = [area.w / cells.columns as f64, area.h / rows as f64];
            assert!((w - 10.0 * block).abs() < 1e-9 && (h - w).abs() < 1e-9);
            let [x, y] = [area.x + w * (at % cells.columns) as f64, area.y + h * (at / cells.columns) as f64];
            let [left, below] = view().0.point([f64::from(cell[0]) * size, f64::from(cell[1]) * size]);
            assert!((-1e-9..w).contains(&(left - x)) && (-1e-9..h).contains(&(y + h - below)), "{size}");
            assert!(area.encloses(&view().0.area) && area.w < 404.0 + 4.0 * w);
        }
        let far = (0..99).fold(view(), |view, _| view.zoomed(0.1, [11.0, 21.0]));
        assert!(far.marked(&[[1, 2]], 0.02).1.shades.len() < 4 * 410 * 310);
    }

    #[test]
    fn two_frames_are_both_seen_in_one() {
        let both = Frame::around([0.0; 2], [4.0, 2.0]).both(Frame::around([-6.0, 0.0], [-2.0, 8.0]));
        assert_eq!(both, Frame::around([-6.0, 0.0], [4.0, 8.0]));
    }

    #[test]
    fn a_whole_is_framed_by_steps_so_that_it_does_not_tremble() {
        let frame = Frame::around([-0.1, 0.2], [7.9, 3.0]);
        assert_eq!((frame.centre, frame.size), ([3.0, 2.0], [10.0, 4.0]));
        assert_eq!(Frame::around([-0.5, 0.9], [6.5, 3.9]), frame);
        assert_eq!(Frame::around([1.0; 2], [1.0; 2]).size, [STEP; 2]);
    }
}
