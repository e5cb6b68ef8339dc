//! What only the lap can do: what a reader does at its wheel.

use crate::action::Own;

/// Something that is done with what is in the reader's hand. What is in it is no part of the recipe; what is done with it is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Verb<'a> {
    /// Takes a tool; an empty name puts it away.
    Take(&'a str),
    /// Uses the tool by a key, `move`, `set`, `drive` or `clear`, or by a button that stands for it: right and up, by so many steps.
    Press(&'a str, [f64; 2]),
    /// Uses the tool along a line that was drawn, or at its only point \[css px of the page\]: x and y of each of its points.
    Stroke(&'a [f64]),
}

impl<'a> Verb<'a> {
    /// As it comes from the page.
    pub fn of(Own { name, with, at }: &'a Own) -> Option<Self> {
        match (&**name, &**at) {
            ("take", _) => Some(Self::Take(with)),
            ("press", &[right, up]) => Some(Self::Press(with, [right, up])),
            ("stroke", line) => Some(Self::Stroke(line)),
            _ => None,
        }
    }
}

impl From<Verb<'_>> for Own {
    fn from(verb: Verb<'_>) -> Self {
        let (name, with, at): (_, _, &[f64]) = match &verb {
            Verb::Take(tool) => ("take", *tool, &[]),
            Verb::Press(key, steps) => ("press", *key, steps),
            Verb::Stroke(line) => ("stroke", "", line),
        };
        Self { name: name.into(), with: with.into(), at: at.into() }
    }
}
