//! Whether what is seen agrees with the noises that a filter is told: its normalised innovations squared.
//!
//! Reference: Bar-Shalom, Li, Kirubarajan, *Estimation with applications to tracking and navigation* (2001), §5.4.

use super::landmarks::{FastSlam, LandmarkLog, LandmarkMap, LandmarkReport, LandmarkRun, Learning, WithLandmarks};
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::Association;
use fastslam::motion::{Displaced, Motion};
use fastslam::nalgebra::{Matrix2, Matrix3, Vector2};
use fastslam::particle::Particle;
use fastslam::proposal::{Calibrated, Either, Proposal};
use std::collections::BTreeMap;

/// A proposal that knows where a particle is before anything is seen.
pub trait Predicts<M: WithLandmarks>: Proposal<M> {
    /// Mean and covariance (3 × 3, \[m, m, rad\]) of the particle's next pose by odometry.
    fn predicted(&self, particle: &Particle<M>, control: &Self::Control) -> (Pose2, Matrix3<f64>);
}

impl<D: Motion> Predicts<LandmarkMap> for FastSlam<D> {
    fn predicted(&self, particle: &Particle<LandmarkMap>, control: &D::Control) -> (Pose2, Matrix3<f64>) {
        let motion = match self {
            Either::Left(proposal) => &proposal.motion,
            Either::Right(proposal) => &proposal.motion,
        };
        let drive = motion.drive(control);
        (drive.apply(&particle.world_from_robot), drive.covariance(&particle.world_from_robot))
    }
}

impl<D: Motion> Predicts<Calibrated<LandmarkMap>> for Learning<D> {
    fn predicted(&self, particle: &Particle<Calibrated<LandmarkMap>>, control: &D::Control) -> (Pose2, Matrix3<f64>) {
        let (from, displacement) = (&particle.world_from_robot, self.corrected(particle.map.drift(), control));
        (Displaced.apply(from, &displacement), Displaced.covariance(from, &displacement))
    }
}

/// Normalised innovations squared of a run, νᵀ S⁻¹ ν for each feature of a mapped landmark.
///
/// ν = z − E ẑ and S = Q + Var ẑ are moments over all particles before the step, by their weights: of the noise of the sensor, of each particle's
/// landmark and next pose, and of the scatter of the particles. Where the told noises are those of the robot the mean is 2, however the
/// particles are distributed.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Innovations {
    all: Squares,
    beyond: u32,
    /// By name, of the landmarks that have one.
    named: BTreeMap<u32, Squares>,
    /// How often features of a name were taken for a landmark never seen before.
    founded: BTreeMap<u32, u32>,
}

/// Numbers, by their sum.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct Squares {
    sum: f64,
    count: u32,
}

impl Squares {
    fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / f64::from(self.count))
    }

    fn add(&mut self, squared: f64) {
        self.sum += squared;
        self.count += 1;
    }
}

/// χ²₂,₀.₉₉: one innovation in a hundred is larger.
const LARGE: f64 = 9.21;

/// Between which means of so many νᵀ S⁻¹ ν the told noises are taken to be right.
///
/// Chance alone leaves the mean within the quantiles 10⁻⁵ and 1 − 10⁻⁵ of χ²₂ₙ / n, here by Wilson and Hilferty (1931). And as innovations of one step
/// share errors, particles are few, and noises are told somewhat too large on purpose where errors repeat, standard deviations within a factor of
/// √2 down and 3 up are not worth a word.
pub fn agreeing(count: u32) -> [f64; 2] {
    const Z: f64 = 4.26;
    let spread = 1.0 / (9.0 * f64::from(count.max(1)));
    let mean_of_chi2 = |z: f64| {
        let root = (1.0 - spread + z * spread.sqrt()).max(0.0);
        2.0 * root * root * root
    };
    [mean_of_chi2(-Z).min(2.0 / 9.0), mean_of_chi2(Z).max(4.0)]
}

impl Innovations {
    /// How many features were of a mapped landmark.
    pub fn count(&self) -> u32 {
        self.all.count
    }

    /// Their mean νᵀ S⁻¹ ν; 2 is expected. `None` where there were none.
    pub fn mean(&self) -> Option<f64> {
        self.all.mean()
    }

    /// How many landmarks with names have a mean of their own that is more than twice the most that is taken to agree with the told noises: few
    /// innovations of few particles are larger together than as many independent ones.
    pub fn contradicting(&self) -> u32 {
        let contradicts = |of: &&Squares| of.mean().is_some_and(|mean| mean > 2.0 * agreeing(of.count)[1]);
        self.named.values().filter(contradicts).count() as u32
    }

    /// How often features of each name were taken for a landmark never seen before, by the best particles.
    pub fn founded(&self) -> &BTreeMap<u32, u32> {
        &self.founded
    }

    /// The share of them that is larger than 99 % should be.
    pub fn share_beyond(&self) -> f64 {
        f64::from(self.beyond) / f64::from(self.all.count.max(1))
    }

