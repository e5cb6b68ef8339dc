//! How a filter begins.

use super::Rbpf;
use crate::error::{Range, SettingError};
use crate::execute::Executor;
use crate::geometry::{Gaussian3, Pose2};
use crate::map::ConditionalMap;
use crate::particle::Particle;
use crate::proposal::Proposal;
use crate::random::{Purpose, Stream};
use crate::resampling::{ResamplePolicy, Scheme};
use crate::weights::Weights;

/// Slots are counted in 32 bits on every platform.
pub(super) const PARTICLES: Range = Range::whole(1, u32::MAX);
/// What [`Builder::selection_temper`] takes.
pub(super) const SELECTION_TEMPER: Range = Range::number(1e-6, 1.0, "");

/// Where the particles stand at step 0.
#[derive(Clone, Debug)]
pub enum Start {
    /// All at one pose, which is known: it defines the frame of the map.
    Pose(Pose2),
    /// Each at a draw of its own, from the stream (seed, [`Purpose::PROPOSAL`], step 0, slot).
    Gaussian(Gaussian3),
}

impl Start {
    fn draw(&self, seed: u64, slot: u32) -> Pose2 {
        match self {
            Self::Pose(pose) => *pose,
            Self::Gaussian(gaussian) => gaussian.sample(&mut Stream::at(seed, Purpose::PROPOSAL, 0, slot)),
        }
    }

    fn validate(&self) -> Result<(), SettingError> {
        // A Gaussian's covariance is finite: it has a Cholesky factor.
        let Pose2 { x, y, theta } = match self {
            Self::Pose(pose) => pose,
            Self::Gaussian(gaussian) => gaussian.mean(),
        };
        Range::finite("m").check("start.x", *x)?;
        Range::finite("m").check("start.y", *y)?;
        Range::finite("rad").check("start.theta", *theta).map(drop)
    }
}

impl From<Pose2> for Start {
    fn from(pose: Pose2) -> Self {
        Self::Pose(pose)
    }
}

impl From<Gaussian3> for Start {
    fn from(gaussian: Gaussian3) -> Self {
        Self::Gaussian(gaussian)
    }
}

/// A filter's settings, from [`Rbpf::builder`] to [`Builder::build`].
#[derive(Clone, Debug)]
#[must_use = "a builder does nothing before `build`"]
pub struct Builder<M, P> {
    map: M,
    proposal: P,
    particles: usize,
    seed: u64,
    start: Start,
    policy: ResamplePolicy,
    scheme: Scheme,
    selection_temper: f64,
    executor: Executor,
}

impl<M: ConditionalMap, P: Proposal<M>> Builder<M, P> {
    pub(super) fn new(map: M, proposal: P) -> Self {
        Self {
            map,
            proposal,
            particles: 30,
            seed: 0,
            start: Start::Pose(Pose2::default()),
            policy: ResamplePolicy::EssBelow(0.5),
            scheme: Scheme::Systematic,
            selection_temper: 1.0,
            executor: Executor::default(),
        }
    }

    /// Number of particles M, 1 or more; by default 30, as in gmapping.
    pub fn particles(self, particles: usize) -> Self {
        Self { particles, ..self }
    }

    /// Seed of all draws; by default 0. Filters of one seed and one input give the same bits.
    pub fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// A pose that is known, or a [`Gaussian3`] to draw from; by default the origin.
    pub fn start(self, start: impl Into<Start>) -> Self {
        Self { start: start.into(), ..self }
    }

    /// When to resample; by default where N_eff < M / 2 (Grisetti, Stachniss, Burgard 2007).
    pub fn policy(self, policy: ResamplePolicy) -> Self {
        Self { policy, ..self }
    }

    /// How to resample; by default systematically.
    pub fn scheme(self, scheme: Scheme) -> Self {
        Self { scheme, ..self }
    }

    /// τ, the share of what a step says of the particles that they are selected by, 10⁻⁶ to 1; by default 1.
    ///
    /// Particles are drawn by their scores w^τ where the policy calls for it at N_eff of the scores, and survivors keep the weight w^(1 − τ).
    /// Whatever τ is, the weights w are those of the posterior, and the evidence has no bias ([`Rbpf::resample`]). With less than 1 the population
    /// keeps its variety longer: where many readings repeat one error, as beams and scans against one map do, the product of their likelihoods
    /// is too sure, and a population that is selected by all of it has one ancestor before a loop closes. The price is that the weights become
    /// uneven. gmapping selects by 1 / (3 M), and takes its best particle by the whole sum.
    pub fn selection_temper(self, selection_temper: f64) -> Self {
        Self { selection_temper, ..self }
    }

