//! Figure w17.2, when to resample: three filters on one log and one noise, and what becomes of their ancestry.

mod challenges;
mod charts;
mod course;
mod guess;
mod layout;
mod model;
mod recipe;
mod stroke;
mod told;
mod tree;
mod values;
mod view;
mod wings;

pub use layout::{Layout, Parts};
pub use model::{Moment, ResamplingModel};
pub use view::ResamplingView;
pub use wings::WINGS;
