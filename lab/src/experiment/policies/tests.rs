use super::*;
use std::collections::BTreeSet;

#[test]
fn the_three_differ_in_nothing_until_one_resamples() {
    for course in [PolicyCourse::Lap, PolicyCourse::Wings] {
        let mut policies = Policies::new(&PoliciesSetup { threshold: 0.0, ..PoliciesSetup::of(course) }).unwrap();
        policies.step().unwrap();
        let [never, always, selective] = policies.reports();
        assert_eq!(never, selective, "{course}: N_eff is never below zero");
        assert_eq!((never.ess, never.resampled(), always.resampled()), (always.ess, false, true), "{course}");
        while policies.step().is_some() {}
        let [never, always, selective] = policies.reports();
        assert_eq!(never, selective, "{course}");
        assert_eq!(never.step, policies.step_count());
        assert_eq!(never.tree_nodes(), never.path_nodes(16), "{course}: nothing was ever shared");
        assert!(always.tree_nodes() < always.path_nodes(16) / 4, "{course}");
    }
}

#[test]
fn a_clone_goes_its_own_way_to_the_same_end() {
    let mut policies = Policies::new(&PoliciesSetup::of(PolicyCourse::Wings)).unwrap();
    (0..70).for_each(|_| {
        policies.step();
    });
    let kept = policies.clone();
    while policies.step().is_some() {}
    assert_eq!(kept.step_number(), 70);
    assert_eq!(kept.trace(), {
        let mut again = Policies::new(policies.setup()).unwrap();
        (0..70).for_each(|_| {
            again.step();
        });
        again.trace()
    });
}

#[test]
fn the_paths_that_are_held_are_those_that_the_reports_count() {
    let mut policies = Policies::new(&PoliciesSetup::of(PolicyCourse::Wings)).unwrap();
    while policies.step().is_some() {}
    for (policy, name) in POLICIES.into_iter().enumerate() {
        let report = &policies.reports()[policy];
        let mut ancestors = vec![BTreeSet::new(); report.step as usize + 1];
        for path in policies.paths(policy).into_iter().flat_map(Path::back) {
            ancestors[path.step() as usize].insert(path.id());
        }
        let widths: Vec<u32> = ancestors.iter().map(|step| step.len() as u32).collect();
        assert_eq!(widths, report.descent.widths().collect::<Vec<_>>(), "{name}");
    }
}

#[test]
fn settings_out_of_range_are_refused_by_name() {
    let setup = PoliciesSetup::default;
    for (setup, name) in [
        (PoliciesSetup { particles: 0, ..setup() }, "particles"),
        (PoliciesSetup { threshold: f64::NAN, ..setup() }, "threshold"),
        (PoliciesSetup { odometry_scale: -1.0, ..setup() }, "odometry_scale"),
        (PoliciesSetup { sensor_scale: 0.0, ..setup() }, "sensor_scale"),
    ] {
        assert_eq!(Policies::new(&setup).unwrap_err().field(), name);
    }
}
