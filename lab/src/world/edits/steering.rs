//! A drive by hand: the course's own drive up to a step, and one motion a step from there on.

use super::{EditError, body};
use crate::world::FloorPlan;
use core::f64::consts::TAU;
use core::fmt;
use core::str::FromStr;
use fastslam::geometry::Pose2;
use fastslam::ops;

/// How far a step leads \[m\].
pub const FORWARD: f64 = 0.3;

/// The least turn \[rad\].
pub const TURN: f64 = TAU / 24.0;

/// Most steps of a drive, those of the course with it.
pub const MOST_STEPS: usize = 400;

/// How often a robot can be lifted.
pub const MOST_LIFTS: usize = 8;

/// No text is longer: version and step, a letter a step, and what a lifting is more than that.
const LONGEST: usize = "1.400.".len() + MOST_STEPS + MOST_LIFTS * "~1295_1295_23".len();

/// A turn to the left by a multiple of [`TURN`]: from half a turn to the right to half a turn to the left.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Turn(i8);

impl Turn {
    /// Half a turn.
    const HALF: i8 = 12;

    /// So many times [`TURN`], no more than half a turn to either side.
    pub fn by(steps: i32) -> Self {
        Self(steps.clamp(-i32::from(Self::HALF), i32::from(Self::HALF)) as i8)
    }

    /// The one nearest to an angle \[rad\].
    pub fn near(angle: f64) -> Self {
        Self::by((ops::wrap_angle(angle) / TURN).round() as i32)
    }

    fn angle(self) -> f64 {
        TURN * f64::from(self.0)
    }

    fn letter(self) -> char {
        char::from((i16::from(b'a') + i16::from(self.0) + i16::from(Self::HALF)) as u8)
    }

    fn of(letter: char) -> Option<Self> {
        ('a'..='y').contains(&letter).then(|| Self(letter as u8 as i8 - b'a' as i8 - Self::HALF))
    }
}

/// A point of a grid of 0.1 m, and a heading of 15°.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Place {
    x: u16,
    y: u16,
    heading: u8,
}

impl Place {
    const MOST: u16 = 1295;

    /// The one next to a pose.
    pub fn near(pose: &Pose2) -> Self {
        let cells = |metres: f64| (10.0 * metres).round().clamp(0.0, f64::from(Self::MOST)) as u16;
        let heading = ((pose.theta / TURN).round() as i64).rem_euclid(24) as u8;
        Self { x: cells(pose.x), y: cells(pose.y), heading }
    }

    /// The pose.
    pub fn pose(&self) -> Pose2 {
        let heading = ops::wrap_angle(TURN * f64::from(self.heading));
        Pose2::new(f64::from(self.x) / 10.0, f64::from(self.y) / 10.0, heading)
    }
}

/// What the robot does in a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Motion {
    /// Turns on the spot.
    Turn(Turn),
    /// Turns, and drives [`FORWARD`].
    Go(Turn),
    /// Drives back as far.
    Back,
    /// Is lifted, and set down elsewhere: its wheels do not notice.
    Lift(Place),
}

impl Motion {
    /// Straight on.
    pub fn straight() -> Self {
        Self::Go(Turn(0))
    }

    /// Where it leads from a pose, if nothing is in the way.
    pub fn from(&self, pose: &Pose2) -> Pose2 {
        match self {
            Self::Turn(turn) => pose.compose(&Pose2::new(0.0, 0.0, turn.angle())),
            Self::Go(turn) => pose.compose(&Pose2::new(0.0, 0.0, turn.angle())).compose(&Pose2::new(FORWARD, 0.0, 0.0)),
            Self::Back => pose.compose(&Pose2::new(-FORWARD, 0.0, 0.0)),
            Self::Lift(place) => place.pose(),
        }
    }

    fn letter(&self) -> Option<char> {
        match self {
            Self::Turn(turn) => Some(turn.letter()),
            Self::Go(turn) => Some(turn.letter().to_ascii_uppercase()),
            Self::Back => Some('z'),
            Self::Lift(_) => None,
        }
    }

    fn of(letter: char) -> Option<Self> {
        match letter {
            'z' => Some(Self::Back),
            'A'..='Y' => Turn::of(letter.to_ascii_lowercase()).map(Self::Go),
            _ => Turn::of(letter).map(Self::Turn),
        }
    }
}

/// What a reader drives: by default nothing, and the course is driven to its end.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Steering {
    course: u16,
    motions: Vec<Motion>,
}

impl Steering {
    /// Whether the course is driven to its end.
    pub fn is_empty(&self) -> bool {
        self.motions.is_empty()
    }

