//! Odometry, held against the motions that scans tell by themselves: what is wrong with a log as a whole.
//!
//! A laser that is mounted the other way round, a left hand that was taken for a right one, centimetres, a clock that is late: none of it makes an impossible step, and
//! where a room is small, a scan of which odometry is wrong fits somewhere all the same. Over many steps it shows. Each scan of a sample is matched with those
//! of the last few places ([`LastPlaces`]), from where odometry leads and from where the motion before leads; what is found elsewhere must fit clearly
//! better, so that along a corridor, where scans do not tell how far one went, odometry is right. Motions by scans and by odometry are compared by
//! regression: translations as complex numbers, whose ratio is a scale and an angle, and turns.

use super::LaserMapperSettings;
use super::last_places::{LastPlaces, MAX_RANGE, fan};
use super::scan_to_scan::match_scans;
use crate::error::fixed;
use crate::geometry::{Pose2, driven};
use crate::ops;
use crate::order::sorted;
use crate::sensor::LaserScan;
use core::fmt;

/// How motions by scans and motions by odometry go together, over a sample of a log.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OdometryCheck {
    /// Steps that were compared.
    pub steps: u32,
    /// Share of the scans, 0 to 1, that fit upon those before.
    pub fitting: f64,
    /// What was put right of poses before the rest was compared, as odometry explains nothing without: [`OdometryFault::Clockwise`] or
    /// [`OdometryFault::Flipped`], if anything.
    pub frame: Option<OdometryFault>,
    /// How far the robot drives by the scans, per metre of odometry.
    pub drives: f64,
    /// How much further to the left it drives than odometry tells \[rad\].
    pub aside: f64,
    /// How far it turns by the scans, per radian of odometry; `None` where it turns too little to tell.
    pub turns: Option<f64>,
    /// Share of the motion by scans that odometry explains so, 0 to 1: of drives and of turns.
    pub explained: [f64; 2],
}

/// What is wrong with odometry, or with what is said of the laser.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum OdometryFault {
    /// The robot turns to the other side than odometry tells: the map is a mirror image, if the laser is to blame.
    Mirrored,
    /// It drives so many times as far as odometry tells.
    Scaled(f64),
    /// It turns so many times as far.
    Turned(f64),
    /// It drives this much further to the left \[rad\].
    Aside(f64),
    /// Headings are told clockwise, and positions are not.
    Clockwise,
    /// Positions are told in a frame whose y axis is to the right of its x axis, and headings are not.
    Flipped,
    /// Odometry does not explain how it moves.
    Unrelated {
        /// Whether nearly all scans fit upon those before, so that they tell by themselves how it moves.
        scans_fit: bool,
    },
}

/// So many scans that follow one another are a stretch; of a log as many stretches are looked at, until one says clearly that all is well.
const STRETCH: usize = 48;
const STRETCHES: [usize; 3] = [1, 0, 2];

/// Scans between which odometry moves by less \[m, rad\] are passed over, but no more than [`PASSED_OVER`] in a row: it may tell too little.
const APART: f64 = 0.1;
const PASSED_OVER: usize = 10;

/// Fewer compared steps are no evidence, and nor is a shorter way \[m\] or less turning \[rad\].
const LEAST_STEPS: usize = 15;
const LEAST_WAY: f64 = 1.5;
const LEAST_TURN: f64 = 1.5;

/// How much better \[nats an end point\] a scan must fit elsewhere than where odometry leads.
const BETTER: f64 = 0.1;

/// Share of the steps that is kept, those first in which scans and odometry differ least: others may be a jump, or a scan that was matched to a wrong place.
const KEPT: f64 = 0.95;

/// A scan of fewer end points tells nothing of a motion.
const ENOUGH: usize = 20;

/// From this share of explained motion on, scans and odometry tell of one motion, by factors that can be believed.
const EXPLAINED: f64 = 0.9;

/// Below these shares of drives and turns they do not. In a hall, where scans do not tell how far one went, half of the drives are explained.
const UNRELATED: [f64; 2] = [0.3, 0.5];

/// Factors beyond these, or the inverse, are no error of wheels; nor is an angle beyond this \[rad\].
const FACTOR: f64 = 1.35;
const ANGLE: f64 = 0.35;

/// From this angle on \[rad\] the robot drives backwards.
const BACKWARDS: f64 = 2.9;

