//! What a reader can set: all numbers that the example begins with.

use crate::model::ParamSpec;
use fastslam_lab::experiment::worked_example::Inputs;

/// How many there are.
pub const COUNT: usize = 18;

/// Indices of Σ_xx, Σ_xy and Σ_yy.
pub const SIGMA: [usize; 3] = [12, 13, 14];

type Range = (f64, f64, f64);

const PLACE: Range = (-100.0, 100.0, 0.1);
const ANGLE: Range = (-6.3, 6.3, 0.05);
const DISTANCE: Range = (0.0, 200.0, 0.1);
const VARIANCE: Range = (0.000_001, 100.0, 0.01);

/// Name, title, unit, range, help; in the order of [`values`].
#[rustfmt::skip]
const ROWS: [(&str, &str, &str, Range, &str); COUNT] = [
    ("x1", "Pose 1, x", "m", PLACE, "Where particle 1 stands."),
    ("y1", "Pose 1, y", "m", PLACE, "Where particle 1 stands."),
    ("theta1", "Pose 1, θ", "rad", ANGLE, "Where particle 1 looks, counter-clockwise from the x axis."),
    ("x2", "Pose 2, x", "m", PLACE, "Where particle 2 stands."),
    ("y2", "Pose 2, y", "m", PLACE, "Where particle 2 stands."),
    ("theta2", "Pose 2, θ", "rad", ANGLE, "Where particle 2 looks, counter-clockwise from the x axis."),
    ("r1", "Range 1", "m", DISTANCE, "How far away particle 1 sees the landmark."),
    ("phi1", "Bearing 1", "rad", ANGLE, "In which direction particle 1 sees it, from straight ahead to the left."),
    ("r2", "Range 2", "m", DISTANCE, "How far away particle 2 sees the landmark."),
    ("phi2", "Bearing 2", "rad", ANGLE, "In which direction particle 2 sees it, from straight ahead to the left."),
    ("mu-x", "μ, x", "m", PLACE, "Where both believe the landmark to be."),
    ("mu-y", "μ, y", "m", PLACE, "Where both believe the landmark to be."),
    ("sigma-xx", "Σ, xx", "m²", VARIANCE, "Variance of the landmark's x before the sighting."),
    ("sigma-xy", "Σ, xy", "m²", PLACE, "Covariance of the landmark's x and y: both off-diagonal entries."),
    ("sigma-yy", "Σ, yy", "m²", VARIANCE, "Variance of the landmark's y before the sighting."),
    ("range-std", "Range σ", "m", (0.001, 10.0, 0.05), "Standard deviation of a measured range: its square is in Q."),
    ("bearing-std", "Bearing σ", "rad", (0.001, 3.0, 0.01), "Standard deviation of a measured bearing: its square is in Q."),
    ("threshold", "Threshold", "of M", (0.0, 1.0, 0.05), "Share of M below which N_eff calls for resampling."),
];

/// All parameters.
pub fn specs() -> Vec<ParamSpec> {
    let spec = |(&(name, title, unit, range, help), default): (&_, f64)| {
        ParamSpec::number(name, title, unit, range, default, help).without_slider()
    };
    ROWS.iter().zip(values(&Inputs::default())).map(spec).collect()
}

/// The inputs as a list.
pub fn values(inputs: &Inputs) -> [f64; COUNT] {
    let Inputs { poses, sightings, mean, covariance, noise_std, threshold } = inputs;
    let lists = [poses.as_flattened(), sightings.as_flattened(), mean, covariance, noise_std, &[*threshold]];
    let mut values = lists.into_iter().flatten().copied();
    [(); COUNT].map(|()| values.next().unwrap_or_default())
}

/// The list as inputs.
pub fn inputs(values: &[f64; COUNT]) -> Inputs {
    let [x1, y1, theta1, x2, y2, theta2, r1, phi1, r2, phi2, x, y, xx, xy, yy, r, phi, threshold] = *values;
    Inputs {
        poses: [[x1, y1, theta1], [x2, y2, theta2]],
        sightings: [[r1, phi1], [r2, phi2]],
        mean: [x, y],
        covariance: [xx, xy, yy],
        noise_std: [r, phi],
        threshold,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_and_values_are_the_same_numbers() {
        let list: [f64; COUNT] = core::array::from_fn(|k| k as f64);
        assert_eq!(values(&inputs(&list)), list);
    }
}