    /// Steps that are driven of a course of so many.
    pub fn of_course(&self, steps: usize) -> usize {
        if self.is_empty() { steps } else { usize::from(self.course) }
    }

    /// All steps, on a course of so many.
    pub fn steps(&self, course: usize) -> usize {
        self.of_course(course) + self.motions.len()
    }

    /// What is driven after that.
    pub fn motions(&self) -> &[Motion] {
        &self.motions
    }

    /// Steps that two drives on a course of so many have in common, from the start on.
    pub fn in_common(&self, other: &Self, course: usize) -> usize {
        let own = [self, other].map(|drive| drive.of_course(course));
        if own[0] != own[1] {
            return own[0].min(own[1]);
        }
        own[0] + self.motions.iter().zip(&other.motions).take_while(|(a, b)| a == b).count()
    }

    /// Drives on from a step of this drive on a course of so many: what came after it is cut off.
    ///
    /// # Errors
    /// Where there are too many steps or liftings; all is as it was.
    pub fn drive_on(&mut self, from: usize, course: usize, motion: Motion) -> Result<(), EditError> {
        let own = self.of_course(course);
        let mut next = Self { course: own.min(from) as u16, motions: self.motions.clone() };
        next.motions.truncate(from.saturating_sub(own));
        next.motions.push(motion);
        next.counted()?;
        *self = next;
        Ok(())
    }

    fn counted(&self) -> Result<(), EditError> {
        let lifts = self.motions.iter().filter(|motion| matches!(motion, Motion::Lift(_))).count();
        let fits = usize::from(self.course) + self.motions.len() <= MOST_STEPS && lifts <= MOST_LIFTS;
        if fits { Ok(()) } else { Err(EditError::Many) }
    }

    /// Whether it can be driven on a course of so many steps.
    pub(super) fn fit(&self, plan: &FloorPlan, steps: usize) -> Result<(), EditError> {
        let inside = |motion: &Motion| match motion {
            Motion::Lift(place) => {
                let Pose2 { x, y, .. } = place.pose();
                0.0 < x && x < plan.size[0] && 0.0 < y && y < plan.size[1]
            }
            _ => true,
        };
        let fits = usize::from(self.course) <= steps && self.motions.iter().all(inside);
        if fits { Ok(()) } else { Err(EditError::Outside) }
    }
}

impl fmt::Display for Steering {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return Ok(());
        }
        write!(f, "1.{}.", self.course)?;
        for run in self.motions.chunk_by(|a, b| a == b && a.letter().is_some()) {
            match (&run[0], run[0].letter()) {
                (_, Some(letter)) => write!(f, "{letter}")?,
                (Motion::Lift(Place { x, y, heading }), _) => write!(f, "~{x}_{y}_{heading}")?,
                _ => {}
            }
            if run.len() > 1 {
                write!(f, "{}", run.len())?;
            }
        }
        Ok(())
    }
}

impl FromStr for Steering {
    type Err = EditError;

    fn from_str(text: &str) -> Result<Self, EditError> {
        let Some(body) = body(text, LONGEST)? else { return Ok(Self::default()) };
        let (course, rest) = body.split_once('.').ok_or(EditError::Garbled)?;
        let course = whole(course).filter(|steps| usize::from(*steps) <= MOST_STEPS).ok_or(EditError::Garbled)?;
        let mut steering = Self { course, motions: Vec::new() };
        let mut letters = rest.chars();
        while let Some(letter) = letters.next() {
            let mut rest = letters.as_str();
            if letter == '~' {
                let numbers = [digits(&mut rest), part(&mut rest), part(&mut rest)];
                let [Some(x), Some(y), Some(heading)] = numbers else { return Err(EditError::Garbled) };
                if x > Place::MOST || y > Place::MOST || heading >= 24 {
                    return Err(EditError::Garbled);
                }
                steering.motions.push(Motion::Lift(Place { x, y, heading: heading as u8 }));
            } else {
                let motion = Motion::of(letter).ok_or(EditError::Garbled)?;
                let run = if rest.starts_with(|c: char| c.is_ascii_digit()) { digits(&mut rest) } else { Some(1) };
                let run = run.filter(|run| *run > 0).ok_or(EditError::Garbled)?;
                if usize::from(run) > MOST_STEPS {
                    return Err(EditError::Many);
                }
                steering.motions.extend(core::iter::repeat_n(motion, run.into()));
            }
            steering.counted()?;
            letters = rest.chars();
        }
        if steering.is_empty() { Err(EditError::Garbled) } else { Ok(steering) }
    }
}

/// A number of ASCII digits at the beginning of the text, which goes on behind it.
fn digits(rest: &mut &str) -> Option<u16> {
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let (number, after) = rest.split_at_checked(end)?;
    *rest = after;
    whole(number)
}

