//! Recordings as their owners have them: in parts, packed, in folders, under other names, or of a kind that cannot be read.

use super::{bag, fastslam, json, noted, refusal, shared, short_log};
use mcap::WriteOptions;
use mcap::read::LinearReader;
use mcap::records::{MessageHeader, Record};
use ruzstd::decoding::StreamingDecoder;
use std::collections::BTreeMap;
use std::io::{Cursor, Read as _};
use tempfile::tempdir;

#[test]
fn a_bag_is_mapped_as_the_log_that_says_the_same_and_its_path_is_written_for_ros() {
    let folder = tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (tum, mcap) = (file("path.tum"), file("path.mcap"));
    let digest = |log: &str| {
        json(&format!("log {log} --particles 3 --trajectory {tum} --path-mcap {mcap} --json"))["digest"].clone()
    };
    let expected = digest(&bag("lap.clf"));
    let (path, message) = (std::fs::read(&tum).unwrap(), std::fs::read(&mcap).unwrap());
    for name in ["odometry-zstd.mcap", "odometry.db3", "tf-lz4.mcap", "plain.bag", "lz4.bag", "bz2.bag"] {
        assert_eq!(digest(&bag(name)), expected, "{name}");
        assert_eq!((&std::fs::read(&tum).unwrap(), &std::fs::read(&mcap).unwrap()), (&path, &message), "{name}");
    }
    assert!(message.starts_with(b"\x89MCAP0\r\n") && message.ends_with(b"\x89MCAP0\r\n"));
    // The figure of logs saves the same bytes (tests/e2e/log-bags.spec.ts).
    if std::env::var_os("UPDATE_GOLDENS").is_some() {
        std::fs::write(bag("lap-path.mcap"), &message).unwrap();
    }
    assert!(message == std::fs::read(bag("lap-path.mcap")).unwrap(), "UPDATE_GOLDENS=1 writes it if that is wanted");
    // What the path's own reader finds in it: no scans, but a path.
    let refused = fastslam(&format!("log {mcap}")).code(2).stdout("");
    let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(
        said.ends_with("path.mcap: no sensor_msgs/LaserScan in it; there is /path (1 × nav_msgs/Path)\n"),
        "{said}"
    );
}

#[test]
fn a_bag_that_cannot_be_read_is_refused_by_file_and_topic() {
    let folder = tempdir().unwrap();
    let refused = |arguments: &str| {
        let refused = fastslam(arguments).code(2).stdout("");
        String::from_utf8_lossy(&refused.get_output().stderr).into_owned()
    };
    let said = refused(&format!("log {} --scan-topic /odom", bag("lz4.bag")));
    assert!(
        said.ends_with("lz4.bag: the topic /odom is of type nav_msgs/Odometry, not sensor_msgs/LaserScan\n"),
        "{said}"
    );
    let said = refused(&format!("log {} --scan-topic /scan", bag("lap.clf")));
    assert!(said.contains("are for bags"), "{said}");
    let half = folder.path().join("half.mcap");
    let bytes = std::fs::read(bag("odometry-zstd.mcap")).unwrap();
    std::fs::write(&half, &bytes[..bytes.len() / 2]).unwrap();
    let half = half.display();
    assert!(refused(&format!("log {half}")).contains("half.mcap: it ends in the middle of a record"));
    let read = fastslam(&format!("log {half} --lenient --particles 2 --json")).success();
    let said = String::from_utf8_lossy(&read.get_output().stderr).into_owned();
    assert!(
        said.contains("malformed messages passed over: 1, the first of them: it ends in the middle of a record"),
        "{said}"
    );
}

/// A bag in so many parts of as many messages, as a recorder splits it: each tells all that its messages need.
fn parts(name: &str, count: usize) -> Vec<Vec<u8>> {
    let bytes = std::fs::read(bag(name)).unwrap();
    let (mut schemas, mut channels, mut messages) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
    let mut keep = |record| match record {
        Record::Schema { header, .. } => drop(schemas.insert(header.id, header.name)),
        Record::Channel(channel) => drop(channels.insert(channel.id, channel)),
        Record::Message { header, data } => messages.push((header, data.into_owned())),
        _ => {}
    };
    for record in LinearReader::new(&bytes).unwrap().map(Result::unwrap) {
        let Record::Chunk { data, .. } = record else { continue };
        let mut chunk = Vec::new();
        StreamingDecoder::new(&data[..]).unwrap().read_to_end(&mut chunk).unwrap();
        LinearReader::sans_magic(&chunk).for_each(|record| keep(record.unwrap().into_owned()));
    }
    let part = |messages: &[(MessageHeader, Vec<u8>)]| {
        let mut writer = WriteOptions::new().compression(None).create(Cursor::new(Vec::new())).unwrap();
        for (header, data) in messages {
            let channel = &channels[&header.channel_id];
            let schema = writer.add_schema(&schemas[&channel.schema_id], "ros2msg", b"").unwrap();
            let channel_id = writer.add_channel(schema, &channel.topic, "cdr", &BTreeMap::new()).unwrap();
            writer.write_to_known_channel(&MessageHeader { channel_id, ..*header }, data).unwrap();
        }
        writer.finish().unwrap();
        writer.into_inner().into_inner()
    };
    messages.chunks(messages.len().div_ceil(count)).map(part).collect()
}

