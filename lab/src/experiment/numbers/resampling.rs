//! When to resample: the three policies on the lap and in the wings.

use super::{Group, Recipe, Runs, SEEDS, VALID};
use crate::experiment::lap::STEPS;
use crate::experiment::resampling::counts::{PolicySummary, outcomes, summary};
use crate::experiment::resampling::{PoliciesSetup, PolicyCourse};
use fastslam::resampling::Scheme;

/// All recipes of the policies.
pub fn recipes() -> Vec<Recipe> {
    let schemes = [Scheme::Multinomial, Scheme::Residual, Scheme::Stratified, Scheme::Systematic];
    [on_the_lap()].into_iter().chain(schemes.map(wings)).collect()
}

/// The three policies over the seeds to be run.
fn summarised(runs: &Runs<'_>, setup: &PoliciesSetup) -> [PolicySummary; 3] {
    let found = runs.over(|seed| outcomes(setup, seed..seed + 1).expect(VALID));
    summary(&found.concat(), setup.particles)
}

fn on_the_lap() -> Recipe {
    Recipe::new("policies.lap", SEEDS, |runs| {
        let group = Group("policies.lap".into());
        let setup = PoliciesSetup::of(PolicyCourse::Lap);
        let policies = summarised(runs, &setup);
        let command = format!("fastslam-lab policies --course lap --particles {}", setup.particles);
        let of = format!("over seeds 1 to {}: {command}", runs.seeds);
        let mut numbers = Vec::new();
        for policy in &policies {
            let mut put = |key: &str, value: Option<f64>, unit, made: &str| {
                let key = format!("{}.{key}", policy.policy);
                numbers.extend(value.map(|value| group.number(&key, value, unit, format!("{made}, {of}"))));
            };
            let [p10, factor, p90] = policy.error_factor.map(Some);
            let one = "the first step at which all particles descend from one";
            put("ess_final_median", Some(policy.final_ess_median), "", "Median N_eff at the end of the lap");
            put("error_median", Some(policy.rms_median), "m", "Median RMS position error of the best particle's path");
            let ratio = "of the error over the selective filter's on the same seed";
            put("error_factor", factor, "", &format!("Median {ratio}"));
            put("error_factor_p10", p10, "", &format!("10th percentile {ratio}"));
            put("error_factor_p90", p90, "", &format!("90th percentile {ratio}"));
            put("resampled_fraction", Some(policy.resampled_fraction), "", "Mean share of the steps that resampled");
            put("lineage_one_step", policy.lineage_one_step_median, "", &format!("Median of {one}"));
            put("ess_at_lineage_one", policy.ess_at_lineage_one_median, "", &format!("Median N_eff at {one}"));
            put("ess_until_lineage_one", Some(policy.ess_meanwhile), "", &format!("Mean N_eff up to {one}"));
        }
        let [_, always, selective] = &policies;
        for (key, policy) in [("tree.always", always), ("tree", selective)] {
            let of = format!("policy {}, {of}", policy.policy);
            let nodes = format!("Mean number of nodes of the ancestry tree at the end, {of}");
            numbers.push(group.number(&format!("{key}.nodes"), policy.tree_nodes, "", nodes));
            let made =
                format!("c of t + 1 + c M ln M, the mean size of the ancestry tree over the lap's second half, {of}");
            numbers.extend(policy.tree_c.map(|c| group.number(&format!("{key}.c"), c, "", made)));
        }
        let dense = (setup.particles * (STEPS + 1)) as f64;
        numbers.push(group.number(
            "tree.dense",
            dense,
            "",
            "M (t + 1) at the end of the lap: nodes of paths kept apart",
        ));
        numbers.into()
    })
}

fn wings(scheme: Scheme) -> Recipe {
    let name = format!("policies.wings.{scheme}");
    Recipe::new(name.clone(), SEEDS, move |runs| {
        let setup = PoliciesSetup { scheme, ..PoliciesSetup::of(PolicyCourse::Wings) };
        let kept = "the runs that still have a particle in the right wing before the sign comes in sight";
        let command = format!("fastslam-lab policies --course wings --scheme {scheme} --particles {}", setup.particles);
        let what = format!("{kept}, over seeds 1 to {}: {command}", runs.seeds);
        let of_policy = |policy: PolicySummary| {
            let group = Group(format!("{name}.{}", policy.policy));
            policy.alive.map(|alive| group.share("alive", &alive, &what))
        };
        summarised(runs, &setup).into_iter().filter_map(of_policy).flatten().collect::<Vec<_>>().into()
    })
}
