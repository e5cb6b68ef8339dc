//! The chain of steps from a sighting to a weight and a new landmark, as a textbook writes it.
//!
//! Matrices are transposed on their way: they are kept column by column and written row by row.

use crate::scene::{Formula, number};
use crate::words::worked_example;
use fastslam_lab::experiment::worked_example::WorkedExample;

/// Significant digits of what is shown.
pub const DIGITS: i32 = 5;

/// One line of the chain.
pub struct Step {
    /// What it is, with its unit.
    pub caption: fn() -> &'static str,
    /// Its formula, as [`Formula::tex`] takes it.
    pub formula: &'static str,
    /// Whether it has two rows.
    pub tall: bool,
    /// Writes its value for the particle in this slot.
    pub write: fn(Formula, &WorkedExample, usize) -> Formula,
}

/// What both particles begin with.
pub const GIVEN: &[Step] = &[
    Step {
        caption: worked_example::landmark,
        formula: "μ",
        tall: true,
        write: |line, e, _| line.matrix(e.before.mean.as_slice(), 1, DIGITS),
    },
    Step {
        caption: worked_example::covariance,
        formula: "Σ",
        tall: true,
        write: |line, e, _| line.matrix(e.before.covariance.transpose().as_slice(), 2, DIGITS),
    },
    Step {
        caption: worked_example::noise,
        formula: "Q",
        tall: true,
        write: |line, e, _| line.matrix(e.noise.transpose().as_slice(), 2, DIGITS),
    },
];

/// What each computes.
pub const STEPS: &[Step] = &[
    Step {
        caption: worked_example::pose,
        formula: "x = (x, y, θ)",
        tall: false,
        write: |line, e, slot| {
            let pose = e.updates[slot].world_from_robot;
            let [x, y, theta] = [pose.x, pose.y, pose.theta].map(|x| number(x, DIGITS));
            line.tex(&format!("({x}, {y}, {theta})"))
        },
    },
    Step {
        caption: worked_example::expected,
        formula: "z\u{302} = h(x, μ)",
        tall: true,
        write: |line, e, slot| line.matrix(e.updates[slot].innovation.prediction.z.as_slice(), 1, DIGITS),
    },
    Step {
        caption: worked_example::innovation_step,
        formula: "ν = z − z\u{302}",
        tall: true,
        write: |line, e, slot| {
            let update = &e.updates[slot];
            let (z, innovation) = (update.z, update.innovation);
            line.matrix(z.as_slice(), 1, DIGITS)
                .tex(" − ")
                .matrix(innovation.prediction.z.as_slice(), 1, DIGITS)
                .tex(" = ")
                .matrix(innovation.residual.as_slice(), 1, DIGITS)
        },
    },
    Step {
        caption: worked_example::derivative,
        formula: "H_m = ∂h/∂m",
        tall: true,
        write: |line, e, slot| line.matrix(e.updates[slot].innovation.prediction.h_m.transpose().as_slice(), 2, DIGITS),
    },
    Step {
        caption: worked_example::innovation_covariance,
        formula: "S = H_m Σ H_m^T + Q",
        tall: true,
        write: |line, e, slot| line.matrix(e.updates[slot].innovation.covariance.transpose().as_slice(), 2, DIGITS),
    },
    Step {
        caption: worked_example::determinant,
        formula: "det S",
        tall: false,
        write: |line, e, slot| line.tex(&number(e.updates[slot].innovation.determinant(), DIGITS)),
    },
    Step {
        caption: worked_example::inverse,
        formula: "S^{−1}",
        tall: true,
        write: |line, e, slot| line.matrix(e.updates[slot].innovation.inverse.transpose().as_slice(), 2, DIGITS),
    },
    Step {
        caption: worked_example::distance,
        formula: "d^2 = ν^T S^{−1} ν",
        tall: false,
        write: |line, e, slot| line.tex(&number(e.updates[slot].innovation.mahalanobis_squared, DIGITS)),
    },
    Step {
        caption: worked_example::log_weight,
        formula: "ln w = −½ (d^2 + ln |2πS|)",
        tall: false,
        write: |line, e, slot| line.tex(&number(e.updates[slot].innovation.log_likelihood, DIGITS)),
    },
    Step {
        caption: worked_example::weight,
        formula: "w = |2πS|^{−1/2} exp(−½ d^2)",
        tall: false,
        write: |line, e, slot| line.tex(&positive(e.updates[slot].weight)),
    },
    Step {
        caption: worked_example::gain,
        formula: "K = Σ H_m^T S^{−1}",
        tall: true,
        write: |line, e, slot| line.matrix(e.updates[slot].gain.transpose().as_slice(), 2, DIGITS),
    },
    Step {
        caption: worked_example::landmark_after,
        formula: "μ ← μ + K ν",
        tall: true,
        write: |line, e, slot| line.matrix(e.updates[slot].after.mean.as_slice(), 1, DIGITS),
    },
    Step {
        caption: worked_example::covariance_after,
        formula: "Σ ← (I − K H_m) Σ",
        tall: true,
        write: |line, e, slot| line.matrix(e.updates[slot].after.covariance.transpose().as_slice(), 2, DIGITS),
    },
    Step {
        caption: worked_example::share,
        formula: "w\u{303} = w / Σ w",
        tall: false,
        write: |line, e, slot| line.tex(&positive(e.weights.as_slice()[slot])),
    },
];

/// A number above 0, though it may be too small to be told from it.
fn positive(x: f64) -> String {
    if x > 0.0 { number(x, DIGITS) } else { "≈ 0".into() }
}
