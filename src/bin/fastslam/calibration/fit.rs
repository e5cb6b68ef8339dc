//! A robust regression of an effect on two causes, and how sure it is.

use nalgebra::{Matrix2, Vector2};

/// Fewest samples that say anything.
pub const FEWEST: usize = 100;

/// Standard errors by which a calibration is off, at least, where a word is said of it.
const SURE: f64 = 4.0;

/// An effect that is linear in two causes, at a time \[s\].
pub struct Sample {
    pub time: f64,
    pub causes: Vector2<f64>,
    pub effect: f64,
}

impl Sample {
    fn residual(&self, value: &Vector2<f64>) -> f64 {
        self.effect - self.causes.dot(value)
    }
}

/// What the effects are of each cause, by least squares without outliers, with standard errors by a jackknife over stretches of time: errors of measurements
/// that follow each other may be as dependent as they like.
pub struct Fit {
    pub value: Vector2<f64>,
    std: Vector2<f64>,
}

/// How many stretches of time, each of which is left out once.
const STRETCHES: usize = 20;

/// Residuals of more median absolute residuals are outliers: three and a half standard deviations of normal ones.
const BEYOND: f64 = 5.2;

/// Least share of the samples that are no outliers.
const AGREEING: f64 = 0.6;

impl Fit {
    /// `None` where samples are too few, or too many of them outliers.
    pub fn of(samples: Vec<Sample>) -> Option<Self> {
        if samples.len() < FEWEST {
            return None;
        }
        let mut kept: Vec<&Sample> = samples.iter().collect();
        for _ in 0..4 {
            let value = Sums::of(&kept).solve()?;
            let mut off: Vec<f64> = samples.iter().map(|sample| sample.residual(&value).abs()).collect();
            off.sort_unstable_by(f64::total_cmp);
            let bound = BEYOND * off[off.len() / 2];
            kept = samples.iter().filter(|sample| sample.residual(&value).abs() <= bound).collect();
        }
        if (kept.len() as f64) < AGREEING * samples.len() as f64 {
            return None;
        }
        let [start, end] = [kept[0].time, kept[kept.len() - 1].time];
        let stretch =
            |sample: &&Sample| (((sample.time - start) / (end - start) * STRETCHES as f64) as usize).min(STRETCHES - 1);
        let mut without = Vec::new();
        for left_out in 0..STRETCHES {
            let rest: Vec<&Sample> = kept.iter().copied().filter(|sample| stretch(sample) != left_out).collect();
            if rest.len() < kept.len() {
                without.push(Sums::of(&rest).solve()?);
            }
        }
        let count = without.len() as f64;
        let mean = without.iter().sum::<Vector2<f64>>() / count;
        let spread = without.iter().map(|value| (value - mean).component_mul(&(value - mean))).sum::<Vector2<f64>>();
        let std = (spread * ((count - 1.0) / count)).map(f64::sqrt);
        (without.len() > STRETCHES / 2).then_some(Self { value: Sums::of(&kept).solve()?, std })
    }

    /// Whether the effect of a cause is surely not this one, and by more than so much.
    pub fn is_off(&self, cause: usize, expected: f64, by: f64) -> bool {
        let off = (self.value[cause] - expected).abs();
        off > by && off > SURE * self.std[cause]
    }
}

/// The normal equations.
struct Sums {
    gram: Matrix2<f64>,
    product: Vector2<f64>,
}

impl Sums {
    fn of(samples: &[&Sample]) -> Self {
        let mut sums = Self { gram: Matrix2::zeros(), product: Vector2::zeros() };
        for Sample { causes, effect, .. } in samples {
            sums.gram += causes * causes.transpose();
            sums.product += causes * *effect;
        }
        sums
    }

    fn solve(&self) -> Option<Vector2<f64>> {
        let value = self.gram.try_inverse()? * self.product;
        value.iter().all(|x| x.is_finite()).then_some(value)
    }
}
