//! What the wheels are like, learnt along the way from what was matched.
//!
//! No fixed noise suits all robots: wheels of one recorded log turn by 3.4° a metre more than they tell, those of another scatter by 3° a
//! metre round the truth. A prior wide enough for both lets a scan of which little is in range turn the map; one half as wide loses
//! the first. So a robot begins with the wide one, and its drift and its noise are estimated as it goes.
//!
//! References: Roy and Thrun, *Online self-calibration for mobile robots*, ICRA 1999 (drift by exponential forgetting); Eliazar and Parr, *Learning
//! probabilistic motion models for mobile robots*, ICML 2004 (motion as a Gaussian in pose space, its noise learnt with the map).

use crate::geometry::{Pose2, driven};
use crate::motion::{Displacement, Drift};
use crate::ops;
use crate::proposal::{DRIFT_STDS, ProposalTrace};
use crate::rbpf::Report;
use nalgebra::Matrix3;

/// Noise of what wheels report. Variances grow with the way, so that they are the same however a drive is cut into steps: after d metres and
/// turns of φ radians in all, σ²_heading = a₁² φ + a₂² d and, along each axis, σ²_position = b₁² d + b₂² φ.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct WheelNoise {
    /// Standard deviations a₁ of the heading after turning by a radian \[rad/√rad\], and a₂ after driving a metre \[rad/√m\].
    pub heading: [f64; 2],
    /// Standard deviations b₁ of the position after driving a metre \[m/√m\], and b₂ after turning by a radian \[m/√rad\].
    pub position: [f64; 2],
}

impl WheelNoise {
    /// Variances of heading and position \[rad², m²\] after so much of driving and turning \[m, rad\].
    fn variances(&self, [way, turn]: [f64; 2]) -> [f64; 2] {
        let ([by_turn, by_way], [along, spin]) = (self.heading, self.position);
        [by_turn * by_turn * turn + by_way * by_way * way, along * along * way + spin * spin * turn]
    }
}

/// Constants of what is assumed and learnt of wheels.
struct WheelsConfig {
    /// Noise of the wheels before any scan was matched. Wide on purpose: real wheels slip, and are off by a bias that no noise
    /// describes. What is too wide is narrowed on the way. After half a metre a heading is uncertain by 4° and a position by 5 cm.
    assumed: WheelNoise,
    /// Noise that stays in a motion, however well the wheels are known: their own is not all that scans of one place differ by.
    floor: WheelNoise,
    /// Standard deviation of the wheels' drift \[rad/m\], before anything is known: some 3° a metre, as one log has.
    drift_std: f64,
    /// Weight of the prior on the noise of the wheels, as a length of the way \[m\].
    trust: f64,
    /// Way after which what was learnt of the wheels is forgotten to 1/e \[m\]: carpets change, and tyres warm up.
    memory: f64,
    /// Length of a stretch \[m\]: over less, a matched heading says little of the wheels.
    stretch: f64,
    /// Standard deviations beyond which an error is not noise of the wheels: the wheels are learnt from it as if it were of this many.
    outlying: f64,
    /// Standard deviation of a matched heading over a stretch \[rad\]: no wheel is to blame for it.
    matched_std: f64,
}

/// See [`WheelsConfig`].
const WHEELS: WheelsConfig = WheelsConfig {
    assumed: WheelNoise { heading: [0.14, 0.1], position: [0.07, 0.07] },
    floor: WheelNoise { heading: [0.014, 0.014], position: [0.028, 0.028] },
    drift_std: DRIFT_STDS[0],
    trust: 5.0,
    memory: 50.0,
    stretch: 0.5,
    outlying: 3.0,
    matched_std: 0.01,
};

/// Drift and noise of a robot's wheels, as far as is known.
///
/// Over a stretch of d metres the heading that was matched and that of odometry differ by
///
/// e = b d + ε, ε ~ N(0, s² v),
///
/// where v is the variance of the noise that is assumed of any wheels. The drift b has a conjugate normal prior around 0; s² is the
/// mean of (e − b d)² / v over the way, in which the 1 that is assumed counts as some metres. Both forget along the way. An error of more than
/// three standard deviations counts as one of three: one scan in a wrong place must not make the next wrong place likely.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(into = "SavedWheels", from = "SavedWheels")
)]
pub struct Wheels {
    /// Of the heading, a metre of the way.
    drift: Drift<1>,
    noise: Scale,
    /// What is not learnt from yet.
    stretch: Stretch,
}

/// A stretch of the way, on which errors add up until they say more than the matcher's own do.
#[derive(Clone, Copy, Debug, Default)]
struct Stretch {
    /// Metres driven.
    way: f64,
    /// v, by the noise that is assumed \[rad²\].
    variance: f64,
    /// e, matched less odometry \[rad\].
    turned: f64,
}

/// s²: how large squared errors are, of what was assumed.
#[derive(Clone, Copy, Debug)]
struct Scale {
    squares: f64,
    count: f64,
}

