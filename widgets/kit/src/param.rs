//! What a parameter is called and may be, and the one place where text from outside becomes a value or a refusal.

use crate::decimal;
use crate::error::FigureError;
pub use crate::error::quoted;
use crate::words::kit::{self, ANumber, AWholeNumber, OneOf, UnknownParameter, WordsOrRange};
use serde::Serialize;
use std::fmt::Display;

/// What values a parameter takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A whole number from `min` to `max`.
    Integer,
    /// A number from `min` to `max`; `step` is a suggestion for controls.
    Number,
    /// One of `choices`.
    Choice,
    /// `on` or `off`.
    Flag,
    /// The same, shown as a button: what a figure is about.
    Toggle,
    /// A text of the figure's own, in a few letters that a link can hold; empty for none. It has no control of its own.
    Text,
}

/// What a parameter belongs to.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// The experiment: a change simulates it anew.
    Setup,
    /// What is shown of it.
    View,
}

/// A word that a parameter takes, and its name for readers.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Choice {
    /// As written in attributes and links.
    pub value: String,
    /// As written on controls.
    pub title: &'static str,
}

impl Choice {
    /// A word and its name.
    pub fn new(value: impl Display, title: &'static str) -> Self {
        Self { value: value.to_string(), title }
    }
}

/// Everything about a parameter but its value.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ParamSpec {
    /// Name in attributes and links.
    pub name: &'static str,
    /// Name for readers.
    pub title: &'static str,
    /// Unit of the numbers; empty for pure numbers.
    pub unit: &'static str,
    /// What values it takes.
    pub kind: Kind,
    /// Least number.
    pub min: f64,
    /// Largest number.
    pub max: f64,
    /// Distance of neighbouring values on a slider.
    pub step: f64,
    /// The words of a [`Kind::Choice`]; for a number, words that are allowed besides.
    pub choices: Vec<Choice>,
    /// Value of a figure of which nothing was asked.
    pub default: String,
    /// What it belongs to.
    pub group: Group,
    /// Whether a number is also set by a slider, or by its box alone.
    pub slider: bool,
    /// Whether its control is one of the few in first sight; the others are in the *Lab*.
    pub sight: bool,
    /// Whether its control is folded away in the Lab as well: few matter to every reader.
    pub folded: bool,
    /// Whether it means anything in this state: what does nothing is not offered.
    pub applies: bool,
    /// What it does, in a sentence.
    pub help: &'static str,
}

/// A checked value.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    /// Within the range of its parameter, and whole if that must be.
    Number(f64),
    /// The rank of one of the parameter's choices.
    Word(usize),
    /// On or off.
    Flag(bool),
    /// As it was given: what it means, or whether anything, its row of the table knows.
    Text(String),
}

impl ParamSpec {
    /// One of the setup, with a slider, in the Lab and not folded there; without unit, choices and default.
    pub(crate) fn new(
        name: &'static str,
        title: &'static str,
        kind: Kind,
        (min, max, step): (f64, f64, f64),
        help: &'static str,
    ) -> Self {
        let (choices, default, unit, group) = (Vec::new(), String::new(), "", Group::Setup);
        let (slider, sight, folded, applies) = (true, false, false, true);
        Self { name, title, unit, kind, min, max, step, choices, default, group, slider, sight, folded, applies, help }
    }

    /// A value as text: what [`ParamSpec::check`] takes.
    pub(crate) fn text(&self, value: Value) -> String {
        match value {
            Value::Number(x) => decimal::write(x),
            Value::Word(rank) => self.choices[rank].value.clone(),
            Value::Flag(on) => if on { "on" } else { "off" }.into(),
            Value::Text(text) => text,
        }
    }

    /// The value that `text` means, or what is wrong with it.
    pub fn check(&self, text: &str) -> Result<Value, FigureError> {
        let text = text.trim();
        if let Some(rank) = self.choices.iter().position(|c| c.value == text) {
            return Ok(Value::Word(rank));
        }
        let value = match self.kind {
            Kind::Integer => decimal::parse(text).filter(|x| x.trunc() == *x).and_then(|x| self.within(x)),
            Kind::Number => decimal::parse(text).and_then(|x| self.within(x)),
            Kind::Choice => None,
            Kind::Flag | Kind::Toggle => flag(text).map(Value::Flag),
            Kind::Text => Some(Value::Text(text.into())),
        };
        value.ok_or_else(|| FigureError::new(self.name, quoted(text), self.allowed()))
    }

