//! Scans that are in a log more than once: a driver that sends its last scan again, or a stretch of the drive that was copied behind itself.

use super::{LaserLog, Remark};
use fastslam::geometry::Pose2;
use fastslam::mapper::LaserMapperSettings;
use fastslam::order::sorted;
use fastslam::sensor::LaserScan;

/// Fewer ranges may be equal by chance.
const ENOUGH: usize = 10;

/// Fewer scans in a row, or poses, may repeat earlier ones by chance, where ranges have no noise.
const IN_A_ROW: usize = 5;

/// Most scans from one that repeats to the next, and between the two that they repeat: those between were spoilt, or are of another copy of the drive.
const APART: usize = 4;

/// A step of odometry this many times as long as the longest of a stretch is not a step of a robot that drives.
const JUMP: f64 = 2.0;

impl LaserLog {
    /// Takes the ranges from scans that repeat, to the bit, those of the scan before, though the robot moved in between: a driver that sends its last scan
    /// again. Their odometry stays. How many there were, and the stamp of the first \[s\]; `None` where there were none. In a corridor that a simulator
    /// draws without noise, all that is left out says nothing new.
    pub fn leave_repeated_out(&mut self) -> Option<(usize, f64)> {
        let (mut count, mut first, mut last) = (0, None, 0);
        for k in 1..self.scans.len() {
            let (before, scan) = (&self.scans[last], &self.scans[k]);
            let moves = moved(before.odometry, scan.odometry) > LaserMapperSettings::STILL;
            let readings = scan.ranges.iter().filter(|range| range.is_finite() && **range > 0.0).count();
            if moves && readings >= ENOUGH && bits(&before.ranges).eq(bits(&scan.ranges)) {
                count += 1;
                first = first.or(Some(scan.time));
                self.scans[k].ranges.fill(f32::NAN);
            } else {
                last = k;
            }
        }
        first.map(|time| (count, time))
    }

    /// Leaves out each stretch of scans that repeats, to the bit and with its odometry, an earlier one, to which the odometry jumps back: part of the log was
    /// written twice. What is in the log is in the order of recording.
    pub(super) fn leave_copies_out(&mut self) {
        let key = |scan: &LaserScan| hash(bits(&scan.ranges).chain(words(&scan.odometry)));
        let keys: Vec<u64> = self.scans.iter().map(key).collect();
        let mut of_scans = copies(&keys);
        of_scans.retain(|copy| copy.iter().filter(|(k, _)| tells(&self.scans[*k])).count() >= IN_A_ROW);
        // Where one was copied, those that follow without a jump were too.
        if !of_scans.iter().any(|copy| jumps(copy, &|k| self.scans[k].odometry)) {
            return;
        }
        let Some(copy) = of_scans.first() else { return };
        let (first, last) = (copy[0], copy[copy.len() - 1]);
        let keys: Vec<u64> = self.odometry.iter().map(|(_, pose)| hash(words(pose))).collect();
        let mut of_odometry = copies(&keys);
        of_odometry.retain(|copy| jumps(copy, &|k| self.odometry[k].1));
        // Scans that are told apart from the odometry: where it goes on, a simulated robot may see a place again as it was.
        if self.scans[first.0].odometry.x.is_nan() && of_odometry.is_empty() && !keys.is_empty() {
            return;
        }
        let stretch = [[first.0, last.0], [first.1, last.1]].map(|ends| ends.map(|k| k as u32 + 1));
        let count = leave_out(&mut self.scans, &of_scans);
        leave_out(&mut self.odometry, &of_odometry);
        self.notes.remarks.push(Remark::Copied { stretch, count });
    }
}

/// What repeats earlier things in a row: the index of each, and that of what it repeats.
type Repeat = Vec<(usize, usize)>;

/// Bits that are the same for ranges that are equal, and for all that are no number.
fn bits(ranges: &[f32]) -> impl Iterator<Item = u32> {
    ranges.iter().map(|range| if range.is_nan() { u32::MAX } else { (range + 0.0).to_bits() })
}

/// The bits of a pose.
fn words(pose: &Pose2) -> impl Iterator<Item = u32> {
    let Pose2 { x, y, theta } = *pose;
    [x, y, theta].into_iter().map(f64::to_bits).flat_map(|c| [c as u32, (c >> 32) as u32])
}

