//! What a grid learns from scans, what is copied for it, and what is said of a point.

mod drawn;
mod sharing;

use super::*;
use crate::ops;
use crate::sensor::BeamSensor;
use core::hash::Hasher;
use wide::{f64x4, i32x4};

const MODEL: GridModel = GridModel {
    cell_size: 0.3,
    log_odds_hit: 0.9,
    log_odds_pass: -0.4,
    log_odds_bounds: [-4.0, 4.0],
    ndt_std: 0.1,
    ndt_stretch: 1.0,
    lag: 0,
    distance_reach: 0,
    ndt_forgets: false,
};

fn one_beam(range: f64) -> Scan {
    BeamSensor::panorama(1, 8.0, 0.0).scan(&[range])
}

#[test]
fn a_beam_frees_what_it_passes_and_fills_where_it_ends() {
    let mut grid = Grid::<1>::new(MODEL);
    grid.assimilate(&Pose2::new(0.15, 0.15, 0.0), &one_beam(1.5), &());
    for i in 0..5 {
        assert_eq!(grid.log_odds(i, 0), -0.40625, "cell {i}");
    }
    assert_eq!(grid.log_odds(5, 0), 0.90625);
    assert_eq!((grid.log_odds(6, 0), grid.log_odds(0, 1), grid.log_odds(-100, 7)), (0.0, 0.0, 0.0));
    let mean = grid.ndt_mean(5, 0).unwrap();
    assert!((mean[0] - 1.65).abs() < 1e-6 && (mean[1] - 0.15).abs() < 1e-6, "{mean:?}");
    assert!(grid.ndt_mean(4, 0).is_none());
}

#[test]
fn a_cell_that_a_beam_ends_in_is_hit_though_another_beam_passes_through_it() {
    for hits in [[[1.5, 0.0], [3.0, 0.0]], [[3.0, 0.0], [1.5, 0.0]]] {
        let mut grid = Grid::<1>::new(MODEL);
        let scan = Scan { hits: hits.to_vec(), ..Scan::default() };
        grid.assimilate(&Pose2::new(0.15, 0.15, 0.0), &scan, &());
        assert_eq!([4, 5, 6, 10].map(|i| grid.log_odds(i, 0)), [-0.40625, 0.90625, -0.40625, 0.90625], "{hits:?}");
    }
}

#[test]
fn beams_reach_the_right_cells_in_every_direction() {
    for k in 0..720 {
        let angle = core::f64::consts::TAU * f64::from(k) / 720.0;
        let mut grid = Grid::<1>::new(MODEL);
        let pose = Pose2::new(-0.17, 0.41, angle);
        // Through several tiles.
        grid.assimilate(&pose, &one_beam(7.7), &());
        let [x, y] = pose.transform([7.7, 0.0]);
        let cell = |c: f64| (c / 0.3).floor() as i32;
        assert!(grid.log_odds(cell(x), cell(y)) > 0.5, "direction {angle}");
        let rect = grid.bounds();
        let passed = (rect.j0..rect.j1).flat_map(|j| (rect.i0..rect.i1).map(move |i| (i, j)));
        let passed: Vec<_> = passed.filter(|&(i, j)| grid.log_odds(i, j) < 0.0).collect();
        let expected = cell(x).abs_diff(cell(pose.x)) + cell(y).abs_diff(cell(pose.y));
        assert_eq!(passed.len() as u32, expected, "direction {angle}: the cells between the two, each once");
        let across = |(i, j)| {
            let [dx, dy] = [(i, pose.x), (j, pose.y)].map(|(k, from)| (f64::from(k) + 0.5) * 0.3 - from);
            (dx * (y - pose.y) - dy * (x - pose.x)).abs() / 7.7
        };
        // Half a diagonal, and a rounding error.
        assert!(passed.into_iter().all(|cell| across(cell) < 0.2122), "direction {angle}");
    }
}

#[test]
fn absurd_poses_change_nothing_and_exhaust_nothing() {
    for pose in [Pose2::new(1e300, 0.0, 0.0), Pose2 { x: f64::NAN, y: 0.0, theta: 0.0 }, Pose2::new(0.0, -1e12, 1.0)] {
        let mut grid = Grid::<1>::new(MODEL);
        grid.assimilate(&pose, &one_beam(2.0), &());
        assert_eq!(grid.bounds().width(), 0);
    }
}