    /// A number, if it is in the range.
    pub(crate) fn within(&self, x: f64) -> Option<Value> {
        (self.min <= x && x <= self.max).then_some(Value::Number(x))
    }

    /// The range, in words that follow "must be".
    pub fn allowed(&self) -> String {
        let words: Vec<&str> = self.choices.iter().map(|c| c.value.as_str()).collect();
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let [min, max] = [self.min, self.max].map(decimal::write);
        let range = match self.kind {
            Kind::Integer => AWholeNumber { min: &min, max: &max, unit: &unit }.say(),
            Kind::Number => ANumber { min: &min, max: &max, unit: &unit }.say(),
            Kind::Choice => return OneOf { words: &words.join(", ") }.say(),
            Kind::Flag | Kind::Toggle => return kit::on_or_off().into(),
            Kind::Text => return kit::as_written().into(),
        };
        if words.is_empty() { range } else { WordsOrRange { words: &words.join(", "), range: &range }.say() }
    }
}

/// `on` and `off`, and what HTML and JavaScript write for them; an attribute without a value is on.
pub(crate) fn flag(text: &str) -> Option<bool> {
    match text {
        "on" | "true" | "1" | "" => Some(true),
        "off" | "false" | "0" => Some(false),
        _ => None,
    }
}

/// The error for a name that no parameter has.
pub fn unknown(name: &str, specs: &[ParamSpec]) -> FigureError {
    let known: Vec<&str> = specs.iter().map(|s| s.name).collect();
    FigureError {
        parameter: name.into(),
        message: UnknownParameter { name: &quoted(name), known: &known.join(", ") }.say(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(kind: Kind) -> ParamSpec {
        let choices = match kind {
            Kind::Choice => vec![Choice::new("red", "Red"), Choice::new("blue", "Blue")],
            _ => Vec::new(),
        };
        ParamSpec { unit: "m/s", choices, ..ParamSpec::new("speed", "Speed", kind, (0.5, 8.0, 0.5), "") }
    }

    #[test]
    fn values_in_range_are_taken() {
        assert_eq!(spec(Kind::Number).check(" 0.5 "), Ok(Value::Number(0.5)));
        assert_eq!(spec(Kind::Number).check("8e0"), Ok(Value::Number(8.0)));
        assert_eq!(spec(Kind::Integer).check("3"), Ok(Value::Number(3.0)));
        assert_eq!(spec(Kind::Choice).check("blue"), Ok(Value::Word(1)));
        assert_eq!(spec(Kind::Flag).check("on"), Ok(Value::Flag(true)));
        assert_eq!(spec(Kind::Flag).check("false"), Ok(Value::Flag(false)));
        assert_eq!(spec(Kind::Toggle).check("on"), Ok(Value::Flag(true)));
    }

    #[test]
    fn a_refusal_names_the_parameter_the_value_and_the_range_on_one_line() {
        for bad in ["", "abc", "NaN", "inf", "-1", "8.01", "0x3", "1\n2", "99999999999999999999"] {
            let error = spec(Kind::Number).check(bad).unwrap_err();
            assert_eq!(error.parameter, "speed");
            assert!(error.message.contains("speed") && error.message.contains("from 0.5 to 8 m/s"), "{error}");
            assert_eq!(error.message.lines().count(), 1, "{error}");
        }
        assert!(spec(Kind::Integer).check("1.5").unwrap_err().message.contains("\"1.5\""));
        assert!(spec(Kind::Choice).check("green").unwrap_err().message.contains("red, blue"));
        assert!(spec(Kind::Flag).check("maybe").unwrap_err().message.contains("on or off"));
        assert!(spec(Kind::Number).check(&"9".repeat(10_000)).unwrap_err().message.len() < 200);
    }
}
