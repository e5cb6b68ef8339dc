//! Figure w17.1, the lap: a mosaic of universes, each with its own map, path and robot, and all of them laid over each other, or one of
//! them, large.

mod challenges;
mod drive;
mod grid;
mod layout;
mod many;
mod map;
mod model;
mod mosaic;
mod overlay;
mod recipe;
mod told;
mod view;

pub use layout::Layout;
pub use many::LAPS;
pub use model::LapModel;
pub use view::LapView;