/// At the ends of what a log's cells and ranges may be, with a laser that reaches as far as they make, and a reading at its end
/// wherever it looks: what has to be marked is never more than what the map then holds of it.
#[test]
fn the_marks_of_a_scan_take_no_more_than_the_tiles_that_it_maps() {
    let side = Grid::<4>::TILE_CELLS;
    for cell_size in [0.02, 0.2] {
        for range in [0.5, 81.9, 200.0] {
            let scan = BeamSensor::panorama(361, 2.0 * range, 0.0).scan(&[range; 361]);
            let (pose, model) = (Pose2::new(3.0, -2.0, 0.3), GridModel { cell_size, distance_reach: 2, ..MODEL });
            let mut grid = Grid::<4>::new(model);
            grid.assimilate(&pose, &scan, &());
            let [marked, mapped] =
                [ray_trace::trace(&pose, &scan, cell_size, side).bytes(), Grid::footprint([&grid]).unique as usize];
            assert!(marked <= mapped, "cells of {cell_size} m, {range} m: {marked} bytes marked, {mapped} mapped");
            // A byte for each cell of the rectangle around would be 400 MB at the worst.
            assert!(marked < 200_000_000, "cells of {cell_size} m, {range} m: {marked} bytes");
        }
    }
}

/// End points as a careless caller might make them, beside a sound one: that one alone is mapped.
#[test]
fn absurd_ranges_change_nothing_and_exhaust_nothing() {
    let pose = Pose2::new(0.15, 0.15, 0.3);
    let mut sound = Grid::<1>::new(MODEL);
    sound.assimilate(&pose, &one_beam(1.5), &());
    for range in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 1e12, 12_000.0] {
        for end in [[range, 0.0], [0.3, range], [range, range]] {
            let ends = vec![end, [1.5, 0.0]];
            for scan in [
                Scan { hits: ends, ..Scan::default() },
                Scan { hits: vec![[1.5, 0.0]], misses: vec![end], ..Scan::default() },
            ] {
                let mut grid = Grid::<1>::new(MODEL);
                grid.assimilate(&pose, &scan, &());
                assert_eq!(grid.bounds(), sound.bounds(), "{scan:?}");
                assert_eq!(fingerprint([&grid]), fingerprint([&sound]), "{scan:?}");
            }
        }
    }
}

fn fingerprint<'a, const CELLS_PER_NDT: usize>(grids: impl IntoIterator<Item = &'a Grid<CELLS_PER_NDT>>) -> u64 {
    let mut hasher = std::hash::DefaultHasher::new();
    Grid::hash_all(grids, &mut hasher);
    hasher.finish()
}

/// What a golden file rests on. Two hits of one cell that differ by a millimetre leave all log-odds alike; a hit on a settled wall
/// changes a cell only; an NDT cell near an NDT cell differs from one that is not.
#[test]
fn the_fingerprint_of_maps_sees_every_cell_and_every_distribution_of_every_one() {
    let model = GridModel { distance_reach: 2, ..MODEL };
    let grid_of = |model, ranges: &[f64]| {
        let mut grid = Grid::<2>::new(model);
        ranges.iter().for_each(|range| grid.assimilate(&Pose2::new(0.15, 0.15, 0.0), &one_beam(*range), &()));
        grid
    };
    let base = grid_of(model, &[1.5]);
    let moved = grid_of(model, &[1.501]);
    let wider = grid_of(GridModel { ndt_std: 0.11, ..model }, &[1.5]);
    let unmarked = grid_of(GridModel { distance_reach: 1, ..model }, &[1.5]);
    let louder = grid_of(GridModel { log_odds_hit: 0.95, ..model }, &[1.5]);
    let cells = base.bounds();
    for other in [&moved, &wider, &unmarked] {
        assert_eq!(other.bounds(), cells);
        for (i, j) in (cells.j0..cells.j1).flat_map(|j| (cells.i0..cells.i1).map(move |i| (i, j))) {
            assert_eq!(other.log_odds(i, j), base.log_odds(i, j), "the difference is not in the cells");
        }
    }
    for other in [moved, wider, unmarked, louder] {
        assert_ne!(fingerprint([&other]), fingerprint([&base]));
        assert_ne!(fingerprint([&base, &other]), fingerprint([&base, &base]), "only the second map differs");
    }
    // Shared or not, the same content is the same.
    assert_eq!(fingerprint([&base, &base.clone()]), fingerprint([&base, &grid_of(model, &[1.5])]));
}

