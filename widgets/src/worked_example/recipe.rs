//! What a reader can set: all numbers that the example begins with.

use crate::{
    decimal::{significant, write},
    field,
    model::FigureError,
    param::quoted,
    recipe::{self, Param},
};
use fastslam_lab::experiment::worked_example::Inputs;

type Range = (f64, f64, f64);

const PLACE: Range = (-100.0, 100.0, 0.1);
const ANGLE: Range = (-6.3, 6.3, 0.05);
const DISTANCE: Range = (0.0, 200.0, 0.1);
const VARIANCE: Range = (0.000_001, 100.0, 0.01);

impl recipe::Recipe for Inputs {
    fn table() -> Vec<Param<Self>> {
        table()
    }

    /// A covariance is positive definite: its three numbers are judged together.
    fn refuse(&mut self, before: &Self) -> Vec<FigureError> {
        let [xx, xy, yy] = self.covariance;
        if xy * xy < xx * yy {
            return Vec::new();
        }
        let bound = plain((xx * yy).sqrt(), 4);
        let allowed = [
            ("sigma-xx", format!("more than {}", plain(xy * xy / yy, 4))),
            ("sigma-xy", format!("between -{bound} and {bound}")),
            ("sigma-yy", format!("more than {}", plain(xy * xy / xx, 4))),
        ];
        let mut refused = Vec::new();
        for (k, (name, allowed)) in allowed.into_iter().enumerate() {
            if self.covariance[k] != before.covariance[k] {
                let allowed = format!("{allowed} m², so that Σ is positive definite");
                refused.push(FigureError::new(name, quoted(&write(self.covariance[k])), allowed));
                self.covariance[k] = before.covariance[k];
            }
        }
        refused
    }
}

/// A number as plain text, with so many significant digits.
pub fn plain(x: f64, digits: i32) -> String {
    match significant(x, digits) {
        (number, 0) => number,
        (number, exponent) => format!("{number}e{exponent}"),
    }
}

#[rustfmt::skip]
fn table() -> Vec<Param<Inputs>> {
    type P = Param<Inputs>;
    let rows = vec![
        P::number("x1", "Pose 1, x", "m", PLACE, field!(poses[0][0]), "Where particle 1 stands."),
        P::number("y1", "Pose 1, y", "m", PLACE, field!(poses[0][1]), "Where particle 1 stands."),
        P::number("theta1", "Pose 1, θ", "rad", ANGLE, field!(poses[0][2]), "Where particle 1 looks, counter-clockwise from the x axis."),
        P::number("x2", "Pose 2, x", "m", PLACE, field!(poses[1][0]), "Where particle 2 stands."),
        P::number("y2", "Pose 2, y", "m", PLACE, field!(poses[1][1]), "Where particle 2 stands."),
        P::number("theta2", "Pose 2, θ", "rad", ANGLE, field!(poses[1][2]), "Where particle 2 looks, counter-clockwise from the x axis."),
        P::number("r1", "Range 1", "m", DISTANCE, field!(sightings[0][0]), "How far away particle 1 sees the landmark."),
        P::number("phi1", "Bearing 1", "rad", ANGLE, field!(sightings[0][1]), "In which direction particle 1 sees it, from straight ahead to the left."),
        P::number("r2", "Range 2", "m", DISTANCE, field!(sightings[1][0]), "How far away particle 2 sees the landmark."),
        P::number("phi2", "Bearing 2", "rad", ANGLE, field!(sightings[1][1]), "In which direction particle 2 sees it, from straight ahead to the left."),
        P::number("mu-x", "μ, x", "m", PLACE, field!(mean[0]), "Where both believe the landmark to be."),
        P::number("mu-y", "μ, y", "m", PLACE, field!(mean[1]), "Where both believe the landmark to be."),
        P::number("sigma-xx", "Σ, xx", "m²", VARIANCE, field!(covariance[0]), "Variance of the landmark's x before the sighting."),
        P::number("sigma-xy", "Σ, xy", "m²", PLACE, field!(covariance[1]), "Covariance of the landmark's x and y: both off-diagonal entries."),
        P::number("sigma-yy", "Σ, yy", "m²", VARIANCE, field!(covariance[2]), "Variance of the landmark's y before the sighting."),
        P::number("range-std", "Range σ", "m", (0.001, 10.0, 0.05), field!(noise_std[0]), "Standard deviation of a measured range: its square is in Q."),
        P::number("bearing-std", "Bearing σ", "rad", (0.001, 3.0, 0.01), field!(noise_std[1]), "Standard deviation of a measured bearing: its square is in Q."),
        P::number("threshold", "Threshold", "of M", (0.0, 1.0, 0.05), field!(threshold), "Share of M below which N_eff calls for resampling."),
    ];
    rows.into_iter().map(P::without_slider).collect()
}
