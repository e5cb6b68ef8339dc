//! What the chapter's figures and numbers come from: a world, a filter, and a comparison with the truth.

pub mod camera;
pub mod car;
pub mod close_up;
pub mod conditioning;
pub mod doors;
pub mod em;
pub mod golden;
pub mod graph;
pub mod hill;
pub mod innovations;
pub mod joint;
pub mod landmarks;
pub mod lap;
pub mod log;
pub mod long_rings;
pub mod looking_back;
pub mod numbers;
pub mod proposal;
pub mod resampling;
pub mod ring;
pub mod smoothing;
mod summary;
pub mod table;
pub mod universes;
pub mod variants;
pub mod worked_example;

pub use summary::{ErrorSummary, Fraction, median_interval, quantile};

use fastslam::error::SettingError;

/// The two proposals a reader chooses from.
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_proposal)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum ProposalKind {
    /// The improved proposal, which the chapter calls measurement-aware: [`FromScan`](fastslam::proposal::FromScan),
    /// [`FromMeasurement`](fastslam::proposal::FromMeasurement).
    #[strum(to_string = "aware", serialize = "improved")]
    #[cfg_attr(feature = "serde", serde(rename = "aware"))]
    Improved,
    /// The motion prior: [`FromMotion`](fastslam::proposal::FromMotion).
    Motion,
}

fn unknown_proposal(given: &str) -> SettingError {
    SettingError::unknown_word("proposal", given, <ProposalKind as strum::VariantNames>::VARIANTS)
}
