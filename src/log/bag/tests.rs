//! Bags of two writers against the CARMEN log that says the same (tests/bags/make.py), and bags made here of whatever goes wrong.

mod made;

use self::made::{Made, ROBOT_AT, framed};
use super::messages::{LaserScan as ScanMessage, Rigid};
use super::*;
use crate::{parse, write_json_lines};
use core::f64::consts::PI;
use fastslam::geometry::Pose2;
use fastslam::mapper::{LaserMapperSettings, Replay};
use std::sync::Arc;

const CARMEN: &[u8] = include_bytes!("../../../tests/bags/lap.clf");
const BAGS: [(&str, &[u8]); 5] = [
    ("odometry-zstd.mcap", include_bytes!("../../../tests/bags/odometry-zstd.mcap")),
    ("tf-lz4.mcap", include_bytes!("../../../tests/bags/tf-lz4.mcap")),
    ("plain.bag", include_bytes!("../../../tests/bags/plain.bag")),
    ("lz4.bag", include_bytes!("../../../tests/bags/lz4.bag")),
    ("bz2.bag", include_bytes!("../../../tests/bags/bz2.bag")),
];

fn read_with(bytes: &[u8], options: BagOptions) -> Result<LaserLog, String> {
    let mut reader = BagReader::new(options);
    // In pieces that no record has the length of.
    bytes
        .chunks(997)
        .try_for_each(|piece| reader.push(piece))
        .and_then(|()| reader.finish())
        .map_err(|error| error.problem.to_string())
}

fn read(bytes: &[u8]) -> Result<LaserLog, String> {
    read_with(bytes, BagOptions::default())
}

fn path(log: LaserLog) -> Vec<[u64; 4]> {
    let settings = LaserMapperSettings { particles: 3, ..LaserMapperSettings::default() };
    let mut replay = Replay::new(settings, Arc::new(log)).unwrap();
    replay.by_ref().for_each(drop);
    let bits = |(time, pose): &(f64, Pose2)| [*time, pose.x, pose.y, pose.theta].map(f64::to_bits);
    replay.mapper().path().iter().map(bits).collect()
}

#[test]
fn the_path_of_each_bag_is_that_of_the_carmen_log_to_the_last_bit() {
    let log = parse(CARMEN, false).unwrap();
    let expected = path(log.clone());
    assert_eq!(expected.len(), 30);
    for (name, bytes) in BAGS {
        let found = read(bytes).unwrap();
        for (found, expected) in found.scans.iter().zip(&log.scans) {
            assert_eq!(found, expected, "{name}");
        }
        assert_eq!(found.notes.remarks, [], "{name}");
        assert_eq!(path(found), expected, "{name}");
    }
}

#[test]
fn json_lines_keep_every_bit() {
    let log = read(BAGS[0].1).unwrap();
    let again = parse(write_json_lines(&log).as_bytes(), false).unwrap();
    assert_eq!(again.scans, log.scans);
}

#[test]
fn a_laser_is_mounted_by_the_chain_of_transforms_and_upside_down_sweeps_the_other_way() {
    let quarter = (0.5_f64).sqrt();
    // 0.3 m ahead on a plate, which stands 0.1 m behind the centre and looks left.
    let log = Made::new()
        .fixed("base_link", "plate", Rigid { position: [-0.1, 0.0, 0.2], orientation: [0.0, 0.0, quarter, quarter] })
        .fixed("plate", "laser", Rigid { position: [0.3, 0.0, 0.0], orientation: [1.0, 0.0, 0.0, 0.0] })
        .odometry("/odom", 1, 0.0)
        .scan("/scan", 1, |_| ())
        .read()
        .unwrap();
    let scan = &log.scans[0];
    let Pose2 { x, y, theta } = scan.robot_from_laser;
    for (found, expected) in [(x, -0.1), (y, 0.3), (theta, PI / 2.0)] {
        assert!((found - expected).abs() < 1e-12, "{found}, {expected}");
    }
    // Upside down: the beam at −0.5 rad of the laser, its first, goes to the left of where it looks.
    assert_eq!((scan.first_angle, scan.angle_step), (0.5, -0.25));
    let first = scan.end_points(100.0, 100.0).hits[0];
    let expected = [-0.1 + fastslam::ops::cos(PI / 2.0 + 0.5), 0.3 + fastslam::ops::sin(PI / 2.0 + 0.5)];
    assert!((first[0] - expected[0]).abs() < 1e-12 && (first[1] - expected[1]).abs() < 1e-12, "{first:?}");
    assert_eq!(log.notes.remarks, []);
}

