//! The sampled map against the computed one: how long particles last by the closed form, and what they come to.

use super::{Group, Number, Recipe, VALID};
use crate::experiment::ErrorSummary;
use crate::experiment::joint::{COMPUTED, Joint, JointSetup, MOST, SAMPLED};
use fastslam::ops;

/// Seeds of what is measured: each is forty runs of both filters.
const SEEDS: u32 = 5;

/// Both recipes.
pub fn recipes() -> Vec<Recipe> {
    vec![
        Recipe::fixed("joint.exercise", exercise),
        Recipe::new("joint", SEEDS, |runs| measured(&runs.over(run)).into()),
    ]
}

/// With perfect wheels N_eff = M ρ^−N, so that M particles last for ln M / ln ρ landmarks.
fn exercise(group: &Group) -> Vec<Number> {
    let setup = JointSetup { odometry_scale: 0.0, ..JointSetup::default() };
    let rho = Joint::new(&setup).expect(VALID).log().rho();
    let lasts = |particles: u32| {
        let made = format!(
            "ln {particles} / ln ρ: landmarks that divide {particles} particles by as many, with a path that is known"
        );
        group.number(&format!("lasts.m{particles}"), ops::ln(f64::from(particles)) / ops::ln(rho), "", made)
    };
    let billions = 1e-9 * ops::exp(f64::from(MOST) * ops::ln(rho));
    vec![
        group.number("rho", rho, "", "By what one sighting of a landmark that is drawn divides N_eff, in closed form"),
        group.number(
            "needed",
            billions,
            "",
            format!("ρ^{MOST} · 10⁻⁹: billions of particles of which one is left after {MOST} landmarks"),
        ),
        lasts(100),
        lasts(1000),
        lasts(20_000),
    ]
}

/// Both filters' N_eff after all landmarks, and the share of the variance that computing the map removes.
fn run(seed: u64) -> [f64; 3] {
    let mut joint = Joint::new(&JointSetup { seed, ..JointSetup::default() }).expect(VALID);
    joint.finish().expect(VALID);
    let ess = |filter| joint.population(filter, MOST).map_or(f64::NAN, |found| found.ess);
    [ess(SAMPLED), ess(COMPUTED), joint.removed(MOST)]
}

fn measured(found: &[[f64; 3]]) -> Vec<Number> {
    let group = Group("joint".into());
    let JointSetup { particles, .. } = JointSetup::default();
    let what = [
        ("ess.sampled", format!("N_eff of {particles} particles with sampled maps after {MOST} landmarks")),
        ("ess.computed", format!("N_eff of {particles} particles with computed maps after {MOST} landmarks")),
        ("removed", format!("share of an estimate's variance that computing the map removes after {MOST} landmarks")),
    ];
    let number = |(k, (key, what)): (usize, (&str, String))| {
        let values: Vec<f64> = found.iter().map(|run| run[k]).collect();
        group.number(
            key,
            ErrorSummary::of(&values).median,
            "",
            format!("Median over seeds 1 to {} of the {what}", found.len()),
        )
    };
    what.into_iter().enumerate().map(number).collect()
}
