//! ROS 2 bags (MCAP) and ROS 1 bags: `sensor_msgs/LaserScan` with `nav_msgs/Odometry`, or with `tf` from the frame of the odometry to the robot.
//!
//! That frame is `odom`. Where no transform leads from there, it is the first one above the laser that the robot moves in.
//!
//! Where the laser sits is told by the transforms: those that are fixed, and of others the first of each. Nothing is kept of a file but the
//! scans, the odometry, and the chunk that is begun.

mod chosen;
mod containers;
mod frames;
mod messages;
mod path;
#[cfg(test)]
mod tests;

pub use path::write_path;

use self::containers::{Channel, Container, Mcap, ROS1_MAGIC, Ros1, Sink};
use self::frames::{Frames, Mounting, flat, frame};
use super::place::{NOWHERE, place};
use super::{LaserLog, LogError, LogProblem, MessageProblem, Remark};
use core::f32::consts::PI;
use fastslam::geometry::Pose2;
use fastslam::sensor::LaserScan;
use std::collections::BTreeMap;

/// What the frame is called that odometry is told in, by REP 105.
const ODOM: &str = "odom";

/// What the robot's own frame is called where odometry does not say.
const ROBOT: [&str; 2] = ["base_link", "base_footprint"];

/// Whether a file that begins so is a bag. Thirteen bytes are enough.
pub fn is_bag(start: &[u8]) -> bool {
    start.starts_with(mcap::MAGIC) || start.starts_with(ROS1_MAGIC)
}

/// Which topics of a bag are read, and how.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct BagOptions {
    /// That of the scans; needed where several have some.
    pub scan_topic: Option<String>,
    /// That of the odometry, or of `tf`; needed where several have some.
    pub odometry_topic: Option<String>,
    /// Frame that transforms tell odometry in, where it is another one than `odom` or the first above the laser that the robot moves in.
    pub odometry_frame: Option<String>,
    /// Malformed messages are passed over, and a bag that breaks off is read up to there; both are counted.
    pub lenient: bool,
}

/// Reads a bag piece by piece, as it comes from a file or a network.
///
/// The stamp of a scan, and of odometry, is that of its header, or where that is zero the time of recording. A range below `range_min`,
/// above `range_max` or not a number has met nothing. A laser that hangs upside down, by the transforms, sweeps the other way.
///
/// Units are those of ROS: metres, radians, seconds. Reference: <https://mcap.dev/spec>, <http://wiki.ros.org/Bags/Format/2.0>, REP 103
/// and REP 105.
#[derive(Default)]
pub struct BagReader {
    start: Vec<u8>,
    container: Option<Box<dyn Container>>,
    gathered: Gathered,
    /// What ended the reading of a bag before its end.
    broken: bool,
}

impl BagReader {
    /// For a bag of which nothing has been read.
    pub fn new(options: BagOptions) -> Self {
        Self { gathered: Gathered { options, ..Gathered::default() }, ..Self::default() }
    }

    /// The next bytes, cut anywhere.
    ///
    /// # Errors
    /// What cannot be read, and on which topic, unless the reader is lenient; what is no bag at all.
    pub fn push(&mut self, bytes: &[u8]) -> Result<(), LogError> {
        if self.broken {
            return Ok(());
        }
        let Some(container) = &mut self.container else {
            self.start.extend_from_slice(bytes);
            if self.start.len() < ROS1_MAGIC.len() {
                return Ok(());
            }
            let start = core::mem::take(&mut self.start);
            self.container = Some(match () {
                () if start.starts_with(mcap::MAGIC) => Box::new(Mcap::default()),
                () if start.starts_with(ROS1_MAGIC) => Box::new(Ros1::default()),
                () if start.starts_with(b"#ROSBAG") => return Err(LogError::whole(LogProblem::OldBag)),
                () => return Err(LogError::whole(LogProblem::NoBag)),
            });
            return self.push(&start);
        };
        container.push(bytes, &mut self.gathered).or_else(|problem| {
            self.broken = true;
            self.gathered.malformed(problem)
        })
    }

    /// What [`BagOptions`] must choose, once all is read: `scan` or `odometry`, and the topics that have it.
    pub fn choice(&self) -> Option<(&'static str, Vec<String>)> {
        let Gathered { scans, odometry, .. } = &self.gathered;
        match (scans.len(), odometry.len()) {
            (2.., _) => Some(("scan", scans.keys().cloned().collect())),
            (_, 2..) => Some(("odometry", odometry.keys().cloned().collect())),
            _ => None,
        }
    }

