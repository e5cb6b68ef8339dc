//! Tiles that two maps share until one of them is written to.

use super::{Kind, cells, label};
use crate::{
    decimal::fixed,
    scene::{Anchor, LINE, Mark, Rect, Role, Scene},
    words::vignette::{self, TilesTold},
};
use fastslam::{geometry::Pose2, map::grid::Grid};
use fastslam_lab::experiment::close_up;

/// Columns and rows of tiles: the apartment, in the middle of a world a little larger.
const TILES: [i32; 2] = [6, 4];
const OFFSET: [f64; 2] = [1.2, 0.3];

/// Cells along a side of a tile.
const SIDE: i32 = Grid::<1>::TILE_CELLS;

/// Where the lap's corridor has been mapped from, and where two copies of the particle look from next \[m\].
const CORRIDOR: f64 = 4.65;
const SEEN_FROM: [f64; 4] = [1.5, 4.5, 7.5, 10.5];
const LOOK_FROM: [f64; 2] = [9.0, 3.0];

/// Places of the handle, and beams of a scan.
const BEAMS: u32 = 36;
const ALL: usize = 144;

pub const KIND: Kind = Kind {
    name: "tiles",
    handle: vignette::tiles_handle,
    last: BEAMS,
    value: |at| (beams(at).to_string(), ""),
    number: vignette::tiles_number,
    result: |at| {
        let count = count(&maps(at));
        (count as f64, count.to_string(), "")
    },
    told,
    draw,
};

/// A place of the apartment, as the maps have it.
fn mapped([x, y]: [f64; 2]) -> Pose2 {
    Pose2::new(x + OFFSET[0], y + OFFSET[1], 0.0)
}

/// The map that three particles share after a resampling, and what two of them make of it by a share of a scan each.
fn maps(at: u32) -> [Grid; 3] {
    let see = |map: &mut Grid, x, beams| {
        let place = [x, CORRIDOR];
        close_up::see(map, &mapped(place), &close_up::scan(place, ALL, beams));
    };
    let mut shared = close_up::map();
    SEEN_FROM.into_iter().for_each(|x| see(&mut shared, x, ALL));
    let [second, third] = LOOK_FROM.map(|x| {
        let mut copy = shared.clone();
        if at > 0 {
            see(&mut copy, x, beams(at));
        }
        copy
    });
    [shared, second, third]
}

fn beams(at: u32) -> usize {
    ALL * at as usize / BEAMS as usize
}

fn tiles() -> impl Iterator<Item = [i32; 2]> {
    let [columns, rows] = TILES;
    (0..columns * rows).map(move |k| [k % columns, k / columns])
}

/// The tiles of which a map has a copy of its own: those in which a cell is another.
fn copied(shared: &Grid, map: &Grid) -> impl Iterator<Item = [i32; 2]> {
    let is_other = |[column, row]: &[i32; 2]| {
        (0..SIDE * SIDE).any(|k| {
            let (i, j) = (column * SIDE + k % SIDE, row * SIDE + k / SIDE);
            shared.log_odds(i, j) != map.log_odds(i, j)
        })
    };
    tiles().filter(is_other)
}

fn count([shared, copies @ ..]: &[Grid; 3]) -> usize {
    copies.iter().map(|map| copied(shared, map).count()).sum()
}

fn told(at: u32) -> String {
    let maps = maps(at);
    let footprint = close_up::footprint(&maps);
    let [kept, dense] = [footprint.unique, footprint.dense].map(|bytes| fixed(bytes as f64 / 1000.0, 0));
    TilesTold { copied: &count(&maps), tiles: &(2 * tiles().count()), kept: &kept, dense: &dense }.say()
}

/// The maps in their tiles; those that a copy has for itself are framed.
fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    const GAP: f64 = 10.0;
    let [columns, rows] = TILES;
    let maps = maps(at);
    let side = ((area.w - 2.0 * GAP) / f64::from(3 * columns)).min((area.h - LINE) / f64::from(rows));
    let [w, h] = TILES.map(|count| f64::from(count) * side);
    let y = area.y + 0.5 * (area.h - LINE - h);
    let words = [vignette::tiles_first(), vignette::tiles_second(), vignette::tiles_third()];
    for (k, (map, words)) in maps.iter().zip(words).enumerate() {
        let place = Rect::new(area.x + k as f64 * (w + GAP), y + LINE, w, h);
        cells(scene, place, map, [0, 0], TILES.map(|count| count * SIDE));
        let frame = |[column, row]: [i32; 2], width, role| {
            let [x, y] = [column, rows - 1 - row].map(|k| f64::from(k) * side);
            Mark::Frame { area: Rect::new(place.x + x, place.y + y, side, side), width, role }
        };
        scene.marks.extend(tiles().map(|tile| frame(tile, 0.5, Role::Frame)));
        scene.marks.extend(copied(&maps[0], map).map(|tile| frame(tile, 2.0, Role::Accent)));
        label(scene, Rect::new(place.x, y, w, LINE), Anchor::Start, Role::Muted, words);
    }
}
