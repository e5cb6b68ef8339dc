//! The command line as its users see it.

use assert_cmd::Command;
use fastslam::geometry::{Pose2, align, rms};
use fastslam::mapper::{LaserMapperSettings, Replay};
use fastslam_lab::experiment::log::{Example, Recipe};
use fastslam_lab::experiment::long_rings::{LongRingSetup, LoopErrors};
use fastslam_lab::experiment::looking_back::fixed_lag;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

#[path = "command_line/exports.rs"]
mod exports;
#[path = "command_line/recordings.rs"]
mod recordings;
#[path = "command_line/sessions.rs"]
mod sessions;

fn fastslam(arguments: &str) -> assert_cmd::assert::Assert {
    Command::new(env!("CARGO_BIN_EXE_fastslam")).args(arguments.split_whitespace()).assert()
}

/// What a command says besides its results, without how far it is, which a busy machine makes it tell.
fn noted(run: &assert_cmd::assert::Assert) -> String {
    let said = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    said.lines().filter(|line| !line.ends_with(" to go")).map(|line| format!("{line}\n")).collect()
}

fn json(arguments: &str) -> Value {
    serde_json::from_slice(&fastslam(arguments).success().get_output().stdout).unwrap()
}

#[test]
fn bad_arguments_are_refused_in_one_line_with_status_2() {
    for (arguments, said) in [
        ("", "a command is missing: log, example-log or landmarks (fastslam --help explains)"),
        ("logs", "logs"),
        ("landmarks --particles -1", "must be a whole number from 1 to 100000"),
        ("log x.clf --particles -1", "must be a whole number from 1 to 4096"),
        ("landmarks --proposal 3.0", "1.0 or 2.0"),
        ("landmarks --association guessed", "known or unknown"),
        ("landmarks --particles 0", "from 1 to 100000"),
        ("landmarks --particles 0 --seeds 2", "from 1 to 100000"),
        ("landmarks --course moon", "eight, tags or wings"),
        ("landmarks --seeds 0", "--seeds"),
        ("landmarks --drift maybe", "must be learnt or none"),
        ("landmarks --late 0,4", "the first from 1 to 1000"),
        ("landmarks --late 4", "two whole numbers"),
        ("log", "FILE"),
        ("log x.clf --particles many", "--particles"),
    ] {
        let refused = fastslam(arguments).code(2).stdout("");
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains(said) && message.trim_end().lines().count() == 1, "{arguments}: {message}");
    }
}

#[test]
fn landmarks_print_what_they_are_asked_for() {
    let one = json("landmarks --particles 5 --seed 2 --proposal 2.0 --association unknown --json");
    assert!(one["rms_best"].as_f64().unwrap() > 0.0 && one["rms_odometry"].as_f64() > one["rms_best"].as_f64());
    assert_eq!(one["steps"].as_array().unwrap().len(), 335);
    assert!(one["steps"][1]["log_evidence"].is_f64());
    let many = json("landmarks --course tags --particles 4 --proposal 1.0 --association known --seeds 3 --json");
    for judged in ["online", "ekf", "best", "best_aligned", "odometry"] {
        let [median, p90, worst] = ["median", "p90", "worst"].map(|key| many[judged][key].as_f64().unwrap());
        assert!(0.0 < median && median <= p90 && p90 <= worst, "{judged}");
    }
    fastslam("landmarks --particles 3").success();
    let late = json("landmarks --particles 5 --course tags --late 2,2 --seeds 2 --json");
    assert!(
        late["late"]["median"].as_f64().unwrap() > 0.0 && late["late"]["median"] != late["online"]["median"],
        "{late}"
    );
    let late = json("landmarks --particles 5 --course tags --late --json");
    assert!(late["rms_late"].as_f64().unwrap() > 0.0 && one["rms_late"].is_null(), "{late}");

    let folder = tempdir().unwrap();
    let path = folder.path().join("landmarks.png");
    fastslam(&format!("landmarks --particles 3 --png {}", path.display())).success();
    assert!(std::fs::read(&path).unwrap().starts_with(b"\x89PNG"));
}

