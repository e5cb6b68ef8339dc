//! Recorded buildings and a campus: how far off their maps are.

use super::{json, poses, recorded};
use fastslam::geometry::{Pose2, align, rms};
use fastslam::mapper::{LaserMapperSettings, Replay};
use fastslam_lab::experiment::long_rings::LoopErrors;
use fastslam_lab::experiment::looking_back::fixed_lag;
use serde_json::Value;
use tempfile::tempdir;

/// The first minutes of the Intel Research Lab. Seeds 1 to 3 gave 33 to 34 mm and 1.46° to 1.47°; the bounds leave twice as much above the worst as
/// lies between seeds.
#[test]
fn the_first_scans_of_the_intel_log_err_by_36_millimetres_and_1_5_degrees_at_most() {
    let Some(file) = recorded("intel", [".clf", ".relations"]) else { return };
    let folder = tempdir().unwrap();
    let first = folder.path().join("first.clf").display().to_string();
    let log = std::fs::read_to_string(format!("{file}.clf")).unwrap();
    std::fs::write(&first, log.lines().take(2500).map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    let run = json(&format!("log {first} --particles 8 --seed 1 --relations {file}.relations --json"));
    assert_eq!((&run["scans"], &run["relations"]), (&Value::from(134), &Value::from(379)));
    let [translation, rotation] = ["translation_mean", "rotation_mean_deg"].map(|key| run[key].as_f64().unwrap());
    assert!(translation <= 0.036 && rotation <= 1.5, "{translation} m, {rotation}°");
}

/// The Intel Research Lab, by the rule of the published figures. This bar is one of scan matching and of closing loops: a single particle holds it
/// too. With these settings seeds 1 to 3 gave 0.066, 0.065 and 0.068 m, and
/// 2.4° each; gmapping, run on the same log, 0.068 to 0.070 m. The bounds leave as much above the worst as lies between seeds.
#[test]
#[ignore = "breadth: a whole recorded log"]
fn three_runs_of_the_intel_log_err_by_75_millimetres_and_2_5_degrees_at_most() {
    let Some(file) = recorded("intel", [".clf", ".relations"]) else { return };
    for seed in 1..=3 {
        let run = json(&format!("log {file}.clf --particles 8 --seed {seed} --relations {file}.relations --json"));
        assert_eq!((&run["scans"], &run["relations"]), (&Value::from(910), &Value::from(2984)));
        let [translation, rotation] = ["translation_mean", "rotation_mean_deg"].map(|key| run[key].as_f64().unwrap());
        assert!(translation <= 0.075 && rotation <= 2.5, "seed {seed}: {translation} m, {rotation}°");
        // Maps of eight particles: 8.2 MB, of which those of before are 2.0 MB. gmapping's process takes 38 MB with sixteen.
        assert!(map_megabytes(&run) < 10.0, "seed {seed}: {} MB", map_megabytes(&run));
    }
}

/// What the maps of a run take at their peak, those of before included \[MB\].
fn map_megabytes(run: &Value) -> f64 {
    ["peak_map_bytes", "kept_map_bytes"].iter().map(|key| run[key].as_f64().unwrap()).sum::<f64>() / 1e6
}

/// Peak memory of the whole process, which writes the map as well, against that of gmapping's with as many particles. Found: 26, 34 and 212 MB; on the campus
/// 369 MB where the sizes of maps were counted by a list of all tiles of all directories, and the whole picture was copied into colours.
#[test]
#[ignore = "breadth: three whole recorded logs"]
fn the_process_takes_no_more_memory_than_gmapping_s() {
    for (log, megabytes) in
        [("intel.clf", 38.0), ("buildings/aces.clf.gz", 55.0), ("buildings/freiburg-campus.clf.gz", 233.0)]
    {
        let Some(file) = recorded(log, [""]) else { return };
        let folder = tempdir().unwrap();
        let map = folder.path().join("map").display().to_string();
        let run = json(&format!("log {file} --particles 16 --map {map} --json"));
        let Some(bytes) = run["peak_process_bytes"].as_f64() else { return };
        assert!(bytes < 1e6 * megabytes, "{log}: {} MB", bytes / 1e6);
        assert!(bytes > run["peak_map_bytes"].as_f64().unwrap(), "{log}: {bytes}");
    }
}

/// Why there is no `log --smooth`: on the Intel log the mean over the ancestry at the end is hardly better than the best particle's path. Before loops
/// were bent so finely, what is told at once was worse by 5 mm (16 particles, seeds 1 to 3: 70, 70 and 86 mm as it went, 64.6, 64.4 and 66.1 mm for the
/// record, 65.3, 65.0 and 67.4 mm for the best path). Now all three are the same to .3 mm (8 particles, seed 1: 66.4, 66.6, 66.6 mm).
#[test]
#[ignore = "breadth: a whole recorded log"]
fn the_record_of_the_intel_log_is_hardly_better_than_the_best_particle_s_path() {
    let Some(file) = recorded("intel", [".clf", ".relations"]) else { return };
    let bytes = |extension: &str| std::fs::read(format!("{file}{extension}")).unwrap();
    let log = std::sync::Arc::new(fastslam_log::parse(&bytes(".clf"), false).unwrap());
    let relations = fastslam_log::parse_relations(&bytes(".relations")).unwrap();
    let settings = LaserMapperSettings { particles: 8, ..LaserMapperSettings::default() };
    let mut replay = Replay::new(settings, std::sync::Arc::clone(&log)).unwrap();
    let paths = fixed_lag(Pose2::default(), &[0, u32::MAX], replay.by_ref());
    let best = replay.mapper().path();
    let error = |poses: &[Pose2]| {
        assert_eq!(poses.len(), best.len(), "the mapper takes every scan of this log");
        let path: Vec<(f64, Pose2)> = best.iter().zip(poses).map(|((time, _), pose)| (*time, *pose)).collect();
        fastslam_log::relation_errors(&path, &log.odometry, &relations).unwrap().translation_mean
    };
    let [went, record] = [&paths[0], &paths[1]].map(|path| error(path));
    let best = error(&best.iter().map(|(_, pose)| *pose).collect::<Vec<_>>());
    assert!(
        (record - best).abs() < 0.001 && went > best - 0.001,
        "as it went {went} m, the record {record} m, the best path {best} m"
    );
}

/// The path of a recorded building that the log comes with.
fn reference(prefix: &str) -> Vec<(f64, Pose2)> {
    poses(&std::fs::read_to_string(format!("{prefix}.reference")).unwrap(), |n| n[3])
}

/// The ACES building, whose loops are long and look alike. Since paths are bent where a loop is missed by some decimetres, one particle maps it as well as
/// sixteen: medians over seeds 1 to 5 were 0.127 m with one and 0.140 m with sixteen, of whose revisits 0.3 % were off by more than half a metre in one
/// seed. Before that they were 0.19 m, with two seeds of five that left places off, and 0.16 m.
#[test]
#[ignore = "breadth: a whole recorded log, ten times"]
fn the_aces_building_is_mapped_within_16_centimetres_by_one_particle_and_by_sixteen() {
    let Some(prefix) = recorded("buildings/aces", [".clf.gz", ".reference"]) else { return };
    let mut text = Vec::new();
    let file = std::fs::File::open(format!("{prefix}.clf.gz")).unwrap();
    std::io::Read::read_to_end(&mut flate2::read::GzDecoder::new(file), &mut text).unwrap();
    let log = std::sync::Arc::new(fastslam_log::parse(&text, false).unwrap());
    let truth: Vec<Pose2> = reference(&prefix).into_iter().map(|(_, pose)| pose).collect();
    let errors = |particles: usize| -> Vec<LoopErrors> {
        let errors = |seed: u64| {
            let settings = LaserMapperSettings { particles, seed, ..LaserMapperSettings::default() };
            let mut replay = Replay::new(settings, std::sync::Arc::clone(&log)).unwrap();
            replay.by_ref().for_each(drop);
            let path: Vec<Pose2> = replay.mapper().path().into_iter().map(|(_, pose)| pose).collect();
            LoopErrors::of(&path, &truth)
        };
        (1..=5).map(errors).collect()
    };
    let median = |errors: &[LoopErrors]| {
        let mut rms: Vec<f64> = errors.iter().map(|one| one.rms).collect();
        rms.sort_by(f64::total_cmp);
        rms[rms.len() / 2]
    };
    let (one, sixteen) = (errors(1), errors(16));
    println!("1 particle: {one:.3?}\n16 particles: {sixteen:.3?}");
    for errors in [one, sixteen] {
        assert!(median(&errors) <= 0.16 && errors.iter().all(|one| one.revisits_off < 0.01), "{errors:.3?}");
    }
}

/// A campus, outdoors, where often half of the beams or more meet nothing. With a prior of one width for all wheels, scans turned the map
/// by up to 47°, and runs ended 23 to 57 m off; gmapping's end 2.5 m off. In `npm test`, `a_laser_that_meets_little_does_not_turn_the_map` of
/// tests/laws is a shorter drive of the kind.
#[test]
#[ignore = "breadth: a whole recorded log"]
fn where_few_beams_return_the_wheels_that_were_learnt_keep_the_map_from_turning() {
    let Some(prefix) = recorded("buildings/freiburg-campus", [".clf.gz", ".reference"]) else { return };
    let reference = reference(&prefix);
    let folder = tempdir().unwrap();
    let file = folder.path().join("path.tum").display().to_string();
    let run = json(&format!("log {prefix}.clf.gz --particles 8 --seed 1 --trajectory {file} --json"));
    let path = poses(&std::fs::read_to_string(&file).unwrap(), |n| 2.0 * fastslam::ops::atan2(n[6], n[7]));
    assert!(path.iter().zip(&reference).all(|((at, _), (then, _))| (at - then).abs() < 1e-3));
    let [path, reference] = [path, reference].map(|path| path.into_iter().map(|(_, pose)| pose).collect::<Vec<_>>());
    let motion = align(&path, &reference);
    let error = rms(&path.iter().map(|pose| motion.compose(pose)).collect::<Vec<_>>(), &reference);
    // Three seeds, of odometry as it is, three times better and twice as bad, gave 0.26 to 0.47 m, this one 0.47 m.
    assert!(error < 1.0, "{error} m");
    // Each of the eleven paths that are bent has a map of its own. gmapping's process takes 233 MB, with sixteen particles.
    assert!(map_megabytes(&run) < 190.0, "{} MB", map_megabytes(&run));
    // Odometry was made with 3° a metre and without a drift.
    let [drift, std] = ["wheel_drift_deg_per_m", "wheel_heading_std_deg_per_m"].map(|key| run[key].as_f64().unwrap());
    assert!(drift.abs() < 1.0 && (2.0..4.0).contains(&std), "{drift} ± {std}°/m");
}
