//! Where particles come from: one append-only tree of all paths.
//!
//! A particle holds the number of its newest node; a node holds its pose and its parent. Cloning a path is copying one number,
//! and what two particles have in common they share. The tree that is still reachable from a population has an expected size of
//! t + O(M log M) nodes (Jacob, Murray, Rubenthaler 2015), against M · t for paths kept apart.

use crate::geometry::Pose2;
use core::ops::Range;
use std::sync::Arc;

/// Number of a node in the ancestry tree.
pub type NodeId = u32;

/// Parent of a root.
const NO_PARENT: NodeId = NodeId::MAX;

/// The nodes of one step.
#[derive(Clone, Debug, Default)]
struct Generation {
    parents: Vec<NodeId>,
    poses: Vec<Pose2>,
}

/// A forest of paths, a root for each particle of step 0.
///
/// Nodes are numbered as they are appended, step after step. A clone shares the steps: it costs a pointer for each.
#[derive(Clone, Debug)]
pub struct Ancestry {
    generations: Vec<Arc<Generation>>,
    /// Number of the first node of each step, and of the node to come.
    firsts: Vec<NodeId>,
}

impl Default for Ancestry {
    fn default() -> Self {
        Self { generations: Vec::new(), firsts: vec![0] }
    }
}

/// What a population descends from.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Descent {
    /// Distinct ancestors at each step, from step 0 to the population's own. They never fall from one step to the next.
    pub widths: Vec<u32>,
}

impl Descent {
    /// Nodes of the tree that the population still needs.
    pub fn size(&self) -> u32 {
        self.widths.iter().sum()
    }

    /// Distinct ancestors so many steps before the population's own, or at step 0, whichever is later: the lineage gauge. Seen
    /// from a later population it never rises.
    pub fn lineage(&self, steps_back: u32) -> u32 {
        self.widths[(self.widths.len() - 1).saturating_sub(steps_back as usize)]
    }

    /// The latest step at which all have one ancestor: up to there they share one path. `None` where they share none.
    pub fn coalescence(&self) -> Option<u32> {
        (self.widths.partition_point(|width| *width == 1) as u32).checked_sub(1)
    }
}

impl Ancestry {
    // ANCHOR: listing-push
    /// Appends a pose after `parent`, or as a root, and returns its number. Parents are of the step before.
    pub fn push(&mut self, parent: Option<NodeId>, world_from_robot: Pose2) -> NodeId {
        let opens = match parent {
            Some(parent) => parent >= self.firsts[self.generations.len() - 1],
            None => self.generations.is_empty(),
        };
        if opens {
            self.firsts.push(self.firsts[self.generations.len()]);
            self.generations.push(Arc::default());
        }
        let last = self.generations.len() - 1;
        let generation = Arc::make_mut(&mut self.generations[last]);
        generation.parents.push(parent.unwrap_or(NO_PARENT));
        generation.poses.push(world_from_robot);
        self.firsts[last + 1] += 1;
        self.firsts[last + 1] - 1
    }
    // ANCHOR_END: listing-push

    /// Number of steps, with step 0.
    pub fn steps(&self) -> u32 {
        self.generations.len() as u32
    }

    /// The nodes of a step, by slot.
    pub fn nodes(&self, step: u32) -> Range<NodeId> {
        self.firsts[step as usize]..self.firsts[step as usize + 1]
    }

    /// The step of a node.
    pub fn step(&self, node: NodeId) -> u32 {
        self.firsts.partition_point(|first| *first <= node) as u32 - 1
    }

    /// The node before, one step earlier; `None` for a root.
    pub fn parent(&self, node: NodeId) -> Option<NodeId> {
        self.parent_at(node, self.step(node))
    }

    /// The pose of a node.
    pub fn pose(&self, node: NodeId) -> Pose2 {
        self.pose_at(node, self.step(node))
    }

    fn parent_at(&self, node: NodeId, step: u32) -> Option<NodeId> {
        let parent = self.generations[step as usize].parents[(node - self.firsts[step as usize]) as usize];
        (parent != NO_PARENT).then_some(parent)
    }

    fn pose_at(&self, node: NodeId, step: u32) -> Pose2 {
        self.generations[step as usize].poses[(node - self.firsts[step as usize]) as usize]
    }

    /// Every edge once, as (parent, child) in the order of the children: of the nodes of these steps, from 1 on. For drawings.
    pub fn edges(&self, steps: Range<u32>) -> impl Iterator<Item = (NodeId, NodeId)> {
        let steps = steps.start.max(1)..steps.end.min(self.steps());
        steps.flat_map(move |step| self.nodes(step).filter_map(move |node| Some((self.parent_at(node, step)?, node))))
    }

