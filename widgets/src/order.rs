//! The order of values, by the one sort of the whole program: each that is compiled weighs kilobytes in a browser.

use fastslam::order::sorted;

/// The indices of these values from the least to the largest, equals as they stand.
pub fn ascending(values: &[f64]) -> Vec<usize> {
    sorted((0..values.len()).collect(), |&a, &b| values[a].total_cmp(&values[b]))
}
