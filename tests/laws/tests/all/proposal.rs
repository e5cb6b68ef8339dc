//! The grid proposals against the posterior of one step, summed on a dense grid of poses.

use fastslam::geometry::{Gaussian3, Pose2};
use fastslam::laws;
use fastslam::map::ConditionalMap;
use fastslam::map::grid::{Grid, GridModel};
use fastslam::mapper::LaserMapperSettings;
use fastslam::matching::{Likelihood, Matcher, ScanModel, Score, ScoreNear};
use fastslam::motion::{Displaced, Displacement, Motion, Odometry, OdometryModel};
use fastslam::ops;
use fastslam::particle::Particle;
use fastslam::proposal::{
    CorrelativeSearch, Fit, FitLimits, FromMotion, FromScan, FromScanSettings, HeadingSeeds, IncrementalWeight,
    Proposal, ProposalTrace, Proposed, Search,
};
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;
use fastslam_lab::experiment::lap::{ALPHAS, FROM_SCAN, GRID, LapWorld, OUTLIER, TEMPER};
use nalgebra::{Matrix3, Vector3};
use statrs::distribution::{ContinuousCDF, Normal};

/// With which logs are mapped.
fn of_logs() -> FromScanSettings<CorrelativeSearch> {
    LaserMapperSettings::default().proposal().settings
}

/// A particle at the start of the lap, its map made there, and the first step's control and scan.
struct OneStep<S = HeadingSeeds> {
    particle: Particle<Grid>,
    world: LapWorld,
    from_scan: FromScan<OdometryModel, ScanModel, S>,
}

fn one_step(matcher: Matcher) -> OneStep {
    one_step_by(matcher, FROM_SCAN.search)
}

fn one_step_by<S>(matcher: Matcher, search: S) -> OneStep<S> {
    // A fifth of the lap's noise, so that odometry and scan have about the same say.
    let motion = OdometryModel { alphas: ALPHAS }.scaled(0.2);
    let world = LapWorld::new(5, &motion, 0.02);
    // What a lattice of starts looks at is kept too.
    let mut map = Grid::new(GridModel { distance_reach: 2, ..GRID });
    for (pose, scan) in &world.start_scans {
        map.assimilate(pose, scan, &());
    }
    let particle = Particle::start(world.truth[0], map);
    // Tempered harder, or the posterior is too narrow for a dense grid and for the motion model's samples to meet it.
    let scan = ScanModel::new(matcher, TEMPER * 0.4, OUTLIER);
    let FromScanSettings {
        motion_floor,
        climb,
        hills,
        climb_stride,
        minimum_improvement,
        full_weight,
        limits,
        weight,
        ..
    } = FROM_SCAN;
    let settings = FromScanSettings {
        motion_floor,
        search,
        climb,
        hills,
        climb_stride,
        minimum_improvement,
        full_weight,
        limits,
        weight,
    };
    OneStep { particle, world, from_scan: FromScan { motion, score: scan, settings } }
}

/// Small enough to change nothing, and enough to make a covariance definite.
const NO_FLOOR: [f64; 3] = [1e-4; 3];

impl<S> OneStep<S> {
    fn prior(&self, floor: [f64; 3]) -> Gaussian3 {
        self.from_scan.motion.gaussian(&self.particle.world_from_robot, &self.world.controls[0], floor).unwrap()
    }

    /// Mean (from the prior's) and covariance of p(x | z, u, m), and ln ∫ p(z | x, m) p(x | u) dx, by summing a lattice of the prior's own axes
    /// to ±4.5 σ.
    fn dense(&self, floor: [f64; 3]) -> (Vector3<f64>, Matrix3<f64>, f64) {
        let (prior, scan) = (self.prior(floor), &self.world.scans[0]);
        let side: Vec<f64> = (-22..=22).map(|k| f64::from(k) * 4.5 / 22.0).collect();
        let cell = ops::ln(4.5 / 22.0) * 3.0;
        let mut poses = Vec::new();
        for a in &side {
            for b in &side {
                for c in &side {
                    let pose = prior.at([*a, *b, *c]);
                    let log_normal = -0.5 * (a * a + b * b + c * c) - 1.5 * ops::ln(core::f64::consts::TAU);
                    let log_likelihood = self.from_scan.score.log_score(&self.particle.map, &pose, scan);
                    poses.push((pose.minus(prior.mean()), log_likelihood + log_normal + cell));
                }
            }
        }
        let log_evidence = ops::log_sum_exp(&poses.iter().map(|(_, w)| *w).collect::<Vec<_>>());
        let mean: Vector3<f64> = poses.iter().map(|(d, w)| d * ops::exp(w - log_evidence)).sum();
        let square = |d: Vector3<f64>| d * d.transpose();
        let covariance = poses.iter().map(|(d, w)| square(d - mean) * ops::exp(w - log_evidence)).sum();
        (mean, covariance, log_evidence)
    }

