//! The laboratory's command line as its users see it.

use assert_cmd::Command;
use fastslam_widgets::registry;
use serde_json::Value;
use tempfile::tempdir;

fn fastslam(arguments: &str) -> assert_cmd::assert::Assert {
    Command::new(env!("CARGO_BIN_EXE_fastslam-lab")).args(arguments.split_whitespace()).assert()
}

fn json(arguments: &str) -> Value {
    serde_json::from_slice(&fastslam(arguments).success().get_output().stdout).unwrap()
}

#[test]
fn bad_arguments_are_refused_in_one_line_with_status_2() {
    for (arguments, said) in [
        (
            "",
            "doors, joint, lap, numbers, policies, ring, rings, smoothing, table or variants (fastslam-lab --help explains)",
        ),
        ("laps", "laps"),
        ("lap --particles 0", "from 1 to 4096"),
        ("lap --particles 1e9", "--particles"),
        ("lap --particles -1", "'--particles <M>': must be a whole number from 1 to 4096"),
        ("lap --particles 1.5", "must be a whole number from 1 to 4096"),
        ("lap --policy neff:2", "F from 0 to 1"),
        ("lap --proposal best", "aware or motion"),
        ("lap --matcher bilinear", "cell or subcell"),
        ("lap --scheme lottery", "systematic, stratified, multinomial or residual"),
        ("lap --odometry -1", "from 0 to 10"),
        ("lap --odometry NaN", "from 0 to 10"),
        ("lap --range-std 7", "from 0 to 1"),
        ("lap --particles 300 --png x.png", "universes"),
        ("lap --course moon", "apartment, ring or rooms"),
        ("lap --bogus", "--bogus"),
        ("lap --method magic", "particles, graph"),
        ("lap --method graph --repair magic", "squares, robust, switchable, mixture"),
        ("lap --repair robust", "need --method graph"),
        ("lap --method graph --png x.png", "not with --method graph"),
        ("policies --course moon", "lap or wings"),
        ("policies --seeds 0", "--seeds"),
        ("policies --particles 0", "from 1 to 4096"),
        ("policies --threshold -0.5", "from 0 to 1"),
        ("policies --scheme lottery", "systematic, stratified, multinomial or residual"),
        ("joint --particles 0", "from 1 to 20000"),
        ("joint --sensor 0", "from 0.1 to 10"),
        ("joint --odometry -1", "from 0 to 3"),
        ("doors --seeds 0", "--seeds"),
        ("doors --ride-std -1", "from 0 to 20"),
        ("doors --policy neff:2", "F from 0 to 1"),
        ("doors --shard 1/3", "--json"),
        ("ring --niches 3", "from 0 to 2"),
        ("ring --rooms --niches 1", "cannot be used with"),
        ("ring --max-range 0", "from 0.5 to 20"),
        ("ring --particles 0", "from 1 to 4096"),
        ("ring --shared-streams", "--price-noise"),
        ("rings --length 39", "'--length <METRES>': must be a whole number from 40 to 480"),
        ("rings --length -1", "must be a whole number from 40 to 480"),
        ("rings --length round", "must be a whole number from 40 to 480"),
        ("rings --particles 0", "from 1 to 4096"),
        ("rings --seeds 0", "--seeds"),
        ("smoothing --particles 1", "from 2 to 64"),
        ("smoothing --odometry 4", "from 0.25 to 3"),
        ("smoothing --sensor -1", "from 0.25 to 2"),
        ("smoothing --sweeps 25", "1..=24"),
        ("table --seeds 0", "--seeds"),
        ("table --shard 4/3 --json", "I from 1 to N"),
        ("table --shard 1/3", "--json"),
        ("table --method magic", "particles, graph"),
        ("table --method graph --shard 1/3 --json", "not with --method graph"),
        ("variants --seeds 0", "--seeds"),
        ("variants --particles 0", "from 1 to 4096"),
        ("variants --only moon", "people"),
    ] {
        let refused = fastslam(arguments).code(2).stdout("");
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains(said) && message.trim_end().lines().count() == 1, "{arguments}: {message}");
    }
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
        assert!(step["log_evidence"].is_f64());
        assert_eq!(step["ancestors"].as_array().unwrap().len(), 5, "policy always resamples every step");
    }
}