/// The same after a `_`.
fn part(rest: &mut &str) -> Option<u16> {
    *rest = rest.strip_prefix('_')?;
    digits(rest)
}

/// A whole number as it is written: without a sign, or a nought before it.
fn whole(text: &str) -> Option<u16> {
    let number: u16 = text.parse().ok()?;
    (number.to_string() == text).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn driven(motions: &[Motion]) -> Steering {
        let mut steering = Steering::default();
        for (k, motion) in motions.iter().enumerate() {
            steering.drive_on(20 + k, 90, *motion).unwrap();
        }
        steering
    }

    #[test]
    fn a_drive_is_read_as_it_is_written() {
        assert_eq!((Steering::default().to_string(), "".parse()), (String::new(), Ok(Steering::default())));
        let lift = Motion::Lift(Place::near(&Pose2::new(8.41, 4.6, -TURN)));
        let left = Motion::Turn(Turn::near(0.3));
        let steering = driven(&[Motion::straight(), Motion::straight(), left, lift, lift, Motion::Back]);
        assert_eq!(steering.to_string(), "1.20.M2n~84_46_23~84_46_23z");
        assert_eq!(steering.to_string().parse(), Ok(steering.clone()));
        assert_eq!((steering.of_course(90), steering.steps(90)), (20, 26));
    }

    #[test]
    fn what_is_written_by_nobody_is_refused() {
        for (text, why) in [
            ("2.0.M", EditError::Version),
            ("M", EditError::Version),
            ("1.M", EditError::Garbled),
            ("1.5.", EditError::Garbled),
            ("1.05.M", EditError::Garbled),
            ("1.-5.M", EditError::Garbled),
            ("1.NaN.M", EditError::Garbled),
            ("1.5.M0", EditError::Garbled),
            ("1.5.M02", EditError::Garbled),
            ("1.5.Z", EditError::Garbled),
            ("1.5.é", EditError::Garbled),
            ("1.5.~1_2", EditError::Garbled),
            ("1.5.~1_2_24", EditError::Garbled),
            ("1.5.~9999_2_3", EditError::Garbled),
            ("1.5.M99999999999", EditError::Garbled),
            ("1.5.M396", EditError::Many),
            (&format!("1.5.{}", "~1_2_3".repeat(9)), EditError::Many),
            (&"M".repeat(3000), EditError::Long),
        ] {
            assert_eq!(text.parse::<Steering>(), Err(why), "{text}");
        }
        assert!("1.5.M395".parse::<Steering>().is_ok());
    }

    #[test]
    fn driving_on_from_an_earlier_step_cuts_off_what_came_after() {
        let mut steering = driven(&[Motion::straight(); 5]);
        let before = steering.clone();
        steering.drive_on(22, 90, Motion::Back).unwrap();
        assert_eq!((steering.to_string().as_str(), steering.in_common(&before, 90)), ("1.20.M2z", 22));
        steering.drive_on(7, 90, Motion::Back).unwrap();
        assert_eq!((steering.to_string().as_str(), steering.in_common(&before, 90)), ("1.7.z", 7));
        assert_eq!(steering.in_common(&Steering::default(), 90), 7);
    }

    #[test]
    fn a_drive_that_is_full_takes_no_more_and_loses_nothing() {
        let mut steering = driven(&[Motion::straight(); 380]);
        let before = steering.clone();
        assert_eq!(steering.drive_on(400, 90, Motion::straight()), Err(EditError::Many));
        assert_eq!(steering, before);
    }

    #[test]
    fn a_robot_is_set_down_inside_only() {
        let plan = FloorPlan::apartment();
        for (text, fits) in
            [("1.90.~84_46_0", true), ("1.91.M", false), ("1.5.~0_46_0", false), ("1.5.~84_90_0", false)]
        {
            assert_eq!(text.parse::<Steering>().unwrap().fit(&plan, 90).is_ok(), fits, "{text}");
        }
    }

    #[test]
    fn motions_go_where_their_names_say() {
        let pose = Pose2::new(1.0, 2.0, 0.0);
        let close = |motion: Motion, x: f64, y: f64, theta: f64| {
            assert!(motion.from(&pose).minus(&Pose2::new(x, y, theta)).norm() < 1e-12, "{motion:?}");
        };
        close(Motion::straight(), 1.3, 2.0, 0.0);
        close(Motion::Back, 0.7, 2.0, 0.0);
        close(Motion::Turn(Turn::by(6)), 1.0, 2.0, TAU / 4.0);
        close(Motion::Go(Turn::by(-6)), 1.0, 1.7, -TAU / 4.0);
    }
}
