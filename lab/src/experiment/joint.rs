//! What if the map were sampled too? One filter draws every landmark along with the path, the other computes it: the same log, the same
//! motion, the same number of particles.
//!
//! A robot drives a metre and then looks at the [`MOST`] landmarks around it, one a step. Of each it is known beforehand what the chapter's
//! worked example knows of its landmark, and each is seen just where it was expected: the kindest log that there can be. Nobody resamples.
//!
//! How N_eff falls has a closed form. Where all is linear, a weight is exp(−½ eᵀ B⁻¹ e) of what was drawn, e ~ N(0, P), against what was
//! not, B. So E\[wᵏ\] ∝ |I + k B⁻¹ P|^(−1/2), and N_eff / M = E\[w\]² / E\[w²\]. What the sampled map draws is path and landmarks:
//! B = Q, P = H_m Σ H_mᵀ + H_x R H_xᵀ. What the computed one draws is the path alone: B = Q + H_m Σ H_mᵀ, P = H_x R H_xᵀ. With a path that
//! is known, R = 0, the first is M ρ^(−N) with ρ = Π (1 + s) / √(1 + 2s) over the two coordinates of a sighting: exercise 2 of the
//! chapter; and with one landmark and a computed map it is [`predicted_ess`](crate::baseline::one_step::predicted_ess).

mod block;

use crate::digest::Digest;
use block::{BLOCK, Block, Look, Weighed};
use core::f64::consts::TAU;
use fastslam::error::{Range, SettingError};
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::Landmark;
use fastslam::motion::{Motion, Odometry, OdometryModel};
use fastslam::nalgebra::{Matrix2, Matrix3, Vector2};
use fastslam::ops;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use std::sync::Arc;

/// How many landmarks there are: as many as the chapter's opening counts.
pub const MOST: u32 = 24;

/// How far each is from the robot \[m\].
pub const DISTANCE: f64 = 4.0;

/// What is known of each before: variance along the line of sight and across it \[m²\].
pub const KNOWN: [f64; 2] = [0.21, 0.12];

/// The sensor, at scale 1.
const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.2, bearing_std: 0.05, max_range: f64::INFINITY, field_of_view: TAU };

/// The wheels, at scale 1: over a metre 5 cm along, 3 cm across, and 0.04 rad.
const WHEELS: OdometryModel = OdometryModel { alphas: [0.0, 0.0009, 0.0025, 0.0] };

/// The drive before the first look; then the robot stands.
const DRIVE: Odometry = Odometry { rot1: 0.0, trans: 1.0, rot2: 0.0 };

/// Most repeats, least, and how many particles all of them have together where that allows more than the least.
const REPEATS: [u32; 2] = [40, 6];
const TOGETHER: u32 = 60_000;

/// Both filters: the sampled map, and the computed one.
pub const SAMPLED: usize = 0;
/// See [`SAMPLED`].
pub const COMPUTED: usize = 1;

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct JointSetup {
    /// Number of particles M of each filter, 1 to 20 000.
    pub particles: u32,
    /// Factor on the standard deviations of the sensor, 0.2 m and 0.05 rad at 1; 0.1 to 10.
    pub sensor_scale: f64,
    /// Factor on the standard deviations of the wheels, 0 to 3: at 0 the path is known.
    pub odometry_scale: f64,
    /// Picks the draws of both filters.
    pub seed: u64,
}

impl Default for JointSetup {
    fn default() -> Self {
        Self { particles: 1000, sensor_scale: 1.0, odometry_scale: 1.0, seed: 1 }
    }
}

impl JointSetup {
    fn validate(&self) -> Result<(), SettingError> {
        Range::whole(1, 20_000).check("particles", f64::from(self.particles))?;
        Range::number(0.1, 10.0, "").check("sensor_scale", self.sensor_scale)?;
        Range::number(0.0, 3.0, "").check("odometry_scale", self.odometry_scale).map(drop)
    }

    /// How often both filters run on the log: fewer times with many particles.
    pub fn repeats(&self) -> u32 {
        (TOGETHER / self.particles).clamp(REPEATS[1], REPEATS[0])
    }

    fn sensor(&self) -> RangeBearing {
        SENSOR.scaled(self.sensor_scale)
    }

