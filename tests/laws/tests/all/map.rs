//! Laws of the copy-on-write grid: sharing is never seen.

use fastslam::geometry::Pose2;
use fastslam::laws::map::{a_family_of_clones_is_independent, a_mounting_changes_nothing};
use fastslam::map::{ConditionalMap, grid::Grid};
use fastslam::matching::{Likelihood, Matcher, ScanModel};
use fastslam::ops;
use fastslam::sensor::{BeamSensor, Scan};
use fastslam_lab::digest::Digest;
use fastslam_lab::experiment::lap::GRID;
use proptest::prelude::*;

/// What a grid says of a cell: where, log-odds, and the mean of the end points in it.
type Cell = (i32, i32, u64, Option<[u64; 2]>);

/// What a grid says of its cells, and the fingerprint of all that it holds.
fn content(grid: &Grid) -> (Vec<Cell>, Digest) {
    let cells = grid.bounds();
    let all = (cells.j0..cells.j1).flat_map(|j| (cells.i0..cells.i1).map(move |i| (i, j)));
    let said = all
        .map(|(i, j)| (i, j, grid.log_odds(i, j).to_bits(), grid.ndt_mean(i, j).map(|mean| mean.map(f64::to_bits))))
        .collect();
    let mut digest = Digest::new();
    Grid::hash_all([grid], &mut digest);
    (said, digest)
}

fn sighting() -> impl Strategy<Value = (Pose2, Scan)> {
    let pose = (-9.0..9.0_f64, -9.0..9.0_f64, -4.0..4.0_f64).prop_map(|(x, y, theta)| Pose2::new(x, y, theta));
    let ranges = prop::collection::vec(0.1..9.0_f64, 24);
    (pose, ranges).prop_map(|(pose, ranges)| (pose, BeamSensor::panorama(24, 8.0, 0.0).scan(&ranges)))
}

/// Scans of a room from 12 places.
fn scans() -> Vec<(Pose2, Scan)> {
    let at = |k: u32| {
        let ranges: Vec<f64> = (0..24).map(|beam| 2.0 + 0.2 * f64::from((7 * beam + 3 * k) % 11)).collect();
        (Pose2::new(0.3 * f64::from(k), 0.0, 0.1 * f64::from(k)), BeamSensor::panorama(24, 8.0, 0.0).scan(&ranges))
    };
    (0..12).map(at).collect()
}

fastslam::map_laws!(grid, || Grid::new(GRID), ScanModel::new(Matcher::SubCell, 1.0, 0.1), scans(), content);

/// Of an end point where nothing is known: κ ln(ε + (1 − ε) p₀).
#[test]
fn nothing_known_is_judged_by_its_own_probability() {
    let grid = <Grid>::new(GRID);
    let scan = Scan { hits: vec![[1.0, 0.5]], ..Scan::default() };
    let score = |model: ScanModel| model.log_score(&grid, &Pose2::default(), &scan);
    for matcher in [Matcher::Cell, Matcher::SubCell] {
        let model = ScanModel::new(matcher, 0.8, 0.1);
        for (model, unknown) in [(model.clone(), 0.5), (model.with_unknown(0.2), 0.2)] {
            let expected = 0.8 * ops::ln(0.1 + 0.9 * unknown);
            assert!((score(model) - expected).abs() < 1e-12, "{matcher}, {unknown}");
        }
    }
    let refused = ScanModel::new(Matcher::Cell, 0.8, 0.1).with_unknown(1.0);
    assert_eq!(Likelihood::<Grid>::validate(&refused).unwrap_err().field(), "score.unknown");
}

/// The cells of two grids are alike: log-odds to the bit, means of end points to within a nanometre.
fn alike(a: &Grid, b: &Grid) {
    let ([(a, _), (b, _)], near) = ([a, b].map(content), |a: [u64; 2], b: [u64; 2]| {
        (0..2).all(|k| (f64::from_bits(a[k]) - f64::from_bits(b[k])).abs() < 1e-9)
    });
    assert_eq!(a.len(), b.len(), "the grids reach as far");
    for (a, b) in a.into_iter().zip(b) {
        assert_eq!((a.0, a.1, a.2), (b.0, b.1, b.2), "column, row and log-odds");
        assert!(a.3.is_some() == b.3.is_some() && a.3.zip(b.3).is_none_or(|(a, b)| near(a, b)), "{a:?} {b:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    /// Of a laser ahead, aside or behind, looking any way, free space begins where it is.
    #[test]
    fn wherever_a_laser_is_mounted_it_maps_what_it_sees(
        scans in prop::collection::vec(sighting(), 1..6),
        mounting in (-1.0..1.0_f64, -1.0..1.0_f64, -4.0..4.0_f64),
    ) {
        let (x, y, theta) = mounting;
        a_mounting_changes_nothing(|| <Grid>::new(GRID), &scans, &[Pose2::new(x, y, theta)], alike);
    }

    /// A family of clones, each written to in turn, holds what grids hold that never shared anything.
    #[test]
    fn a_clone_and_its_siblings_are_independent(
        trunk in prop::collection::vec(sighting(), 0..6),
        branches in prop::collection::vec(prop::collection::vec(sighting(), 0..4), 1..5),
    ) {
        let score = ScanModel::new(Matcher::SubCell, 1.0, 0.1);
        let branches: Vec<Vec<_>> = branches.iter().map(|branch| branch.iter().collect()).collect();
        a_family_of_clones_is_independent(|| Grid::new(GRID), &score, &trunk, &branches, content);
    }

    /// Before anybody writes, maps of one trunk hold what one does. Where each then writes 200 m away, no tile of the trunk is
    /// touched: together they hold what copies would, less the trunk's tiles for all but one.
    #[test]
    fn shared_maps_hold_what_they_share_once(
        trunk in prop::collection::vec(sighting(), 1..4),
        branches in prop::collection::vec(sighting(), 1..10),
    ) {
        let mut grid = <Grid>::new(GRID);
        trunk.iter().for_each(|(pose, scan)| grid.assimilate(pose, scan, &()));
        let alone = Grid::footprint([&grid]);
        let cells = grid.bounds();
        // The directory holds a pointer of 8 bytes for each tile of its rectangle.
        let pointers = 8 * cells.width() * cells.height() / (<Grid>::TILE_CELLS * <Grid>::TILE_CELLS) as usize;
        let trunk_tiles = alone.unique - pointers as u64;
        let mut family = vec![grid; branches.len()];
        let (together, copies) = (Grid::footprint(&family), family.len() as u64);
        prop_assert_eq!((together.unique, together.dense), (alone.unique, copies * alone.dense));

        for (grid, (pose, scan)) in family.iter_mut().zip(&branches) {
            grid.assimilate(&Pose2::new(pose.x + 200.0, pose.y, pose.theta), scan, &());
        }
        let (together, each) = (Grid::footprint(&family), family.iter().map(|grid| Grid::footprint([grid])));
        let unique: u64 = each.clone().map(|footprint| footprint.unique).sum();
        prop_assert_eq!(together.unique, unique - (copies - 1) * trunk_tiles);
        prop_assert_eq!(together.dense, each.map(|footprint| footprint.dense).sum::<u64>());
    }
}