    /// Importance-weighted mean of draws, its standard error, and ln of the mean weight.
    fn sampled(
        &self,
        proposal: &impl Proposal<Grid, Control = Odometry>,
        draws: u32,
    ) -> (Vector3<f64>, Vector3<f64>, f64) {
        let prior = self.prior(NO_FLOOR);
        let drawn: Vec<(Vector3<f64>, f64)> = (0..draws)
            .map(|k| {
                let mut stream = Stream::at(7, Purpose::TRIAL, k, 0);
                let p = proposal.propose(&self.particle, &self.world.controls[0], &self.world.scans[0], &mut stream);
                (p.world_from_robot.minus(prior.mean()), p.log_increment)
            })
            .collect();
        let log_sum = ops::log_sum_exp(&drawn.iter().map(|(_, w)| *w).collect::<Vec<_>>());
        let weights: Vec<f64> = drawn.iter().map(|(_, w)| ops::exp(w - log_sum)).collect();
        let mean: Vector3<f64> = drawn.iter().zip(&weights).map(|((d, _), w)| d * *w).sum();
        let variance: Vector3<f64> =
            drawn.iter().zip(&weights).map(|((d, _), w)| (d - mean).component_mul(&(d - mean)) * (w * w)).sum();
        (mean, variance.map(f64::sqrt), log_sum - ops::ln(f64::from(draws)))
    }
}

/// n = 20 000 draws; 4 standard errors (α = 6e-5 each), plus the difference between the motion model and its Gaussian, which
/// is of second order in the noise: 2 % of the prior's standard deviations.
#[test]
fn the_motion_prior_weighted_by_the_scan_has_the_posteriors_mean() {
    for matcher in [Matcher::Cell, Matcher::SubCell] {
        let step = one_step(matcher);
        let (expected, _, log_evidence) = step.dense(NO_FLOOR);
        let from_motion = FromMotion { motion: step.from_scan.motion, likelihood: step.from_scan.score.clone() };
        let (mean, error, log_mean_weight) = step.sampled(&from_motion, 20_000);
        for axis in 0..3 {
            let bound = 4.0 * error[axis] + 0.02 * spread(&step, NO_FLOOR)[axis];
            assert!(
                (mean[axis] - expected[axis]).abs() < bound,
                "{matcher} axis {axis}: {} for {}, ±{bound}",
                mean[axis],
                expected[axis]
            );
        }
        assert!((log_mean_weight - log_evidence).abs() < 0.1, "{matcher}: {log_mean_weight} for {log_evidence}");
    }
}

/// What the proposal draws from, beside the posterior. Along each axis it must be `least` times as wide or more: where it is too narrow, no weight
/// makes up for what is never drawn.
fn compare<S: Search>(name: &str, step: &OneStep<S>, least: [f64; 3]) {
    let FromScan { score, settings, .. } = &step.from_scan;
    let (prior, control, scan) = (step.prior(settings.motion_floor), &step.world.controls[0], &step.world.scans[0]);
    let target = |pose: &Pose2| score.log_score(&step.particle.map, pose, scan) + prior.log_density(pose);
    let stream = || Stream::at(7, Purpose::TRIAL, 0, 0);
    let proposed = step.from_scan.propose(&step.particle, control, scan, &mut stream());
    let ProposalTrace::Matched { mode, log_integral, .. } = proposed.trace else { panic!("{name}: {proposed:?}") };
    let fit = Fit::around(&mode, &settings.limits, target).unwrap();
    // The fit that is judged is the one that was drawn from. The map is looked up another way, in single precision.
    assert!(fit.gaussian.sample(&mut stream()).minus(&proposed.world_from_robot).norm() < 1e-9, "{name}");
    assert!((fit.log_integral - log_integral).abs() < 1e-9, "{name}");
    let (mean, covariance, log_evidence) = step.dense(settings.motion_floor);
    let std = covariance.diagonal().map(f64::sqrt);
    let off = (fit.gaussian.mean().minus(prior.mean()) - mean).component_div(&std);
    let ratio = fit.gaussian.covariance().diagonal().map(f64::sqrt).component_div(&std);
    assert!((log_integral - log_evidence).abs() < 0.15, "{name}: ln η̂ {log_integral} for {log_evidence}");
    assert!(off.amax() < 0.25, "{name}: off by {off} standard deviations");
    let narrow = ratio.iter().zip(least).any(|(ratio, least)| *ratio < least);
    assert!(!narrow && ratio.max() < 1.1, "{name}: {ratio} times as wide");
}

