//! Figure w17.2, when to resample: three filters on one log and one noise, and what becomes of their ancestry.

mod layout;
mod model;
mod recipe;
mod scene;
mod wings;

pub use layout::{Column, Layout};
pub use model::{Moment, ResamplingModel};
pub use wings::WINGS;
