//! EM mapping on a corridor of nameless doors: the path computed forward and backward, the map decided; and beside it, on the same log,
//! particles.

mod challenges;
mod chart;
mod cloud;
mod layout;
mod map;
mod model;
mod recipe;
mod strips;
mod told;
mod view;

pub use layout::Layout;
pub use model::EmModel;
pub use view::EmView;
