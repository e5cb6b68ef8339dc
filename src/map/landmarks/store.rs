//! Where landmarks are kept: by index, with copies that cost as little as their kind allows.

use super::Landmark;
use crate::map::Footprint;

/// Landmarks by index. All kinds hold the same bits; they differ in what a copy and a change of a copy cost.
pub trait Store: Clone + Default + Send + Sync {
    /// One past the largest index in use.
    fn len(&self) -> u32;

    /// Whether there is no landmark at all.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The landmark of an index.
    fn get(&self, index: u32) -> Option<&Landmark>;

    /// All landmarks with their indices, in ascending order.
    fn iter(&self) -> impl Iterator<Item = (u32, &Landmark)> {
        (0..self.len()).filter_map(|index| Some((index, self.get(index)?)))
    }

    /// The place of an index, to be written: grown up to there, and nobody else's.
    fn entry(&mut self, index: u32) -> &mut Option<Landmark>;

    /// Memory of these stores.
    fn footprint<'a>(stores: impl Iterator<Item = &'a Self>) -> Footprint
    where
        Self: 'a;
}

/// Bytes of one place.
pub(super) const PLACE: u64 = size_of::<Option<Landmark>>() as u64;

/// The plain form: a copy copies every landmark, and there is a place for each index up to the largest, with a landmark or without.
impl Store for Vec<Option<Landmark>> {
    fn len(&self) -> u32 {
        self.len() as u32
    }

    fn get(&self, index: u32) -> Option<&Landmark> {
        self.as_slice().get(index as usize)?.as_ref()
    }

    fn entry(&mut self, index: u32) -> &mut Option<Landmark> {
        if self.len() <= index as usize {
            self.resize(index as usize + 1, None);
        }
        &mut self[index as usize]
    }

    fn footprint<'a>(stores: impl Iterator<Item = &'a Self>) -> Footprint {
        let bytes = stores.map(|store| store.len() as u64 * PLACE).sum();
        Footprint { unique: bytes, dense: bytes }
    }
}
