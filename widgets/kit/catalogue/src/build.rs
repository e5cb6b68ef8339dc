//! For build scripts and tests: Rust of a catalogue, and whether its languages agree.

use crate::{key, names, pieces};
use std::{
    collections::{BTreeMap, BTreeSet},
    env,
    fmt::Write,
    fs,
    path::Path,
};

/// A catalogue's messages: by section, and there by key.
pub type Catalogue = BTreeMap<String, BTreeMap<String, String>>;

/// The catalogue of a file.
///
/// # Panics
/// Where it cannot be read, or is none.
pub fn read(path: &Path) -> Catalogue {
    let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Writes the messages of `words/en.json` as Rust to `OUT_DIR/words.rs`, but for sections that the program has nothing to say of.
///
/// # Panics
/// Where the catalogue is malformed.
pub fn write_words(without: &[&str]) {
    println!("cargo:rerun-if-changed=words");
    let mut english = read(Path::new("words/en.json"));
    english.retain(|section, _| !without.contains(&section.as_str()));
    let out = env::var_os("OUT_DIR").expect("it is a build script that calls");
    fs::write(Path::new(&out).join("words.rs"), rust(&english))
        .expect("the folder of a build script can be written to");
}

/// All that is written in the catalogues of a folder, but for the accents that formulas draw by themselves.
///
/// # Panics
/// Where there is no such folder.
pub fn characters(folder: &Path) -> BTreeSet<char> {
    let texts = fs::read_dir(folder).expect("the folder of the catalogues").map(|file| {
        let path = file.expect("an entry of the folder").path();
        fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    });
    let written = |c: &char| !c.is_control() && !('\u{300}'..='\u{36f}').contains(c);
    texts.flat_map(|text| text.chars().filter(written).collect::<Vec<_>>()).collect()
}

/// What is wrong with catalogues that are read as one, a folder each with a file for each language: a language that lacks a message of English
/// or has one more, other values in a message, one that is empty or malformed, and two names that the program takes for one.
///
/// # Panics
/// Where a file is missing.
pub fn disagreements(folders: &[&Path]) -> Vec<String> {
    let (mut wrong, mut known) = (Vec::new(), BTreeMap::new());
    for folder in folders {
        let english = read(&folder.join("en.json"));
        for (section, messages) in &english {
            for name in messages.keys().map(|key| format!("{section}.{key}")) {
                if let Some(other) = known.insert(key(&name), name.clone()) {
                    wrong.push(format!("{name} and {other} have the same key"));
                }
            }
        }
        let named = |catalogue: &Catalogue| -> Vec<(String, Vec<String>)> {
            catalogue.iter().map(|(name, messages)| (name.clone(), messages.keys().cloned().collect())).collect()
        };
        for file in
            fs::read_dir(folder).expect("the folder of the catalogues").map(|file| file.expect("an entry").path())
        {
            let other = read(&file);
            if named(&other) != named(&english) {
                wrong.push(format!("{} has not the messages of English", file.display()));
                continue;
            }
            for (section, messages) in &other {
                for (key, message) in messages {
                    let fits = !message.is_empty() && !message.contains('\n') && pieces(message).is_some();
                    if !fits || names(message) != names(&english[section][key]) {
                        wrong.push(format!("{}: {section}.{key}: {message}", file.display()));
                    }
                }
            }
        }
    }
    wrong
}

/// A function for a message, or a struct with its values. Titles are said before any language is known: a constant.
fn message(section: &str, key: &str, english: &str) -> String {
    let hash = crate::key(&format!("{section}.{key}"));
    assert!(pieces(english).is_some(), "{section}.{key} is malformed: {english}");
    let values = names(english);
    let doc = format!("    #[doc = {english:?}]\n");
    if key == "title" {
        return format!("{doc}    pub(crate) const TITLE: &str = {english:?};\n");
    }
    if values.is_empty() {
        return format!(
            "{doc}    pub(crate) fn {key}() -> &'static str {{\n        text({english:?}, {hash})\n    }}\n"
        );
    }
    let name: String = key.split('_').map(capital).collect();
    let join = |row: &dyn Fn(&str) -> String| values.iter().map(|name| row(name)).collect::<String>();
    let fields = join(&|name| format!("pub(crate) {name}: &'a dyn Display, "));
    let own = join(&|name| format!("self.{name}, "));
    format!(
        "{doc}    pub(crate) struct {name}<'a> {{ {fields}}}\n    impl {name}<'_> {{\n        pub(crate) fn say(&self) -> String {{\n            \
         fill({english:?}, {hash}, &[{own}])\n        }}\n    }}\n"
    )
}

fn capital(word: &str) -> String {
    let (first, rest) = word.split_at(1);
    first.to_uppercase() + rest
}

/// The modules of the messages, one for each section. What they call, `text` and `fill` of the kit, is to stand above them with `Display`.
fn rust(english: &Catalogue) -> String {
    let mut module = String::new();
    for (section, messages) in english {
        writeln!(
            module,
            "pub(crate) mod {section} {{\n    #[allow(unused_imports)]\n    use super::{{Display, fill, text}};"
        )
        .unwrap();
        module.extend(messages.iter().map(|(key, english)| message(section, key, english)));
        module.push_str("}\n");
    }
    module
}
