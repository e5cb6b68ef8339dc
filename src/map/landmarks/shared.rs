//! Landmarks in a tree that copies share: a clone costs one pointer, and a write copies the nodes on its path and no others.

use super::{Landmark, Store, store::PLACE};
use crate::map::Footprint;
use std::sync::Arc;

/// The binary tree of the FastSLAM paper: a write copies ⌈log₂ N⌉ nodes of two places.
pub type Balanced = Shared<2>;

/// Blocks of eight: fewer and larger nodes, four levels for 4096 landmarks. What the filters use.
pub type Blocks = Shared<8>;

/// A persistent vector: a tree of width W (a power of two), all leaves at one depth, in which the digits of an index to base W
/// are its path (Bagwell 2001). It grows at the root.
#[derive(Clone, PartialEq, Debug)]
pub struct Shared<const W: usize> {
    pub(super) root: Node<W>,
    /// Levels above the leaves.
    pub(super) height: u32,
    pub(super) len: u32,
}

#[derive(Clone, PartialEq, Debug)]
pub(super) enum Node<const W: usize> {
    Inner(Arc<[Option<Node<W>>; W]>),
    Leaf(Arc<[Option<Landmark>; W]>),
}

impl<const W: usize> Node<W> {
    /// Without any landmark, this many levels above the leaves.
    fn empty(height: u32) -> Self {
        if height == 0 { Self::Leaf(Arc::new([None; W])) } else { Self::Inner(Arc::new([const { None }; W])) }
    }
}

#[cfg(feature = "serde")]
impl<const W: usize> Node<W> {
    /// The same for those that are one and the same.
    pub(super) fn address(&self) -> usize {
        match self {
            Self::Inner(children) => Arc::as_ptr(children).addr(),
            Self::Leaf(places) => Arc::as_ptr(places).addr(),
        }
    }
}

impl<const W: usize> Default for Shared<W> {
    fn default() -> Self {
        Self { root: Node::empty(0), height: 0, len: 0 }
    }
}

/// Of a pointer \[bytes\]: as on a 64-bit machine everywhere: the same footprint on every platform.
const POINTER: u64 = 8;

impl<const W: usize> Shared<W> {
    const BITS: u32 = {
        assert!(W.is_power_of_two() && W > 1);
        W.trailing_zeros()
    };

    /// Place of an index within its node of this height.
    fn digit(index: u32, height: u32) -> usize {
        (index >> (height * Self::BITS)) as usize & (W - 1)
    }

    fn reaches(&self, index: u32) -> bool {
        let bits = (self.height + 1) * Self::BITS;
        bits >= u32::BITS || index >> bits == 0
    }

    /// Whether a tree of this height exists, and may have this length.
    #[cfg(feature = "serde")]
    pub(super) fn is_high_enough(height: u32, len: u32) -> bool {
        // Its root tells apart by at least one bit of an index.
        let possible = height.saturating_mul(Self::BITS) < u32::BITS;
        possible && (len == 0 || Self { root: Node::empty(0), height, len }.reaches(len - 1))
    }
}

impl<const W: usize> Store for Shared<W> {
    fn len(&self) -> u32 {
        self.len
    }

    fn get(&self, index: u32) -> Option<&Landmark> {
        if index >= self.len {
            return None;
        }
        let (mut node, mut height) = (&self.root, self.height);
        loop {
            match node {
                Node::Inner(children) => node = children[Self::digit(index, height)].as_ref()?,
                Node::Leaf(places) => return places[Self::digit(index, 0)].as_ref(),
            }
            height -= 1;
        }
    }

    /// Looks at nodes that hold something alone, however far apart the indices are.
    fn iter(&self) -> impl Iterator<Item = (u32, &Landmark)> {
        let mut open = vec![(&self.root, self.height, 0)];
        let leaves = core::iter::from_fn(move || {
            loop {
                let (node, height, first) = open.pop()?;
                match node {
                    Node::Leaf(places) => return Some((first, places)),
                    Node::Inner(children) => {
                        let below = children.iter().enumerate().rev().filter_map(|(digit, child)| {
                            Some((child.as_ref()?, height - 1, first + ((digit as u32) << (height * Self::BITS))))
                        });
                        open.extend(below);
                    }
                }
            }
        });
        leaves.flat_map(|(first, places)| {
            places.iter().enumerate().filter_map(move |(digit, place)| Some((first + digit as u32, place.as_ref()?)))
        })
    }