impl Scale {
    const ASSUMED: Self = Self { squares: WHEELS.trust, count: WHEELS.trust };

    fn value(&self) -> f64 {
        self.squares / self.count
    }

    /// Learns from a stretch of so many metres.
    fn learn(&mut self, square: f64, way: f64) {
        let kept = kept(way);
        *self = Self { squares: kept * self.squares + way * square, count: kept * self.count + way };
    }
}

/// What is left of older stretches after so many more metres.
fn kept(way: f64) -> f64 {
    ops::exp(-way / WHEELS.memory)
}

impl Default for Wheels {
    fn default() -> Self {
        Self { drift: Drift::new([WHEELS.drift_std]), noise: Scale::ASSUMED, stretch: Stretch::default() }
    }
}

impl Wheels {
    /// b \[rad/m\]: by how much more than odometry tells the robot turns to the left, a metre.
    pub fn drift(&self) -> f64 {
        self.drift.mean([1.0])
    }

    /// Standard deviation of the heading after a metre straight on \[rad\], apart from what stays uncertain of any motion.
    pub fn heading_std(&self) -> f64 {
        (self.noise.value() * WHEELS.assumed.heading[1] * WHEELS.assumed.heading[1] + self.drift.variance([1.0])).sqrt()
    }

    /// Where the robot is, seen from where it was, when odometry tells this motion. Half of an error of the heading is there from the
    /// start of the motion, so that it moves the position too.
    pub(super) fn displacement(&self, odometry: &Pose2) -> Displacement {
        let driven = driven(odometry);
        self.displaced(odometry, driven, driven)
    }

    /// The displacement where odometry tells this motion of many steps, in which the robot drove so far and turned by so much \[m, rad\]. It is a bound
    /// on what wheels may be off by, there and back: beyond a stretch, and half a radian, standard deviations grow as if all errors went one way.
    pub(super) fn displacement_over(&self, odometry: &Pose2, driven: [f64; 2]) -> Displacement {
        self.displaced(odometry, driven, driven.map(|way| way * (way / WHEELS.stretch).max(1.0)))
    }

    /// The displacement after driving so far, with the noise of driving and turning by as much as `noisy` \[m, rad\].
    fn displaced(&self, odometry: &Pose2, [way, _]: [f64; 2], noisy: [f64; 2]) -> Displacement {
        let ([heading, position], floor) = (WHEELS.assumed.variances(noisy), WHEELS.floor.variances(noisy));
        let covariance = Matrix3::from_diagonal(&[position + floor[1], position + floor[1], 0.0].into());
        let variance = self.noise.value() * heading + self.drift.variance([way]) + floor[0];
        Displacement { mean: *odometry, covariance }.turned(self.drift.mean([way]), variance)
    }

    /// Learns from a step of the filter, to which odometry told this motion: from the mean over the particles that were matched. Whatever a path
    /// weighs, its last motion says as much of the wheels as that of any other.
    pub(super) fn learn(&mut self, odometry: &Pose2, report: &Report<()>) {
        let (mut count, mut turned) = (0.0, 0.0);
        for (path, trace) in report.paths.iter().zip(&report.traces) {
            let (ProposalTrace::Matched { .. }, Some(before)) = (trace, path.before()) else { continue };
            count += 1.0;
            turned += ops::wrap_angle(before.pose().between(&path.pose()).theta - odometry.theta);
        }
        if count > 0.0 {
            self.add(odometry, turned / count);
        }
    }

    /// Adds what was found in a step to the stretch, and learns from it where it is long enough.
    fn add(&mut self, odometry: &Pose2, turned: f64) {
        let ([heading, _], stretch) = (WHEELS.assumed.variances(driven(odometry)), &mut self.stretch);
        stretch.way += ops::hypot(odometry.x, odometry.y);
        stretch.variance += heading;
        stretch.turned += turned;
        if stretch.way >= WHEELS.stretch {
            let stretch = core::mem::take(stretch);
            self.conclude(&stretch);
        }
    }

    fn conclude(&mut self, stretch: &Stretch) {
        let (matched, expected) = (WHEELS.matched_std * WHEELS.matched_std, self.drift() * stretch.way);
        let variance = self.noise.value() * stretch.variance + matched;
        let most = WHEELS.outlying * variance.sqrt();
        // Not `clamp`, whose panic has std's writing of floats with it.
        let error = (stretch.turned - expected).max(-most).min(most);
        let kept = kept(stretch.way);
        self.drift.learn_and_forget([stretch.way], expected + error, variance, kept);
        self.noise.learn(error * error / (stretch.variance + matched), stretch.way);
    }
}

/// In plain numbers.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct SavedWheels {
    drift: [f64; 2],
    noise: [f64; 2],
    stretch: [f64; 3],
}

