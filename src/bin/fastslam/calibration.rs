//! What successive measurements of a landmark say of the motion between them, against odometry: no filter and no map is asked.
//!
//! Between two looks a landmark turns in view by what the robot turned, and comes nearer by what the robot drove towards it. Where it does so all along
//! by another measure than that of odometry, one of both is wrong: a clock, a scale, or how the sensor is mounted. A filter takes such errors for noise.

mod fit;

use fastslam::geometry::Pose2;
use fastslam::motion::Velocity;
use fastslam::ops;
use fastslam::sensor::Feature;
use fit::{FEWEST, Fit, Sample};
use nalgebra::Vector2;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Most pairs of measurements that are compared at each delay.
const MOST: usize = 2000;

/// Longest time between two measurements that are compared for a turn \[s\]. A robot steers against its own errors, so that over a longer time what odometry reports
/// is no longer independent of them.
const SHORT: f64 = 2.0;

/// Longest time \[s\] and shortest way \[m\] between two measurements that are compared for a range.
const LONG: f64 = 20.0;
const WAY: f64 = 0.05;

/// Most measurements of a landmark by which two that are compared for a turn or a range lie apart.
const BACK: usize = 8;

/// Largest turn between two measurements that are compared \[rad\].
const TURN: f64 = 1.0;

/// Delays that are tried: so many to each side, of this length \[s\].
const DELAYS: i32 = 100;
const DELAY: f64 = 0.1;

/// Shortest delay that is worth a word, in those. A camera takes a fifth of a second.
const LEAST_DELAY: i32 = 3;

/// How many times larger the mean squared error is without the delay than with it, at least.
const BETTER: f64 = 1.4;

/// An error of a bearing of more is an outlier, and counts as this \[rad\].
const OUTLIER: f64 = 0.2;

/// Relative errors of ranges and of turns, errors of a bearing \[rad\] and of a turn rate \[rad/s\] that are not worth a word. Turns of a sound robot are
/// reported a tenth too large.
const RANGE_SCALE: f64 = 0.1;
const TURN_SCALE: f64 = 0.15;
const BEARING: f64 = 0.07;
const TURN_RATE: f64 = 0.008;

/// A robot's path by odometry, and what it saw on the way.
pub struct Sequence<'a> {
    odometry: &'a [[f64; 3]],
    poses: Vec<Pose2>,
    looks: &'a [(f64, Vec<Feature>)],
}

/// A later measurement z of a landmark, and one before it, each with its time \[s\].
type Pair = [(f64, Vector2<f64>); 2];

impl<'a> Sequence<'a> {
    /// Rows of odometry are time \[s\], v \[m/s\] and ω \[rad/s\]; each velocity holds until the next row.
    pub fn new(odometry: &'a [[f64; 3]], looks: &'a [(f64, Vec<Feature>)]) -> Self {
        let mut poses = vec![Pose2::default()];
        for pair in odometry.windows(2) {
            poses.push(held(&pair[0], pair[1][0]).apply(&poses[poses.len() - 1]));
        }
        Self { odometry, poses, looks }
    }

    /// What is to be told.
    pub fn remarks(&self) -> Vec<String> {
        let pairs = self.pairs(1, SHORT);
        let delay = self.delay(&pairs);
        let late = f64::from(delay.unwrap_or_default()) * DELAY;
        let told = delay.filter(|steps| steps.abs() >= LEAST_DELAY).map(|_| {
            let order = if late > 0.0 { "after" } else { "before" };
            format!(
                "landmarks turn in view {:.1} s {order} the robot does by its odometry: put the clocks right",
                late.abs()
            )
        });
        // Successive measurements turn little, so that errors of odometry dilute the regression: pairs further apart, within the same time, turn more.
        let turns = self.of_turns(&self.pairs(BACK, SHORT), late);
        let ranges = self.of_ranges(late, turns.is_none());
        [told, turns, ranges].into_iter().flatten().collect()
    }

    /// Measurements of one landmark with those before them.
    fn pairs(&self, back: usize, longest: f64) -> Vec<Pair> {
        let mut before: BTreeMap<u32, Vec<(f64, Vector2<f64>)>> = BTreeMap::new();
        let mut pairs = Vec::new();
        for (time, features) in self.looks {
            for Feature { z, signature } in features {
                let Some(signature) = signature else { continue };
                let known = before.entry(*signature).or_default();
                let recent = known[known.len().saturating_sub(back)..].iter();
                pairs.extend(
                    recent
                        .filter(|first| *time > first.0 && time - first.0 < longest)
                        .map(|first| [*first, (*time, *z)]),
                );
                known.push((*time, *z));
            }
        }
        pairs
    }

    /// The pose by odometry, while there is odometry.
    fn at(&self, time: f64) -> Option<Pose2> {
        let after = self.odometry.partition_point(|row| row[0] <= time);
        (1..self.odometry.len())
            .contains(&after)
            .then(|| held(&self.odometry[after - 1], time).apply(&self.poses[after - 1]))
    }