/// Files of one small log, of which one is not what it should be.
fn small_log(replaced: &str, text: &str) -> TempDir {
    let folder = tempdir().unwrap();
    for (file, content) in [
        ("barcodes", "# comment\n  6 \t 63\n"),
        ("landmarks", "6 1.0 1.0 0.0 0.0\n"),
        ("robot1-odometry", "10.0 0.1 0.0\n10.5 0.1 0.1\n13.0 0.1 0.0\n"),
        ("robot1-measurement", "10.4 63 1.4 0.7\n11.9 5 2.0 0.1\n12.0 63 1.2 0.8\n"),
        ("robot1-groundtruth", "9.9 0 0 0\n13.1 0.3 0 0.1\n"),
    ] {
        let content = if file == replaced { text } else { content };
        std::fs::write(folder.path().join(format!("small-{file}.dat")), content).unwrap();
    }
    folder
}

#[test]
fn a_recorded_log_is_read_and_a_bad_line_of_it_named() {
    let folder = small_log("", "");
    for prefix in ["small", "small-", "small-robot1"] {
        let run = json(&format!("landmarks --particles 2 --json --mrclam {}", folder.path().join(prefix).display()));
        // 0.4 s, then 1.5 s in three steps, then 0.1 s.
        assert_eq!((run["steps"].as_array().unwrap().len(), &run["landmarks"]), (5, &1.into()));
    }
    // Of the bar codes one is another robot's. Who reads them passes it over, who does not takes it for a landmark like any other.
    let prefix = folder.path().join("small").display().to_string();
    for (association, landmarks) in [("known", 1), ("unknown", 2)] {
        let run = json(&format!("landmarks --particles 2 --association {association} --json --mrclam {prefix}"));
        let seen: u64 = run["steps"].as_array().unwrap().iter().map(|step| step["seen"].as_u64().unwrap()).sum();
        assert_eq!((seen, &run["landmarks"]), (3, &landmarks.into()), "{association}");
        assert!(run["noises"].as_str().unwrap().starts_with("calibrated on robot 1 of data set 6"));
    }

    // What is seen at the very start is seen from the pose that is known: by a step that takes no time.
    let early = small_log("robot1-measurement", "10.0 63 1.414 0.785\n");
    let run = json(&format!("landmarks --particles 2 --json --mrclam {}", early.path().join("small").display()));
    assert_eq!((run["steps"].as_array().unwrap().len(), &run["steps"][0]["seen"]), (1, &1.into()));
    assert_eq!((&run["landmarks"], &run["rms_online"]), (&1.into(), &0.0.into()));

    for (name, file, text, said) in [
        (
            "word",
            "robot1-odometry",
            "10.0 0.1 fast\n",
            "robot1-odometry.dat: line 1: expected 3 numbers: time [s], v [m/s]",
        ),
        ("short", "robot1-measurement", "# c\n10.4 63 1.4 0.7\n10.6 63\n", "line 3: expected 4 numbers"),
        ("nan", "robot1-groundtruth", "9.9 0 0 NaN\n", "line 1: expected 4 numbers"),
        ("empty", "barcodes", "# nothing\n\n", "barcodes.dat: no line with 2 numbers"),
        ("back", "robot1-odometry", "10.0 0 0\n9.0 0 0\n", "times go back: 9 after 10"),
        ("apart", "robot1-measurement", "99.0 63 1.4 0.7\n", "no measurement"),
        ("binary", "landmarks", "\0\u{1}\u{2}", "line 1: expected 5 numbers"),
    ] {
        let folder = small_log(file, text);
        let refused = fastslam(&format!("landmarks --mrclam {}", folder.path().join("small").display())).code(2);
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains(said) && message.trim_end().lines().count() == 1, "{name}: {message}");
    }
    fastslam("landmarks --mrclam no/such/log").code(1);
}

/// What is said in one line about arguments that are refused.
fn refusal(arguments: &str) -> String {
    let refused = fastslam(arguments).code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
    message
}

