//! Which module may know which: read from the `use` of the sources.

use std::fs;
use std::path::{Path, PathBuf};

/// Modules of `fastslam`, each after all that it may use.
const ORDER: [&str; 21] = [
    "decimal",
    "error",
    "digest",
    "execute",
    "ops",
    "random",
    "geometry",
    "motion",
    "sensor",
    "log",
    "map",
    "matching",
    "weights",
    "resampling",
    "lineage",
    "rbpf",
    "proposal",
    "exact",
    "world",
    "experiment",
    "lib",
];

/// Parts of the figures' crate, with what each may know of the others: a scene is data that knows nobody, models make scenes,
/// the painter paints them.
const FIGURES: [(&str, &[&str]); 3] =
    [("scene", &["scene", "font"]), ("paint", &["scene", "paint", "font"]), ("model", &["scene", "model"])];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() && path.file_name().unwrap() != "bin" {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files
}

/// Modules of its own crate that a source names, outside comments and tests.
fn used(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
    let code: String = code.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let first_word =
        |path: &str| path.trim().split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap().to_owned();
    let mut names = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        if !rest.starts_with('{') {
            names.push(first_word(rest));
            continue;
        }
        // A group: the first word of each of its parts, whatever is nested in them.
        let (mut depth, mut part) = (0, String::new());
        for c in rest.chars() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            match c {
                ',' if depth == 1 => names.push(first_word(&std::mem::take(&mut part))),
                '{' if depth == 1 => (),
                _ => part.push(c),
            }
            if depth == 0 {
                break;
            }
        }
        names.push(first_word(&part));
    }
    names.retain(|name| !name.is_empty());
    names
}

fn module(root: &Path, path: &Path) -> String {
    let first = path.strip_prefix(root).unwrap().components().next().unwrap();
    first.as_os_str().to_str().unwrap().trim_end_matches(".rs").to_owned()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn modules_use_only_what_comes_before_them() {
    let src = root().join("src");
    let rank =
        |name: &str| ORDER.iter().position(|m| *m == name).unwrap_or_else(|| panic!("{name} is not in the order"));
    for path in sources(&src) {
        let module = module(&src, &path);
        for name in used(&path) {
            // A proposal reads the particle, and the filter calls the proposal: two halves of one trait.
            let halves = module == "rbpf" && name == "proposal";
            assert!(halves || rank(&name) <= rank(&module), "{} uses {name}", path.display());
        }
    }
}

#[test]
fn no_filter_knows_the_truth() {
    let src = root().join("src");
    let mut found = false;
    for path in sources(&src) {
        let module = module(&src, &path);
        let knows = used(&path).iter().any(|name| name == "world");
        assert!(!knows || ["world", "experiment"].contains(&module.as_str()), "{} uses the world", path.display());
        found |= knows;
    }
    assert!(found, "experiments use the world: where not even they seem to, this test sees nothing");
}

#[test]
fn only_the_shell_knows_javascript_and_nothing_has_a_clock() {
    for folder in ["src", "widgets/src"] {
        for path in sources(&root().join(folder)) {
            let text = fs::read_to_string(&path).unwrap();
            let shell = path.ends_with("shell.rs");
            for word in ["wasm_bindgen", "web_sys", "js_sys"] {
                assert!(shell || !text.contains(word), "{} names {word}", path.display());
            }
            for word in ["std::time", "std::env", "std::fs", "std::net", "std::thread", "thread_rng", "HashMap"] {
                assert!(!text.contains(word), "{} names {word}", path.display());
            }
        }
    }
}

#[test]
fn models_know_no_pixels_scenes_no_colours_and_the_painter_no_slam() {
    let widgets = root().join("widgets/src");
    let mut met = Vec::new();
    for path in sources(&widgets) {
        // A figure's own folder keeps the same names: lap/model.rs is a model.
        let [part, file] = [module(&widgets, &path), path.file_stem().unwrap().to_str().unwrap().to_owned()];
        let Some((part, may)) = FIGURES.iter().find(|(name, _)| *name == part || *name == file) else { continue };
        met.push(*part);
        for name in
            used(&path).iter().filter(|name| ["model", "scene", "paint", "figure", "shell"].contains(&name.as_str()))
        {
            // A figure's own scene is made of its model.
            let own_model = file == "scene" && name == "model";
            assert!(own_model || may.contains(&name.as_str()), "{} ({part}) uses {name}", path.display());
        }
        let slam = fs::read_to_string(&path).unwrap().contains("fastslam::experiment");
        assert!(*part == "model" || file == "scene" || !slam, "{} ({part}) knows the filters", path.display());
    }
    assert!(FIGURES.iter().all(|(name, _)| met.contains(name)), "a part has another name now, and is not looked at");
}
