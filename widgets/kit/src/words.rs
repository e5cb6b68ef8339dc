//! What figures say, in the language of their readers.
//!
//! English is in the program: a build script makes a function of every message of `words/en.json`, and a struct with a field for each value
//! of one that has values ([`fastslam_figures_catalogue`]). They call [`text`] and [`fill`]. Another language is a catalogue that is handed to a figure ([`crate::figure::Figure::set_words`]); what it
//! lacks is said in English. A figure speaks its language while it is asked something ([`Language::spoken`]), so that nothing in between
//! has to hand it on.

use core::{cell::Cell, fmt::Display};
use fastslam_figures_catalogue::{self as message, Piece, names};
use std::sync::Mutex;

/// A message without values, in the language spoken. Not inlined, as it is called for every word there is.
#[inline(never)]
pub fn text(english: &'static str, key: u32) -> &'static str {
    SPOKEN.get().message(key).unwrap_or(english)
}

/// A message with its values, which are in the order of their names, in the language spoken. Which names those are, the English message
/// says.
#[inline(never)]
pub fn fill(english: &'static str, key: u32, values: &[&dyn Display]) -> String {
    let names = names(english);
    let said = filled(text(english, key), &names, values).or_else(|| filled(english, &names, values));
    said.unwrap_or_else(|| english.into())
}

/// A message with its values; `None` if it is malformed, or asks for values that it does not get.
fn filled(message: &str, names: &[&str], values: &[&dyn Display]) -> Option<String> {
    let value =
        |name: &str| names.iter().position(|known| *known == name).and_then(|k| Some(values.get(k)?.to_string()));
    let mut said = String::new();
    for piece in message::pieces(message)? {
        match piece {
            Piece::Text(text) => said.push_str(text),
            Piece::Value(name) => said.push_str(&value(name)?),
            Piece::Plural(name, [one, other]) => said.push_str(if value(name)? == "1" { one } else { other }),
        }
    }
    Some(said)
}

/// A language, as it was learnt; by default English.
#[derive(Clone, Copy, Default)]
pub struct Language(Option<&'static Catalogue>);

/// The messages of a language.
struct Catalogue {
    /// What it was made of.
    text: &'static str,
    /// With their keys.
    messages: Vec<(u32, &'static str)>,
}

thread_local! {
    static SPOKEN: Cell<Language> = const { Cell::new(Language(None)) };
}

impl Language {
    /// The language of a catalogue: a line for each message, `section.key=text`. Lines that are none are passed over. What was learnt is
    /// kept for good, so that a message is good for good; there are as many as a page has languages.
    pub fn learnt(catalogue: &str) -> Self {
        static LEARNT: Mutex<Vec<&'static Catalogue>> = Mutex::new(Vec::new());
        if catalogue.is_empty() {
            return Self::default();
        }
        let Ok(mut learnt) = LEARNT.lock() else { return Self::default() };
        if let Some(known) = learnt.iter().find(|known| known.text == catalogue) {
            return Self(Some(known));
        }
        let text: &'static str = String::leak(catalogue.into());
        let lines = text.lines().filter_map(|line| line.split_once('='));
        let messages = lines.map(|(name, message)| (message::key(name), message)).collect();
        let new: &'static Catalogue = Box::leak(Box::new(Catalogue { text, messages }));
        learnt.push(new);
        Self(Some(new))
    }

    /// A message, if the language has it.
    fn message(self, key: u32) -> Option<&'static str> {
        let (_, message) = self.0?.messages.iter().find(|(known, _)| *known == key)?;
        Some(*message).filter(|message| !message.is_empty())
    }

    /// Speaks it until what this returns is dropped.
    #[must_use]
    pub fn spoken(self) -> Spoken {
        Spoken { before: SPOKEN.replace(self) }
    }
}

/// While it lives, a language is spoken.
pub struct Spoken {
    before: Language,
}

impl Drop for Spoken {
    fn drop(&mut self) {
        SPOKEN.set(self.before);
    }
}

mod catalogue {
    use super::{Display, fill, text};
    include!(concat!(env!("OUT_DIR"), "/words.rs"));
}
pub(crate) use catalogue::*;

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam_figures_catalogue::build::disagreements;
    use std::path::Path;

    #[test]
    fn every_language_has_the_messages_of_english_with_the_same_values() {
        assert_eq!(disagreements(&[&Path::new(env!("CARGO_MANIFEST_DIR")).join("words")]), Vec::<String>::new());
    }

    #[test]
    fn a_plural_goes_by_the_value_as_it_is_written() {
        let say = |n: &dyn Display| filled("{n} {n:universe|universes}", &["n"], &[n]);
        assert_eq!([say(&1), say(&16), say(&"1")].map(Option::unwrap), ["1 universe", "16 universes", "1 universe"]);
        for bad in ["{n", "{n:one}", "{m}"] {
            assert_eq!(filled(bad, &["n"], &[&1]), None, "{bad}");
        }
    }

    #[test]
    fn a_language_is_spoken_until_its_guard_goes_and_inside_another_one_too() {
        let of = |word: &str| Language::learnt(&format!("kit.seed={word}\n"));
        let seed = || kit::seed();
        {
            let _outer = of("Startwert").spoken();
            assert_eq!(seed(), "Startwert");
            {
                let _inner = of("graine").spoken();
                assert_eq!(seed(), "graine");
            }
            assert_eq!(seed(), "Startwert");
        }
        assert_eq!(seed(), "Seed");
    }

    #[test]
    fn a_catalogue_is_learnt_once() {
        let [one, two] = [0, 1].map(|_| Language::learnt("kit.step=Paso\n").0.unwrap());
        assert!(core::ptr::eq(one, two));
    }
}