#[test]
fn settings_of_noise_are_options_and_lines_of_a_file() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("noise.toml");
    let run = |options: &str| json(&format!("landmarks --particles 3 --course tags --json {options}"));
    let text = "# of the wheels\nalphas = [0.1, 0, 0.01, 0.1]\nspeed-std = 0.2\nrange-std = 0.5\nbearing-std = 0.05\n";
    std::fs::write(&file, text).unwrap();
    let options = "--alphas 0.1,0,0.01,0.1 --speed-std 0.2 --range-std 0.5 --bearing-std 0.05";
    let (by_options, by_file) = (run(options), run(&format!("--settings {}", file.display())));
    assert_eq!(by_options, by_file);
    assert_eq!(by_options["noises"], "those of the course, and as set");
    assert_ne!(by_options["rms_best"], run("")["rms_best"]);
    // An option stands over the file.
    let over = run(&format!("--settings {} --range-std 0.1", file.display()));
    assert_eq!(over, run(&format!("{options} --range-std 0.1").replace("--range-std 0.5 ", "")));

    for (options, said) in [
        ("--range-std -1", "'--range-std <M>': must be a number from 0 to 1000 [m]"),
        ("--bearing-std NaN", "'--bearing-std <RAD>': must be a number from 0 to 10 [rad]"),
        ("--alphas 1,2,3", "'--alphas <A1,A2,A3,A4>': must be four numbers from 0 to 100, apart by commas"),
        ("--alphas -1,2,3,4", "must be four numbers from 0 to 100"),
        ("--alphas 1,2,3,x", "must be four numbers from 0 to 100"),
        ("--sighting-worth 1.5", "'--sighting-worth <N>': must be a whole number from 0 to 1000"),
        ("--sighting-worth 9 --most-count 3", "most-count = 3: must be at least sighting-worth = 9"),
        ("--steering-std 0.1", "steering-std: cannot be set of a course"),
    ] {
        let message = refusal(&format!("landmarks {options}"));
        assert!(message.contains(said), "{options}: {message}");
    }
    for (text, said) in [
        ("range-std = -1\n", "noise.toml: range-std = -1: must be a number from 0 to 1000 [m]"),
        ("alphas = [0, 0, 0, 1e9]\n", "noise.toml: alphas = 1000000000: must be a number from 0 to 100"),
        ("\nrange = 1\n", "noise.toml: line 2: unknown field `range`"),
        ("range-std = \"wide\"\n", "noise.toml: line 1: invalid type"),
        ("range-std 1\n", "noise.toml: line 1: "),
        ("alphas = [1, 2]\n", "noise.toml: line 1: "),
    ] {
        std::fs::write(&file, text).unwrap();
        let message = refusal(&format!("landmarks --settings {}", file.display()));
        assert!(message.contains(said), "{text}: {message}");
    }
    fastslam("landmarks --settings no/such/file.toml").code(1);
}

/// The simulated car as the files in which the log of Victoria Park is passed on: what its wheel and steering read, and where it truly was.
fn car_log(folder: &TempDir, steps: usize) -> String {
    use fastslam_lab::experiment::car::{self, WHEEL_ASIDE};
    let (log, base) = (car::simulate(1), car::tuning().motion.wheel_base);
    let (mut time, mut files) = (0.0, [String::new(), String::from("0,0,0\n"), String::new()]);
    for k in 0..steps {
        let control = log.controls[k];
        let tan = base * control.turn_rate / control.speed;
        let wheel = control.speed * (1.0 - tan * WHEEL_ASIDE / base);
        files[0] += &format!("{time},{wheel},{}\n", fastslam::ops::atan2(tan, 1.0));
        time += control.duration;
        files[1] += &format!("{time},{},{}\n", log.truth[k + 1].x, log.truth[k + 1].y);
        for seen in &log.sightings[k] {
            files[2] += &format!("{time} {} {} {}\n", seen.z.x, seen.z.y, seen.signature.unwrap());
        }
    }
    files[0] += &format!("{time},0,0\n");
    for (name, text) in ["DRS", "GPS", "SIGHTINGS"].into_iter().zip(files) {
        std::fs::write(folder.path().join(format!("{name}.txt")), text).unwrap();
    }
    folder.path().display().to_string()
}

