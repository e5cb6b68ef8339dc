//! The words of a message, each read as what it must be.

use crate::number::number;
use crate::{Field, LogProblem};
use fastslam::geometry::Pose2;
use fastslam::sensor::LaserScan;

/// Beams that room is made for before they are read.
const MOST_BEAMS: u32 = 4096;

/// The words of one message.
pub(super) struct Words<'a> {
    pub words: core::str::SplitAsciiWhitespace<'a>,
    /// Its name; empty for a pose in a line of a TUM file.
    pub kind: &'static str,
}

impl<'a> Words<'a> {
    fn wrong(&self, field: Field, found: Option<&str>) -> LogProblem {
        let message = Some(self.kind).filter(|kind| !kind.is_empty());
        LogProblem::Field { message, field, found: found.map(shown) }
    }

    pub fn word(&mut self, field: Field) -> Result<&'a str, LogProblem> {
        self.words.next().ok_or_else(|| self.wrong(field, None))
    }

    /// A finite number, by the name of its field.
    pub fn number(&mut self, name: &'static str) -> Result<f64, LogProblem> {
        self.value(Field::Named(name))
    }

    /// A finite number.
    pub fn value(&mut self, field: Field) -> Result<f64, LogProblem> {
        let word = self.word(field)?;
        number(word).filter(|x| x.is_finite()).ok_or_else(|| self.wrong(field, Some(word)))
    }

    pub fn count(&mut self, field: Field) -> Result<u32, LogProblem> {
        let word = self.word(field)?;
        word.parse().map_err(|_| self.wrong(field, Some(word)))
    }

    /// A count, and as many ranges. What a laser writes for *nothing met* (nan, inf) is kept as infinite.
    pub fn ranges(&mut self) -> Result<Vec<f32>, LogProblem> {
        let count = self.count(Field::RangeCount)?;
        let mut ranges = Vec::with_capacity(count.min(MOST_BEAMS) as usize); // it may say anything
        for k in 0..count {
            let field = Field::Range { number: k + 1, of: count };
            let word = self.word(field)?;
            let range = match number(word).filter(|range| !range.is_nan()) {
                Some(range) => range as f32,
                None if is_no_number(word) => f32::INFINITY,
                None => return Err(self.wrong(field, Some(word))),
            };
            ranges.push(range);
        }
        Ok(ranges)
    }

    /// A pose, and the same with its heading as it is told.
    pub fn pose(&mut self, names: &'static str) -> Result<(Pose2, [f64; 3]), LogProblem> {
        let found @ [x, y, theta] = [self.number(names)?, self.number(names)?, self.number(names)?];
        if x.abs().max(y.abs()) > LaserScan::FARTHEST || theta.abs() > LaserScan::FARTHEST {
            return Err(LogProblem::Far { message: self.kind, names, found });
        }
        Ok((Pose2::new(x, y, theta), found))
    }

    /// The first stamp at the end of the line.
    pub fn time(&mut self) -> Result<f64, LogProblem> {
        self.value(Field::Time)
    }
}

fn is_no_number(word: &str) -> bool {
    let unsigned = word.trim_start_matches(['-', '+']);
    ["nan", "inf", "infinity"].iter().any(|name| unsigned.eq_ignore_ascii_case(name))
}

/// A word as a message shows it: the start of it, without control characters.
pub(super) fn shown(word: &str) -> String {
    const MOST: usize = 24;
    let start: String = word.chars().take(MOST).flat_map(char::escape_debug).collect();
    if word.chars().count() > MOST { format!("“{start}…”") } else { format!("“{start}”") }
}
