#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! A figure is a [`recipe`] (a typed table of parameters), a [`model`] (deterministic, without clock or pixels), a [`view`] that makes
//! a [`scene`] of it (marks with meanings, without colours), the one painter of [`paint`] and, in the browser, a `shell`: an [`action`] goes in, a [`frame`] comes out. Native tests and
//! the command line use the same [`figure::Figure`] as the page.

pub mod action;
pub mod challenge;
pub mod comma;
mod comparison;
pub mod decimal;
pub mod export;
pub mod figure;
pub mod font;
pub mod frame;
pub mod ghost;
pub mod job;
pub mod kept;
pub mod marks;
mod message;
pub mod model;
mod names;
pub mod order;
pub mod paint;
pub mod panels;
pub mod param;
mod policy;
pub mod prediction;
pub mod prelude;
pub mod query;
pub mod recipe;
pub mod registry;
mod robot;
pub mod scene;
#[cfg(target_arch = "wasm32")]
pub mod shell;
mod symbol;
mod told;
#[cfg(all(target_arch = "wasm32", feature = "trouble"))]
mod trouble;
pub mod unread;
pub mod view;
pub mod vignette;
pub mod words;

// The figures: scripts/registry.mjs writes a line for each row of the registry.
pub mod conditioning;
pub mod doors;
pub mod em;
pub mod graph;
pub mod joint;
pub mod lap;
pub mod log;
pub mod proposal;
pub mod resampling;
pub mod smoothing;
pub mod universes;
pub mod worked_example;

pub use fastslam;
