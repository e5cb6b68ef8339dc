//! Ranges whose unit changes while a log is recorded: parts of it were made by two drivers, or by one that was set anew.

use super::LaserLog;
use crate::ascending::ascending;
use fastslam::ops;

/// Where ranges are in another unit from one scan on.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UnitChange {
    /// Stamp of the first scan in that unit \[s\].
    pub time: f64,
    /// How many times as long a range is as before: 100 or 1000, or the inverse.
    pub times: f64,
}

/// Centimetres and millimetres in a metre.
const UNITS: [f64; 2] = [100.0, 1000.0];

/// The quartiles of two scans that follow one another differ by no more than this factor, whatever way the robot goes in between.
const ALIKE: f64 = 3.0;

/// Fewer readings tell no quartiles, and nor do those that are all the same: they met nothing.
const ENOUGH: usize = 12;
const SPREAD: f64 = 1.05;

impl LaserLog {
    /// Brings all ranges to one unit, the longest of those that they are in, and tells where it changes: where all three quartiles of a scan's readings are
    /// 100 or 1000 times those of the scan before, or that part of them, within a factor of 3.
    pub fn bring_to_one_unit(&mut self) -> Vec<UnitChange> {
        let (mut changes, mut before) = (Vec::new(), None);
        // How many of its units a metre of the first scan is, for each scan.
        let mut units = Vec::with_capacity(self.scans.len());
        let mut unit = 1.0;
        for scan in &self.scans {
            let now = quartiles(&scan.ranges);
            if let Some((before, now)) = before.zip(now)
                && let Some(times) = changed(&before, &now)
            {
                unit *= times;
                changes.push(UnitChange { time: scan.time, times });
            }
            before = now.or(before);
            units.push(unit);
        }
        let longest = units.iter().copied().fold(f64::INFINITY, f64::min);
        for (scan, unit) in self.scans.iter_mut().zip(units) {
            if unit > longest {
                let times = longest / unit;
                scan.ranges.iter_mut().for_each(|range| *range = (f64::from(*range) * times) as f32);
            }
        }
        changes
    }
}

/// The quartiles of the readings of a scan.
fn quartiles(ranges: &[f32]) -> Option<[f64; 3]> {
    let readings: Vec<f32> = ranges.iter().copied().filter(|range| range.is_finite() && *range > 0.0).collect();
    let readings = ascending(readings);
    let quartiles = (readings.len() >= ENOUGH).then(|| [1, 2, 3].map(|k| f64::from(readings[k * readings.len() / 4])));
    quartiles.filter(|[first, _, third]| *third > SPREAD * first)
}

/// By how much the unit changed between two scans of these quartiles.
fn changed(before: &[f64; 3], now: &[f64; 3]) -> Option<f64> {
    let near = |times: &f64| {
        let ratios = before.iter().zip(now).map(|(before, now)| now / before / times);
        ratios.fold(0.0, |off, ratio| f64::max(off, ops::ln(ratio).abs())) < ops::ln(ALIKE)
    };
    UNITS.into_iter().flat_map(|unit| [unit, 1.0 / unit]).find(near)
}