/// Within a quarter of a standard deviation, 0.15 nats, and a tenth of each standard deviation. With normal distributions in cells the heading has
/// several bumps, and the fit sees the one at the mode: there it may be a quarter too narrow. No draws: nothing here is chance.
#[test]
fn the_measurement_aware_proposal_has_the_posteriors_mean_covariance_and_integral() {
    for matcher in [Matcher::Cell, Matcher::SubCell] {
        let (mut spread, mut lattice) = (one_step(matcher), one_step_by(matcher, of_logs().search));
        // So hard a temper leaves cells, and the coarse look of the lattice, too little for the guard to trust them.
        lattice.from_scan.settings.minimum_improvement = f64::NEG_INFINITY;
        if matcher == Matcher::Cell {
            spread.from_scan.settings.minimum_improvement = f64::NEG_INFINITY;
        }
        let least = [0.92, 0.92, if matcher == Matcher::Cell { 0.92 } else { 0.75 }];
        compare(&format!("{matcher} spread"), &spread, least);
        compare(&format!("{matcher} lattice"), &lattice, least);
    }
}

/// A step weighs in the share of [`FromScanSettings::full_weight`] that it drives, whether the matcher was trusted or not; and the heuristic pays the score
/// of the pose that was drawn by the map of some scans ago. 1e-12: rounding.
#[test]
fn a_short_step_weighs_in_proportion_in_both_branches_of_the_guard() {
    use IncrementalWeight::{Marginal, NewGroundFree, OldMapAtDraw};
    let weights = [Marginal, NewGroundFree, OldMapAtDraw];
    for (matcher, weight) in [Matcher::Cell, Matcher::SubCell].into_iter().flat_map(|m| weights.map(|w| (m, w))) {
        let mut step = one_step(matcher);
        step.from_scan.settings.weight = weight;
        // One scan is old, and the rest new.
        let mut map = Grid::new(GRID);
        for (k, (pose, scan)) in step.world.start_scans.iter().take(20).enumerate() {
            map.assimilate(pose, scan, &());
            if k == 0 {
                map.settle();
            }
        }
        step.particle.map = map;
        let (control, scan) = (step.world.controls[0], &step.world.scans[0]);
        let motion = control.trans.abs() + control.rot1.abs() + control.rot2.abs();
        for (gain, trusted) in [(f64::NEG_INFINITY, true), (f64::INFINITY, false)] {
            step.from_scan.settings.minimum_improvement = gain;
            for slot in 0..5 {
                let mut proposed = |full_weight| {
                    step.from_scan.settings.full_weight = full_weight;
                    let mut stream = Stream::at(7, Purpose::TRIAL, slot, 0);
                    step.from_scan.propose(&step.particle, &control, scan, &mut stream)
                };
                let whole = proposed(0.0);
                assert_eq!(matches!(whole.trace, ProposalTrace::Matched { .. }), trusted);
                for (full_weight, share) in [(0.5 * motion, 1.0), (4.0 * motion, 0.25)] {
                    let (part, expected) = (proposed(full_weight).log_increment, share * whole.log_increment);
                    assert!(
                        expected != 0.0 && (part - expected).abs() <= 1e-12 * expected.abs(),
                        "{matcher}, {weight}"
                    );
                }
                let score = |map: &Grid| step.from_scan.score.log_score(map, &whole.world_from_robot, scan);
                let (old, new) = (score(&step.particle.map.past()), score(&step.particle.map));
                assert!((old - new).abs() > 1e-3, "the two maps differ: {old} and {new}");
                if weight == IncrementalWeight::OldMapAtDraw {
                    assert!((whole.log_increment - old).abs() <= 1e-12 * old.abs(), "{matcher}, trusted {trusted}");
                }
            }
        }
    }
}

