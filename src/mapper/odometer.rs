//! Odometry, as far as it can be believed.
//!
//! A base restarts, a counter wraps, wheels stand while the robot is pushed, two sources write under one name: odometry then tells of motions
//! that never were, or of none. A step is doubted where it is faster or more abrupt than robots are, where the scan does not show the
//! last place as it would from there, or where it would show more of it if the robot went on as before, or stayed. A doubted step is searched for upon
//! the map of the last few places ([`LastPlaces`]), as if there were no odometry; before that, these places are put where their own scans fit, as
//! odometry that errs blurs the map of them. If the scan fits much better where odometry cannot have led, or further off than the filter can put
//! right, the robot is there, and odometry goes on from there. Where the robot went on as before, less is proof enough. The search continues until
//! odometry agrees with it again.
//!
//! Where scans prove neither, the step stays doubted, and so does one that was put right: how far it may be off is passed on ([`Believed::doubt`]), so that
//! loops are looked for as far, and a path that is bent to close one gives way there first.
//!
//! Particles have no part in it, so that a whole log can be checked before it is mapped ([`Replay`](super::Replay)).
//!
//! The constants were chosen on simulated drives that were spoilt in ten ways (`tests/laws`, `sense.rs`) and by jumps (`jumps.rs`), how far a doubted step may be
//! off on spoilt logs of Intel and ACES, and all of them so that no step of the three recorded logs that are at hand (these, and Freiburg's campus) is disbelieved.

mod last;
mod proof;

use self::last::Last;
use self::proof::{CLEAR, DISPUTED, GOES_ON, ODD, REFUTED, STANDING, STEADILY};
use super::last_places::{LastPlaces, MAX_RANGE, errors_of_wheels, fan, is_within};
use super::moving::{Directions, MOVING};
use crate::error::{Range, SettingError};
use crate::geometry::{Pose2, driven};
use crate::matching::ScoredPose;
use crate::ops;
#[cfg(feature = "serde")]
use crate::save::{self, RestoreError};
use crate::sensor::{LaserScan, Scan};

/// Where odometry has a scan, as far as it is believed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Believed {
    /// In the frame of odometry up to the first step that is not believed.
    pub(super) pose: Pose2,
    /// Standard deviations of the position and the heading after the step that led there \[m, rad\], besides what matching leaves: 0 of a step that was not doubted.
    pub(super) doubt: [f64; 2],
}

/// A step of odometry that was not believed.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unbelieved {
    /// Stamp of the scan that it leads to \[s\].
    pub time: f64,
    /// How long it took \[s\].
    pub elapsed: f64,
    /// The motion that odometry tells, in the frame of the robot before it.
    pub told: Pose2,
    /// The motion that was found by matching the scan with those of the last few places.
    pub matched: Pose2,
}

/// No robot with a laser drives faster \[m/s\] or turns faster \[rad/s\], but for this much \[m, rad\] by which stamps may be late.
const FASTEST: [f64; 2] = [15.0, 9.0];
const LATE: [f64; 2] = [1.0, 1.0];

/// Motions change seldom by more from one scan to the next \[m/s, rad\].
const STEADY: [f64; 2] = [2.0, 1.0];

/// Odometry that moves by less from one scan to the next \[m, rad\] says that the robot stands.
const STANDS: f64 = 1e-3;

/// About how many beams are compared with the last place.
const COMPARED: usize = 60;

/// The share of the beams that must end where those of the last place do: of a robot that moves, and of one that is said to stand.
const AGREED: [f64; 2] = [0.3, 0.9];

/// Least share of a scan's beams that can be compared with another: fewer say nothing of where it was taken.
const IN_COMMON: f64 = 0.2;

/// Fewer end points are no witness against odometry.
const ENOUGH: usize = 20;

/// Where half of a scan's end points are nearer to the laser than this \[m\], someone stands right before it: such a scan fits anywhere, and is no witness.
const COVERED: f64 = 0.5;

