//! Logs: what the parser reads and refuses, the benchmark's metric, and that no input makes either panic.

use fastslam::geometry::Pose2;
use fastslam::mapper::{LaserMapperSettings, Replay};
use fastslam::ops;
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::longest_reading;
use fastslam_lab::experiment::log::Example;
use fastslam_log::{LaserLog, LogError, LogReader, NEAR, Relation, parse, parse_relations, relation_errors, write};
use flate2::read::GzDecoder;
use std::f64::consts::PI;
use std::io::Read as _;
use std::sync::Arc;

#[path = "../../../fuzz/fuzz_targets/any_bytes.rs"]
mod any_bytes;

/// One message of each kind, with two lasers of different fans.
const SMALL: &str = "# a comment\n\
    PARAM robot_frontlaser_offset 0.25 nohost\n\
    PARAM robot_front_laser_max 8.0 nohost\n\
    PARAM base_motdir\n\
    ODOM 0.0 0.0 0.0 0 0 0 10.0 nohost 0.0\n\
    FLASER 5 1.0 2.0 nan 0 8.19 0.1 0.0 0.0 0.1 0.0 0.0 10.5 nohost 0.5\n\
    RLASER 2 1 1 0 0 0 0 0 0 10.6 nohost 0.6\n\
    SYNC anything goes here \n\
    ROBOTLASER1 0 -1.5 3.0 1.5 30.0 0.01 0 3 1.0 2.0 30.0 1 77 1.3 0.0 0.1 1.0 0.0 0.1 0 0 0.5 0.5 0 11.0 nohost 1.0\r\n\
    \n\
    ODOM 2e0 0.0 0.0 0 0 0 12.0 nohost 2.0";

/// A log of ../shared/data; without it a test says that it is skipped.
pub fn recorded(file: &str) -> Option<LaserLog> {
    let Ok(bytes) = std::fs::read(format!("{}/../../../shared/data/{file}", env!("CARGO_MANIFEST_DIR"))) else {
        println!("skipped: {file} is not in ../shared/data");
        return None;
    };
    Some(parse(&unpacked(bytes), false).unwrap())
}

/// A file, packed or not.
fn unpacked(bytes: Vec<u8>) -> Vec<u8> {
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return bytes;
    }
    let mut all = Vec::new();
    GzDecoder::new(&bytes[..]).read_to_end(&mut all).unwrap();
    all
}

fn message(text: &str) -> LogError {
    parse(text.as_bytes(), false).unwrap_err()
}

#[test]
fn every_message_is_read_as_carmen_wrote_it() {
    let log = parse(SMALL.as_bytes(), false).unwrap();
    assert_eq!(log.scans.len(), 2);
    let [front, robot] = [&log.scans[0], &log.scans[1]];
    assert_eq!((front.time, front.odometry, front.max_range), (10.5, Pose2::new(0.1, 0.0, 0.0), Some(8.0)));
    assert_eq!((front.first_angle, front.angle_step), (-0.5 * PI, 0.25 * PI));
    assert_eq!(front.robot_from_laser, Pose2::new(0.25, 0.0, 0.0));
    assert_eq!(front.ranges, [1.0, 2.0, f32::INFINITY, 0.0, 8.19]);
    assert_eq!((robot.first_angle, robot.angle_step, robot.max_range), (-1.5, 1.5, Some(30.0)));
    assert!((robot.robot_from_laser.x - 0.3 * ops::cos(0.1)).abs() < 1e-12, "seen from a robot that is turned");
    assert_eq!(log.odometry.iter().map(|(time, _)| *time).collect::<Vec<_>>(), [10.0, 10.5, 11.0, 12.0]);
    assert_eq!((log.notes.rear, log.notes.unknown), (1, vec![("SYNC".to_owned(), 1)]));
    assert_eq!((log.notes.malformed, log.notes.out_of_order), (0, 0));
}

#[test]
fn readings_that_met_nothing_are_no_end_points_and_far_ones_are_cut() {
    let log = parse(SMALL.as_bytes(), false).unwrap();
    let ends = log.scans[0].end_points(100.0, 1.5);
    assert_eq!((ends.hits.len(), ends.misses.len()), (1, 1));
    assert!((ends.hits[0][0] - 0.25).abs() < 1e-12 && (ends.hits[0][1] + 1.0).abs() < 1e-12, "{ends:?}");
    assert_eq!(longest_reading(&log.scans), 30.0);
}

