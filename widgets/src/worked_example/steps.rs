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
    /// Symbols of what it is made of: results of steps before, and what is given.
    pub enters: &'static str,
    /// Whether it has two rows.
    pub tall: bool,
    /// Writes its value for the particle in this slot.
    pub write: fn(&Writing, &WorkedExample, usize) -> Formula,
}

impl Step {
    /// What the formula is of, as a formula too.
    pub fn symbol(&self) -> &'static str {
        before(before(self.formula, '='), '←')
    }

    /// Whether its result has this symbol. What is there after the sighting has that of before, and nothing is made of it.
    fn makes(&self, symbol: &str) -> bool {
        before(self.formula, '=') == symbol
    }

    /// Symbols of what it is made of, by steps that are shown and by what is given: of a step that is not shown, what that is made of.
    pub fn entering(&self, shown: &[Self]) -> Vec<&'static str> {
        let mut found = Vec::new();
        for symbol in self.enters.split_whitespace() {
            let hidden = STEPS.iter().find(|step| step.makes(symbol) && !step.enters.is_empty());
            let parts = match hidden.filter(|_| row_of(shown, symbol).is_none()) {
                Some(step) => step.entering(shown),
                None => vec![symbol],
            };
            for part in parts {
                if !found.contains(&part) {
                    found.push(part);
                }
            }
        }
        found
    }

    /// What it is made of, in words.
    pub fn told(&self, shown: &[Self]) -> String {
        let plain = |symbol| match symbol {
            "d^2" => "d²",
            "S^{−1}" => "S⁻¹",
            "H_m" => "H",
            letter => letter,
        };
        let what: Vec<&str> = self.entering(shown).into_iter().map(plain).collect();
        let name = before((self.caption)(), '[');
        worked_example::Enters { name: &name, what: &what.join(", ") }.say()
    }

    /// The unit that its caption tells.
    pub fn unit(&self) -> Option<&'static str> {
        let (_, unit) = (self.caption)().split_once('[')?;
        unit.split(']').next()
    }
}

/// What stands before a sign, or all where that is missing.
fn before(text: &str, sign: char) -> &str {
    text.split(sign).next().unwrap_or(text).trim_end()
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
        enters: "",
        tall: true,
        write: |to, e, _| to.vector(to.line(), &e.before.mean),
    },
    Step {
        caption: worked_example::covariance,
        formula: "Σ",
        enters: "",
        tall: true,
        write: |to, e, _| to.matrix(&e.before.covariance),
    },
    Step {
        caption: worked_example::noise,
        formula: "Q",
        enters: "",
        tall: true,
        write: |to, e, _| to.matrix(&e.noise),
    },
];

const INNOVATION: Step = Step {
    caption: worked_example::innovation_step,
    formula: "ν = z − z\u{302}",
    enters: "z z\u{302}",
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
    enters: "Σ Q H_m",
    tall: true,
    write: |to, e, slot| to.matrix(&e.updates[slot].innovation.covariance),
};

const DISTANCE: Step = Step {
    caption: worked_example::distance,
    formula: "d^2 = ν^T S^{−1} ν",
    enters: "ν S^{−1}",
    tall: false,
    write: |to, e, slot| to.number(e.updates[slot].innovation.mahalanobis_squared),
};

const WEIGHT: Step = Step {
    caption: worked_example::weight,
    formula: "w = |2πS|^{−1/2} exp(−½ d^2)",
    enters: "d^2 S",
    tall: false,
    write: |to, e, slot| to.positive(e.updates[slot].weight),
};