    /// The motion by odometry between two measurements that come late by so much.
    fn motion(&self, [(first, _), (second, _)]: &Pair, late: f64) -> Option<Pose2> {
        Some(self.at(first - late)?.between(&self.at(second - late)?))
    }

    /// How much the robot turned \[rad\] as a landmark turned in view, by the way that odometry tells, and by odometry.
    fn turns(&self, pair: &Pair, late: f64) -> Option<[f64; 2]> {
        let motion = self.motion(pair, late)?;
        let [(_, first), (_, second)] = pair;
        let to = seen_from(first, &motion);
        Some([motion.theta + ops::wrap_angle(ops::atan2(to.y, to.x) - second.y), motion.theta])
    }

    /// By how many steps of time measurements come late after odometry, where that explains their bearings better than no delay.
    fn delay(&self, pairs: &[Pair]) -> Option<i32> {
        let every = pairs.len().div_ceil(MOST).max(1);
        let error = |steps: i32| {
            let turns = pairs.iter().step_by(every).filter_map(|pair| self.turns(pair, f64::from(steps) * DELAY));
            let (sum, count) = turns.fold((0.0, 0_usize), |(sum, count), [seen, turned]| {
                let off = (seen - turned).abs().min(OUTLIER);
                (sum + off * off, count + 1)
            });
            (count >= FEWEST && 2 * every * count > pairs.len()).then(|| sum / count as f64)
        };
        let without = error(0)?;
        let errors = (-DELAYS..=DELAYS).filter_map(|steps| Some((steps, error(steps)?)));
        let (steps, least) = errors.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (without > BETTER * least).then_some(steps)
    }

    fn of_turns(&self, pairs: &[Pair], late: f64) -> Option<String> {
        let turns = |pair: &Pair| Some((pair[1].0, self.turns(pair, late)?, pair[1].0 - pair[0].0));
        let turns: Vec<(f64, [f64; 2], f64)> = pairs.iter().filter_map(turns).collect();
        let fit = |cause: usize| {
            let sample = |&(time, turn, elapsed): &(f64, [f64; 2], f64)| Sample {
                time,
                causes: Vector2::new(turn[cause], elapsed),
                effect: turn[1 - cause],
            };
            Fit::of(turns.iter().map(sample).collect())
        };
        let (of_told, of_seen) = (fit(1)?, fit(0)?);
        let ([scale, rate], [told, besides]) = (of_told.value.into(), of_seen.value.into());
        // Noise of odometry makes the first scale too small, noise of bearings the inverse of the other one too large: what is wrong is off in both, to the same side.
        let both = |cause, expected, by| of_told.is_off(cause, expected, by) && of_seen.is_off(cause, expected, 0.0);
        let is_scaled = both(0, 1.0, TURN_SCALE) && (scale < 1.0) == (1.0 / told < 1.0);
        (is_scaled || both(1, 0.0, TURN_RATE) && (rate < 0.0) == (besides > 0.0)).then(|| {
            format!(
                "landmarks turn in view by {scale:.2} of what the robot turns by its odometry, and by {:+.2} °/s besides: check the scale of turns; what errs \
                 all along can be learnt (--drift learnt)",
                rate.to_degrees()
            )
        })
    }

    /// Where turns are not right, ranges say nothing of bearings.
    fn of_ranges(&self, late: f64, turns_right: bool) -> Option<String> {
        let sample = |pair: &Pair| {
            let motion = self.motion(pair, late)?;
            let [(_, first), (time, second)] = pair;
            let far = motion.x * motion.x + motion.y * motion.y > WAY * WAY && motion.theta.abs() < TURN;
            let to = seen_from(first, &motion);
            let range = to.norm();
            if !far || range <= 0.0 || first.x <= 0.0 || second.x <= 0.0 {
                return None;
            }
            // How the range would change if the bearing of the first was too large.
            let aside = Vector2::new(first.x * ops::sin(first.y), -first.x * ops::cos(first.y));
            let turned = Pose2::new(0.0, 0.0, motion.theta);
            let along = rotated(&to, &turned);
            Some(Sample {
                time: *time,
                causes: Vector2::new(first.x - range, -along.dot(&aside) / range),
                effect: first.x - second.x,
            })
        };
        let fit = Fit::of(self.pairs(BACK, LONG).iter().filter_map(sample).collect())?;
        let [scale, bearing] = fit.value.into();
        if fit.is_off(0, 1.0, RANGE_SCALE) {
            return Some(format!(
                "ranges change by {scale:.2} of the way that the robot drives towards landmarks by its odometry: check the scales and units of ranges and speeds"
            ));
        }
        (turns_right && fit.is_off(1, 0.0, BEARING)).then(|| {
            format!(
                "ranges change as if bearings were {:+.0}° too far to the left: check how the sensor is mounted, and the signs of bearings and turns",
                bearing.clamp(-FRAC_PI_2, FRAC_PI_2).to_degrees()
            )
        })
    }
}

/// What a row of odometry says of the time until then.
fn held(&[time, speed, turn_rate]: &[f64; 3], until: f64) -> Velocity {
    Velocity { speed, turn_rate, duration: until - time }
}