#[test]
fn a_few_errors_beyond_the_longest_range_do_not_make_walls_of_it() {
    let scan = |longest: f64| format!("FLASER 4 2.0 3.0 8.19 {longest} 0 0 0 0 0 0 1 h 1\n");
    let log = parse([scan(8.0).repeat(999), scan(81.91)].concat().as_bytes(), false).unwrap();
    let longest = LaserMapperSettings::default().for_scans(&log.scans).no_return.unwrap();
    assert!((7.9..8.0).contains(&longest), "{longest}");
    assert_eq!(log.scans[0].end_points(longest, 30.0).hits.len(), 2);
}

/// However many beams are said to have met something at a distance that no laser measures.
#[test]
fn readings_that_cannot_be_change_no_meaning_of_others() {
    for absurd in ["1e30", "65535", "4e3"] {
        let text = format!("FLASER 5 2.0 3.0 8.0 81.83 {absurd} 0 0 0 0 0 0 1 h 1\n");
        let log = parse(text.repeat(20).as_bytes(), false).unwrap();
        let longest = LaserMapperSettings::default().for_scans(&log.scans).no_return.unwrap();
        assert!((79.0..80.0).contains(&longest), "{absurd}: {longest}");
    }
}

#[test]
fn a_half_circle_may_leave_its_last_beam_out() {
    for (count, first, step) in
        [(180, -90.0, 1.0), (181, -90.0, 1.0), (361, -90.0, 0.5), (360, -90.0, 0.5), (401, -50.0, 0.25)]
    {
        let text = format!("FLASER {count}{} 0 0 0 0 0 0 1 h 1", " 1".repeat(count));
        let scan = parse(text.as_bytes(), false).unwrap().scans.swap_remove(0);
        assert!(
            (scan.first_angle.to_degrees() - first).abs() < 1e-9 && (scan.angle_step.to_degrees() - step).abs() < 1e-9
        );
    }
}

