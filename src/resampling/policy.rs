//! When to resample.

use crate::decimal;
use crate::error::ParameterError;
use core::{fmt, str::FromStr};

/// When a population is resampled.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ResamplePolicy {
    /// Never: N_eff falls towards 1.
    Never,
    /// Every step: N_eff looks fine, the lineage dies.
    Always,
    /// Where N_eff < fraction · M (Liu and Chen 1995; GSB take ½).
    EssBelow(f64),
}

impl ResamplePolicy {
    /// Whether a population of `count` with this N_eff is to be resampled.
    pub fn calls_for(&self, ess: f64, count: usize) -> bool {
        match self {
            Self::Never => false,
            Self::Always => true,
            Self::EssBelow(fraction) => ess < fraction * count as f64,
        }
    }
}

impl fmt::Display for ResamplePolicy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Never => f.write_str("never"),
            Self::Always => f.write_str("always"),
            Self::EssBelow(fraction) => write!(f, "neff:{}", decimal::write(*fraction)),
        }
    }
}

impl FromStr for ResamplePolicy {
    type Err = ParameterError;

    fn from_str(text: &str) -> Result<Self, ParameterError> {
        let fraction = text.strip_prefix("neff:").and_then(decimal::parse);
        match (text, fraction) {
            ("never", _) => Ok(Self::Never),
            ("always", _) => Ok(Self::Always),
            (_, Some(f)) if (0.0..=1.0).contains(&f) => Ok(Self::EssBelow(f)),
            _ => Err(ParameterError::new("policy", text, "never, always or neff:F with F from 0 to 1")),
        }
    }
}
