//! The scale of ratios: logarithmic, because twice is twice anywhere.

use super::recipe::RATIOS as ENDS;
use crate::scene::Rect;
use fastslam::ops;

/// Ratios with a name on the scale.
pub const TICKS: [f64; 7] = [1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 30.0];

/// Where a ratio is on the axis \[css px\]; at the nearer end for what is beyond.
pub fn position(axis: &Rect, ratio: f64) -> f64 {
    let t = ops::ln(ratio.clamp(ENDS[0], ENDS[1])) / ops::ln(ENDS[1]);
    axis.x + t * axis.w
}

/// The ratio at a place of the axis \[css px\].
pub fn ratio(axis: &Rect, x: f64) -> f64 {
    ops::exp(((x - axis.x) / axis.w).clamp(0.0, 1.0) * ops::ln(ENDS[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_is_read_where_it_was_put() {
        let axis = Rect::new(40.0, 0.0, 300.0, 20.0);
        for at in TICKS {
            assert!((ratio(&axis, position(&axis, at)) - at).abs() < 1e-9);
        }
        assert_eq!((position(&axis, 0.1), position(&axis, 1e9)), (40.0, 340.0));
        assert!((ratio(&axis, 1e9) - 30.0).abs() < 1e-9);
    }
}
