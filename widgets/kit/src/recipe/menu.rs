//! What a choice is among.

use crate::param::Choice;
use std::fmt::Display;
use strum::VariantArray;

/// The words of a choice, each with its name for readers and what it means.
pub struct Menu<T> {
    pub(super) choices: Vec<Choice>,
    pub(super) meanings: Vec<T>,
}

impl<T: 'static> Menu<T> {
    /// Words, names and meanings.
    pub fn new(items: impl IntoIterator<Item = (impl Display, &'static str, T)>) -> Self {
        let mut menu = Self { choices: Vec::new(), meanings: Vec::new() };
        for (word, title, meaning) in items {
            menu.choices.push(Choice::new(word, title));
            menu.meanings.push(meaning);
        }
        menu
    }

    /// All variants of an enum by the words that it has for itself, `first` before the others; a variant without a name for
    /// readers does not compile.
    pub fn of(first: T, title: fn(T) -> &'static str) -> Self
    where
        T: VariantArray + Display + Copy + PartialEq,
    {
        let mut menu = Self::new([(first, title(first), first)]);
        for variant in T::VARIANTS.iter().filter(|variant| **variant != first) {
            menu.choices.push(Choice::new(variant, title(*variant)));
            menu.meanings.push(*variant);
        }
        menu
    }

    /// The same in another type, after a word and a meaning of its own.
    pub fn after<U: 'static>(self, (word, title, meaning): (&str, &'static str, U), wrap: fn(T) -> U) -> Menu<U> {
        let mut menu = Menu::new([(word, title, meaning)]);
        menu.choices.extend(self.choices);
        menu.meanings.extend(self.meanings.into_iter().map(wrap));
        menu
    }
}
