//! What the past looks like afterwards: the ancestry that a filter leaves, and paths that a smoother draws.

mod challenges;
mod chart;
mod ground;
mod layout;
mod model;
mod recipe;
mod told;
mod view;

pub use layout::Layout;
pub use model::SmoothingModel;
pub use view::SmoothingView;
