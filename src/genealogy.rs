//! Where particles come from: the tree of all paths that are still needed.
//!
//! A particle holds its newest node, a node its pose and the node before. Cloning a path is counting one reference more, and what
//! two particles have in common they share. A node without descendants is freed with its last reference, and its memory is
//! reused. So the tree never holds more than the population and its kept copies need. With multinomial resampling at every step that is t + O(M log M) nodes in expectation (Jacob, Murray, Rubenthaler 2015),
//! against M · t for paths kept apart; other schemes and policies are not covered by their proof, but share just as well.

#[cfg(feature = "serde")]
mod saved;

#[cfg(feature = "serde")]
pub use saved::SavedPaths;

use crate::geometry::Pose2;
use crate::order::distinct;
use core::fmt;
use std::sync::Arc;

/// A path, from a pose at step 0 on. A clone is the same node: it costs a reference, and so does a copy of a whole population.
#[derive(Clone)]
pub struct Path(Arc<Node>);

/// A pose, and how the robot came there.
struct Node {
    world_from_robot: Pose2,
    step: u32,
    before: Option<Path>,
}

impl Path {
    /// What a node takes, with its two counts of references \[bytes\].
    pub(crate) const NODE_BYTES: usize = size_of::<Node>() + 2 * size_of::<usize>();

    /// A path of one pose, at step 0.
    pub fn start(world_from_robot: Pose2) -> Self {
        Self(Arc::new(Node { world_from_robot, step: 0, before: None }))
    }

    /// Goes on to a pose. Whoever shares the path so far is not moved.
    pub fn push(&mut self, world_from_robot: Pose2) {
        let (step, before) = (self.step() + 1, Some(self.clone()));
        *self = Self(Arc::new(Node { world_from_robot, step, before }));
    }
}

impl Drop for Node {
    /// Frees what only this node held, in a loop: by recursion a long path would need a stack as deep.
    fn drop(&mut self) {
        let mut before = self.before.take();
        while let Some(path) = before {
            before = Arc::into_inner(path.0).and_then(|mut node| node.before.take());
        }
    }
}

impl Path {
    /// The newest pose.
    pub fn pose(&self) -> Pose2 {
        self.0.world_from_robot
    }

    /// The step of the newest pose.
    pub fn step(&self) -> u32 {
        self.0.step
    }

    /// The path up to one step earlier; `None` at step 0.
    pub fn before(&self) -> Option<&Self> {
        self.0.before.as_ref()
    }

    /// The path and all those before it, newest first: a path for each step.
    pub fn back(&self) -> impl Iterator<Item = &Self> {
        core::iter::successors(Some(self), |path| path.before())
    }

    /// The poses, from step 0 on.
    pub fn poses(&self) -> Vec<Pose2> {
        let mut poses: Vec<Pose2> = self.back().map(Self::pose).collect();
        poses.reverse();
        poses
    }

    /// The same number for those paths, of all that are held, that are one and the same. It says nothing else: where a path was
    /// freed, its number is given away again.
    pub fn id(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }
}

/// The newest pose only: a path is as long as the drive.
impl fmt::Debug for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Node { world_from_robot, step, .. } = &*self.0;
        f.debug_struct("Path").field("world_from_robot", world_from_robot).field("step", step).finish_non_exhaustive()
    }
}

/// What a population descends from.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Descent {
    /// The step of the first of `widths`: 0, or the latest at which all have one ancestor.
    first: u32,
    /// Distinct ancestors at each step from there to the population's own. They never fall from one step to the next.
    widths: Vec<u32>,
}

impl Descent {
    /// What these paths, all of one step, descend from. Goes back node by node to the common ancestor, and no further.
    ///
    /// # Panics
    /// Without any path.
    pub fn of<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Self {
        let mut front: Vec<&Path> = paths.into_iter().collect();
        let last = front[0].step();
        let mut widths = Vec::new();
        loop {
            // Siblings are neighbours already where particles were resampled in the order of their slots.
            front = distinct(&front, |path| path.id() as u64);
            widths.push(front.len() as u32);
            if front.len() == 1 || front[0].before().is_none() {
                break;
            }
            front.iter_mut().for_each(|path| *path = path.before().unwrap_or(path));
        }
        widths.reverse();
        Self { first: last + 1 - widths.len() as u32, widths }
    }

    /// Distinct ancestors at each step, from step 0 to the population's own.
    pub fn widths(&self) -> impl Iterator<Item = u32> {
        core::iter::repeat_n(1, self.first as usize).chain(self.widths.iter().copied())
    }

    /// Nodes of the tree that the population still needs.
    pub fn size(&self) -> u32 {
        self.first + self.widths.iter().sum::<u32>()
    }

