//! The setting that is compared with the one of now, as far as it is drawn behind it: its curves. What they are is each model's own.

/// Curves of a run, each as a row of numbers.
pub type Curves = Vec<Vec<f64>>;

/// A curve by its rank; one without any numbers where there is none.
pub fn curve(curves: &[Vec<f64>], rank: usize) -> &[f64] {
    curves.get(rank).map_or(&[], Vec::as_slice)
}
