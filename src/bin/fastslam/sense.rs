//! What the rows of a landmark log say against each other: every number is possible, and yet something is wrong.

use crate::calibration::Sequence;
use crate::offsets;
use fastslam::motion::VelocityDiffusion;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Longest time for which one row of odometry of a moving robot may hold \[s\].
const LONGEST_ROW: f64 = 5.0;

/// Largest share of measurements that may be lost without a word.
const LOST: f64 = 0.05;

/// Largest share of the drive without a measurement that is not worth a word.
const SILENT: f64 = 0.25;

/// Largest share of measurements that may give the numbers of the one before them. A camera that is read faster than it takes pictures does so in one of fifty.
const REPEATED: f64 = 0.05;

/// Largest speed of a robot \[m/s\].
const FASTEST: f64 = 50.0;

/// Standard deviations of the sensor by which two measurements of one landmark from one place may differ: six of a difference.
const APART: f64 = 8.5;

/// Rows of odometry, time \[s\], v \[m/s\] and ω \[rad/s\], and the looks, against each other and the time \[s\] that can be used.
pub struct Drive<'a> {
    pub odometry: &'a [[f64; 3]],
    pub looks: &'a [(f64, Vec<Feature>)],
    /// First and last second.
    pub used: [f64; 2],
    pub sensor: &'a RangeBearing,
    /// Noise of the odometry, where it is one of velocities.
    pub motion: Option<&'a VelocityDiffusion>,
}

impl Drive<'_> {
    /// What is to be told, each with what to look at.
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = [self.of_rows(), Sequence::new(self.odometry, self.looks).remarks()].concat();
        // Where clocks, units or scales are wrong, offsets are not known.
        if let (Some(motion), true) = (self.motion, remarks.is_empty()) {
            remarks.extend(offsets::remarks(self.odometry, self.looks, motion, self.sensor));
        }
        remarks
    }

    /// What rows and looks contradict, whatever lies between two looks.
    fn of_rows(&self) -> Vec<String> {
        let of_looks = [self.lost(), self.silent(), self.impossible(), self.repeated()];
        let of_odometry = [self.units(), self.unmoved(), self.gap(), self.stuck()];
        of_looks.into_iter().chain(of_odometry).flatten().collect()
    }

    fn features(&self) -> impl Iterator<Item = (f64, &Feature)> {
        self.looks.iter().flat_map(|(time, features)| features.iter().map(|feature| (*time, feature)))
    }

    fn lost(&self) -> Option<String> {
        let [start, end] = self.used;
        let all = self.features().count();
        let lost = self.features().filter(|(time, _)| !(start..=end).contains(time)).count();
        (lost as f64 > LOST * all as f64).then(|| {
            format!(
                "{lost} of {all} measurements are not used: they lie outside the time of both odometry and ground truth, {start} to {end} s; compare \
                 the clocks"
            )
        })
    }

    /// The longest time without a measurement, at either end of the drive too.
    fn silent(&self) -> Option<String> {
        let [start, end] = self.used;
        let within = self.looks.iter().map(|(time, _)| *time).filter(|time| (start..=end).contains(time));
        let times: Vec<f64> = std::iter::once(start).chain(within).chain([end]).collect();
        let pairs = times.windows(2).map(|pair| [pair[0], pair[1]]);
        let [from, to] = pairs.max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
        (to - from > SILENT * (end - start)).then(|| {
            format!("nothing was measured from {from} to {to} s, a large part of the drive: the path of that time is raw odometry at best")
        })
    }

    /// Measurements that give the numbers of the one before them although the robot moved.
    fn repeated(&self) -> Option<String> {
        let mut last: BTreeMap<u32, (f64, &Feature)> = BTreeMap::new();
        let moves = |from: f64, to: f64| {
            let first = self.odometry.partition_point(|row| row[0] <= from).max(1) - 1;
            self.odometry[first..].iter().take_while(|row| row[0] < to).all(|row| !rests(row))
        };
        let (mut all, mut repeated) = (0, 0);
        for (time, feature) in self.features() {
            let Some(signature) = feature.signature else { continue };
            if let Some((before, same)) = last.insert(signature, (time, feature))
                && time - before < LONGEST_ROW
                && moves(before, time)
            {
                all += 1;
                repeated += u32::from(same.z == feature.z);
            }
        }
        (f64::from(repeated) > REPEATED * f64::from(all)).then(|| {
            format!("{repeated} measurements give the very numbers of the one before them while the robot moves: each counts as one of its own")
        })
    }

    fn impossible(&self) -> Option<String> {
        let ignored = self.features().filter(|(_, feature)| !self.sensor.can_measure(&feature.z)).count();
        (ignored > 0).then(|| format!("{ignored} measurements are ignored: a range must be above 0 m"))
    }

    fn units(&self) -> Option<String> {
        let most = |column: usize| self.odometry.iter().map(|row| row[column].abs()).fold(0.0, f64::max);
        let (speed, turn_rate) = (most(1), most(2));
        (speed > FASTEST || turn_rate > TAU)
            .then(|| format!("odometry reports up to {speed:.1} m/s and {turn_rate:.1} rad/s: check its units"))
    }

    fn unmoved(&self) -> Option<String> {
        self.odometry.iter().all(rests).then(|| {
            "odometry never moves: it says nothing of the motion, and the noises told of it do not hold".into()
        })
    }

    fn gap(&self) -> Option<String> {
        let [start, end] = self.used;
        let held = |pair: &[[f64; 3]]| {
            let [[time, ..], [next, ..]] = [pair[0], pair[1]];
            (next.min(end) - time.max(start), time)
        };
        let moving = self.odometry.windows(2).filter(|pair| !rests(&pair[0]));
        let (longest, time) = moving.map(held).max_by(|a, b| a.0.total_cmp(&b.0))?;
        (longest > LONGEST_ROW).then(|| {
            format!("odometry has no row for {longest:.0} s after {time} s: its last velocity is held as long, and the path may break there")
        })
    }

    /// The longest rest by odometry in which a landmark moves in view.
    fn stuck(&self) -> Option<String> {
        let stretches = self.odometry.chunk_by(|a, b| rests(a) == rests(b));
        let still = stretches.filter(|rows| rests(&rows[0]) && rows.len() < self.odometry.len());
        let times = still.map(|rows| [rows[0][0], rows[rows.len() - 1][0]]);
        let [from, to] =
            times.filter(|rest| self.moves_in_view(*rest)).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
        Some(format!(
            "odometry stands still from {from} to {to} s, while a landmark moves in view by more than the sensor's noise: was it stuck?"
        ))
    }

    fn moves_in_view(&self, [from, to]: [f64; 2]) -> bool {
        if to - from < LONGEST_ROW {
            return false;
        }
        let mut first: BTreeMap<u32, &Feature> = BTreeMap::new();
        let mut within = self.features().filter(|(time, _)| (from..=to).contains(time));
        within.any(|(_, feature)| {
            let Some(signature) = feature.signature else { return false };
            let off = self.sensor.residual(&feature.z, &first.entry(signature).or_insert(feature).z);
            off.x.abs() > APART * self.sensor.range_std || off.y.abs() > APART * self.sensor.bearing_std
        })
    }
}

