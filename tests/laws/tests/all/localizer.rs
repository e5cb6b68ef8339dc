//! What a robot that only finds its way must hold to: it is found in the map of another drive, and that map stays as it is.

use fastslam::geometry::{Gaussian3, Pose2};
use fastslam::map::grid::{GreyMode, Grid, MapImage, MapImageSettings, MapReading};
use fastslam::mapper::{LaserMapper, LaserMapperSettings, Localizer};
use fastslam::nalgebra::Matrix3;
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::LaserScan;
use fastslam_lab::digest::Digest;
use fastslam_lab::experiment::log::{Example, Recipe};

/// A building of which so many scans are mapped.
fn building() -> (LaserMapper, Vec<LaserScan>) {
    let log = Example::of(&Recipe { scatter: 0.5, ..Recipe::building() }, 300).log;
    let settings = LaserMapperSettings { particles: 2, ..LaserMapperSettings::default() }.for_scans(&log.scans);
    let mut mapper = LaserMapper::new(settings).unwrap();
    log.scans.iter().for_each(|scan| drop(mapper.push(scan)));
    (mapper, log.scans)
}

/// Another drive past the same places: odometry begins anew, in a frame of its own, is 3 % too long, and errs by 1° a step.
fn again(scans: &[LaserScan]) -> Vec<LaserScan> {
    let mut pose = Pose2::new(20.0, -7.0, 2.0);
    let mut scans = scans.to_vec();
    let told: Vec<Pose2> = scans.iter().map(|scan| scan.odometry).collect();
    for k in 0..scans.len() {
        if k > 0 {
            let Pose2 { x, y, theta } = told[k - 1].between(&told[k]);
            let [turn] = Stream::at(5, Purpose::TRIAL, k as u32, 0).normals();
            pose = pose.compose(&Pose2::new(1.03 * x, 1.03 * y, theta + 0.017 * turn));
        }
        scans[k].odometry = pose;
    }
    scans
}

fn hash(map: &Grid<4>) -> u64 {
    let mut digest = Digest::new();
    Grid::hash_all([map], &mut digest);
    digest.value()
}

fn about(pose: &Pose2) -> Gaussian3 {
    Gaussian3::new(*pose, Matrix3::from_diagonal(&[0.25, 0.25, 0.04].into())).unwrap()
}

#[test]
fn a_robot_is_found_in_a_map_from_about_where_it_begins_and_the_map_stays_as_it_is() {
    let (mapper, scans) = building();
    let path = mapper.path();
    let first = 120;
    let start = path[first].1.compose(&Pose2::new(0.5, -0.4, 0.2));
    let mut localizer = Localizer::new(&mapper, about(&start)).unwrap();
    let before = hash(localizer.map());
    let told = localizer.pose_with_covariance();
    assert!(told.pose == start && (told.covariance - about(&start).covariance()).norm() < 1e-12, "{told:?}");
    let mut worst = 0.0_f64;
    for (scan, (_, pose)) in again(&scans[first..]).iter().zip(&path[first..]) {
        _ = localizer.push(scan);
        worst = worst.max(localizer.pose().distance(pose));
        // From the first scan on, and never beyond the limits of a fit.
        let [x, y, _] = localizer.pose_with_covariance().stds();
        assert!([x, y].iter().all(|std| (1e-3..0.15).contains(std)), "{x}, {y}");
    }
    // Two cells of the map.
    assert!(worst < 0.1, "{worst} m");
    assert!(localizer.matched_fraction() > 0.9, "{}", localizer.matched_fraction());
    assert_eq!(localizer.path().len(), scans.len() - first);
    let maps = localizer.filter().particles().iter().map(|particle| hash(&particle.map));
    assert!(maps.chain([hash(localizer.map())]).all(|hash| hash == before));
}

#[test]
fn a_robot_that_is_lost_sees_little_of_the_map() {
    let (mapper, scans) = building();
    let elsewhere = mapper.path()[120].1.compose(&Pose2::new(15.0, 15.0, 0.5));
    let mut localizer = Localizer::new(&mapper, about(&elsewhere)).unwrap();
    again(&scans[120..160]).iter().for_each(|scan| drop(localizer.push(scan)));
    assert!(localizer.matched_fraction() < 0.5, "{}", localizer.matched_fraction());
}

/// In the picture of the map, as it is written for ROS and read again: a path within a cell of that in the map itself, though a picture tells of a wall no more than the
/// cells that it is in. Where the picture is turned, the same path is turned with it.
#[test]
fn a_robot_is_found_in_the_picture_of_a_map_as_in_the_map() {
    let (mapper, scans) = building();
    let (path, first) = (mapper.path(), 120);
    let scans = again(&scans[first..]);
    let start = path[first].1.compose(&Pose2::new(0.5, -0.4, 0.2));
    let found = |mut localizer: Localizer| -> Vec<Pose2> {
        scans.iter().for_each(|scan| drop(localizer.push(scan)));
        assert!(localizer.matched_fraction() > 0.9, "{}", localizer.matched_fraction());
        assert_eq!(localizer.path().last().unwrap().1, localizer.pose());
        assert_eq!(localizer.pose_with_covariance().pose, localizer.pose());
        localizer.path().into_iter().map(|(_, pose)| pose).collect()
    };
    let in_map = found(Localizer::new(&mapper, about(&start)).unwrap());
    let image = MapImage::of(mapper.map(), &path, &MapImageSettings::default()).unwrap();
    let reading = |origin| MapReading {
        mode: GreyMode::Trinary,
        resolution: 0.05,
        origin,
        negate: false,
        occupied_thresh: 0.65,
        free_thresh: 0.196,
    };
    let origin = Pose2::new(image.origin[0], image.origin[1], 0.0);
    let read = MapImage::from_pgm(&image.pgm(), &reading(origin)).unwrap();
    let in_picture = |origin: Pose2, start: Pose2| {
        found(Localizer::in_drawn(&read, &reading(origin), *mapper.settings(), about(&start)).unwrap())
    };
    let drawn = in_picture(origin, start);
    let off = in_map.iter().zip(&drawn).map(|(a, b)| a.distance(b)).fold(0.0, f64::max);
    assert!(off < 0.05, "{off} m");
    let turn = Pose2::new(3.0, -2.0, 0.7);
    let turned = in_picture(turn.compose(&origin), turn.compose(&start));
    for (turned, drawn) in turned.iter().zip(&drawn) {
        assert!(turned.minus(&turn.compose(drawn)).norm() < 1e-6, "{turned:?}, {drawn:?}");
    }
}
