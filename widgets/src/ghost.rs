//! A run that a reader has pinned, as far as it is drawn behind the one that is shown: its curves.
//!
//! The page keeps them, as numbers in a row, and gives them back after a trap. What they are is each model's own.

/// Curves of a run, each as a row of numbers.
pub type Curves = Vec<Vec<f64>>;

/// All curves as one row of numbers: before each curve, how many numbers it has.
pub fn flat(curves: &[Vec<f64>]) -> Vec<f64> {
    curves.iter().flat_map(|curve| [curve.len() as f64].into_iter().chain(curve.iter().copied())).collect()
}

/// The curves of such a row. What does not fit together ends it.
pub fn curves(flat: &[f64]) -> Curves {
    let (mut curves, mut rest) = (Vec::new(), flat);
    while let Some((&count, numbers)) = rest.split_first() {
        let Some((curve, others)) = numbers.split_at_checked(count as usize) else { break };
        curves.push(curve.iter().map(|x| if x.is_finite() { *x } else { 0.0 }).collect());
        rest = others;
    }
    curves
}

/// A curve by its rank; one without any numbers where there is none.
pub fn curve(curves: &[Vec<f64>], rank: usize) -> &[f64] {
    curves.get(rank).map_or(&[], Vec::as_slice)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_come_back_as_they_were() {
        let all = vec![vec![1.0, 0.5], vec![], vec![3.0]];
        assert_eq!(curves(&flat(&all)), all);
        assert_eq!(curves(&[]), Curves::new());
    }

    #[test]
    fn numbers_that_are_no_curves_are_no_harm() {
        for numbers in [&[5.0, 1.0][..], &[-1.0, 2.0], &[f64::NAN], &[1e300], &[f64::INFINITY, 0.0]] {
            assert!(curves(numbers).iter().all(|curve| curve.len() <= numbers.len()), "{numbers:?}");
        }
    }
}