    /// Ends one of several files that are a recording together: the next bytes are those of the next file.
    ///
    /// # Errors
    /// That the file breaks off, unless the reader is lenient; that it is no bag at all.
    pub fn end_part(&mut self) -> Result<(), LogError> {
        let (container, broken) = (self.container.take(), core::mem::take(&mut self.broken));
        match container {
            None => Err(LogError::whole(LogProblem::NoBag)),
            Some(_) if broken => Ok(()),
            Some(mut container) => {
                container.finish(&mut self.gathered).or_else(|problem| self.gathered.malformed(problem))
            }
        }
    }

    /// The log: scans by time, each with its odometry.
    ///
    /// # Errors
    /// That the bag breaks off, unless the reader is lenient; that it has no scans, or several topics of them and none was chosen, and
    /// which topics there are; that scans and odometry have no time in common; a laser that is not level.
    pub fn finish(mut self) -> Result<LaserLog, LogError> {
        self.end_part()?;
        self.gathered.log()
    }
}

/// What is kept of a bag.
#[derive(Default)]
struct Gathered {
    options: BagOptions,
    /// All topics, with type and number of messages.
    topics: BTreeMap<String, (String, u32)>,
    scans: BTreeMap<String, Vec<(String, LaserScan)>>,
    odometry: BTreeMap<String, Track>,
    /// What transforms tell. As soon as one leads from the frame of the odometry, no other is kept.
    transforms: Vec<Led>,
    frames: Frames,
    log: LaserLog,
}

/// The odometry of a topic, and whose it is.
#[derive(Default)]
struct Track {
    robot: String,
    /// Whether it is told by fixed transforms, which count for nothing where there are others.
    is_fixed: bool,
    poses: Vec<(f64, Pose2)>,
}

/// What the transforms from one frame to another tell.
struct Led {
    from: String,
    to: String,
    track: Track,
}

impl Sink for Gathered {
    fn channel(&mut self, channel: &Channel) {
        self.topics.entry(channel.topic.clone()).or_insert_with(|| (channel.kind.clone(), 0));
    }

    fn message(&mut self, channel: &Channel, recorded: f64, bytes: &[u8]) -> Result<(), LogProblem> {
        let Channel { topic, kind, .. } = channel;
        let number = self.topics.get_mut(topic).map_or(0, |(_, count)| {
            *count += 1;
            *count
        });
        self.take(channel, recorded, bytes)
            .or_else(|problem| {
                self.malformed(LogProblem::Message { topic: topic.clone(), number, kind: kind.clone(), problem })
            })
            .map_err(|error| error.problem)
    }
}

