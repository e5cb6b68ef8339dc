//! The parameters of a figure: one table that attributes, controls and links are all made from, and the one place where
//! text from outside becomes a value or a refusal.

use crate::model::FigureError;
use fastslam::decimal;
use serde::Serialize;

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
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Choice {
    /// As written in attributes and links.
    pub value: &'static str,
    /// As written on controls.
    pub title: &'static str,
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
    pub choices: &'static [Choice],
    /// Value of a figure of which nothing was asked.
    pub default: String,
    /// What it belongs to.
    pub group: Group,
    /// What it does, in a sentence.
    pub help: &'static str,
}

/// A checked value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Value {
    /// Within the range of its parameter, and whole if that must be.
    Number(f64),
    /// One of the parameter's choices.
    Word(&'static str),
    /// On or off.
    Flag(bool),
}

impl ParamSpec {
    /// The value that `text` means, or what is wrong with it.
    pub fn check(&self, text: &str) -> Result<Value, FigureError> {
        let text = text.trim();
        if let Some(choice) = self.choices.iter().find(|c| c.value == text) {
            return Ok(Value::Word(choice.value));
        }
        let value = match self.kind {
            Kind::Integer => decimal::parse(text).filter(|x| x.trunc() == *x).and_then(|x| self.within(x)),
            Kind::Number => decimal::parse(text).and_then(|x| self.within(x)),
            Kind::Choice => None,
            Kind::Flag => flag(text).map(Value::Flag),
        };
        value.ok_or_else(|| FigureError::new(self.name, quoted(text), self.allowed()))
    }

    fn within(&self, x: f64) -> Option<Value> {
        (self.min <= x && x <= self.max).then_some(Value::Number(x))
    }

    /// The range, in words that follow "must be".
    pub fn allowed(&self) -> String {
        let words: Vec<&str> = self.choices.iter().map(|c| c.value).collect();
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let [min, max] = [self.min, self.max].map(decimal::write);
        let range = match self.kind {
            Kind::Integer => format!("a whole number from {min} to {max}{unit}"),
            Kind::Number => format!("a number from {min} to {max}{unit}"),
            Kind::Choice => return format!("one of {}", words.join(", ")),
            Kind::Flag => return "on or off".into(),
        };
        if words.is_empty() { range } else { format!("{} or {range}", words.join(", ")) }
    }
}

/// `on` and `off`, and what HTML and JavaScript write for them; an attribute without a value is on.
fn flag(text: &str) -> Option<bool> {
    match text {
        "on" | "true" | "1" | "" => Some(true),
        "off" | "false" | "0" => Some(false),
        _ => None,
    }
}

/// What was given, on one short line whatever it was.
pub fn quoted(text: &str) -> String {
    let visible = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    let short: String = text.chars().take(40).map(visible).collect();
    let dots = if text.chars().nth(40).is_some() { "…" } else { "" };
    format!("\"{short}{dots}\"")
}

/// The error for a name that no parameter has.
pub fn unknown(name: &str, specs: &[ParamSpec]) -> FigureError {
    let known: Vec<&str> = specs.iter().map(|s| s.name).collect();
    FigureError {
        parameter: name.into(),
        message: format!("{} is not a parameter of this figure; it has {}", quoted(name), known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(kind: Kind) -> ParamSpec {
        let choices: &[Choice] = match kind {
            Kind::Choice => &[Choice { value: "red", title: "Red" }, Choice { value: "blue", title: "Blue" }],
            _ => &[],
        };
        ParamSpec {
            name: "speed",
            title: "Speed",
            unit: "m/s",
            kind,
            min: 0.5,
            max: 8.0,
            step: 0.5,
            choices,
            default: "1".into(),
            group: Group::Setup,
            help: "",
        }
    }

    #[test]
    fn values_in_range_are_taken() {
        assert_eq!(spec(Kind::Number).check(" 0.5 "), Ok(Value::Number(0.5)));
        assert_eq!(spec(Kind::Number).check("8e0"), Ok(Value::Number(8.0)));
        assert_eq!(spec(Kind::Integer).check("3"), Ok(Value::Number(3.0)));
        assert_eq!(spec(Kind::Choice).check("blue"), Ok(Value::Word("blue")));
        assert_eq!(spec(Kind::Flag).check("on"), Ok(Value::Flag(true)));
        assert_eq!(spec(Kind::Flag).check("false"), Ok(Value::Flag(false)));
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