#[test]
fn a_laser_that_is_not_level_is_refused() {
    let quarter = (0.5_f64).sqrt();
    let tilted = Rigid { position: [0.0; 3], orientation: [0.0, quarter, 0.0, quarter] };
    let error =
        Made::new().fixed("base_link", "laser", tilted).odometry("/odom", 1, 0.0).scan("/scan", 1, |_| ()).read();
    assert!(error.unwrap_err().contains("the laser laser is tilted against base_link by more than 20°"));
}

#[test]
fn a_sweep_may_be_clockwise_or_a_whole_turn_and_what_is_no_range_has_met_nothing() {
    let log = Made::new()
        .odometry("/odom", 1, 0.0)
        .scan("/scan", 1, |scan| {
            (scan.angle_min, scan.angle_increment) = (core::f32::consts::PI, -2.0 * core::f32::consts::PI / 360.0);
            scan.ranges = vec![2.0; 360];
            scan.ranges[..6].copy_from_slice(&[f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.05, 31.0, -1.0]);
        })
        .read()
        .unwrap();
    let ends = log.scans[0].end_points(100.0, 100.0);
    assert_eq!((ends.hits.len(), ends.misses.len()), (354, 0));
    // From straight behind, clockwise: the beam after a quarter goes to the left.
    let left = ends.hits[90 - 6];
    assert!(left[0].abs() < 1e-5 && (left[1] - 2.0).abs() < 1e-5, "{left:?}");
}

#[test]
fn odometry_is_interpolated_at_the_stamp_and_held_beyond_its_ends() {
    let made = Made::new().odometry("/odom", 2, 1.0).odometry("/odom", 4, 3.0);
    let made = [1, 2, 3, 4, 5].into_iter().fold(made, |made, sec| made.scan("/scan", sec, |_| ()));
    let log = made.read().unwrap();
    assert_eq!(log.scans.iter().map(|scan| scan.odometry.x).collect::<Vec<_>>(), [1.0, 1.0, 2.0, 3.0, 3.0]);
    assert!(
        log.notes.remarks.iter().any(|remark| remark.to_string().contains("last word of odometry: 2")),
        "{:?}",
        log.notes.remarks
    );
    assert!(
        log.notes
            .remarks
            .iter()
            .any(|remark| remark.to_string().contains("no transform tells where the laser (laser)"))
    );
    let error = Made::new().odometry("/odom", 2, 1.0).scan("/scan", 9, |_| ()).read().unwrap_err();
    assert!(
        error.contains("its scans (9.000 to 9.000 s) and its odometry (2.000 to 2.000 s) have no time in common"),
        "{error}"
    );
}

#[test]
fn without_odometry_scans_are_matched_to_each_other_and_it_is_said() {
    let mut log = parse(CARMEN, false).unwrap();
    let mapped = path(log.clone())[29].map(f64::from_bits);
    let mapped = Pose2::new(mapped[1], mapped[2], mapped[3]);
    let wheels = log.scans[0].odometry.between(&log.scans[29].odometry);
    log.odometry.clear();
    log.scans.iter_mut().for_each(|scan| scan.odometry = NOWHERE);
    place(&mut log).unwrap();
    assert_eq!(
        log.notes.remarks.iter().map(ToString::to_string).collect::<Vec<_>>(),
        ["there is no odometry: each scan is matched with those before"]
    );
    // Eight metres along a corridor, which the wheels turn away from.
    let matched = log.scans[29].odometry;
    assert!(wheels.distance(&mapped) > 2.0, "{wheels:?}, {mapped:?}");
    assert!(matched.distance(&mapped) < 0.4, "{matched:?}, {mapped:?}");
    // And the filter has something to start from.
    let again = path(log)[29].map(f64::from_bits);
    assert!(Pose2::new(again[1], again[2], again[3]).distance(&mapped) < 0.4, "{again:?}, {mapped:?}");
}

