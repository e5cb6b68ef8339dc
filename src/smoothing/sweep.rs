//! One sweep: a filter that is led along a path, and reconnects it to other pasts.

use super::{Settings, Smoother};
use crate::error::SettingError;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::particle::Particle;
use crate::proposal::Retrace;
use crate::random::{Purpose, Stream};
use crate::rbpf::Rbpf;
use crate::resampling::{ResamplePolicy, Scheme};
use core::borrow::Borrow as _;
use rand::Rng as _;

/// A path that a sweep has drawn.
#[derive(Clone, Debug)]
pub struct Draw<M> {
    /// The poses of steps 0 to T.
    pub path: Vec<Pose2>,
    /// The map that follows from them.
    pub map: M,
    /// At how many steps the given path was joined to another particle's past than its own.
    pub reconnected: u32,
    /// How many observations a map has taken in: ½ M T² and M T of them, where a filter needs M T.
    pub updates: u64,
}

/// A sweep under way: [`Smoother::begin`].
#[derive(Clone, Debug)]
pub struct Sweep<M, P> {
    filter: Rbpf<M, P>,
    /// The path that is given, from step 0 on.
    path: Vec<Pose2>,
    seed: u64,
    step: usize,
    reconnected: u32,
    updates: u64,
}

impl<M, P> Sweep<M, P> {
    /// How many steps are done.
    pub fn step(&self) -> usize {
        self.step
    }

    /// How many observations a map has taken in.
    pub fn updates(&self) -> u64 {
        self.updates
    }
}

impl<M: ConditionalMap, P: Retrace<M> + Clone> Smoother<M, P> {
    /// Begins a sweep that is to be done step by step.
    ///
    /// # Errors
    /// As [`Smoother::sweep`].
    pub fn begin(&self, number: u32, path: &[Pose2]) -> Result<Sweep<M, P>, SettingError> {
        let fits = path.len() == self.step_count() + 1 && path[0] == self.start;
        if !fits {
            return Err(SettingError::Unfit { field: "path", allowed: "the start, and a pose after each control" });
        }
        let drivable = path
            .windows(2)
            .zip(&*self.controls)
            .all(|(poses, control)| self.proposal.log_motion(&poses[0], control, &poses[1]).is_finite());
        if !drivable {
            let allowed = "one that the motion can drive, by a density (motion::Floored gives it one)";
            return Err(SettingError::Unfit { field: "path", allowed });
        }
        let Settings { particles, seed, ref executor, .. } = self.settings;
        // A sweep's filter has the streams of a seed of its own.
        let seed = Stream::at(seed, Purpose::SMOOTHING, number, 0).next_u64();
        let filter = Rbpf::builder(self.map.clone(), self.proposal.clone())
            .particles(particles)
            .seed(seed)
            .start(self.start)
            .policy(ResamplePolicy::Never)
            .executor(executor.clone())
            .build()?;
        Ok(Sweep { filter, path: path.to_vec(), seed, step: 0, reconnected: 0, updates: 0 })
    }

    /// Does one step of a sweep. Returns the path that was drawn after the last one.
    pub fn advance(&self, sweep: &mut Sweep<M, P>) -> Option<Draw<M>> {
        let t = sweep.step;
        if t < self.step_count() {
            if t > 0 {
                let ancestors = self.ancestors(sweep);
                sweep.filter.copy(&ancestors); // all were at the start before the first step
            }
            sweep.filter.weigh_along(&self.controls[t], self.observations[t].borrow(), &sweep.path[t + 1]);
            sweep.updates += sweep.filter.particles().len() as u64;
            sweep.step += 1;
        }
        (sweep.step == self.step_count()).then(|| self.draw(sweep))
    }

    /// Ancestors of all slots: those of the free ones by the weights; that of the given path by what it explains of the future.
    fn ancestors(&self, sweep: &mut Sweep<M, P>) -> Vec<u32> {
        let (t, last) = (sweep.step, sweep.filter.particles().len() - 1);
        let mut stream = Stream::at(sweep.seed, Purpose::RESAMPLING, t as u32, 0);
        let mut ancestors = Scheme::Multinomial.ancestors(sweep.filter.weights(), last, &mut stream);
        ancestors.push(self.reconnect(sweep).unwrap_or(last as u32));
        sweep.reconnected += u32::from(ancestors[last] != last as u32);
        ancestors
    }

    /// The ancestor of the given path's next pose, drawn by w · p(x′ | x, u) · p(z from there on | x′ from there on, m). `None` where it is
    /// to keep its own, or where none can be had.
    fn reconnect(&self, sweep: &mut Sweep<M, P>) -> Option<u32> {
        let t = sweep.step;
        let reach = self.settings.reconnect.reach(self.step_count() - t);
        if reach == 0 {
            return None;
        }
        let (proposal, control) = (&self.proposal, &self.controls[t]);
        let (path, observations) = (&sweep.path[t + 1..], &self.observations[t..t + reach]);
        let particles = sweep.filter.particles();
        let maps: Vec<&M> = particles.iter().map(|particle| &particle.map).collect();
        let said = proposal.log_likelihoods_along(&maps, path, observations, &self.settings.executor);
        let join = |(particle, said): (&Particle<M>, &Vec<f64>)| {
            let log_motion = proposal.log_motion(&particle.world_from_robot, control, &path[0]);
            said.iter().fold(log_motion, |sum, log_likelihood| sum + log_likelihood)
        };
        let log_joins: Vec<f64> = particles.iter().zip(&said).map(join).collect();
        sweep.updates += (particles.len() * reach) as u64;
        let (weights, log_sum) = sweep.filter.weights().reweighted(&log_joins);
        let mut stream = Stream::at(sweep.seed, Purpose::SMOOTHING, t as u32, 0);
        log_sum.is_finite().then(|| Scheme::Multinomial.ancestors(&weights, 1, &mut stream)[0])
    }

    /// One of the paths, by the weights.
    fn draw(&self, sweep: &Sweep<M, P>) -> Draw<M> {
        let mut stream = Stream::at(sweep.seed, Purpose::SMOOTHING, sweep.step as u32, 1);
        let slot = Scheme::Multinomial.ancestors(sweep.filter.weights(), 1, &mut stream)[0];
        let particle = &sweep.filter.particles()[slot as usize];
        Draw {
            path: particle.path.poses(),
            map: particle.map.clone(),
            reconnected: sweep.reconnected,
            updates: sweep.updates,
        }
    }
}