/// Where odometry leads, a scan is at home if the map disputes less of it than this share, and more than this share of its end points are on walls: it may
/// have much that is new.
const AT_HOME: [f64; 2] = [0.25, 0.25];

/// After a step that was not believed: how near \[m, rad\] the next one must be to what is matched to be believed again, and the share of the step that
/// it may be off besides.
const AGAIN: [f64; 3] = [0.05, 0.03, 0.1];

/// Odometry errors in one step that the filter corrects by itself \[m, rad\], even when it has learnt a narrow odometry noise. Of twelve single jumps in the
/// recorded logs it corrects 11 of 0.2 rad, and 9 of 0.25 or 0.3 rad. A motion that has changed by less is steady.
const REPAIRED: [f64; 2] = [0.35, 0.25];

/// Standard deviations of a doubted step that is matched with the scans before \[m, rad\]. Where two places are in question, what lies between them is added, up
/// to [`FARTHEST`].
const DOUBTED: [f64; 2] = [0.5, 0.1];

/// Largest distance between two places that counts \[m, rad\]: three times this is as far as loops are looked for (12 m), and nearly all round.
const FARTHEST: [f64; 2] = [4.0, 1.0];

/// Why a step is doubted.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Doubt {
    /// The step before was not believed.
    Still,
    /// No robot is as fast.
    Impossible,
    /// The motion has changed more than motions do.
    Odd,
    /// Odometry stands, and the scan has changed.
    Stands,
    /// The scan is of another place, or shows more of the last one if the robot went on as before, or stayed.
    Differs,
}

/// A step of odometry that is doubted.
struct Doubted {
    why: Doubt,
    /// Where it leads.
    told: Pose2,
    /// How long it took \[s\].
    elapsed: f64,
}

/// What the scans say of a doubted step.
enum Verdict {
    /// It is as odometry tells.
    AsTold,
    /// The scan was taken there.
    Elsewhere(Pose2),
    /// They do not tell. Where odometry leads the map disputes this share.
    Open(f64),
}

/// What a search finds of a doubted step.
#[derive(Default)]
struct Found {
    /// Where the scan was taken, if not where odometry leads.
    elsewhere: Option<Pose2>,
    /// [`Believed::doubt`].
    doubt: [f64; 2],
}

/// See the module.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Odometer {
    /// What leads from the frame of odometry to that of the poses that are believed; `None` as long as all of it is.
    correction: Option<Pose2>,
    last: Option<Last>,
    places: LastPlaces,
    /// The scan of the last place, and where it was taken.
    #[cfg_attr(feature = "serde", serde(with = "super::saved_place"))]
    place: Option<(Pose2, LaserScan)>,
    /// Why the last step was not believed, if it was not.
    disbelieved: Option<Doubt>,
    unbelieved: Vec<Unbelieved>,
}

