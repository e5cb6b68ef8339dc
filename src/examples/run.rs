//! The examples of the crate run, and say what they say: each asserts in its `main` that it found its way.

use std::process::Command;

/// What an example prints. Cargo builds the examples of a package with its tests, in the folder beside theirs.
fn run(example: &str) -> String {
    let tests = std::env::current_exe().unwrap();
    let program = tests.parent().unwrap().with_file_name("examples").join(example);
    let output = Command::new(&program).output();
    let output =
        output.unwrap_or_else(|error| panic!("{}: {error}; `cargo test --examples` builds it", program.display()));
    assert!(output.status.success(), "{example}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn landmarks() {
    let said = run("landmarks");
    assert!(said.contains("step 100: error") && said.contains("N_eff"), "{said}");
}

#[test]
fn own_sensor() {
    assert!(run("own_sensor").contains("error after two rounds"));
}

#[test]
fn own_map() {
    assert!(run("own_map").contains("largest error in eight rounds"));
}
