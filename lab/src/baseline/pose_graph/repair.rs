//! What is done about edges that may be wholly wrong.

use fastslam::error::{Range, SettingError};
use fastslam::ops;

/// How the edges of loops are judged. Those of odometry and of matches between neighbours are least squares always: what closes a loop is
/// what can be mistaken for another place.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Repair {
    /// ½ χ²: an edge pulls the harder the further it is off.
    #[default]
    LeastSquares,
    /// ½ c² ln(1 + χ²/c²), after Cauchy: from c standard deviations on an edge pulls less the further it is off, and never lets go.
    Cauchy {
        /// c, in standard deviations.
        width: f64,
    },
    /// ½ (s² χ² + Ξ (1 − s)²) with a switch s for each edge, 0 to 1, found along with the poses (Sünderhauf and Protzel 2012): for less
    /// than ½ Ξ the optimiser may switch an edge off.
    Switchable {
        /// Ξ: how firmly an edge is believed to be right.
        prior: f64,
    },
    /// The better of two Gaussians, chosen anew at every place (Olson and Agarwal 2013): the measurement, or *none of that*, of the
    /// same mean with `null_scale` of the information and `null_weight` of the weight.
    /// min(½ χ², ½ s χ² − ln w − (3/2) ln s), both up to the constant of the first.
    MaxMixture {
        /// w: weight of the null component against that of the measurement.
        null_weight: f64,
        /// s: its share of the information.
        null_scale: f64,
    },
}

impl Repair {
    /// Cauchy's with the width that has 95 % of the efficiency of least squares where all is Gaussian (Zhang 1997, table 1).
    pub const CAUCHY: Self = Self::Cauchy { width: 2.385 };
    /// An edge is believed until it is off by some five standard deviations. With the paper's Ξ = 1, many right edges of a path that has
    /// drifted far are switched off before it is bent, and stay off.
    pub const SWITCHABLE: Self = Self::Switchable { prior: 30.0 };
    /// A null component of a tenth of the weight and a millionth of the information: standard deviations a thousand times as wide.
    pub const MAX_MIXTURE: Self = Self::MaxMixture { null_weight: 0.1, null_scale: 1e-6 };

    /// Whether all settings are in range.
    ///
    /// # Errors
    /// Where one is not.
    pub fn validate(&self) -> Result<(), SettingError> {
        match *self {
            Self::LeastSquares => Ok(()),
            Self::Cauchy { width } => Range::number(1e-3, 1e6, "").check("width", width).map(drop),
            Self::Switchable { prior } => Range::number(1e-6, 1e9, "").check("prior", prior).map(drop),
            Self::MaxMixture { null_weight, null_scale } => {
                Range::number(1e-9, 1.0, "").check("null_weight", null_weight)?;
                Range::number(1e-12, 1.0, "").check("null_scale", null_scale).map(drop)
            }
        }
    }

    /// What an edge with this χ² and this switch costs \[nats\].
    pub(super) fn cost(&self, chi_squared: f64, switch: f64) -> f64 {
        match *self {
            Self::LeastSquares => 0.5 * chi_squared,
            Self::Cauchy { width } => {
                let c2 = width * width;
                0.5 * c2 * ops::ln(1.0 + chi_squared / c2)
            }
            Self::Switchable { prior } => {
                let off = 1.0 - switch;
                0.5 * (switch * switch * chi_squared + prior * off * off)
            }
            Self::MaxMixture { .. } => (0.5 * chi_squared).min(self.null_cost(chi_squared)),
        }
    }

    /// The share of an edge's information that pulls: 1 for all of it.
    pub fn weight(&self, chi_squared: f64, switch: f64) -> f64 {
        match *self {
            Self::LeastSquares => 1.0,
            // ∂cost/∂(½ χ²).
            Self::Cauchy { width } => 1.0 / (1.0 + chi_squared / (width * width)),
            Self::Switchable { .. } => switch * switch,
            Self::MaxMixture { null_scale, .. } => {
                if self.null_cost(chi_squared) < 0.5 * chi_squared {
                    null_scale
                } else {
                    1.0
                }
            }
        }
    }

    /// Of the null component \[nats\]; infinite where there is none.
    fn null_cost(&self, chi_squared: f64) -> f64 {
        match *self {
            Self::MaxMixture { null_weight, null_scale } => {
                0.5 * null_scale * chi_squared - ops::ln(null_weight) - 1.5 * ops::ln(null_scale)
            }
            _ => f64::INFINITY,
        }
    }
}