impl Odometer {
    /// Where the robot was at the next scan. A reading of `longest` \[m\] or more met nothing.
    ///
    /// # Errors
    /// Where what the scan says of its time or its place is not finite, or no place: see [`LaserMapper::push`](super::LaserMapper::push). It is as
    /// if that scan had not been there.
    pub(super) fn next(&mut self, scan: &LaserScan, longest: f64) -> Result<Believed, SettingError> {
        scan.validate()?;
        if let Some(last) = &self.last {
            let jump = last.told.distance(&scan.odometry);
            Range::number(0.0, LaserScan::FARTHEST_JUMP, "m").check("odometry since the last scan", jump)?;
        }
        let told = self.correction.map_or(scan.odometry, |correction| correction.compose(&scan.odometry));
        let (mut pose, mut doubted) = (told, [0.0; 2]);
        if let Some(last) = self.last
            && let Some(why) = self.doubt(&last, scan, &told, longest)
        {
            let elapsed = scan.time - last.time;
            let found = self.searched(&last, scan, longest, &Doubted { why, told, elapsed });
            self.disbelieved = found.elsewhere.map(|_| why);
            doubted = found.doubt;
            if let Some(matched) = found.elsewhere {
                pose = matched;
                self.correction = Some(pose.compose(&scan.odometry.between(&Pose2::default())));
                self.unbelieved.push(Unbelieved {
                    time: scan.time,
                    elapsed,
                    told: last.pose.between(&told),
                    matched: last.pose.between(&pose),
                });
            }
        }
        let since = |last: Last| (last.pose.between(&pose), scan.time - last.time);
        let (motion, elapsed) = self.last.map_or((Pose2::default(), 0.0), since);
        let steady = self.last.is_some_and(|last| is_within(REPAIRED, &last.ahead(elapsed), &pose));
        self.last = Some(Last { time: scan.time, told: scan.odometry, pose, motion, elapsed, steady });
        if self.places.take(pose, || scan.end_points(longest, MAX_RANGE)) {
            self.place = Some((pose, scan.clone()));
        }
        Ok(Believed { pose, doubt: doubted })
    }

    pub(super) fn unbelieved(&self) -> &[Unbelieved] {
        &self.unbelieved
    }

    /// Why the step to this pose is doubted, if it is.
    fn doubt(&self, last: &Last, scan: &LaserScan, told: &Pose2, longest: f64) -> Option<Doubt> {
        if self.disbelieved.is_some_and(|doubt| doubt != Doubt::Differs) {
            return Some(Doubt::Still);
        }
        let elapsed = scan.time - last.time;
        let moved = driven(&last.pose.between(told));
        if elapsed > 0.0 && (0..2).any(|k| moved[k] > FASTEST[k] * elapsed + LATE[k]) {
            return Some(Doubt::Impossible);
        }
        let ahead = last.ahead(elapsed);
        let change = driven(&ahead.between(told));
        if change[0] > STEADY[0] * f64::max(elapsed, 0.5) || change[1] > STEADY[1] {
            return Some(Doubt::Odd);
        }
        let stands = moved[0].max(moved[1]) < STANDS;
        let doubt = if stands { Doubt::Stands } else { Doubt::Differs };
        let agreed = |pose: &Pose2| self.agreed(scan, pose, longest);
        let as_told = agreed(told);
        let differs = as_told.is_some_and(|agreed| agreed < AGREED[usize::from(stands)]);
        // Of a heading that jumps a third of the beams may agree, and of a jump along a corridor most.
        let jumps = change[1] > REPAIRED[1] || last.steady && change[0] > REPAIRED[0];
        let more = || last.without_jump(elapsed, told).iter().any(|pose| agreed(pose) > as_told);
        (self.disbelieved.is_some() || differs || jumps && more()).then_some(doubt)
    }

    /// The share of the beams of a scan that was taken at this pose that agree with the last place, of those that can be compared with it; 0 where too few can,
    /// and `None` where there is nothing to compare.
    fn agreed(&self, scan: &LaserScan, pose: &Pose2, longest: f64) -> Option<f64> {
        let (place, before) = self.place.as_ref()?;
        let (before_from_now, directions) = (place.between(pose), Directions::of(before));
        let [way, turn] = driven(&before_from_now);
        let met = |range: f64| range > 0.0 && range < longest;
        let (mut looked, mut compared, mut agreed) = (0, 0, 0);
        for k in (0..scan.ranges.len()).step_by(scan.ranges.len().div_ceil(COMPARED).max(1)) {
            let range = f64::from(scan.ranges[k]);
            if !met(range) {
                continue;
            }
            looked += 1;
            let (sin, cos) = ops::sin_cos(scan.first_angle + k as f64 * scan.angle_step);
            let end = scan.robot_from_laser.transform([range * cos, range * sin]);
            let (distance, at) = directions.towards(before_from_now.transform(end));
            let then = before.ranges.get(directions.index(at.round() as i64)).map(|then| f64::from(*then));
            if let Some(then) = then.filter(|then| met(*then)) {
                compared += 1;
                let tolerance = MOVING.range_error + 0.1 * way + 0.1 * (way + turn).min(0.5) * distance;
                agreed += u32::from((then - distance).abs() < tolerance);
            }
        }
        let [looked, compared, agreed] = [looked, compared, agreed].map(f64::from);
        (looked > 0.0).then(|| if compared < IN_COMMON * looked { 0.0 } else { agreed / compared })
    }

