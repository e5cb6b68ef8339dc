//! The schemes against an outside oracle: the Python package `particles` of Nicolas Chopin (PyPI), which goes with Chopin and
//! Papaspiliopoulos, *An Introduction to Sequential Monte Carlo* (2020). The same weights and uniforms give the same ancestors.
//!
//! Not among the tests that `cargo test` runs by itself: the first run installs the package, into a virtual environment of its
//! own under `.cache`. `npm test` runs it as a step; by hand, `cargo test -p laws --test oracle -- --ignored --nocapture`. Without
//! Python or PyPI it says so, and `npm test` counts it as skipped.

use fastslam::random::{Purpose, Stream};
use fastslam::resampling::Scheme;
use fastslam::weights::Weights;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const PACKAGE: &str = "particles==0.4";

/// Python with the package, or why there is none.
fn python() -> Result<PathBuf, String> {
    let venv = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../.cache/particles");
    let python = venv.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let run = |command: &mut Command, what: &str| {
        let output = command.output().map_err(|error| format!("{what}: {error}"))?;
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let last = said.trim_end().lines().last().unwrap_or("no reason given").to_owned();
        if output.status.success() { Ok(()) } else { Err(format!("{what}: {last}")) }
    };
    let import = || run(Command::new(&python).env("NUMBA_DISABLE_JIT", "1").args(["-c", "import particles"]), "import");
    if import().is_err() {
        run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&venv), "python3 -m venv")?;
        let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "1", PACKAGE];
        run(Command::new(&python).args(pip), &format!("pip install {PACKAGE}"))?;
        import()?;
    }
    Ok(python)
}

/// 4 × 60 resamplings: populations of 1 to 60 of weights over a few or over hundreds of nats, 1 to 100 offspring.
fn cases() -> (String, Vec<Vec<u32>>) {
    let (mut lines, mut ours) = (String::new(), Vec::new());
    for scheme in [Scheme::Systematic, Scheme::Stratified, Scheme::Multinomial, Scheme::Residual] {
        for case in 0..60 {
            let mut draw = Stream::at(11, Purpose::TRIAL, case, 0);
            let spread = if case % 3 == 0 { 300.0 } else { 4.0 };
            let log_weights: Vec<f64> = (0..=case).map(|_| -spread * draw.uniform()).collect();
            let n = 1 + (100.0 * draw.uniform()) as usize;
            let weights = Weights::uniform(log_weights.len()).reweighted(&log_weights).0;
            let stream = || Stream::at(12, Purpose::RESAMPLING, case, 0);
            ours.push(scheme.ancestors(&weights, n, &mut stream()));
            let mut uniforms = stream();
            let join = |values: Vec<f64>| values.iter().map(|x| format!("{x:e}")).collect::<Vec<_>>().join(",");
            let uniforms = join((0..n).map(|_| uniforms.uniform()).collect());
            lines += &format!("{scheme} {n} {} {uniforms}\n", join(weights.as_slice().to_vec()));
        }
    }
    (lines, ours)
}

#[test]
#[ignore = "installs a Python package: a step of its own of npm test"]
fn the_same_weights_and_uniforms_give_the_ancestors_of_the_package_particles() {
    let python = match python() {
        Ok(python) => python,
        Err(why) => return println!("skipped: {why}"),
    };
    let (lines, ours) = cases();
    // Its loops are compiled at their first run, which takes longer than to run them as they are.
    let mut child = Command::new(python)
        .env("NUMBA_DISABLE_JIT", "1")
        .args(["-c", include_str!("oracle.py")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || stdin.write_all(lines.as_bytes()));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap().unwrap();
    assert!(output.status.success());
    let theirs = String::from_utf8(output.stdout).unwrap();
    assert_eq!(theirs.lines().count(), ours.len());
    for (case, (theirs, ours)) in theirs.lines().zip(&ours).enumerate() {
        let theirs: Vec<u32> = theirs.split(' ').map(|slot| slot.parse().unwrap()).collect();
        assert_eq!(&theirs, ours, "case {case}");
    }
    println!("{} resamplings agree", ours.len());
}
