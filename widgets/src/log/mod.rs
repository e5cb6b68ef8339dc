//! A recorded log of a robot with a laser: the building that the best universe has mapped, and the paths of all of them.

mod challenges;
mod kept;
mod laid;
mod layout;
mod map;
mod model;
mod opened;
mod recipe;
mod told;
mod tree;
mod verb;
mod view;

pub use layout::Layout;
pub use model::LogModel;
pub use verb::Verb;
pub use view::LogView;
