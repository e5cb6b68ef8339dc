//! A particle: one hypothesis of where the robot has been, and the map that follows from it.

use crate::genealogy::Path;
use crate::geometry::Pose2;

/// One hypothesis: a path and the map that follows from it.
#[derive(Clone, Debug)]
pub struct Particle<M> {
    /// Newest pose of the path.
    pub world_from_robot: Pose2,
    /// Map given the path.
    pub map: M,
    /// The path, a branch of the tree that all particles share.
    pub path: Path,
}

impl<M> Particle<M> {
    /// A particle at step 0: it stands at `world_from_robot`, which is all of its path, with this map.
    pub fn start(world_from_robot: Pose2, map: M) -> Self {
        Self { world_from_robot, map, path: Path::start(world_from_robot) }
    }
}