#[test]
fn the_log_of_a_car_is_read_and_a_bad_line_of_it_named() {
    let folder = tempdir().unwrap();
    let log = car_log(&folder, 200);
    let run = json(&format!("landmarks --particles 20 --json --victoria {log}"));
    assert_eq!(run["steps"].as_array().unwrap().len(), 200);
    let [online, ekf, odometry] = ["rms_online", "rms_ekf", "rms_odometry"].map(|key| run[key].as_f64().unwrap());
    // GPS gives the heading of the start to some degrees.
    assert!(online < 1.5 * ekf + 1.0 && ekf < 10.0, "{online} {ekf} {odometry}");
    let wide = json(&format!("landmarks --particles 2 --json --steering-std 0.2 --victoria {log}"));
    assert!(wide["noises"].as_str().unwrap().ends_with("and as set"));
    assert!(
        refusal(&format!("landmarks --alphas 0,0,0,0 --victoria {log}")).contains("alphas: cannot be set of a car")
    );

    for (file, text, said) in [
        ("SIGHTINGS", "1 2 0.1 1.5\n", "must be above 0, and a whole number from 0 to 99999"),
        ("SIGHTINGS", "1 -2 0.1 1\n", "range -2, tree 1"),
        ("SIGHTINGS", "999 2 0.1 1\n", "nothing is seen in the time of both"),
        ("DRS", "0,1,9\n", "DRS.txt: time 0: steering angle 9: must be from -1.5 to 1.5 [rad]"),
        ("DRS", "0,1\n", "DRS.txt: line 1: expected 3 numbers"),
        ("GPS", "0,0,0\n1,1,0\n", "GPS.txt: never 3 m from its start"),
    ] {
        let path = folder.path().join(format!("{file}.txt"));
        let kept = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text).unwrap();
        let message = refusal(&format!("landmarks --victoria {log}"));
        assert!(message.contains(said), "{text}: {message}");
        std::fs::write(&path, kept).unwrap();
    }
    // Of a laser's scans: two trunks, and nobody says which.
    std::fs::remove_file(folder.path().join("SIGHTINGS.txt")).unwrap();
    assert!(refusal(&format!("landmarks --victoria {log}")).contains("--association unknown"));
    let scan: Vec<&str> = (0..361).map(|k| if (100..104).contains(&k) || k == 240 { "9.5" } else { "81.9" }).collect();
    std::fs::write(folder.path().join("LASER.txt"), format!("0.5,{}\n", scan.join(","))).unwrap();
    let run = json(&format!("landmarks --particles 2 --association unknown --json --victoria {log}"));
    assert_eq!((&run["steps"][0]["seen"], &run["landmarks"]), (&2.into(), &2.into()));
    std::fs::write(folder.path().join("LASER.txt"), "0.5,1,2\n").unwrap();
    assert!(
        refusal(&format!("landmarks --association unknown --victoria {log}")).contains("line 1: expected 362 numbers")
    );
}

