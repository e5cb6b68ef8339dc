//! Figure w17.4, the graphical model: what couples landmarks, and what is left of it once the path is known.

mod challenges;
mod graph;
mod layout;
mod matrix;
mod model;
mod recipe;
mod told;
mod view;

pub use layout::Layout;
pub use model::ConditioningModel;
pub use view::ConditioningView;
