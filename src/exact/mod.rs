//! What a particle filter approximates, computed without particles: the oracle of tests and of figures.

pub mod one_step;
