//! What the figures say: `build.rs` makes it of `words/en.json`, as the kit's is made of its own. What both have is one catalogue to a page.

pub use fastslam_figures_kit::words::Language;

mod catalogue {
    use core::fmt::Display;
    use fastslam_figures_kit::words::{fill, text};
    include!(concat!(env!("OUT_DIR"), "/words.rs"));
}
pub(crate) use catalogue::*;

#[cfg(test)]
mod tests {
    use crate::font::has;
    use fastslam_figures_catalogue::build::{characters, disagreements, read};
    use std::{fs, path::Path};

    #[test]
    fn every_language_has_the_messages_of_english_with_the_same_values() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert_eq!(disagreements(&[&folder.join("words"), &folder.join("kit/words")]), Vec::<String>::new());
        for file in fs::read_dir(folder.join("words")).unwrap() {
            assert!(["point", "comma"].contains(&read(&file.unwrap().path())["language"]["decimal"].as_str()));
        }
    }

    #[test]
    fn every_letter_of_every_language_is_embedded() {
        for character in characters(&Path::new(env!("CARGO_MANIFEST_DIR")).join("words")) {
            assert!(has(character), "{character}");
        }
    }
}