    fn motion(&self) -> OdometryModel {
        WHEELS.scaled(self.odometry_scale)
    }
}

/// What a filter has come to after it has seen some landmarks.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Population {
    /// N_eff.
    pub ess: f64,
    /// How many particles a resampling would leave descendants of.
    pub left: u32,
    /// Where it believes the first landmark to be: the weighted mean \[m\].
    pub first: [f64; 2],
}

/// One run of both filters on the log: of each, what it came to after 1, 2, … landmarks.
pub type Repeat = [Vec<Population>; 2];

/// What is on the log, and what can be said of it beforehand.
#[derive(Clone, PartialEq, Debug)]
pub struct Log {
    /// Where the robot stands and looks.
    pub robot: Pose2,
    /// What is known of each landmark before.
    pub known: Vec<Landmark>,
    /// One sighting a step.
    pub features: Vec<Feature>,
    setup: JointSetup,
}

impl Log {
    fn new(setup: &JointSetup) -> Self {
        let (robot, sensor) = (DRIVE.apply(&Pose2::default()), setup.sensor());
        let landmark = |k: u32| {
            // One here, one there, so that a few are not all on one side.
            let turn = rotation(TAU * f64::from(k * 7 % MOST) / f64::from(MOST));
            let mean = Vector2::new(robot.x, robot.y) + turn * Vector2::new(DISTANCE, 0.0);
            let along = Matrix2::new(KNOWN[0], 0.0, 0.0, KNOWN[1]);
            Landmark { mean, covariance: turn * along * turn.transpose(), existence_count: 1, apart: 0 }
        };
        let known: Vec<Landmark> = (0..MOST).map(landmark).collect();
        let see = |(index, landmark): (u32, &Landmark)| Feature {
            z: sensor.predict(&robot, &landmark.mean).z,
            signature: Some(index),
        };
        let features = (0..).zip(&known).map(see).collect();
        Self { robot, known, features, setup: setup.clone() }
    }

    /// ln E\[(w / w_max)ᵏ\] after so many landmarks: −½ ln |I + k B⁻¹ P|, by the rule for determinants with a term of rank three.
    fn log_moment(&self, filter: usize, landmarks: u32, k: f64) -> f64 {
        let motion = self.setup.motion().covariance(&Pose2::default(), &DRIVE);
        let (mut log_determinant, mut information) = (0.0, Matrix3::zeros());
        for landmark in &self.known[..landmarks as usize] {
            let prediction = self.setup.sensor().predict(&self.robot, &landmark.mean);
            let noise = self.setup.sensor().noise();
            let of_map = prediction.h_m * landmark.covariance * prediction.h_m.transpose();
            let (drawn, kept) = if filter == SAMPLED { (of_map, noise) } else { (Matrix2::zeros(), noise + of_map) };
            let both = kept + drawn * k;
            log_determinant += ops::ln(both.determinant() / kept.determinant());
            let inverse = both.try_inverse().unwrap_or_else(Matrix2::zeros);
            information += prediction.h_x.transpose() * inverse * prediction.h_x * k;
        }
        -0.5 * (log_determinant + ops::ln((Matrix3::identity() + motion * information).determinant()))
    }

    /// N_eff / M of a filter after so many landmarks, where all is linear and the particles are many.
    pub fn predicted_share(&self, filter: usize, landmarks: u32) -> f64 {
        let [one, two] = [1.0, 2.0].map(|k| self.log_moment(filter, landmarks, k));
        ops::exp(2.0 * one - two)
    }

    /// Standard deviation of ln N_eff of so many particles about the log of [`Self::predicted_share`], as long as it is well below 1. By
    /// the delta method: it is that of 2 w / E\[w\] − w² / E\[w²\], over √M.
    pub fn predicted_std(&self, filter: usize, landmarks: u32, particles: f64) -> f64 {
        let [a, b, c, d] = [1.0, 2.0, 3.0, 4.0].map(|k| self.log_moment(filter, landmarks, k));
        let ratio = |log: f64| ops::exp(log) - 1.0;
        ((4.0 * ratio(b - 2.0 * a) - 4.0 * ratio(c - a - b) + ratio(d - 2.0 * b)) / particles).sqrt()
    }

