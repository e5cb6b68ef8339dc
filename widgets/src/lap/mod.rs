//! Figure w17.1, the lap: a mosaic of universes, each with its own map, path and robot, and all of them laid over each other, or one of
//! them, large.

mod challenges;
mod drive;
mod grid;
mod hand;
mod layout;
mod many;
pub(crate) mod map;
mod model;
mod mosaic;
mod overlay;
mod paths;
mod recipe;
mod told;
mod verb;
mod view;

pub use layout::Layout;
pub use many::LAPS;
pub(crate) use map::ASPECT;
pub use model::LapModel;
pub use verb::Verb;
pub use view::LapView;