    /// The best mode of the scan's score that hill climbs from these starts reach, of those that are off by less than these errors from where odometry leads.
    fn near(&mut self, starts: &[Pose2], told: &Pose2, errors: [f64; 2], ends: &Scan) -> Option<ScoredPose> {
        self.places.matched(starts, ends, &|pose| is_within(errors, told, pose))
    }

    /// Whether the last places show what the scan does about where odometry leads, and not clearly more of it at one of these poses.
    fn is_at_home(&mut self, told: &Pose2, others: &[Pose2], ends: &Scan) -> bool {
        let near = self.near(&[*told], told, REPAIRED, ends);
        near.is_some_and(|near| {
            let (agreement, [disputed, fits]) = (self.places.agreement(&near.pose, ends), AT_HOME);
            let clear = near.value + ODD.gain * ends.hits.len() as f64;
            let mut other = || self.places.matched(others, ends, &|_| true);
            agreement.disputed() < disputed && agreement.fits > fits && other().is_none_or(|other| other.value < clear)
        })
    }

    /// Where the scan of a doubted step was taken, and how far it may be from there.
    fn searched(&mut self, last: &Last, scan: &LaserScan, longest: f64, step: &Doubted) -> Found {
        let (Doubted { why, told, elapsed }, ends) = (step, scan.end_points(longest, MAX_RANGE));
        let without_jump = last.without_jump(*elapsed, told);
        let ahead = without_jump[0];
        let doubt_between = |one: &Pose2, other: &Pose2| {
            let apart = driven(&one.between(other));
            [0, 1].map(|k| DOUBTED[k] + apart[k].min(FARTHEST[k]))
        };
        if (ends.hits.len() < ENOUGH || is_covered(&ends)) && *why != Doubt::Impossible {
            let doubt = if *why == Doubt::Odd { doubt_between(&ahead, told) } else { [0.0; 2] };
            return Found { elsewhere: None, doubt };
        }
        if *why == Doubt::Differs && self.is_at_home(told, &without_jump, &ends) {
            return Found::default();
        }
        self.places.tighten();
        let starts = [ahead, last.pose, *told].map(fan);
        let Some(best) = self.places.searched(starts.as_flattened(), &last.pose, &ends, 0.0) else {
            return Found::default();
        };
        match self.judged(last, step, &ends, &best) {
            Verdict::AsTold => Found::default(),
            Verdict::Elsewhere(pose) => {
                let is_home = self.places.is_home(&pose, &ends);
                Found { elsewhere: Some(pose), doubt: doubt_between(if is_home { &pose } else { &ahead }, &pose) }
            }
            // What differs from the last place may be new, as of one step in a hundred outdoors; and before a robot that stands, people move.
            Verdict::Open(_) if *why != Doubt::Odd => Found::default(),
            Verdict::Open(disputed) => {
                let on = self.near(&fan(ahead), &ahead, REPAIRED, &ends).map_or(ahead, |near| near.pose);
                let goes_on = last.is_recent(*elapsed)
                    && disputed > DISPUTED
                    && self.places.agreement(&on, &ends).disputed() < disputed;
                Found { elsewhere: goes_on.then_some(on), doubt: doubt_between(told, &best.pose) }
            }
        }
    }

