//! `fastslam log`: what is written and printed of a map, and what is said of lines that cannot be read.

use super::{fastslam, json, short_log};
use tempfile::tempdir;

#[test]
fn a_log_is_mapped_and_its_path_map_and_errors_are_written() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 60);
    let [path, map, relations] =
        ["path.tum", "map", "example.relations"].map(|name| folder.path().join(name).display().to_string());
    let outputs = format!("--trajectory {path} --map {map} --relations {relations}");
    let run = json(&format!("log {log} --particles 3 --seed 2 --threads 1 --json {outputs}"));
    assert_eq!((run["scans"].as_u64(), run["digest"].as_str().unwrap().len()), (Some(60), 16));
    assert!(
        run["translation_mean"].as_f64().unwrap() < 0.1 && run["rotation_mean_deg"].as_f64().unwrap() < 2.0,
        "{run}"
    );
    assert!(run["peak_map_bytes"].as_f64().unwrap() < run["dense_map_bytes"].as_f64().unwrap());
    #[cfg(target_os = "linux")]
    assert!(run["peak_process_bytes"].as_u64().unwrap() > run["peak_map_bytes"].as_u64().unwrap());
    let longest = run["longest_scan_s"].as_f64().unwrap();
    let mean = run["elapsed_s"].as_f64().unwrap() / run["scans"].as_f64().unwrap();
    assert!((mean..=run["elapsed_s"].as_f64().unwrap()).contains(&longest), "{longest} s, {mean} s in the mean");
    let keys =
        ["ms_per_scan_particle", "translation_std", "resampled_fraction", "lineage_one_scan", "wheel_drift_deg_per_m"];
    for key in keys {
        assert!(run.get(key).is_some(), "{key}");
    }
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text.lines().count(), 60);
    assert_eq!(text.lines().next(), Some("1000000000.000000 0.000000 0.000000 0 0 0 0.000000000 1.000000000"));
    let pgm = std::fs::read(format!("{map}.pgm")).unwrap();
    let png = std::fs::read(format!("{map}.png")).unwrap();
    let (width, height) = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap().info().size();
    assert!(pgm.starts_with(format!("P5\n{width} {height}\n255\n").as_bytes()));
    let yaml = std::fs::read_to_string(format!("{map}.yaml")).unwrap();
    assert!(yaml.contains("image: \"map.pgm\"") && yaml.contains("resolution: 0.05"), "{yaml}");

    let threads = json(&format!("log {log} --particles 3 --seed 2 --threads 3 --json"));
    assert_eq!((&threads["digest"], threads.get("translation_mean")), (&run["digest"], None));
    let said = fastslam(&format!("log {log} --particles 2 --relations {relations}")).success();
    assert!(String::from_utf8_lossy(&said.get_output().stdout).contains("over"));

    // Compressed, it is the same log.
    let packed = format!("{log}.gz");
    let mut encoder =
        flate2::write::GzEncoder::new(std::fs::File::create(&packed).unwrap(), flate2::Compression::fast());
    std::io::Write::write_all(&mut encoder, &std::fs::read(&log).unwrap()).unwrap();
    encoder.finish().unwrap();
    assert_eq!(json(&format!("log {packed} --particles 3 --seed 2 --json"))["digest"], run["digest"]);
    std::fs::write(&packed, &std::fs::read(&packed).unwrap()[..999]).unwrap();
    let refused = fastslam(&format!("log {packed}")).code(2);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("cannot be unpacked"));
}

