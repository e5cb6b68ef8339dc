//! Paths as the tree that they share.

use super::{Node, Path};
use crate::geometry::Pose2;
use crate::save::{self, RestoreError, SaveShared};
use serde::{Deserialize, Serialize};

/// Paths that share their past: the nodes of their tree, and where each of them ends.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SavedPaths {
    /// Each behind the one that it follows.
    nodes: Vec<SavedNode>,
    /// The newest node of each path.
    ends: Vec<u32>,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct SavedNode {
    world_from_robot: Pose2,
    /// The node before; none at step 0.
    before: Option<u32>,
}

impl SaveShared for Path {
    type Saved = SavedPaths;

    fn save_all<'a>(paths: impl IntoIterator<Item = &'a Self>) -> SavedPaths {
        let mut tree = save::Table::<Node>::default();
        let ends = paths.into_iter().map(|path| {
            // What is new of it, oldest first.
            let mut new: Vec<&Self> = path.back().take_while(|path| tree.known(&path.0).is_none()).collect();
            while let Some(path) = new.pop() {
                tree.index(&path.0);
            }
            tree.index(&path.0)
        });
        let ends = ends.collect();
        let before = |node: &Node| node.before.as_ref().and_then(|path| tree.known(&path.0));
        let saved = |node: &Node| SavedNode { world_from_robot: node.world_from_robot, before: before(node) };
        SavedPaths { nodes: tree.things.iter().map(|node| saved(node)).collect(), ends }
    }

    fn restore_all(SavedPaths { nodes, ends }: SavedPaths) -> Result<Vec<Self>, RestoreError> {
        let mut paths: Vec<Self> = Vec::with_capacity(nodes.len());
        for SavedNode { world_from_robot: pose, before } in nodes {
            save::finite("paths.nodes", [pose.x, pose.y, pose.theta])?;
            let path = match before {
                None => Self::start(pose),
                Some(index) => {
                    let mut path = save::at("paths.nodes", &paths, index)?.clone();
                    path.push(pose);
                    path
                }
            };
            paths.push(path);
        }
        ends.into_iter().map(|end| save::at("paths.nodes", &paths, end).cloned()).collect()
    }
}
