//! Laws of proposals.
//!
//! Each takes a proposal and a [`Step`]: one particle, what its robot does next, and what it sees then.
//!
//! Two kinds of proposals are told apart by what their price claims. Where E exp(log_increment) = ∫ p(z | x, m) p(x | x′, u) dx, as that of
//! [`FromMotion`](crate::proposal::FromMotion) is and, where all is linear, that of
//! [`FromMeasurement`](crate::proposal::FromMeasurement), draws with their weights are the posterior, whatever they were drawn from:
//! [`draws_and_prices_are_those_of_the_reference`], [`the_mean_price_is_the_evidence`] and
//! [`weighted_draws_have_mean_and_covariance`] hold. [`FromScan`](crate::proposal::FromScan) pays what the scan says of the *path*, which is
//! another price; of it only the laws of [`proposal_laws!`](crate::proposal_laws) without a reference can be asked.

use super::{Estimate, STANDARD_ERRORS, rounding, size, turn3};
use crate::geometry::Pose2;
use crate::map::{ConditionalMap, Observed};
use crate::ops;
use crate::particle::Particle;
use crate::proposal::Proposal;
use crate::random::{Purpose, Stream};
use core::borrow::Borrow;
use nalgebra::{Matrix3, Vector3};

/// One step of one particle, before it is taken.
pub struct Step<M: ConditionalMap, U> {
    /// Where the robot is, and its map.
    pub particle: Particle<M>,
    /// What the robot does.
    pub control: U,
    /// What it sees then.
    pub observation: Observed<M>,
}

/// A `#[test]` of every law in [`laws::proposal`](crate::laws::proposal) that all proposals obey: `proposal_laws!(name, proposal, step, turns)`
/// makes a module `name`. `proposal` is a [`Proposal`](crate::proposal::Proposal). `step` is a function that makes the
/// [`Step`](crate::laws::proposal::Step) in a world that has been moved by a pose T: everything in it that is given in the world’s frame
/// is T ⊕ what it would be. `turns` are the T that the map can follow: [`TURNS`](crate::laws::TURNS), or
/// [`QUARTER_TURNS`](crate::laws::QUARTER_TURNS) for grids.
///
/// With a fifth argument, a proposal whose price and draws are right, also
/// [`draws_and_prices_are_those_of_the_reference`](crate::laws::proposal::draws_and_prices_are_those_of_the_reference).
///
/// ```
/// use fastslam::geometry::Pose2;
/// use fastslam::laws::{TURNS, proposal::Step};
/// use fastslam::map::landmarks::{Correspondence, Landmark, Landmarks};
/// use fastslam::motion::{Odometry, OdometryModel};
/// use fastslam::nalgebra::{Matrix2, Vector2};
/// use fastslam::particle::Particle;
/// use fastslam::proposal::{FromMeasurement, FromMotion, Marginal};
/// use fastslam::sensor::{Feature, RangeBearing};
///
/// // Little noise, so that linearising does not show.
/// const MOTION: OdometryModel = OdometryModel { alphas: [1e-4, 1e-4, 1e-4, 1e-4] };
///
/// fn step(world: &Pose2) -> Step<Landmarks<RangeBearing>, Odometry> {
///     let sensor = RangeBearing { range_std: 0.02, bearing_std: 0.01, max_range: 9.0, field_of_view: 6.3 };
///     let [x, y] = world.transform([3.0, 1.0]);
///     let landmark = Landmark { mean: Vector2::new(x, y), covariance: Matrix2::identity() * 1e-4, existence_count: 1, apart: 0 };
///     Step {
///         particle: Particle::start(*world, Landmarks::new(sensor, Correspondence::Known).with([landmark])),
///         control: Odometry { rot1: 0.0, trans: 1.0, rot2: 0.0 },
///         observation: vec![Feature { z: Vector2::new(2.23, 0.46), signature: Some(0) }],
///     }
/// }
///
/// fastslam::proposal_laws!(first, FromMotion { motion: MOTION, likelihood: Marginal }, step, TURNS);
/// fastslam::proposal_laws!(
///     second,
///     FromMeasurement { motion: MOTION },
///     step,
///     TURNS,
///     FromMotion { motion: MOTION, likelihood: Marginal }
/// );
/// ```
#[macro_export]
macro_rules! proposal_laws {
    ($name:ident, $proposal:expr, $step:expr, $turns:expr $(,)?) => {
        $crate::tests_of_laws!(
            $name,
            proposal,
            [one_stream_gives_one_draw, turning_the_world_turns_what_is_drawn],
            (&$proposal, $step, &$turns)
        );
    };
    ($name:ident, $proposal:expr, $step:expr, $turns:expr, $reference:expr $(,)?) => {
        mod $name {
            #[allow(unused_imports)]
            use super::*;

            $crate::proposal_laws!(by_itself, $proposal, $step, $turns);

            #[test]
            fn draws_and_prices_are_those_of_the_reference() {
                let step = ($step)(&$crate::geometry::Pose2::default());
                $crate::laws::proposal::draws_and_prices_are_those_of_the_reference(&$proposal, &$reference, &step);
            }
        }
    };
}