#[test]
fn a_distribution_has_the_moments_of_its_hits() {
    let mut tile = tile::Tile::<1>::default();
    let hits = [[0.01_f32, 0.02], [-0.05, 0.1], [0.07, -0.03], [0.0, 0.04]];
    for hit in hits {
        tile.add_hit(9, hit, 0.1, 1.0);
    }
    let ndt_cell = tile.ndt_cell(9).unwrap();
    let mean = |k: usize| hits.iter().map(|h| h[k]).sum::<f32>() / 4.0;
    assert!((ndt_cell.mean[0] - mean(0)).abs() < 1e-6 && (ndt_cell.mean[1] - mean(1)).abs() < 1e-6);
    let moment = |a: usize, b: usize| hits.iter().map(|h| (h[a] - mean(a)) * (h[b] - mean(b))).sum::<f32>();
    let sigma = nalgebra::Matrix2::new(moment(0, 0) + 0.02, moment(0, 1), moment(0, 1), moment(1, 1) + 0.02) / 6.0;
    let product = sigma
        * nalgebra::Matrix2::new(
            ndt_cell.information[0],
            ndt_cell.information[1],
            ndt_cell.information[1],
            ndt_cell.information[2],
        );
    assert!((product - nalgebra::Matrix2::identity()).norm() < 1e-4, "{product}");
}

/// What a grid says of one point.
fn nearest<const CELLS_PER_NDT: usize>(mut grid: &Grid<CELLS_PER_NDT>, point: [f64; 2]) -> (f32, i8) {
    let Nearest { d2, units } = grid.nearest_ndt(point.map(f64x4::splat));
    (d2.to_array()[0], units[0])
}

#[test]
fn the_nearest_distribution_is_that_of_all_cells_around() {
    let mut grid = Grid::<1>::new(MODEL);
    grid.assimilate(&Pose2::new(2.0, 1.0, 0.3), &BeamSensor::panorama(90, 8.0, 0.0).scan(&[1.7; 90]), &());
    for k in 0..4000 {
        let (x, y) = (f64::from(k % 80) * 0.05 + 0.013, f64::from(k / 80) * 0.05 - 0.71);
        let (i, j) = ((x / 0.3 - 0.5).floor() as i32, (y / 0.3 - 0.5).floor() as i32);
        let relative = |c: f64, k: i32| (c - (f64::from(k) + 0.5) * 0.3) as f32;
        let four = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)];
        let near = four.iter().filter_map(|&(i, j)| {
            let (NdtCell { mean, information: [xx, xy, yy], .. }, x, y) =
                (grid.ndt_cell(i, j)?, relative(x, i), relative(y, j));
            let (dx, dy) = (x - mean[0], y - mean[1]);
            Some(xx * dx * dx + 2.0 * xy * dx * dy + yy * dy * dy)
        });
        let expected = near.fold(f32::INFINITY, f32::min);
        let (found, units) = nearest(&grid, [x, y]);
        let own = grid.cell_of(x, y);
        assert_eq!(units, grid.units(own.0, own.1), "({x}, {y})");
        assert!(found == expected || (found - expected).abs() < 1e-3 * expected, "({x}, {y}): {found} {expected}");
    }
}

