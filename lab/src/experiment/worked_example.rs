//! One update by hand: two particles that see one landmark, and every number between their inputs and the decision to resample.

use fastslam::nalgebra::{Matrix2, Vector2};
use fastslam::{
    geometry::Pose2,
    map::landmarks::{Innovation, Landmark},
    ops,
    resampling::ResamplePolicy,
    sensor::{LandmarkSensor, RangeBearing},
    weights::Weights,
};

/// What the example begins with. In a filter both particles get one sighting and differ in their poses; here either may differ.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Inputs {
    /// x of each particle: (x, y, θ) \[m, m, rad\].
    pub poses: [[f64; 3]; 2],
    /// z of each particle: (r, φ) \[m, rad\].
    pub sightings: [[f64; 2]; 2],
    /// μ in both particles \[m\].
    pub mean: [f64; 2],
    /// Σ_xx, Σ_xy and Σ_yy in both particles \[m²\]; positive definite.
    pub covariance: [f64; 3],
    /// σ_r \[m\] and σ_φ \[rad\].
    pub noise_std: [f64; 2],
    /// Share of M below which N_eff calls for resampling.
    pub threshold: f64,
}

impl Default for Inputs {
    /// The example of the chapter.
    fn default() -> Self {
        Self {
            poses: [[0.0; 3]; 2],
            sightings: [[4.1, 0.05], [4.3, 0.15]],
            mean: [4.0, 0.0],
            covariance: [0.21, 0.0, 0.12],
            noise_std: [0.2, 0.05],
            threshold: 0.5,
        }
    }
}

/// One particle's update.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Update {
    /// x.
    pub world_from_robot: Pose2,
    /// z \[m, rad\].
    pub z: Vector2<f64>,
    /// Where z alone puts the landmark \[m\].
    pub seen_at: Vector2<f64>,
    /// ẑ, H_m, ν, S, S⁻¹, νᵀS⁻¹ν, ln w.
    pub innovation: Innovation,
    /// w = |2πS|^(−1/2) exp(−½ νᵀS⁻¹ν) \[1/(m rad)\].
    pub weight: f64,
    /// K.
    pub gain: Matrix2<f64>,
    /// μ and Σ after it.
    pub after: Landmark,
}

/// Both updates, and what follows from them.
#[derive(Clone, PartialEq, Debug)]
pub struct WorkedExample {
    /// μ and Σ before the sightings.
    pub before: Landmark,
    /// Q.
    pub noise: Matrix2<f64>,
    /// By particle.
    pub updates: [Update; 2],
    /// w̃.
    pub weights: Weights,
    /// N_eff.
    pub ess: f64,
    /// Threshold · M.
    pub limit: f64,
    /// Whether the particles are to be resampled.
    pub resamples: bool,
}

impl WorkedExample {
    /// Computed by the filter's own code.
    pub fn new(inputs: &Inputs) -> Self {
        let Inputs { poses, sightings, mean, covariance: [xx, xy, yy], noise_std, threshold } = *inputs;
        let [range_std, bearing_std] = noise_std;
        let sensor =
            RangeBearing { range_std, bearing_std, max_range: f64::INFINITY, field_of_view: core::f64::consts::TAU };
        let before = Landmark {
            mean: Vector2::from(mean),
            covariance: Matrix2::new(xx, xy, xy, yy),
            existence_count: 1,
            apart: 0,
        };
        let updates = [0, 1].map(|slot| {
            let ([x, y, theta], z) = (poses[slot], Vector2::from(sightings[slot]));
            let world_from_robot = Pose2::new(x, y, theta);
            let innovation = before.innovation(&sensor, &world_from_robot, &z);
            let mut after = before;
            after.update(&sensor, &world_from_robot, &z);
            let (weight, gain) = (ops::exp(innovation.log_likelihood()), before.gain(&innovation));
            let seen_at = sensor.locate(&world_from_robot, &z);
            Update { world_from_robot, z, seen_at, innovation, weight, gain, after }
        });
        let count = updates.len();
        let (weights, _) = Weights::uniform(count).reweighted(&updates.map(|u| u.innovation.log_likelihood()));
        let ess = weights.ess();
        let resamples = ResamplePolicy::EssBelow(threshold).should_resample(ess, count);
        Self { before, noise: sensor.noise(), updates, weights, ess, limit: threshold * count as f64, resamples }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worked_example_is_met_from_the_weights_to_the_verdict() {
        let example = WorkedExample::new(&Inputs::default());
        let shares = example.weights.as_slice();
        for (slot, (weight, share)) in
            [(2.753_451_476_665, 0.761_332_714_843), (0.863_168_987_665, 0.238_667_285_157)].into_iter().enumerate()
        {
            assert!((example.updates[slot].weight - weight).abs() < 1e-9);
            assert!((shares[slot] - share).abs() < 1e-9);
        }
        assert!((example.ess - 1.570_870_837_6).abs() < 1e-9);
        assert!(example.ess > example.limit && example.limit == 1.0 && !example.resamples);
    }

    #[test]
    fn the_same_sighting_from_the_same_pose_gives_equal_weights() {
        let sightings = [[4.3, 0.15]; 2];
        let example = WorkedExample::new(&Inputs { sightings, ..Inputs::default() });
        assert_eq!(example.weights, Weights::uniform(2));
        assert_eq!(example.updates[0], example.updates[1]);
        assert_eq!(example.ess, 2.0);
    }

    #[test]
    fn a_threshold_above_n_eff_resamples() {
        for (threshold, resamples) in [(0.0, false), (0.78, false), (0.79, true), (1.0, true)] {
            assert_eq!(WorkedExample::new(&Inputs { threshold, ..Inputs::default() }).resamples, resamples);
        }
    }
}
