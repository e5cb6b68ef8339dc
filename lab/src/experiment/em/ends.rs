//! Where EM mapping ends: from other first guesses on the same log, and over many logs beside the filter.

use super::{Cloud, Guess, ITERATIONS, LENGTH, Log, LogSetup, again, iterate};
use crate::baseline::em_mapping::{DoorMap, Expectation};
use fastslam::error::SettingError;
use fastslam::random::{Purpose, Stream};

/// How many other first guesses are tried on a log.
pub const OTHERS: u32 = 20;

/// What a first guess of [`Others`] is drawn for.
const GUESSES: Purpose = Purpose::new(101);

/// Where a climb from some other guess ended.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct End {
    /// The log posterior that it came to \[nats\].
    pub log_posterior: f64,
    /// What it says of the second ride's doors: [`again`].
    pub again: f64,
}

/// Where [`OTHERS`] other guesses end: each has its marks anywhere in the corridor, drawn for the log's seed.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Others {
    ends: Vec<End>,
}

impl Others {
    /// Those that have been tried.
    pub fn ends(&self) -> &[End] {
        &self.ends
    }

    /// How many are still to be tried.
    pub fn pending(&self) -> u32 {
        OTHERS - self.ends.len() as u32
    }

    /// Tries the next one, while there is one, for as long as it takes.
    ///
    /// # Errors
    /// None for a log that there is.
    pub fn advance(&mut self, log: &Log) -> Result<(), SettingError> {
        if self.pending() == 0 {
            return Ok(());
        }
        let mut stream = Stream::at(log.setup.seed, GUESSES, self.ends.len() as u32, 0);
        let marks = core::array::from_fn(|_| LENGTH * stream.uniform());
        let first = Guess { marks, trust: 1.0 }.first_map()?;
        self.ends.push(end(log, first)?);
        Ok(())
    }
}

/// Result of [`ITERATIONS`] iterations from a first map.
pub(super) fn end(log: &Log, first: DoorMap) -> Result<End, SettingError> {
    let mut passes = Expectation::of(first, &log.ride)?;
    for _ in 0..ITERATIONS {
        passes.iterate(&log.ride);
    }
    let put_down = passes.product(log.carried).unwrap_or_default();
    Ok(End { log_posterior: iterate(&passes).log_posterior, again: again(&put_down) })
}

/// What a log came to, by both methods.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Outcome {
    /// Where EM mapping ends from [`Guess::default`], and from [`FOLDING`].
    pub ends: [End; 2],
    /// Where it ends at best from one of the [`OTHERS`], and how many of them end within half a nat of the best of all.
    pub best: (f64, u32),
    /// The share of the particles' weight that has the first two doors come again.
    pub again: f64,
}

/// A guess that takes the second door and the third for one, and is else the default.
pub const FOLDING: Guess = Guess { marks: [2.6, 5.2, 5.2], trust: 1.0 };

/// Both methods on the log of a setting.
///
/// # Errors
/// Where a setting is out of its range.
pub fn outcome(setup: &LogSetup) -> Result<Outcome, SettingError> {
    let log = Log::new(setup)?;
    let last = |guess: &Guess| end(&log, guess.first_map()?);
    let ends = [last(&Guess::default())?, last(&FOLDING)?];
    let (mut others, mut cloud) = (Others::default(), Cloud::new(&log)?);
    while others.pending() > 0 {
        others.advance(&log)?;
    }
    while cloud.pending(&log) > 0 {
        cloud.advance(&log);
    }
    let all = || others.ends().iter().map(|end| end.log_posterior);
    let best = all().chain(ends.map(|end| end.log_posterior)).fold(f64::MIN, f64::max);
    let near = all().filter(|found| best - found < 0.5).count() as u32;
    let again = again(cloud.shares(log.carried).unwrap_or_default());
    Ok(Outcome { ends, best: (best, near), again })
}
