//! FastSLAM and Rao-Blackwellization: particle filters over paths, each particle towing a map it can compute exactly.
//!
//! From a log of a robot with a laser to a map and a path:
//!
#![doc = include_str!("mapper/example.md")]
//!
//! [`mapper`] is ready-made for odometry and a laser. Whoever has another sensor, map or motion builds a filter of their own:
//! [`rbpf`] is the algorithm, and takes any [`proposal`] and any [`map`]. Modules are the mathematics, in the order in which they
//! depend on each other: [`ops`] → [`random`] → [`geometry`] → [`motion`], [`sensor`] → [`map`] → [`matching`] → [`proposal`] → [`rbpf`] →
//! [`mapper`].
//!
//! Every result is meant to be the same to the last bit on every platform, with any number of threads: see [`ops`], [`random`]
//! and [`execute`]. Tested are native builds on x86-64 and WebAssembly in Chromium.

/// The linear algebra of this crate’s interface: covariances, Jacobians and landmarks are its fixed-size matrices. Taken from here it is the
/// version that they are made of.
pub use nalgebra;
/// The generators and distributions of random numbers: a [`Stream`](random::Stream) is a generator by the traits of this version.
pub use rand;

pub mod error;
pub mod execute;
pub mod genealogy;
pub mod geometry;
pub mod log;
pub mod map;
pub mod mapper;
pub mod matching;
pub mod motion;
pub mod ops;
pub mod particle;
pub mod proposal;
pub mod random;
pub mod rbpf;
pub mod resampling;
pub mod sensor;
pub mod weights;