/// To the bit: in the part that it copies, at its border, beyond it, and where nothing is known.
#[test]
fn a_local_map_says_of_every_point_what_its_grid_says() {
    let mut grid = Grid::<1>::new(MODEL);
    grid.assimilate(&Pose2::new(2.0, 1.0, 0.3), &BeamSensor::panorama(90, 8.0, 0.0).scan(&[1.7; 90]), &());
    grid.assimilate(&Pose2::new(14.0, 2.0, 0.3), &BeamSensor::panorama(90, 8.0, 0.0).scan(&[1.3; 90]), &());
    let mut local = LocalMap::new(grid.present(), [2.0, 1.0], 3.0).with_distances();
    let points: Vec<[f64; 2]> = (0..12_000)
        .map(|k| [f64::from(k % 200) * 0.1 - 2.013, f64::from(k / 200) * 0.1 - 2.71])
        .chain([[1e6, -1e6], [-1e6, 2.0]])
        .collect();
    for four in points.as_chunks().0 {
        let [here, there] = [local.nearest_ndt(lanes(four)), (&grid).nearest_ndt(lanes(four))];
        let bits = |found: Nearest| (found.d2.to_array().map(f32::to_bits), found.units);
        assert_eq!(bits(here), bits(there), "{four:?}");
    }
}

/// Four points by x and by y.
fn lanes(points: &[[f64; 2]; LANES]) -> [f64x4; 2] {
    [0, 1].map(|k: usize| f64x4::new(points.map(|point| point[k])))
}

/// On every platform, with vector instructions or without, by this alone.
#[test]
fn four_lanes_have_the_bits_of_one_point_after_the_other() {
    let mut grid = Grid::<1>::new(MODEL);
    grid.assimilate(&Pose2::new(2.0, 1.0, 0.3), &BeamSensor::panorama(90, 8.0, 0.0).scan(&[1.7; 90]), &());
    let alone = |[x, y]: [f64; 2]| {
        let at = [x, y].map(|c| c * (1.0 / 0.3) - 0.5);
        let [i, j] = at.map(|c| c.floor() as i32);
        let beyond = [at[0] - f64::from(i), at[1] - f64::from(j)];
        let offset = beyond.map(|c| c as f32 * 0.3_f64 as f32);
        let mut least = f32::INFINITY;
        for (right, above) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let Some(NdtCell { mean, information: [xx, xy, yy], .. }) = grid.ndt_cell(i + right, j + above) else {
                continue;
            };
            let [dx, dy] = [(0, right), (1, above)].map(|(k, step)| offset[k] - step as f32 * 0.3_f64 as f32 - mean[k]);
            least = least.min(xx * dx * dx + 2.0 * xy * dx * dy + yy * dy * dy);
        }
        let own = beyond.map(|c| i32::from(c >= 0.5));
        (least.to_bits(), grid.units(i + own[0], j + own[1]))
    };
    let points: Vec<[f64; 2]> =
        (0..4000).map(|k| [f64::from(k % 80) * 0.05 + 0.013, f64::from(k / 80) * 0.05 - 0.71]).collect();
    for four in points.as_chunks().0 {
        let Nearest { d2, units } = (&grid).nearest_ndt(lanes(four));
        let found: [_; LANES] = core::array::from_fn(|k| (d2.to_array()[k].to_bits(), units[k]));
        assert_eq!(found, four.map(alone), "{four:?}");
    }
}

/// What a step costs: of thirteen poses that are tried near one place, each quad of distributions is put together once, and none for what lies elsewhere.
#[test]
fn a_local_map_puts_each_quad_together_once() {
    let mut grid = Grid::<1>::new(MODEL);
    let scan = BeamSensor::panorama(180, 8.0, 0.0).scan(&[2.7; 180]);
    grid.assimilate(&Pose2::new(2.0, 1.0, 0.3), &scan, &());
    let mut local = LocalMap::new(grid.past(), [2.0, 1.0], 4.0);
    let (mut asked, mut corners) = (0, Vec::new());
    for k in 0..13 {
        let pose = Pose2::new(2.0 + 0.004 * f64::from(k), 1.0, 0.3 + 0.002 * f64::from(k));
        let ends: Vec<[f64; 2]> = scan.hits.iter().map(|end| pose.transform(*end)).collect();
        for four in ends.as_chunks().0 {
            local.nearest_ndt(lanes(four));
            let [i, j] = grid.corners(lanes(four)).cell.map(i32x4::to_array);
            corners.extend(core::iter::zip(i, j));
            asked += LANES;
        }
    }
    corners.sort_unstable();
    corners.dedup();
    assert_eq!(local.quad_count(), corners.len());
    assert!(asked > 15 * corners.len(), "{asked} questions, {} answers", corners.len());
}

