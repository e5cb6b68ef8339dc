//! A car: it is steered by its front wheels, and its sensor stands ahead of the axle that does not turn.
//!
//! References: Guivant, Nebot, *Optimization of the simultaneous localization and map-building algorithm for real-time
//! implementation* (IEEE T-RA 2001), from which the vehicle of Victoria Park and its model are; Montemerlo, *FastSLAM* (thesis, CMU 2003), which
//! runs that log. The numbers of the vehicle are those that its log is distributed with.

use super::{Motion, Velocity, VelocityModel};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::ops;
use crate::random::Stream;
use nalgebra::{Matrix2, Matrix3, Matrix3x2, Vector2};

/// A car without slip, driven by (v, ω) of the middle of its rear axle, ω = v tan α / L for the steering angle α.
///
/// The pose is that of the sensor, which stands at `mount` of the axle's frame and looks ahead: x_t = x_{t−1} ⊖ mount ⊕ arc(v, ω) ⊕ mount,
/// without Euler's error. The noise is that of what the car measures, v and α: one that stands turns by nothing, and an error of
/// the steering turns it by as much as it drives.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Car {
    /// L: distance of the axles \[m\], above 0.
    pub wheel_base: f64,
    /// Where the sensor stands, ahead and left of the middle of the rear axle \[m\].
    pub mount: [f64; 2],
    /// Standard deviation of v at rest \[m/s\].
    pub speed_std: f64,
    /// Of v, as a share of it \[–\].
    pub speed_share: f64,
    /// Of α \[rad\].
    pub steering_std: f64,
}

/// Nothing turns slower than this while it drives \[m/s\]: below it the steering angle of (v, ω) is not to be had.
const SLOWEST: f64 = 1e-9;

impl Car {
    /// (v, ω) of the rear axle's middle for a steering angle \[rad\] and the speed \[m/s\] of a wheel that runs `wheel_aside` \[m\] beside
    /// the middle, as wheels are read: v = v_wheel / (1 − tan α · H / L).
    pub fn control(&self, wheel_speed: f64, steering: f64, wheel_aside: f64, duration: f64) -> Velocity {
        let (sin, cos) = ops::sin_cos(steering);
        let curvature = sin / cos / self.wheel_base;
        let speed = wheel_speed / (1.0 - curvature * wheel_aside);
        Velocity { speed, turn_rate: speed * curvature, duration }
    }

    /// [∂ω/∂v, ∂ω/∂α] at (v, ω): tan α / L, and v (1 + tan² α) / L.
    fn turning(&self, u: &Velocity) -> [f64; 2] {
        if u.speed.abs() < SLOWEST {
            return [0.0, 0.0];
        }
        let curvature = u.turn_rate / u.speed;
        let tan = curvature * self.wheel_base;
        [curvature, u.speed * (1.0 + tan * tan) / self.wheel_base]
    }

    /// Standard deviations of v \[m/s\] and α \[rad\].
    fn stds(&self, u: &Velocity) -> [f64; 2] {
        let share = self.speed_share * u.speed;
        [(self.speed_std * self.speed_std + share * share).sqrt(), self.steering_std]
    }

    /// The control with its noise added: of v and of α, as far as ω is linear in them. Takes four `u64`s.
    pub fn perturb(&self, u: &Velocity, stream: &mut Stream) -> Velocity {
        let [dv, da] = stream.noise(self.stds(u));
        let [by_speed, by_steering] = self.turning(u);
        Velocity { speed: u.speed + dv, turn_rate: u.turn_rate + by_speed * dv + by_steering * da, ..*u }
    }

    /// The sensor's pose when the rear axle's middle stands at the origin.
    fn axle_from_sensor(&self) -> Pose2 {
        Pose2::new(self.mount[0], self.mount[1], 0.0)
    }

    fn drive(&self, from: &Pose2, u: &Velocity) -> Pose2 {
        let mount = self.axle_from_sensor();
        u.apply(&from.compose(&mount.between(&Pose2::default()))).compose(&mount)
    }
}

impl Motion for Car {
    type Control = Velocity;

    fn apply(&self, from: &Pose2, u: &Velocity) -> Pose2 {
        self.drive(from, u)
    }

    fn sample(&self, from: &Pose2, u: &Velocity, stream: &mut Stream) -> Pose2 {
        self.drive(from, &self.perturb(u, stream))
    }

