//! Laws of the filter itself, whatever it maps.

use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::nalgebra::Matrix3;
use fastslam::ops;
use fastslam::particle::Particle;
use fastslam::proposal::{Proposal, ProposalTrace, Proposed};
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::{ResamplePolicy, Scheme};
use laws::drifting_from;

/// A map of nothing.
#[derive(Clone)]
struct Nothing;

impl ConditionalMap for Nothing {
    type Observation = ();
    type Association = ();

    fn assimilate(&mut self, _: &Pose2, (): &(), (): &()) {}
}

/// Draws nothing but the price, which the control makes of a normal number \[nats\].
struct Price;

impl Proposal<Nothing> for Price {
    type Control = fn(f64) -> f64;

    fn propose(&self, _: &Particle<Nothing>, price: &fn(f64) -> f64, (): &(), stream: &mut Stream) -> Proposed<()> {
        let [normal] = stream.normals();
        let log_increment = price(normal);
        Proposed { world_from_robot: Pose2::default(), association: (), log_increment, trace: ProposalTrace::Motion }
    }
}

const COUNT: usize = 16;

fn filter(policy: ResamplePolicy, scheme: Scheme, seed: u64) -> Rbpf<Nothing, Price> {
    Rbpf::builder(Nothing, Price).particles(COUNT).seed(seed).policy(policy).scheme(scheme).build().unwrap()
}

/// What all particles explain, some of them better.
const SOME: fn(f64) -> f64 = |normal| 0.1 * normal;

/// Slot of the largest, the lowest of equals.
fn largest(values: &[f64]) -> usize {
    (1..values.len()).fold(0, |best, slot| if values[slot] > values[best] { slot } else { best })
}

/// Sums kept by hand: what a particle has paid along its path goes with it wherever it is copied. Multinomial draws of nearly
/// equal weights let the best die a third of the time, (1 − 1/16)¹⁶ = 0.36, in 500 steps 179 times with a deviation of 11: more
/// than 100 is 7 of them.
#[test]
fn the_best_is_the_survivor_that_has_explained_most_along_its_path() {
    let (mut died, mut steps) = (0, 0);
    for seed in 0..50 {
        let mut filter = filter(ResamplePolicy::Always, Scheme::Multinomial, seed);
        let mut paid = vec![0.0; COUNT];
        for _ in 0..10 {
            let report = filter.weigh(&SOME, &());
            for (paid, increment) in paid.iter_mut().zip(&report.log_increments) {
                *paid += increment;
            }
            let before = largest(&paid);
            assert_eq!(filter.best(), before, "seed {seed}, step {}, weighed", report.step);
            let ancestors = filter.resample();
            died += u32::from(!ancestors.contains(&(before as u32)));
            steps += 1;
            paid = ancestors.iter().map(|slot| paid[*slot as usize]).collect();
            assert_eq!(filter.best(), largest(&paid), "seed {seed}, step {}, resampled", report.step);
        }
    }
    assert!(steps == 500 && died > 100, "the best died {died} times of {steps}");
}

#[test]
fn the_evidence_is_the_mean_of_what_the_particles_paid_by_their_weights() {
    let mut filter = filter(ResamplePolicy::Never, Scheme::Systematic, 1);
    for _ in 0..3 {
        let before = filter.weights().clone();
        let report = filter.step(&SOME, &());
        let paid = before.as_slice().iter().zip(&report.log_increments).map(|(w, x)| w * ops::exp(*x));
        // Sums of 16 numbers about 1: some of the last bits.
        assert!((report.log_evidence - ops::ln(paid.sum())).abs() < 1e-14 && report.explained());
        assert_ne!(report.log_evidence, 0.0);
    }
}

/// Scores are w^τ, the policy goes by their N_eff, and a survivor keeps w / w^τ, by hand.
#[test]
fn particles_are_drawn_by_their_scores_and_keep_the_rest_of_their_weight() {
    const TEMPER: f64 = 0.3;
    let some: fn(f64) -> f64 = |normal| 2.0 * normal;
    let builder = Rbpf::builder(Nothing, Price).particles(COUNT).seed(3).policy(ResamplePolicy::Never);
    let mut filter = builder.selection_temper(TEMPER).build().unwrap();
    for step in 1..=10 {
        let report = filter.weigh(&some, &());
        let scores: Vec<f64> = report.weights.iter().map(|w| ops::exp(TEMPER * ops::ln(*w))).collect();
        let sum: f64 = scores.iter().sum();
        let ess = sum * sum / scores.iter().map(|score| score * score).sum::<f64>();
        assert!((report.selection_ess / ess - 1.0).abs() < 1e-12, "{} for {ess}", report.selection_ess);
        assert!(report.ess < report.selection_ess, "{} and {}", report.ess, report.selection_ess);

        let scores = filter.weights().tempered(TEMPER);
        let ancestors = filter.resample();
        let mut stream = Stream::at(3, Purpose::RESAMPLING, step, 0);
        assert_eq!(ancestors, Scheme::Systematic.ancestors(&scores, COUNT, &mut stream));
        let kept = ancestors.iter().map(|slot| report.weights[*slot as usize] / scores.as_slice()[*slot as usize]);
        let kept: Vec<f64> = kept.collect();
        let sum: f64 = kept.iter().sum();
        for (weight, kept) in filter.weights().as_slice().iter().zip(&kept) {
            assert!((weight - kept / sum).abs() < 1e-13, "{weight} for {}", kept / sum);
        }
    }
}

