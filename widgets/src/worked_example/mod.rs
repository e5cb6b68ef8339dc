//! One update by hand: two particles, one landmark, one sighting each, and every number between input and decision.

mod layout;
mod model;
mod recipe;
mod steps;
mod view;

pub use layout::Layout;
pub use model::WorkedExampleModel;
pub use view::WorkedExampleView;
