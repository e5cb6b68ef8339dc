//! Maps of landmarks as the blocks that they share.

use super::shared::{Node, Shared};
use super::{Correspondence, Landmark, Landmarks, Store};
use crate::map::ConditionalMap;
use crate::save::{self, RestoreError, SaveShared};
use crate::sensor::LandmarkSensor;
use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::sync::Arc;

/// A landmark in plain numbers.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct SavedLandmark {
    mean: [f64; 2],
    /// By columns.
    covariance: [[f64; 2]; 2],
    existence_count: i32,
    #[serde(default)]
    apart: u32,
}

impl From<Landmark> for SavedLandmark {
    fn from(Landmark { mean, covariance, existence_count, apart }: Landmark) -> Self {
        Self { mean: mean.into(), covariance: covariance.into(), existence_count, apart }
    }
}

impl From<SavedLandmark> for Landmark {
    fn from(SavedLandmark { mean, covariance, existence_count, apart }: SavedLandmark) -> Self {
        Self { mean: Vector2::from(mean), covariance: Matrix2::from(covariance), existence_count, apart }
    }
}

fn check(landmarks: &[Option<Landmark>]) -> Result<(), RestoreError> {
    let numbers = landmarks.iter().flatten().flat_map(|landmark| landmark.mean.iter().chain(&landmark.covariance));
    save::finite("maps.landmarks", numbers.copied())
}

/// Maps of landmarks: the settings of each, and what their stores hold together.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SavedLandmarks<Z, T> {
    settings: Vec<(Z, Correspondence)>,
    stores: T,
}

impl<Z, S> SaveShared for Landmarks<Z, S>
where
    Z: LandmarkSensor + Serialize + DeserializeOwned,
    S: Store + SaveShared,
{
    type Saved = SavedLandmarks<Z, S::Saved>;

    fn save_all<'a>(maps: impl IntoIterator<Item = &'a Self>) -> Self::Saved
    where
        Self: 'a,
    {
        let maps: Vec<&Self> = maps.into_iter().collect();
        let settings = maps.iter().map(|map| (map.sensor.clone(), map.correspondence)).collect();
        SavedLandmarks { settings, stores: S::save_all(maps.iter().map(|map| &map.store)) }
    }

    fn restore_all(SavedLandmarks { settings, stores }: Self::Saved) -> Result<Vec<Self>, RestoreError> {
        let stores = S::restore_all(stores)?;
        save::count("maps.settings", settings.len(), stores.len())?;
        let maps = settings.into_iter().zip(stores).map(|((sensor, correspondence), store)| {
            let map = Self { sensor, correspondence, store };
            map.validate()?;
            Ok(map)
        });
        maps.collect()
    }
}

/// The plain form: it shares nothing.
impl SaveShared for Vec<Option<Landmark>> {
    type Saved = Vec<Self>;

    fn save_all<'a>(stores: impl IntoIterator<Item = &'a Self>) -> Vec<Self> {
        stores.into_iter().cloned().collect()
    }

    fn restore_all(stores: Vec<Self>) -> Result<Vec<Self>, RestoreError> {
        stores.iter().try_for_each(|store| check(store))?;
        Ok(stores)
    }
}

/// Trees that share their nodes.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SavedTrees {
    /// Each behind those below it.
    nodes: Vec<SavedNode>,
    trees: Vec<SavedTree>,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
enum SavedNode {
    Inner(Vec<Option<u32>>),
    Leaf(Vec<Option<Landmark>>),
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct SavedTree {
    root: u32,
    height: u32,
    len: u32,
}

/// Writes the nodes of trees, each once.
#[derive(Default)]
struct Writer {
    /// By address. Inner nodes and leaves are all held while they are written, so no two have one address.
    indices: std::collections::BTreeMap<usize, u32>,
    nodes: Vec<SavedNode>,
}

impl Writer {
    /// The number of a node, written behind those below it. As deep as the tree is high.
    fn write<const W: usize>(&mut self, node: &Node<W>) -> u32 {
        if let Some(index) = self.indices.get(&node.address()) {
            return *index;
        }
        let saved = match node {
            Node::Inner(children) => {
                SavedNode::Inner(children.iter().map(|child| child.as_ref().map(|child| self.write(child))).collect())
            }
            Node::Leaf(places) => SavedNode::Leaf(places.to_vec()),
        };
        let index = self.nodes.len() as u32;
        self.nodes.push(saved);
        self.indices.insert(node.address(), index);
        index
    }
}

impl<const W: usize> SaveShared for Shared<W> {
    type Saved = SavedTrees;

    fn save_all<'a>(trees: impl IntoIterator<Item = &'a Self>) -> SavedTrees {
        let mut writer = Writer::default();
        let trees = trees.into_iter().map(|tree| SavedTree {
            root: writer.write(&tree.root),
            height: tree.height,
            len: tree.len,
        });
        SavedTrees { trees: trees.collect(), nodes: writer.nodes }
    }

    fn restore_all(SavedTrees { nodes, trees }: SavedTrees) -> Result<Vec<Self>, RestoreError> {
        // With their heights above the leaves.
        let mut restored: Vec<(Node<W>, u32)> = Vec::with_capacity(nodes.len());
        for node in nodes {
            let (node, height) = match node {
                SavedNode::Leaf(places) => {
                    check(&places)?;
                    (Node::Leaf(Arc::new(width(places)?)), 0)
                }
                SavedNode::Inner(children) => {
                    let child =
                        |index: Option<u32>| index.map(|index| save::at("maps.nodes", &restored, index)).transpose();
                    let children = children.into_iter().map(child).collect::<Result<Vec<_>, RestoreError>>()?;
                    let mut heights = children.iter().flatten().map(|(_, height)| *height);
                    let height = heights.next();
                    let alike = heights.all(|other| Some(other) == height);
                    let Some(height) = height.filter(|_| alike) else {
                        let needed = "an inner node of one child or more, all of one height";
                        return Err(RestoreError::Inconsistent { part: "maps.nodes", needed });
                    };
                    let children = children.into_iter().map(|child| child.map(|(node, _)| node.clone())).collect();
                    (Node::Inner(Arc::new(width(children)?)), height + 1)
                }
            };
            // Nor is any node dropped by a deeper recursion than that.
            save::holds(Self::is_high_enough(height, 0), "maps.nodes", "no higher than an index has digits")?;
            restored.push((node, height));
        }
        let tree = |SavedTree { root, height, len }| {
            let (root, found) = save::at("maps.nodes", &restored, root)?;
            save::holds(*found == height, "maps.height", "that of the root")?;
            save::holds(Self::is_high_enough(height, len), "maps.len", "no more than a tree of its height holds")?;
            Ok(Self { root: root.clone(), height, len })
        };
        trees.into_iter().map(tree).collect()
    }
}

/// As many as a node has.
fn width<T, const W: usize>(places: Vec<T>) -> Result<[T; W], RestoreError> {
    let found = places.len();
    places.try_into().map_err(|_| RestoreError::Count { part: "maps.nodes", found, needed: W })
}