/// Where what is measured from one place lies as seen after a motion.
fn seen_from(z: &Vector2<f64>, motion: &Pose2) -> Vector2<f64> {
    let (sin, cos) = ops::sin_cos(z.y);
    let at = motion.between(&Pose2::default()).compose(&Pose2::new(z.x * cos, z.x * sin, 0.0));
    Vector2::new(at.x, at.y)
}

/// A vector, turned.
fn rotated(v: &Vector2<f64>, by: &Pose2) -> Vector2<f64> {
    let to = by.compose(&Pose2::new(v.x, v.y, 0.0));
    Vector2::new(to.x, to.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::random::{Purpose, Stream};

    /// A robot that drives about among eight landmarks for ten minutes, as it truly moves and sees, with noise of 2 cm and 0.01 rad; spoiled by these.
    fn said(spoil_row: impl Fn(&mut [f64; 3]), spoil_look: impl Fn(&mut f64, &mut Feature)) -> Vec<String> {
        let mut odometry = Vec::new();
        let mut looks = Vec::new();
        let mut pose = Pose2::default();
        for k in 0..3000_u32 {
            let time = 0.2 * f64::from(k);
            let mut row = [time, 0.3, if k / 25 % 2 == 0 { 0.3 * f64::from(k / 25 % 5) - 0.4 } else { 0.1 }];
            let mut features = Vec::new();
            for name in 0..8_u32 {
                let angle = 0.785 * f64::from(name);
                let (dx, dy) = (6.0 * ops::cos(angle) - pose.x, 6.0 * ops::sin(angle) - pose.y);
                let [a, b] = Stream::at(1, Purpose::TRIAL, k, name).normals();
                let bearing = ops::wrap_angle(ops::atan2(dy, dx) - pose.theta + 0.01 * b);
                let mut at = time;
                let mut feature =
                    Feature { z: Vector2::new(ops::hypot(dx, dy) + 0.02 * a, bearing), signature: Some(name) };
                spoil_look(&mut at, &mut feature);
                if k % 2 == 0 {
                    features.push((at, feature));
                }
            }
            if let Some((at, _)) = features.first() {
                looks.push((*at, features.iter().map(|(_, feature)| *feature).collect()));
            }
            pose = held(&row, time + 0.2).apply(&pose);
            spoil_row(&mut row);
            odometry.push(row);
        }
        Sequence::new(&odometry, &looks).remarks()
    }

    #[test]
    fn of_a_sound_robot_nothing_is_told() {
        assert_eq!(said(|_| (), |_, _| ()), [""; 0]);
        // Nor of one whose errors are worth no word.
        assert_eq!(said(|row| row[1] *= 1.05, |time, _| *time += 0.2), [""; 0]);
    }

    #[test]
    fn what_is_off_all_along_is_told_by_how_much() {
        for (said, part) in [
            (said(|_| (), |_, feature| feature.z.x *= 1.2), "ranges change by 1.20 of the way"),
            (said(|row| row[1] *= 1.25, |_, _| ()), "ranges change by 0.80 of the way"),
            (said(|_| (), |_, feature| feature.z.y += 0.175), "bearings were +10° too far to the left"),
            (said(|row| row[2] *= 0.8, |_, _| ()), "landmarks turn in view by 1.25 of what"),
            (said(|row| row[2] *= -1.0, |_, _| ()), "landmarks turn in view by -1.00 of what"),
            (said(|row| row[2] += 0.0175, |_, _| ()), "and by -1.00 °/s besides"),
            (said(|_| (), |time, _| *time += 1.0), "landmarks turn in view 1.0 s after the robot does"),
            (said(|_| (), |time, _| *time -= 1.0), "landmarks turn in view 1.0 s before the robot does"),
        ] {
            assert!(said.len() == 1 && said[0].contains(part), "{part}: {said:?}");
        }
    }

    /// Noise of 0.15 rad/s in each row hides the scale of turns from one measurement to the next.
    #[test]
    fn the_scale_of_turns_is_found_in_noisy_odometry() {
        let noisy = |scale: f64, std: f64| {
            move |row: &mut [f64; 3]| {
                let [noise, _] = Stream::at(2, Purpose::TRIAL, (5.0 * row[0]).round() as u32, 8).normals();
                row[2] = scale * row[2] + std * noise;
            }
        };
        assert_eq!(said(noisy(1.0, 0.15), |_, _| ()), [""; 0]);
        // What a noisy gyro adds is part of no turn. With 0.4 rad/s, landmarks seem to turn by 0.76 of what it reports, and by 2 °/s besides.
        assert_eq!(said(noisy(1.0, 0.4), |_, _| ()), [""; 0]);
        let scaled = said(noisy(0.8, 0.15), |_, _| ());
        assert!(scaled.len() == 1 && scaled[0].contains("landmarks turn in view by 1."), "{scaled:?}");
    }

    /// By names that mean nothing, or in too few measurements, nothing is found.
    #[test]
    fn without_names_nothing_is_told() {
        assert_eq!(said(|_| (), |_, feature| (feature.z.x *= 1.2, feature.signature = None).1), [""; 0]);
    }
}