#[test]
fn the_number_of_threads_does_not_change_a_lap() {
    let digest = |threads: u32| json(&format!("lap --particles 6 --json --threads {threads}"))["digest"].clone();
    assert_eq!(digest(1), digest(3));
}

/// The graph of a lap goes into a file in the format of g2o and comes back, and its optimum is the same.
#[test]
fn a_lap_is_a_graph_too_and_a_bad_line_of_one_is_named() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("ring.g2o");
    let file = path.display();
    let lap = json(&format!("lap --method graph --course ring --seed 3 --g2o {file} --json"));
    let number = |value: &Value, key: &str| value[key].as_f64().unwrap();
    assert_eq!(
        [number(&lap, "poses"), number(&lap, "odometry_edges"), number(&lap, "match_edges")],
        [111.0, 110.0, 110.0]
    );
    assert!(lap["after"]["rms"].as_f64() < lap["before"]["rms"].as_f64() && number(&lap, "loop_edges") > 10.0);
    let read = json(&format!("lap --method graph --from-g2o {file} --json"));
    assert_eq!((&read["path"], &read["cost_after"], &read["before"]), (&lap["path"], &lap["cost_after"], &Value::Null));
    let mended = json(&format!("lap --method graph --repair switchable --from-g2o {file} --json"));
    assert!(number(&mended, "cost_after") <= number(&read, "cost_after") + 1e-6);
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replacen("EDGE_SE2 1 2", "EDGE_SE2 1 two", 1)).unwrap();
    let refused = fastslam(&format!("lap --method graph --from-g2o {file}")).code(2).stdout("");
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("ring.g2o: line ") && message.contains("two: must be an id"), "{message}");
    std::fs::write(&path, "# nothing\n").unwrap();
    let refused = fastslam(&format!("lap --method graph --from-g2o {file}")).code(2);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("no VERTEX_SE2 in it"));
    let shown = fastslam("lap --method graph --seed 3").success();
    assert!(String::from_utf8_lossy(&shown.get_output().stdout).contains("a graph of 91 poses: 90 odometry edges"));
}

#[test]
fn the_table_has_the_graphs_of_the_same_laps() {
    let rows = json("table --method graph --seeds 3 --json");
    let mut errors: Vec<f64> = (1..=3)
        .map(|seed| json(&format!("lap --method graph --seed {seed} --json"))["after"]["rms"].as_f64().unwrap())
        .collect();
    errors.sort_by(f64::total_cmp);
    assert_eq!((rows[0]["seeds"].as_u64(), rows[0]["matcher"].as_str()), (Some(3), Some("subcell")));
    assert_eq!([&rows[0]["rms_median"], &rows[0]["rms_worst"]].map(|x| x.as_f64().unwrap()), [errors[1], errors[2]]);
    assert!(rows[0]["rms_before_median"].as_f64() < rows[0]["odometry_rms_median"].as_f64());
    let shown =
        fastslam("table --method graph --seeds 2 --matcher both --course ring").success().get_output().stdout.clone();
    assert_eq!(String::from_utf8(shown).unwrap().lines().count(), 4);
}

#[test]
fn a_lap_is_painted_into_a_file() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("lap.png");
    let pictures = ["apartment", "ring"].map(|course| {
        fastslam(&format!("lap --course {course} --particles 3 --png {}", path.display())).success();
        std::fs::read(&path).unwrap()
    });
    assert_ne!(pictures[0], pictures[1]);
    for png in pictures {
        let info = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap().info().size();
        assert_eq!(info.0, 1280);
    }
}

