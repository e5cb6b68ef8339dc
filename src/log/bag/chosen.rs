//! Which topic of scans a bag is read by, and which odometry: those that were asked for, or the only ones there are.

use super::frames::frame;
use super::{Gathered, Led, ODOM, Track};
use crate::place::STILL;
use crate::{LogError, LogProblem, Remark, Topics};
use fastslam::geometry::Pose2;

/// What is said of a topic that was asked for, or of one that must be: to whoever names topics, as a command does.
fn of_topic(words: String) -> LogError {
    LogError::whole(LogProblem::Topic(words))
}

impl Gathered {
    pub fn odometry_frame(&self) -> &str {
        self.options.odometry_frame.as_deref().map_or(ODOM, frame)
    }

    pub fn chosen_scans(&self) -> Result<String, LogError> {
        if let Some(wanted) = &self.options.scan_topic {
            self.is_of(wanted, &["sensor_msgs/LaserScan"])?;
        }
        // What could not be read tells more than what is not there.
        if let (true, Some(first)) = (self.scans.is_empty(), &self.log.notes.first_malformed) {
            return Err(first.clone());
        }
        let mut topics = self.scans.keys();
        match (topics.next(), topics.len()) {
            (Some(topic), 0) => Ok(topic.clone()),
            (Some(_), _) => {
                Err(self.several("scan-topic", "scans", self.scans.iter().map(|(topic, scans)| (topic, scans.len()))))
            }
            (None, _) => Err(LogError::whole(LogProblem::NoScanTopic(self.listed()))),
        }
    }

    /// The chosen one, that of the one topic of odometry, or that of the transforms.
    pub fn chosen_odometry(&mut self, laser: &str) -> Result<Option<Track>, LogError> {
        if let Some(wanted) = &self.options.odometry_topic {
            self.is_of(wanted, &["nav_msgs/Odometry", "tf2_msgs/TFMessage", "tf/tfMessage"])?;
        }
        if self.odometry.is_empty() || self.options.odometry_frame.is_some() {
            return self.of_transforms(laser);
        }
        if self.odometry.len() > 1 {
            let counts = self.odometry.iter().map(|(topic, track)| (topic, track.poses.len()));
            return Err(self.several("odometry-topic", "odometry", counts));
        }
        Ok(self.odometry.pop_first().map(|(_, track)| track))
    }

    /// What transforms tell from the frame of the odometry, to the robot that carries the laser where there are several. Where none leads from there and none
    /// was asked for, the first one above the laser that moves, or the only one that does.
    fn of_transforms(&mut self, laser: &str) -> Result<Option<Track>, LogError> {
        let (transforms, wanted) = (&self.transforms, self.odometry_frame());
        // From the laser up: the place of a transform in the chain that it hangs from.
        let above: Vec<_> = self.frames.above(laser).collect();
        let height = |led: &Led| above.iter().position(|(from, to)| **from == led.from && **to == led.to);
        let lowest = |among: &dyn Fn(&Led) -> bool| {
            let kept = transforms.iter().enumerate().filter(|(_, led)| among(led));
            kept.min_by_key(|(_, led)| height(led).unwrap_or(usize::MAX)).map(|(at, _)| at)
        };
        let mut at = lowest(&|led| led.from == wanted);
        let moving: Vec<String> = transforms
            .iter()
            .filter(|led| moves(&led.track.poses))
            .map(|Led { from, to, .. }| format!("{from} to {to}"))
            .collect();
        if at.is_none() && self.options.odometry_frame.is_some() {
            let listed = if moving.is_empty() { "none".into() } else { moving.join(", ") };
            return Err(of_topic(format!("no transform leads from the frame {wanted}; those that move: {listed}")));
        }
        if at.is_none() {
            at = lowest(&|led| moves(&led.track.poses) && (moving.len() == 1 || height(led).is_some()));
        }
        if at.is_none() && moving.len() > 1 {
            let listed = moving.join(", ");
            let words = format!("odometry-frame may name a transform that tells odometry by its first frame: {listed}");
            self.log.notes.remarks.push(Remark::Told(words));
        }
        Ok(at.map(|at| self.transforms.swap_remove(at).track))
    }

    /// Whether a topic that was asked for is there, and is of one of these types.
    fn is_of(&self, wanted: &str, kinds: &[&str]) -> Result<(), LogError> {
        match self.topics.get(wanted) {
            None => Err(of_topic(format!("there is no topic {wanted} in it; there is {}", self.listed()))),
            Some((kind, _)) if !kinds.contains(&kind.as_str()) => {
                Err(of_topic(format!("the topic {wanted} is of type {kind}, not {}", kinds.join(" or "))))
            }
            Some((_, 0)) => Err(of_topic(format!("the topic {wanted} has no message"))),
            Some(_) => Ok(()),
        }
    }

    fn several<'a>(&self, flag: &str, what: &str, topics: impl Iterator<Item = (&'a String, usize)>) -> LogError {
        let listed: Vec<String> = topics.map(|(topic, count)| format!("{topic} ({count})")).collect();
        of_topic(format!("several topics have {what}, and {flag} must name one: {}", listed.join(", ")))
    }

    /// All topics, as far as a line holds them.
    fn listed(&self) -> Topics {
        const MOST: usize = 20;
        let listed = self.topics.iter().take(MOST).map(|(topic, (kind, count))| format!("{topic} ({count} × {kind})"));
        Topics { listed: listed.collect(), more: self.topics.len().saturating_sub(MOST) }
    }
}

/// Whether poses are not all one.
fn moves(poses: &[(f64, Pose2)]) -> bool {
    poses.iter().any(|(_, pose)| pose.minus(&poses[0].1).amax() > STILL)
}
