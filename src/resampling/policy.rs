//! When to resample.

use crate::error::{Range, SettingError};
use core::{fmt, str::FromStr};

/// When a population is resampled.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ResamplePolicy {
    /// Never: N_eff falls towards 1.
    Never,
    /// Every step: N_eff looks fine, the lineage dies.
    Always,
    /// Where N_eff < fraction · M (Liu and Chen 1995; GSB take ½).
    EssBelow(f64),
}

impl ResamplePolicy {
    /// Range of the fraction of [`Self::EssBelow`].
    pub const FRACTION: Range = Range::number(0.0, 1.0, "");

    /// Whether the fraction is in its range.
    ///
    /// # Errors
    /// Where it is not.
    pub fn validate(&self) -> Result<(), SettingError> {
        match self {
            Self::Never | Self::Always => Ok(()),
            Self::EssBelow(fraction) => Self::FRACTION.check("policy", *fraction).map(drop),
        }
    }

    /// Whether a population of `count` with this N_eff is to be resampled.
    pub fn should_resample(&self, ess: f64, count: usize) -> bool {
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
            Self::EssBelow(fraction) => write!(f, "neff:{fraction}"),
        }
    }
}

impl FromStr for ResamplePolicy {
    type Err = SettingError;

    fn from_str(text: &str) -> Result<Self, SettingError> {
        let fraction = text.strip_prefix("neff:").and_then(|text| text.parse().ok());
        match (text, fraction) {
            ("never", _) => Ok(Self::Never),
            ("always", _) => Ok(Self::Always),
            (_, Some(f)) if Self::FRACTION.contains(f) => Ok(Self::EssBelow(f)),
            _ => Err(SettingError::unknown_word("policy", text, &["never", "always", "neff:F with F from 0 to 1"])),
        }
    }
}