    /// Distinct ancestors so many steps before the population's own, or at step 0, whichever is later: the lineage gauge. Seen
    /// from a later population it never rises.
    pub fn lineage(&self, steps_back: u32) -> u32 {
        // Before the first there is one: that is what the first says, or there are no steps before it.
        self.widths[(self.widths.len() - 1).saturating_sub(steps_back as usize)]
    }

    /// The latest step at which all have one ancestor: up to there they share one path. `None` where they share none.
    pub fn coalescence(&self) -> Option<u32> {
        // One particle is its own ancestor; of several, only the first width can be one.
        (self.widths[0] == 1).then_some(self.first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Pose2 {
        Pose2::new(x, 0.0, 0.0)
    }

    fn then(path: &Path, x: f64) -> Path {
        let mut path = path.clone();
        path.push(at(x));
        path
    }

    /// Three steps of three, by slot: both ends of the first step have died out, and one of the second.
    fn tree() -> [[Path; 3]; 3] {
        let roots = [0.0, 1.0, 2.0].map(|x| Path::start(at(x)));
        let first = [0, 1, 1].map(|k: usize| then(&roots[k], 10.0));
        let second = [1, 2, 2].map(|k: usize| then(&first[k], 20.0));
        [roots, first, second]
    }

    #[test]
    fn paths_share_their_past_and_the_gauge_counts_it() {
        let [_, first, second] = tree();
        assert_eq!(second[2].poses().iter().map(|pose| pose.x).collect::<Vec<_>>(), [1.0, 10.0, 20.0]);
        let descent = Descent::of(&second);
        assert_eq!(descent.widths().collect::<Vec<_>>(), [1, 2, 3]);
        assert_eq!([0, 1, 2, 9].map(|steps_back| descent.lineage(steps_back)), [3, 2, 1, 1]);
        assert_eq!((descent.size(), descent.coalescence()), (6, Some(0)));
        let descent = Descent::of(&first);
        assert_eq!((descent.widths().collect::<Vec<_>>(), descent.coalescence()), (vec![2, 3], None));
        let alone = Descent::of(&first[1..=1]);
        assert_eq!((alone.size(), alone.coalescence()), (2, Some(1)), "one node is its own ancestor");
    }

    #[test]
    fn the_order_of_the_slots_does_not_matter() {
        let [_, _, [a, b, c]] = tree();
        let descents = [[&a, &b, &c], [&b, &a, &c], [&c, &b, &a]].map(Descent::of);
        assert!(descents.iter().all(|descent| *descent == descents[0]), "{descents:?}");
    }

    #[test]
    fn what_is_shared_before_the_common_ancestor_is_not_gone_through() {
        let mut trunk = Path::start(at(0.0));
        (0..99).for_each(|_| trunk.push(at(1.0)));
        let ends = [then(&trunk, 2.0), then(&trunk, 3.0)];
        let descent = Descent::of(&ends);
        assert_eq!((descent.first, &descent.widths[..]), (99, &[1, 2][..]));
        assert_eq!((descent.size(), descent.coalescence(), descent.widths().count()), (102, Some(99), 101));
        assert_eq!([0, 1, 2, 1000].map(|steps_back| descent.lineage(steps_back)), [2, 1, 1, 1]);
    }

    #[test]
    fn a_node_is_freed_with_the_last_that_descends_from_it() {
        let [roots, first, second] = tree();
        let watched = [&roots[0], &roots[1], &first[0]].map(|path| Arc::downgrade(&path.0));
        let held = || [0, 1, 2].map(|k: usize| watched[k].strong_count() > 0);
        drop((roots, first));
        assert_eq!(held(), [false, true, false], "slots 0 and 2 of the start and 0 of step 1 have no descendants");
        drop(second);
        assert_eq!(held(), [false; 3]);
    }

    #[test]
    fn a_long_path_is_freed_without_a_deep_stack() {
        let mut path = Path::start(at(0.0));
        // A test has a stack of 2 MB, by default: two bytes for each pose.
        (0..1_000_000).for_each(|_| path.push(at(1.0)));
        drop(path);
    }

    #[test]
    fn what_is_appended_to_a_clone_stays_there() {
        let [_, _, [kept, ..]] = tree();
        let mut longer = kept.clone();
        assert_eq!(longer.id(), kept.id());
        longer.push(at(30.0));
        assert_eq!((longer.step(), kept.step(), longer.before().map(Path::id)), (3, 2, Some(kept.id())));
        assert_eq!(format!("{kept:?}").matches("Pose2").count(), 1, "a path is not written out");
    }
}