/// A map that never changes: it is known how well each pose explains what is seen.
#[derive(Clone, Copy)]
struct Explained(fn(&Pose2) -> f64);

impl ConditionalMap for Explained {
    type Observation = ();
    type Association = ();
    fn assimilate(&mut self, _: &Pose2, (): &(), (): &()) {}
}

impl Likelihood<Explained> for Explained {
    fn log_likelihood(&self, _: &Explained, world_from_robot: &Pose2, (): &()) -> (f64, ()) {
        (self.log_score(world_from_robot), ())
    }
}

impl Score<Explained> for Explained {
    type Near<'a> = Self;

    fn near<'a>(&'a self, _: &'a Explained, _: &Pose2, (): &'a (), _: usize) -> Self {
        *self
    }
}

impl ScoreNear for Explained {
    fn log_score(&self, pose: &Pose2) -> f64 {
        self.0(pose)
    }
}

/// Where two places explain what is seen along x \[m\], and how well: one of them three times as well as the other.
const PLACES: [(f64, f64); 2] = [(-0.3, 0.75), (0.3, 0.25)];

/// Of either place, along each axis \[m, m, rad\].
const WIDTH: [f64; 3] = [0.05, 0.05, 0.03];

const TWO_PLACES: Explained = Explained(|pose| {
    let at = |(x, share): (f64, f64)| {
        let [a, b, c] = [(pose.x - x) / WIDTH[0], pose.y / WIDTH[1], pose.theta / WIDTH[2]];
        ops::ln(share) - 0.5 * (a * a + b * b + c * c)
    };
    ops::log_sum_exp(&PLACES.map(at))
});

/// Where two hills are told apart, a particle is on either as often as the hill is large: four standard deviations of the binomial. Where
/// the highest is all, all are there, and what the other explained is lost.
#[test]
fn hills_are_drawn_by_their_integrals() {
    const DRAWS: u32 = 2000;
    let share = |hills: u32| {
        let settings = FromScanSettings { hills, ..of_logs() };
        let proposal = FromScan { motion: Displaced, score: TWO_PLACES, settings };
        let covariance = Matrix3::from_diagonal(&Vector3::new(0.09, 0.09, 0.01));
        let control = Displacement { mean: Pose2::default(), covariance };
        let particle = Particle::start(Pose2::default(), TWO_PLACES);
        let at_the_better = (0..DRAWS).filter(|slot| {
            let mut stream = Stream::at(11, Purpose::TRIAL, 0, *slot);
            let proposed = proposal.propose(&particle, &control, &(), &mut stream);
            assert!(matches!(proposed.trace, ProposalTrace::Matched { .. }));
            let x = proposed.world_from_robot.x;
            assert!((x.abs() - 0.3).abs() < 0.25, "{x} is at neither place");
            x < 0.0
        });
        at_the_better.count() as f64 / f64::from(DRAWS)
    };
    assert_eq!(share(1), 1.0);
    let (found, error) = (share(3), (0.75 * 0.25 / f64::from(DRAWS)).sqrt());
    assert!((found - 0.75).abs() < 4.0 * error, "{found}");
}

/// To the bit, for each incremental weight, with one mode and with several, and where the match is rejected.
#[test]
fn copies_proposed_together_are_proposed_as_each_by_itself() {
    let covariance = Matrix3::from_diagonal(&Vector3::new(0.09, 0.09, 0.01));
    let control = Displacement { mean: Pose2::default(), covariance };
    let particle = Particle::start(Pose2::default(), TWO_PLACES);
    let streams = || (0..6).map(|slot| Stream::at(12, Purpose::TRIAL, 0, slot));
    for weight in [IncrementalWeight::Marginal, IncrementalWeight::NewGroundFree, IncrementalWeight::OldMapAtDraw] {
        for (hills, minimum_improvement) in [(1, 0.5), (3, 0.5), (1, 1e3)] {
            let settings = FromScanSettings { hills, weight, minimum_improvement, ..of_logs() };
            let proposal = FromScan { motion: Displaced, score: TWO_PLACES, settings };
            let together = proposal.propose_copies(&particle, &control, &(), &mut streams().collect::<Vec<_>>());
            let alone = streams().map(|mut stream| proposal.propose(&particle, &control, &(), &mut stream));
            assert_eq!(together, alone.collect::<Vec<_>>(), "{weight:?}, {hills}");
            assert!(together[1..].iter().all(|proposed| proposed.world_from_robot != together[0].world_from_robot));
            let matched = |proposed: &Proposed<()>| matches!(proposed.trace, ProposalTrace::Matched { .. });
            assert_eq!(
                together.iter().filter(|proposed| matched(proposed)).count(),
                if minimum_improvement < 1.0 { 6 } else { 0 }
            );
        }
    }
}

