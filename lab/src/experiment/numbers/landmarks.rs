//! Among landmarks: the figure of eight, and the doors that look alike.

use super::{Group, Recipe, SEEDS, VALID};
use crate::experiment::ProposalKind;
use crate::experiment::doors::{self, DoorsOutcome, DoorsSetup};
use crate::experiment::landmarks::{CorrespondenceKind, Course, LandmarkRun, LandmarkSetup};
use crate::experiment::{ErrorSummary, Fraction};
use fastslam::execute::Executor;
use fastslam::geometry::rms;
use fastslam::resampling::ResamplePolicy;
use std::sync::Arc;

/// All recipes among landmarks.
pub fn recipes() -> Vec<Recipe> {
    eight().into_iter().chain([six_doors()]).collect()
}

/// Identical doors: who ends at the right one.
fn six_doors() -> Recipe {
    const PARTICLES: [usize; 3] = [25, 100, 400];
    Recipe::new("doors", SEEDS, |runs| {
        let found: Vec<[DoorsOutcome; 7]> = runs.over(|seed| {
            let run = |setup: DoorsSetup| doors::outcomes(&setup, seed..seed + 1).expect(VALID)[0];
            let of =
                |proposal| PARTICLES.map(|particles| run(DoorsSetup { particles, proposal, ..DoorsSetup::default() }));
            let ([few, some, many], [few2, some2, many2]) = (of(ProposalKind::Motion), of(ProposalKind::Improved));
            let always =
                DoorsSetup { particles: PARTICLES[2], policy: ResamplePolicy::Always, ..DoorsSetup::default() };
            [few, some, many, few2, some2, many2, run(always)]
        });
        let of = format!("over seeds 1 to {} of the doors (lab/src/experiment/doors.rs)", runs.seeds);
        let right = |filter: &str, is_right: &dyn Fn(&[DoorsOutcome; 7]) -> bool| {
            let what = format!("the runs that end within a metre of the truth, {of}");
            Group(format!("doors.{filter}")).share("right", &Fraction::of(found.iter().map(is_right)), &what)
        };
        let group = Group("doors".into());
        let hypotheses = |key: &str, when: &str, count: fn(&DoorsOutcome) -> u32| {
            let counts: Vec<f64> = found.iter().map(|[_, _, many, ..]| f64::from(count(many))).collect();
            let made =
                format!("Median number of explanations with 1 % of the weight {when}, M = {}, {of}", PARTICLES[2]);
            group.number(key, ErrorSummary::of(&counts).median, "", made)
        };
        let mut numbers = vec![
            group.number("runs", f64::from(runs.seeds), "", "Seeds of the doors, from 1 on"),
            hypotheses("hypotheses.first", "after the first door that follows the ride", |outcome| outcome.first),
            hypotheses("hypotheses.last", "when the sign comes in sight", |outcome| outcome.last),
        ];
        numbers.extend(right("ekf", &|[outcome, ..]| outcome.ekf_right));
        for (k, particles) in PARTICLES.into_iter().enumerate() {
            numbers.extend(right(&format!("fastslam.m{particles}"), &|outcomes| outcomes[k].fastslam_right));
            numbers.extend(right(&format!("fastslam2.m{particles}"), &|outcomes| outcomes[k + 3].fastslam_right));
        }
        numbers.extend(right(&format!("always.m{}", PARTICLES[2]), &|[.., always]| always.fastslam_right));
        numbers.into()
    })
}

