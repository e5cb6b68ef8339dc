//! Elementary functions that give the same bits natively and in WebAssembly (tested on x86-64 and in Chromium; nothing in them
//! depends on more than IEEE 754).
//!
//! `f64::sin` and its kin call the platform's mathematics library, and libraries disagree in the last bit: the difference
//! grows through a filter until two runs resample differently. Everything here goes through the [`libm`] crate, compiled
//! from the same source for native and for WebAssembly. Square root, floor and the four operations are exact in IEEE 754 and
//! need no wrapper; `clippy.toml` bans the rest.

use core::f64::consts::{PI, TAU};

/// ln 2π, to the bit what [`ln`] says of it.
pub(crate) const LN_TAU: f64 = 1.837_877_066_409_345_3;

/// Sine of an angle \[rad\].
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of an angle \[rad\].
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Sine and cosine of an angle \[rad\].
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// Angle \[rad\] in (−π, π] of the vector (x, y).
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// eˣ.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// 2/√π ∫₀ˣ exp(−t²) dt: a normal deviate stays within ±x √2 standard deviations with this probability.
pub fn erf(x: f64) -> f64 {
    libm::erf(x)
}

/// √(x² + y²) without overflow.
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// Wraps an angle \[rad\] to (−π, π].
///
/// ```
/// use std::f64::consts::PI;
/// assert_eq!(fastslam::ops::wrap_angle(-PI), PI);
/// assert!((fastslam::ops::wrap_angle(7.0) - (7.0 - 2.0 * PI)).abs() < 1e-15);
/// ```
pub fn wrap_angle(x: f64) -> f64 {
    if -PI < x && x <= PI {
        return x; // the common case, and exact
    }
    let y = x - TAU * (x / TAU).round();
    if y <= -PI {
        PI // the one end that is left out, or a last bit past it
    } else if y > PI {
        y - TAU
    } else {
        y
    }
}

/// ln Σ exp(xᵢ) of log values \[nats\], shifted by the largest so that nothing overflows; −∞ for no values, or all −∞;
/// +∞ where one is.
pub fn log_sum_exp(log_values: &[f64]) -> f64 {
    let max = log_values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if max.is_infinite() {
        return max;
    }
    max + ln(log_values.iter().map(|x| exp(x - max)).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrapped_angles_lie_in_the_half_open_interval() {
        for k in -1000..1000 {
            let x = f64::from(k) * 0.1;
            let y = wrap_angle(x);
            assert!(-PI < y && y <= PI, "{x} wrapped to {y}");
            assert!((sin(x) - sin(y)).abs() < 1e-12 && (cos(x) - cos(y)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_logarithm_of_a_turn_is_what_is_written() {
        assert_eq!(LN_TAU.to_bits(), ln(TAU).to_bits());
    }

    #[test]
    fn log_sum_exp_survives_hundreds_of_orders_of_magnitude() {
        assert!((log_sum_exp(&[-2000.0, -2000.0]) - (-2000.0 + ln(2.0))).abs() < 1e-12);
        assert_eq!(log_sum_exp(&[f64::NEG_INFINITY]), f64::NEG_INFINITY);
        assert_eq!(log_sum_exp(&[]), f64::NEG_INFINITY);
        assert_eq!(log_sum_exp(&[0.0, f64::INFINITY, f64::INFINITY]), f64::INFINITY);
    }
}
