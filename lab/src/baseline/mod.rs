//! What a particle filter approximates, computed without particles: the oracle of tests and of figures.

mod ekf;
pub mod em_mapping;
pub mod information_matrix;
pub mod one_step;
pub mod pose_graph;
pub mod sampled_map;

pub use ekf::{EkfSlam, EkfStep};