#[test]
fn a_log_that_cannot_be_read_is_refused_by_line_and_one_with_flaws_is_read_if_asked() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 3);
    let good = std::fs::read_to_string(&log).unwrap();
    for (text, said) in [
        ("".to_owned(), "no FLASER"),
        ("\0\u{1}\u{2}".to_owned(), "line 1: expected the name of a message"),
        (good.replace("FLASER 180", "FLASER 0"), "expected ranges, found 0 of them"),
        (good.clone() + "FLASER 1 1 0 0 0 0 0 0 9 h 9\n", "expected 180 ranges as in the scans before, found 1"),
        ("FLASER 2 nan 0 0 0 0 0 0 0 1 h 1\n".repeat(9), "none of its 18 readings is a range"),
        (
            "{\"time\": 1, \"ranges\": [1.0, NaN]}\n".to_owned(),
            "line 1: expected a scan in JSON: NaN and Infinity are not JSON",
        ),
        ("SQLite format 3\0".to_owned(), "becomes MCAP by `ros2 bag convert`"),
        (good.clone() + "ODOM 1 2\n", "line 5: ODOM: expected x, y, theta, found the end of the line"),
    ] {
        std::fs::write(&log, text).unwrap();
        let refused = fastslam(&format!("log {log}")).code(2).stdout("");
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains(said) && message.trim_end().lines().count() == 1, "{message}");
    }
    let folder_itself = fastslam(&format!("log {}", folder.path().display())).code(2);
    let said = String::from_utf8_lossy(&folder_itself.get_output().stderr).into_owned();
    assert!(said.contains("it is a folder without a bag in it; name a file"), "{said}");
    let flawed = fastslam(&format!("log {log} --lenient --particles 2 --json")).success();
    assert!(String::from_utf8_lossy(&flawed.get_output().stderr).contains("malformed lines passed over: 1"));
    std::fs::write(&log, good + "RLASER 0\nGPS 1\n").unwrap();
    let noted = fastslam(&format!("log {log} --particles 2 --json")).success();
    let notes = String::from_utf8_lossy(&noted.get_output().stderr).into_owned();
    assert!(notes.contains("1 messages of a rear laser") && notes.contains("1 GPS"), "{notes}");

    let relations = folder.path().join("bad.relations").display().to_string();
    std::fs::write(&relations, "1 2 3\n").unwrap();
    let another = folder.path().join("another.relations").display().to_string();
    std::fs::write(&another, "1 2 0 0 0 0 0 0\n3 4 0 0 0 0 0 0\n").unwrap();
    for (arguments, status, said) in [
        ("--cell 7".to_owned(), 2, "cell = 7: must be a number from 0.02 to 0.2"),
        ("--max-range NaN".to_owned(), 2, "max-range = NaN"),
        ("--min-travel -1".to_owned(), 2, "min-travel = -1"),
        ("--occupied-threshold 0.4".to_owned(), 2, "occupied-threshold = 0.4: must be a number from 0.5 to 1"),
        ("--free-threshold 0.7".to_owned(), 2, "free-threshold = 0.7: must be a number from 0 to 0.5"),
        ("--footprint-radius -0.1".to_owned(), 2, "footprint-radius = -0.1: must be a number from 0 to 5 [m]"),
        ("--particles 0".to_owned(), 2, "from 1 to 4096"),
        (format!("--relations {relations}"), 2, "line 1: expected 8 numbers"),
        (
            format!("--relations {another}"),
            2,
            "another.relations: none of its 2 relations is within the time of the log",
        ),
        ("--trajectory no/such/folder/path".to_owned(), 1, "no/such/folder/path"),
        ("--map no/such/folder/map".to_owned(), 1, "no/such/folder/map.png"),
    ] {
        let refused = fastslam(&format!("log {log} {arguments}")).code(status);
        assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains(said), "{arguments}");
    }
}

#[test]
fn scans_as_json_lines_take_their_odometry_from_tum_lines_or_from_each_other() {
    let folder = tempdir().unwrap();
    let name = folder.path().join("log.jsonl");
    let scan = |time: f64| {
        format!(
            "{{\"time\": {time}, \"angle_min\": -1.5, \"angle_increment\": 0.5, \"ranges\": [1, 2, null, 2, 2, 1]}}\n"
        )
    };
    let scans: String = [1.0, 2.0, 3.0].map(scan).concat();
    let run = || fastslam(&format!("log {} --particles 2 --json", name.display()));
    std::fs::write(&name, format!("1 0 0 0 0 0 0 1\n3 1 0 0 0 0 0 1\n{scans}")).unwrap();
    assert_eq!(String::from_utf8_lossy(&run().success().get_output().stderr), "");
    std::fs::write(&name, &scans).unwrap();
    let said = run().success();
    assert!(String::from_utf8_lossy(&said.get_output().stderr).contains("there is no odometry"));
    std::fs::write(&name, format!("{scans}{{\"time\": 4}}\n")).unwrap();
    let said = run().code(2);
    let said = String::from_utf8_lossy(&said.get_output().stderr).into_owned();
    assert!(said.contains("log.jsonl: line 4: a scan in JSON: expected \"angle_min\", found none"), "{said}");
}
