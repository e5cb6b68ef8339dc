//! The chain of steps from a sighting to a weight and a new landmark, as a textbook writes it.

use crate::font::Weight;
use crate::scene::{Formula, Role, number};
use crate::words::worked_example;
use fastslam::nalgebra::{Matrix2, Vector2};
use fastslam_lab::experiment::worked_example::WorkedExample;

/// One line of the chain.
pub struct Step {
    /// What it is, with its unit in brackets.
    pub caption: fn() -> &'static str,
    /// Its formula, as [`Formula::tex`] takes it.
    pub formula: &'static str,
    /// Whether it has two rows.
    pub tall: bool,
    /// Writes its value for the particle in this slot.
    pub write: fn(&Writing, &WorkedExample, usize) -> Formula,
}

impl Step {
    /// What the formula is of, as a formula too.
    pub fn symbol(&self) -> &'static str {
        let name = |formula: &'static str, sign| formula.split(sign).next().unwrap_or_default();
        name(name(self.formula, " = "), " ← ")
    }

    /// The unit that its caption tells.
    pub fn unit(&self) -> Option<&'static str> {
        let (_, unit) = (self.caption)().split_once('[')?;
        unit.split(']').next()
    }
}

/// How values are written where there is so much room.
#[derive(Clone, Copy, Debug)]
pub struct Writing {
    /// Font size \[css px\].
    pub size: f64,
    /// Significant digits.
    pub digits: i32,
    /// Only the result of a step, not how it comes about.
    pub brief: bool,
}

impl Writing {
    /// An empty line.
    pub fn line(&self) -> Formula {
        Formula::new(self.size, Weight::Regular, Role::Ink)
    }

    fn number(&self, x: f64) -> Formula {
        self.line().tex(&number(x, self.digits))
    }

    /// A number above 0, though it may be too small to be told from it.
    fn positive(&self, x: f64) -> Formula {
        if x > 0.0 { self.number(x) } else { self.line().tex("≈ 0") }
    }

    fn vector(&self, line: Formula, vector: &Vector2<f64>) -> Formula {
        line.matrix(vector.as_slice(), 1, self.digits)
    }

    fn matrix(&self, matrix: &Matrix2<f64>) -> Formula {
        // Kept column by column and written row by row.
        self.line().matrix(matrix.transpose().as_slice(), 2, self.digits)
    }
}

/// What both particles begin with.
pub const GIVEN: &[Step] = &[
    Step {
        caption: worked_example::landmark,
        formula: "μ",
        tall: true,
        write: |to, e, _| to.vector(to.line(), &e.before.mean),
    },
    Step {
        caption: worked_example::covariance,
        formula: "Σ",
        tall: true,
        write: |to, e, _| to.matrix(&e.before.covariance),
    },
    Step { caption: worked_example::noise, formula: "Q", tall: true, write: |to, e, _| to.matrix(&e.noise) },
];

const INNOVATION: Step = Step {
    caption: worked_example::innovation_step,
    formula: "ν = z − z\u{302}",
    tall: true,
    write: |to, e, slot| {
        let update = &e.updates[slot];
        let (z, innovation) = (update.z, update.innovation);
        if to.brief {
            return to.vector(to.line(), &innovation.residual);
        }
        let difference = to.vector(to.vector(to.line(), &z).tex(" − "), &innovation.prediction.z);
        to.vector(difference.tex(" = "), &innovation.residual)
    },
};

const INNOVATION_COVARIANCE: Step = Step {
    caption: worked_example::innovation_covariance,
    formula: "S = H_m Σ H_m^T + Q",
    tall: true,
    write: |to, e, slot| to.matrix(&e.updates[slot].innovation.covariance),
};

const DISTANCE: Step = Step {
    caption: worked_example::distance,
    formula: "d^2 = ν^T S^{−1} ν",
    tall: false,
    write: |to, e, slot| to.number(e.updates[slot].innovation.mahalanobis_squared),
};

const WEIGHT: Step = Step {
    caption: worked_example::weight,
    formula: "w = |2πS|^{−1/2} exp(−½ d^2)",
    tall: false,
    write: |to, e, slot| to.positive(e.updates[slot].weight),
};

const MEAN_AFTER: Step = Step {
    caption: worked_example::landmark_after,
    formula: "μ ← μ + K ν",
    tall: true,
    write: |to, e, slot| to.vector(to.line(), &e.updates[slot].after.mean),
};

/// What decides: how large the surprise is, how large it may fairly be, the one measured against the other, what the particle is
/// worth, and what it has learnt.
pub const FIVE_STEPS: &[Step] = &[INNOVATION, INNOVATION_COVARIANCE, DISTANCE, WEIGHT, MEAN_AFTER];

/// All that each computes.
pub const STEPS: &[Step] = &[
    Step {
        caption: worked_example::pose,
        formula: "x = (x, y, θ)",
        tall: false,
        write: |to, e, slot| {
            let pose = e.updates[slot].world_from_robot;
            let [x, y, theta] = [pose.x, pose.y, pose.theta].map(|x| number(x, to.digits));
            to.line().tex(&format!("({x}, {y}, {theta})"))
        },
    },
    Step {
        caption: worked_example::expected,
        formula: "z\u{302} = h(x, μ)",
        tall: true,
        write: |to, e, slot| to.vector(to.line(), &e.updates[slot].innovation.prediction.z),
    },
    INNOVATION,
    Step {
        caption: worked_example::derivative,
        formula: "H_m = ∂h/∂m",
        tall: true,
        write: |to, e, slot| to.matrix(&e.updates[slot].innovation.prediction.h_m),
    },
    INNOVATION_COVARIANCE,
    Step {
        caption: worked_example::determinant,
        formula: "det S",
        tall: false,
        write: |to, e, slot| to.number(e.updates[slot].innovation.determinant()),
    },
    Step {
        caption: worked_example::inverse,
        formula: "S^{−1}",
        tall: true,
        write: |to, e, slot| to.matrix(&e.updates[slot].innovation.inverse),
    },
    DISTANCE,
    Step {
        caption: worked_example::log_weight,
        formula: "ln w = −½ (d^2 + ln |2πS|)",
        tall: false,
        write: |to, e, slot| to.number(e.updates[slot].innovation.log_likelihood()),
    },
    WEIGHT,
    Step {
        caption: worked_example::gain,
        formula: "K = Σ H_m^T S^{−1}",
        tall: true,
        write: |to, e, slot| to.matrix(&e.updates[slot].gain),
    },
    MEAN_AFTER,
    Step {
        caption: worked_example::covariance_after,
        formula: "Σ ← (I − K H_m) Σ",
        tall: true,
        write: |to, e, slot| to.matrix(&e.updates[slot].after.covariance),
    },
    Step {
        caption: worked_example::share,
        formula: "w\u{303} = w / Σ w",
        tall: false,
        write: |to, e, slot| to.positive(e.weights.as_slice()[slot]),
    },
];