#[cfg(feature = "serde")]
impl From<Wheels> for SavedWheels {
    fn from(Wheels { drift, noise, stretch: Stretch { way, variance, turned } }: Wheels) -> Self {
        Self { drift: drift.sums(), noise: [noise.squares, noise.count], stretch: [way, variance, turned] }
    }
}

#[cfg(feature = "serde")]
impl From<SavedWheels> for Wheels {
    fn from(SavedWheels { drift, noise: [squares, count], stretch: [way, variance, turned] }: SavedWheels) -> Self {
        let stretch = Stretch { way, variance, turned };
        Self { drift: Drift::of_sums(drift), noise: Scale { squares, count }, stretch }
    }
}

#[cfg(feature = "serde")]
impl Wheels {
    /// Whether these can be what was learnt of wheels.
    pub(super) fn check(&self) -> Result<(), crate::save::RestoreError> {
        let Self { drift, noise: Scale { squares, count }, stretch: Stretch { way, variance, turned } } = self;
        let [information, weighted] = drift.sums();
        crate::save::finite("wheels", [information, weighted, *squares, *count, *way, *variance, *turned])?;
        let [information, count] = [information, *count].map(|sum| sum > 0.0);
        let is_known = information && count && *squares >= 0.0 && *way >= 0.0 && *variance >= 0.0;
        crate::save::holds(is_known, "wheels", "sums of squares and ways")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Stream};

    /// After so many steps of this motion, of which wheels tell all but a drift \[rad/m\] and noise with this standard deviation \[rad/√m\].
    fn after(steps: u32, motion: Pose2, drift: f64, std: f64) -> Wheels {
        let mut wheels = Wheels::default();
        for step in 0..steps {
            let [turn] = Stream::at(1, Purpose::TRIAL, step, 0).normals();
            let way = ops::hypot(motion.x, motion.y);
            wheels.add(&motion, drift * way + std * way.sqrt() * turn);
        }
        wheels
    }

    #[test]
    fn wheels_of_which_nothing_is_known_are_wide_and_straight() {
        let Displacement { mean, covariance } = Wheels::default().displacement(&Pose2::new(1.0, 0.0, 0.0));
        assert_eq!(mean, Pose2::new(1.0, 0.0, 0.0));
        let [x, _, theta] = [covariance.m11, covariance.m22, covariance.m33].map(f64::sqrt);
        let known = ops::hypot(WHEELS.assumed.heading[1], WHEELS.drift_std);
        assert!((x - ops::hypot(WHEELS.assumed.position[0], WHEELS.floor.position[0])).abs() < 1e-12);
        assert!((theta - ops::hypot(known, WHEELS.floor.heading[1])).abs() < 1e-12);
    }

    #[test]
    fn drift_and_noise_are_learnt_whatever_the_length_of_a_step() {
        for (steps, way) in [(200, 1.0), (667, 0.3), (2_000, 0.1), (10_000, 0.02)] {
            let wheels = after(steps, Pose2::new(way, 0.0, 0.0), 0.06, 0.03);
            assert!((wheels.drift() - 0.06).abs() < 0.012, "{way} m: {}", wheels.drift());
            assert!((0.75..1.25).contains(&(wheels.heading_std() / 0.03)), "{way} m: {}", wheels.heading_std());
        }
    }

    #[test]
    fn what_was_learnt_is_in_the_displacement() {
        let (wheels, ahead) = (after(300, Pose2::new(0.7, 0.0, 0.0), 0.06, 0.03), Pose2::new(1.0, 0.0, 0.0));
        let Displacement { mean, covariance } = wheels.displacement(&ahead);
        assert!((mean.theta - 0.06).abs() < 0.012 && (mean.y - 0.03).abs() < 0.006, "{mean:?}");
        assert!((covariance.m33.sqrt() - ops::hypot(wheels.heading_std(), WHEELS.floor.heading[1])).abs() < 1e-12);
    }

    #[test]
    fn a_step_aside_turns_a_robot_no_more_than_one_ahead() {
        let wheels = Wheels::default();
        let [ahead, aside] = [Pose2::new(1.0, 0.0, 0.0), Pose2::new(0.0, 1.0, 0.0)].map(|to| wheels.displacement(&to));
        assert_eq!(ahead.covariance.m33, aside.covariance.m33);
        assert!((ahead.covariance.m22 - aside.covariance.m11).abs() < 1e-15);
    }

    #[test]
    fn one_scan_in_a_wrong_place_is_not_learnt_as_if_it_were_the_wheels() {
        let (mut wheels, ahead) = (after(100, Pose2::new(1.0, 0.0, 0.0), 0.0, 0.03), Pose2::new(1.0, 0.0, 0.0));
        let before = wheels.clone();
        wheels.add(&ahead, 0.8);
        assert!((wheels.drift() - before.drift()).abs() < 0.01, "{}", wheels.drift());
        assert!(wheels.heading_std() < 1.1 * before.heading_std(), "{}", wheels.heading_std());
    }
}