#[test]
fn a_landmark_graph_is_read_and_a_bad_line_of_it_named() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("graph.g2o");
    let run = |text: &str| {
        std::fs::write(&file, text).unwrap();
        format!("landmarks --particles 5 --g2o {}", file.display())
    };
    // Ids of landmarks lie between those of poses.
    let graph = "# a graph\nVERTEX_SE2 0 0 0 0\nVERTEX_XY 1 2 1\nVERTEX_SE2 2 1 0 0\nVERTEX_SE2 5 2 0 0\nFIX 0\n\
        EDGE_SE2 0 2 1.1 0 0 100 0 0 100 0 400\nEDGE_SE2 2 5 1 0 0 100 0 0 100 0 400\nEDGE_SE2 0 5 2 0 0 1 0 0 1 0 1\n\
        EDGE_SE2_XY 2 1 1 1 100 0 100\nEDGE_SE2_XY 5 1 0 1 100 0 100\n";
    let output = json(&format!("{} --json", run(graph)));
    assert_eq!((output["steps"].as_array().unwrap().len(), &output["landmarks"]), (2, &1.into()));
    assert!((output["rms_odometry"].as_f64().unwrap() - (0.02_f64 / 3.0).sqrt()).abs() < 1e-9);
    assert!(output["drift"][0].is_f64(), "the drift of a graph's odometry is learnt");
    assert_eq!(json(&format!("{} --drift none --json", run(graph)))["drift"], Value::Null);
    assert!(refusal(&format!("{} --speed-std 1", run(graph))).contains("speed-std: cannot be set of a graph"));
    // An edge that leads back, a landmark that is named first, and what says nothing of motion.
    let turned = graph
        .replace("EDGE_SE2 2 5 1 0 0", "EDGE_SE2 5 2 -1 0 0")
        .replace("EDGE_SE2_XY 2 1", "EDGE_SE2_XY 1 2")
        .replace("FIX 0", "FIX 0\nPARAMS_SE2OFFSET 0 0 0 0\nEDGE_PRIOR_SE2 0 0 0 0 1 0 0 1 0 1");
    let again = json(&format!("{} --json", run(&turned)));
    assert_eq!((&again["rms_odometry"], &again["landmarks"]), (&output["rms_odometry"], &output["landmarks"]));
    // A landmark that is seen from the first pose alone: there is a step more, in which the robot stands.
    let early = format!("{graph}VERTEX_XY 3 -1 1\nEDGE_SE2_XY 0 3 -1 1 100 0 100\nEDGE_SE2_XY 0 1 2 1 100 0 100\n");
    let output = json(&format!("{} --json", run(&early)));
    assert_eq!((output["steps"].as_array().unwrap().len(), &output["landmarks"]), (3, &2.into()));
    assert_eq!((&output["steps"][0]["seen"], &output["steps"][0]["error_mean"]), (&2.into(), &0.0.into()));
    for (old, new, said) in [
        ("VERTEX_XY 1 2 1", "VERTEX_XYZ 1 2 1", "line 3: VERTEX_XYZ: must be VERTEX_SE2"),
        ("VERTEX_XY 1 2 1", "VERTEX_XY 0 2 1", "line 3: vertex 0 is there already"),
        ("VERTEX_XY 1 2 1", "VERTEX_XY 1 2", "line 3: VERTEX_XY needs 1 ids and 2 numbers, not 2 words"),
        ("VERTEX_XY 1 2 1", "VERTEX_XY 1 2 inf", "line 3: VERTEX_XY needs 2 finite numbers"),
        ("VERTEX_XY 1 2 1", "VERTEX_XY -1 2 1", "line 3: an id must be a whole number from 0"),
        ("EDGE_SE2 2 5", "EDGE_SE2 5 0", "no EDGE_SE2 leads from vertex 2 to 5"),
        ("VERTEX_XY 1 2 1", "VERTEX_SE3:QUAT 1 2 1", "line 3: VERTEX_SE3:QUAT: must be VERTEX_SE2, VERTEX_XY"),
        ("VERTEX_XY 1 2 1", "VERTEX_SE3:QUAT 1 2 1", "only graphs in the plane can be read"),
        ("EDGE_SE2_XY 2 1", "EDGE_SE2_XY 2 9", "line 10: no VERTEX_XY has the id 9"),
        ("EDGE_SE2_XY 2 1", "EDGE_SE2_XY 1 1", "line 10: no VERTEX_SE2 has the id 1"),
        ("2 1 1 1 100 0 100", "2 1 1 1 0 0 100", "line 10: the information matrix must be positive definite"),
        ("2 1 1 1 100 0 100", "2 1 0 0 100 0 100", "line 10: a landmark at the robot's own place"),
    ] {
        let message = refusal(&run(&graph.replacen(old, new, 1)));
        assert!(message.contains(said), "{new}: {message}");
    }
    assert!(refusal(&run("# nothing\n")).contains("needs two poses"));
}

/// Where a log of shared/data is, which may not be shipped. Where one of its files is absent `npm test` counts the test as skipped, by
/// the line that this prints.
fn recorded(name: &str, files: [&str; 2]) -> Option<String> {
    shared("data", name, files)
}

/// The same of one of the folders of shared.
fn shared(of: &str, name: &str, files: [&str; 2]) -> Option<String> {
    let prefix = format!("{}/../../../../shared/{of}/{name}", env!("CARGO_MANIFEST_DIR"));
    match files.iter().find(|file| !std::path::Path::new(&format!("{prefix}{file}")).exists()) {
        Some(file) => println!("skipped: {name}{file} is not in ../shared/{of}"),
        None => return Some(prefix),
    }
    None
}

/// The positions of a TUM file, seen from the first pose.
fn positions(path: &str) -> Vec<[f64; 2]> {
    let text = std::fs::read_to_string(path).unwrap();
    let numbers = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = text.lines().filter(|line| !line.starts_with('#')).map(numbers).collect();
    let (sin, cos) = fastslam::ops::sin_cos(2.0 * fastslam::ops::atan2(rows[0][6], rows[0][7]));
    let seen = |row: &Vec<f64>| {
        let [x, y] = [row[1] - rows[0][1], row[2] - rows[0][2]];
        [cos * x + sin * y, cos * y - sin * x]
    };
    rows.iter().map(seen).collect()
}