impl Gathered {
    fn take(&mut self, channel: &Channel, recorded: f64, bytes: &[u8]) -> Result<(), MessageProblem> {
        let Channel { topic, kind, encoding } = channel;
        let stamp = |time: messages::Time| if time.sec == 0 && time.nanosec == 0 { recorded } else { time.seconds() };
        let other = |wanted: &Option<String>| wanted.as_ref().is_some_and(|wanted| wanted != topic);
        match kind.as_str() {
            "sensor_msgs/LaserScan" if !other(&self.options.scan_topic) => {
                let message: messages::LaserScan = encoding.one(bytes)?;
                let time = stamp(message.header.stamp);
                let scan = scan(&message, time)?;
                self.log.notes.beyond.add(&message.ranges, scan.max_range);
                self.scans.entry(topic.clone()).or_default().push((message.header.frame_id, scan));
            }
            "nav_msgs/Odometry" if !other(&self.options.odometry_topic) => {
                let message: messages::Transform = encoding.one(bytes)?;
                let pose = flat(&message.parent_from_child).ok_or(MessageProblem::Pose)?;
                let track = self.odometry.entry(topic.clone()).or_default();
                track.robot = message.child_frame_id;
                track.poses.push((stamp(message.header.stamp), pose));
            }
            "tf2_msgs/TFMessage" | "tf/tfMessage" => {
                for transform in encoding.list::<messages::Transform>(bytes)? {
                    let is_fixed = topic.ends_with("tf_static");
                    self.frames.take(&transform, is_fixed);
                    if !other(&self.options.odometry_topic) {
                        self.transform(transform, is_fixed, stamp)?;
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Keeps a transform that may be odometry.
    fn transform(
        &mut self,
        transform: messages::Transform,
        is_fixed: bool,
        stamp: impl Fn(messages::Time) -> f64,
    ) -> Result<(), MessageProblem> {
        let messages::Transform { header, child_frame_id: robot, parent_from_child } = transform;
        let (from, to, wanted) = (frame(&header.frame_id), frame(&robot), self.odometry_frame());
        let is_wanted = from == wanted;
        let is_chosen = self.options.odometry_frame.is_some();
        let is_found = self.transforms.first().is_some_and(|led| led.from == wanted);
        if !is_wanted && (is_fixed || (is_found && !is_chosen)) {
            return Ok(());
        }
        let pose = match flat(&parent_from_child) {
            Some(pose) => pose,
            None if is_wanted => return Err(MessageProblem::Transform),
            None => return Ok(()),
        };
        if is_wanted && !is_found && !is_chosen {
            self.transforms.clear();
        }
        let at = self.transforms.iter().position(|led| led.from == from && led.to == to).unwrap_or_else(|| {
            self.transforms.push(Led { from: from.into(), to: to.into(), track: Track::default() });
            self.transforms.len() - 1
        });
        let track = &mut self.transforms[at].track;
        if is_fixed && !track.is_fixed && !track.poses.is_empty() {
            return Ok(());
        }
        if core::mem::replace(&mut track.is_fixed, is_fixed) && !is_fixed {
            track.poses.clear();
        }
        track.robot = robot;
        track.poses.push((stamp(header.stamp), pose));
        Ok(())
    }

    fn malformed(&mut self, problem: LogProblem) -> Result<(), LogError> {
        let error = LogError::whole(problem);
        if !self.options.lenient {
            return Err(error);
        }
        self.log.notes.malformed += 1;
        self.log.notes.first_malformed.get_or_insert(error);
        Ok(())
    }

    fn log(mut self) -> Result<LaserLog, LogError> {
        let scan_topic = self.chosen_scans()?;
        let scans = self.scans.remove(&scan_topic).unwrap_or_default();
        let track = self.chosen_odometry(scans.first().map_or("", |(laser, _)| laser))?;
        let mut log = core::mem::take(&mut self.log);
        let mounting = self.mounting(&scans, track.as_ref(), &mut log)?;
        log.scans = scans.into_iter().map(|(_, scan)| mounted(scan, &mounting)).collect();
        log.odometry = track.unwrap_or_default().poses;
        log.in_order();
        place(&mut log)?;
        log.seen_something()?;
        Ok(log)
    }

    /// Where the laser sits. What no transform tells is told as such.
    fn mounting(
        &self,
        scans: &[(String, LaserScan)],
        track: Option<&Track>,
        log: &mut LaserLog,
    ) -> Result<Mounting, LogError> {
        let Some((laser, _)) = scans.first() else { return Ok(Mounting::default()) };
        let told = track.map(|track| track.robot.as_str()).filter(|robot| !robot.is_empty());
        let robots = told.into_iter().chain(ROBOT);
        let found = robots.clone().find_map(|robot| self.frames.mounting(robot, laser));
        found
            .unwrap_or_else(|| {
                let robot = robots.clone().next().unwrap_or_default();
                log.notes.remarks.push(Remark::NoTransform { laser: frame(laser).into(), robot: frame(robot).into() });
                Ok(Mounting::default())
            })
            .map_err(LogError::whole)
    }
}

/// A sweep, in the laser's own frame.
fn scan(message: &messages::LaserScan, time: f64) -> Result<LaserScan, MessageProblem> {
    let messages::LaserScan { angle_min, angle_increment, range_min, range_max, ranges, .. } = message;
    if ranges.is_empty() {
        return Err(MessageProblem::NoRanges);
    }
    let angles = [*angle_min, *angle_increment];
    if !angles.iter().all(|angle| angle.is_finite())
        || angle_min.abs() > 2.0 * PI
        || angle_increment.abs() > PI
        || *angle_increment == 0.0
    {
        let [first, step] = angles.map(f64::from);
        return Err(MessageProblem::Angles { first, step });
    }
    let longest = if *range_max > 0.0 { *range_max } else { f32::INFINITY };
    // What is too near, too far or no number says nothing.
    let told = |range: f32| (range >= *range_min && range <= longest) || range == f32::INFINITY;
    let reading = |range: &f32| if told(*range) { *range } else { 0.0 };
    Ok(LaserScan {
        time,
        odometry: NOWHERE,
        robot_from_laser: Pose2::default(),
        first_angle: f64::from(*angle_min),
        angle_step: f64::from(*angle_increment),
        max_range: Some(f64::from(longest)).filter(|range| range.is_finite()),
        ranges: ranges.iter().map(reading).collect(),
    })
}

/// A sweep as the robot sees it: seen from above, a laser upside down sweeps the other way.
fn mounted(scan: LaserScan, mounting: &Mounting) -> LaserScan {
    let way = if mounting.upside_down { -1.0 } else { 1.0 };
    LaserScan {
        robot_from_laser: mounting.robot_from_laser,
        first_angle: way * scan.first_angle,
        angle_step: way * scan.angle_step,
        ..scan
    }
}
