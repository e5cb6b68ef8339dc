//! The measurement-aware proposal for grids: look first, then move.
//!
//! Reference: Grisetti, Stachniss, Burgard, *Improved techniques for grid mapping with Rao-Blackwellized particle filters*,
//! T-RO 2007, §IV and algorithm 1.

use super::{FromMotion, Proposal, ProposalTrace, Proposed};
use crate::geometry::{Gaussian3, Pose2};
use crate::map::grid::{Grid, View};
use crate::matching::{Climb, ClimbSteps, ScanModel, climb};
use crate::motion::{Odometry, OdometryModel};
use crate::ops;
use crate::random::Stream;
use crate::rbpf::Particle;
use crate::sensor::Scan;
use nalgebra::{Matrix3, Vector3};

/// Settings of [`FromScan`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FromScanSettings {
    /// Floor of the motion Gaussian's standard deviations \[m, m, rad\].
    pub motion_floor: [f64; 3],
    /// Step sizes of the hill climb.
    pub climb: ClimbSteps,
    /// The climb looks at every n-th beam.
    pub climb_stride: usize,
    /// Step of the coarse lattice.
    pub lattice: f64,
    /// Seeds of the climb besides the odometry's prediction.
    pub seeds: u32,
    /// How much better than the mean likelihood over the seeds the mode must be for the matcher to be trusted \[nats\].
    pub gain: f64,
    /// Share of ln η that goes into the weight, 0 to 1.
    pub weight_share: f64,
    /// Number of probes K.
    pub probes: u32,
    /// Limits of the standard deviations of the probes along each axis \[m, m, rad\]: least and most.
    pub probe_stds: [[f64; 3]; 2],
}

/// Seeds reach this many standard deviations of the heading to each side. Heading is what a climb is lost
/// by: a few degrees more, and far end points fall on the wrong wall.
const SPREAD: f64 = 3.0;

/// How far from the prediction a match may lie \[m\] and be looked up fast.
const SLACK: f64 = 1.0;

/// The gmapping recipe: find the mode, probe around it, fit a Gaussian, sample it, pay the normaliser η.
#[derive(Clone, Debug)]
pub struct FromScan {
    /// The models, and what is done where the matcher fails.
    pub fallback: FromMotion<OdometryModel, ScanModel>,
    /// Tuning.
    pub settings: FromScanSettings,
}

impl<const FINE: usize> Proposal<Grid<FINE>> for FromScan {
    type Control = Odometry;

