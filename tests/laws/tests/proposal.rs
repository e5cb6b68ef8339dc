//! The grid proposals against the posterior of one step, summed on a dense grid of poses.

use fastslam::experiment::lap::{ALPHAS, FROM_SCAN, GRID, LapWorld, OUTLIER, TEMPER};
use fastslam::geometry::{Gaussian3, Pose2};
use fastslam::lineage::Path;
use fastslam::map::{ConditionalMap, grid::Grid};
use fastslam::matching::{Matcher, ScanModel};
use fastslam::motion::{Motion, Odometry, OdometryModel};
use fastslam::ops;
use fastslam::proposal::{FromMotion, FromScan, Proposal, ProposalTrace, Proposed, Spread};
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Particle;
use nalgebra::Vector3;

/// A particle at the start of the lap, its map made there, and the first step's control and scan.
struct OneStep {
    particle: Particle<Grid>,
    world: LapWorld,
    from_scan: FromScan<Spread>,
}

fn one_step(matcher: Matcher) -> OneStep {
    // A fifth of the lap's noise, so that odometry and scan have about the same say.
    let motion = OdometryModel { alphas: ALPHAS }.scaled(0.2);
    let world = LapWorld::new(5, &motion, 0.02);
    let mut map = Grid::new(GRID);
    for (pose, scan) in &world.start_scans {
        map.assimilate(pose, scan, &());
    }
    let particle = Particle { world_from_robot: world.truth[0], map, path: Path::start(world.truth[0]) };
    // Tempered harder, or the posterior is too narrow for a dense grid and for the motion model's samples to meet it.
    let scan = ScanModel::new(matcher, TEMPER * 0.4, OUTLIER);
    OneStep {
        particle,
        world,
        from_scan: FromScan { fallback: FromMotion { motion, likelihood: scan }, settings: FROM_SCAN },
    }
}

/// Small enough to change nothing, and enough to make a covariance definite.
const NO_FLOOR: [f64; 3] = [1e-4; 3];

impl OneStep {
    fn prior(&self, floor: [f64; 3]) -> Gaussian3 {
        self.from_scan.fallback.motion.gaussian(&self.particle.world_from_robot, &self.world.controls[0], floor)
    }

    /// Mean of p(x | z, u, m) and ln ∫ p(z | x, m) p(x | u) dx, by summing a lattice of the prior's own axes to ±4.5 σ.
    fn dense(&self, floor: [f64; 3]) -> (Vector3<f64>, f64) {
        let (prior, scan) = (self.prior(floor), &self.world.scans[0]);
        let side: Vec<f64> = (-22..=22).map(|k| f64::from(k) * 4.5 / 22.0).collect();
        let cell = ops::ln(4.5 / 22.0) * 3.0;
        let mut poses = Vec::new();
        for a in &side {
            for b in &side {
                for c in &side {
                    let pose = prior.at([*a, *b, *c]);
                    let log_normal = -0.5 * (a * a + b * b + c * c) - 1.5 * ops::ln(core::f64::consts::TAU);
                    let log_likelihood = self.from_scan.fallback.likelihood.log_score(&self.particle.map, &pose, scan);
                    poses.push((pose.minus(prior.mean()), log_likelihood + log_normal + cell));
                }
            }
        }
        let log_evidence = ops::log_sum_exp(&poses.iter().map(|(_, w)| *w).collect::<Vec<_>>());
        (poses.iter().map(|(d, w)| d * ops::exp(w - log_evidence)).sum(), log_evidence)
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
                let mut stream = Stream::at(7, Purpose::Trial, k, 0);
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
        let (expected, log_evidence) = step.dense(NO_FLOOR);
        let (mean, error, log_mean_weight) = step.sampled(&step.from_scan.fallback, 20_000);
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

/// n = 4 000 draws; 4 standard errors, plus 6 % of the prior's standard deviations: the fit is a Gaussian through few probes, the
/// posterior of a grid is not one.
#[test]
fn the_measurement_aware_proposal_has_the_posteriors_mean() {
    for matcher in [Matcher::Cell, Matcher::SubCell] {
        let mut step = one_step(matcher);
        let floor = step.from_scan.settings.motion_floor;
        step.from_scan.settings.gain = f64::NEG_INFINITY; // the fit is what this is about, not the guard
        let (expected, log_evidence) = step.dense(floor);
        let (mean, error, log_mean_weight) = step.sampled(&step.from_scan, 4_000);
        for axis in 0..3 {
            let bound = 4.0 * error[axis] + 0.06 * spread(&step, floor)[axis];
            assert!(
                (mean[axis] - expected[axis]).abs() < bound,
                "{matcher} axis {axis}: {} for {}, ±{bound}",
                mean[axis],
                expected[axis]
            );
        }
        assert!((log_mean_weight - log_evidence).abs() < 0.1, "{matcher}: η {log_mean_weight} for {log_evidence}");
    }
}

/// On an unknown map every pose scores alike: the optimum is noise, and the motion model must be drawn from.
#[test]
fn the_matcher_fails_on_a_flat_score_surface() {
    let mut step = one_step(Matcher::SubCell);
    step.particle.map = Grid::new(GRID);
    for slot in 0..50 {
        let draw =
            |proposal: &dyn Fn(&mut Stream) -> Proposed<()>| proposal(&mut Stream::at(3, Purpose::Trial, 0, slot));
        let (control, scan) = (&step.world.controls[0], &step.world.scans[0]);
        let aware = draw(&|stream| step.from_scan.propose(&step.particle, control, scan, stream));
        assert_eq!(aware.trace, ProposalTrace::Motion);
    }
}

/// Standard deviations along x, y, θ of the prior with this floor.
fn spread(step: &OneStep, floor: [f64; 3]) -> Vector3<f64> {
    let covariance =
        step.from_scan.fallback.motion.covariance(&step.particle.world_from_robot, &step.world.controls[0]);
    (covariance.diagonal() + Vector3::from(floor.map(|std| std * std))).map(f64::sqrt)
}

/// α = 0.001 two-sided over 6 moments, n = 100 000.
#[test]
fn sampled_motions_have_the_models_moments() {
    let model = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
    let (from, n) = (Pose2::new(1.0, 2.0, 0.5), 100_000_u32);
    let u = Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 };
    let draws: Vec<Vector3<f64>> = (0..n)
        .map(|k| {
            let noisy = model.perturb(&u, &mut Stream::at(2, Purpose::Trial, k, 0));
            assert!(model.sample(&from, &u, &mut Stream::at(2, Purpose::Trial, k, 0)) == noisy.apply(&from));
            Vector3::new(noisy.rot1 - u.rot1, noisy.trans - u.trans, noisy.rot2 - u.rot2)
        })
        .collect();
    for (axis, std) in model.stds(&u).into_iter().enumerate() {
        let mean = draws.iter().map(|d| d[axis]).sum::<f64>() / f64::from(n);
        let variance = draws.iter().map(|d| d[axis] * d[axis]).sum::<f64>() / f64::from(n);
        let z = 3.8 / f64::from(n).sqrt();
        assert!(mean.abs() < z * std, "axis {axis}: mean {mean}");
        assert!((variance / (std * std) - 1.0).abs() < z * 2.0_f64.sqrt(), "axis {axis}: variance {variance}");
    }
}