/// x′ = x + u, u ~ N(0, 1), and z = x′ + v, v ~ N(0, 1): the control is z.
#[derive(Clone)]
struct Walk;

impl Proposal<Nothing> for Walk {
    type Control = f64;

    fn propose(&self, from: &Particle<Nothing>, z: &f64, (): &(), stream: &mut Stream) -> Proposed<()> {
        let [normal] = stream.normals();
        let world_from_robot = Pose2::new(from.world_from_robot.x + normal, 0.0, 0.0);
        let log_increment = log_normal(z - world_from_robot.x, 1.0);
        Proposed { world_from_robot, association: (), log_increment, trace: ProposalTrace::Motion }
    }
}

fn log_normal(x: f64, variance: f64) -> f64 {
    -0.5 * (x * x / variance + ops::ln(core::f64::consts::TAU * variance))
}

/// The exponential of the evidence, summed over twelve steps, has the Kalman filter's p(z₁..₁₂) for its mean, whatever the temper. n = 400 filters of
/// 200 particles for each; by four standard errors of the mean, of which each is below a tenth of the evidence.
#[test]
fn the_evidence_has_no_bias_whatever_the_temper_of_selection() {
    let z: [f64; 12] = core::array::from_fn(|k| {
        let [normal] = Stream::at(5, Purpose::TRIAL, k as u32, 0).normals();
        0.2 * k as f64 + normal
    });
    let (mut mean, mut variance, mut exact) = (0.0, 0.0, 0.0);
    for z in z {
        variance += 1.0;
        exact += log_normal(z - mean, variance + 1.0);
        let gain = variance / (variance + 1.0);
        (mean, variance) = (mean + gain * (z - mean), (1.0 - gain) * variance);
    }
    for temper in [1.0, 0.3, 0.1, 0.01] {
        for policy in [ResamplePolicy::Always, ResamplePolicy::EssBelow(0.5)] {
            let ratio = |seed| {
                let filter = Rbpf::builder(Nothing, Walk).particles(200).seed(seed).policy(policy);
                let mut filter = filter.selection_temper(temper).build().unwrap();
                let log_evidence: f64 = z.iter().map(|z| filter.step(z, &()).log_evidence).sum();
                ops::exp(log_evidence - exact)
            };
            let ratios: Vec<f64> = (0..400).map(ratio).collect();
            let mean_of = |of: &dyn Fn(f64) -> f64| ratios.iter().map(|r| of(*r)).sum::<f64>() / 400.0;
            let mean = mean_of(&|r| r);
            let error = (mean_of(&|r| (r - mean) * (r - mean)) / 400.0).sqrt();
            println!("temper {temper}, {policy}: {mean} ± {error}");
            assert!(error < 0.1 && (mean - 1.0).abs() < 4.0 * error, "temper {temper}, {policy}: {mean} ± {error}");
        }
    }
}

#[test]
fn a_step_that_explains_nothing_says_so_and_leaves_weights_and_best_as_they_were() {
    for nothing in [|_| f64::NEG_INFINITY, |_| f64::NAN] as [fn(f64) -> f64; 2] {
        let mut filter = filter(ResamplePolicy::Never, Scheme::Systematic, 1);
        filter.step(&SOME, &());
        let before = (filter.weights().clone(), filter.path_weights().clone(), filter.best());
        let report = filter.step(&nothing, &());
        assert_eq!((report.log_evidence, report.explained()), (f64::NEG_INFINITY, false));
        assert_eq!((filter.weights().clone(), filter.path_weights().clone(), filter.best()), before);
        assert!(filter.step(&SOME, &()).explained());
    }
}

/// A density without bound is no density that a filter can weigh, but it is no reason to believe all particles alike either.
#[test]
fn particles_that_are_infinitely_likely_take_all_the_weight() {
    let mut filter = filter(ResamplePolicy::Never, Scheme::Systematic, 1);
    filter.step(&SOME, &());
    let before = filter.weights().as_slice().to_vec();
    let half: fn(f64) -> f64 = |normal| if normal > 0.0 { f64::INFINITY } else { 0.0 };
    let report = filter.step(&half, &());
    assert_eq!((report.log_evidence, report.explained()), (f64::INFINITY, true));
    let sure: Vec<bool> = report.log_increments.iter().map(|x| *x > 0.0).collect();
    assert!(sure.contains(&true) && sure.contains(&false) && sure[filter.best()]);
    let shared: f64 = before.iter().zip(&sure).filter_map(|(w, sure)| sure.then_some(w)).sum();
    for ((after, before), sure) in filter.weights().as_slice().iter().zip(&before).zip(&sure) {
        let expected = if *sure { before / shared } else { 0.0 };
        // Of numbers below 1: some of the last bits.
        assert!((after - expected).abs() < 1e-14, "{after} for {expected}");
    }
}

