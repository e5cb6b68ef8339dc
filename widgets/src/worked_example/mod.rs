//! One update by hand: two particles, one landmark, one sighting each, and every number between input and decision.

mod challenges;
mod hands;
mod layout;
mod model;
mod plot;
mod recipe;
mod steps;
mod told;
mod view;
mod window;

pub use layout::Layout;
pub use model::WorkedExampleModel;
pub use view::WorkedExampleView;
