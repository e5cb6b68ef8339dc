//! The chapter's figures. A figure is a [`model`] (deterministic, without clock or pixels), a [`scene`] (marks with meanings,
//! without colours), the one painter of [`paint`] and, in the browser, a `shell` whose methods are one line each. Native tests and
//! the command line use the same [`figure::Figure`] as the page.

pub mod conditioning;
pub mod export;
pub mod figure;
pub mod font;
pub mod job;
pub mod lap;
pub mod log;
pub mod model;
pub mod paint;
mod param;
pub mod proposal;
mod query;
pub mod registry;
pub mod resampling;
pub mod scene;
#[cfg(target_arch = "wasm32")]
pub mod shell;
pub mod worked_example;

pub use fastslam;