/// Whether the robot stands still by a row of odometry.
fn rests(&[_, speed, turn_rate]: &[f64; 3]) -> bool {
    speed == 0.0 && turn_rate == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    const SENSOR: RangeBearing = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: TAU };

    /// A drive of 100 s, a row and a look each second, spoiled by these. What is seen does not follow from the motion: that is for `calibration`.
    fn said(spoil_row: impl Fn(&mut [f64; 3]) -> bool, spoil_look: impl Fn(&mut f64, &mut Feature)) -> Vec<String> {
        let mut odometry: Vec<[f64; 3]> = (0..=100).map(|k| [f64::from(k), 0.2, 0.1]).collect();
        odometry.retain_mut(spoil_row);
        let look = |k: u32| {
            let (mut time, angle) = (f64::from(k), 0.1 * f64::from(k % 10));
            let mut feature = Feature { z: Vector2::new(2.0 + angle, angle), signature: Some(k % 3) };
            spoil_look(&mut time, &mut feature);
            (time, vec![feature])
        };
        let looks: Vec<_> = (1..=100).map(look).collect();
        Drive { odometry: &odometry, looks: &looks, used: [odometry[0][0], 100.0], sensor: &SENSOR, motion: None }
            .of_rows()
    }

    #[test]
    fn of_a_sound_log_nothing_is_told() {
        assert!(said(|_| true, |_, _| ()).is_empty());
        // Some are lost at its end, and the robot rests while nothing moves.
        assert!(said(|_| true, |time, _| *time += 5.0).is_empty());
        let rests = |row: &mut [f64; 3]| {
            if (20.0..80.0).contains(&row[0]) {
                *row = [row[0], 0.0, 0.0];
            }
            true
        };
        let same_at_rest = |time: &mut f64, feature: &mut Feature| {
            if (20.0..80.0).contains(time) {
                feature.z = Vector2::new(2.0, 0.3);
            }
        };
        assert!(said(rests, same_at_rest).is_empty());
    }

    #[test]
    fn each_kind_of_contradiction_is_told() {
        let still = |row: &mut [f64; 3], from: f64, to: f64| {
            if (from..to).contains(&row[0]) {
                *row = [row[0], 0.0, 0.0];
            }
            true
        };
        for (said, part) in [
            (said(|_| true, |time, _| *time += 20.0), "20 of 100 measurements are not used"),
            (said(|row| row[0] > 50.0, |_, _| ()), "50 of 100 measurements are not used"),
            (said(|_| true, |_, feature| feature.z = Vector2::new(2.0, 0.3)), "measurements give the very numbers"),
            (said(|_| true, |time, _| *time *= 0.6), "nothing was measured from 60 to 100 s"),
            (said(|_| true, |_, feature| feature.z.x = -2.0), "100 measurements are ignored: a range must be above 0"),
            (
                said(
                    |row| {
                        row[1] *= 1000.0;
                        true
                    },
                    |_, _| (),
                ),
                "up to 200.0 m/s",
            ),
            (
                said(
                    |row| {
                        row[2] = row[2].to_degrees() * 2.0;
                        true
                    },
                    |_, _| (),
                ),
                "11.5 rad/s: check its units",
            ),
            (said(|row| still(row, 0.0, 200.0), |_, _| ()), "odometry never moves"),
            (said(|row| !(30.0..50.0).contains(&row[0]), |_, _| ()), "no row for 21 s after 29 s"),
            (said(|row| still(row, 20.0, 60.0), |_, _| ()), "stands still from 20 to 59 s"),
        ] {
            assert!(said.len() == 1 && said[0].contains(part), "{part}: {said:?}");
        }
    }
}
