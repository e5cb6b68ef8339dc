//! What is said about a setting that cannot be used.

use core::fmt;

/// A parameter outside its range: says which, what was given and what is allowed, in one line.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ParameterError {
    /// Name of the parameter as its user knows it.
    pub parameter: String,
    /// What was given and what is allowed.
    pub message: String,
}

impl ParameterError {
    /// `parameter` was given as `value`, where `allowed` names the range or the choices.
    pub fn new(parameter: &str, value: impl fmt::Display, allowed: impl fmt::Display) -> Self {
        Self { parameter: parameter.into(), message: format!("{parameter} = {value}: must be {allowed}") }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl core::error::Error for ParameterError {}