    // anchor: propose
    fn propose(&self, particle: &Particle<Grid<FINE>>, u: &Odometry, scan: &Scan, stream: &mut Stream) -> Proposed<()> {
        let settings = &self.settings;
        let prior = self.fallback.motion.gaussian(&particle.world_from_robot, u, settings.motion_floor);
        let reach = scan.hits.iter().map(|[x, y]| x * x + y * y).fold(0.0, f64::max).sqrt();
        let view = View::new(&particle.map, [prior.mean().x, prior.mean().y], reach + SLACK);
        let log_target =
            |pose: &Pose2| self.fallback.likelihood.log_likelihood(&view, pose, scan) + prior.log_density(pose);
        // The search looks at a thinner scan, in which each beam counts for those left out.
        let (thin, share) = (scan.thinned(settings.climb_stride), settings.climb_stride as f64);
        let log_thin = |pose: &Pose2, floor: f64| {
            share * self.fallback.likelihood.log_likelihood_above(floor / share, &view, pose, &thin)
        };

        // Seeds: the prediction, and poses spread over the prior's heading, so that the climb begins on the right slope.
        let mut log_seeds = vec![log_thin(prior.mean(), f64::NEG_INFINITY)];
        let mut best = Climb { pose: *prior.mean(), value: log_seeds[0] + prior.log_density(prior.mean()) };
        let mut starts: Vec<(f64, Pose2)> = Vec::new();
        if settings.lattice > 0.0 {
            let few = scan.thinned(crate::experiment::log::knob("CSTRIDE", 4.0) as usize);
            let share = scan.hits.len() as f64 / few.hits.len().max(1) as f64;
            let c = prior.covariance();
            let [sx, sy, st] = [c.m11, c.m22, c.m33].map(f64::sqrt);
            let astep = crate::experiment::log::knob("ASTEP", 0.05);
            let n = |s: f64, step: f64, most: f64| ((SPREAD * s / step).ceil().min(most)) as i32;
            let m = prior.mean();
            let (nx, ny, nt) = (n(sx, settings.lattice, 5.0), n(sy, settings.lattice, 5.0), n(st, astep, 20.0));
            let least = prior.log_density(m) - 0.5 * SPREAD * SPREAD;
            for t in -nt..=nt {
                let theta = m.theta + f64::from(t) * astep;
                let (sin, cos) = ops::sin_cos(theta);
                let k = view.per_square();
                let turned: Vec<[f64; 2]> = few.hits.iter().map(|[x, y]| [(cos * x - sin * y) * k, (sin * x + cos * y) * k]).collect();
                for j in -ny..=ny { for i in -nx..=nx {
                    let pose = Pose2::new(m.x + f64::from(i) * settings.lattice, m.y + f64::from(j) * settings.lattice, theta);
                    let log_prior = prior.log_density(&pose);
                    if log_prior >= least {
                        starts.push((log_prior + share * self.fallback.likelihood.coarse(&view, &turned, [pose.x, pose.y]), pose));
                    }
                }}
            }
            starts.sort_by(|a, b| b.0.total_cmp(&a.0));
            let climbs = crate::experiment::log::knob("CLIMBS", 3.0) as usize;
            let mut picked: Vec<Pose2> = Vec::new();
            for (_, pose) in &starts {
                if picked.len() >= climbs { break; }
                if picked.iter().all(|p| { let d = p.minus(pose); d.x.abs().max(d.y.abs()) > 1.5 * settings.lattice || d.z.abs() > 1.5 * astep }) { picked.push(*pose); }
            }
            for pose in picked {
                let value = log_thin(&pose, f64::NEG_INFINITY) + prior.log_density(&pose);
                let end = climb(Climb { pose, value }, settings.climb, |pose, value| {
                    let log_prior = prior.log_density(pose);
                    log_prior + log_thin(pose, value - log_prior)
                });
                if end.value > best.value { best = end; }
            }
        }
        for k in 0..settings.seeds {
            let heading = SPREAD * ((f64::from(k) + 0.5) / f64::from(settings.seeds) * 2.0 - 1.0);
            let [a, b] = stream.normals();
            let pose = prior.at([heading, a, b]);
            let log_seed = log_thin(&pose, f64::NEG_INFINITY);
            log_seeds.push(log_seed);
            let value = log_seed + prior.log_density(&pose);
            if value > best.value {
                best = Climb { pose, value };
            }
        }
        let top = climb(best, settings.climb, |pose, value| {
            let log_prior = prior.log_density(pose);
            log_prior + log_thin(pose, value - log_prior)
        });

        // The guard: on a flat score surface the optimum is noise, no better than what the motion model would draw anyway.
        let log_mean = ops::log_sum_exp(&log_seeds) - ops::ln(log_seeds.len() as f64);
        if top.value - prior.log_density(&top.pose) - log_mean < settings.gain {
            return self.fallback.propose(particle, u, scan, stream);
        }
        let mode = Climb { pose: top.pose, value: log_target(&top.pose) };

        // Probes around the mode, as wide as the target is there; each weighs τ_k = target / density of the probes.
        let around = self.probe_gaussian(&mode, log_target);
        let probes: Vec<(Pose2, f64)> = (0..settings.probes)
            .map(|_| around.sample(stream))
            .map(|pose| (pose, log_target(&pose) - around.log_density(&pose)))
            .collect();
        let log_taus: Vec<f64> = probes.iter().map(|(_, log_tau)| *log_tau).collect();
        let log_sum = ops::log_sum_exp(&log_taus);

        // μ and Σ of the weighted probes, as differences from the mode (angles wrapped).
        let (mut mu, mut second) = (Vector3::zeros(), Matrix3::zeros());
        for (pose, log_tau) in &probes {
            let (d, tau) = (pose.minus(&mode.pose), ops::exp(log_tau - log_sum));
            mu += d * tau;
            second += d * d.transpose() * tau;
        }
        let floor = Matrix3::from_diagonal(&Vector3::from(settings.probe_stds[0].map(|std| 0.25 * std * std)));
        let sigma = second - mu * mu.transpose() + floor;
        let Some(fitted) = Gaussian3::new(mode.pose.plus(&mu), sigma) else {
            return self.fallback.propose(particle, u, scan, stream);
        };
        let log_eta = log_sum - ops::ln(f64::from(settings.probes));
        Proposed {
            world_from_robot: fitted.sample(stream),
            association: (),
            log_increment: settings.weight_share * log_eta,
            trace: ProposalTrace::Matched { mode: mode.pose },
        }
    }
    // end: propose
}

impl FromScan {
    /// A Gaussian at the mode, with standard deviations from the curvature of the target along each axis (Laplace), kept within
    /// the limits.
    fn probe_gaussian(&self, mode: &Climb, log_target: impl Fn(&Pose2) -> f64) -> Gaussian3 {
        let [least, most] = self.settings.probe_stds;
        let mut variances = Vector3::zeros();
        for axis in 0..3 {
            let mut step = Vector3::zeros();
            step[axis] = least[axis].max(0.25 * most[axis]);
            let drop = 2.0 * mode.value - log_target(&mode.pose.plus(&step)) - log_target(&mode.pose.plus(&-step));
            // −f″ ≈ drop / h²; σ² = h² / drop, and a plateau takes the most.
            let std = if drop > 0.0 { (step[axis] * step[axis] / drop).sqrt() } else { most[axis] };
            let std = std.max(least[axis]).min(most[axis]);
            variances[axis] = std * std;
        }
        Gaussian3::new(mode.pose, Matrix3::from_diagonal(&variances)).expect("limits of probe_stds are positive")
    }
}
