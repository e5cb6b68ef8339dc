//! What grids share, and what a write copies.

use super::*;

#[test]
fn writing_to_a_clone_never_touches_its_sibling() {
    let mut original = Grid::<1>::new(MODEL);
    original.assimilate(&Pose2::default(), &one_beam(2.0), &());
    let before = original.log_odds(6, 0);
    let mut copy = original.clone();
    copy.assimilate(&Pose2::default(), &one_beam(2.0), &());
    copy.assimilate(&Pose2::new(40.0, -30.0, 1.0), &one_beam(2.0), &()); // grows the copy only
    assert_eq!(original.log_odds(6, 0), before);
    assert!(copy.log_odds(6, 0) > before);
    assert_ne!(original.bounds(), copy.bounds());
}

#[test]
fn a_clone_costs_no_memory_until_it_is_written_to() {
    let mut original = Grid::<1>::new(MODEL);
    original.assimilate(&Pose2::default(), &BeamSensor::panorama(90, 8.0, 0.0).scan(&[7.0; 90]), &());
    let alone = Grid::footprint([&original]);
    let mut copy = original.clone();
    let pair = Grid::footprint([&original, &copy]);
    assert_eq!((pair.unique, pair.dense), (alone.unique, 2 * alone.dense));
    copy.assimilate(&Pose2::default(), &one_beam(0.5), &()); // one tile
    let written = Grid::footprint([&original, &copy]).unique;
    assert!(pair.unique < written && written < 2 * alone.unique, "{} {written} {}", pair.unique, 2 * alone.unique);
}

/// Two maps that never shared a scan: where both are as free as can be, they hold one tile. What a beam then ends in is a map's own again.
#[test]
fn what_cannot_become_freer_is_one_tile_of_all_maps() {
    let blank = Grid::<4>::new(GridModel { cell_size: 0.05, log_odds_bounds: [-2.0, 3.5], ..MODEL });
    // Beams so dense that they pass every cell, of which five scans make one as free as can be.
    let scan = BeamSensor::panorama(1440, 20.0, 0.0).scan(&[9.0; 1440]);
    let hall = |x: f64| {
        let mut grid = blank.blank();
        (0..6).for_each(|_| grid.assimilate(&Pose2::new(x, 0.02, 0.0), &scan, &()));
        grid
    };
    let mut maps = [hall(0.0), hall(0.33)];
    let unique = |maps: &[&Grid<4>]| Grid::footprint(maps.iter().copied()).unique;
    let [one, other] = [0, 1].map(|k| unique(&[&maps[k]]));
    // A hall of 18 m across holds some sixty tiles of 1.6 m that no wall is in, nor near.
    let (together, tile) = (unique(&[&maps[0], &maps[1]]), Grid::<4>::tile_bytes(0) as u64);
    assert_eq!(one + other - together, tile, "they share one tile");
    let tiles = one / tile;
    let rectangle = maps[0].directory.tiles.len() as u64;
    assert!(tiles < rectangle - 40, "{tiles} of a rectangle of {rectangle}");
    assert_eq!((maps[0].log_odds(40, 40), maps[1].log_odds(40, 40)), (-2.0, -2.0));

    // Restored, they share it as before, and with what comes to be as free later.
    #[cfg(feature = "serde")]
    {
        use crate::save::SaveShared;
        let mut restored = Grid::restore_all(Grid::save_all(&maps)).unwrap();
        assert_eq!(unique(&[&restored[0], &restored[1]]), together);
        for maps in [&mut maps[..], &mut restored[..]] {
            (0..6).for_each(|_| maps[1].assimilate(&Pose2::new(12.0, 0.02, 0.0), &scan, &()));
        }
        assert_eq!(unique(&[&restored[0], &restored[1]]), unique(&[&maps[0], &maps[1]]));
    }

    let near = Scan { hits: vec![[2.02, 2.0]], ..Scan::default() };
    maps[0].assimilate(&Pose2::new(0.0, 0.02, 0.0), &near, &());
    assert_eq!((maps[0].log_odds(40, 40), maps[1].log_odds(40, 40)), (-1.09375, -2.0));
}
