//! What many runs come to: quantiles and shares, and how far they are to be trusted.

/// The q-quantile of ascending values, interpolated linearly between neighbours (type 7 of Hyndman and Fan 1996).
pub fn quantile(ascending: &[f64], q: f64) -> f64 {
    let position = q * (ascending.len() - 1) as f64;
    let (low, share) = (position.floor() as usize, position - position.floor());
    let next = ascending[(low + 1).min(ascending.len() - 1)];
    if share == 0.0 || next == ascending[low] {
        ascending[low]
    } else {
        ascending[low] + share * (next - ascending[low])
    }
}

/// A 95 % confidence interval of the median of which these ascending values are a sample: the two order statistics as near the
/// middle as that allows. It holds for any distribution, since the number of values below the true median is that of heads in n
/// throws of a coin. Of fewer than six values the least and the greatest are as near to 95 % as they come.
///
/// Of 10 and of 200 values it is that of R's `qbinom(0.025, n, 0.5)`:
///
/// ```
/// use fastslam_lab::experiment::median_interval;
/// let values = |n: u32| (1..n + 1).map(f64::from).collect::<Vec<_>>();
/// assert_eq!(median_interval(&values(10)), [2.0, 9.0]);
/// assert_eq!(median_interval(&values(200)), [86.0, 115.0]);
/// ```
pub fn median_interval(ascending: &[f64]) -> [f64; 2] {
    let n = ascending.len();
    // P(k heads), from k = 0 upward. Halving is exact; beyond a thousand values it underflows, and the interval is too wide.
    let mut probability = (0..n).fold(1.0, |p, _| 0.5 * p);
    let (mut below, mut rank) = (probability, 0);
    while below <= 0.025 && rank < n / 2 {
        rank += 1;
        probability *= (n - rank + 1) as f64 / rank as f64;
        below += probability;
    }
    let rank = rank.max(1);
    [ascending[rank - 1], ascending[n - rank]]
}

/// What the errors of many runs come to.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ErrorSummary {
    /// Median.
    pub median: f64,
    /// Its 95 % confidence interval.
    pub median_interval: [f64; 2],
    /// 90th percentile.
    pub p90: f64,
    /// Largest.
    pub worst: f64,
}

impl ErrorSummary {
    /// Of these values, in any order.
    ///
    /// # Panics
    /// Without any value.
    pub fn of(values: &[f64]) -> Self {
        // By insertion, which for the hundreds of values there are takes no time: std's sort would be 2 KB of the page.
        let mut ascending: Vec<f64> = Vec::with_capacity(values.len());
        for value in values {
            ascending.insert(ascending.partition_point(|other| other.total_cmp(value).is_lt()), *value);
        }
        let [median, p90, worst] = [0.5, 0.9, 1.0].map(|q| quantile(&ascending, q));
        Self { median, median_interval: median_interval(&ascending), p90, worst }
    }
}

/// Successes among so many trials.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Fraction {
    /// How many succeeded.
    pub successes: u32,
    /// Of how many.
    pub total: u32,
}

impl Fraction {
    /// How many of these are true.
    pub fn of(trials: impl Iterator<Item = bool>) -> Self {
        trials.fold(Self { successes: 0, total: 0 }, |Self { successes, total }, success| Self {
            successes: successes + u32::from(success),
            total: total + 1,
        })
    }

    /// The share.
    pub fn share(&self) -> f64 {
        f64::from(self.successes) / f64::from(self.total)
    }

    /// 95 % confidence interval of the share, by Wilson's score (1927): unlike the plain one it never leaves \[0, 1\], and holds
    /// for shares near its ends.
    ///
    /// ```
    /// let [low, high] = fastslam_lab::experiment::Fraction { successes: 8, total: 10 }.wilson();
    /// assert!((low - 0.4902).abs() < 1e-4 && (high - 0.9433).abs() < 1e-4);
    /// ```
    pub fn wilson(&self) -> [f64; 2] {
        const Z: f64 = 1.959_963_984_540_054; // Φ⁻¹(0.975)
        if self.total == 0 {
            return [0.0, 1.0];
        }
        let (n, p) = (f64::from(self.total), self.share());
        let middle = (p + Z * Z / (2.0 * n)) / (1.0 + Z * Z / n);
        let half = Z / (1.0 + Z * Z / n) * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        [(middle - half).max(0.0), (middle + half).min(1.0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::random::{Purpose, Stream};

    #[test]
    fn quantiles_interpolate() {
        let values = [1.0, 2.0, 3.0, 5.0];
        assert_eq!([0.0, 0.5, 0.9, 1.0].map(|q| quantile(&values, q)), [1.0, 2.5, 3.0 + 2.0 * (0.9 * 3.0 - 2.0), 5.0]);
        assert_eq!(quantile(&[7.0], 0.9), 7.0);
    }

    #[test]
    fn of_few_values_the_interval_is_all_of_them() {
        assert_eq!(median_interval(&[3.0]), [3.0, 3.0]);
        assert_eq!(median_interval(&[1.0, 2.0, 3.0, 4.0, 5.0]), [1.0, 5.0]);
        assert_eq!(median_interval(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), [1.0, 6.0]); // 96.9 %
    }

    /// 40 values, of which the interval is from the 14th to the 27th and holds 96.2 % (1 − 2 P(at most 13 heads)); α = 0.001 two-sided,
    /// n = 2000 samples of a skewed distribution.
    #[test]
    fn the_interval_holds_the_true_median_as_often_as_it_says() {
        let held = (0..2000)
            .filter(|&sample| {
                let mut stream = Stream::at(1, Purpose::TRIAL, sample, 0);
                let mut values: Vec<f64> = (0..40).map(|_| stream.uniform()).map(|u| u * u).collect();
                values.sort_unstable_by(f64::total_cmp);
                let [low, high] = median_interval(&values);
                low <= 0.25 && 0.25 <= high
            })
            .count() as f64;
        assert!((held / 2000.0 - 0.9615).abs() < 3.29 * (0.9615 * 0.0385 / 2000.0_f64).sqrt(), "{held}");
    }

    #[test]
    fn a_spread_does_not_depend_on_the_order() {
        let values = [0.4, 0.1, 2.0, 0.3, 0.2];
        let mut turned = values;
        turned.reverse();
        assert_eq!(ErrorSummary::of(&values), ErrorSummary::of(&turned));
        let ErrorSummary { median, median_interval, worst, .. } = ErrorSummary::of(&values);
        assert_eq!((median, median_interval, worst), (0.3, [0.1, 2.0], 2.0));
    }

    /// Values of R's `prop.test(x, n, correct = FALSE)`.
    #[test]
    fn intervals_stay_within_zero_and_one() {
        let interval = |successes, total| Fraction { successes, total }.wilson();
        assert_eq!(interval(0, 0), [0.0, 1.0]);
        let [low, high] = interval(0, 20);
        assert!(low == 0.0 && (high - 0.1611).abs() < 1e-4, "{low} {high}");
        let [low, high] = interval(20, 20);
        assert!((low - 0.8389).abs() < 1e-4 && high == 1.0, "{low} {high}");
    }
}
