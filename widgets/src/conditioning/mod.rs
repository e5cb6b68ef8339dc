//! Figure w17.4, the graphical model: what couples landmarks, and what is left of it once the path is known.

mod layout;
mod model;
mod recipe;
mod scene;

pub use layout::Layout;
pub use model::ConditioningModel;
