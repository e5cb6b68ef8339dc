//! The part of a grid around a robot, for a matcher that looks at it thousands of times in one step.

use super::quad::{Apart, Corners, Quad, least};
use super::tile::{MAX_DISTANCE, SHIFT, TILE};
use super::{CellRect, Grid, LANES, NdtField, Nearest, fast_floor};
use wide::{CmpGt, f64x4, i32x4};

/// Farthest from the robot that anything is kept for \[m\]; what lies beyond is looked up in the grid.
const RADIUS: f64 = 12.0;

/// About as many quads as the poses of one step ask for: room for them is asked for once.
const USUAL_QUADS: usize = 512;

/// A grid around a place, without the two levels of pointers that it has. What end points are compared with is put together where one falls
/// for the first time: poses that are tried in one step differ by little, so that each is asked for again some ten times.
pub(crate) struct LocalMap<const CELLS_PER_NDT: usize> {
    grid: Grid<CELLS_PER_NDT>,
    /// In NDT cells.
    rect: CellRect,
    /// One for each lane, which a point outside the rectangle is compared with, and then all within it, in the order in which they were asked for.
    quads: Vec<Quad>,
    /// By the NDT cell at its lower left: the index of a quad, or 0 where none was asked for yet.
    places: Vec<u32>,
    /// The distance field; empty where there is none.
    distances: Vec<u8>,
}

impl<const CELLS_PER_NDT: usize> LocalMap<CELLS_PER_NDT> {
    /// All within `radius` \[m\] of a place, and within [`RADIUS`]; without the distance field.
    pub fn new(grid: Grid<CELLS_PER_NDT>, [x, y]: [f64; 2], radius: f64) -> Self {
        let reach = (radius.min(RADIUS) * grid.per_ndt) as i32 + 2;
        let (i, j) = (fast_floor(x * grid.per_ndt), fast_floor(y * grid.per_ndt));
        let known = grid.directory.rect;
        let clip = |k: i32, low: i32, high: i32| (k >> SHIFT).clamp(low, high) * TILE;
        let rect = CellRect {
            i0: clip(i.saturating_sub(reach), known.i0, known.i1),
            j0: clip(j.saturating_sub(reach), known.j0, known.j1),
            i1: clip(i.saturating_add(reach + TILE), known.i0, known.i1),
            j1: clip(j.saturating_add(reach + TILE), known.j0, known.j1),
        };
        let places = vec![0; rect.width() * rect.height()];
        let mut quads = Vec::with_capacity(USUAL_QUADS);
        quads.resize(LANES, Quad::UNKNOWN);
        Self { grid, rect, quads, places, distances: Vec::new() }
    }

    /// The same with the distance field, if the grid keeps one.
    pub fn with_distances(mut self) -> Self {
        if self.grid.model.distance_reach == 0 {
            return self;
        }
        let rect = self.rect;
        self.distances = vec![MAX_DISTANCE as u8; self.places.len()];
        for (j, i) in (rect.j0..rect.j1)
            .step_by(TILE as usize)
            .flat_map(|j| (rect.i0..rect.i1).step_by(TILE as usize).map(move |i| (j, i)))
        {
            let Some(tile) = self.grid.directory.tile(i >> SHIFT, j >> SHIFT) else { continue };
            for row in 0..TILE {
                let start = (j + row - rect.j0) as usize * rect.width() + (i - rect.i0) as usize;
                for (column, distance) in self.distances[start..start + TILE as usize].iter_mut().enumerate() {
                    *distance = tile.distance((row << SHIFT) as usize + column) as u8;
                }
            }
        }
        self
    }

    /// The indices of the quads of these corners.
    #[inline]
    fn quads_at(&mut self, corners: &Corners) -> [usize; LANES] {
        let ([i, j], CellRect { i0, j0, i1, j1 }) = (corners.cell, self.rect);
        let (columns, rows) = (i32x4::splat(i1 - i0), i32x4::splat(j1 - j0));
        let (column, row) = (i - i0, j - j0);
        let none = i32x4::splat(-1);
        let inside = column.cmp_gt(none) & row.cmp_gt(none) & columns.cmp_gt(column) & rows.cmp_gt(row);
        if !inside.all() {
            return self.quads_anywhere(corners);
        }
        (row * columns + column).to_array().map(|place| {
            let quad = self.places[place as usize] as usize;
            if quad == 0 { self.add_quad(place as usize) } else { quad }
        })
    }

    /// The same where some of them may be outside the rectangle.
    #[cold]
    #[inline(never)]
    fn quads_anywhere(&mut self, corners: &Corners) -> [usize; LANES] {
        let [i, j] = corners.cell.map(i32x4::to_array);
        core::array::from_fn(|k| match self.rect.index(i[k], j[k]) {
            Some(place) if self.places[place] == 0 => self.add_quad(place),
            Some(place) => self.places[place] as usize,
            None => {
                self.quads[k] = self.grid.quad(i[k], j[k]);
                k
            }
        })
    }

    /// Apart, because the loop that asks for quads is better without it.
    #[cold]
    #[inline(never)]
    fn add_quad(&mut self, place: usize) -> usize {
        let columns = self.rect.width();
        let (column, row) = ((place % columns) as i32, (place / columns) as i32);
        self.quads.push(self.grid.quad(self.rect.i0 + column, self.rect.j0 + row));
        self.places[place] = self.quads.len() as u32 - 1;
        self.quads.len() - 1
    }

    /// The distance field \[NDT cells\] at a point given in NDT cells: 0 where an end point fell, [`MAX_DISTANCE`] where none fell near.
    #[inline]
    pub fn distance(&self, u: f64, v: f64) -> usize {
        let (i, j) = (fast_floor(u), fast_floor(v));
        let distance = self.rect.index(i, j).and_then(|place| self.distances.get(place));
        distance.map_or_else(|| self.grid.distance(i, j), |distance| usize::from(*distance))
    }

    /// How many quads were put together.
    #[cfg(test)]
    pub fn quad_count(&self) -> usize {
        self.quads.len() - LANES
    }

    /// NDT cells a metre.
    pub fn per_ndt(&self) -> f64 {
        self.grid.per_ndt
    }
}

impl<const CELLS_PER_NDT: usize> NdtField for LocalMap<CELLS_PER_NDT> {
    fn units_at(&mut self, point: [f64; 2]) -> i8 {
        (&self.grid).units_at(point)
    }

    #[inline]
    fn nearest_ndt(&mut self, points: [f64x4; 2]) -> Nearest {
        let (corners, apart) = (self.grid.corners(points), Apart::new(self.grid.ndt_size as f32));
        let [a, b, c, d] = self.quads_at(&corners);
        // One after the other and not in a loop, in which what is found would go through memory.
        let at = |quad: usize, lane| self.quads[quad].at(lane, &corners, &apart);
        let (a, b, c, d) = (at(a, 0), at(b, 1), at(c, 2), at(d, 3));
        Nearest { d2: least([a.0, b.0, c.0, d.0]), units: [a.1, b.1, c.1, d.1] }
    }
}