fn digest(log: &str) -> String {
    json(&format!("log {log} --particles 2 --json"))["digest"].as_str().unwrap().to_owned()
}

#[test]
fn a_recording_in_parts_is_mapped_as_the_whole() {
    let folder = tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let expected = digest(&bag("odometry-zstd.mcap"));
    // Eleven parts: a shell names the tenth before the second.
    let all = parts("odometry-zstd.mcap", 11);
    let names: Vec<String> = (0..all.len()).map(|k| format!("recording_{k}.mcap")).collect();
    names.iter().zip(&all).for_each(|(name, bytes)| std::fs::write(place(name), bytes).unwrap());
    let mut files: Vec<String> = names.iter().map(|name| place(name).display().to_string()).collect();
    files.sort();
    assert_eq!(digest(&files.join(" ")), expected);
    // The folder, before and after its recorder has said what is in it, which leaves others out.
    let itself = folder.path().display().to_string();
    assert_eq!(digest(&itself), expected);
    let listed: String = names.iter().map(|name| format!("    - recording/{name}\n")).collect();
    let metadata = format!("rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n{listed}  duration:\n");
    std::fs::write(place("metadata.yaml"), metadata).unwrap();
    std::fs::write(place("another.mcap"), "").unwrap();
    assert_eq!(digest(&itself), expected);
    assert!(refusal(&format!("log {}", place("metadata.yaml").display())).contains("name the folder that it is in"));
    std::fs::remove_file(place("recording_7.mcap")).unwrap();
    assert!(
        refusal(&format!("log {itself}"))
            .contains("metadata.yaml names recording/recording_7.mcap, which is not there")
    );
    std::fs::remove_file(place("metadata.yaml")).unwrap();
    assert!(
        refusal(&format!("log {itself}"))
            .contains("name one of the bags in it, or the parts of one: another.mcap, recording_0.mcap")
    );
    // Logs in plain text, of which one is malformed.
    let text = std::fs::read_to_string(bag("lap.clf")).unwrap();
    let (first, second) = text.split_at(text.match_indices('\n').nth(20).unwrap().0);
    std::fs::write(place("a.clf"), first).unwrap();
    std::fs::write(place("b.clf"), second.trim_start()).unwrap();
    let both = format!("{} {}", place("a.clf").display(), place("b.clf").display());
    assert_eq!(digest(&both), digest(&bag("lap.clf")));
    std::fs::write(place("b.clf"), "# one\nODOM 1\n").unwrap();
    assert!(refusal(&format!("log {both}")).contains("b.clf: line 2: ODOM: expected x, y, theta"));
    // In one folder: files are read in the order of their paths, and where the samples lie is nobody's choice.
    std::fs::copy(bag("odometry-zstd.mcap"), place("c.mcap")).unwrap();
    let mixed = refusal(&format!("log {} {}", place("c.mcap").display(), place("a.clf").display()));
    assert!(mixed.contains("c.mcap: it is of another kind than the file before it"), "{mixed}");
}

#[test]
fn what_is_packed_by_zstd_is_unpacked() {
    let folder = tempdir().unwrap();
    let packed = folder.path().join("recording.mcap.zstd");
    let bytes = std::fs::read(bag("odometry-zstd.mcap")).unwrap();
    let zstd = ruzstd::encoding::compress_to_vec(&bytes[..], ruzstd::encoding::CompressionLevel::Fastest);
    std::fs::write(&packed, &zstd).unwrap();
    assert_eq!(digest(&packed.display().to_string()), digest(&bag("odometry-zstd.mcap")));
    assert_eq!(digest(&folder.path().display().to_string()), digest(&bag("odometry-zstd.mcap")));
    std::fs::write(&packed, &zstd[..zstd.len() / 2]).unwrap();
    assert!(refusal(&format!("log {}", packed.display())).contains("recording.mcap.zstd: cannot be unpacked: "));
}

