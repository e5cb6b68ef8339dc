//! Figure w17.2, when to resample: three filters on one log and one noise, and what becomes of their ancestry.

mod course;
mod filter;
mod layout;
mod model;
mod recipe;
mod told;
mod tree;
mod view;
mod wings;

pub use layout::{Column, Layout};
pub use model::{Moment, ResamplingModel};
pub use view::ResamplingView;
pub use wings::WINGS;
