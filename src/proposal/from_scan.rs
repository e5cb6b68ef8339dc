//! The measurement-aware proposal for grids: look first, then move.
//!
//! Reference: Grisetti, Stachniss, Burgard, *Improved techniques for grid mapping with Rao-Blackwellized particle filters*,
//! T-RO 2007, §IV and algorithm 1.

use super::{FromMotion, Proposal, ProposalTrace, Proposed};
use crate::geometry::{Gaussian3, Pose2};
use crate::map::grid::Grid;
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
    /// Seeds of the climb besides the odometry's prediction.
    pub seeds: u32,
    /// How much better than the mean likelihood over the seeds the mode must be for the matcher to be trusted \[nats\].
    pub gain: f64,
    /// Number of probes K.
    pub probes: u32,
    /// Limits of the standard deviations of the probes along each axis \[m, m, rad\]: least and most.
    pub probe_stds: [[f64; 3]; 2],
}

/// Seeds reach this many standard deviations of the heading to each side. Heading is what a climb is lost
/// by: a few degrees more, and far end points fall on the wrong wall.
const SPREAD: f64 = 3.0;

/// The gmapping recipe: find the mode, probe around it, fit a Gaussian, sample it, pay the normaliser η.
#[derive(Clone, Debug)]
pub struct FromScan {
    /// The models, and what is done where the matcher fails.
    pub fallback: FromMotion<OdometryModel, ScanModel>,
    /// Tuning.
    pub settings: FromScanSettings,
}

impl Proposal<Grid> for FromScan {
    type Control = Odometry;

    // anchor: propose
    fn propose(&self, particle: &Particle<Grid>, u: &Odometry, scan: &Scan, stream: &mut Stream) -> Proposed<()> {
        let settings = &self.settings;
        // ANCHOR: predict
        let prior = self.fallback.motion.gaussian(&particle.world_from_robot, u, settings.motion_floor);
        // ANCHOR_END: predict
        let log_target =
            |pose: &Pose2| self.fallback.likelihood.log_likelihood(&particle.map, pose, scan) + prior.log_density(pose);
        // The search looks at a thinner scan, in which each beam counts for those left out.
        let (thin, share) = (scan.thinned(settings.climb_stride), settings.climb_stride as f64);
        let log_thin = |pose: &Pose2, floor: f64| {
            share * self.fallback.likelihood.log_likelihood_above(floor / share, &particle.map, pose, &thin)
        };

        // Seeds: the prediction, and poses spread over the prior's heading, so that the climb begins on the right slope.
        // ANCHOR: seeds
        let mut log_seeds = vec![log_thin(prior.mean(), f64::NEG_INFINITY)];
        let mut best = Climb { pose: *prior.mean(), value: log_seeds[0] + prior.log_density(prior.mean()) };
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
        // ANCHOR_END: seeds
        // ANCHOR: match
        let top = climb(best, settings.climb, |pose, value| {
            let log_prior = prior.log_density(pose);
            log_prior + log_thin(pose, value - log_prior)
        });
        // ANCHOR_END: match

        // The guard: on a flat score surface the optimum is noise, no better than what the motion model would draw anyway.
        // ANCHOR: guard
        let log_mean = ops::log_sum_exp(&log_seeds) - ops::ln(log_seeds.len() as f64);
        if top.value - prior.log_density(&top.pose) - log_mean < settings.gain {
            return self.fallback.propose(particle, u, scan, stream);
        }
        // ANCHOR_END: guard
        let mode = Climb { pose: top.pose, value: log_target(&top.pose) };

        // Probes around the mode, as wide as the target is there; each weighs τ_k = target / density of the probes.
        // ANCHOR: probe
        let around = self.probe_gaussian(&mode, log_target);
        let probes: Vec<(Pose2, f64)> = (0..settings.probes)
            .map(|_| around.sample(stream))
            .map(|pose| (pose, log_target(&pose) - around.log_density(&pose)))
            .collect();
        let log_taus: Vec<f64> = probes.iter().map(|(_, log_tau)| *log_tau).collect();
        let log_sum = ops::log_sum_exp(&log_taus);
        // ANCHOR_END: probe

        // μ and Σ of the weighted probes, as differences from the mode (angles wrapped).
        // ANCHOR: fit
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
        // ANCHOR_END: fit
        // ANCHOR: eta
        let log_eta = log_sum - ops::ln(f64::from(settings.probes));
        // ANCHOR_END: eta
        Proposed {
            // ANCHOR: draw
            world_from_robot: fitted.sample(stream),
            // ANCHOR_END: draw
            association: (),
            log_increment: log_eta,
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