/// One drive, spoiled in ways that owners of robots have reported: the path is that of the drive as it was, pose by pose in the order of
/// recording, and what was made of the log is said.
#[test]
fn a_spoiled_drive_is_mapped_as_it_was_driven() {
    let still = "the odometry never moves: it is taken for none, and each scan is matched with those before";
    let folder = tempdir().unwrap();
    for (file, said) in [
        ("base/base.mcap.gz", ""),
        ("clock-set-back/clock-set-back.mcap.gz", "the clock was set back by 10.1 s after "),
        ("no-wheels/static-transform.mcap.gz", still),
        ("no-wheels/repeated-transform.mcap.gz", still),
        ("no-wheels/zero-odometry.mcap.gz", still),
        ("beams-vary/robotlaser1.clf.gz", ""),
        (
            "odometry-starts-anew/reset.mcap.gz",
            "contradict odometry: 1, the first at 1029.600 s (10.17 m and 132° in 0.4 s)",
        ),
    ] {
        let truth = format!("{}/truth.tum", file.split_once('/').unwrap().0);
        let Some(cases) = shared("cases", "", [file, &truth]) else { return };
        let path = folder.path().join("path.tum").display().to_string();
        let run = fastslam(&format!("log {cases}{file} --particles 8 --trajectory {path} --json")).success();
        let noted = noted(&run);
        assert!(noted.contains(said) && (!said.is_empty() || noted.is_empty()), "{file}: {noted}");
        let [found, truth] = [path, format!("{cases}{truth}")].map(|path| positions(&path));
        assert_eq!(found.len(), truth.len(), "{file}");
        let error = |(a, b): (&[f64; 2], &[f64; 2])| fastslam::ops::hypot(a[0] - b[0], a[1] - b[1]);
        let squares: f64 = found.iter().zip(&truth).map(error).map(|error| error * error).sum();
        let rms = (squares / found.len() as f64).sqrt();
        // Seen from the first pose, whose heading is off by 0.3° where each scan has another number of beams; aligned, that path is 8 mm off as the others are.
        let bar = if file.starts_with("beams-vary") { 0.04 } else { 0.03 };
        assert!(rms < bar, "{file}: {rms} m");
    }
}

/// A loop of 240 m that two particles leave open: the fifth of the rings of tests/laws.
#[test]
fn a_map_that_contradicts_itself_ends_with_exit_status_3() {
    let folder = tempdir().unwrap();
    let [log, map] = ["ring.clf", "ring"].map(|name| folder.path().join(name).display().to_string());
    let recipe = LongRingSetup { length: 120, seed: 73, ..LongRingSetup::default() }.recipe();
    std::fs::write(&log, fastslam_log::write(&Example::of(&recipe, usize::MAX).log)).unwrap();
    let run = fastslam(&format!("log {log} --particles 1 --seed 73 --map {map} --json")).code(3);
    let output = run.get_output();
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(said.contains("loops that stay open: 1, the last of them at "), "{said}");
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(told["loops_open"], 1);
    let open = told["loops"].as_array().unwrap().iter().find(|one| one["end"] == "open").unwrap();
    assert!(open["disputed"].as_f64().unwrap() > 0.25 && open["from"].as_f64() < open["to"].as_f64(), "{open}");
    // A ring round the place, in a colour that is nowhere else.
    let mut png = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(format!("{map}.png")).unwrap()));
    png.set_transformations(png::Transformations::IDENTITY);
    let mut reader = png.read_info().unwrap();
    let mut picture = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut picture).unwrap();
    assert!(picture.chunks(3).filter(|pixel| *pixel == [220, 0, 160]).count() > 100);
}