#[test]
fn stamps_that_go_back_are_put_in_order() {
    let at = |time: f64| format!("FLASER 1 1 0 0 0 {time} 0 0 {time} h 0\n");
    let log = parse([at(3.0), at(1.0), at(2.0)].concat().as_bytes(), false).unwrap();
    assert_eq!(log.scans.iter().map(|scan| scan.odometry.x).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
    assert_eq!(log.notes.out_of_order, 1);
}

#[test]
fn a_malformed_line_is_named_and_what_was_expected() {
    for (line, said) in [
        ("FLASER", "FLASER: expected the number of ranges, found the end of the line"),
        ("FLASER -1", "the number of ranges, found “-1”"),
        ("FLASER 4294967295 1 2", "expected 4294967295 ranges, of them number 3, found the end of the line"),
        ("FLASER 1 wall 0 0 0 0 0 0 1", "of them number 1, found “wall”"),
        ("FLASER 1 1 0 0 0 0 0", "odom_x, odom_y, odom_theta, found the end"),
        ("FLASER 1 1 0 0 0 0 0 1e300 1", "odom_x, odom_y, odom_theta within 10000 km"),
        ("FLASER 1 1 0 0 0 nan 0 0 1", "found “nan”"),
        ("ODOM 0 0 0 0 0 0", "ODOM: expected a time [s]"),
        ("ROBOTLASER1 0 -90 180 1 81 0 0 1 1", "expected angles in radians, found -90 and 1"),
        ("FLASER 0 0 0 0 0 0 0 1 h 1", "FLASER: expected ranges, found 0 of them"),
        ("PARAM robot_front_laser_max far", "expected metres, found “far”"),
        ("<html>", "expected the name of a message, found “<html>”"),
        ("caf\u{e9} 1 2", "expected the name of a message"),
    ] {
        let error = message(&format!("# fine\n{line}\n"));
        assert_eq!(error.line, 2);
        assert!(error.to_string().contains(said) && error.to_string().lines().count() == 1, "{error}");
        let both = format!("{line}\n{SMALL}\nODOM 1");
        let log = parse(both.as_bytes(), true).unwrap();
        assert_eq!((log.scans.len(), log.notes.malformed, log.notes.first_malformed.unwrap().line), (2, 2, 1));
    }
    assert_eq!(parse(b"\xff\xfe\x00", false).unwrap_err().line, 1);
    assert_eq!(message("").to_string(), "line 0: no FLASER or ROBOTLASER1 message in it");
    assert!(message("SYNC 1\n").to_string().contains("(but SYNC)"));
}

#[test]
fn a_mark_of_utf_8_is_passed_over_and_files_that_are_parts_count_their_own_lines() {
    let marked = format!("\u{feff}{SMALL}");
    assert_eq!(parse(marked.as_bytes(), false).unwrap(), parse(SMALL.as_bytes(), false).unwrap());
    let mut reader = LogReader::new(false);
    reader.push(SMALL.as_bytes()).unwrap();
    assert_eq!(reader.scans(), 2);
    reader.end_part().unwrap();
    assert_eq!(reader.push(marked.as_bytes()).and_then(|()| reader.push(b"\nODOM 1\n")).unwrap_err().line, 12);
}

#[test]
fn where_there_is_no_scan_the_first_malformed_line_tells_most() {
    let error = parse(b"SYNC 1\nODOM 1\nFLASER 1\n", true).unwrap_err();
    assert_eq!(error.to_string(), "line 2: ODOM: expected x, y, theta, found the end of the line");
}

#[test]
fn a_scan_that_does_not_go_with_those_before_it_is_named() {
    let scan = |beams: usize, x: f64| format!("FLASER {beams}{} 0 0 0 {x} 0 0 1 h 1\n", " 1".repeat(beams));
    for (second, said) in [
        (scan(3, 0.1), "FLASER: expected 4 ranges as in the scans before, found 3"),
        (scan(4, 5e3), "FLASER: expected a pose within 1 km of the scan before, found one 5.0 km away"),
    ] {
        let text = [scan(4, 0.0), second, scan(4, 0.2)].concat();
        let error = message(&text);
        assert_eq!((error.line, error.problem.to_string().as_str()), (2, said));
        let log = parse(text.as_bytes(), true).unwrap();
        assert_eq!((log.scans.len(), log.notes.malformed), (2, 1), "passed over, and the next one goes with the first");
    }
}

#[test]
fn a_log_that_has_met_nothing_is_no_log_to_map() {
    for reading in ["nan", "inf", "0", "-1"] {
        let text = format!("FLASER 4{} 0 0 0 0 0 0 1 h 1\n", format!(" {reading}").repeat(4)).repeat(3);
        for lenient in [false, true] {
            let error = parse(text.as_bytes(), lenient).unwrap_err();
            let said = "none of its 12 readings is a range: a finite number above 0";
            assert_eq!((error.line, error.problem.to_string().as_str()), (0, said), "{reading}");
        }
    }
}

#[test]
fn a_log_is_read_in_pieces_as_it_is_read_whole() {
    let example = write(&Example::new(3).log);
    let text =
        [SMALL, "\nODOM 1 2\n", &example.replace("FLASER 180", "FLASER 5 1 1 1 1 1 0 0 0 0 0 0 9 h 9\nFLASER 180")]
            .concat();
    let whole = parse(text.as_bytes(), true).unwrap();
    assert!(whole.notes.malformed > 0 && whole.scans.len() > 3);
    for size in [1, 7, 64, 4096] {
        let mut reader = LogReader::new(true);
        text.as_bytes().chunks(size).for_each(|piece| reader.push(piece).unwrap());
        assert_eq!(reader.finish().unwrap(), whole, "in pieces of {size} bytes");
        let mut strict = LogReader::new(false);
        let refused = text.as_bytes().chunks(size).find_map(|piece| strict.push(piece).err());
        assert_eq!(refused, whole.notes.first_malformed, "in pieces of {size} bytes");
    }
}

/// A gigabyte of newlines in a small archive, or one line without an end: neither is kept, nor read to its end.
#[test]
fn what_is_no_log_is_given_up_early_and_a_line_without_an_end_is_not_kept() {
    let mut reader = LogReader::new(true);
    let newlines = vec![b'\n'; 1 << 20];
    let read = (1..1000).find(|_| reader.push(&newlines).is_err());
    assert_eq!(read, Some(65), "megabytes");
    let error = reader.push(b"").unwrap_err();
    assert_eq!(error.to_string(), "line 0: no FLASER or ROBOTLASER1 message in its first 64 MB");

    let endless = [b"FLASER 4 ".to_vec(), vec![b'1'; 3 << 20], b"\n".to_vec(), SMALL.into()].concat();
    assert_eq!(
        parse(&endless, false).unwrap_err().to_string(),
        "line 1: expected a message, found a line of more than 1 MB"
    );
    let log = parse(&endless, true).unwrap();
    assert_eq!((log.scans.len(), log.notes.malformed), (2, 1));
}

#[test]
fn the_example_is_read_back_as_it_was_written() {
    let log = Example::new(5).log;
    let read = parse(write(&log).as_bytes(), false).unwrap();
    assert_eq!(read.odometry, log.odometry);
    for (read, scan) in read.scans.iter().zip(&log.scans) {
        assert_eq!((read.time, read.odometry, &read.ranges), (scan.time, scan.odometry, &scan.ranges));
        assert_eq!(read.first_angle, scan.first_angle);
        assert!((read.angle_step - scan.angle_step).abs() < 1e-15);
    }
}

/// What a fuzzer does, with a fixed seed: neither the parser nor, on what it lets through, the filter may panic or hang.
#[test]
fn mutilated_logs_are_refused_or_mapped_but_never_panic() {
    let example = write(&Example::new(4).log);
    let words = [
        "NaN",
        "-inf",
        "1e308",
        "-1",
        "0",
        "99999999999",
        "4294967295",
        "FLASER",
        "\0\u{1}",
        "\n",
        "1e7",
        "ROBOTLASER1",
    ];
    let (mut read, mut mapped) = (0, 0);
    for trial in 0..400 {
        let mut stream = Stream::at(5, Purpose::TRIAL, trial, 0);
        let mut below = |n: usize| (stream.uniform() * n as f64) as usize;
        let mut bytes = [SMALL.as_bytes(), b"\n", example.as_bytes()].concat();
        for _ in 0..=below(4) {
            let at = below(bytes.len());
            match below(4) {
                0 => bytes.truncate(at.max(1)),
                1 => bytes[at] = below(256) as u8,
                2 => {
                    let end = (at + below(40)).min(bytes.len());
                    bytes.drain(at..end);
                }
                _ => {
                    // A whole word, so that the line is likely to be read.
                    let blank = |byte: &u8| byte.is_ascii_whitespace();
                    let start = bytes[..at].iter().rposition(blank).map_or(0, |k| k + 1);
                    let end = bytes[start..].iter().position(blank).map_or(bytes.len(), |k| start + k);
                    bytes.splice(start..end, words[below(words.len())].bytes());
                }
            }
            if bytes.is_empty() {
                break;
            }
        }
        any_bytes::any_bytes(&bytes);
        let strict = parse(&bytes, false);
        let Ok(log) = parse(&bytes, true) else { continue };
        read += 1;
        assert!(strict.is_err() == (log.notes.malformed > 0), "the two ways to read agree on what is malformed");
        assert!(log.scans.windows(2).all(|pair| pair[0].time <= pair[1].time));
        if trial % 4 == 0 {
            let settings = LaserMapperSettings { particles: 2, max_range: 5.0, ..LaserMapperSettings::default() };
            let mut replay = Replay::new(settings, Arc::new(log)).unwrap();
            replay.by_ref().for_each(drop);
            assert!(replay.mapper().path().iter().all(|(_, pose)| pose.x.is_finite() && pose.y.is_finite()));
            mapped += 1;
        }
    }
    assert!(read > 200 && mapped > 50, "{read} logs read, {mapped} mapped");
}

#[test]
fn the_truth_has_no_errors_and_a_shift_of_the_frame_makes_none() {
    let Example { log, truth, relations } = Example::new(80);
    let frame = Pose2::new(3.0, -2.0, 1.0);
    let path: Vec<_> = log.scans.iter().zip(&truth).map(|(scan, pose)| (scan.time, frame.compose(pose))).collect();
    let errors = relation_errors(&path, &log.odometry, &relations).unwrap();
    assert_eq!(errors.relations as usize, relations.len());
    assert!(errors.translation_mean < 1e-9 && errors.rotation_mean_deg < 1e-9, "{errors:?}");

    // Nothing to judge is not an error of zero.
    assert_eq!(relation_errors(&[], &log.odometry, &relations), None);
    let another = relations.iter().map(|Relation { times, first_from_second }| Relation {
        times: times.map(|time| time + 1e6),
        first_from_second: *first_from_second,
    });
    assert_eq!(relation_errors(&path, &log.odometry, &another.collect::<Vec<_>>()), None);
}

#[test]
fn errors_are_those_computed_by_hand() {
    let path = [(0.0, Pose2::default()), (10.0, Pose2::new(3.0, 0.0, 0.0))];
    // By odometry half a metre ahead and a little left from 10 s to 11 s.
    let odometry =
        [(0.0, Pose2::default()), (10.0, Pose2::new(2.0, 0.0, 0.5 * PI)), (11.0, Pose2::new(2.0, 0.5, 0.6 * PI))];
    let relation = |t1, t2, x, y, theta| Relation { times: [t1, t2], first_from_second: Pose2::new(x, y, theta) };
    let relations = [
        relation(0.0, 10.0, 3.0, 0.4, -PI / 18.0), // 0.4 m and 10° off
        relation(0.0, 11.0, 3.5, 0.0, 0.1 * PI),   // exact, with the odometry's half metre
        relation(10.0, 0.0, -3.0, 0.0, 0.0),       // back, exact
        relation(10.0, 99.0, 7.0, 7.0, 1.0),       // when the log was over
    ];
    let errors = relation_errors(&path, &odometry, &relations).unwrap();
    assert!((errors.translation_mean - 0.4 / 3.0).abs() < 1e-12, "{errors:?}");
    assert!((errors.rotation_mean_deg - 10.0 / 3.0).abs() < 1e-9, "{errors:?}");
    assert!((errors.translation_std - 0.4 * (2.0_f64 / 9.0).sqrt()).abs() < 1e-12, "{errors:?}");
}

/// The rule of the published figures, branch by branch: which estimate a stamp takes, and whether odometry moves it.
#[test]
fn a_stamp_takes_the_estimate_within_a_tenth_of_a_second_as_it_stands_and_else_moves_the_nearest() {
    let at = |x: f64| Pose2::new(x, 0.0, 0.0);
    // Estimated at 0, 10 and, twice, 20 s; by odometry half a metre a second, and at 30 s the wheels jump.
    let path = [(0.0, at(0.0)), (10.0, at(100.0)), (20.0, at(200.0)), (20.0, at(300.0))];
    let odometry = [(0.0, at(0.0)), (30.0, at(15.0)), (30.0, at(55.0)), (40.0, at(60.0))];
    let cases = [
        (10.0, 100.0),
        (10.0 + 0.99 * NEAR, 100.0),
        (10.0 - 0.99 * NEAR, 100.0),
        (NEAR, 0.0), // the bound itself is near
        (10.0 + 1.01 * NEAR, 100.0 + 0.5 * 1.01 * NEAR),
        (10.0 - 1.01 * NEAR, 100.0 - 0.5 * 1.01 * NEAR),
        (4.0, 2.0),           // moved on from 0 s
        (6.0, 98.0),          // moved back from 10 s
        (5.0, 2.5),           // of two as near the earlier
        (20.05, 200.0),       // of two with one stamp the first
        (24.0, 202.0),        // and so where it is moved
        (30.0, 205.0),        // of odometry with one stamp the first of the file
        (32.0, 200.0 + 46.0), // and after it the last
    ];
    let off = |(time, expected)| {
        let relation = Relation { times: [0.0, time], first_from_second: at(expected) };
        relation_errors(&path, &odometry, &[relation]).unwrap().translation_mean
    };
    let wrong: Vec<_> = cases.into_iter().filter(|case| off(*case) > 1e-9).collect();
    assert!(wrong.is_empty(), "times [s] at which it was somewhere else [m]: {wrong:?}");
}

#[test]
fn odometry_of_one_stamp_keeps_the_order_of_the_file() {
    let odom = |x: f64, time: f64| format!("ODOM {x} 0 0 0 0 0 {time} h 0\n");
    let scan = "FLASER 1 1 0 0 0 3 0 0 2.0 h 0\n";
    let text = [&odom(1.0, 2.0), &odom(9.0, 5.0), &odom(2.0, 2.0), scan, &odom(0.5, 1.0)].concat();
    let log = parse(text.as_bytes(), false).unwrap();
    let odometry: Vec<(f64, f64)> = log.odometry.iter().map(|(time, pose)| (*time, pose.x)).collect();
    assert_eq!(odometry, [(1.0, 0.5), (2.0, 1.0), (2.0, 2.0), (2.0, 3.0), (5.0, 9.0)]);
}

#[test]
fn relations_are_read_and_a_bad_line_of_them_named() {
    let relations = parse_relations(b"# c\n1 2 0.5 0.25 9 9 9 1.5\n").unwrap();
    assert_eq!(relations, [Relation { times: [1.0, 2.0], first_from_second: Pose2::new(0.5, 0.25, 1.5) }]);
    for (text, line) in [("1 2 3\n", 1), ("\n1 2 0 0 0 0 0 nan", 2), ("\u{0}", 1), ("# none", 0)] {
        assert_eq!(parse_relations(text.as_bytes()).unwrap_err().line, line, "{text}");
    }
    assert_eq!(parse_relations(b"1 2 0 0 0 0 0 1\n\xff").unwrap_err().line, 2);
}