/// A pose, its difference from where the particle stood, and ln of its price.
struct Draws(Vec<(Vector3<f64>, f64)>);

/// Number of draws of a law, unless it says otherwise.
const N: u32 = 10_000;

/// Names of the moments, as (i, j) of a covariance.
const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

impl Draws {
    /// n draws, as differences from `origin`; `trial` tells apart those that must be independent.
    fn of<M: ConditionalMap, P: Proposal<M>>(
        proposal: &P,
        Step { particle, control, observation }: &Step<M, P::Control>,
        origin: &Pose2,
        trial: u32,
        n: u32,
    ) -> Self {
        let draw = |slot| {
            let mut stream = Stream::at(4, Purpose::TRIAL, trial, slot);
            let proposed = proposal.propose(particle, control, observation.borrow(), &mut stream);
            (proposed.world_from_robot.minus(origin), proposed.log_increment)
        };
        Self((0..n).map(draw).collect())
    }

    /// The same draws, all at one price.
    fn unweighted(&self) -> Self {
        Self(self.0.iter().map(|(d, _)| (*d, 0.0)).collect())
    }

    /// E exp(log_increment), in units of exp(`log_unit`).
    fn price(&self, log_unit: f64) -> Estimate {
        Estimate::of(self.0.iter().map(|(_, log_price)| (ops::exp(log_price - log_unit), 1.0)))
    }