#[test]
fn odometry_that_never_moves_while_scans_do_is_none() {
    let drive = parse(CARMEN, false).unwrap();
    let standing = Pose2::new(3.0, -2.0, 0.5);
    let placed = |mut log: LaserLog, odometry: &[(f64, Pose2)]| {
        log.odometry = odometry.to_vec();
        log.scans.iter_mut().for_each(|scan| scan.odometry = NOWHERE);
        place(&mut log).map(|()| log).map_err(|error| error.to_string())
    };
    let none = placed(drive.clone(), &[]).unwrap();
    // Of wheels that tell nothing: once, of another time, and with every scan.
    let each: Vec<(f64, Pose2)> = drive.scans.iter().map(|scan| (scan.time, standing)).collect();
    for odometry in [&[(-7.0, standing)][..], &each] {
        let still = placed(drive.clone(), odometry).unwrap();
        assert_eq!(still.notes.remarks, [Remark::StillOdometry]);
        assert_eq!((&still.scans, &still.odometry), (&none.scans, &none.odometry));
    }
    // A robot that stands is where its odometry has it.
    let mut stands = drive.clone();
    let first = stands.scans[0].clone();
    stands.scans.iter_mut().for_each(|scan| scan.ranges.clone_from(&first.ranges));
    let stands = placed(stands, &each).unwrap();
    assert!(stands.notes.remarks.is_empty() && stands.scans.iter().all(|scan| scan.odometry == standing));
}

#[test]
fn a_clock_that_is_set_back_shuffles_nothing() {
    let drive = parse(CARMEN, false).unwrap();
    let (mut spoiled, at) = (drive.clone(), drive.scans[15].time);
    let back = |time: &mut f64| *time -= if *time >= at { 10.07 } else { 0.0 };
    spoiled.scans.iter_mut().for_each(|scan| back(&mut scan.time));
    spoiled.odometry.iter_mut().for_each(|(time, _)| back(time));
    spoiled.in_order();
    let poses = |log: &LaserLog| log.scans.iter().map(|scan| scan.odometry).collect::<Vec<Pose2>>();
    assert_eq!(poses(&spoiled), poses(&drive));
    assert!(matches!(spoiled.notes.remarks[..], [Remark::ClockSetBack { .. }]), "{:?}", spoiled.notes);
}

#[test]
fn what_is_missing_is_named_with_its_topic() {
    let error = |made: Made| made.read().unwrap_err();
    let said = error(Made::new().odometry("/odom", 1, 0.0));
    assert_eq!(said, "no sensor_msgs/LaserScan in it; there is /odom (1 × nav_msgs/Odometry)");
    let said = error(Made::new().scan("/a", 1, |_| ()).scan("/b", 1, |_| ()).scan("/b", 2, |_| ()));
    assert_eq!(said, "several topics have scans, and scan-topic must name one: /a (1), /b (2)");
    let said = error(Made::new().scan("/a", 1, |_| ()).odometry("/o", 1, 0.0).odometry("/p", 1, 0.0));
    assert_eq!(said, "several topics have odometry, and odometry-topic must name one: /o (1), /p (1)");
    let said = error(Made::new().scan("/a", 1, |scan| scan.ranges.clear()));
    assert_eq!(said, "/a: message 1 (sensor_msgs/LaserScan) has no ranges");
    let said = error(Made::new().scan("/a", 1, |scan| scan.angle_increment = 0.0));
    assert!(
        said.contains("/a: message 1 (sensor_msgs/LaserScan) expected angle_min and angle_increment in radians"),
        "{said}"
    );
    let said = error(Made::new().scan("/a", 1, |scan| scan.ranges = vec![f32::NAN; 3]));
    assert!(said.contains("none of its 3 readings is a range"), "{said}");
    let said = error(Made::new().raw("/a", "sensor_msgs/msg/LaserScan", "cdr", &[0, 1, 0, 0, 1, 2, 3]));
    assert_eq!(said, "/a: message 1 (sensor_msgs/LaserScan) is shorter than its type asks for");
    let said = error(Made::new().raw("/a", "sensor_msgs/msg/LaserScan", "protobuf", &[0; 9]));
    assert!(said.contains("is encoded as “protobuf”"), "{said}");
    let wanted = |topic: &str| BagOptions { scan_topic: Some(topic.into()), ..BagOptions::default() };
    let bag = Made::new().scan("/a", 1, |_| ()).scan("/b", 1, |_| ()).odometry("/o", 1, 0.0).bytes();
    assert_eq!(read_with(&bag, wanted("/b")).unwrap().scans.len(), 1);
    assert_eq!(
        read_with(&bag, wanted("/o")).unwrap_err(),
        "the topic /o is of type nav_msgs/Odometry, not sensor_msgs/LaserScan"
    );
    assert!(read_with(&bag, wanted("/c")).unwrap_err().starts_with("there is no topic /c in it; there is /a (1 × "));
}