    /// [`LandmarkRun::step`], watched.
    pub fn step<D, M, P>(&mut self, run: &mut LandmarkRun<D, M, P>) -> Option<LandmarkReport>
    where
        D: Motion + Clone,
        M: WithLandmarks,
        P: Predicts<M, Control = D::Control>,
    {
        let k = run.steps_taken();
        let LandmarkLog { controls, sightings, .. } = run.log();
        let (control, features) = (controls.get(k)?, sightings.get(k)?);
        if features.is_empty() {
            return run.step();
        }
        let filter = run.filter();
        let weights = filter.weights().as_slice().to_vec();
        let before: Vec<_> = filter
            .particles()
            .iter()
            .map(|particle| (particle.map.clone(), filter.proposal().predicted(particle, control)))
            .collect();
        let features = features.clone();
        let (told, associations) = run.advance()?;
        // The slot of the best before resampling.
        let slot = told.ancestors.as_ref().map_or(run.best(), |from| from[run.best()] as usize);
        for (k, feature) in features.iter().enumerate() {
            let innovations = before.iter().zip(&weights).zip(&associations).filter_map(|((slot, w), seen)| {
                let ((map, (pose, p)), Association::Matched(index)) = (slot, M::associations(seen)[k]) else {
                    return None;
                };
                let map = map.landmarks();
                let innovation = map.get(index)?.innovation_with(map.sensor(), pose, &feature.z, |prediction| {
                    prediction.h_x * p * prediction.h_x.transpose()
                });
                Some((*w, innovation.residual, innovation.covariance))
            });
            self.add(&innovations.collect::<Vec<_>>(), feature.signature);
            if let Some(name) = feature.signature
                && matches!(M::associations(&associations[slot])[k], Association::New(_))
            {
                *self.founded.entry(name).or_default() += 1;
            }
        }
        Some(told)
    }

    /// Adds the innovation of a landmark of this name, of which each particle of this weight has mean and covariance.
    fn add(&mut self, particles: &[(f64, Vector2<f64>, Matrix2<f64>)], name: Option<u32>) {
        let weight: f64 = particles.iter().map(|(w, ..)| w).sum();
        let mean = particles.iter().map(|(w, residual, _)| residual * *w).sum::<Vector2<f64>>() / weight;
        let covariance =
            particles.iter().map(|(w, residual, s)| (s + (residual - mean) * (residual - mean).transpose()) * *w);
        let covariance = covariance.sum::<Matrix2<f64>>() / weight;
        // Seen as known by fewer than half, a landmark is new.
        if weight > 0.5
            && let Some(inverse) = covariance.try_inverse()
        {
            let squared = mean.dot(&(inverse * mean));
            self.all.add(squared);
            self.beyond += u32::from(squared > LARGE);
            name.into_iter().for_each(|name| self.named.entry(name).or_default().add(squared));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::landmarks::{Course, LandmarkSetup, Tuning};

    fn watched(course: Course, tuning: &Tuning) -> Innovations {
        let setup = LandmarkSetup { particles: 50, ..LandmarkSetup::default() };
        let mut run = LandmarkRun::new(&setup, tuning, course.simulate(1).into()).unwrap();
        let mut innovations = Innovations::default();
        while innovations.step(&mut run).is_some() {}
        innovations
    }

    /// Told right, the mean is 2 to a tenth and one in a hundred is large; told a quarter of the deviations of the sensor, or eight times all deviations, it is neither.
    #[test]
    fn the_mean_is_two_where_the_noises_are_told_right_and_nowhere_near_where_they_are_not() {
        for course in [Course::Eight, Course::Tags] {
            let right = watched(course, &course.tuning());
            let (mean, [least, most]) = (right.mean().unwrap(), agreeing(right.count()));
            assert!(
                right.count() > 200 && (1.75..2.25).contains(&mean) && least < mean && mean < most,
                "{course} {mean}"
            );
            assert!(right.share_beyond() < 0.025, "{course}: {}", right.share_beyond());
            let small = watched(course, &course.tuning().scaled(1.0, 0.25));
            assert!(small.mean().unwrap() > most && small.share_beyond() > 0.1, "{course} {small:?}");
            let large = watched(course, &course.tuning().scaled(8.0, 8.0));
            assert!(large.mean().unwrap() < least, "{course} {large:?}");
        }
    }

    /// Against tables: χ²₂ at 10⁻⁵ from either end is 2 · 10⁻⁵ and 23.0, χ²₂₀ / 10 is 0.25 and 6.1. Wilson and Hilferty are right to a fifth there.
    #[test]
    fn few_innovations_may_differ_more_from_two_than_many() {
        assert!(agreeing(1)[0] < 0.02 && (21.0..27.0).contains(&agreeing(1)[1]), "{:?}", agreeing(1));
        assert!((5.8..6.4).contains(&agreeing(10)[1]), "{:?}", agreeing(10));
        assert_eq!(agreeing(100_000), [2.0 / 9.0, 4.0]);
    }
}
