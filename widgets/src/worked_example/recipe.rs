//! What a reader can set: all numbers that the example begins with.

use super::steps::STEPS;
use crate::{
    decimal::{significant, write},
    field,
    model::FigureError,
    param::quoted,
    recipe::{self, Param},
    words::{policy, worked_example},
};
use fastslam_lab::experiment::worked_example::Inputs;

type Range = (f64, f64, f64);

const PLACE: Range = (-100.0, 100.0, 0.1);
const ANGLE: Range = (-6.3, 6.3, 0.05);
const DISTANCE: Range = (0.0, 200.0, 0.1);
/// Of variances \[m²\], and the step of a control.
pub const VARIANCE: Range = (0.000_001, 100.0, 0.01);

/// All that a link says.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct Recipe {
    /// What the example begins with.
    pub inputs: Inputs,
    /// Whether every step is shown, not only those that decide.
    pub all_steps: bool,
    /// The step that is pointed at, from 1 on of all that there are; 0 is none.
    pub row: u32,
}

impl recipe::Recipe for Recipe {
    #[rustfmt::skip]
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let rows = vec![
            P::number("x1", worked_example::pose_1_x(), "m", PLACE, field!(inputs.poses[0][0]), worked_example::stands_1()),
            P::number("y1", worked_example::pose_1_y(), "m", PLACE, field!(inputs.poses[0][1]), worked_example::stands_1()),
            P::number("theta1", worked_example::pose_1_theta(), "rad", ANGLE, field!(inputs.poses[0][2]), worked_example::looks_1()),
            P::number("x2", worked_example::pose_2_x(), "m", PLACE, field!(inputs.poses[1][0]), worked_example::stands_2()),
            P::number("y2", worked_example::pose_2_y(), "m", PLACE, field!(inputs.poses[1][1]), worked_example::stands_2()),
            P::number("theta2", worked_example::pose_2_theta(), "rad", ANGLE, field!(inputs.poses[1][2]), worked_example::looks_2()),
            P::number("r1", worked_example::range_1(), "m", DISTANCE, field!(inputs.sightings[0][0]), worked_example::far_1()),
            P::number("phi1", worked_example::bearing_1(), "rad", ANGLE, field!(inputs.sightings[0][1]), worked_example::direction_1()),
            P::number("r2", worked_example::range_2(), "m", DISTANCE, field!(inputs.sightings[1][0]), worked_example::far_2()),
            P::number("phi2", worked_example::bearing_2(), "rad", ANGLE, field!(inputs.sightings[1][1]), worked_example::direction_2()),
            P::number("mu-x", "μ, x", "m", PLACE, field!(inputs.mean[0]), worked_example::mean_help()),
            P::number("mu-y", "μ, y", "m", PLACE, field!(inputs.mean[1]), worked_example::mean_help()),
            P::number("sigma-xx", "Σ, xx", "m²", VARIANCE, field!(inputs.covariance[0]), worked_example::sigma_xx_help()),
            P::number("sigma-xy", "Σ, xy", "m²", PLACE, field!(inputs.covariance[1]), worked_example::sigma_xy_help()),
            P::number("sigma-yy", "Σ, yy", "m²", VARIANCE, field!(inputs.covariance[2]), worked_example::sigma_yy_help()),
            P::number("range-std", worked_example::range_std(), "m", (0.001, 10.0, 0.05), field!(inputs.noise_std[0]), worked_example::range_std_help()).in_sight(),
            P::number("bearing-std", worked_example::bearing_std(), "rad", (0.001, 3.0, 0.01), field!(inputs.noise_std[1]), worked_example::bearing_std_help()).in_sight(),
            P::number("threshold", policy::threshold(), policy::of_m(), (0.0, 1.0, 0.05), field!(inputs.threshold), worked_example::threshold_help()),
        ];
        let every = P::flag("all-steps", worked_example::all_steps(), field!(all_steps), worked_example::all_steps_help()).view();
        let row = P::integer("row", worked_example::row(), "", (0, STEPS.len() as u32), field!(row), worked_example::row_help()).view().folded();
        rows.into_iter().chain([row]).map(P::without_slider).chain([every]).collect()
    }

    /// A covariance is positive definite: its three numbers are judged together.
    fn refuse(&mut self, before: &Self) -> Vec<FigureError> {
        let [xx, xy, yy] = self.inputs.covariance;
        if xy * xy < xx * yy {
            return Vec::new();
        }
        let bound = plain((xx * yy).sqrt(), 4);
        let allowed = [
            ("sigma-xx", worked_example::MoreThan { bound: &plain(xy * xy / yy, 4) }.say()),
            ("sigma-xy", worked_example::Between { bound: &bound }.say()),
            ("sigma-yy", worked_example::MoreThan { bound: &plain(xy * xy / xx, 4) }.say()),
        ];
        let mut refused = Vec::new();
        for (k, (name, allowed)) in allowed.into_iter().enumerate() {
            if self.inputs.covariance[k] != before.inputs.covariance[k] {
                refused.push(FigureError::new(name, quoted(&write(self.inputs.covariance[k])), allowed));
                self.inputs.covariance[k] = before.inputs.covariance[k];
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