const MEAN_AFTER: Step = Step {
    caption: worked_example::landmark_after,
    formula: "μ ← μ + K ν",
    enters: "μ K ν",
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
        enters: "",
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
        enters: "x μ",
        tall: true,
        write: |to, e, slot| to.vector(to.line(), &e.updates[slot].innovation.prediction.z),
    },
    INNOVATION,
    Step {
        caption: worked_example::derivative,
        formula: "H_m = ∂h/∂m",
        enters: "x μ",
        tall: true,
        write: |to, e, slot| to.matrix(&e.updates[slot].innovation.prediction.h_m),
    },
    INNOVATION_COVARIANCE,
    Step {
        caption: worked_example::determinant,
        formula: "det S",
        enters: "S",
        tall: false,
        write: |to, e, slot| to.number(e.updates[slot].innovation.determinant()),
    },
    Step {
        caption: worked_example::inverse,
        formula: "S^{−1}",
        enters: "S",
        tall: true,
        write: |to, e, slot| to.matrix(&e.updates[slot].innovation.inverse),
    },
    DISTANCE,
    Step {
        caption: worked_example::log_weight,
        formula: "ln w = −½ (d^2 + ln |2πS|)",
        enters: "d^2 S",
        tall: false,
        write: |to, e, slot| to.number(e.updates[slot].innovation.log_likelihood()),
    },
    WEIGHT,
    Step {
        caption: worked_example::gain,
        formula: "K = Σ H_m^T S^{−1}",
        enters: "Σ H_m S^{−1}",
        tall: true,
        write: |to, e, slot| to.matrix(&e.updates[slot].gain),
    },
    MEAN_AFTER,
    Step {
        caption: worked_example::covariance_after,
        formula: "Σ ← (I − K H_m) Σ",
        enters: "K H_m Σ",
        tall: true,
        write: |to, e, slot| to.matrix(&e.updates[slot].after.covariance),
    },
    Step {
        caption: worked_example::share,
        formula: "w\u{303} = w / Σ w",
        enters: "w",
        tall: false,
        write: |to, e, slot| to.positive(e.weights.as_slice()[slot]),
    },
];

/// Which of the steps that are shown makes a symbol.
pub fn row_of(shown: &[Step], symbol: &str) -> Option<usize> {
    shown.iter().position(|step| step.makes(symbol))
}

/// The steps that are shown, all or those that decide.
pub fn steps(all: bool) -> &'static [Step] {
    if all { STEPS } else { FIVE_STEPS }
}

/// The step with a number from 1 on, of all that there are, if it is shown.
pub fn pointed(row: u32, shown: &[Step]) -> Option<usize> {
    let formula = STEPS.get((row as usize).checked_sub(1)?)?.formula;
    shown.iter().position(|step| step.formula == formula)
}

/// The number of a step that is shown, of all that there are.
pub fn number_of(shown: &[Step], rank: usize) -> u32 {
    let same = |step: &Step| shown.get(rank).is_some_and(|shown| shown.formula == step.formula);
    STEPS.iter().position(same).map_or(0, |row| row as u32 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_enters_a_step_is_shown_or_given() {
        let of = |rank: usize| FIVE_STEPS[rank].entering(FIVE_STEPS).join(" ");
        assert_eq!([0, 1, 2, 3, 4].map(of), ["z x μ", "Σ Q x μ", "ν S", "d^2 S", "μ Σ x S ν"]);
        for step in STEPS {
            for symbol in step.entering(STEPS) {
                let given = "z x μ Σ Q".split(' ').any(|known| known == symbol);
                assert!(given || row_of(STEPS, symbol).is_some(), "{symbol} of {}", step.formula);
            }
        }
    }

    #[test]
    fn what_enters_a_step_is_said_as_it_is_read() {
        for shown in [STEPS, FIVE_STEPS] {
            for told in shown.iter().map(|step| step.told(shown)) {
                assert!(!told.contains(['^', '_', '{']), "{told}");
            }
        }
    }

    #[test]
    fn a_number_names_the_same_step_whichever_are_shown() {
        for shown in [STEPS, FIVE_STEPS] {
            for (rank, step) in shown.iter().enumerate() {
                let number = number_of(shown, rank);
                assert_eq!(pointed(number, shown), Some(rank), "{}", step.formula);
            }
        }
        assert_eq!((pointed(0, STEPS), pointed(1, FIVE_STEPS), number_of(STEPS, 99)), (None, None, 0));
    }
}
