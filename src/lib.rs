#![doc = include_str!("README.md")]
//!
//! # Modules
//!
//! [`mapper`] is ready-made for odometry and a laser. For another sensor, map or motion, build a filter of your own:
//! [`rbpf`] is the algorithm, and takes any [`proposal`] and any [`map`]. Modules are the mathematics, in the order in which they
//! depend on each other: [`ops`] → [`random`] → [`geometry`] → [`motion`], [`sensor`] → [`map`] → [`matching`] → [`proposal`] → [`rbpf`] →
//! [`mapper`], [`smoothing`]. Recorded drives are read by the crate `fastslam-log`. Why the bits are the
//! same everywhere is said in [`ops`], [`random`] and [`execute`].
//!
//! # Glossary
//!
//! Names are those of the field. The chapter, its figures and some of its sources say other words for the same things:
//!
//! | there | here |
//! |---|---|
//! | universe | a particle: [`particle::Particle`], a pose, a path and a map |
//! | ancestry, family tree | [`genealogy`]: the tree of all paths |
//! | lineage | distinct ancestors at the start, [`Rbpf::lineage`](rbpf::Rbpf::lineage) |
//! | measurement-aware proposal, *aware* | the improved proposal: [`FromScan`](proposal::FromScan) for grids, [`FromMeasurement`](proposal::FromMeasurement) for landmarks |
//! | fixed lag, block proposal, delayed draw | [`FromWindow`](proposal::FromWindow), with a map that is [`Windowed`](proposal::Windowed) |
//! | static parameter, self-calibration, drift of the odometry | [`Calibrating`](proposal::Calibrating), with a map that is [`Calibrated`](proposal::Calibrated) |
//! | motion model only, FastSLAM 1.0 | the motion prior: [`FromMotion`](proposal::FromMotion) |
//! | what a particle pays, its price | log weight increment: [`log_increment`](proposal::Proposed::log_increment) |
//! | tempering, likelihood smoothing | the temper κ of [`ScanModel`](matching::ScanModel::new) |
//! | old map, map of some time ago | [`Grid::past`](map::grid::Grid::past), by its [`lag`](map::grid::GridModel::lag) |
//! | surface, square, a Gaussian per cell | NDT cell, of `CELLS_PER_NDT` × `CELLS_PER_NDT` cells: [`map::grid`] |
//! | matcher: cell, sub-cell | [`Matcher`](matching::Matcher): a scan is scored by occupancy, or by NDT cells |
//! | climb, hill climb | [`matching::hill_climb`] |
//! | coarse search, lattice | [`CorrelativeSearch`](proposal::CorrelativeSearch) |
//! | guard, doubting the match | [`minimum_improvement`](proposal::FromScanSettings::minimum_improvement) |
//! | correspondence, which landmark it is | [`Association`](map::landmarks::Association): matched, new or ignored |
//! | landmark that should have been seen | negative information: [`existence_count`](map::landmarks::Landmark::existence_count) |
//! | N_eff, effective sample size | [`ess`](weights::Weights::ess) |
//! | policy, N_eff below threshold | [`ResamplePolicy`](resampling::ResamplePolicy) |

/// The linear algebra of this crate’s interface: covariances, Jacobians and landmarks are its fixed-size matrices. Taken from here it is the
/// version that they are made of.
pub use nalgebra;
/// The generators and distributions of random numbers: a [`Stream`](random::Stream) is a generator by the traits of this version.
pub use rand;

pub mod error;
pub mod execute;
pub mod genealogy;
pub mod geometry;
#[cfg(any(test, feature = "laws"))]
pub mod laws;
pub mod map;
pub mod mapper;
pub mod matching;
pub mod motion;
pub mod ops;
pub mod order;
pub mod particle;
pub mod proposal;
pub mod random;
pub mod rbpf;
pub mod resampling;
#[cfg(feature = "serde")]
pub mod save;
pub mod sensor;
pub mod smoothing;
pub mod weights;
