//! Maps that are drawn along with the path, as a plain particle filter over the whole state would have them: each landmark of a particle
//! is a point.
//!
//! The filter is [`Rbpf`](fastslam::rbpf::Rbpf) all the same. What differs is what a particle keeps of a landmark, one draw of its
//! Gaussian instead of the Gaussian, and what a sighting weighs: p(z | x, m) of that point instead of ∫ p(z | x, m) p(m) dm.

use fastslam::error::SettingError;
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::map::landmarks::Landmark;
use fastslam::motion::Motion;
use fastslam::nalgebra::{Matrix2, Vector2};
use fastslam::particle::Particle;
use fastslam::proposal::{Proposal, ProposalTrace, Proposed};
use fastslam::random::Stream;
use fastslam::sensor::{Feature, LandmarkSensor};
use std::sync::Arc;

/// The landmarks of one particle: what is known of each before it is seen, and from then on a point.
#[derive(Clone, Debug)]
pub struct SampledMap {
    known: Arc<[Landmark]>,
    drawn: Arc<Vec<Option<Vector2<f64>>>>,
}

impl SampledMap {
    /// Of landmarks by index of which this much is known; none is drawn yet.
    pub fn new(known: &[Landmark]) -> Self {
        Self { known: known.into(), drawn: Arc::new(vec![None; known.len()]) }
    }

    /// The point that this particle has drawn for a landmark; `None` as long as it was not seen.
    pub fn get(&self, index: u32) -> Option<Vector2<f64>> {
        self.drawn.get(index as usize).copied().flatten()
    }

    /// The same, drawn now where it is seen for the first time; `None` for a landmark of which nothing is known.
    fn at_sight(&self, index: u32, stream: &mut Stream) -> Option<Vector2<f64>> {
        self.get(index).or_else(|| {
            let drawn = |landmark: &Landmark| Factor::of(&landmark.covariance).draw(&landmark.mean, stream);
            self.known.get(index as usize).map(drawn)
        })
    }
}

/// Cholesky's factor of a covariance, lower left.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Factor {
    first: f64,
    across: f64,
    second: f64,
}

impl Factor {
    /// L with L Lᵀ = Σ.
    pub fn of(covariance: &Matrix2<f64>) -> Self {
        let first = covariance.m11.sqrt();
        let across = covariance.m21 / first;
        Self { first, across, second: (covariance.m22 - across * across).max(0.0).sqrt() }
    }

    /// A draw of N(μ, L Lᵀ). Takes four `u64`s.
    pub fn draw(&self, mean: &Vector2<f64>, stream: &mut Stream) -> Vector2<f64> {
        let [a, b] = stream.normals();
        mean + Vector2::new(self.first * a, self.across * a + self.second * b)
    }
}

impl ConditionalMap for SampledMap {
    type Observation = [Feature];
    /// Landmarks by index, each where this particle has it.
    type Association = Vec<(u32, Vector2<f64>)>;

    /// Keeps what was drawn. That is all: what is seen later moves no point, it only weighs the particle.
    fn assimilate(&mut self, _: &Pose2, _: &[Feature], points: &Vec<(u32, Vector2<f64>)>) {
        let unseen = |(index, _): &&(u32, Vector2<f64>)| self.get(*index).is_none();
        let fresh: Vec<_> = points.iter().filter(unseen).copied().collect();
        if !fresh.is_empty() {
            let drawn = Arc::make_mut(&mut self.drawn);
            fresh.into_iter().for_each(|(index, point)| drawn[index as usize] = Some(point));
        }
    }
}

/// Draws the pose from the motion, then a point for each landmark that is seen for the first time, and weighs both by what is seen:
/// ln w += Σ ln p(z_j | x, m_j).
///
/// The pose is drawn first: of the same stream, [`FromMotion`](fastslam::proposal::FromMotion) draws the same one.
#[derive(Clone, Debug)]
pub struct WithMap<D, Z> {
    /// Noise of the motion.
    pub motion: D,
    /// What sees.
    pub sensor: Z,
}

impl<D: Motion, Z: LandmarkSensor> Proposal<SampledMap> for WithMap<D, Z> {
    type Control = D::Control;

    fn propose(
        &self,
        particle: &Particle<SampledMap>,
        control: &D::Control,
        features: &[Feature],
        stream: &mut Stream,
    ) -> Proposed<Vec<(u32, Vector2<f64>)>> {
        let world_from_robot = self.motion.drive(control).sample(&particle.world_from_robot, stream);
        let (mut log_increment, mut association) = (0.0, Vec::with_capacity(features.len()));
        for Feature { z, signature } in features.iter().filter(|feature| self.sensor.can_measure(&feature.z)) {
            let Some(index) = *signature else { continue };
            let Some(mean) = particle.map.at_sight(index, stream) else { continue };
            let point = Landmark { mean, covariance: Matrix2::zeros(), existence_count: 1, apart: 0 };
            log_increment += point.innovation(&self.sensor, &world_from_robot, z).log_likelihood();
            association.push((index, mean));
        }
        Proposed { world_from_robot, association, log_increment, trace: ProposalTrace::Motion }
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.motion.validate()?;
        self.sensor.validate()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::random::Purpose;

    /// n = 20 000 draws; four standard errors of a mean (σ/√n) and of a covariance (at most √2 σ²/√n).
    #[test]
    fn points_are_drawn_from_what_is_known_and_stay_where_they_are() {
        let covariance = Matrix2::new(0.21, 0.05, 0.05, 0.12);
        let known = [Landmark { mean: Vector2::new(4.0, 1.0), covariance, existence_count: 1, apart: 0 }];
        let n = 20_000;
        let mut draws = Vec::new();
        for slot in 0..n {
            let mut map = SampledMap::new(&known);
            let point = map.at_sight(0, &mut Stream::at(1, Purpose::TRIAL, 0, slot)).unwrap();
            map.assimilate(&Pose2::default(), &[], &vec![(0, point)]);
            map.assimilate(&Pose2::default(), &[], &vec![(0, Vector2::zeros())]);
            assert_eq!(map.at_sight(0, &mut Stream::at(2, Purpose::TRIAL, 0, slot)), Some(point));
            draws.push(point - known[0].mean);
        }
        let mean = draws.iter().sum::<Vector2<f64>>() / f64::from(n);
        let found = draws.iter().map(|d| d * d.transpose()).sum::<Matrix2<f64>>() / f64::from(n);
        assert!(mean.abs().max() < 4.0 * (0.21 / f64::from(n)).sqrt(), "{mean}");
        assert!((found - covariance).abs().max() < 4.0 * 2.0_f64.sqrt() * 0.21 / f64::from(n).sqrt(), "{found}");
        assert_eq!(SampledMap::new(&known).at_sight(1, &mut Stream::at(1, Purpose::TRIAL, 0, 0)), None);
    }
}