    /// ρ of a landmark that is drawn, with a path that is known: by what a sighting of one divides N_eff.
    pub fn rho(&self) -> f64 {
        let known = JointSetup { odometry_scale: 0.0, ..self.setup.clone() };
        1.0 / Self { setup: known, ..self.clone() }.predicted_share(SAMPLED, 1)
    }
}

fn rotation(angle: f64) -> Matrix2<f64> {
    let (sin, cos) = ops::sin_cos(angle);
    Matrix2::new(cos, -sin, sin, cos)
}

/// Both filters on one log, over and over, with other draws each time.
#[derive(Clone, Debug)]
pub struct Joint {
    setup: JointSetup,
    log: Log,
    repeats: Vec<Repeat>,
    /// Present repeat: number of finished blocks, the block under way, the landmarks that it has observed, and the weights so far.
    finished: u32,
    block: Arc<Block>,
    seen: u32,
    weighed: [Weighed; 2],
    populations: Repeat,
    /// Blocks of all repeats so far, if they are kept for another noise of the sensor.
    drawn: Option<Vec<Arc<Block>>>,
}

impl Joint {
    /// Before its first step.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn new(setup: &JointSetup) -> Result<Self, SettingError> {
        setup.validate()?;
        let log = Log::new(setup);
        let block = Block::new(setup, 0, 0).into();
        let (setup, repeats, drawn) = (setup.clone(), Vec::new(), None);
        let (weighed, populations) = Default::default();
        Ok(Self { setup, log, repeats, finished: 0, block, seen: 0, weighed, populations, drawn })
    }

    /// A run with other settings. If they differ in the noise of the sensor only, samples are taken over, and kept for the next run.
    ///
    /// # Errors
    /// Where a setting is out of its range.
    pub fn asked(&self, setup: &JointSetup) -> Result<Self, SettingError> {
        let mut asked = Self::new(setup)?;
        if self.draws_for(setup) && setup.particles * setup.repeats() <= TOGETHER {
            asked.drawn = Some(self.drawn.clone().unwrap_or_default());
            asked.block = asked.block_of(0, 0);
        }
        Ok(asked)
    }

    /// Whether a run with these settings draws the same samples.
    pub fn draws_for(&self, setup: &JointSetup) -> bool {
        self.setup == JointSetup { sensor_scale: self.setup.sensor_scale, ..setup.clone() }
    }

    /// Frees the memory of the samples; results are kept.
    pub fn forget_draws(&mut self) {
        self.drawn = None;
    }

    /// A block with its samples if they are kept, or else without any.
    fn block_of(&self, repeat: u32, block: u32) -> Arc<Block> {
        let known = self.drawn.as_ref().and_then(|drawn| drawn.get((repeat * self.blocks() + block) as usize));
        known.cloned().unwrap_or_else(|| Block::new(&self.setup, repeat, block).into())
    }

    /// What was set.
    pub fn setup(&self) -> &JointSetup {
        &self.setup
    }

    /// What both filters read.
    pub fn log(&self) -> &Log {
        &self.log
    }

    /// All runs that are finished.
    pub fn repeats(&self) -> &[Repeat] {
        &self.repeats
    }

    fn blocks(&self) -> u32 {
        self.setup.particles.div_ceil(BLOCK)
    }

    /// Calls of [`Self::advance`] that are still to be made.
    pub fn pending(&self) -> u32 {
        let each = (self.blocks() + 1) * MOST;
        let done = self.finished * MOST + self.seen + self.populations[SAMPLED].len() as u32;
        (self.setup.repeats() - self.repeats.len() as u32) * each - if self.is_done() { 0 } else { done }
    }

    fn is_done(&self) -> bool {
        self.repeats.len() as u32 == self.setup.repeats()
    }

    /// The next bit of work, while there is one: a landmark for a block of particles, or where all blocks have seen all, what they have
    /// come to after a landmark.
    ///
    /// # Errors
    /// None after [`Self::new`].
    pub fn advance(&mut self) -> Result<(), SettingError> {
        let repeat = self.repeats.len() as u32;
        if self.is_done() {
            return Ok(());
        }
        if self.finished < self.blocks() {
            let (look, seen) = (Look::new(&self.log, self.seen as usize), self.seen as usize);
            if seen == self.block.residuals.len() {
                Arc::make_mut(&mut self.block).draw(&self.log, &look);
            }
            self.block.weigh(&look, seen, &mut self.weighed);
            self.seen += 1;
            if self.seen == MOST {
                (self.seen, self.finished) = (0, self.finished + 1);
                let next = if self.finished < self.blocks() { (repeat, self.finished) } else { (repeat + 1, 0) };
                let next = self.block_of(next.0, next.1);
                let block = core::mem::replace(&mut self.block, next);
                self.remember(block, repeat);
            }
            return Ok(());
        }
        let seen = self.populations[SAMPLED].len();
        let seed = self.setup.seed + (u64::from(repeat) << 32);
        for (populations, weighed) in self.populations.iter_mut().zip(&self.weighed) {
            populations.push(weighed.population(seen, seed));
        }
        if seen + 1 == MOST as usize {
            self.repeats.push(core::mem::take(&mut self.populations));
            (self.finished, self.weighed) = Default::default();
        }
        Ok(())
    }

    /// Keeps the samples of a finished block, if that is wanted and they are new.
    fn remember(&mut self, block: Arc<Block>, repeat: u32) {
        let number = (repeat * self.blocks() + self.finished - 1) as usize;
        if let Some(drawn) = self.drawn.as_mut().filter(|drawn| drawn.len() == number) {
            drawn.push(block);
        }
    }

    /// All work that is left.
    ///
    /// # Errors
    /// None after [`Self::new`].
    pub fn finish(&mut self) -> Result<(), SettingError> {
        while self.pending() > 0 {
            self.advance()?;
        }
        Ok(())
    }

    /// The first run's population of a filter after so many landmarks, from 1 on.
    pub fn population(&self, filter: usize, landmarks: u32) -> Option<&Population> {
        self.repeats.first()?[filter].get(landmarks.checked_sub(1)? as usize)
    }

    /// Where a filter believes the first landmark to be after so many, in each repeat \[m\].
    pub fn estimates(&self, filter: usize, landmarks: u32) -> Vec<[f64; 2]> {
        let after = |repeat: &Repeat| repeat[filter].get(landmarks.checked_sub(1)? as usize).map(|found| found.first);
        self.repeats.iter().filter_map(after).collect()
    }

    /// Variance of such an estimate over the repeats, of both coordinates together \[m²\]; not a number of fewer than two.
    pub fn variance(&self, filter: usize, landmarks: u32) -> f64 {
        let estimates = self.estimates(filter, landmarks);
        let n = estimates.len() as f64;
        let along = |axis: usize| {
            let mean = estimates.iter().map(|place| place[axis]).sum::<f64>() / n;
            estimates.iter().map(|place| (place[axis] - mean) * (place[axis] - mean)).sum::<f64>()
        };
        if n < 2.0 { f64::NAN } else { (along(0) + along(1)) / (n - 1.0) }
    }

    /// The share of the variance that computing the map has removed: E\[Var\[δ | a\]\] / Var\[δ\], by the law of total variance.
    pub fn removed(&self, landmarks: u32) -> f64 {
        1.0 - self.variance(COMPUTED, landmarks) / self.variance(SAMPLED, landmarks)
    }

    /// A fingerprint of all that every repeat comes to, with what was predicted.
    ///
    /// # Errors
    /// None after [`Self::new`].
    pub fn trace(mut self) -> Result<Digest, SettingError> {
        self.finish()?;
        let mut digest = Digest::new();
        for (filter, landmarks) in
            [SAMPLED, COMPUTED].into_iter().flat_map(|filter| (1..=MOST).map(move |n| (filter, n)))
        {
            digest.f64(self.log.predicted_share(filter, landmarks));
            for repeat in &self.repeats {
                let Population { ess, left, first } = repeat[filter][landmarks as usize - 1];
                digest.u32(left);
                [ess, first[0], first[1]].into_iter().for_each(|x| digest.f64(x));
            }
        }
        Ok(digest)
    }
}

#[cfg(test)]
mod tests;
