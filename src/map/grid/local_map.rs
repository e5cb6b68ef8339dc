//! The part of a grid around a robot, for a matcher that looks at it thousands of times in one step.

use super::quad::{Quad, least};
use super::tile::{MAX_DISTANCE, SHIFT, TILE};
use super::{BLOCK, CellRect, Grid, NdtField, Nearest, fast_floor};

/// Farthest from the robot that anything is kept for \[m\]; what lies beyond is looked up in the grid.
const RADIUS: f64 = 12.0;

/// A grid around a place, without the two levels of pointers that it has. What end points are compared with is put together where one falls
/// for the first time: poses that are tried in one step differ by little, so that each is asked for again some ten times.
pub(crate) struct LocalMap<const CELLS_PER_NDT: usize> {
    grid: Grid<CELLS_PER_NDT>,
    /// In NDT cells.
    rect: CellRect,
    /// All that were asked for, in that order.
    quads: Vec<Quad>,
    /// By the NDT cell at its lower left: how many quads there were when one was added, or 0 for none yet.
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
        Self { grid, rect, quads: Vec::new(), places, distances: Vec::new() }
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

    /// The quad of the cell at its lower left, if that is near.
    #[inline]
    fn quad(&mut self, i: i32, j: i32) -> Option<&Quad> {
        let place = self.place(i, j)?;
        if self.places[place] == 0 {
            self.add_quad(i, j, place);
        }
        Some(&self.quads[self.places[place] as usize - 1])
    }

    /// Apart, because the loop that asks for quads is better without it.
    #[cold]
    #[inline(never)]
    fn add_quad(&mut self, i: i32, j: i32, place: usize) {
        self.quads.push(self.grid.quad(i, j));
        self.places[place] = self.quads.len() as u32;
    }

    /// Of an NDT cell in the rectangle.
    #[inline]
    fn place(&self, i: i32, j: i32) -> Option<usize> {
        let (column, row) = (i.wrapping_sub(self.rect.i0), j.wrapping_sub(self.rect.j0));
        let (column, row) = (column as u32 as usize, row as u32 as usize);
        (column < self.rect.width() && row < self.rect.height()).then(|| row * self.rect.width() + column)
    }

    /// The distance field \[NDT cells\] at a point given in NDT cells: 0 where an end point fell, [`MAX_DISTANCE`] where none fell near.
    #[inline]
    pub fn distance(&self, u: f64, v: f64) -> usize {
        let (i, j) = (fast_floor(u), fast_floor(v));
        let distance = self.place(i, j).and_then(|place| self.distances.get(place));
        distance.map_or_else(|| self.grid.distance(i, j), |distance| usize::from(*distance))
    }

    /// How many quads were put together.
    #[cfg(test)]
    pub fn quad_count(&self) -> usize {
        self.quads.len()
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

    fn nearest_ndt(&mut self, points: &[[f64; 2]; BLOCK], count: usize) -> Nearest {
        let size = self.grid.ndt_size as f32;
        let corners = points.map(|point| self.grid.corner(point));
        let (mut d2, mut units) = ([[f32::INFINITY; 4]; BLOCK], [0; BLOCK]);
        for (k, corner) in corners.iter().enumerate().take(count) {
            let far;
            let quad = match self.quad(corner.i, corner.j) {
                Some(quad) => quad,
                None => {
                    far = self.grid.quad(corner.i, corner.j);
                    &far
                }
            };
            (d2[k], units[k]) = (quad.mahalanobis2(corner, size), quad.units_at(corner));
        }
        Nearest { d2: d2.map(least), units }
    }
}
