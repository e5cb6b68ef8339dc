//! The examples of the crate run, and say what they say: each asserts in its `main` that it found its way.

use std::path::Path;
use std::process::Command;

/// What an example prints. Optimised as tests are, so that it is quick and mostly built.
fn run(example: &str, arguments: &[&str]) -> String {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../Cargo.toml");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["run", "--quiet", "--profile", "test", "--example", example, "--manifest-path"]).arg(manifest);
    let output = cargo.arg("--").args(arguments).output().unwrap();
    assert!(output.status.success(), "{example}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn landmarks() {
    let said = run("landmarks", &[]);
    assert!(said.contains("step 100: error") && said.contains("N_eff"), "{said}");
}

#[test]
fn own_sensor() {
    assert!(run("own_sensor", &[]).contains("error after two rounds"));
}

#[test]
fn own_map() {
    assert!(run("own_map", &[]).contains("largest error in eight rounds"));
}
