//! Writes what the figures say as Rust.

fn main() {
    // Its language, and what the elements around the picture say, are nothing to the program.
    fastslam_figures_catalogue::build::write_words(&["language", "elements"]);
    println!("cargo:rerun-if-changed=build.rs");
}