/// FNV-1a over words.
fn hash(words: impl Iterator<Item = u32>) -> u64 {
    words.fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ u64::from(word)).wrapping_mul(0x0100_0000_01b3))
}

/// What repeats earlier things, by their keys. Things in a row that are the same count as one: a robot that stands repeats nothing.
fn copies(keys: &[u64]) -> Vec<Repeat> {
    let heads: Vec<usize> = (0..keys.len()).filter(|k| *k == 0 || keys[*k] != keys[*k - 1]).collect();
    let key = |p: &usize| keys[heads[*p]];
    let mut firsts: Vec<usize> = (0..heads.len()).collect();
    for same in sorted(firsts.clone(), |a, b| key(a).cmp(&key(b))).chunk_by(|a, b| key(a) == key(b)) {
        same.iter().for_each(|p| firsts[*p] = same[0]);
    }
    let (mut open, mut done) = (Vec::<Repeat>::new(), Vec::new());
    let mut close = |copy: &mut Repeat| {
        if copy.len() >= IN_A_ROW {
            done.push(core::mem::take(copy));
        }
    };
    for (p, first) in firsts.iter().copied().enumerate() {
        open.retain_mut(|copy| {
            let goes_on = p - copy[copy.len() - 1].0 <= APART;
            if !goes_on {
                close(copy);
            }
            goes_on
        });
        if first == p {
            continue;
        }
        // What follows, if it was there before, or else what is a little farther on.
        let next = |copy: &mut Repeat| {
            let (q, j) = copy[copy.len() - 1];
            let along = j + p - q;
            let near = (1..=APART).contains(&first.wrapping_sub(j)).then_some(first);
            let next = if along < copy[0].0 && firsts[along] == first { Some(along) } else { near };
            next.map(|j| copy.push((p, j)))
        };
        if open.iter_mut().find_map(next).is_none() {
            open.push(vec![(p, first)]);
        }
    }
    open.iter_mut().for_each(close);
    let (mut repeats, mut is_repeated) = (vec![false; heads.len()], vec![false; heads.len()]);
    for (p, j) in done.iter().flatten() {
        (repeats[*p], is_repeated[*j]) = (true, true);
    }
    let whole = |copy: Repeat| {
        let mut whole = Repeat::new();
        let (mut q, mut j) = copy[0];
        for (p, original) in copy {
            // What was spoilt between two that repeat.
            let spoilt =
                |at: &usize| p - q == original - j && !repeats[*at] && !is_repeated[*at] && !repeats[*at - q + j];
            for at in (q + 1..p).filter(spoilt).chain([p]) {
                let end = heads.get(at + 1).copied().unwrap_or(keys.len());
                whole.extend((heads[at]..end).map(|k| (k, heads[original + at - p])));
            }
            (q, j) = (p, original);
        }
        whole
    };
    done.into_iter().map(whole).collect()
}

/// Whether a scan tells of the place where it was taken.
fn tells(scan: &LaserScan) -> bool {
    let differ = |pair: &&[f32]| pair[0].is_finite() && pair[0] != pair[1];
    scan.ranges.windows(2).filter(differ).count() >= ENOUGH
}

/// How far one pose is from another \[m, rad\].
fn moved(from: Pose2, to: Pose2) -> f64 {
    let Pose2 { x, y, theta } = from.between(&to);
    x.abs().max(y.abs()).max(theta.abs())
}

/// Whether the odometry jumps to one of these from what is none of them. Where there are no poses, or they never move, there is nothing to go on.
fn jumps(copy: &Repeat, pose: &dyn Fn(usize) -> Pose2) -> bool {
    let step = |a: usize, b: usize| moved(pose(a), pose(b));
    let longest = copy.windows(2).map(|pair| step(pair[0].1, pair[1].1)).fold(0.0, f64::max);
    longest == 0.0 || copy.iter().any(|(k, _)| step(*k - 1, *k) > JUMP * longest)
}

