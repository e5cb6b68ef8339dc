//! The laws for implementers must fail where they are broken: for each there is an implementation that breaks it, and no more than that
//! where it can be helped.

use core::f64::consts::TAU;
use fastslam::geometry::Pose2;
use fastslam::laws::linear::{self, Drift, Offset};
use fastslam::laws::proposal::{self, Step};
use fastslam::laws::{TURNS, map, motion, sensor};
use fastslam::map::ConditionalMap;
use fastslam::map::landmarks::{Correspondence, Landmark, Landmarks};
use fastslam::matching::Likelihood;
use fastslam::motion::{Motion, Odometry, OdometryModel};
use fastslam::ops;
use fastslam::particle::Particle;
use fastslam::proposal::{FromMeasurement, FromMotion, Marginal, Proposal, Proposed};
use fastslam::random::Stream;
use fastslam::sensor::{Feature, LandmarkSensor, Prediction, RangeBearing};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use std::cell::Cell;
use std::sync::{Arc, Mutex, PoisonError};

// Motions.

/// What is wrong with a motion.
#[derive(Clone, Copy, PartialEq)]
enum WrongMotion {
    Jacobian,
    Asymmetric,
    Indefinite,
    Biased,
    TooCertain,
    Unfloored,
    Restless,
    Northbound,
    Lazy,
}
use WrongMotion::{Asymmetric, Biased, Indefinite, Jacobian, Lazy, Northbound, Restless, TooCertain, Unfloored};

const MODEL: OdometryModel = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };

impl Motion for WrongMotion {
    type Control = Odometry;

    fn apply(&self, from: &Pose2, u: &Odometry) -> Pose2 {
        let north = if *self == Northbound { 1e-3 } else { 0.0 };
        u.apply(from).plus(&Vector3::new(0.0, north, 0.0))
    }

    fn sample(&self, from: &Pose2, u: &Odometry, stream: &mut Stream) -> Pose2 {
        let sample = MODEL.perturb(u, stream).apply(from);
        let off = match self {
            Biased => 0.02,
            Restless => 1e-6,
            _ => 0.0,
        };
        sample.plus(&Vector3::new(off, 0.0, 0.0))
    }

    fn covariance(&self, from: &Pose2, u: &Odometry) -> Matrix3<f64> {
        let r = MODEL.covariance(from, u);
        match self {
            Asymmetric => r + Matrix3::new(0.0, 1e-6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
            Indefinite => r - Matrix3::identity() * 1e-2,
            TooCertain => r * 0.8,
            _ => r,
        }
    }

    fn gaussian(&self, from: &Pose2, u: &Odometry, floor: [f64; 3]) -> Option<fastslam::geometry::Gaussian3> {
        MODEL.gaussian(from, u, floor.map(|std| if *self == Unfloored { 0.99 * std } else { std }))
    }

    fn jacobian(&self, from: &Pose2, u: &Odometry) -> Matrix3<f64> {
        if *self == Jacobian { Matrix3::identity() } else { MODEL.jacobian(from, u) }
    }

    fn travel(&self, u: &Odometry) -> f64 {
        if *self == Lazy { 0.9 * MODEL.travel(u) } else { MODEL.travel(u) }
    }
}

const DRIVE: (Pose2, Odometry) = (Pose2 { x: 1.0, y: 2.0, theta: 0.5 }, Odometry { rot1: 0.2, trans: 1.0, rot2: 0.1 });
const STILL: (Pose2, Odometry) = (Pose2 { x: 1.0, y: 2.0, theta: 0.5 }, Odometry { rot1: 0.0, trans: 0.0, rot2: 0.0 });

/// A test that a law refuses what is wrong, with these words.
macro_rules! refused {
    ($($name:ident: $said:literal, $law:expr;)+) => {
        $(
            #[test]
            #[should_panic(expected = $said)]
            fn $name() {
                $law
            }
        )+
    };
}

refused! {
    a_wrong_jacobian: "column 2 of the Jacobian is off", motion::the_jacobian_is_the_derivative(&Jacobian, &[DRIVE]);
    an_asymmetric_covariance: "not symmetric",
        motion::the_covariance_is_symmetric_and_positive_semidefinite(&Asymmetric, &[DRIVE]);
    a_covariance_below_zero: "not positive semidefinite",
        motion::the_covariance_is_symmetric_and_positive_semidefinite(&Indefinite, &[DRIVE]);
    samples_with_another_mean: "the mean of axis 0", motion::samples_have_mean_and_covariance(&Biased, &[DRIVE]);
    samples_with_another_covariance: "and that of the samples",
        motion::samples_have_mean_and_covariance(&TooCertain, &[DRIVE]);
    a_model_of_too_much_noise: "give a model of less noise",
        motion::samples_have_mean_and_covariance(&MODEL.scaled(5.0), &[DRIVE]);
    a_gaussian_with_another_floor: "the covariance is off",
        motion::the_gaussian_has_mean_covariance_and_floor(&Unfloored, &[DRIVE]);
    a_gaussian_with_another_mean: "from where the motion leads",
        motion::the_gaussian_has_mean_covariance_and_floor(&Northbound, &[DRIVE]);
    a_robot_that_moves_without_noise: "without noise a sample is",
        motion::without_noise_a_sample_is_the_motion_itself(&Restless, &[STILL]);
    a_motion_that_knows_north: "the motion does not turn",
        motion::turning_the_world_turns_the_motion(&Northbound, &[DRIVE]);
    samples_that_know_east: "a sample does not turn", motion::turning_the_world_turns_the_motion(&Biased, &[DRIVE]);
    a_covariance_that_knows_north: "the covariance does not turn",
        motion::turning_the_world_turns_the_motion(&Asymmetric, &[DRIVE]);
    a_jacobian_that_does_not_turn: "the Jacobian does not turn",
        motion::turning_the_world_turns_the_motion(&WrongTurn, &[DRIVE]);
    a_way_that_is_shorter_than_the_straight_one: "case 0: travels",
        motion::a_robot_travels_at_least_as_far_as_it_gets(&Lazy, &[DRIVE]);
}

/// A Jacobian that is right for one heading.
struct WrongTurn;

impl Motion for WrongTurn {
    type Control = Odometry;

