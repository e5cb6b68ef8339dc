//! The order of values. One sort serves all figures: each that is compiled weighs kilobytes in a browser.

/// The indices of these values from the least to the largest, equals as they stand.
pub fn ascending(values: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    order
}