/// Where the way by scans is a smaller share of that by odometry, odometry is in another unit, and not the ranges: no room measures hundreds of metres.
const OTHER_UNIT: f64 = 0.1;

/// The same with a frame that was put right: by chance, two motions do not even go together so.
const EXPLAINED_SO: f64 = 0.75;

/// Share of the scans that must fit upon those before for a map that is made by them alone.
const FITTING: f64 = 0.9;

impl OdometryCheck {
    /// For the scans of a log; `None` where they do not tell enough of their motions.
    pub fn of(scans: &[LaserScan], settings: &LaserMapperSettings) -> Option<Self> {
        let longest = settings.for_scans(scans).longest();
        let scans = apart(scans);
        let mut found = Found::default();
        if scans.len() <= STRETCH * STRETCHES.len() {
            found.add(&scans, longest);
            return found.check();
        }
        for k in STRETCHES {
            let first = k * (scans.len() - STRETCH) / (STRETCHES.len() - 1);
            found.add(&scans[first..first + STRETCH], longest);
            if found.check().is_some_and(|check| check.is_well()) {
                break;
            }
        }
        found.check()
    }

    /// The unit that all ranges of a log are in, as a part of a metre and by its name, where odometry in metres and ranges in metres do not go together, and
    /// with ranges in this unit clearly do.
    pub fn unit_of_ranges(scans: &[LaserScan], settings: &LaserMapperSettings) -> Option<(f64, &'static str)> {
        if Self::of(scans, settings).is_some_and(|check| check.explained[0] > EXPLAINED) {
            return None;
        }
        let fits = |times: f64| {
            let mut scans = scans.to_vec();
            scans.iter_mut().for_each(|scan| scan.ranges.iter_mut().for_each(|range| *range *= times as f32));
            let check = Self::of(&scans, settings).filter(Self::is_well);
            check.is_some_and(|check| check.fitting > FITTING && unit(check.drives * times) == unit(times))
        };
        UNITS.into_iter().find(|(size, _)| fits(*size))
    }

    /// Whether scans and odometry clearly tell of one motion.
    fn is_well(&self) -> bool {
        self.turns.is_some() && self.explained.iter().all(|share| *share > EXPLAINED) && self.fault().is_none()
    }

    /// What is wrong, if anything is.
    pub fn fault(&self) -> Option<OdometryFault> {
        let Self { drives, aside, turns, explained, fitting, frame, .. } = *self;
        let is_off = |factor: f64| !(1.0 / FACTOR..FACTOR).contains(&factor);
        if explained.iter().zip(UNRELATED).any(|(share, least)| *share < least) {
            return Some(OdometryFault::Unrelated { scans_fit: fitting >= FITTING });
        }
        if frame.is_some() {
            return frame;
        }
        match turns.filter(|_| explained[1] > EXPLAINED) {
            Some(turns) if turns < 0.0 => return Some(OdometryFault::Mirrored),
            Some(turns) if is_off(turns) => return Some(OdometryFault::Turned(turns)),
            _ => {}
        }
        if explained[0] > EXPLAINED && is_off(drives) {
            return Some(OdometryFault::Scaled(drives));
        }
        (aside.abs() > ANGLE).then_some(OdometryFault::Aside(aside))
    }
}

impl OdometryFault {
    /// Whether a map is still not to be trusted when this is [put right](Self::put_right): the laser may be what is wrong.
    pub fn doubts_scans(&self) -> bool {
        match self {
            Self::Mirrored | Self::Turned(_) => true,
            Self::Scaled(times) => *times > OTHER_UNIT,
            Self::Aside(_) | Self::Clockwise | Self::Flipped => false,
            Self::Unrelated { scans_fit } => !scans_fit,
        }
    }
}

impl OdometryFault {
    /// Corrects the odometry of all scans of a log, motion by motion, so that it agrees with what they show; where it does not tell how the robot moves,
    /// each scan is matched with those before ([`match_scans`]). Returns the stamps \[s\] of those that do not fit there.
    pub fn put_right(&self, scans: &mut [LaserScan]) -> Vec<f64> {
        if matches!(self, Self::Unrelated { .. }) {
            return match_scans(scans);
        }
        let told: Vec<Pose2> = scans.iter().map(|scan| self.meant(&scan.odometry)).collect();
        if let (Some(scan), Some(first)) = (scans.first_mut(), told.first()) {
            scan.odometry = *first;
        }
        for k in 1..told.len() {
            let motion = self.corrected(&told[k - 1].between(&told[k]));
            scans[k].odometry = scans[k - 1].odometry.compose(&motion);
        }
        Vec::new()
    }

