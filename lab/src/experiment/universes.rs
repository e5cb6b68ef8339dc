//! How many universes are enough: judging a number of particles by how many of some laps end well.
//!
//! A lap succeeds if it ends nearer to the truth than a threshold. The share of laps that do, over many seeds, is what a number of particles
//! is worth; a rule such as *four of five seeds* is what somebody with less time judges it by. The rule has an
//! [operating curve](Rule::passes) of its own: how often it passes a filter that succeeds with a given probability.

use super::Fraction;

/// The numbers of particles that are tried.
pub const TRIED: [usize; 11] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 40];

/// The share of laps that is to end well \[–\].
pub const ENOUGH: f64 = 0.8;

/// A lap with a smaller RMS position error of its best universe has ended well, where nothing else is said \[m\].
pub const WELL: f64 = 0.5;

/// At least four fifths of so many seeds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Rule {
    /// How many seeds are run.
    pub seeds: u32,
}

impl Rule {
    /// How many of them are to succeed.
    pub fn successes(&self) -> u32 {
        (4 * self.seeds).div_ceil(5)
    }

    /// The rule's operating curve: how probably a filter passes it that succeeds with probability p on every seed.
    ///
    /// Σ_{j ≥ k} C(n, j) pʲ (1 − p)ⁿ⁻ʲ, the upper tail of the binomial distribution, for k successes of n seeds.
    ///
    /// ```
    /// use fastslam_lab::experiment::universes::Rule;
    /// let two_of_three = Rule { seeds: 5 }.passes(2.0 / 3.0);
    /// assert!((two_of_three - 112.0 / 243.0).abs() < 1e-12);
    /// ```
    pub fn passes(&self, p: f64) -> f64 {
        // A sum of products, seed by seed: after each, how probable each number of successes is. Nothing in it can overflow.
        let mut counts = vec![0.0; self.seeds as usize + 1];
        counts[0] = 1.0;
        for _ in 0..self.seeds {
            for k in (0..counts.len()).rev() {
                let before = if k > 0 { counts[k - 1] } else { 0.0 };
                counts[k] = counts[k] * (1.0 - p) + before * p;
            }
        }
        counts.iter().skip(self.successes() as usize).sum()
    }
}

/// The rank of the first fraction that is at least [`ENOUGH`]; `None` if there is none.
pub fn sufficient(fractions: &[Fraction]) -> Option<usize> {
    fractions.iter().position(|fraction| fraction.share() >= ENOUGH)
}

/// The rank of the first fraction from which on more particles buy nothing that the seeds can tell: its 95 % interval and those of all
/// after it reach up to that of the largest share.
pub fn saturated(fractions: &[Fraction]) -> Option<usize> {
    let best = fractions.iter().map(|fraction| fraction.wilson()[0]).fold(0.0, f64::max);
    let short = fractions.iter().rposition(|fraction| fraction.wilson()[1] < best);
    let first = short.map_or(0, |rank| rank + 1);
    (first < fractions.len()).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(successes: impl IntoIterator<Item = u32>) -> Vec<Fraction> {
        successes.into_iter().map(|successes| Fraction { successes, total: 200 }).collect()
    }

    /// All 2¹⁰ outcomes of ten seeds, one by one.
    #[test]
    fn the_operating_curve_is_that_of_counting_all_outcomes() {
        for seeds in [1, 3, 5, 10] {
            for p in [0.0, 0.1, 0.5, 0.8, 1.0] {
                let probability = |outcome: u32| -> f64 {
                    (0..seeds).map(|seed| if outcome >> seed & 1 == 1 { p } else { 1.0 - p }).product()
                };
                let rule = Rule { seeds };
                let passing = (0..1_u32 << seeds).filter(|outcome| outcome.count_ones() >= rule.successes());
                let counted: f64 = passing.map(probability).sum();
                assert!((rule.passes(p) - counted).abs() < 1e-12, "{seeds} {p}: {} {counted}", rule.passes(p));
            }
        }
    }

    #[test]
    fn more_seeds_tell_sufficient_from_not_quite() {
        let passes = |seeds, p| Rule { seeds }.passes(p);
        assert!(passes(5, 2.0 / 3.0) > 0.45 && passes(50, 2.0 / 3.0) < 0.05);
        assert!(passes(50, 0.95) > 0.99 && passes(100, 0.95) > passes(50, 0.95));
    }

    #[test]
    fn the_smallest_sufficient_is_the_first_that_reaches_four_fifths() {
        assert_eq!(sufficient(&of([100, 159, 160, 155])), Some(2));
        assert_eq!(sufficient(&of([100, 159])), None);
    }

    #[test]
    fn more_buys_nothing_from_where_every_interval_reaches_that_of_the_best() {
        assert_eq!(saturated(&of([20, 100, 190, 150, 190, 196])), Some(4), "one that falls back begins it anew");
        assert_eq!(saturated(&of([200; 4])), Some(0));
        assert_eq!(saturated(&[]), None);
    }
}
