//! The goldens of all figures, in one program: it is linked once, and its tests keep both cores busy to the end.

mod characters;
mod goldens;
mod links;
mod universes;
