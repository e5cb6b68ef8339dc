//! What several figures say of the filters, in words.

use crate::{
    decimal::{self, fixed},
    model::{Change, FigureError},
    words::common::{self, NEffOf},
};
use fastslam::error::SettingError;

/// What a lap's universes are weighed by, in figures that have no parameter for it.
pub const WEIGHED_ANEW: Change = Change::Told(
    "Universes pay what known ground says of all poses that they might have drawn, and not of the one that they drew.",
);

/// A setting that the filters refuse. Parameters keep within what they take: this is for who has let one of them take more.
pub fn refused(error: SettingError) -> FigureError {
    let field = error.field();
    match error {
        SettingError::OutOfRange { value, range, .. } => {
            let [value, least, most] = [value, range.least, range.most].map(decimal::write);
            FigureError::new(field, value, format_args!("{least} … {most} {}", range.unit))
        }
        SettingError::UnknownWord { given, choices, .. } => FigureError::not_among(field, &given, choices),
        SettingError::Unfit { allowed: needed, .. } | SettingError::Missing { needed, .. } => {
            FigureError { parameter: field.into(), message: format!("{field}: {needed}") }
        }
        _ => FigureError { parameter: field.into(), message: field.into() },
    }
}

/// What is made of a setting that cannot be refused: the ranges of the parameters are within those of the filters.
pub fn in_range<T>(made: Result<T, SettingError>) -> T {
    made.unwrap_or_else(|error| unreachable!("{} is out of its range", error.field()))
}

/// A pose, or a difference of poses \[m, m, rad\], as text.
pub fn pose_text([x, y, theta]: [f64; 3]) -> String {
    format!("({}, {}, {})", fixed(x, 2), fixed(y, 2), fixed(theta, 3))
}

/// N_eff of so many, as text.
pub fn ess_text(ess: f64, particles: usize) -> String {
    NEffOf { ess: &fixed(ess, 1), m: &particles }.say()
}

/// What is to be said of a step of this log evidence \[nats\], if no universe explains what it saw.
pub fn unexplained(log_evidence: f64) -> Option<String> {
    (log_evidence == f64::NEG_INFINITY).then(|| common::unexplained().into())
}

/// A length \[m\], with two decimals.
pub fn metres(length: f64) -> String {
    fixed(length, 2)
}

/// A number of particles: one decimal where there are few.
pub fn count(particles: f64) -> String {
    match particles {
        few if few < 0.1 => format!("< {}", fixed(0.1, 1)),
        few if few < 100.0 => fixed(few, 1),
        many => fixed(many, 0),
    }
}

/// In whole MB, or tenths where there are few.
pub fn megabytes(bytes: f64) -> String {
    let megabytes = bytes / 1e6;
    if megabytes < 10.0 { fixed(megabytes, 1) } else { fixed(megabytes, 0) }
}
