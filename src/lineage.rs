//! Where particles come from: one append-only tree of all paths.
//!
//! A particle holds the number of its newest node; a node holds its pose and its parent. Cloning a path is copying one number,
//! and what two particles have in common they share. The tree that is still reachable from a population has an expected size of
//! t + O(M log M) nodes (Jacob, Murray, Rubenthaler 2015), against M · t for paths kept apart.

use crate::geometry::Pose2;

/// Number of a node in the ancestry tree.
pub type NodeId = u32;

/// Parent of a root.
const NO_PARENT: NodeId = NodeId::MAX;

/// A forest of paths, a root for each particle of step 0.
#[derive(Clone, Debug, Default)]
pub struct Ancestry {
    parents: Vec<NodeId>,
    poses: Vec<Pose2>,
}

impl Ancestry {
    /// Appends a pose after `parent`, or as a root, and returns its number.
    pub fn push(&mut self, parent: Option<NodeId>, world_from_robot: Pose2) -> NodeId {
        let id = self.parents.len() as NodeId;
        self.parents.push(parent.unwrap_or(NO_PARENT));
        self.poses.push(world_from_robot);
        id
    }

    /// The node before, one step earlier; `None` for a root.
    pub fn parent(&self, node: NodeId) -> Option<NodeId> {
        let parent = self.parents[node as usize];
        (parent != NO_PARENT).then_some(parent)
    }

    /// The path that ends in a node, from step 0 on.
    pub fn path(&self, node: NodeId) -> Vec<Pose2> {
        let mut path: Vec<Pose2> =
            core::iter::successors(Some(node), |n| self.parent(*n)).map(|n| self.poses[n as usize]).collect();
        path.reverse();
        path
    }

    /// Distinct ancestors of these nodes, all of one step, `steps` earlier or at step 0, whichever is later.
    ///
    /// This is the lineage gauge: seen from a later step it never rises.
    pub fn distinct_ancestors(&self, nodes: &[NodeId], steps: u32) -> usize {
        let mut front = nodes.to_vec();
        for _ in 0..steps {
            // Nodes of one step are numbered in slot order and have parents of one step: equal ones lie together once sorted.
            front.sort_unstable();
            front.dedup();
            if self.parent(front[0]).is_none() {
                break;
            }
            front.iter_mut().for_each(|node| *node = self.parents[*node as usize]);
        }
        front.sort_unstable();
        front.dedup();
        front.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_share_their_past_and_the_gauge_counts_it() {
        let mut tree = Ancestry::default();
        let at = |x: f64| Pose2::new(x, 0.0, 0.0);
        let roots: Vec<_> = (0..3).map(|k| tree.push(None, at(f64::from(k)))).collect();
        let first: Vec<_> = [0, 1, 1].map(|k| tree.push(Some(roots[k]), at(10.0))).into();
        let second: Vec<_> = [1, 2, 2].map(|k| tree.push(Some(first[k]), at(20.0))).into();
        assert_eq!(tree.path(second[2]), vec![at(1.0), at(10.0), at(20.0)]);
        let distinct: Vec<_> = (0..5).map(|steps| tree.distinct_ancestors(&second, steps)).collect();
        assert_eq!(distinct, [3, 2, 1, 1, 1]);
        assert_eq!(tree.distinct_ancestors(&first, 9), 2);
    }
}