    /// ln of the largest price.
    fn log_largest(&self) -> f64 {
        self.0.iter().map(|(_, log_price)| *log_price).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The weighted mean of a function of the draws.
    fn mean_of(&self, value: impl Fn(&Vector3<f64>) -> f64 + Copy) -> Estimate {
        let largest = self.log_largest();
        Estimate::of(self.0.iter().map(move |(d, log_price)| (value(d), ops::exp(log_price - largest))))
    }

    /// Weighted mean and covariance (in the order of [`PAIRS`]) about `center`: nine numbers with their errors.
    fn moments(&self, center: &Vector3<f64>) -> Vec<Estimate> {
        let first = (0..3).map(|i| self.mean_of(|d| d[i] - center[i]));
        let second = PAIRS.iter().map(|&(i, j)| self.mean_of(|d| (d[i] - center[i]) * (d[j] - center[j])));
        first.chain(second).collect()
    }

    /// Weighted mean.
    fn center(&self) -> Vector3<f64> {
        Vector3::from_fn(|i, _| self.mean_of(|d| d[i]).mean)
    }
}

/// What a moment is called.
fn name(moment: usize) -> String {
    match moment.checked_sub(3) {
        None => format!("mean of axis {moment}"),
        Some(pair) => format!("covariance {:?}", PAIRS[pair]),
    }
}

/// A proposal draws from its stream and from nothing else: pose and price are the same bits when it is asked twice.
///
/// Takes the arguments of [`turning_the_world_turns_what_is_drawn`].
///
/// ```
/// # use fastslam::laws::{linear, proposal};
/// # use fastslam::proposal::{FromMotion, Marginal};
/// let first = FromMotion { motion: linear::Drift, likelihood: Marginal };
/// proposal::one_stream_gives_one_draw(&first, linear::one_step, &[]);
/// ```
pub fn one_stream_gives_one_draw<M: ConditionalMap, P: Proposal<M>>(
    proposal: &P,
    step: impl Fn(&Pose2) -> Step<M, P::Control>,
    _turns: &[Pose2],
) {
    let Step { particle, control, observation } = step(&Pose2::default());
    for slot in 0..100 {
        let [one, other] = [(), ()].map(|()| {
            let mut stream = Stream::at(4, Purpose::TRIAL, 0, slot);
            let proposed = proposal.propose(&particle, &control, observation.borrow(), &mut stream);
            let Pose2 { x, y, theta } = proposed.world_from_robot;
            [x, y, theta, proposed.log_increment].map(f64::to_bits)
        });
        assert_eq!(one, other, "one stream gave two draws");
    }
}

/// Draws and prices in a world moved by T are those of the world as it was, their poses moved: T⁻¹ ⊕ x has the same mean and covariance,
/// and exp(log_increment) the same mean. One stream need not give the same draw.
///
/// n = 10 000 draws in each world, all ten moments to 4.5 standard errors of their difference.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws::{TURNS, proposal::{self, Step}}, random::Stream};
/// # use fastslam::{map::ConditionalMap, particle::Particle, proposal::{Proposal, Proposed, ProposalTrace}};
/// #[derive(Clone)]
/// struct Nothing;
///
/// impl ConditionalMap for Nothing {
///     type Observation = ();
///     type Association = ();
///     fn assimilate(&mut self, _: &Pose2, (): &(), (): &()) {}
/// }
///
/// /// Goes ahead, some way.
/// struct Ahead;
///
/// impl Proposal<Nothing> for Ahead {
///     type Control = ();
///     fn propose(&self, particle: &Particle<Nothing>, (): &(), (): &(), stream: &mut Stream) -> Proposed<()> {
///         let ahead = Pose2::new(1.0 + 0.1 * stream.normal(), 0.0, 0.0);
///         let world_from_robot = particle.world_from_robot.compose(&ahead);
///         Proposed { world_from_robot, association: (), log_increment: 0.0, trace: ProposalTrace::Motion }
///     }
/// }
///
/// let step = |world: &Pose2| Step { particle: Particle::start(*world, Nothing), control: (), observation: () };
/// proposal::turning_the_world_turns_what_is_drawn(&Ahead, step, &TURNS);
/// ```
pub fn turning_the_world_turns_what_is_drawn<M: ConditionalMap, P: Proposal<M>>(
    proposal: &P,
    step: impl Fn(&Pose2) -> Step<M, P::Control>,
    turns: &[Pose2],
) {
    let here = step(&Pose2::default());
    let origin = here.particle.world_from_robot;
    let drawn = Draws::of(proposal, &here, &origin, 0, N);
    let (center, log_unit) = (drawn.unweighted().center(), drawn.log_largest());
    let (moments, price) = (drawn.unweighted().moments(&center), drawn.price(log_unit));
    for (trial, world) in (1..).zip(turns) {
        let moved = world.compose(&origin);
        let Draws(turned) = Draws::of(proposal, &step(world), &moved, trial, N);
        let back = turn3(world).transpose();
        let turned = Draws(turned.into_iter().map(|(d, log_price)| (back * d, log_price)).collect());
        // Coordinates that were moved there and back.
        let lost = rounding(size(world) + size(&origin));
        for (k, (there, here)) in turned.unweighted().moments(&center).iter().zip(&moments).enumerate() {
            let off = (there.mean - here.mean).abs();
            let alike = off <= STANDARD_ERRORS * ops::hypot(there.error, here.error) + lost;
            assert!(alike, "{} does not turn with the world by {}: {there:?} for {here:?}", name(k), world.theta);
        }
        let there = turned.price(log_unit);
        assert!(there.agrees_with(&price), "the price is not that of the world as it was: {there:?} for {price:?}");
    }
}

/// exp(log_increment) is the same in a world moved by T, for the same stream: of proposals whose price does not contain the pose that was
/// drawn, or whose draws turn with the world.
///
/// To 10⁻⁹ nats, what is left of likelihoods of coordinates that were moved.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws::{TURNS, proposal::{self, Step}}};
/// # use fastslam::map::landmarks::{Correspondence, Landmark, Landmarks};
/// # use fastslam::motion::{Odometry, OdometryModel};
/// # use fastslam::nalgebra::{Matrix2, Vector2};
/// # use fastslam::particle::Particle;
/// # use fastslam::proposal::FromMeasurement;
/// # use fastslam::sensor::{Feature, RangeBearing};
/// let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// let step = |world: &Pose2| {
///     let [x, y] = world.transform([3.0, 1.0]);
///     let landmark = Landmark { mean: Vector2::new(x, y), covariance: Matrix2::identity(), existence_count: 1, apart: 0 };
///     Step {
///         particle: Particle::start(*world, <Landmarks<_>>::new(sensor, Correspondence::Known).with([landmark])),
///         control: Odometry { rot1: 0.0, trans: 1.0, rot2: 0.0 },
///         observation: vec![Feature { z: Vector2::new(2.3, 0.4), signature: Some(0) }],
///     }
/// };
/// let second = FromMeasurement { motion: OdometryModel { alphas: [0.1, 0.02, 0.08, 0.02] } };
/// proposal::turning_the_world_leaves_the_price_of_a_draw(&second, step, &TURNS);
/// ```
pub fn turning_the_world_leaves_the_price_of_a_draw<M: ConditionalMap, P: Proposal<M>>(
    proposal: &P,
    step: impl Fn(&Pose2) -> Step<M, P::Control>,
    turns: &[Pose2],
) {
    let prices = |world: &Pose2| -> Vec<f64> {
        let Draws(drawn) = Draws::of(proposal, &step(world), &Pose2::default(), 0, 100);
        drawn.into_iter().map(|(_, log_price)| log_price).collect()
    };
    let expected = prices(&Pose2::default());
    for world in turns {
        for (there, here) in prices(world).iter().zip(&expected) {
            let off = (there - here).abs();
            assert!(off <= 1e-9 * (1.0 + here.abs()), "turned by {}: {there} nats for {here}", world.theta);
        }
    }
}

/// E exp(log_increment) = ∫ p(z | x, m) p(x | x′, u) dx, for a value \[nats\] that is known.
///
/// n = 40 000 draws, 4.5 standard errors.
///
/// # Panics
/// Also where the standard error is more than 5 % of the value: then nothing has been shown.
///
/// ```
/// # use fastslam::laws::{linear, proposal};
/// # use fastslam::{geometry::Pose2, proposal::{FromMeasurement, FromMotion, Marginal}};
/// let step = linear::one_step(&Pose2::default());
/// let second = FromMeasurement { motion: linear::Drift };
/// let exact = second.fold(&step.particle.map, &Pose2::default(), &step.control, &step.observation);
/// let first = FromMotion { motion: linear::Drift, likelihood: Marginal };
/// proposal::the_mean_price_is_the_evidence(&first, &step, exact.log_evidence);
/// ```
pub fn the_mean_price_is_the_evidence<M: ConditionalMap, P: Proposal<M>>(
    proposal: &P,
    step: &Step<M, P::Control>,
    log_evidence: f64,
) {
    let price = Draws::of(proposal, step, &Pose2::default(), 0, 4 * N).price(log_evidence);
    assert!(price.error < 0.05, "the prices scatter too much for anything to be said: {price:?}");
    assert!(price.agrees_with(&Estimate::exact(1.0)), "the mean price is {price:?} times the evidence");
}

/// E\[w x\] / E\[w\] = ∫ x p(x | z, x′, u, m) dx with w = exp(log_increment), and the same of the covariance: a mean pose and a covariance
/// (3 × 3, \[m, m, rad\]) that are known.
///
/// n = 40 000 draws, 4.5 standard errors for each of nine moments.
///
/// ```
/// # use fastslam::laws::{linear, proposal};
/// # use fastslam::{geometry::Pose2, proposal::{FromMeasurement, FromMotion, Marginal}};
/// let step = linear::one_step(&Pose2::default());
/// let second = FromMeasurement { motion: linear::Drift };
/// let exact = second.fold(&step.particle.map, &Pose2::default(), &step.control, &step.observation);
/// let first = FromMotion { motion: linear::Drift, likelihood: Marginal };
/// proposal::weighted_draws_have_mean_and_covariance(&first, &step, &exact.mean, &exact.covariance);
/// ```
pub fn weighted_draws_have_mean_and_covariance<M: ConditionalMap, P: Proposal<M>>(
    proposal: &P,
    step: &Step<M, P::Control>,
    mean: &Pose2,
    covariance: &Matrix3<f64>,
) {
    let moments = Draws::of(proposal, step, mean, 0, 4 * N).moments(&Vector3::zeros());
    let expected = [0.0; 3].into_iter().chain(PAIRS.map(|pair| covariance[pair]));
    for (k, (estimate, expected)) in moments.iter().zip(expected).enumerate() {
        let agrees = estimate.agrees_with(&Estimate::exact(expected));
        assert!(agrees, "{}: {estimate:?} for {expected}", name(k));
    }
}

/// Weighted draws of a proposal and of one that is known to be right agree: the mean of their prices, and mean and covariance of their
/// poses by these prices.
///
/// The reference may be [`FromMotion`](crate::proposal::FromMotion) with the same likelihood, which is the definition. n = 40 000 draws
/// of each, ten moments to 4.5 standard errors of their difference.
///
/// # Panics
/// Also where the standard error of a price is more than 5 % of it: then nothing has been shown.
///
/// ```
/// # use fastslam::laws::{linear, proposal};
/// # use fastslam::{geometry::Pose2, proposal::{FromMeasurement, FromMotion, Marginal}};
/// let first = FromMotion { motion: linear::Drift, likelihood: Marginal };
/// let second = FromMeasurement { motion: linear::Drift };
/// proposal::draws_and_prices_are_those_of_the_reference(&second, &first, &linear::one_step(&Pose2::default()));
/// ```
pub fn draws_and_prices_are_those_of_the_reference<M, P, Q>(proposal: &P, reference: &Q, step: &Step<M, P::Control>)
where
    M: ConditionalMap,
    P: Proposal<M>,
    Q: Proposal<M, Control = P::Control>,
{
    let origin = &step.particle.world_from_robot;
    let expected = Draws::of(reference, step, origin, 0, 4 * N);
    let drawn = Draws::of(proposal, step, origin, 1, 4 * N);
    let log_unit = expected.log_largest();
    let [price, expected_price] = [&drawn, &expected].map(|draws| draws.price(log_unit));
    for price in [price, expected_price] {
        let Estimate { mean, error } = price;
        assert!(error < 0.05 * mean, "the prices scatter too much for anything to be said: {price:?}");
    }
    assert!(price.agrees_with(&expected_price), "the mean price is {price:?} for {expected_price:?}");
    let center = expected.center();
    for (k, (one, other)) in drawn.moments(&center).iter().zip(expected.moments(&center)).enumerate() {
        assert!(one.agrees_with(&other), "{}: {one:?} for {other:?}", name(k));
    }
}