/// Scans and odometry that contradict each other throughout: the cause is named, odometry taken for none, and the exit status says whether the map may be
/// wrong. Which of the two a mirror image is of cannot be known.
#[test]
fn what_is_wrong_throughout_is_named_and_ends_with_its_exit_status() {
    let folder = tempdir().unwrap();
    let [file, path] = ["log.clf", "path.tum"].map(|name| folder.path().join(name).display().to_string());
    let Example { log, truth, .. } = Example::of(&Recipe { scatter: 0.3, ..Recipe::building() }, 160);
    type Spoil = fn(&Pose2) -> Pose2;
    let kinds: [(Spoil, u8, &str); 3] = [
        (Pose2::clone, 0, ""),
        (|pose| Pose2::new(100.0 * pose.x, 100.0 * pose.y, pose.theta), 0, "the robot drives 0.0"),
        (|pose| Pose2::new(pose.x, -pose.y, -pose.theta), 3, "the robot turns to the other side"),
    ];
    for (spoil, status, said) in kinds {
        let mut log = log.clone();
        for scan in &mut log.scans {
            scan.odometry = spoil(&scan.odometry);
        }
        std::fs::write(&file, fastslam_log::write(&log)).unwrap();
        let run = fastslam(&format!("log {file} --particles 2 --trajectory {path} --json")).code(i32::from(status));
        let output = run.get_output();
        let noted = noted(&run);
        assert!(noted.contains(said) && noted.is_empty() == said.is_empty(), "{noted}");
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(told["odometry_fault"].is_null(), said.is_empty(), "{told}");
        let found: Vec<Pose2> = positions(&path).iter().map(|[x, y]| Pose2::new(*x, *y, 0.0)).collect();
        let motion = align(&found, &truth);
        let error = rms(&found.iter().map(|pose| motion.compose(pose)).collect::<Vec<_>>(), &truth);
        assert!(error < 0.06, "{said}: {error} m");
    }
}

/// A laser of 2 m in a hall: by default a beam that meets nothing says nothing, and a third of the ground within a metre of the robot's way stays unknown.
#[test]
fn beams_that_meet_nothing_clear_the_way_if_asked() {
    let file = "nothing-in-reach/inf.mcap.gz";
    let Some(cases) = shared("cases", "", [file, file]) else { return };
    let folder = tempdir().unwrap();
    let [map, path] = ["map", "path.tum"].map(|name| folder.path().join(name).display().to_string());
    let unknown = |option: &str| {
        let run = format!("log {cases}{file} --particles 2 --map {map} --trajectory {path} {option}");
        fastslam(&run).success();
        let pgm = std::fs::read(format!("{map}.pgm")).unwrap();
        let yaml = std::fs::read_to_string(format!("{map}.yaml")).unwrap();
        let header = pgm.iter().enumerate().filter(|(_, byte)| **byte == b'\n').nth(2).unwrap().0;
        let size: Vec<usize> = std::str::from_utf8(&pgm[..header])
            .unwrap()
            .split_whitespace()
            .skip(1)
            .map(|word| word.parse().unwrap())
            .collect();
        let (pixels, [width, height]) = (&pgm[header + 1..], [size[0], size[1]]);
        let origin = yaml.split(['[', ']']).nth(1).unwrap();
        let origin: Vec<f64> = origin.split(',').map(|number| number.trim().parse().unwrap()).collect();
        let way: Vec<[f64; 2]> =
            poses(&std::fs::read_to_string(&path).unwrap(), |_| 0.0).iter().map(|(_, pose)| [pose.x, pose.y]).collect();
        let near = (0..width * height).filter(|k| {
            let x = origin[0] + 0.05 * ((k % width) as f64 + 0.5);
            let y = origin[1] + 0.05 * ((height - 1 - k / width) as f64 + 0.5);
            way.iter().any(|at| fastslam::ops::hypot(at[0] - x, at[1] - y) < 1.0)
        });
        let near: Vec<u8> = near.map(|k| pixels[k]).collect();
        near.iter().filter(|pixel| **pixel == 205).count() as f64 / near.len() as f64
    };
    let [before, after] = ["", "--clear-range 2"].map(unknown);
    assert!(before > 0.2 && after < 0.02, "unknown: {before}, with --clear-range {after}");
}

#[test]
fn millimetres_are_told() {
    let file = "millimetres/range-max-in-metres.jsonl.gz";
    let Some(cases) = shared("cases", "", [file, file]) else { return };
    let refused = fastslam(&format!("log {cases}{file}")).code(2);
    let said = String::from_utf8(refused.get_output().stderr.clone()).unwrap();
    assert!(
        said.contains("readings is a range: a finite number above 0 and up to range_max")
            && said.contains("are they in metres?"),
        "{said}"
    );
}

#[test]
fn the_recorded_log_is_far_better_than_its_odometry() {
    let Some(prefix) = recorded("mrclam6", ["-landmarks.dat", "-robot1-odometry.dat"]) else { return };
    for arguments in ["--proposal 1.0 --association known", "--proposal 2.0 --association unknown"] {
        let run = json(&format!("landmarks --particles 30 --seed 1 --json {arguments} --mrclam {prefix}"));
        let [best, odometry] = ["rms_best", "rms_odometry"].map(|key| run[key].as_f64().unwrap());
        assert!(best < 0.5 * odometry, "{arguments}: {best} against {odometry}");
    }
}

