//! What the chapter's figures and numbers come from: a world, a filter, and a comparison with the truth.

pub mod landmarks;
pub mod lap;
pub mod policies;
pub mod policy_counts;
pub mod table;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_interpolate() {
        let values = [1.0, 2.0, 3.0, 5.0];
        assert_eq!([0.0, 0.5, 0.9, 1.0].map(|q| quantile(&values, q)), [1.0, 2.5, 3.0 + 2.0 * (0.9 * 3.0 - 2.0), 5.0]);
        assert_eq!(quantile(&[7.0], 0.9), 7.0);
    }
}
