//! EM mapping beside particles, on the corridor of nameless doors.

use super::{Group, Recipe, SEEDS, VALID};
use crate::experiment::em::{self, LogSetup, OTHERS, Outcome};
use crate::experiment::{ErrorSummary, Fraction};

/// An answer that has less than this share of the particles' weight is given up.
const HELD: f64 = 0.05;

/// All recipes of EM mapping.
pub fn recipes() -> Vec<Recipe> {
    let run = |seed| em::outcome(&LogSetup { seed, ..LogSetup::default() }).expect(VALID);
    let many = Recipe::new("em", SEEDS, move |runs| {
        let found: Vec<Outcome> = runs.over(run);
        let of = format!("seeds 1 to {} of the corridor (lab/src/experiment/em.rs)", runs.seeds);
        let group = Group("em".into());
        let share = |key: &str, what: &str, is: fn(&Outcome) -> bool| {
            let fraction = Fraction::of(found.iter().map(is));
            group.number(key, fraction.share(), "", format!("Share of {of} on which {what}"))
        };
        let near: Vec<f64> = found.iter().map(|outcome| f64::from(outcome.best.1)).collect();
        vec![
            group.number("runs", f64::from(runs.seeds), "", "Seeds of the corridor, from 1 on"),
            group.number("others", f64::from(OTHERS), "", "Other first guesses that are tried on a log, each drawn at random"),
            group.number("near", ErrorSummary::of(&near).median, "", format!("Median over {of} of how many of the other first guesses end within half a nat of the best")),
            share("fold.stays", "EM mapping from a guess with two doors ends with the second ride's doors taken for the first two", |outcome| {
                outcome.ends[1].again > 0.5
            }),
            share("fold.lower", "it ends there lower than the best that was found by half a nat or more", |outcome| {
                outcome.ends[1].again > 0.5 && outcome.best.0 - outcome.ends[1].log_posterior >= 0.5
            }),
            share("default.folds", "EM mapping from three marks, each 10 to 30 cm off its door, takes the second ride's doors for the first two", |outcome| {
                outcome.ends[0].again > 0.5
            }),
            share("both", "either answer has a twentieth of the particles' weight or more", |outcome| {
                (HELD..=1.0 - HELD).contains(&outcome.again)
            }),
        ]
        .into()
    });
    let one = Recipe::new("em.figure", 0, move |_| {
        let Outcome { ends: [right, fold], again, .. } = run(LogSetup::default().seed);
        let group = Group("em.figure".into());
        let of = "as the figure opens (lab/src/experiment/em.rs)";
        let guess = "of a guess with the second and the third mark at one place";
        vec![
            group.number(
                "end",
                right.log_posterior,
                "",
                format!("Log posterior that EM mapping ends with {of} [nats]"),
            ),
            group.number("fold", fold.log_posterior, "", format!("The same {guess} [nats]")),
            group.number(
                "loses",
                right.log_posterior - fold.log_posterior,
                "",
                format!("The difference of the two [nats]: {guess}"),
            ),
            group.number(
                "again",
                again,
                "",
                format!("Share of the particles' weight that has the first two doors come again {of}"),
            ),
        ]
        .into()
    });
    vec![many, one]
}