#[test]
fn ranges_beyond_what_the_laser_declares_are_counted_where_there_are_no_others() {
    let said = "none of its 4 readings is a range: a finite number above 0 and up to range_max, 12.0 m; 3 are beyond it, the shortest of them 1033.0: \
                are they in metres?";
    let millimetres = |scan: &mut ScanMessage| {
        (scan.range_max, scan.ranges) = (12.0, vec![1033.0, f32::INFINITY, 2500.0, 4100.0]);
    };
    assert_eq!(Made::new().scan("/scan", 9, millimetres).read().unwrap_err(), said);
    let line =
        br#"{"time": 1, "angle_min": 0, "angle_increment": 0.1, "range_max": 12, "ranges": [1033, null, 2500, 4100]}"#;
    assert_eq!(parse(line, false).unwrap_err().problem.to_string(), said);
}

#[test]
fn what_is_in_reach_of_nothing_is_told_from_what_says_nothing() {
    let spoil = |scan: &mut ScanMessage| {
        (scan.range_min, scan.range_max) = (0.2, 12.0);
        scan.ranges = vec![3.0, f32::INFINITY, f32::NAN, 0.1, 13.0, f32::NEG_INFINITY];
    };
    let log = Made::new().scan("/scan", 9, spoil).read().unwrap();
    let again = parse(write_json_lines(&log).as_bytes(), false).unwrap();
    for log in [&log, &again] {
        assert_eq!(log.scans[0].ranges, [3.0, f32::INFINITY, 0.0, 0.0, 0.0, 0.0]);
    }
}

#[test]
fn a_stamp_of_zero_is_the_time_of_recording() {
    assert_eq!(Made::new().scan("/scan", 0, |_| ()).read().unwrap().scans[0].time, 77.5);
}

#[test]
fn a_bag_that_breaks_off_is_refused_or_read_up_to_there() {
    for (name, bytes) in BAGS {
        let half = &bytes[..bytes.len() / 2];
        assert_eq!(
            read(half).unwrap_err(),
            "it ends in the middle of a record: was its recording broken off?",
            "{name}"
        );
        let lenient = || BagOptions { lenient: true, ..BagOptions::default() };
        // What is before the break is there, unless the first chunk already is beyond it.
        if let Ok(log) = read_with(half, lenient()) {
            assert_eq!(log.notes.malformed, 1, "{name}");
            assert!((1..30).contains(&log.scans.len()), "{name}: {}", log.scans.len());
        } else {
            assert!(name.ends_with(".bag"), "{name}");
        }
        // No cut, and no byte that is another, brings it down.
        for cut in (0..bytes.len()).step_by(1009) {
            _ = read_with(&bytes[..cut], lenient());
            let mut bytes = bytes.to_vec();
            bytes[cut] ^= 0x55;
            _ = read_with(&bytes, lenient());
        }
    }
    assert_eq!(read(b"").unwrap_err(), "it is neither an MCAP file nor a ROS 1 bag");
    assert!(read(b"#ROSBAG V1.2\n....").unwrap_err().contains("another format than 2.0"));
}