    fn apply(&self, from: &Pose2, u: &Odometry) -> Pose2 {
        u.apply(from)
    }

    fn sample(&self, from: &Pose2, u: &Odometry, stream: &mut Stream) -> Pose2 {
        MODEL.sample(from, u, stream)
    }

    fn covariance(&self, from: &Pose2, u: &Odometry) -> Matrix3<f64> {
        MODEL.covariance(from, u)
    }

    fn jacobian(&self, _: &Pose2, u: &Odometry) -> Matrix3<f64> {
        MODEL.jacobian(&DRIVE.0, u)
    }
}

// Sensors.

/// What is wrong with a sensor of range and bearing.
#[derive(Clone, Copy, PartialEq)]
enum WrongSensor {
    HeadingForgotten,
    LandmarkForgotten,
    Misplaced,
    Unwrapped,
    Imaginary,
    Overbound,
    Overseeing,
    Compass,
}
use WrongSensor::{
    Compass, HeadingForgotten, Imaginary, LandmarkForgotten, Misplaced, Overbound, Overseeing, Unwrapped,
};

const SENSOR: RangeBearing = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 5.0, field_of_view: TAU };

impl LandmarkSensor for WrongSensor {
    fn predict(&self, at: &Pose2, landmark: &Vector2<f64>) -> Prediction {
        let mut prediction = SENSOR.predict(at, landmark);
        match self {
            HeadingForgotten => prediction.h_x.m23 = 0.0,
            LandmarkForgotten => prediction.h_m.m21 = -prediction.h_m.m21,
            Compass => prediction.z.y = ops::wrap_angle(prediction.z.y + at.theta),
            _ => (),
        }
        prediction
    }

    fn residual(&self, z: &Vector2<f64>, predicted: &Vector2<f64>) -> Vector2<f64> {
        if *self == Unwrapped { z - predicted } else { SENSOR.residual(z, predicted) }
    }

    fn least_mahalanobis_squared(&self, at: &Pose2, m: &Vector2<f64>, spread: &Matrix2<f64>, z: &Vector2<f64>) -> f64 {
        let least = SENSOR.least_mahalanobis_squared(at, m, spread, z);
        if *self == Overbound { 1.5 * least } else { least }
    }

    fn locate(&self, at: &Pose2, z: &Vector2<f64>) -> Vector2<f64> {
        let off = if *self == Misplaced { 1e-6 } else { 0.0 };
        SENSOR.locate(at, &Vector2::new(z.x + off, z.y))
    }

    fn noise(&self) -> Matrix2<f64> {
        if *self == Imaginary { Matrix2::new(0.01, 0.02, 0.02, 0.01) } else { SENSOR.noise() }
    }

    fn sees(&self, at: &Pose2, landmark: &Vector2<f64>, margin: f64) -> bool {
        SENSOR.sees(at, landmark, if *self == Overseeing { 0.0 } else { margin })
    }
}

const VIEW: (Pose2, Vector2<f64>) = (Pose2 { x: 1.0, y: 2.0, theta: 0.5 }, Vector2::new(3.0, -1.0));
const FAR: (Pose2, Vector2<f64>) = (Pose2 { x: 0.0, y: 0.0, theta: 0.0 }, Vector2::new(4.95, 0.0));

