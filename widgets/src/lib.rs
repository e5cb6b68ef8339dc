#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! A folder for each figure, and the [`registry`] of all. What they are made with is the kit, `fastslam-figures-kit`, whose modules stand here
//! too; what several of them say and draw of filters and robots is beside them. In the browser there is a `shell` as well: an [`action`] goes in,
//! a [`frame`] comes out. Native tests and the command line use the same [`figure::Figure`] as the page.

mod names;
pub mod order;
mod policy;
pub mod registry;
mod robot;
mod shared;
#[cfg(target_arch = "wasm32")]
pub mod shell;
mod told;
#[cfg(all(target_arch = "wasm32", feature = "trouble"))]
mod trouble;
pub mod unread;
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
pub use fastslam_figures_kit::{
    action, challenge, decimal, export, field, figure, font, frame, ghost, job, kept, marks, model, numerals, paint,
    panels, param, prediction, prelude, query, recipe, scene, sketch, view,
};
