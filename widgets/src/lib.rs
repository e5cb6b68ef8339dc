#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! A figure is a [`recipe`] (a typed table of parameters), a [`model`] (deterministic, without clock or pixels), a [`view`] that makes
//! a [`scene`] of it (marks with meanings, without colours), the one painter of [`paint`] and, in the browser, a `shell` whose methods are one line each. Native tests and
//! the command line use the same [`figure::Figure`] as the page.
// The program that reads bags has no figure.
#![cfg_attr(not(any(feature = "page", feature = "log")), allow(dead_code, unused_imports))]

pub mod challenge;
mod comma;
#[cfg(feature = "page")]
pub mod conditioning;
pub mod decimal;
#[cfg(feature = "page")]
pub mod doors;
#[cfg(feature = "page")]
pub mod em;
pub mod export;
pub mod figure;
pub mod font;
pub mod ghost;
#[cfg(feature = "page")]
pub mod graph;
pub mod job;
#[cfg(feature = "page")]
pub mod joint;
#[cfg(feature = "page")]
pub mod lap;
#[cfg(feature = "log")]
pub mod log;
pub mod marks;
mod message;
pub mod model;
#[cfg(feature = "page")]
mod names;
pub mod order;
pub mod paint;
pub mod panels;
pub mod param;
mod policy;
pub mod prediction;
pub mod prelude;
#[cfg(feature = "page")]
pub mod proposal;
mod query;
pub mod recipe;
pub mod registry;
#[cfg(feature = "page")]
pub mod resampling;
pub mod scene;
#[cfg(target_arch = "wasm32")]
pub mod shell;
#[cfg(feature = "page")]
pub mod smoothing;
#[cfg(all(target_arch = "wasm32", feature = "trouble"))]
mod trouble;
#[cfg(feature = "page")]
pub mod universes;
#[cfg(any(feature = "log", feature = "bags"))]
pub mod unread;
pub mod view;
pub mod words;
#[cfg(feature = "page")]
pub mod worked_example;

pub use fastslam;