/// Leaves these things out, and returns how many there were.
fn leave_out<T>(things: &mut Vec<T>, copies: &[Repeat]) -> u32 {
    let mut stays = vec![true; things.len()];
    copies.iter().flatten().for_each(|(k, _)| stays[*k] = false);
    let mut flags = stays.iter();
    let before = things.len();
    things.retain(|_| flags.next().copied().unwrap_or(true));
    (before - things.len()) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::ops::Range;

    /// The drive from its first record to its last.
    const WHOLE: [Range<usize>; 1] = [Range { start: 0, end: 60 }];

    /// The records of a drive of 60 scans, a step of odometry before each: half a metre a second, but for a rest of five scans.
    fn drive() -> Vec<[f64; 2]> {
        (0..60_i32).map(|k| [f64::from(k), 0.5 * f64::from(k - (k - 30).clamp(0, 5))]).collect()
    }

    /// A log of records, each with its stamp, the place where it was made, and what its scan is.
    fn log(records: &[(f64, [f64; 2])], spoil: impl Fn(usize, usize) -> Option<f32>) -> LaserLog {
        let record = |(number, (stamp, [k, x])): (usize, &(f64, [f64; 2]))| {
            let range = |beam: usize| {
                let range = 1.0 + ((*k as usize * 64 + beam) * 7919 % 7001) as f32 / 1000.0;
                spoil(number, beam).unwrap_or(range).to_string()
            };
            let ranges = (0..24).map(range).collect::<Vec<_>>().join(" ");
            format!("ODOM {} 0 0 0 0 0 {} h 0\nFLASER 24 {ranges} {x} 0 0 {x} 0 0 {stamp} h 0\n", x - 0.1, stamp - 0.5)
        };
        let text: String = records.iter().enumerate().map(record).collect();
        crate::parse(text.as_bytes(), false).unwrap()
    }

    fn plain() -> LaserLog {
        log(&stamped(&WHOLE, 0.0), |_, _| None)
    }

    /// Stretches of the drive one after another; the stamps of each begin so much later than those of the one before end, or are as they were.
    fn stamped(stretches: &[Range<usize>], pause: f64) -> Vec<(f64, [f64; 2])> {
        let (mut records, mut shift) = (Vec::new(), 0.0);
        for (k, stretch) in stretches.iter().enumerate() {
            let of = &drive()[stretch.clone()];
            if pause > 0.0 && k > 0 {
                shift = records.last().map_or(0.0, |(stamp, _): &(f64, _)| stamp + pause) - of[0][0];
            }
            records.extend(of.iter().map(|record| (record[0] + shift, *record)));
        }
        records
    }

    /// The places of a log: of its scans, and of its odometry.
    fn places(log: &LaserLog) -> [Vec<f64>; 2] {
        [log.scans.iter().map(|scan| scan.odometry.x).collect(), log.odometry.iter().map(|(_, pose)| pose.x).collect()]
    }

    #[test]
    fn a_stretch_that_is_written_twice_is_left_out() {
        let twice = |stretch, count| vec![Remark::Copied { stretch, count }];
        /// Stretches that are written, the first one that repeats another with that one, and how many scans do.
        type Case<'a> = (&'a [Range<usize>], [[u32; 2]; 2], u32);
        let cases: [Case<'_>; 5] = [
            (&[0..40, 20..40, 40..60], [[41, 60], [21, 40]], 20),
            (&[0..60, 10..40], [[61, 90], [11, 40]], 30),
            (&[0..60, 0..60], [[61, 120], [1, 60]], 60),
            (&[0..20, 8..20, 20..40, 28..40, 40..60], [[21, 32], [9, 20]], 24),
            (&[0..40, 20..40, 20..40, 40..60], [[41, 60], [21, 40]], 40),
        ];
        for (stretches, stretch, count) in cases {
            for pause in [0.0, 1.0] {
                let log = log(&stamped(stretches, pause), |_, _| None);
                assert_eq!(places(&log), places(&plain()), "{stretches:?}, {pause} s");
                assert_eq!(log.notes.remarks, twice(stretch, count), "{stretches:?}, {pause} s");
            }
        }
    }

    #[test]
    fn readings_that_are_no_number_repeat_and_a_scan_that_was_spoilt_goes_with_those_beside_it() {
        let records = stamped(&[0..40, 20..40, 40..60], 1.0);
        // Beam 5 of every scan, and in some scans of the copy another one.
        for spoilt in [None, Some(50)] {
            let log = log(&records, |number, beam| match beam {
                5 => Some(f32::NAN),
                7 if Some(number) == spoilt => Some(81.83),
                _ => None,
            });
            assert_eq!(places(&log), places(&plain()), "{spoilt:?}");
        }
        let mut again = log(&stamped(core::slice::from_ref(&(0..20)), 0.0), |number, beam| match beam {
            5 => Some(f32::NAN),
            _ if number == 11 => Some(1.0 + ((10 * 64 + beam) * 7919 % 7001) as f32 / 1000.0),
            _ => None,
        });
        assert_eq!(again.leave_repeated_out(), Some((1, 11.0)));
    }

    #[test]
    fn two_copies_of_a_drive_that_are_shuffled_are_one() {
        let mut records = stamped(&WHOLE, 0.0);
        records.extend(stamped(&WHOLE, 0.0).iter().map(|(stamp, record)| (stamp + 8.3, *record)));
        let log = log(&sorted(records, |a, b| a.0.total_cmp(&b.0)), |_, _| None);
        assert_eq!(places(&log)[0], places(&plain())[0]);
    }

    #[test]
    fn a_robot_that_sees_a_place_again_is_believed() {
        let good =
            |log: &LaserLog, scans: usize| assert_eq!((log.scans.len(), &log.notes.remarks[..]), (scans, &[][..]));
        good(&plain(), 60);
        // Scans that tell nothing: few beams meet anything.
        let blind = |_: usize, beam: usize| (beam > 5).then_some(81.83);
        good(&log(&stamped(&[0..40, 20..40, 40..60], 1.0), blind), 80);
        // To and fro, where neither ranges nor wheels have noise, and round and round.
        let to_and_fro: Vec<_> = (0..3).flat_map(|_| drive().into_iter().chain(drive().into_iter().rev())).collect();
        let stamps = |records: Vec<[f64; 2]>| -> Vec<_> {
            records.into_iter().enumerate().map(|(k, record)| (k as f64, record)).collect()
        };
        let rest = log(&stamps(to_and_fro), |_, _| None);
        good(&rest, 360);
        // Four in a row.
        good(&log(&stamped(&[0..40, 36..40, 40..60], 1.0), |_, _| None), 64);
    }

    #[test]
    fn where_odometry_goes_on_a_stretch_is_no_copy() {
        let scans =
            |x: f64| stamped(&[0..40, 20..40], 1.0).into_iter().map(move |(stamp, [k, _])| (stamp, [k, x * stamp]));
        let log = log(&scans(0.5).collect::<Vec<_>>(), |_, _| None);
        assert_eq!((log.scans.len(), &log.notes.remarks[..]), (60, &[][..]));
    }

    #[test]
    fn scans_that_are_told_apart_from_odometry_are_copies_if_it_is_one_too() {
        let apart = |odometry: &[Range<usize>], pause| {
            let parts = |stretches: &[Range<usize>]| -> Vec<LaserLog> {
                let records = stamped(stretches, pause);
                records.iter().map(|record| log(core::slice::from_ref(record), |_, _| None)).collect()
            };
            let mut scans: Vec<_> =
                parts(&[0..40, 20..40, 40..60]).into_iter().flat_map(|mut log| log.scans.pop()).collect();
            scans.iter_mut().for_each(|scan| scan.odometry = Pose2::new(f64::NAN, f64::NAN, f64::NAN));
            let odometry = parts(odometry).into_iter().flat_map(|log| log.odometry).collect();
            let mut log = LaserLog { scans, odometry, ..LaserLog::default() };
            log.in_order();
            log
        };
        for pause in [0.0, 1.0] {
            let copied = apart(&[0..40, 20..40, 40..60], pause);
            assert_eq!((copied.scans.len(), &places(&copied)[1]), (60, &places(&plain())[1]), "{pause} s");
            assert_eq!(apart(&[], pause).scans.len(), 60, "{pause} s");
            assert_eq!(apart(&WHOLE, pause).scans.len(), 80, "{pause} s");
        }
    }
}