/// Without bar codes the median of five seeds is at most half more than what the joint filter errs by. Found: 0.9 of it, for both versions.
#[test]
fn without_bar_codes_the_recorded_log_is_followed_nearly_as_by_the_joint_filter() {
    let Some(prefix) = recorded("mrclam6", ["-landmarks.dat", "-robot1-odometry.dat"]) else { return };
    for version in ["1.0", "2.0"] {
        let runs = json(&format!(
            "landmarks --particles 100 --proposal {version} --association unknown --seeds 5 --json --mrclam {prefix}"
        ));
        let [online, joint] = ["online", "ekf"].map(|key| runs[key]["median"].as_f64().unwrap());
        assert!(online <= 1.5 * joint, "{version}: {online} against {joint}");
        assert_eq!((&runs["remarks"], &runs["drift"]), (&Value::Array(Vec::new()), &Value::Null));
    }
}

/// Remarks stand on standard error and in JSON; the exit status stays 0.
#[test]
fn noises_that_are_contradicted_and_landmarks_that_vanish_are_told() {
    let told = |options: &str| {
        let run = fastslam(&format!("landmarks --particles 20 --json {options}")).success();
        let said = String::from_utf8(run.get_output().stderr.clone()).unwrap();
        let output: Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
        let remarks: Vec<&str> =
            output["remarks"].as_array().unwrap().iter().map(|one| one.as_str().unwrap()).collect();
        assert_eq!(said, remarks.iter().map(|one| format!("fastslam: {one}\n")).collect::<String>());
        said
    };
    for silent in ["", "--association unknown", "--course tags", "--course tags --seeds 3", "--drift learnt"] {
        assert_eq!(told(silent), "", "{silent}");
    }
    let sharp = told("--range-std 0.005 --bearing-std 0.001");
    assert!(sharp.contains("contradicts the noises that were told") && sharp.contains("--alphas"), "{sharp}");
    assert!(told("--seeds 3 --range-std 0.005 --bearing-std 0.001").contains("contradicts"));
    assert!(told("--range-std 1 --bearing-std 0.2").contains("agrees far better than the noises that were told"));
    // Every landmark up to 50 m all around should be seen, and a sensor that sees 6 m ahead does not.
    let few = told("--association unknown --max-range 50 --field-of-view 6.28");
    assert!(few.contains("of the 24 landmarks that were seen are left in the best map"), "{few}");
}

/// The first scans of the example log.
fn short_log(folder: &TempDir, scans: usize) -> String {
    let [log, relations] =
        ["example.clf", "example.relations"].map(|name| folder.path().join(name).display().to_string());
    fastslam(&format!("example-log {log} --relations {relations}")).success();
    let text = std::fs::read_to_string(&log).unwrap();
    std::fs::write(&log, text.lines().take(scans + 1).map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    log
}

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

/// A path in the format of TUM or of a reference: a time \[s\] and a pose a line, whose heading is found in its numbers by `heading`.
fn poses(text: &str, heading: fn(&[f64]) -> f64) -> Vec<(f64, Pose2)> {
    let numbers = text.lines().map(|line| line.split_whitespace().map(|word| word.parse().unwrap()).collect());
    numbers.map(|n: Vec<f64>| (n[0], Pose2::new(n[1], n[2], heading(&n)))).collect()
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

/// A file of tests/bags.
fn bag(name: &str) -> String {
    format!("{}/../../../tests/bags/{name}", env!("CARGO_MANIFEST_DIR"))
}

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

#[test]
fn the_example_that_the_page_ships_is_the_one_that_is_written() {
    let folder = tempdir().unwrap();
    let log = folder.path().join("example.clf").display().to_string();
    fastslam(&format!("example-log {log}")).success();
    let shipped = include_bytes!("../../../../www/public/example.clf.gz");
    let mut text = String::new();
    std::io::Read::read_to_string(&mut flate2::read::GzDecoder::new(&shipped[..]), &mut text).unwrap();
    assert!(text == std::fs::read_to_string(&log).unwrap(), "write it again: fastslam example-log, gzip -9n");
}