#[test]
fn a_compression_that_is_not_known_is_named() {
    let bag = BAGS[1].1;
    let at = bag.windows(3).position(|three| three == b"lz4").unwrap();
    let mut other = bag.to_vec();
    other[at..at + 3].copy_from_slice(b"xz9");
    let lenient = read_with(&other, BagOptions { lenient: true, ..BagOptions::default() });
    assert_eq!(lenient.unwrap_err(), read(&other).unwrap_err());
    assert_eq!(read(&other).unwrap_err(), "its chunks are compressed by “xz9”; zstd, lz4 and bz2 can be read");
}

#[test]
fn the_frame_of_the_odometry_may_have_any_name() {
    let driven = |log: &LaserLog| log.scans.iter().map(|scan| scan.odometry.x).collect::<Vec<_>>();
    for (odom, robot) in [("odom", "base_link"), ("odom_comb", "base_footprint"), ("robot1/odom", "robot1/base_link")] {
        let log = framed(odom, robot).read().unwrap();
        assert_eq!((driven(&log), log.scans[0].robot_from_laser.x), (vec![1.0, 2.0], 0.2), "{odom}");
        assert_eq!(log.notes.remarks, [], "{odom}");
    }
    let chosen = |name: &str| BagOptions { odometry_frame: Some(name.into()), ..BagOptions::default() };
    let bag = framed("odom", "base_link").bytes();
    assert_eq!(driven(&read_with(&bag, chosen("/map")).unwrap()), [0.1, 0.2]);
    assert_eq!(
        read_with(&bag, chosen("odometry")).unwrap_err(),
        "no transform leads from the frame odometry; those that move: map to odom, odom to base_link, base_link to wheel"
    );
    // Where no transform tells what the laser hangs from, only one of them can be it, or its owner must say.
    let loose = |made: Made| {
        made.moving("o", "r", 1, 1.0).moving("o", "r", 2, 2.0).scan("/scan", 1, |_| ()).scan("/scan", 2, |_| ())
    };
    assert_eq!(driven(&loose(Made::new()).read().unwrap()), [1.0, 2.0]);
    let log = loose(Made::new().moving("p", "q", 1, 0.0).moving("p", "q", 2, 1.0)).read().unwrap();
    let said: Vec<String> = log.notes.remarks.iter().map(ToString::to_string).collect();
    assert!(
        said[0].ends_with("by its first frame: p to q, o to r") && said[2].starts_with("there is no odometry"),
        "{said:?}"
    );
}

#[test]
fn a_fixed_transform_counts_for_nothing_beside_one_that_moves() {
    let made = Made::new().fixed("odom", "base_link", ROBOT_AT).moving("odom", "base_link", 3, 3.0);
    let made = made.fixed("odom", "base_link", ROBOT_AT).moving("odom", "base_link", 4, 4.0);
    let log = [3, 4].into_iter().fold(made, |made, sec| made.scan("/scan", sec, |_| ())).read().unwrap();
    assert_eq!(log.odometry.iter().map(|(time, pose)| (*time, pose.x)).collect::<Vec<_>>(), [(3.0, 3.0), (4.0, 4.0)]);
}

#[test]
fn a_recording_in_parts_is_one_log() {
    let whole = Made::new().odometry("/odom", 1, 0.0).scan("/scan", 1, |_| ()).odometry("/odom", 2, 1.0).scan(
        "/scan",
        2,
        |_| (),
    );
    let parts = [
        Made::new().odometry("/odom", 1, 0.0).scan("/scan", 1, |_| ()).bytes(),
        Made::new().odometry("/odom", 2, 1.0).scan("/scan", 2, |_| ()).bytes(),
    ];
    let mut reader = BagReader::new(BagOptions::default());
    reader.push(&parts[0]).unwrap();
    reader.end_part().unwrap();
    reader.push(&parts[1]).unwrap();
    assert_eq!(reader.finish().unwrap(), whole.read().unwrap());
    let mut broken = BagReader::new(BagOptions::default());
    broken.push(&parts[0][..parts[0].len() / 2]).unwrap();
    assert_eq!(broken.end_part().unwrap_err().problem, LogProblem::Truncated);
}
