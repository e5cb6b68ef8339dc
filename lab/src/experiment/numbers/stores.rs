//! What a first write to a copied map of landmarks copies: a vector all of it, a tree one path.

use super::{Group, Number, Recipe};
use fastslam::map::landmarks::{Balanced, Blocks, Landmark, Store};
use fastslam::nalgebra::{Matrix2, Vector2};

/// Maps up to this size are tried.
const LARGEST: u32 = 1000;

/// All recipes of the stores.
pub fn recipes() -> Vec<Recipe> {
    vec![Recipe::fixed("stores", |group| {
        vec![crossing::<Balanced>(group, "binary tree"), crossing::<Blocks>(group, "blocked tree, eight wide,")]
    })]
}

/// The size of map from which on a tree copies less than a vector.
fn crossing<S: Store>(group: &Group, tree: &str) -> Number {
    let copies_more = |n: &u32| copied::<S>(*n) >= copied::<Vec<Option<Landmark>>>(*n);
    let last = (1..=LARGEST).rfind(copies_more).unwrap_or_default();
    let key = format!("{}.copies_less", tree.split(' ').next().unwrap_or_default());
    let made = format!(
        "Smallest number of landmarks from which on, up to {LARGEST}, a first write after a copy copies fewer bytes in a \
         {tree} than in a vector, counted by their footprints"
    );
    group.number(&key, f64::from(last + 1), "", made)
}

/// Bytes that two maps of this many landmarks hold more than one, once one is a copy of the other and has written to one landmark.
fn copied<S: Store>(landmarks: u32) -> u64 {
    let landmark = Landmark { mean: Vector2::zeros(), covariance: Matrix2::identity(), existence_count: 1, apart: 0 };
    let mut map = S::default();
    for index in 0..landmarks {
        *map.entry(index) = Some(landmark);
    }
    let mut copy = map.clone();
    *copy.entry(landmarks / 2) = Some(landmark);
    S::footprint([&map, &copy].into_iter()).unique - S::footprint([&map].into_iter()).unique
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tree_copies_one_path_and_a_vector_everything() {
        // The formulas of the exercise, for 24 landmarks.
        assert_eq!(copied::<Vec<Option<Landmark>>>(24), 64 * 24);
        assert_eq!(copied::<Balanced>(24), 128 + 32 * 4);
        assert_eq!(copied::<Blocks>(24), 512 + 128);
        let crossings: Vec<f64> = recipes()[0]
            .make(0, &fastslam::execute::Executor::Serial, &Default::default(), &|| ())
            .numbers
            .iter()
            .map(|number| number.value)
            .collect();
        assert_eq!(crossings, [3.0, 11.0]);
    }
}