    /// Who computes; by default [`Executor::default`]. No number depends on it.
    pub fn executor(self, executor: Executor) -> Self {
        Self { executor, ..self }
    }

    /// The filter at step 0: every particle with a copy of the map, all of one weight.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] where there are no particles, where the policy's fraction or the temper is out of its range, where
    /// the start is not finite, or where the map or the proposal refuses one of its settings.
    pub fn build(self) -> Result<Rbpf<M, P>, SettingError> {
        let Self { map, proposal, particles: count, seed, start, policy, scheme, selection_temper, executor } = self;
        PARTICLES.check("particles", count as f64)?;
        SELECTION_TEMPER.check("selection_temper", selection_temper)?;
        map.validate()?;
        proposal.validate()?;
        policy.validate()?;
        start.validate()?;
        let copied = if matches!(start, Start::Pose(_)) { vec![0; count] } else { Vec::new() };
        Ok(Rbpf {
            proposal,
            policy,
            scheme,
            seed,
            selection_temper,
            executor,
            step: 0,
            resamplings: 0,
            particles: (0..count as u32).map(|slot| Particle::start(start.draw(seed, slot), map.clone())).collect(),
            weights: Weights::uniform(count),
            log_selected: 0.0,
            path_weights: Weights::uniform(count),
            copied,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::grid::{Grid, GridModel};
    use crate::map::landmarks::{Correspondence, Gate, Landmarks};
    use crate::matching::{Matcher, ScanModel};
    use crate::motion::OdometryModel;
    use crate::proposal::{Either, FromMeasurement, FromMotion};
    use crate::sensor::RangeBearing;
    use nalgebra::{Matrix3, Vector3};

    type Map = Landmarks<RangeBearing>;
    type Improved = FromMeasurement<OdometryModel>;

    fn builder() -> Builder<Map, Improved> {
        let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 5.0, field_of_view: 3.0 };
        let motion = OdometryModel { alphas: [0.1; 4] };
        Rbpf::builder(Landmarks::new(sensor, Correspondence::Known), FromMeasurement { motion })
    }

    #[test]
    fn what_cannot_be_built_is_refused_by_the_name_of_its_field() {
        let refused = |builder: Builder<Map, Improved>| builder.build().unwrap_err().to_string();
        let particles = "must be a whole number from 1 to 4294967295";
        assert_eq!(refused(builder().particles(0)), format!("particles = 0: {particles}"));
        assert_eq!(refused(builder().particles(1 << 32)), format!("particles = 4294967296: {particles}"));
        for (fraction, shown) in [(1.5, "1.5"), (-0.1, "-0.1"), (f64::NAN, "NaN")] {
            let policy = ResamplePolicy::EssBelow(fraction);
            assert_eq!(refused(builder().policy(policy)), format!("policy = {shown}: must be a number from 0 to 1"));
        }
        for (temper, shown) in [(0.0, "0"), (1.5, "1.5"), (f64::NAN, "NaN")] {
            let said = refused(builder().selection_temper(temper));
            assert_eq!(said, format!("selection_temper = {shown}: must be a number from 0.000001 to 1"));
        }
        let lost = Pose2 { x: f64::INFINITY, y: 0.0, theta: 0.0 };
        assert_eq!(refused(builder().start(lost)), "start.x = inf: must be a finite number [m]");
        let lost = Pose2 { x: 0.0, y: 0.0, theta: f64::NAN };
        assert_eq!(refused(builder().start(lost)), "start.theta = NaN: must be a finite number [rad]");
    }

    #[test]
    fn all_stand_at_a_start_that_is_known_and_the_defaults_are_those_documented() {
        let filter = builder().build().unwrap();
        assert_eq!(filter.particles().len(), 30);
        assert!(filter.particles().iter().all(|p| p.path.poses() == [Pose2::default()]));
        let (policy, scheme) = (filter.policy, filter.scheme);
        assert_eq!((filter.seed, policy, scheme), (0, ResamplePolicy::EssBelow(0.5), Scheme::Systematic));
        let start = Pose2::new(1.0, 2.0, 3.0);
        let filter = builder().particles(3).start(start).build().unwrap();
        assert!(filter.particles().len() == 3 && filter.particles().iter().all(|p| p.world_from_robot == start));
    }

    /// Where several filters of one seed begin at one Gaussian, slot k begins at one pose in all of them.
    #[test]
    fn a_start_that_is_a_gaussian_is_drawn_for_each_slot_at_its_address() {
        let covariance = Matrix3::from_diagonal(&Vector3::new(0.04, 0.09, 0.01));
        let gaussian = Gaussian3::new(Pose2::new(1.0, 2.0, 3.0), covariance).unwrap();
        let filter = builder().particles(8).seed(7).start(gaussian.clone()).build().unwrap();
        for (slot, particle) in (0..).zip(filter.particles()) {
            let expected = gaussian.sample(&mut Stream::at(7, Purpose::PROPOSAL, 0, slot));
            assert_eq!((particle.world_from_robot, particle.path.pose()), (expected, expected), "slot {slot}");
        }
        assert_eq!(filter.lineage(), 8, "each is a root of its own");
    }

    /// Every part of a filter is asked, through whatever it is wrapped in.
    #[test]
    fn a_part_that_cannot_be_used_is_refused_with_the_filter() {
        let refused = |sensor, motion, correspondence| {
            let built = Rbpf::builder(<Map>::new(sensor, correspondence), FromMeasurement { motion }).build();
            built.err().map(|error| error.field())
        };
        let sensor = RangeBearing { range_std: 0.0, bearing_std: 0.02, max_range: f64::INFINITY, field_of_view: 7.0 };
        let motion = OdometryModel { alphas: [0.1, 0.0, 0.1, 0.1] };
        assert_eq!(refused(sensor, motion, Correspondence::Known), None);
        let blunt = RangeBearing { range_std: f64::NAN, ..sensor };
        assert_eq!(refused(blunt, motion, Correspondence::Known), Some("sensor.range_std"));
        let wild = OdometryModel { alphas: [0.1, f64::INFINITY, 0.1, 0.1] };
        assert_eq!(refused(sensor, wild, Correspondence::Known), Some("motion.alphas"));
        let shut = Correspondence::Unknown(Gate { mahalanobis_squared: -1.0, ..Gate::default() });
        assert_eq!(refused(sensor, motion, shut), Some("gate.mahalanobis_squared"));
        let gate = Gate::default();
        for (gate, field) in [
            (Gate { sighting_worth: 0, ..gate }, "gate.sighting_worth"),
            (Gate { sighting_worth: 9, most_count: 8, ..gate }, "gate.most_count"),
            (Gate { merge_squared: f64::NAN, ..gate }, "gate.merge_squared"),
        ] {
            assert_eq!(refused(sensor, motion, Correspondence::Unknown(gate)), Some(field));
        }

        let grid = GridModel {
            cell_size: 0.1,
            log_odds_hit: 0.9,
            log_odds_pass: -0.4,
            log_odds_bounds: [-4.0, 4.0],
            ndt_std: 0.1,
            ndt_stretch: 1.0,
            lag: 0,
            distance_reach: 0,
            ndt_forgets: false,
        };
        let refused = |model, temper| {
            let likelihood = ScanModel::new(Matcher::Cell, temper, 0.1);
            let proposal = Either::<_, FromMotion<OdometryModel, ScanModel>>::Left(FromMotion { motion, likelihood });
            Rbpf::builder(<Grid>::new(model), proposal).build().err().map(|error| error.field())
        };
        assert_eq!(refused(grid, 0.3), None);
        assert_eq!(refused(grid, 0.0), Some("score.temper"));
        for (model, field) in [
            (GridModel { cell_size: 0.0, ..grid }, "grid.cell_size"),
            (GridModel { cell_size: f64::NAN, ..grid }, "grid.cell_size"),
            (GridModel { log_odds_hit: -0.1, ..grid }, "grid.log_odds_hit"),
            (GridModel { log_odds_pass: 0.1, ..grid }, "grid.log_odds_pass"),
            (GridModel { log_odds_bounds: [0.1, 4.0], ..grid }, "grid.log_odds_bounds"),
            (GridModel { log_odds_bounds: [-4.0, f64::NAN], ..grid }, "grid.log_odds_bounds"),
            (GridModel { ndt_std: 0.0, ..grid }, "grid.ndt_std"),
            (GridModel { ndt_stretch: 0.5, ..grid }, "grid.ndt_stretch"),
            (GridModel { lag: u32::MAX, ..grid }, "grid.lag"),
            (GridModel { distance_reach: 3, ..grid }, "grid.distance_reach"),
        ] {
            assert_eq!(refused(model, 0.3), Some(field));
        }
    }
}