#[test]
fn a_file_that_cannot_be_read_is_refused_by_its_kind_and_with_what_will_help() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("log");
    let said = |bytes: &[u8], options: &str| {
        std::fs::write(&file, bytes).unwrap();
        refusal(&format!("log {} {options}", file.display()))
    };
    let utf16: Vec<u8> = "\u{feff}FLASER 1 1".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let formats = "; logs that can be read are ROS 2 bags (MCAP), ROS 1 bags, CARMEN's format, and scans as JSON lines";
    for (bytes, part) in [
        (&b"SQLite format 3\0"[..], "ros2 bag convert"),
        (b"PK\x03\x04 and more", "it is a zip archive: unpack it first (unzip)"),
        (b"BZh91AY", "bunzip2"),
        (&utf16, "UTF-16"),
        (b"time,x,y\n1,2,3\n", formats),
        (b"\x7fELF\x02\x01\xff", formats),
        (b"", formats),
        (b"# subject\n1 2 3\n", formats),
        (b"# a graph\nFIX 0\nVERTEX_SE2 0 0 0 0\n", "`fastslam landmarks --g2o` reads graphs"),
        (b"{\"time\": 1, \"ranges\": [NaN]}\n", "s/NaN/0/g"),
        (b"\n{\"time\": 1,, }\n", "line 2: expected a scan in JSON: key must be a string at column 12\n"),
    ] {
        let said = said(bytes, "");
        assert!(said.contains(part) && said.trim_end().lines().count() == 1, "{said}");
    }
    // Packed and not: what is in it counts.
    let tar = [&[b'a'; 257][..], b"ustar\x0000", &[0; 400]].concat();
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    std::io::Write::write_all(&mut encoder, &tar).unwrap();
    assert!(said(&encoder.finish().unwrap(), "").contains("tar -xf"));
    // A log that is known is no longer told what logs there are, but how to pass over what is wrong with it.
    let good = "FLASER 2 1.0 2.0 0 0 0 0 0 0 1 host 1\n";
    let line = said(format!("{good}GPS?\n").as_bytes(), "");
    assert!(line.contains("line 2: ") && line.ends_with("(--lenient passes such lines over)\n"), "{line}");
    // A mark of UTF-8 is no fault.
    let log = short_log(&folder, 5);
    let text = std::fs::read_to_string(&log).unwrap();
    std::fs::write(
        &file,
        format!("\u{feff}{}", text.lines().skip(1).map(|line| format!("{line}\n")).collect::<String>()),
    )
    .unwrap();
    assert_eq!(digest(&file.display().to_string()), digest(&log));
}

/// Odometry that is told in a frame of another name than `odom` is that of the laser's own chain.
#[test]
fn odometry_may_be_told_in_a_frame_of_any_name() {
    let base = "base/base.mcap.gz";
    let names = ["odometry-frame-names/odom_comb.mcap.gz", "odometry-frame-names/robot1-odom.mcap.gz"];
    let Some(cases) = shared("cases", "", [base, names[0]]) else { return };
    let expected = digest(&format!("{cases}{base}"));
    for name in names {
        let run = fastslam(&format!("log {cases}{name} --particles 2")).success();
        assert_eq!(noted(&run), "", "{name}");
        assert_eq!(digest(&format!("{cases}{name}")), expected, "{name}");
    }
    let refused = refusal(&format!("log {cases}{} --odometry-frame odom", names[0]));
    assert!(
        refused.contains("no transform leads from the frame odom; those that move: odom_comb to base_link"),
        "{refused}"
    );
}

#[test]
fn a_file_of_settings_stands_behind_options_and_its_mistakes_are_named() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 20);
    let file = folder.path().join("settings.toml");
    let with = |text: &str, options: &str| {
        std::fs::write(&file, text).unwrap();
        format!("log {log} --settings {} {options}", file.display())
    };
    let expected = json(&format!("log {log} --particles 3 --cell 0.1 --seed 5 --json"))["digest"].clone();
    let text = "particles = 3\ncell = 0.1\nseed = 4\nweight = \"new-ground-free\"\nlenient = true\n";
    assert_eq!(json(&with(text, "--seed 5 --json"))["digest"], expected);
    for (text, said) in [
        (
            "particles = 3\ncells = 1\n",
            "settings.toml: line 2: unknown field `cells`, expected one of `particles`, `seed`",
        ),
        ("cell = 7\n", "settings.toml: cell = 7: must be a number from 0.02 to 0.2"),
        ("particles = \"many\"\n", "line 1: invalid type: string \"many\""),
        ("weight = \"heavy\"\n", "expected one of `marginal`"),
    ] {
        let refused = refusal(&with(text, ""));
        assert!(refused.contains(said), "{refused}");
    }
    fastslam(&format!("log {log} --settings no/such.toml")).code(1);
}