    /// Whether the scan of a doubted step was taken where odometry leads, or at the best place that was found.
    fn judged(&mut self, last: &Last, step: &Doubted, ends: &Scan, best: &ScoredPose) -> Verdict {
        let Doubted { why, told, elapsed } = step;
        let [ahead, turned_ahead, ..] = last.without_jump(*elapsed, told);
        let agrees = |with: &Pose2| {
            let ([way, turn], [position, heading, share]) = (driven(&last.pose.between(&best.pose)), AGAIN);
            is_within([position + share * way, heading + share * turn], with, &best.pose)
        };
        let count = ends.hits.len() as f64;
        let of_way = errors_of_wheels(self.places.span(told));
        let (errors, less) = match why {
            Doubt::Impossible => return Verdict::Elsewhere(best.pose),
            Doubt::Still if agrees(told) => return Verdict::AsTold,
            Doubt::Still if is_within(REPAIRED, told, &best.pose) => return Verdict::Elsewhere(best.pose),
            // Rooms look alike: of two places where a scan fits about as well, it was taken where odometry leads.
            Doubt::Still => {
                let near = self.near(&fan(*told), told, REPAIRED, ends);
                let near = near.filter(|near| near.value >= best.value - ODD.gain * count);
                return Verdict::Elsewhere(near.unwrap_or(*best).pose);
            }
            // Errors of the wheels on all of the way are in the map of the places. Of a robot that stands the last place alone is asked.
            Doubt::Odd if !is_within(of_way, told, &best.pose) => (of_way, Some(ODD)),
            Doubt::Stands => (errors_of_wheels([0.0; 2]), Some(STANDING)),
            Doubt::Odd | Doubt::Differs => (REPAIRED, (last.steady && agrees(&ahead)).then_some(ODD)),
        };
        if is_within(errors, told, &best.pose) {
            return Verdict::AsTold;
        }
        let there = self.near(&fan(*told), told, errors, ends);
        let found = self.places.agreement(&best.pose, ends);
        let gain = there.map_or(f64::INFINITY, |there| (best.value - there.value) / count);
        let disputed = there.map_or(1.0, |there| self.places.agreement(&there.pose, ends).disputed());
        let goes_on = last.steady && [ahead, turned_ahead].iter().any(|pose| is_within(REPAIRED, pose, &best.pose));
        let is_proved = CLEAR.is_given(gain, &found)
            || less.is_some_and(|less| less.is_given(gain, &found))
            || goes_on && GOES_ON.is_given(gain, &found) && disputed > REFUTED
            || goes_on && *why == Doubt::Odd && last.is_recent(*elapsed) && STEADILY.is_given(gain, &found);
        if is_proved { Verdict::Elsewhere(best.pose) } else { Verdict::Open(disputed) }
    }
}

#[cfg(feature = "serde")]
impl Odometer {
    /// Whether this can be what was found of odometry.
    pub(super) fn check(&self) -> Result<(), RestoreError> {
        let Self { correction, last, places, place, disbelieved: _, unbelieved } = self;
        let of_last = last.iter().flat_map(|last| [last.told, last.pose, last.motion]);
        let of_steps = unbelieved.iter().flat_map(|step| [step.told, step.matched]);
        let of_place = place.iter().map(|(pose, _)| *pose);
        save::poses("odometer", correction.iter().copied().chain(of_last).chain(of_steps).chain(of_place))?;
        let times = last.iter().map(|last| [last.time, last.elapsed]);
        save::finite("odometer", times.chain(unbelieved.iter().map(|step| [step.time, step.elapsed])).flatten())?;
        place.iter().try_for_each(|(_, scan)| scan.validate())?;
        places.check()
    }
}

/// Whether the laser is covered: see [`COVERED`].
fn is_covered(ends: &Scan) -> bool {
    let is_near = |end: &&[f64; 2]| ops::hypot(end[0] - ends.origin[0], end[1] - ends.origin[1]) < COVERED;
    2 * ends.hits.iter().filter(is_near).count() > ends.hits.len()
}
