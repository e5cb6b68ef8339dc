#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! A figure is a [`mod@recipe`] (a typed table of parameters), a [`model`] (deterministic, without clock or pixels), a [`view`] that makes
//! a [`scene`] of it (marks with meanings, without colours) and the one painter of [`paint`]. All of it together is a [`figure::Figure`]: an
//! [`action`] goes in, a [`frame`] comes out.

pub mod action;
pub mod challenge;
mod comparison;
pub mod decimal;
mod declared;
mod error;
pub mod export;
pub mod figure;
pub mod font;
pub mod frame;
pub mod ghost;
pub mod job;
pub mod kept;
pub mod marks;
mod measured;
pub mod model;
pub mod numerals;
pub mod paint;
pub mod panels;
pub mod param;
pub mod prediction;
pub mod prelude;
pub mod query;
pub mod recipe;
pub mod scene;
pub mod sketch;
mod symbol;
pub mod view;
pub mod words;