refused! {
    a_wrong_derivative_by_the_pose: "column 2 of H_x is off",
        sensor::the_derivatives_are_those_of_the_prediction(&HeadingForgotten, &[VIEW]);
    a_wrong_derivative_by_the_landmark: "column 0 of H_m is off",
        sensor::the_derivatives_are_those_of_the_prediction(&LandmarkForgotten, &[VIEW]);
    an_inverse_that_is_none: "m from where it is", sensor::locating_undoes_predicting(&Misplaced, &[VIEW]);
    an_angle_that_is_not_wrapped: "the residual jumps",
        sensor::residuals_do_not_jump_where_angles_wrap(&Unwrapped, &[VIEW]);
    a_noise_that_is_no_covariance: "not positive definite",
        sensor::the_noise_is_symmetric_and_positive_definite(&Imaginary, &[VIEW]);
    a_lower_bound_that_is_too_high: "is above it",
        sensor::the_lower_bound_is_never_above_the_distance(&Overbound, &[VIEW]);
    a_margin_that_is_forgotten: "in it is not", sensor::what_is_in_view_with_a_margin_is_in_view(&Overseeing, &[FAR]);
    a_sensor_that_knows_north: "the prediction is off", sensor::turning_the_world_changes_nothing(&Compass, &[VIEW]);
    derivatives_that_do_not_turn: "H_m is off",
        sensor::turning_the_world_changes_nothing(&LandmarkForgotten, &[VIEW]);
}

// Maps.

/// What is wrong with a map that is a list of what was observed.
#[derive(Clone, Copy, PartialEq)]
enum WrongMap {
    Deaf,
    Shared,
    Counting,
}
use WrongMap::{Counting, Deaf, Shared};

#[derive(Clone)]
struct Listed {
    wrong: WrongMap,
    list: Vec<u32>,
    shared: Arc<Mutex<Vec<u32>>>,
}

thread_local! {
    static CALLS: Cell<u32> = const { Cell::new(0) };
}

impl ConditionalMap for Listed {
    type Observation = u32;
    type Association = ();

    fn assimilate(&mut self, _: &Pose2, number: &u32, (): &()) {
        match self.wrong {
            Deaf => (),
            Shared => self.shared.lock().unwrap_or_else(PoisonError::into_inner).push(*number),
            Counting => {
                CALLS.set(CALLS.get() + 1);
                self.list.push(CALLS.get());
            }
        }
    }
}

/// How long the list is.
struct Length;

impl Likelihood<Listed> for Length {
    fn log_likelihood(&self, map: &Listed, _: &Pose2, _: &u32) -> (f64, ()) {
        (content(map).len() as f64, ())
    }
}

fn content(map: &Listed) -> Vec<u32> {
    if map.wrong == Shared { map.shared.lock().unwrap().clone() } else { map.list.clone() }
}

fn empty(wrong: WrongMap) -> impl Fn() -> Listed {
    move || Listed { wrong, list: Vec::new(), shared: Arc::default() }
}

fn numbers() -> Vec<(Pose2, u32)> {
    (0..9).map(|number| (Pose2::default(), number)).collect()
}

refused! {
    a_map_that_learns_nothing: "the observations changed nothing",
        map::an_observation_changes_the_map(empty(Deaf), &Length, &numbers(), content);
    a_map_that_depends_on_who_else_was_mapped: "made two maps",
        map::assimilating_is_deterministic(empty(Counting), &Length, &numbers(), content);
    a_clone_that_is_shared: "the original holds it",
        map::clones_never_see_each_others_writes(empty(Shared), &Length, &numbers(), content);
    clones_that_know_of_their_siblings: "what it would without its siblings",
        map::clones_never_see_each_others_writes(empty(Counting), &Length, &numbers(), content);
}

// Proposals.

/// What is wrong with a proposal, or what is added to its price \[nats\].
struct WrongProposal<P> {
    proposal: P,
    /// Added to the price \[nats\] for each metre east of where the particle stood.
    per_metre: f64,
    /// Added to the price \[nats\].
    price: f64,
    /// Added to the pose \[m\], to the east.
    east: f64,
    /// Numbers drawn so far, for one that does not draw from its stream alone.
    drawn: Option<Mutex<u32>>,
}

impl<P> WrongProposal<P> {
    fn of(proposal: P) -> Self {
        Self { proposal, per_metre: 0.0, price: 0.0, east: 0.0, drawn: None }
    }
}

impl<P: Clone> Clone for WrongProposal<P> {
    fn clone(&self) -> Self {
        Self { proposal: self.proposal.clone(), drawn: None, ..*self }
    }
}

impl<M: ConditionalMap, P: Proposal<M>> Proposal<M> for WrongProposal<P> {
    type Control = P::Control;

