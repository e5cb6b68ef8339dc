//! Sorting: one sort of indices for all kinds of things, as each that is compiled weighs kilobytes in a browser.

use core::cmp::Ordering;

/// These things in the order that a comparison gives them, equals as they stand.
pub fn sorted<T>(things: Vec<T>, compare: impl Fn(&T, &T) -> Ordering) -> Vec<T> {
    let order = indices(things.len(), &|a, b| compare(&things[a], &things[b]));
    let mut things: Vec<Option<T>> = things.into_iter().map(Some).collect();
    order.into_iter().filter_map(|k| things[k].take()).collect()
}

/// Each of these things once, by a key that tells them apart, in the order of keys.
pub(crate) fn distinct<T: Copy>(things: &[T], key: impl Fn(T) -> u64) -> Vec<T> {
    let keys: Vec<u64> = things.iter().map(|thing| key(*thing)).collect();
    let mut order = indices(keys.len(), &|a, b| keys[a].cmp(&keys[b]));
    order.dedup_by_key(|k| keys[*k]);
    order.into_iter().map(|k| things[k]).collect()
}

/// The indices of so many things in their order.
fn indices(count: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| compare(*a, *b));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_stay_as_they_stand() {
        let by_first = |a: &(i32, char), b: &(i32, char)| a.0.cmp(&b.0);
        let things = vec![(2, 'a'), (1, 'b'), (2, 'c'), (0, 'd'), (1, 'e')];
        assert_eq!(sorted(things, by_first), [(0, 'd'), (1, 'b'), (1, 'e'), (2, 'a'), (2, 'c')]);
        assert_eq!(sorted(Vec::new(), by_first), []);
    }

    #[test]
    fn what_has_one_key_is_there_once() {
        let things = [(2, 'a'), (1, 'b'), (2, 'c'), (0, 'd'), (1, 'e')];
        assert_eq!(distinct(&things, |thing| thing.0), [(0, 'd'), (1, 'b'), (2, 'a')]);
        assert_eq!(distinct(&[], |thing: (u64, char)| thing.0), []);
    }
}