/// Draws poses whose x is the number of copies that were proposed together, and whose y is from the stream.
struct AtOnce;

impl Proposal<Nothing> for AtOnce {
    type Control = ();

    fn propose(&self, particle: &Particle<Nothing>, control: &(), seen: &(), stream: &mut Stream) -> Proposed<()> {
        self.propose_copies(particle, control, seen, core::slice::from_mut(stream)).remove(0)
    }

    fn propose_copies(&self, _: &Particle<Nothing>, (): &(), (): &(), streams: &mut [Stream]) -> Vec<Proposed<()>> {
        let count = streams.len() as f64;
        let draw = |stream: &mut Stream| Proposed {
            world_from_robot: Pose2::new(count, stream.normal(), 0.0),
            association: (),
            log_increment: stream.normal(),
            trace: ProposalTrace::Motion,
        };
        streams.iter_mut().map(draw).collect()
    }
}

/// All particles are equal at the start, and those copied from one slot in the step after a resampling. Each draws from the stream of its own
/// slot, with either executor.
#[test]
fn copies_of_a_particle_are_proposed_together_in_the_next_step() {
    let policies = [ResamplePolicy::Always, ResamplePolicy::Never, ResamplePolicy::EssBelow(0.6)];
    for (policy, scheme) in
        policies.into_iter().flat_map(|policy| [Scheme::Systematic, Scheme::Residual].map(|scheme| (policy, scheme)))
    {
        let filter = || Rbpf::builder(Nothing, AtOnce).particles(COUNT).seed(5).policy(policy).scheme(scheme);
        let mut filters = [Executor::Serial, Executor::default()].map(|by| filter().executor(by).build().unwrap());
        let mut alike = vec![COUNT; COUNT];
        for step in 1..=30 {
            let [report, other] = filters.each_mut().map(|filter| filter.step(&(), &()));
            assert_eq!(report.log_increments, other.log_increments);
            for (slot, (path, count)) in report.paths.iter().zip(&alike).enumerate() {
                let own = Stream::at(5, Purpose::PROPOSAL, step, slot as u32).normal();
                assert_eq!([path.pose().x, path.pose().y], [*count as f64, own], "step {step}, slot {slot}");
            }
            alike = vec![1; COUNT];
            if let Some(ancestors) = &report.ancestors {
                let copies = |slot: &u32| ancestors.iter().filter(|other| *other == slot).count();
                alike = ancestors.iter().map(copies).collect();
            }
        }
    }
}

/// By one stream for both, the second resampling of a step would repeat the first. Whoever resamples once a step draws from slot 0.
#[test]
fn every_resampling_of_a_step_draws_from_a_stream_of_its_own() {
    let scheme = Scheme::Multinomial;
    let mut filter = filter(ResamplePolicy::Never, scheme, 7);
    for step in 1..=3 {
        filter.weigh(&SOME, &());
        for slot in 0..3 {
            let mut stream = Stream::at(7, Purpose::RESAMPLING, step, slot);
            let expected = scheme.ancestors(filter.weights(), COUNT, &mut stream);
            assert_eq!(filter.resample(), expected, "resampling {slot} of step {step}");
        }
    }
}

/// What all particles are moved by moves the mean, and turns the covariance of the position: R Σ Rᵀ. Headings cross the cut at π.
#[test]
fn an_estimate_moves_and_turns_with_its_particles() {
    let run = |start| {
        let mut filter = drifting_from(start, ResamplePolicy::EssBelow(0.5), Scheme::Systematic, 100);
        (0..30).for_each(|_| drop(filter.step(&(), &())));
        filter.estimate()
    };
    let here = run(Pose2::default());
    assert!(here.covariance.symmetric_eigenvalues().min() > 1e-6, "a cloud with an extent: {}", here.covariance);
    for motion in [Pose2::new(3.0, -1.0, 0.0), Pose2::new(0.0, 0.0, 1.3), Pose2::new(-20.0, 7.0, 3.1)] {
        let there = run(motion);
        assert_eq!(there.best, here.best);
        // Of numbers about 20, after 30 steps: some of the last bits.
        assert!(there.mean.minus(&motion.compose(&here.mean)).norm() < 1e-12, "{motion:?}");
        let (sin, cos) = ops::sin_cos(motion.theta);
        let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        let expected = turn * here.covariance * turn.transpose();
        assert!((there.covariance - expected).norm() < 1e-12, "{motion:?}: {} {expected}", there.covariance);
    }
}