    /// The motion that was meant.
    fn corrected(&self, &Pose2 { x, y, theta }: &Pose2) -> Pose2 {
        match *self {
            Self::Mirrored => Pose2::new(x, -y, -theta),
            Self::Scaled(times) => Pose2::new(times * x, times * y, theta),
            Self::Turned(times) => Pose2::new(x, y, times * theta),
            Self::Aside(angle) => {
                let [x, y] = Pose2::new(0.0, 0.0, angle).transform([x, y]);
                Pose2::new(x, y, theta)
            }
            Self::Clockwise | Self::Flipped | Self::Unrelated { .. } => Pose2::new(x, y, theta),
        }
    }

    /// The pose that was meant, where it is the frame of poses that is wrong.
    fn meant(&self, &Pose2 { x, y, theta }: &Pose2) -> Pose2 {
        match self {
            Self::Clockwise => Pose2::new(x, y, -theta),
            Self::Flipped => Pose2::new(x, -y, theta),
            _ => Pose2::new(x, y, theta),
        }
    }
}

/// The scans between which odometry moves.
fn apart(scans: &[LaserScan]) -> Vec<&LaserScan> {
    let mut taken: Vec<&LaserScan> = Vec::new();
    let mut passed = 0;
    for scan in scans {
        let moves = |last: &&LaserScan| driven(&last.odometry.between(&scan.odometry)).iter().any(|by| *by >= APART);
        passed += 1;
        if passed > PASSED_OVER || taken.last().is_none_or(moves) {
            taken.push(scan);
            passed = 0;
        }
    }
    taken
}

/// What was found of the steps that were looked at.
#[derive(Default)]
struct Found {
    /// Scans that were matched.
    scans: u32,
    /// Of those that fit, the motion by scans and the poses by odometry before it and after.
    steps: Vec<(Pose2, [Pose2; 2])>,
}

impl Found {
    /// Looks at scans that follow one another.
    fn add(&mut self, scans: &[&LaserScan], longest: f64) {
        let mut places = LastPlaces::default();
        let (mut last, mut motion) = (Pose2::default(), Pose2::default());
        for (k, scan) in scans.iter().enumerate() {
            let ends = scan.end_points(longest, MAX_RANGE);
            let told = if k > 0 { scans[k - 1].odometry.between(&scan.odometry) } else { Pose2::default() };
            let there = places.matched(&[last.compose(&told)], &ends, &|_| true);
            let ahead = places.searched(&fan(last.compose(&motion)), &last, &ends, 0.0);
            let pose = match (there, ahead) {
                (Some(there), Some(ahead)) => {
                    let better = ahead.value > there.value + BETTER * ends.hits.len() as f64;
                    if better { ahead.pose } else { there.pose }
                }
                _ => last.compose(&motion),
            };
            let found = last.between(&pose);
            if k > 0 && ends.hits.len() >= ENOUGH {
                self.scans += 1;
                if places.is_home(&pose, &ends) {
                    self.steps.push((found, [scans[k - 1].odometry, scan.odometry]));
                }
            }
            places.take(pose, || ends);
            (motion, last) = (found, pose);
        }
    }

    /// With odometry as it is told, if scans and odometry go together so; else with that which a wrong frame explains, if one does.
    fn check(&self) -> Option<OdometryCheck> {
        let as_told = self.check_in(None)?;
        if !matches!(as_told.fault(), Some(OdometryFault::Unrelated { .. })) {
            return Some(as_told);
        }
        let explains = |check: &OdometryCheck| {
            check.turns.is_some_and(|turns| turns > 0.0) && check.explained.iter().all(|share| *share > EXPLAINED_SO)
        };
        let frames = [OdometryFault::Clockwise, OdometryFault::Flipped].map(Some);
        frames.into_iter().filter_map(|frame| self.check_in(frame)).find(explains).or(Some(as_told))
    }

