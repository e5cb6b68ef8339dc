//! Sorting: one sort of indices for all kinds of things, as each that is compiled weighs kilobytes in a browser; and a small one.

use core::cmp::Ordering;
use std::collections::BinaryHeap;

/// These things in the order that a comparison gives them, equals as they stand.
pub fn sorted<T>(things: Vec<T>, compare: impl Fn(&T, &T) -> Ordering) -> Vec<T> {
    let order = indices(things.len(), &|a, b| compare(&things[a], &things[b]));
    let mut things: Vec<Option<T>> = things.into_iter().map(Some).collect();
    order.into_iter().filter_map(|k| things[k].take()).collect()
}

/// Each of these things once, by a key that tells them apart, in the order in which they come first.
pub(crate) fn distinct<T: Copy>(things: &[T], key: impl Fn(T) -> u64) -> Vec<T> {
    // By open addressing (Knuth, *TAOCP* 3, §6.4): a thing is found at the place that its key is scattered to, or in one after it.
    let bits = (2 * things.len()).next_power_of_two().ilog2().max(1);
    let mut places = vec![None; 1 << bits];
    let mut found = Vec::new();
    for thing in things {
        let mut place = (key(*thing).wrapping_mul(GOLDEN) >> (u64::BITS - bits)) as usize;
        while places[place].is_some_and(|known| key(known) != key(*thing)) {
            place = (place + 1) & (places.len() - 1);
        }
        if places[place].is_none() {
            places[place] = Some(*thing);
            found.push(*thing);
        }
    }
    found
}

/// 2⁶⁴ over the golden ratio, which scatters neighbouring keys most evenly.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// Fewer things than these are put into their places one after the other: they are often in order as they come.
const MANY: usize = 24;

/// The indices of so many things in their order, equals as they stand. By std's heap, and not by its `sort_by`: that is three times the code.
fn indices(count: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    if count < MANY {
        let mut order = Vec::with_capacity(count);
        for index in 0..count {
            let before = order.iter().rposition(|before| compare(*before, index).is_le());
            order.insert(before.map_or(0, |last| last + 1), index);
        }
        return order;
    }
    let things: Vec<Thing> = (0..count).map(|index| Thing { index, compare }).collect();
    BinaryHeap::from(things).into_sorted_vec().into_iter().map(|thing| thing.index).collect()
}

/// One of the things that are sorted.
struct Thing<'a> {
    index: usize,
    compare: &'a dyn Fn(usize, usize) -> Ordering,
}

impl Ord for Thing<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.compare)(self.index, other.index).then(self.index.cmp(&other.index))
    }
}

impl PartialOrd for Thing<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Thing<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Thing<'_> {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_stay_as_they_stand() {
        let by_first = |a: &(i32, char), b: &(i32, char)| a.0.cmp(&b.0);
        let things = vec![(2, 'a'), (1, 'b'), (2, 'c'), (0, 'd'), (1, 'e')];
        assert_eq!(sorted(things, by_first), [(0, 'd'), (1, 'b'), (1, 'e'), (2, 'a'), (2, 'c')]);
        assert_eq!(sorted(Vec::new(), by_first), []);
        for count in [MANY - 1, MANY, 1000] {
            let things: Vec<(usize, usize)> = (0..count).map(|k| (k * 7919 % 31, k)).collect();
            let mut expected = things.clone();
            expected.sort_by_key(|thing| thing.0);
            assert_eq!(sorted(things, |a, b| a.0.cmp(&b.0)), expected);
        }
    }

    #[test]
    fn what_has_one_key_is_there_once() {
        let things = [(2, 'a'), (1, 'b'), (2, 'c'), (0, 'd'), (1, 'e')];
        assert_eq!(distinct(&things, |thing| thing.0), [(2, 'a'), (1, 'b'), (0, 'd')]);
        assert_eq!(distinct(&[], |thing: (u64, char)| thing.0), []);
        assert_eq!(distinct(&things[..1], |thing| thing.0), [(2, 'a')]);
        let many: Vec<u64> = (0..1000).map(|k| k % 100 * 8).collect();
        assert_eq!(distinct(&many, |k| k), many[..100]);
    }
}