/// Where a scan of a known map has its hill N(x; here, Σ), up to a constant factor: all of the map is old.
const HERE: Pose2 = Pose2 { x: 0.2, y: -0.1, theta: 0.05 };

/// Σ \[m, m, rad\]: a hill that runs askew.
const SPREAD: Matrix3<f64> = Matrix3::new(0.0016, 0.0006, -0.0002, 0.0006, 0.0009, 0.0001, -0.0002, 0.0001, 0.0004);

const KNOWN_PLACE: Explained = Explained(|pose| {
    let d = pose.minus(&HERE);
    -7.0 - 0.5 * d.dot(&(SPREAD.try_inverse().unwrap() * d))
});

/// A proposal that looks first on the known map, a step whose prior is `times` as wide as the scan's hill and 1.2 of its own standard deviations off it
/// along each axis, and ln η.
fn on_known_ground(
    times: f64,
    weight: IncrementalWeight,
) -> (FromScan<Displaced, Explained, CorrelativeSearch>, laws::proposal::Step<Explained, Displacement>, f64) {
    // Floors and limits of the fit out of the way, and every match trusted.
    let settings = FromScanSettings {
        motion_floor: [1e-6; 3],
        minimum_improvement: f64::NEG_INFINITY,
        full_weight: 0.0,
        limits: FitLimits { least: [1e-4; 2], most: [1.0; 2] },
        weight,
        ..of_logs()
    };
    let covariance = SPREAD.map_with_location(|i, j, s| if i == j { times * times * s } else { 0.0 });
    let off = covariance.diagonal().map(|variance| 1.2 * variance.sqrt());
    let control = Displacement { mean: HERE.plus(&off), covariance };
    let particle = Particle::start(Pose2::default(), KNOWN_PLACE);
    let sum = covariance + SPREAD;
    let log_eta = -7.0
        - 0.5 * off.dot(&(sum.try_inverse().unwrap() * off))
        - 0.5 * ops::ln(sum.determinant() / SPREAD.determinant());
    let step = laws::proposal::Step { particle, control, observation: () };
    (FromScan { motion: Displaced, score: KNOWN_PLACE, settings }, step, log_eta)
}

/// Within 0.05 nats, of prior wide and narrow. One draw of each: both weights are the same whatever is drawn.
#[test]
fn on_known_ground_either_weight_is_the_normaliser() {
    for times in [0.5, 1.0, 2.0, 3.0, 5.0, 10.0] {
        for weight in [IncrementalWeight::Marginal, IncrementalWeight::NewGroundFree] {
            let (proposal, step, expected) = on_known_ground(times, weight);
            for slot in 0..3 {
                let mut stream = Stream::at(3, Purpose::TRIAL, 0, slot);
                let found = proposal.propose(&step.particle, &step.control, &(), &mut stream);
                assert!(matches!(found.trace, ProposalTrace::Matched { .. }), "{weight}, {times} times");
                let off = found.log_increment - expected;
                println!("{weight}, a prior {times} times as wide: {:.4} for {expected:.4}", found.log_increment);
                assert!(off.abs() < 0.05, "{weight}, {times} times: off by {off}");
            }
        }
    }
}

/// By the law that all proposals with a right price obey, against draws from the motion.
#[test]
fn on_known_ground_looking_first_draws_and_pays_as_the_motion_does() {
    for weight in [IncrementalWeight::Marginal, IncrementalWeight::NewGroundFree] {
        let (proposal, step, _) = on_known_ground(1.5, weight);
        let reference = FromMotion { motion: Displaced, likelihood: KNOWN_PLACE };
        laws::proposal::draws_and_prices_are_those_of_the_reference(&proposal, &reference, &step);
    }
}

/// The drawn pose pays by the old map, which is the whole map, a second time: the variance of a Gaussian hill and a prior as wide is then a third and not
/// half of either, and the law of right prices is broken.
#[test]
#[should_panic(expected = "the mean price is")]
fn on_known_ground_the_price_at_the_draw_counts_the_map_twice() {
    let (proposal, step, _) = on_known_ground(1.0, IncrementalWeight::OldMapAtDraw);
    let reference = FromMotion { motion: Displaced, likelihood: KNOWN_PLACE };
    laws::proposal::draws_and_prices_are_those_of_the_reference(&proposal, &reference, &step);
}