    /// With this put right of the frame of odometry.
    fn check_in(&self, frame: Option<OdometryFault>) -> Option<OdometryCheck> {
        let steps = self.steps.iter().map(|(found, told)| {
            let [before, after] = told.map(|pose| frame.map_or(pose, |frame| frame.meant(&pose)));
            [*found, before.between(&after)]
        });
        let off = |[m, o]: &[Pose2; 2]| driven(&o.between(m)).iter().sum::<f64>();
        let steps = sorted(steps.collect(), |a, b| off(a).total_cmp(&off(b)));
        let steps = &steps[..(KEPT * steps.len() as f64) as usize];
        let way: [f64; 2] = [0, 1].map(|k: usize| steps.iter().map(|[m, _]| driven(m)[k]).sum());
        if steps.len() < LEAST_STEPS || way[0] < LEAST_WAY {
            return None;
        }
        let sum = |term: fn(&Pose2, &Pose2) -> f64| steps.iter().map(|[m, o]| term(m, o)).sum::<f64>();
        let [re, im] = [sum(|m, o| o.x * m.x + o.y * m.y), sum(|m, o| o.x * m.y - o.y * m.x)];
        let [oo, mm] = [sum(|_, o| o.x * o.x + o.y * o.y), sum(|m, _| m.x * m.x + m.y * m.y)];
        let [tt, nn] = [sum(|_, o| o.theta * o.theta), sum(|m, _| m.theta * m.theta)];
        let turned = sum(|m, o| o.theta * m.theta);
        let ratio = |above: f64, below: f64| if below > 0.0 { above / below } else { 0.0 };
        let tells_turns = way[1] > LEAST_TURN;
        Some(OdometryCheck {
            steps: steps.len() as u32,
            fitting: self.steps.len() as f64 / f64::from(self.scans),
            frame,
            drives: ratio(ops::hypot(re, im), oo),
            aside: ops::atan2(im, re),
            turns: tells_turns.then(|| ratio(turned, tt)),
            explained: [
                ratio(re * re + im * im, oo * mm),
                if tells_turns { ratio(turned * turned, tt * nn) } else { 1.0 },
            ],
        })
    }
}

/// Units that are told in place of metres, as parts of a metre.
const UNITS: [(f64, &str); 4] = [(0.001, "millimetres"), (0.01, "centimetres"), (0.0254, "inches"), (0.3048, "feet")];

/// The unit that is this part of a metre, to 12 %.
fn unit(metres: f64) -> Option<&'static str> {
    UNITS.into_iter().find(|(size, _)| (metres / size - 1.0).abs() < 0.12).map(|(_, name)| name)
}

impl fmt::Display for OdometryFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mirrored => f.write_str(
                "by the scans the robot turns to the other side than by its odometry: does the laser hang upside down, or are left and right exchanged?",
            ),
            Self::Scaled(times) => {
                let times_as_far = fixed(*times, if *times < 0.1 { 4 } else { 2 });
                write!(f, "by the scans the robot drives {times_as_far} times as far as by its odometry: ")?;
                match (unit(*times), unit(1.0 / times)) {
                    (Some(unit), _) => write!(f, "is odometry in {unit}, and not in metres?"),
                    (_, Some(unit)) => write!(f, "are ranges in {unit}, and not in metres?"),
                    _ => f.write_str("are both in metres, and is the laser's angle from beam to beam right?"),
                }
            }
            Self::Turned(times) => write!(
                f,
                "by the scans the robot turns {times:.2} times as far as by its odometry: are headings and the laser's angles in radians, and is the angle from beam to beam right?"
            ),
            Self::Aside(angle) if angle.abs() > BACKWARDS => f.write_str(
                "by the scans the robot drives back where by its odometry it drives ahead: does the laser look back?",
            ),
            Self::Aside(angle) => write!(
                f,
                "by the scans the robot drives {:.0}° further to the {} than by its odometry: is the laser turned on the robot by as much?",
                angle.abs().to_degrees(),
                if *angle > 0.0 { "left" } else { "right" }
            ),
            Self::Clockwise => f.write_str(
                "headings and positions of the odometry go together only if headings are clockwise: are they those of a compass?",
            ),
            Self::Flipped => f.write_str(
                "headings and positions of the odometry go together only if one axis is turned round: are x and y exchanged, or has one of them the wrong sign?",
            ),
            Self::Unrelated { .. } => f.write_str(
                "by the scans the robot moves otherwise than by its odometry: are they of one robot, one clock and one frame, and are all angles in radians?",
            ),
        }
    }
}
