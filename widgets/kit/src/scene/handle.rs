//! Points of a scene that a reader moves.

use super::{Point, Rect};

/// A point that is dragged, or moved by keyboard. The scene draws its mark; the page lays something to grasp over it.
#[derive(Clone, PartialEq, Debug)]
pub struct Handle {
    /// Argument of [`crate::view::View::drag`] and [`crate::view::View::nudge`], unique in the figure.
    pub name: &'static str,
    /// Name for readers.
    pub title: String,
    /// Where \[css px\].
    pub at: Point,
    /// Names of the parameters that it moves, the one that moves it sideways first: what it can be is their ranges.
    pub axes: &'static [&'static str],
    /// Its value as one number, for assistive technology; of one that moves in two directions, what the place says.
    pub value: f64,
    /// Its value in words, read out.
    pub text: String,
    /// An area over which it follows the pointer without a button held, as the cursor of a heat map does.
    pub hover: Option<Rect>,
}

impl Handle {
    /// That of one parameter, which has its name; or of two, with the name of the first.
    pub fn of(axes: &'static [&'static str], title: &str, at: Point, value: f64, text: String) -> Self {
        Self { name: axes[0], title: title.into(), at, axes, value, text, hover: None }
    }
}
