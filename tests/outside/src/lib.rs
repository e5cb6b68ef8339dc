//! A robot that the crate `fastslam` knows nothing of, and what its owner has to write to map with it: a motion, a sensor, a map with its
//! score, and a search. And a hall for it to drive through.

pub mod beacons;
pub mod hall;
pub mod points;
pub mod search;
pub mod wheels;