#[test]
fn floor_is_floor() {
    for k in -400..400 {
        let x = f64::from(k) * 0.01;
        assert_eq!(floor(x), x.floor() as i32, "{x}");
        assert!(fast_floor(x) == floor(x) || (x.fract() == 0.0 && fast_floor(x) == floor(x) - 1), "{x}");
    }
    assert_eq!((floor(f64::NAN), floor(1e300), floor(-1e300)), (0, i32::MAX, i32::MIN));
}

#[test]
fn stretched_distributions_make_a_row_of_cells_one_wall() {
    // A wall along y = 2.05, seen evenly; then points on it, and 5 cm off it.
    let scan = Scan { hits: (0..400).map(|k| [-2.0 + 0.01 * f64::from(k), 2.05]).collect(), ..Scan::default() };
    let least_and_most = |ndt_stretch: f64, off: f64| {
        let mut grid = Grid::<4>::new(GridModel { cell_size: 0.05, ndt_std: 0.06, ndt_stretch, ..MODEL });
        grid.assimilate(&Pose2::default(), &scan, &());
        let along = (0..150).map(|k| nearest(&grid, [-1.5 + 0.02 * f64::from(k), 2.05 + off]).0);
        along.fold((f32::INFINITY, 0.0_f32), |(low, high), d2| (low.min(d2), high.max(d2)))
    };
    let (beads, wall) = (least_and_most(1.0, 0.0), least_and_most(4.0, 0.0));
    assert!(beads.1 > 2.0 && wall.1 < 0.3, "{beads:?} {wall:?}");
    let (beads, wall) = (least_and_most(1.0, 0.05), least_and_most(4.0, 0.05));
    assert!((beads.0 - wall.0).abs() < 0.2 && wall.1 - wall.0 < 1.0, "across, nothing changes: {beads:?} {wall:?}");
}

/// Somebody stood a metre in front of a wall, and went. What is left of him pulls at no scan, and pushes none away; the wall stays, along which
/// beams pass all the time.
#[test]
fn what_was_seen_through_is_forgotten() {
    let model = GridModel { cell_size: 0.05, ndt_std: 0.06, ndt_stretch: 3.0, ..MODEL };
    let seen = |ndt_forgets: bool, passes: usize| {
        let mut grid = Grid::<4>::new(GridModel { ndt_forgets, ..model });
        // The wall y = 2.05 from the left end to the right, and a back at y = 1.05 that hides a part of it.
        let wall =
            |hidden: bool| (0..150).map(|k| -1.5 + 0.02 * f64::from(k)).filter(move |x| !(hidden && x.abs() < 0.3));
        let back = (0..16).map(|k| [-0.15 + 0.02 * f64::from(k), 1.05]);
        let first = Scan { hits: wall(true).map(|x| [x, 2.05]).chain(back).collect(), ..Scan::default() };
        let then = Scan { hits: wall(false).map(|x| [x, 2.05]).collect(), ..Scan::default() };
        grid.assimilate(&Pose2::default(), &first, &());
        (0..passes).for_each(|_| grid.assimilate(&Pose2::default(), &then, &()));
        let (back, beside) = (nearest(&grid, [0.0, 1.05]), nearest(&grid, [0.15, 0.9]));
        (back, beside, nearest(&grid, [0.5, 2.05]).0)
    };
    let (back, _, wall) = seen(true, 0);
    assert!(back.0 < 1.0 && wall < 1.0, "{back:?} {wall}");
    for passes in [3, 30] {
        let (back, beside, wall) = seen(true, passes);
        assert_eq!(
            (back, beside),
            ((f32::INFINITY, 0), (f32::INFINITY, 0)),
            "as if nothing were known, after {passes}"
        );
        assert!(wall < 1.0, "{wall}");
        let (back, ..) = seen(false, passes);
        assert!(back.0 < 1.0, "{back:?}");
    }
}
