use super::*;
use crate::model::Tells as _;

#[test]
fn the_sentence_says_when_no_universe_explains_a_scan() {
    let mut model = LogModel::default();
    model.open(include_bytes!("../../../../tests/figures/golden/tiny.clf")).unwrap();
    model.seek(1);
    model.settle();
    assert!(!model.describe().contains("explains"));
    model.history[0].log_evidence = f64::NEG_INFINITY;
    assert!(model.describe().contains("No universe explains this scan: the weights stay."));
}

#[test]
fn odometry_lays_out_the_scans_that_the_filter_took_and_going_back_takes_away_the_later_ones() {
    let mapped = |min_travel, step| {
        let mut model = LogModel::default();
        let setup = LaserMapperSettings { cell_size: 0.2, min_travel, particles: 4, ..model.recipe.setup };
        model.adopt(Recipe { setup, odometry: true, ..model.recipe.clone() }).unwrap();
        model.open(include_bytes!("../../../../tests/figures/golden/tiny.clf")).unwrap();
        model.seek(step);
        model.settle();
        model
    };
    for min_travel in [0.0, 0.6] {
        let mut whole = mapped(min_travel, 90);
        let last = whole.step_count();
        assert!(last == 90 || min_travel > 0.0 && last < 60);
        for step in [last, last - 1, 7, 1] {
            whole.seek(step);
            let (laid, then) = (whole.compared().unwrap(), mapped(min_travel, step));
            assert_eq!(laid.cells(step), then.laid.cells(step));
            assert_eq!(whole.apart(), then.apart());
            // Beam by beam: the range along its direction, from where the wheels say that the robot was.
            let log = whole.log().unwrap();
            let mut cells = std::collections::BTreeSet::new();
            let (mut taken, mut at) = (0, log.scans[0].odometry);
            for scan in &log.scans {
                let moved = at.between(&scan.odometry);
                let far = moved.distance(&Default::default()).max(moved.theta.abs()) >= min_travel.max(1e-9);
                if taken > 0 && !far || taken > step {
                    continue;
                }
                (taken, at) = (taken + 1, scan.odometry);
                let pose = log.scans[0].odometry.between(&scan.odometry);
                for (k, range) in scan.ranges.iter().map(|range| f64::from(*range)).enumerate() {
                    let angle = scan.first_angle + k as f64 * scan.angle_step;
                    if range < whole.mapper().unwrap().settings().no_return.unwrap() {
                        let (sin, cos) = fastslam::ops::sin_cos(angle);
                        let ahead = scan.robot_from_laser.transform([range * cos, range * sin]);
                        cells.insert(pose.transform(ahead).map(|metres| (metres / 0.2).floor() as i32));
                    }
                }
            }
            assert!(laid.cells(step).len() == cells.len() && laid.cells(step).iter().all(|cell| cells.contains(cell)));
        }
    }
}

#[test]
fn a_way_back_falls_on_the_walls_that_were_mapped_and_beside_those_that_odometry_lays_out() {
    let mut model = LogModel::default();
    let setup = LaserMapperSettings { cell_size: 0.1, ..model.recipe.setup };
    model.adopt(Recipe { setup, odometry: true, ..model.recipe.clone() }).unwrap();
    model.open(include_bytes!("../../../../tests/figures/golden/tiny.clf")).unwrap();
    model.seek(90);
    model.settle();
    let map = &model.seen().unwrap().map;
    let bounds = map.bounds();
    let walls = (bounds.i0..bounds.i1).flat_map(|i| (bounds.j0..bounds.j1).map(move |j| (i, j)));
    let walls = walls.filter(|&(i, j)| map.log_odds(i, j) > 0.0).count();
    let laid = model.compared().unwrap().cells(90).len();
    assert!(laid as f64 > 1.5 * walls as f64, "{laid} cells by odometry, {walls} in the map");
    assert!(model.apart().unwrap() > 0.5 && model.describe().contains("By raw odometry alone the robot would be "));
    model.adopt(Recipe { odometry: false, ..model.recipe.clone() }).unwrap();
    assert!(model.compared().is_none() && !model.describe().contains("Raw odometry"));
}

#[test]
fn a_scan_that_was_gone_back_to_has_the_bits_that_it_had() {
    let mapped = |step| {
        let mut model = LogModel::default();
        let recipe =
            Recipe { setup: LaserMapperSettings { cell_size: 0.2, ..model.recipe.setup }, ..model.recipe.clone() };
        model.adopt(recipe).unwrap();
        model.open(include_bytes!("../../../../tests/figures/golden/tiny.clf")).unwrap();
        model.seek(step);
        model.settle();
        model
    };
    let drawn = |model: &LogModel| {
        let seen = model.seen().unwrap();
        let poses: Vec<_> = seen.paths.iter().map(|path| path.poses()).collect();
        let deaths: Vec<_> = seen.deaths.iter().map(|death| (death.step, death.paths.len())).collect();
        let map = MapImage::of(&seen.map, &[], &MapImageSettings::default()).unwrap();
        (seen.step, seen.scans, seen.best, poses, deaths, map)
    };
    let mut whole = mapped(90);
    for step in [89, 1, 46, 47, 30] {
        whole.seek(step);
        assert_eq!(drawn(&whole), drawn(&mapped(step)));
    }
    whole.seek(90);
    assert_eq!(drawn(&whole), drawn(&mapped(90)));
}