    /// V M Vᵀ with V = ∂(x ⊕ u)/∂(v, α).
    fn covariance(&self, from: &Pose2, u: &Velocity) -> Matrix3<f64> {
        // Of the axle by (v, ω), which the velocity model knows for a noise of one of each.
        let axle = from.compose(&self.axle_from_sensor().between(&Pose2::default()));
        let [by_v, by_w] = VelocityModel::derivatives(&axle, u);
        let to = u.apply(&axle);
        let (sin, cos) = ops::sin_cos(to.theta);
        let [a, b] = self.mount;
        // The sensor swings around the axle.
        let swing = Vector2::new(-a * sin - b * cos, a * cos - b * sin);
        let sensor = |[x, y, turn]: [f64; 3]| [x + swing.x * turn, y + swing.y * turn, turn];
        let ([vx, vy, vt], [wx, wy, wt]) = (sensor(by_v), sensor(by_w));
        let [by_speed, by_steering] = self.turning(u);
        let v = Matrix3x2::new(
            vx + by_speed * wx,
            by_steering * wx,
            vy + by_speed * wy,
            by_steering * wy,
            vt + by_speed * wt,
            by_steering * wt,
        );
        let m = Matrix2::from_diagonal(&Vector2::from(self.stds(u).map(|std| std * std)));
        v * m * v.transpose()
    }

    fn validate(&self) -> Result<(), SettingError> {
        Range::number(1e-3, 1e3, "m").check("motion.wheel_base", self.wheel_base)?;
        self.mount.iter().try_for_each(|at| Range::number(-1e3, 1e3, "m").check("motion.mount", *at).map(drop))?;
        Range::at_least(0.0, "m/s").check("motion.speed_std", self.speed_std)?;
        Range::at_least(0.0, "").check("motion.speed_share", self.speed_share)?;
        Range::number(0.0, core::f64::consts::FRAC_PI_2, "rad")
            .check("motion.steering_std", self.steering_std)
            .map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAR: Car =
        Car { wheel_base: 2.83, mount: [3.78, 0.5], speed_std: 0.02, speed_share: 0.02, steering_std: 0.005 };

    /// Ahead, arcs to both sides, backwards, standing with its wheels turned.
    fn cases() -> [(Pose2, Velocity); 5] {
        let steered = [(3.0, 0.0), (3.0, 0.3), (2.0, -0.5), (-1.0, 0.2), (0.0, 0.4)];
        steered.map(|(speed, steering)| (Pose2::new(1.0, 2.0, 0.4 + steering), CAR.control(speed, steering, 0.76, 0.2)))
    }

    crate::motion_laws!(laws, CAR, cases());

    /// The equations of the log's page, by Euler in 20 000 small steps, against one arc: to 1e-4 of 3 m.
    #[test]
    fn a_small_step_is_that_of_the_vehicle_of_victoria_park() {
        let (wheel, steering, aside) = (3.0, 0.35, 0.76);
        let (l, [a, b]) = (CAR.wheel_base, CAR.mount);
        let tan = ops::sin_cos(steering).0 / ops::sin_cos(steering).1;
        let speed = wheel / (1.0 - tan * aside / l);
        let (mut x, mut y, mut phi) = (1.0, 2.0, 0.4);
        for _ in 0..20_000 {
            let (dt, (sin, cos)) = (1.0 / 20_000.0, ops::sin_cos(phi));
            x += dt * (speed * cos - speed / l * tan * (a * sin + b * cos));
            y += dt * (speed * sin + speed / l * tan * (a * cos - b * sin));
            phi += dt * speed / l * tan;
        }
        let arc = CAR.apply(&Pose2::new(1.0, 2.0, 0.4), &CAR.control(wheel, steering, aside, 1.0));
        assert!(arc.minus(&Pose2::new(x, y, phi)).norm() < 3e-4, "{arc:?} {x} {y} {phi}");
    }

    #[test]
    fn a_car_that_stands_is_sure_of_its_heading() {
        let stands = CAR.control(0.0, 0.4, 0.76, 1.0);
        assert_eq!(CAR.covariance(&Pose2::default(), &stands).m33, 0.0);
    }

    #[test]
    fn what_no_car_has_is_refused_by_name() {
        let refused = |car: Car| car.validate().unwrap_err().to_string();
        assert_eq!(
            refused(Car { wheel_base: 0.0, ..CAR }),
            "motion.wheel_base = 0: must be a number from 0.001 to 1000 [m]"
        );
        assert!(refused(Car { mount: [0.0, f64::NAN], ..CAR }).starts_with("motion.mount = NaN"));
        assert!(refused(Car { steering_std: -0.1, ..CAR }).starts_with("motion.steering_std = -0.1"));
    }
}