    fn entry(&mut self, index: u32) -> &mut Option<Landmark> {
        self.len = self.len.max(index.saturating_add(1));
        while !self.reaches(index) {
            let below = core::mem::replace(&mut self.root, Node::empty(0));
            let mut children = [const { None }; W];
            children[0] = Some(below);
            self.root = Node::Inner(Arc::new(children));
            self.height += 1;
        }
        let (mut node, mut height) = (&mut self.root, self.height);
        loop {
            match node {
                Node::Inner(children) => {
                    let child = &mut Arc::make_mut(children)[Self::digit(index, height)];
                    height -= 1;
                    node = child.get_or_insert_with(|| Node::empty(height));
                }
                Node::Leaf(places) => return &mut Arc::make_mut(places)[Self::digit(index, 0)],
            }
        }
    }

    fn footprint<'a>(stores: impl Iterator<Item = &'a Self>) -> Footprint {
        let mut footprint = Footprint::default();
        let mut level: Vec<&Node<W>> = Vec::new();
        for store in stores {
            footprint.dense += u64::from(store.len) * PLACE;
            level.push(&store.root);
        }
        // Trees of one height share level by level; where heights differ, a shared root is another's inner node.
        let mut seen = std::collections::BTreeSet::new();
        while let Some(node) = level.pop() {
            let (address, bytes) = match node {
                Node::Inner(children) => (Arc::as_ptr(children).addr(), W as u64 * 2 * POINTER),
                Node::Leaf(places) => (Arc::as_ptr(places).addr(), W as u64 * PLACE),
            };
            if seen.insert(address) {
                footprint.unique += bytes;
                if let Node::Inner(children) = node {
                    level.extend(children.iter().flatten());
                }
            }
        }
        footprint
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2};

    fn landmark(x: u32) -> Landmark {
        Landmark {
            mean: Vector2::new(f64::from(x), 1.0),
            covariance: Matrix2::identity(),
            existence_count: 1,
            apart: 0,
        }
    }

    fn holds_what_a_vector_holds<S: Store>() {
        let (mut store, mut vector) = (S::default(), Vec::new());
        let mut copies = Vec::new();
        for k in 0..600_u32 {
            let index = (k * 7919) % (k + 1);
            let value = (k % 5 > 0).then(|| landmark(k));
            if k % 37 == 0 {
                copies.push((store.clone(), vector.clone()));
            }
            *store.entry(index) = value;
            *vector.entry(index) = value;
        }
        *store.entry(100_000) = Some(landmark(1));
        *vector.entry(100_000) = Some(landmark(1));
        copies.push((store, vector));
        for (store, vector) in copies {
            assert_eq!(store.len(), Store::len(&vector));
            assert!((0..store.len() + 2).all(|index| store.get(index) == Store::get(&vector, index)));
            assert!(Store::iter(&store).eq(Store::iter(&vector)));
        }
    }

    #[test]
    fn every_kind_holds_what_a_plain_vector_holds_and_writes_never_reach_a_copy() {
        holds_what_a_vector_holds::<Balanced>();
        holds_what_a_vector_holds::<Blocks>();
        holds_what_a_vector_holds::<Shared<4>>();
    }

    /// A tag whose number is a hash: one path from root to leaf, and nothing that grows with the number.
    #[test]
    fn an_index_of_thousands_of_millions_takes_no_more_than_one_of_hundreds() {
        let mut store = Blocks::default();
        for (x, index) in (1..).zip([3_000_000_000, 5, u32::MAX - 1]) {
            *store.entry(index) = Some(landmark(x));
        }
        let found: Vec<(u32, f64)> = store.iter().map(|(index, landmark)| (index, landmark.mean.x)).collect();
        assert_eq!(found, [(5, 2.0), (3_000_000_000, 1.0), (u32::MAX - 1, 3.0)]);
        assert!(Blocks::footprint([&store].into_iter()).unique <= 3 * (10 * 8 * 2 * POINTER + 8 * PLACE));
    }

    #[test]
    fn copies_share_all_but_what_was_written() {
        let mut one = Blocks::default();
        (0..512).for_each(|index| *one.entry(index) = Some(landmark(index)));
        let alone = Blocks::footprint([&one].into_iter());
        let mut other = one.clone();
        assert_eq!(Blocks::footprint([&one, &other].into_iter()).unique, alone.unique);
        *other.entry(300) = None;
        let both = Blocks::footprint([&one, &other].into_iter());
        assert_eq!(both.unique - alone.unique, 2 * 8 * 2 * POINTER + 8 * PLACE, "two inner nodes and a leaf");
        assert_eq!(both.dense, 2 * 512 * PLACE);
    }
}
