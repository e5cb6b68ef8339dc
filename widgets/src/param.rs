//! The parameters of a figure: one table that attributes, controls and links are all made from, and the one place where
//! text from outside becomes a value or a refusal.

use crate::decimal;
use crate::model::FigureError;
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
    /// The same, shown as a button: what a figure is about.
    Toggle,
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
    /// Whether a number is also set by a slider, or by its box alone.
    pub slider: bool,
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
    /// A number of the setup, from `min` to `max`.
    pub fn number(
        name: &'static str,
        title: &'static str,
        unit: &'static str,
        (min, max, step): (f64, f64, f64),
        default: f64,
        help: &'static str,
    ) -> Self {
        Self {
            name,
            title,
            unit,
            kind: Kind::Number,
            min,
            max,
            step,
            choices: &[],
            default: decimal::write(default),
            group: Group::Setup,
            slider: true,
            help,
        }
    }

    /// A whole number of the setup, from `min` to `max`.
    pub fn integer(
        name: &'static str,
        title: &'static str,
        unit: &'static str,
        (min, max): (i64, i64),
        default: i64,
        help: &'static str,
    ) -> Self {
        let spec = Self::number(name, title, unit, (min as f64, max as f64, 1.0), default as f64, help);
        Self { kind: Kind::Integer, ..spec }
    }

    /// One of some words.
    pub fn choice(
        name: &'static str,
        title: &'static str,
        choices: &'static [Choice],
        default: impl Into<String>,
        help: &'static str,
    ) -> Self {
        let spec = Self::number(name, title, "", (0.0, 0.0, 0.0), 0.0, help);
        Self { kind: Kind::Choice, choices, default: default.into(), ..spec }
    }

    /// A checkbox.
    pub fn flag(name: &'static str, title: &'static str, default: bool, help: &'static str) -> Self {
        let spec = Self::number(name, title, "", (0.0, 1.0, 1.0), 0.0, help);
        Self { kind: Kind::Flag, default: flag_text(default), ..spec }
    }

    /// A button that stays pressed.
    pub fn toggle(name: &'static str, title: &'static str, default: bool, help: &'static str) -> Self {
        Self { kind: Kind::Toggle, ..Self::flag(name, title, default, help) }
    }

    /// The same as a parameter of what is shown.
    pub fn view(self) -> Self {
        Self { group: Group::View, ..self }
    }

    /// The same set by its box alone: where there are twenty numbers, a slider each is too much.
    pub fn without_slider(self) -> Self {
        Self { slider: false, ..self }
    }

    /// The same number, which may also be one of some words, the first of them unless another is asked for.
    pub fn or_words(self, words: &'static [Choice]) -> Self {
        Self { choices: words, default: words[0].value.into(), ..self }
    }

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
            Kind::Flag | Kind::Toggle => flag(text).map(Value::Flag),
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
            Kind::Flag | Kind::Toggle => return "on or off".into(),
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

/// A flag as text: what [`ParamSpec::check`] takes.
pub fn flag_text(on: bool) -> String {
    if on { "on" } else { "off" }.into()
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
        ParamSpec { kind, choices, ..ParamSpec::number("speed", "Speed", "m/s", (0.5, 8.0, 0.5), 1.0, "") }
    }

    #[test]
    fn values_in_range_are_taken() {
        assert_eq!(spec(Kind::Number).check(" 0.5 "), Ok(Value::Number(0.5)));
        assert_eq!(spec(Kind::Number).check("8e0"), Ok(Value::Number(8.0)));
        assert_eq!(spec(Kind::Integer).check("3"), Ok(Value::Number(3.0)));
        assert_eq!(spec(Kind::Choice).check("blue"), Ok(Value::Word("blue")));
        assert_eq!(spec(Kind::Flag).check("on"), Ok(Value::Flag(true)));
        assert_eq!(spec(Kind::Flag).check("false"), Ok(Value::Flag(false)));
        assert_eq!(spec(Kind::Toggle).check("on"), Ok(Value::Flag(true)));
    }

    #[test]
    fn every_constructor_s_default_is_a_value_that_it_takes() {
        const WORDS: &[Choice] = &[Choice { value: "best", title: "the best" }];
        let integer = ParamSpec::integer("count", "Count", "", (-1, 4), 2, "");
        assert_eq!(integer.check(&integer.default), Ok(Value::Number(2.0)));
        assert!(integer.check("0.5").is_err());
        let number = ParamSpec::number("speed", "Speed", "m/s", (0.0, 1.0, 0.1), 0.3, "").without_slider();
        assert_eq!((number.check(&number.default), number.slider), (Ok(Value::Number(0.3)), false));
        let words = integer.or_words(WORDS).view();
        assert_eq!((words.check(&words.default), words.group), (Ok(Value::Word("best")), Group::View));
        let choice = ParamSpec::choice("best", "Best", WORDS, "best", "");
        assert_eq!(choice.check(&choice.default), Ok(Value::Word("best")));
        for on in [false, true] {
            for spec in [ParamSpec::flag("a", "A", on, ""), ParamSpec::toggle("a", "A", on, "")] {
                assert_eq!(spec.check(&spec.default), Ok(Value::Flag(on)));
            }
        }
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
