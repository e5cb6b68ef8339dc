//! The scans that are kept: what a path that is bent is mapped again by, and what the robot saw on the last metres.

use super::{CLOSING, Closings};
use crate::geometry::Pose2;
use crate::ops;
use crate::order::sorted;
use crate::sensor::Scan;
use std::sync::Arc;

/// Which scans are kept: all of the last metres, and of those before them every 2ⁿ-th, with n as small as the bound allows.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Keeping {
    /// n.
    pub(super) halvings: u32,
    /// How many are kept.
    pub(super) kept: usize,
    /// The scans before this step are not of the last metres.
    pub(super) past: usize,
}

/// A scan that the filter took.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct View {
    /// Metres driven up to here, by odometry.
    pub(super) way: f64,
    /// Distance within which nine of ten beams end that met something \[m\].
    pub(super) reach: f64,
    /// `None` of one that is not kept.
    #[cfg_attr(feature = "serde", serde(with = "shared"))]
    pub(super) scan: Option<Arc<KeptScan>>,
    /// Whether the maps before it were marked.
    pub(super) marked: bool,
    /// Standard deviations of position and heading \[m, rad\] that steps from the last view to it add, where they were doubted or nothing was seen; 0 else.
    pub(super) doubt: [f64; 2],
}

/// A scan, in single precision: it is kept as long as the mapper is.
#[derive(Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct KeptScan {
    pub(super) origin: [f32; 2],
    pub(super) hits: Box<[[f32; 2]]>,
    pub(super) misses: Box<[[f32; 2]]>,
}

impl KeptScan {
    fn new(scan: &Scan) -> Self {
        let single = |point: &[f64; 2]| point.map(|c| c as f32);
        let keep = |ends: &[[f64; 2]]| ends.iter().map(single).collect();
        Self { origin: single(&scan.origin), hits: keep(&scan.hits), misses: keep(&scan.misses) }
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&*self.hits) + size_of_val(&*self.misses)
    }

    pub(super) fn scan(&self) -> Scan {
        let ends = |kept: &[[f32; 2]]| kept.iter().map(|end| end.map(f64::from)).collect();
        Scan { origin: self.origin.map(f64::from), hits: ends(&self.hits), misses: ends(&self.misses) }
    }
}

impl Closings {
    /// A scan that the filter took after so many metres, where at most so many are kept.
    pub(in crate::mapper) fn take(&mut self, scan: &Scan, driven: f64, most: usize) {
        let way = self.views.last().map_or(0.0, |last| last.way) + driven;
        let [x0, y0] = scan.origin;
        let distances = scan.hits.iter().map(|[x, y]| ops::hypot(x - x0, y - y0)).collect();
        let distances = sorted(distances, f64::total_cmp);
        let reach = distances.get(distances.len() * 9 / 10).copied().unwrap_or(0.0);
        let marked = core::mem::take(&mut self.marked);
        let doubt = core::mem::take(&mut self.doubt);
        self.views.push(View { way, reach, scan: Some(KeptScan::new(scan).into()), marked, doubt });
        self.keep(most);
    }

    /// Lets go of scans, so that at most so many are kept: not of the first, and of the last metres of no more than half of the bound allows.
    fn keep(&mut self, most: usize) {
        let now = self.views.len() - 1;
        self.keeping.kept += 1;
        while self.way(self.keeping.past, now) >= CLOSING.window || now - self.keeping.past >= most / 2 {
            self.let_go(self.keeping.past);
            self.keeping.past += 1;
        }
        while self.keeping.kept > most {
            self.keeping.halvings += 1;
            (0..self.keeping.past).for_each(|step| self.let_go(step));
        }
    }

    /// Lets go of the scan of a step, if it is not the 2ⁿ-th.
    fn let_go(&mut self, step: usize) {
        if !step.is_multiple_of(1 << self.keeping.halvings) && self.views[step].scan.take().is_some() {
            self.keeping.kept -= 1;
        }
    }

    /// How many of the scans that the filter took are kept, how many it took, and the bytes of those that are kept.
    pub(in crate::mapper) fn kept_scans(&self) -> [usize; 3] {
        let bytes = self.views.iter().flat_map(|view| &view.scan).map(|scan| scan.bytes()).sum::<usize>();
        [self.keeping.kept, self.views.len(), bytes + size_of_val(&self.views[..])]
    }

    /// Whether no more than one scan in twenty met anything.
    pub(in crate::mapper) fn met_nothing(&self) -> bool {
        20 * self.views.iter().filter(|view| view.reach > 0.0).count() <= self.views.len()
    }

    /// Steps of the last metres, the newest first.
    pub(super) fn last_steps(&self, now: usize) -> impl Iterator<Item = usize> {
        (0..=now).rev().take_while(move |step| self.way(*step, now) < CLOSING.window)
    }

    /// Metres driven between two steps.
    pub(super) fn way(&self, from: usize, to: usize) -> f64 {
        self.views[to].way - self.views[from].way
    }

    /// The end points of the last metres in the robot's frame, evenly picked. They were seen from many places: no one origin is theirs.
    pub(super) fn picture(&self, poses: &[Pose2]) -> Scan {
        let now = poses.len() - 1;
        let scans = || self.last_steps(now).filter_map(|step| Some((step, self.views[step].scan.as_ref()?)));
        let count: usize = scans().map(|(_, scan)| scan.hits.len()).sum();
        let ends = scans().flat_map(|(step, scan)| {
            let seen = poses[now].between(&poses[step]);
            scan.hits.iter().map(move |end| (seen, end))
        });
        let picked = ends.step_by(count.div_ceil(CLOSING.picture).max(1));
        Scan { hits: picked.map(|(seen, end)| seen.transform(end.map(f64::from))).collect(), ..Scan::default() }
    }
}

/// What is behind an [`Arc`] of its own, if it is there.
#[cfg(feature = "serde")]
mod shared {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::sync::Arc;

    pub fn serialize<T: Serialize, S: Serializer>(shared: &Option<Arc<T>>, serializer: S) -> Result<S::Ok, S::Error> {
        shared.as_deref().serialize(serializer)
    }

    pub fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Arc<T>>, D::Error> {
        Ok(Option::deserialize(deserializer)?.map(Arc::new))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scan_is_kept_to_less_than_a_millionth_of_its_range() {
        let scan = Scan { origin: [0.6, -0.4], hits: vec![[12.345_678_9, -0.1]], misses: vec![[29.999_999_9, 3.3]] };
        let kept = KeptScan::new(&scan).scan();
        let points = |scan: &Scan| [&[scan.origin][..], &scan.hits, &scan.misses].concat();
        for (kept, given) in points(&kept).iter().zip(&points(&scan)) {
            assert!((0..2).all(|k| (kept[k] - given[k]).abs() <= 1e-7 * given[k].abs()), "{kept:?} {given:?}");
        }
    }
}