    /// The path that ends in a node, from step 0 on.
    pub fn path(&self, node: NodeId) -> Vec<Pose2> {
        let mut path: Vec<Pose2> = self.line(node).map(|(node, step)| self.pose_at(node, step)).collect();
        path.reverse();
        path
    }

    /// A node and its ancestors with their steps, newest first.
    fn line(&self, node: NodeId) -> impl Iterator<Item = (NodeId, u32)> {
        let first = (node, self.step(node));
        core::iter::successors(Some(first), |(node, step)| Some((self.parent_at(*node, *step)?, step - 1)))
    }

    /// What these nodes, all of one step, descend from. Goes back node by node to the common ancestor, and no further.
    ///
    /// # Panics
    /// Without any node.
    pub fn descent(&self, nodes: &[NodeId]) -> Descent {
        let mut step = self.step(nodes[0]);
        let mut widths = vec![1; step as usize + 1];
        let mut front = nodes.to_vec();
        let mut seen = vec![false; self.firsts[self.generations.len()] as usize];
        loop {
            front.retain(|&node| !core::mem::replace(&mut seen[node as usize], true));
            widths[step as usize] = front.len() as u32;
            if front.len() == 1 || step == 0 {
                return Descent { widths };
            }
            front.iter_mut().for_each(|node| *node = self.parent_at(*node, step).unwrap_or(NO_PARENT));
            step -= 1;
        }
    }

    /// Of every node, by number, whether these nodes descend from it, or are it: what of a drawing is alive.
    pub fn alive(&self, nodes: &[NodeId]) -> Vec<bool> {
        let mut alive = vec![false; self.firsts[self.generations.len()] as usize];
        for node in nodes {
            // Where another line has been, it went on to the root.
            for (node, _) in self.line(*node) {
                if core::mem::replace(&mut alive[node as usize], true) {
                    break;
                }
            }
        }
        alive
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three steps of three: both ends of the first step have died out, and one of the second.
    fn tree() -> (Ancestry, Vec<NodeId>) {
        let mut tree = Ancestry::default();
        let at = |x: f64| Pose2::new(x, 0.0, 0.0);
        let roots: Vec<_> = (0..3).map(|k| tree.push(None, at(f64::from(k)))).collect();
        let first = [0, 1, 1].map(|k| tree.push(Some(roots[k]), at(10.0)));
        let second = [1, 2, 2].map(|k| tree.push(Some(first[k]), at(20.0)));
        (tree, second.into())
    }

    #[test]
    fn paths_share_their_past_and_the_gauge_counts_it() {
        let (tree, second) = tree();
        assert_eq!(tree.path(second[2]).iter().map(|pose| pose.x).collect::<Vec<_>>(), [1.0, 10.0, 20.0]);
        let descent = tree.descent(&second);
        assert_eq!(descent.widths, [1, 2, 3]);
        assert_eq!([0, 1, 2, 9].map(|steps_back| descent.lineage(steps_back)), [3, 2, 1, 1]);
        assert_eq!((descent.size(), descent.coalescence()), (6, Some(0)));
        let first: Vec<_> = tree.nodes(1).collect();
        assert_eq!((tree.descent(&first).widths, tree.descent(&first).coalescence()), (vec![2, 3], None));
        assert_eq!(tree.descent(&first[1..=1]).coalescence(), Some(1), "one node is its own ancestor");
    }

    #[test]
    fn a_drawing_gets_every_edge_once_and_knows_which_live() {
        let (tree, second) = tree();
        assert_eq!(tree.edges(0..9).collect::<Vec<_>>(), [(0, 3), (1, 4), (1, 5), (4, 6), (5, 7), (5, 8)]);
        assert_eq!(tree.edges(2..3).count(), 3);
        let alive = tree.alive(&second);
        let dead: Vec<_> = (0..9).filter(|node| !alive[*node]).collect();
        assert_eq!(dead, [0, 2, 3]);
        assert_eq!(alive.iter().filter(|alive| **alive).count() as u32, tree.descent(&second).size());
        assert!((0..9).all(|node| tree.nodes(tree.step(node)).contains(&node)));
    }

    #[test]
    fn what_is_appended_to_a_clone_stays_there() {
        let (mut tree, second) = tree();
        let kept = tree.clone();
        let third = tree.push(Some(second[0]), Pose2::default());
        assert_eq!((tree.steps(), kept.steps(), third), (4, 3, 9));
        tree.push(Some(second[1]), Pose2::default());
        assert_eq!((tree.nodes(3), kept.nodes(2)), (9..11, 6..9));
    }
}
