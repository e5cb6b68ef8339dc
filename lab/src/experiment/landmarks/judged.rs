//! How far from the truth a run ends, and how far others end that are told the same.

use super::{LandmarkMap, LandmarkRun, LandmarkSetup, Tuning, WithLandmarks};
use crate::baseline::EkfSlam;
use fastslam::error::SettingError;
use fastslam::geometry::{Pose2, align, rms};
use fastslam::map::ConditionalMap;
use fastslam::motion::Motion;
use fastslam::ops;
use fastslam::proposal::{FromWindow, Proposal, Windowed};
use fastslam::rbpf::Rbpf;

/// Distance of the weighted mean of all particles from the truth \[m\].
pub(super) fn error_of_mean<M: ConditionalMap, P: Proposal<M>>(filter: &Rbpf<M, P>, truth: &Pose2) -> f64 {
    let weighted = filter.particles().iter().zip(filter.weights().as_slice());
    let (x, y) =
        weighted.fold((0.0, 0.0), |(x, y), (p, w)| (x + w * p.world_from_robot.x, y + w * p.world_from_robot.y));
    ops::hypot(x - truth.x, y - truth.y)
}

impl<D: Motion + Clone, M: WithLandmarks, P: Proposal<M, Control = D::Control>> LandmarkRun<D, M, P> {
    /// Root mean square over the steps so far of the error of the weighted mean's position, each when it was made \[m\]: as the filter
    /// went, without hindsight. 0 before the first step.
    pub fn rms_online(&self) -> f64 {
        (self.squared_errors / f64::from(self.step.max(1))).sqrt()
    }

    /// Root mean square error of position of the best particle's path so far \[m\]: with hindsight, as that path is what is left of all
    /// that was tried.
    pub fn rms_best(&self) -> f64 {
        rms(&self.path(self.best()), &self.log.truth)
    }

    /// The same after the best rigid motion of that path onto the truth \[m\]: what is left when map and path may be moved as a
    /// whole.
    pub fn rms_best_aligned(&self) -> f64 {
        let path = self.path(self.best());
        let gauge = align(&path, &self.log.truth[..path.len()]);
        let aligned: Vec<Pose2> = path.iter().map(|pose| gauge.compose(pose)).collect();
        rms(&aligned, &self.log.truth)
    }

    /// Root mean square error of position of raw odometry so far \[m\].
    pub fn rms_odometry(&self) -> f64 {
        rms(&self.log.odometry[..=self.step as usize], &self.log.truth)
    }

    /// What [`Self::rms_online`] is at the end for an EKF-SLAM that is told the same of the same drive \[m\]. Its one Gaussian must commit
    /// to one association.
    pub fn rms_ekf(&self, setup: &LandmarkSetup, tuning: &Tuning<D>) -> f64 {
        let start = self.log.truth.first().copied().unwrap_or_default();
        let mut ekf = EkfSlam::new(tuning.motion.clone(), tuning.sensor, setup.correspondence.of(tuning), start);
        let mut path = Vec::with_capacity(self.log.controls.len());
        for (control, features) in self.log.controls.iter().zip(&self.log.sightings) {
            ekf.step(control, features);
            path.push(*ekf.pose());
        }
        rms(&path, self.log.truth.get(1..).unwrap_or_default())
    }

    /// What [`Self::rms_online`] is at the end for a filter that draws its poses late ([`FromWindow`]) on the same drive \[m\]: so many together,
    /// when so many steps after them are seen. Of the setup, `proposal` is not asked.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn rms_late(
        &self,
        setup: &LandmarkSetup,
        tuning: &Tuning<D>,
        [drawn, ahead]: [u32; 2],
    ) -> Result<f64, SettingError>
    where
        D::Control: Clone + Send,
    {
        let map = <Windowed<_, _>>::new(<LandmarkMap>::new(tuning.sensor, setup.correspondence.of(tuning)));
        let proposal = FromWindow { motion: tuning.motion.clone(), drawn, ahead };
        let mut filter = setup.filter(map, proposal, &self.log)?;
        let mut squared_errors = 0.0;
        for ((control, features), truth) in
            self.log.controls.iter().zip(&self.log.sightings).zip(self.log.truth.iter().skip(1))
        {
            filter.step(control, features);
            let error = error_of_mean(&filter, truth);
            squared_errors += error * error;
        }
        Ok((squared_errors / self.log.controls.len().max(1) as f64).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::landmarks::Course;

    /// The mean over the same steps: what is judged as it went is judged alike, whoever went.
    #[test]
    fn the_error_as_it_went_is_the_root_mean_square_of_the_reported_ones() {
        let (course, setup) = (Course::Tags, LandmarkSetup { particles: 5, ..LandmarkSetup::default() });
        let mut run = LandmarkRun::new(&setup, &course.tuning(), course.simulate(1).into()).unwrap();
        assert_eq!(run.rms_online(), 0.0);
        let mut squares = Vec::new();
        while let Some(report) = run.step() {
            squares.push(report.error_mean * report.error_mean);
        }
        let expected = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        assert_eq!((squares.len(), run.rms_online()), (run.log().controls.len(), expected));
    }

    /// One particle without any noise of the wheels, and a sensor too blunt to say anything: both go by the wheels alone.
    #[test]
    fn a_particle_and_the_joint_filter_are_judged_alike() {
        let course = Course::Eight;
        let tuning = course.tuning().scaled(0.0, 1e9);
        let setup = LandmarkSetup { particles: 1, ..LandmarkSetup::default() };
        let mut run = LandmarkRun::new(&setup, &tuning, course.simulate(2).into()).unwrap();
        while run.step().is_some() {}
        let [particle, joint] = [run.rms_online(), run.rms_ekf(&setup, &tuning)];
        // Of step 0, where nobody errs, both say nothing: the path's error has it in.
        let steps = run.log().controls.len() as f64;
        let wheels = run.rms_odometry() * ((steps + 1.0) / steps).sqrt();
        assert!(
            (particle - wheels).abs() < 1e-6 * wheels && (joint - wheels).abs() < 1e-6 * wheels,
            "{particle} {joint} {wheels}"
        );
    }
}
