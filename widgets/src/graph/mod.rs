//! The pose graph: one path with one map that is bent as a whole, beside the universes on the same log.

mod challenges;
mod chart;
mod city;
mod layout;
mod many;
mod model;
mod recipe;
mod told;
mod universes;
mod view;

pub use layout::Layout;
pub use many::GRAPHS;
pub use model::GraphModel;
pub use view::GraphView;
