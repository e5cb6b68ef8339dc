//! What a run leaves to go back to: the best map and all paths as they were after a scan, for as many scans as fit.

use fastslam::{
    genealogy::Path,
    mapper::{Map, Replay},
};
use fastslam_log::LaserLog;

/// Most scans that are kept: as many places as a slider has.
const MOST: usize = 300;

/// Most memory that the kept maps may take together \[bytes\].
const LIMIT: u64 = 200_000_000;

/// Steps between two looks at that memory.
const LOOK: u32 = 32;

/// The universes that one resampling let die out. The filter does not keep them: this does.
#[derive(Clone, Debug)]
pub struct Death {
    /// The step.
    pub step: u32,
    /// Their paths.
    pub paths: Vec<Path>,
}

/// What is drawn of a population. It takes little: a map shares all tiles with the map before but those that the scans in between have
/// touched, and a path shares its past.
#[derive(Clone)]
pub struct Seen {
    /// After this step.
    pub step: u32,
    /// Scans of the log up to here.
    pub scans: usize,
    /// The best universe's map.
    pub map: Map,
    /// Of all universes, by slot.
    pub paths: Vec<Path>,
    /// The slot of the best.
    pub best: usize,
    /// What had died out a short while before.
    pub deaths: Vec<Death>,
}

impl Seen {
    /// The population as it is now.
    pub fn now(replay: &Replay<LaserLog>, deaths: &[Death]) -> Self {
        let (mapper, filter) = (replay.mapper(), replay.mapper().filter());
        let paths = filter.particles().iter().map(|particle| particle.path.clone()).collect();
        let (step, scans, best) = (mapper.steps(), replay.scans(), filter.best());
        Self { step, scans, map: mapper.map().clone(), paths, best, deaths: deaths.to_vec() }
    }
}

/// The newest population, and earlier ones at even distances: they are thinned out where they are too many, or take too much memory.
#[derive(Default)]
pub struct Kept {
    /// By step, the first being 0.
    seen: Vec<Seen>,
    /// How often the distance of two was doubled.
    thinned: u32,
}

impl Kept {
    /// The population after the next step.
    pub fn push(&mut self, seen: Seen) {
        self.push_within(LIMIT, seen);
    }

    fn push_within(&mut self, limit: u64, seen: Seen) {
        let (step, stays) = (seen.step, |step: u32, thinned| step.is_multiple_of(1u32 << thinned));
        self.seen.retain(|kept| stays(kept.step, self.thinned));
        self.seen.push(seen);
        while self.seen.len() > MOST || (step.is_multiple_of(LOOK) && self.bytes() > limit && self.seen.len() > 2) {
            self.thinned += 1;
            self.seen.retain(|kept| kept.step == step || stays(kept.step, self.thinned));
        }
    }

    fn bytes(&self) -> u64 {
        Map::footprint(self.seen.iter().map(|seen| &seen.map)).unique
    }

    /// The newest.
    pub fn newest(&self) -> Option<&Seen> {
        self.seen.last()
    }

    /// The one after this step, or the last before it.
    pub fn at(&self, step: u32) -> Option<&Seen> {
        self.seen.iter().rev().find(|seen| seen.step <= step)
    }

    /// On the way from one step to another, the first that is kept there or beyond.
    pub fn towards(&self, step: u32, from: u32) -> u32 {
        let beyond = self.seen.iter().find(|seen| seen.step >= step);
        let kept = if step > from { beyond } else { self.at(step) };
        kept.map_or(0, |seen| seen.step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::mapper::LaserMapperSettings;
    use fastslam_log::parse;
    use std::sync::Arc;

    fn after(step: u32) -> Seen {
        let map = Map::new(LaserMapperSettings { cell_size: 0.1, ..LaserMapperSettings::default() }.grid());
        Seen { step, scans: step as usize, map, paths: Vec::new(), best: 0, deaths: Vec::new() }
    }

    fn kept(steps: u32) -> Kept {
        let mut kept = Kept::default();
        (0..=steps).for_each(|step| kept.push(after(step)));
        kept
    }

    fn steps(kept: &Kept) -> Vec<u32> {
        kept.seen.iter().map(|seen| seen.step).collect()
    }

    #[test]
    fn every_step_is_kept_while_they_are_few_and_later_some_at_even_distances_and_the_newest() {
        assert_eq!(steps(&kept(299)), (0..300).collect::<Vec<_>>());
        let some = steps(&kept(301));
        assert_eq!((some.len(), &some[..3], &some[150..]), (152, &[0, 2, 4][..], &[300, 301][..]));
        for count in [1000, 4097, 10_001] {
            let some = steps(&kept(count));
            assert!((150..=300).contains(&some.len()), "{} of {count}", some.len());
            let apart = some[1];
            assert!(some[..some.len() - 1].iter().zip(0..).all(|(step, k)| *step == k * apart), "{some:?}");
            assert_eq!(some.last(), Some(&count));
        }
    }

    #[test]
    fn maps_are_kept_as_long_as_they_take_little_memory_together() {
        let log = parse(include_bytes!("../../../tests/figures/golden/tiny.clf"), false).unwrap();
        let mut replay = Replay::new(LaserMapperSettings::default(), Arc::new(log)).unwrap();
        let [mut all, mut some] = [Kept::default(), Kept::default()];
        const FEW: u64 = 1_500_000;
        while replay.next().is_some() {
            all.push(Seen::now(&replay, &[]));
            some.push_within(FEW, Seen::now(&replay, &[]));
        }
        assert_eq!(all.seen.len(), 90);
        assert!(all.bytes() > 2 * FEW, "or there is nothing to thin out: {}", all.bytes());
        assert!((9..80).contains(&some.seen.len()), "{}", some.seen.len());
        assert!(some.bytes() < FEW + FEW / 2, "it is looked at every {LOOK} steps: {}", some.bytes());
    }

    #[test]
    fn a_step_that_is_not_kept_is_met_by_going_on_and_the_first_by_going_back() {
        let kept = kept(1001);
        let apart = steps(&kept)[1];
        assert!(apart > 1);
        assert_eq!((kept.towards(apart + 1, apart), kept.towards(apart - 1, apart)), (2 * apart, 0));
        assert_eq!((kept.towards(1001, 7), kept.towards(5000, 7), kept.towards(0, 7)), (1001, 0, 0));
        assert_eq!(kept.at(apart + 1).map(|seen| seen.step), Some(apart));
    }
}