    fn propose(
        &self,
        particle: &Particle<M>,
        control: &P::Control,
        observation: &M::Observation,
        stream: &mut Stream,
    ) -> Proposed<M::Association> {
        let mut proposed = self.proposal.propose(particle, control, observation, stream);
        proposed.log_increment +=
            self.price + self.per_metre * (proposed.world_from_robot.x - particle.world_from_robot.x);
        proposed.world_from_robot.x += self.east;
        if let Some(drawn) = &self.drawn {
            let mut drawn = drawn.lock().unwrap();
            *drawn += 1;
            proposed.world_from_robot.x += f64::from(*drawn);
        }
        proposed
    }
}

fn first() -> WrongProposal<FromMotion<Drift, Marginal>> {
    WrongProposal::of(FromMotion { motion: Drift, likelihood: Marginal })
}

fn second() -> WrongProposal<FromMeasurement<Drift>> {
    WrongProposal::of(FromMeasurement { motion: Drift })
}

fn linear_step() -> Step<Landmarks<Offset>, Vector3<f64>> {
    linear::one_step(&Pose2::default())
}

/// A step past a landmark, in a world that has been moved.
fn moved_step(world: &Pose2) -> Step<Landmarks<RangeBearing>, Odometry> {
    let [x, y] = world.transform([3.0, 1.0]);
    let landmark =
        Landmark { mean: Vector2::new(x, y), covariance: Matrix2::identity() * 0.01, existence_count: 1, apart: 0 };
    Step {
        particle: Particle::start(*world, Landmarks::new(SENSOR, Correspondence::Known).with([landmark])),
        control: Odometry { rot1: 0.0, trans: 1.0, rot2: 0.0 },
        observation: vec![Feature { z: Vector2::new(2.2, 0.5), signature: Some(0) }],
    }
}

fn with_landmarks() -> WrongProposal<FromMeasurement<OdometryModel>> {
    WrongProposal::of(FromMeasurement { motion: MODEL })
}

/// What the linear step is exactly.
fn exact() -> fastslam::proposal::Measured {
    let Step { particle, control, observation } = linear_step();
    FromMeasurement { motion: Drift }.fold(&particle.map, &particle.world_from_robot, &control, &observation)
}

refused! {
    a_draw_from_elsewhere_than_its_stream: "one stream gave two draws",
        proposal::one_stream_gives_one_draw(
            &WrongProposal { drawn: Some(Mutex::new(0)), ..first() }, linear::one_step, &[]);
    draws_that_know_east: "mean of axis 0 does not turn",
        proposal::turning_the_world_turns_what_is_drawn(
            &WrongProposal { east: 0.02, ..with_landmarks() }, moved_step, &TURNS);
    prices_that_know_east: "the price is not that of the world as it was",
        proposal::turning_the_world_turns_what_is_drawn(
            &WrongProposal { per_metre: 0.1, ..with_landmarks() }, moved_step, &TURNS);
    prices_of_draws_that_know_east: "turned by",
        proposal::turning_the_world_leaves_the_price_of_a_draw(
            &WrongProposal { per_metre: 1e-6, ..with_landmarks() }, moved_step, &TURNS);
    a_price_of_four_percent_too_much: "times the evidence",
        proposal::the_mean_price_is_the_evidence(
            &WrongProposal { price: 0.04, ..first() }, &linear_step(), exact().log_evidence);
    a_price_that_scatters: "scatter too much",
        proposal::the_mean_price_is_the_evidence(
            &WrongProposal { per_metre: 40.0, ..first() }, &linear_step(), exact().log_evidence);
    draws_somewhere_else: "mean of axis 0",
        proposal::weighted_draws_have_mean_and_covariance(
            &WrongProposal { east: 0.01, ..second() }, &linear_step(), &exact().mean, &exact().covariance);
    draws_that_scatter_less: "covariance (0, 0)",
        proposal::weighted_draws_have_mean_and_covariance(
            &second(), &linear_step(), &exact().mean, &(exact().covariance * 1.1));
    a_price_that_is_not_the_references: "the mean price is",
        proposal::draws_and_prices_are_those_of_the_reference(
            &WrongProposal { price: 0.04, ..second() }, &first(), &linear_step());
    a_price_that_makes_another_posterior: "mean of axis 0",
        proposal::draws_and_prices_are_those_of_the_reference(
            &WrongProposal { per_metre: 0.5, price: -0.5 * exact().mean.x - 0.002, ..second() }, &first(), &linear_step());
    a_filter_that_is_not_the_kalman_filter: "standard errors",
        linear::with_many_particles_it_is_the_kalman_filter(&WrongProposal { east: 0.002, ..second() });
    a_filter_that_explains_too_much: "of the evidence",
        linear::the_evidence_has_no_bias(&WrongProposal { price: 0.01, ..second() });
    a_filter_whose_error_does_not_shrink: "times those of 10 000",
        linear::the_error_shrinks_with_the_root_of_the_number_of_particles(&WrongProposal { east: 0.05, ..second() });
}
