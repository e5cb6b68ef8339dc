//! Why something was refused.

use crate::words::kit::{MustBe, OneOf};
use core::fmt;
use serde::Serialize;

/// Why a value was refused: the parameter, and one line that names it, what was given and what is allowed.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct FigureError {
    /// Name of the parameter as its reader knows it.
    pub parameter: String,
    /// What was given and what is allowed.
    pub message: String,
}

impl FigureError {
    /// `parameter` was given as `value`, where `allowed` names the range or the choices.
    pub fn new(parameter: &str, value: impl fmt::Display, allowed: impl fmt::Display) -> Self {
        let message = MustBe { parameter: &parameter, value: &value, allowed: &allowed }.say();
        Self { parameter: parameter.into(), message }
    }

    /// `parameter` was given as something else than one of these names.
    pub fn not_among(parameter: &str, given: &str, names: &[&str]) -> Self {
        Self::new(parameter, quoted(given), OneOf { words: &names.join(", ") }.say())
    }
}

impl fmt::Display for FigureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl core::error::Error for FigureError {}

/// What was given, on one short line whatever it was.
pub fn quoted(text: &str) -> String {
    let visible = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    let short: String = text.chars().take(40).map(visible).collect();
    let dots = if text.chars().nth(40).is_some() { "…" } else { "" };
    format!("\"{short}{dots}\"")
}
