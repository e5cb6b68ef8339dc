//! The sampled map against the computed one: what particles are left of, when the map is drawn along with the path.

mod challenges;
mod chart;
mod guess;
mod layout;
mod model;
mod panel;
mod recipe;
mod told;
mod view;

pub use layout::Layout;
pub use model::JointModel;
pub use view::JointView;
