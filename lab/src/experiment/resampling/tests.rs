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

/// Also when the threshold changes again before the selective filter has caught up, and in the steps after that.
#[test]
fn another_threshold_runs_the_selective_filter_alone() {
    for course in [PolicyCourse::Lap, PolicyCourse::Wings] {
        let of = |threshold| PoliciesSetup { threshold, ..PoliciesSetup::of(course) };
        let every_step = |threshold| {
            let mut run = Policies::new(&of(threshold)).unwrap();
            core::iter::from_fn(move || run.step().cloned()).collect::<Vec<_>>()
        };
        let mut run = Policies::new(&of(0.5)).unwrap();
        for _ in 0..20 {
            run.step();
        }
        for (threshold, far) in [(0.7, 12), (0.0, 20), (1.0, 20), (0.6, 30)] {
            run = run.asked(&of(threshold)).unwrap().unwrap();
            assert_eq!((run.step_number(), run.catches_up()), (0, true));
            for (step, expected) in every_step(threshold).iter().enumerate().take(far) {
                let alone = run.catches_up();
                assert_eq!(alone, step < 20);
                if alone {
                    assert_eq!(run.advance(), Some(true));
                    assert_eq!(run.reports()[SELECTIVE], expected[SELECTIVE], "{threshold}, {step}");
                } else {
                    assert_eq!(run.step(), Some(expected), "{threshold}, {step}");
                }
            }
        }
        assert!(run.asked(&PoliciesSetup { seed: 4, ..of(0.6) }).unwrap().is_none(), "another log");
        run.advance();
        assert!(run.asked(&of(0.5)).unwrap().is_none(), "in the middle of a step");
        assert_eq!(run.asked(&of(2.0)).unwrap_err().field(), "threshold");
    }
}

/// Until the last filter has made its step, reports are those of the previous one.
#[test]
fn a_step_is_made_filter_by_filter() {
    for course in [PolicyCourse::Lap, PolicyCourse::Wings] {
        let [mut whole, mut parts] = [(); 2].map(|()| Policies::new(&PoliciesSetup::of(course)).unwrap());
        while let Some(reports) = whole.step() {
            let before = parts.reports().clone();
            assert_eq!([parts.advance(), parts.advance()], [Some(false); 2]);
            assert_eq!((parts.reports(), parts.step_number()), (&before, reports[0].step - 1));
            parts = parts.clone(); // also from there on
            assert_eq!(parts.advance(), Some(true));
            assert_eq!(parts.reports(), reports);
        }
        assert_eq!((parts.advance(), parts.reports()), (None, whole.reports()));
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

/// Also in the step in which the selective filter branches off, where another's parts come, and in the middle of a step.
#[test]
fn a_step_of_which_two_draw_a_part_each_is_the_step_of_one() {
    let setup = PoliciesSetup { particles: 6, threshold: 0.6, ..PoliciesSetup::of(PolicyCourse::Lap) };
    let [mut alone, mut shared] = [(); 2].map(|()| Policies::new(&setup).unwrap());
    let mut filters = BTreeSet::new();
    while alone.step().is_some() {
        let parts = [0, 1].map(|part| shared.propose(part));
        filters.insert(parts[0].len());
        match shared.step_number() {
            10 => shared.step_by([&parts[0][1..], &parts[1]]),
            20 => {
                shared.advance();
                assert!(shared.propose(0).is_empty());
                shared.step_by([&parts[0], &parts[1]]);
            }
            _ => shared.step_by([&parts[0], &parts[1]]),
        }
        assert_eq!(shared.reports(), alone.reports());
    }
    assert_eq!(filters.len(), 2, "two filters, and later three");
}
