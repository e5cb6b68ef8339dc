//! What is said about a setting that cannot be used, and numbers as messages and files say them.

use core::fmt;

/// A setting that cannot be used: which one, what was given, and what is allowed, in one line.
///
/// ```
/// use fastslam::error::{Range, SettingError};
/// let error = Range::whole(1, 4096).check("particles", 0.0).unwrap_err();
/// assert!(matches!(error, SettingError::OutOfRange { field: "particles", .. }));
/// assert_eq!(error.to_string(), "particles = 0: must be a whole number from 1 to 4096");
/// ```
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// A number outside its range.
    #[error("{field} = {}: must be {range}", Shown(*value))]
    OutOfRange {
        /// Name of the setting.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        range: Range,
    },
    /// A word that is none of those allowed.
    #[error("{field} = {given}: must be {}", one_of(choices))]
    UnknownWord {
        /// Name of the setting.
        field: &'static str,
        /// What was given.
        given: String,
        /// The words that are allowed.
        choices: &'static [&'static str],
    },
    /// Something that is more than a number or a word, and does not fit to what else was set.
    #[error("{field}: must be {allowed}")]
    Unfit {
        /// Name of the setting.
        field: &'static str,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Something that is needed and was not given.
    #[error("{field}: needs {needed}")]
    Missing {
        /// Name of the setting.
        field: &'static str,
        /// What is needed.
        needed: &'static str,
    },
}

impl SettingError {
    /// `given`, short enough for one line, is none of the words that `field` takes.
    pub fn unknown_word(field: &'static str, given: &str, choices: &'static [&'static str]) -> Self {
        Self::UnknownWord { field, given: given.chars().take(40).collect(), choices }
    }

    /// The same refusal under the name by which the readers of a program know the setting: a flag, a control.
    ///
    /// ```
    /// # use fastslam::error::Range;
    /// let error = Range::number(0.02, 0.2, "m").check("cell_size", 7.0).unwrap_err().called("cell");
    /// assert_eq!(error.to_string(), "cell = 7: must be a number from 0.02 to 0.2 [m]");
    /// ```
    pub fn called(mut self, name: &'static str) -> Self {
        match &mut self {
            Self::OutOfRange { field, .. }
            | Self::UnknownWord { field, .. }
            | Self::Unfit { field, .. }
            | Self::Missing { field, .. } => {
                *field = name;
            }
        }
        self
    }

    /// Name of the setting that is refused.
    pub fn field(&self) -> &'static str {
        match self {
            Self::OutOfRange { field, .. }
            | Self::UnknownWord { field, .. }
            | Self::Unfit { field, .. }
            | Self::Missing { field, .. } => field,
        }
    }
}

/// The numbers that a setting takes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Range {
    /// Least that is allowed, in `unit`.
    pub least: f64,
    /// Most that is allowed, in `unit`.
    pub most: f64,
    /// Whether it must be a whole number.
    pub whole: bool,
    /// Unit of both; empty for a pure number.
    pub unit: &'static str,
}

impl Range {
    /// Numbers from `least` to `most`, both allowed, in this unit; an empty one for pure numbers.
    pub const fn number(least: f64, most: f64, unit: &'static str) -> Self {
        Self { least, most, whole: false, unit }
    }

    /// Finite numbers from `least` on, in this unit.
    pub const fn at_least(least: f64, unit: &'static str) -> Self {
        Self::number(least, f64::MAX, unit)
    }

    /// All numbers but infinities and NaN, in this unit.
    pub const fn finite(unit: &'static str) -> Self {
        Self::number(f64::MIN, f64::MAX, unit)
    }

    /// Whole numbers from `least` to `most`, both allowed.
    pub const fn whole(least: u32, most: u32) -> Self {
        Self { least: least as f64, most: most as f64, whole: true, unit: "" }
    }

    /// Whether a number is in the range. None that is no number is.
    pub fn contains(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value) && !(self.whole && value.fract() != 0.0)
    }

    /// The number as it is.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] where it is not in the range.
    pub fn check(&self, field: &'static str, value: f64) -> Result<f64, SettingError> {
        if self.contains(value) { Ok(value) } else { Err(SettingError::OutOfRange { field, value, range: *self }) }
    }
}

/// In words that follow *must be*.
impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { least, most, whole, unit } = *self;
        let kind = if whole { "a whole number" } else { "a number" };
        match (least, most) {
            (f64::MIN, f64::MAX) => f.write_str("a finite number")?,
            (_, f64::MAX) => write!(f, "{kind} of at least {}", Shown(least))?,
            _ => write!(f, "{kind} from {} to {}", Shown(least), Shown(most))?,
        }
        if unit.is_empty() { Ok(()) } else { write!(f, " [{unit}]") }
    }
}

/// Words with commas between them, and *or* before the last.
fn one_of(words: &[&str]) -> String {
    match words {
        [all @ .., last] if !all.is_empty() => format!("{} or {last}", all.join(", ")),
        _ => words.concat(),
    }
}

/// A number, displayed on one short line, whatever it is.
pub struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.abs() < 1e15 || !self.0.is_finite() { write!(f, "{}", self.0) } else { write!(f, "{:e}", self.0) }
    }
}

/// A number with so many decimals, and 0 without a sign.
pub fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.into(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_names_the_setting_what_was_given_and_the_range_on_one_line() {
        let refused = |range: Range, value| range.check("cell_size", value).unwrap_err().to_string();
        let range = Range::number(0.02, 0.2, "m");
        assert_eq!(refused(range, 3.5), "cell_size = 3.5: must be a number from 0.02 to 0.2 [m]");
        assert_eq!(refused(range, f64::NAN), "cell_size = NaN: must be a number from 0.02 to 0.2 [m]");
        assert_eq!(refused(range, -1e300), "cell_size = -1e300: must be a number from 0.02 to 0.2 [m]");
        assert_eq!(refused(Range::whole(1, 10), 1.5), "cell_size = 1.5: must be a whole number from 1 to 10");
        assert_eq!(refused(Range::at_least(0.0, ""), -1.0), "cell_size = -1: must be a number of at least 0");
        assert_eq!(refused(Range::finite("rad"), f64::INFINITY), "cell_size = inf: must be a finite number [rad]");
    }

    #[test]
    fn both_ends_of_a_range_are_in_it() {
        let range = Range::number(0.02, 0.2, "m");
        assert_eq!([0.02, 0.2, 0.1].map(|x| range.check("cell_size", x)), [Ok(0.02), Ok(0.2), Ok(0.1)]);
    }
}
