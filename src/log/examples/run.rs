//! The example of the crate runs, and says what it says.

use std::path::Path;
use std::process::Command;

/// Cargo builds the examples of a package with its tests, in the folder beside theirs.
#[test]
fn laser_log() {
    let tests = std::env::current_exe().unwrap();
    let program = tests.parent().unwrap().with_file_name("examples").join("laser_log");
    let log = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/figures/golden/tiny.clf");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("laser_log");
    let output = Command::new(&program).args([Path::new(log), &folder]).output();
    let output =
        output.unwrap_or_else(|error| panic!("{}: {error}; `cargo test --examples` builds it", program.display()));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains(" of 91 scans mapped"), "{said}");
    assert!(["map.pgm", "map.yaml", "path.tum"].iter().all(|file| folder.join(file).exists()));
}
