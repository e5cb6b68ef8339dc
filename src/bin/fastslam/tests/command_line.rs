//! The command line as its users see it.

use assert_cmd::Command;
use serde_json::Value;

fn fastslam(arguments: &str) -> assert_cmd::assert::Assert {
    Command::new(env!("CARGO_BIN_EXE_fastslam")).args(arguments.split_whitespace()).assert()
}

fn json(arguments: &str) -> Value {
    serde_json::from_slice(&fastslam(arguments).success().get_output().stdout).unwrap()
}

#[test]
fn a_lap_reports_every_step() {
    let lap = json("lap --particles 5 --seed 3 --proposal motion --matcher cell --policy always --json");
    let steps = lap["steps"].as_array().unwrap();
    assert_eq!(steps.len(), 91);
    assert_eq!(lap["rms_best"], steps[90]["rms_best"]);
    assert_eq!(lap["rms_odometry"], steps[90]["rms_odometry"]);
    assert_eq!(lap["digest"].as_str().unwrap().len(), 16);
    for step in &steps[1..] {
        assert_eq!(step["weights"].as_array().unwrap().len(), 5);
        assert_eq!(step["ancestors"].as_array().unwrap().len(), 5, "policy always resamples every step");
    }
}

#[test]
fn the_number_of_threads_does_not_change_a_lap() {
    let digest = |threads: u32| json(&format!("lap --particles 6 --json --threads {threads}"))["digest"].clone();
    assert_eq!(digest(1), digest(3));
}

#[test]
fn a_lap_is_painted_into_a_file() {
    let path = std::env::temp_dir().join(format!("fastslam-lap-{}.png", std::process::id()));
    fastslam(&format!("lap --particles 3 --png {}", path.display())).success();
    let png = std::fs::read(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let info = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap().info().size();
    assert_eq!(info.0, 1280);
}

#[test]
fn shards_merge_to_the_rows_of_one_run() {
    let folder = std::env::temp_dir().join(format!("fastslam-shards-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let files: Vec<String> = (1..=3)
        .map(|index| {
            let path = folder.join(format!("{index}.json"));
            let share = fastslam(&format!("table --seeds 2 --matcher cell --shard {index}/3 --json")).success();
            std::fs::write(&path, &share.get_output().stdout).unwrap();
            path.display().to_string()
        })
        .collect();
    let merged = json(&format!("table --json --merge {}", files.join(" ")));
    let whole = json("table --seeds 2 --matcher cell --json");
    fastslam(&format!("table --merge {} {}", files[0], files[1]))
        .code(1)
        .stderr("fastslam: --merge: shares missing: 3/3\n");
    std::fs::remove_dir_all(&folder).unwrap();

    assert_eq!(merged, whole);
    let rows = whole.as_array().unwrap();
    assert_eq!(rows.len(), 10, "two proposals, five M");
    for key in [
        "proposal",
        "matcher",
        "particles",
        "seeds",
        "rms_median",
        "rms_p90",
        "rms_worst",
        "odometry_rms_median",
        "resampled_fraction",
        "lineage_one_step_median",
    ] {
        assert!(rows.iter().all(|row| row.get(key).is_some()), "{key}");
    }
}

#[test]
fn bad_arguments_are_refused_in_one_line_with_status_2() {
    for (arguments, said) in [
        ("", "lap or table"),
        ("laps", "laps"),
        ("lap --particles 0", "from 1 to 4096"),
        ("lap --particles 1e9", "--particles"),
        ("lap --policy neff:2", "F from 0 to 1"),
        ("lap --proposal best", "aware or motion"),
        ("lap --matcher bilinear", "cell or subcell"),
        ("lap --scheme lottery", "systematic, stratified, multinomial or residual"),
        ("lap --odometry -1", "from 0 to 10"),
        ("lap --odometry NaN", "from 0 to 10"),
        ("lap --range-std 7", "from 0 to 1"),
        ("lap --particles 300 --png x.png", "universes"),
        ("lap --bogus", "--bogus"),
        ("table --seeds 0", "--seeds"),
        ("table --shard 4/3 --json", "I from 1 to N"),
        ("table --shard 1/3", "--json"),
    ] {
        let refused = fastslam(arguments).code(2).stdout("");
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains(said) && message.trim_end().lines().count() == 1, "{arguments}: {message}");
    }
}

#[test]
fn files_that_cannot_be_used_are_named() {
    for arguments in ["table --merge no/such/file", "lap --particles 1 --png no/such/folder/lap.png"] {
        let failed = fastslam(arguments).code(1);
        assert!(String::from_utf8_lossy(&failed.get_output().stderr).starts_with("fastslam: no/such/"));
    }
}
