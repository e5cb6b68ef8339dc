//! What a figure measures of itself: the numbers of the state shown, the lines of its algorithm, and the data of every step.

use serde::Serialize;
use std::borrow::Cow;

/// A measured quantity of the state shown.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Readout {
    /// Identifier, unique in the figure.
    pub name: &'static str,
    /// Name for readers.
    pub title: &'static str,
    /// The number, if there is one now.
    pub value: Option<f64>,
    /// The number as it is to be written, without its unit.
    pub text: String,
    /// Unit of value and text; empty for pure numbers.
    pub unit: &'static str,
    /// What it means, in a sentence.
    pub help: &'static str,
    /// Whether the picture says it: a page need not write it a second time.
    pub drawn: bool,
}

impl Readout {
    /// A number with its text, which is a dash where the number is not finite.
    #[inline(never)] // figures have some 150 of them
    pub fn new(
        name: &'static str,
        title: &'static str,
        value: f64,
        text: impl Into<String>,
        unit: &'static str,
        help: &'static str,
    ) -> Self {
        let known = value.is_finite();
        let text = if known { text.into() } else { "–".into() };
        Self { name, title, value: known.then_some(value), text, unit, help, drawn: false }
    }

    /// The same where the picture says it.
    #[inline(never)]
    pub fn drawn(mut self) -> Self {
        self.drawn = true;
        self
    }
}

/// A line of an algorithm that the step shown has run, for a page that shows the algorithm beside the figure.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct TraceLine {
    /// What the line does: `propose`, `weigh`, `resample` …
    pub key: &'static str,
    /// What came out, with its unit; empty where there is nothing to tell.
    pub text: String,
}

impl TraceLine {
    /// A line, and what came out of it.
    pub fn new(key: &'static str, text: impl Into<String>) -> Self {
        Self { key, text: text.into() }
    }
}

/// A column of the measured data.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Column {
    /// Identifier with the unit as suffix, e.g. `rms_best_m`.
    pub name: &'static str,
    /// What it means, in a sentence.
    pub help: &'static str,
}

impl Column {
    /// By its name and what it means.
    pub const fn new(name: &'static str, help: &'static str) -> Self {
        Self { name, help }
    }
}

/// Measured data of every step simulated so far.
#[derive(Clone, PartialEq, Debug)]
pub struct Series {
    /// What the values of a row are.
    pub columns: Cow<'static, [Column]>,
    /// One row a step.
    pub rows: Vec<Vec<f64>>,
}