#[test]
fn shards_merge_to_the_rows_of_one_run() {
    let folder = tempdir().unwrap();
    let files: Vec<String> = (1..=3)
        .map(|index| {
            let path = folder.path().join(format!("{index}.json"));
            let share = fastslam(&format!("table --seeds 2 --matcher cell --shard {index}/3 --json")).success();
            std::fs::write(&path, &share.get_output().stdout).unwrap();
            path.display().to_string()
        })
        .collect();
    let merged = json(&format!("table --json --merge {}", files.join(" ")));
    let whole = json("table --seeds 2 --matcher cell --json");
    fastslam(&format!("table --merge {} {}", files[0], files[1]))
        .code(1)
        .stderr("fastslam-lab: --merge: shares missing: 3/3\n");

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
fn shares_of_the_doors_merge_to_the_rows_of_one_run_and_to_nothing_with_those_of_another() {
    let folder = tempdir().unwrap();
    let share = |name: &str, arguments: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, &fastslam(&format!("doors {arguments} --json")).success().get_output().stdout).unwrap();
        path.display().to_string()
    };
    let [one, two] = [1, 2].map(|index| share(&index.to_string(), &format!("--seeds 6 --shard {index}/2")));
    let whole = json("doors --seeds 6 --json");
    assert_eq!(json(&format!("doors --json --merge {one} {two}")), whole);
    assert_eq!(whole.as_array().unwrap().len(), 7, "EKF-SLAM, and two proposals with three M");
    let other = share("other", "--seeds 6 --ride-std 2 --shard 2/2");
    let refused = fastslam(&format!("doors --merge {one} {other}")).code(1);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("a share of another sweep than the first file"), "{message}");
}

#[test]
fn drawn_landmarks_take_the_particles_one_by_one_and_computed_ones_do_not() {
    let rows = json("joint --particles 2000 --odometry 0 --seed 3 --json");
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), 24);
    let number = |n: usize, filter: &str, name: &str| rows[n - 1][filter][name].as_f64().unwrap();
    // Exercise 2: each landmark divides N_eff by the same ρ, and a computed map loses nothing where the path is known.
    let rho = number(1, "sampled", "predicted") / number(2, "sampled", "predicted");
    assert!((number(23, "sampled", "predicted") / number(24, "sampled", "predicted") - rho).abs() < 1e-9, "{rho}");
    assert!((number(1, "sampled", "ess") / (2000.0 / rho) - 1.0).abs() < 0.1);
    assert!((number(24, "computed", "ess") - 2000.0).abs() < 1e-6);
    assert!(rows[23]["removed"].as_f64().unwrap() > 0.99);
    let said = fastslam("joint --particles 50").success().get_output().stdout.clone();
    assert!(String::from_utf8(said).unwrap().starts_with("rho 2.7864, 40 repeats\n"));
}

/// The numbers of the figure: its readouts are made of the same run.
#[test]
fn a_smoother_s_table_is_that_of_its_figure() {
    let mut figure = registry::figure("fastslam-smoothing").unwrap();
    for (name, value) in [("particles", "6"), ("seed", "2"), ("odometry", "1.5"), ("step", "3"), ("at", "9")] {
        figure.set(name, value).unwrap();
    }
    while figure.model().pending() > 0 {
        figure.model_mut().work();
    }
    let readouts = figure.readouts();
    let told = |name: &str| readouts.iter().find(|readout| readout.name == name).unwrap().value;
    let run = json("smoothing --particles 6 --seed 2 --odometry 1.5 --sweeps 3 --json");
    let number = |pointer: &str| run.pointer(pointer).and_then(Value::as_f64).unwrap();
    assert_eq!(run["steps"].as_array().unwrap().len(), 62);
    for (pointer, name) in [
        ("/coalescence", "coalescence"),
        ("/cost", "cost"),
        ("/early_rms_m/record", "early_before"),
        ("/early_rms_m/sweeps", "early_after"),
        ("/steps/8/distinct/record", "distinct_before"),
        ("/steps/8/distinct/sweeps", "distinct_after"),
        ("/steps/0/distinct/sweeps", "first_after"),
    ] {
        assert_eq!(Some(number(pointer)), told(name), "{name}");
    }
    assert_eq!(run["steps"][8]["step"], 9);
    let kept = json("smoothing --particles 6 --seed 2 --odometry 1.5 --sweeps 3 --keep --json");
    assert!(kept["steps"][0]["distinct"]["sweeps"].as_f64().unwrap() <= number("/steps/0/distinct/sweeps"));
    let said = fastslam("smoothing --particles 2 --sweeps 1").success().get_output().stdout.clone();
    assert!(String::from_utf8(said).unwrap().starts_with("one ancestor of all until step"));
}