/// The figure of eight among landmarks.
fn eight() -> Vec<Recipe> {
    const NAME: &str = "landmarks.eight";
    const COURSE: Course = Course::Eight;
    let setup = |proposal, association, particles| LandmarkSetup {
        proposal,
        correspondence: association,
        particles,
        ..LandmarkSetup::default()
    };
    let run = move |setup: LandmarkSetup, seed| {
        let setup = LandmarkSetup { seed, ..setup };
        let run = LandmarkRun::new(&setup, &COURSE.tuning(), Arc::new(COURSE.simulate(seed))).expect(VALID);
        run.with_executor(Executor::Serial)
    };
    let versions = [("fastslam1", "1.0", ProposalKind::Motion), ("fastslam2", "2.0", ProposalKind::Improved)];
    let mut recipes = Vec::new();
    for association in [CorrespondenceKind::Known, CorrespondenceKind::Unknown] {
        for (version, number, proposal) in versions {
            for particles in [10, 100] {
                let name = format!("{NAME}.{association}.{version}.m{particles}");
                let of = format!(
                    "fastslam landmarks --course eight --proposal {number} --association {association} --particles {particles} --seed N"
                );
                recipes.push(Recipe::new(name.clone(), SEEDS, move |runs| {
                    let errors = runs.over(|seed| {
                        let mut run = run(setup(proposal, association, particles), seed);
                        while run.step().is_some() {}
                        [run.rms_online(), run.rms_best(), run.rms_best_aligned()]
                    });
                    let [online, path, aligned] =
                        [0, 1, 2].map(|k| errors.iter().map(|error| error[k]).collect::<Vec<_>>());
                    let group = Group(name.clone());
                    let mut numbers = group
                        .spread(&online, &format!("the RMS position error of the particles' mean as it went: {of}"));
                    let path_of = "the RMS position error of the best particle's path at the end";
                    for (key, errors, how) in
                        [("path", path, ""), ("aligned", aligned, ", after the best rigid alignment with the truth")]
                    {
                        let made = format!("Median over seeds 1 to {} of {path_of}{how}: {of}", runs.seeds);
                        numbers.push(group.number(key, ErrorSummary::of(&errors).median, "m", made));
                    }
                    numbers.into()
                }));
            }
        }
        let name = format!("{NAME}.{association}.ekf");
        recipes.push(Recipe::new(name.clone(), SEEDS, move |runs| {
            let setup = setup(ProposalKind::Improved, association, 1);
            let errors = runs.over(|seed| run(setup.clone(), seed).rms_ekf(&setup, &COURSE.tuning()));
            let what = format!("the RMS position error of EKF-SLAM as it went: fastslam landmarks --course eight --association {association} --seed N");
            Group(name.clone()).spread(&errors, &what).into()
        }));
    }
    let ahead = format!("{NAME}.unknown.ahead");
    recipes.push(Recipe::new(ahead.clone(), SEEDS, move |runs| {
        let setup = setup(ProposalKind::Improved, CorrespondenceKind::Unknown, 100);
        let is_ahead = runs.over(|seed| {
            let mut run = run(setup.clone(), seed);
            while run.step().is_some() {}
            run.rms_online() < run.rms_ekf(&setup, &COURSE.tuning())
        });
        let what = format!("seeds 1 to {} on which the particles' mean has a smaller RMS position error than EKF-SLAM, both as they went: fastslam landmarks --course eight --proposal 2.0 --association unknown --particles 100 --seed N", runs.seeds);
        Group(ahead.clone()).share("share", &Fraction::of(is_ahead.into_iter()), &what).into()
    }));
    recipes.push(Recipe::new(format!("{NAME}.odometry"), SEEDS, |runs| {
        let errors = runs.over(|seed| {
            let log = COURSE.simulate(seed);
            rms(&log.odometry, &log.truth)
        });
        let what = "the RMS position error of raw odometry: fastslam landmarks --course eight --seed N";
        Group(format!("{NAME}.odometry")).spread(&errors, what).into()
    }));
    recipes.push(Recipe::fixed(NAME, |group| {
        let log = COURSE.simulate(1);
        let of = "of the course: lab/src/experiment/landmarks/course.rs";
        vec![
            group.number("landmarks", log.landmarks.len() as f64, "", format!("Landmarks {of}")),
            group.number("runs", f64::from(SEEDS), "", "Seeds of every row of the landmark table, from 1 on"),
            group.number("steps", log.controls.len() as f64, "", format!("Steps {of}")),
        ]
    }));
    recipes
}
