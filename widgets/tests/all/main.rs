//! The laws of all figures, in one program: it is linked once, and its tests keep both cores busy to the end.

mod challenges;
mod claims;
mod common;
mod comparison;
mod conditioning;
mod doors;
mod drive;
mod em;
mod figures;
mod graph;
mod joint;
mod kept;
mod lap;
mod led;
mod log;
mod pinned;
mod prediction;
mod predictions_of_the_family;
mod proposal;
mod resampling;
mod smoothing;
mod trace;
mod vignettes;
mod whole;
mod words;
mod worked_example;
