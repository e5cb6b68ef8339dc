//! What only the figure of logs can do: its reader looks nearer, and elsewhere.

use crate::{action::Own, scene::Point};

/// A look. What is looked at is no part of the recipe.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Verb {
    /// Magnifies the picture by a factor about a point \[css px of the page\]; about its middle, where there is none.
    Zoom(f64, Option<Point>),
    /// Moves the picture right and down \[css px of the page\].
    Pan(Point),
    /// Shows the whole again.
    Fit,
}

impl Verb {
    /// As it comes from the page.
    pub fn of(Own { name, at, .. }: &Own) -> Option<Self> {
        match (&**name, &**at) {
            ("zoom", &[factor]) => Some(Self::Zoom(factor, None)),
            ("zoom", &[factor, x, y]) => Some(Self::Zoom(factor, Some([x, y]))),
            ("pan", &[right, down]) => Some(Self::Pan([right, down])),
            ("fit", []) => Some(Self::Fit),
            _ => None,
        }
    }
}

impl From<Verb> for Own {
    fn from(verb: Verb) -> Self {
        let (name, at) = match verb {
            Verb::Zoom(factor, at) => ("zoom", [factor].into_iter().chain(at.into_iter().flatten()).collect()),
            Verb::Pan([right, down]) => ("pan", vec![right, down]),
            Verb::Fit => ("fit", Vec::new()),
        };
        Self { name: name.into(), at, ..Self::default() }
    }
}