/// Where nothing is old, all particles weigh the same, to the bit, as long as they look first by the weight that new ground has no say in; and not by
/// the other.
#[test]
fn new_ground_tells_no_particle_from_another() {
    let world = LapWorld::new(3, &OdometryModel { alphas: ALPHAS }, 0.02);
    let steps = |weight| {
        let settings = FromScanSettings { weight, ..FROM_SCAN };
        let score = ScanModel::new(Matcher::SubCell, TEMPER, OUTLIER);
        let proposal = FromScan { motion: OdometryModel { alphas: ALPHAS }, score, settings };
        // A map that never becomes old.
        let mut map = <Grid>::new(GridModel { lag: 1_000_000, ..GRID });
        world.start_scans.iter().for_each(|(pose, scan)| map.assimilate(pose, scan, &()));
        let filter = Rbpf::builder(map, proposal).particles(8).start(world.truth[0]);
        let mut filter = filter.policy(ResamplePolicy::Never).build().unwrap();
        let mut matched = 0;
        for (control, scan) in world.controls.iter().zip(&world.scans).take(20) {
            matched += filter.step(control, scan).matched();
        }
        (filter.weights().as_slice().to_vec(), matched)
    };
    let (weights, matched) = steps(IncrementalWeight::NewGroundFree);
    assert!(matched > 100, "{matched} of 160 looked first");
    assert!(weights.iter().all(|weight| *weight == weights[0]), "{weights:?}");
    assert!(steps(IncrementalWeight::Marginal).0.iter().any(|weight| *weight < 0.1 / 8.0));
}

/// On an unknown map every pose scores alike: the optimum is noise, and the motion model must be drawn from.
#[test]
fn the_matcher_fails_on_a_flat_score_surface() {
    let mut step = one_step(Matcher::SubCell);
    step.particle.map = Grid::new(GRID);
    for slot in 0..50 {
        let draw =
            |proposal: &dyn Fn(&mut Stream) -> Proposed<()>| proposal(&mut Stream::at(3, Purpose::TRIAL, 0, slot));
        let (control, scan) = (&step.world.controls[0], &step.world.scans[0]);
        let aware = draw(&|stream| step.from_scan.propose(&step.particle, control, scan, stream));
        assert_eq!(aware.trace, ProposalTrace::Motion);
    }
}

/// Standard deviations along x, y, θ of the prior with this floor.
fn spread<S>(step: &OneStep<S>, floor: [f64; 3]) -> Vector3<f64> {
    let covariance = step.from_scan.motion.covariance(&step.particle.world_from_robot, &step.world.controls[0]);
    (covariance.diagonal() + Vector3::from(floor.map(|std| std * std))).map(f64::sqrt)
}

/// α = 0.001 two-sided over 6 moments (Bonferroni), n = 100 000.
#[test]
fn sampled_motions_have_the_models_moments() {
    let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
    let (from, n) = (Pose2::new(1.0, 2.0, 0.5), 100_000_u32);
    let u = Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 };
    let draws: Vec<Vector3<f64>> = (0..n)
        .map(|k| {
            let noisy = model.perturb(&u, &mut Stream::at(2, Purpose::TRIAL, k, 0));
            assert!(model.sample(&from, &u, &mut Stream::at(2, Purpose::TRIAL, k, 0)) == noisy.apply(&from));
            Vector3::new(noisy.rot1 - u.rot1, noisy.trans - u.trans, noisy.rot2 - u.rot2)
        })
        .collect();
    for (axis, std) in model.stds(&u).into_iter().enumerate() {
        let mean = draws.iter().map(|d| d[axis]).sum::<f64>() / f64::from(n);
        let variance = draws.iter().map(|d| d[axis] * d[axis]).sum::<f64>() / f64::from(n);
        let z = Normal::standard().inverse_cdf(1.0 - 0.001 / 2.0 / 6.0) / f64::from(n).sqrt();
        assert!(mean.abs() < z * std, "axis {axis}: mean {mean}");
        assert!((variance / (std * std) - 1.0).abs() < z * 2.0_f64.sqrt(), "axis {axis}: variance {variance}");
    }
}