#[test]
fn files_that_cannot_be_used_are_named() {
    for arguments in ["table --merge no/such/file", "lap --particles 1 --png no/such/folder/lap.png"] {
        let failed = fastslam(arguments).code(1);
        assert!(String::from_utf8_lossy(&failed.get_output().stderr).starts_with("fastslam-lab: no/such/"));
    }
}

#[test]
fn variants_are_judged_over_seeds_whatever_the_number_of_threads() {
    let runs = |threads: u32| {
        let table = json(&format!("variants --only sparse --seeds 2 --particles 1 --json --threads {threads}"));
        let row = &table["variants"].as_array().unwrap()[0];
        assert!(table["variants"].as_array().unwrap().len() == 1 && row["cpu_ms"]["median"].as_f64().unwrap() > 0.0);
        let [median, worst] = ["median", "worst"].map(|key| row["translation"][key].as_f64().unwrap());
        let errors: Vec<f64> =
            row["runs"].as_array().unwrap().iter().map(|run| run["translation_mean"].as_f64().unwrap()).collect();
        // Of two, the median is the mean.
        assert!((errors[0] + errors[1] - 2.0 * median).abs() < 1e-15 && worst == errors[0].max(errors[1]));
        row["runs"].as_array().unwrap().iter().map(|run| run["digest"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(runs(1), runs(2));
    fastslam("variants --only sparse --seeds 1 --particles 1").success();
}

#[test]
fn the_ring_prints_what_the_closing_leaves() {
    let ring = json("ring --seeds 3 --particles 6 --json --threads 2");
    assert_eq!(ring, json("ring --seeds 3 --particles 6 --json --threads 1"));
    let runs = ring["runs"].as_array().unwrap();
    assert_eq!(runs.iter().map(|run| run["seed"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 2, 3]);
    for (key, value) in ring["medians"].as_object().unwrap() {
        let below = runs.iter().filter(|run| run[key].as_f64().unwrap() <= value.as_f64().unwrap()).count();
        assert!(below >= 2, "{key}");
    }
    let lap = json("lap --course ring --seed 2 --particles 6 --json");
    assert_eq!(lap["rms_best"], runs[1]["rms_best"]);
    assert_ne!(ring["medians"], json("ring --seeds 3 --particles 6 --niches 1 --max-range 2.5 --json")["medians"]);
    fastslam("ring --seeds 2 --particles 2").success();

    let noise = |weight| {
        json(&format!("ring --price-noise --every 50 --draws 3 --seeds 2 --particles 2 --json --weight {weight}"))
    };
    let of_draws = noise("old-map-at-draw");
    assert_eq!(of_draws["runs"][1].as_array().unwrap().len(), 2, "steps 50 and 100");
    assert!(of_draws["medians"]["noise"].as_f64().unwrap() > 0.0);
    assert_eq!(noise("usual")["medians"]["noise"], 0.0, "the integral is the same whatever was drawn");
    fastslam("ring --price-noise --every 110 --draws 2 --seeds 1 --particles 2 --shared-streams").success();
}

#[test]
fn rings_are_judged_over_seeds_whatever_the_number_of_threads() {
    let rings = json("rings --length 40 --seeds 2 --particles 2 --json --threads 2");
    assert_eq!(rings, json("rings --length 40 --seeds 2 --particles 2 --json --threads 1"));
    let ring = &rings["rings"].as_array().unwrap()[0];
    assert_eq!((ring["length"].as_u64(), rings["particles"].as_u64()), (Some(40), Some(2)));
    let runs = ring["runs"].as_array().unwrap();
    assert_eq!(runs.iter().map(|run| run["seed"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 2]);
    for (path, measure) in
        ["mapped", "odometry"].into_iter().flat_map(|path| ["rms", "first_lap", "revisits_off"].map(|key| (path, key)))
    {
        let of_runs: Vec<f64> = runs.iter().map(|run| run[path][measure].as_f64().unwrap()).collect();
        let [median, worst] = ["median", "worst"].map(|key| ring[path][measure][key].as_f64().unwrap());
        // Of two, the median is the mean.
        assert!((of_runs[0] + of_runs[1] - 2.0 * median).abs() < 1e-12, "{path} {measure}");
        assert_eq!(worst, of_runs[0].max(of_runs[1]), "{path} {measure}");
    }
    let shown = fastslam("rings --length 40 --seeds 1 --particles 1").success().get_output().stdout.clone();
    let shown = String::from_utf8(shown).unwrap();
    assert_eq!((shown.lines().count(), shown.matches("40 m").count()), (5, 2), "{shown}");
}

#[test]
fn policies_print_what_the_figure_must_show() {
    let wings = json("policies --course wings --seeds 6 --particles 8 --json --threads 2");
    assert_eq!(wings, json("policies --course wings --seeds 6 --particles 8 --scheme multinomial --json --threads 1"));
    let policies = wings["policies"].as_array().unwrap();
    let names: Vec<_> = policies.iter().map(|policy| policy["policy"].as_str().unwrap()).collect();
    assert_eq!(names, ["never", "always", "selective"]);
    for policy in policies {
        let [low, high] = [0, 1].map(|end| policy["alive_interval"][end].as_f64().unwrap());
        let share = policy["alive"]["successes"].as_f64().unwrap() / 6.0;
        assert!(policy["alive"]["total"] == 6 && low <= share && share <= high);
    }
    assert_eq!([0, 1].map(|k| policies[k]["resampled_fraction"].as_f64().unwrap()), [0.0, 1.0]);

    let lap = json("policies --seeds 2 --particles 6 --threshold 0.4 --json");
    let [never, always, selective] = [0, 1, 2].map(|k| &lap["policies"][k]);
    assert_eq!((lap["scheme"].as_str(), lap["threshold"].as_f64()), (Some("systematic"), Some(0.4)));
    assert_eq!((&never["tree_nodes"], &never["tree_c"]), (&546.0.into(), &Value::Null), "6 paths of 91 poses");
    assert!(always["lineage_one_step_median"].as_f64().unwrap() > 0.0 && always["tree_c"].as_f64().unwrap() > 0.0);
    assert_eq!((selective["error_factor"][1].as_f64(), &selective["alive"]), (Some(1.0), &Value::Null));

    let said = fastslam("policies --course wings --seeds 2 --particles 4").success();
    let said = String::from_utf8_lossy(&said.get_output().stdout).into_owned();
    assert_eq!((said.lines().count(), said.matches("95 %").count()), (3 + 3 + 6, 6), "{said}");
}

#[test]
fn numbers_are_written_by_key_and_some_can_be_measured_again() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("numbers.json");
    let read = || serde_json::from_slice::<Value>(&std::fs::read(&out).unwrap()).unwrap();
    std::fs::write(&out, r#"{"worked.ess": {"value": 9, "unit": "", "made": ""}, "worked.old": {"value": 9, "unit": "", "made": ""}, "lap.cell": {"value": 7, "unit": "", "made": ""}}"#).unwrap();
    fastslam(&format!("numbers --only worked --out {}", out.display())).success();
    let numbers = read();
    assert!((numbers["worked.ess"]["value"].as_f64().unwrap() - 1.570_870_837_6).abs() < 1e-9);
    assert_eq!((&numbers["worked.old"], &numbers["lap.cell"]["value"]), (&Value::Null, &Value::from(7.0)), "{numbers}");
    fastslam(&format!("numbers --only nothing --out {}", out.display()))
        .code(2)
        .stderr("fastslam-lab: --only nothing: no number begins so\n");
}
