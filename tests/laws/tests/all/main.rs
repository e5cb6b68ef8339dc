//! The laws but for those that need a program of their own, in one program: it is linked once, and its tests keep both cores busy to the end.

mod broken;
mod drift;
mod filter;
mod fit;
mod graphs;
mod jumps;
mod landmarks;
mod localizer;
mod log;
mod map;
mod mapper;
mod order;
mod proposal;
mod resampling;
mod ring;
mod robots;
mod saved;
mod sense;
mod smoothing;
mod sound;
mod steering;
mod turned;
mod units;
mod window;
