//! What moves by itself: people who walk by, and those who go along with the robot.
//!
//! A scan is matched to those before it, so a person who walks beside the robot makes it look as if the robot stood still. Each end
//! point is therefore compared with the scans of the last metres before any matching, with the motion that odometry tells and the
//! uncertainty of it. It is taken to move where it violates free space:
//!
//! - it lies in space that was seen to be free, wherever in the circle of that uncertainty it is; or
//! - it lies close to something in the same direction through whose circle beams go now: who walks ahead hides what is before him.
//!
//! Such an end point is neither matched nor drawn; its beam says that the way up to it is free. The radius of the circle is
//! three standard deviations, as many as the pose is searched for. Some walls are left out by mistake: those thinner than the gap
//! between two beams, and those that somebody stood right before, until the robot is three metres on.
//!
//! Reference: Lindström and Eklundh, *Detecting and tracking moving objects from a mobile platform using a laser range scanner*, IROS 2001
//! (violations of free space).

use crate::geometry::{Pose2, driven};
use crate::motion::Displacement;
use crate::ops;
use crate::proposal::SEARCH_STDS;
#[cfg(feature = "serde")]
use crate::save::{self, RestoreError};
use crate::sensor::{Beam, LaserScan, Scan};
use core::f64::consts::TAU;
use nalgebra::{Matrix2x3, Matrix3};
use std::collections::VecDeque;

/// Constants of what is taken to move.
pub(super) struct MovingConfig {
    /// Radius of the circle in which an end point may lie, in standard deviations of odometry: it is taken to move where all of the circle was
    /// seen to be free. As many as the search for the pose reaches.
    pub seen_through_stds: f64,
    /// Length added to that radius \[m\]: three standard deviations of a range that is off by 3 cm.
    pub range_error: f64,
    /// Least distance on the way between two scans that are remembered to find what moves \[m\]; the last one always is.
    view_spacing: f64,
    /// Way after which a scan is forgotten \[m\]: odometry is then less certain than most free space is wide.
    view_reach: f64,
    /// How much further than the robot a person may have walked since a view \[m\].
    walked_on: f64,
}

/// See [`MovingConfig`].
pub(super) const MOVING: MovingConfig = MovingConfig {
    seen_through_stds: SEARCH_STDS,
    range_error: 0.1,
    view_spacing: 0.5,
    view_reach: 3.0,
    walked_on: 0.5,
};

/// What was seen on the last metres of the way.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct LastViews {
    /// The oldest first.
    views: VecDeque<View>,
}

/// What one scan saw.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct View {
    odometry: Pose2,
    /// How far the robot has driven since \[m\], and by how much it has turned, to whichever side \[rad\].
    driven: [f64; 2],
    directions: Directions,
    /// By direction; `None` of what says nothing.
    beams: Vec<Option<Beam>>,
}

impl LastViews {
    /// The end points of this scan that may belong to something that stands still as its hits, the others as its misses. `displacement` tells
    /// where the robot is by a motion of odometry's, on which it drove so far and turned by so much ([`View::driven`]).
    pub(super) fn standing(
        &mut self,
        scan: &LaserScan,
        odometry: Pose2,
        beams: impl Iterator<Item = Option<Beam>>,
        displacement: impl Fn(&Pose2, [f64; 2]) -> Displacement,
    ) -> Scan {
        let view = View::new(scan, odometry, beams.collect());
        let last = self.views.back().map_or(view.odometry, |last| last.odometry);
        let step = driven(&last.between(&view.odometry));
        let mut moving = vec![false; view.beams.len()];
        for before in &mut self.views {
            before.driven = [0, 1].map(|k: usize| before.driven[k] + step[k]);
            let since = Since::new(&displacement(&before.odometry.between(&view.odometry), before.driven));
            view.mark_moving(before, &since, &mut moving);
        }
        let mut standing = Scan { origin: scan.origin(), ..Scan::default() };
        for (beam, moving) in view.beams.iter().zip(moving) {
            let Some(Beam { end, met, .. }) = *beam else { continue };
            if met && !moving { standing.hits.push(end) } else { standing.misses.push(end) }
        }
        self.remember(view);
        standing
    }

    /// Keeps this view, and of those before it the ones that were taken from places apart and not long ago.
    fn remember(&mut self, view: View) {
        if let [.., before, last] = self.views.make_contiguous()
            && before.driven[0] - last.driven[0] < MOVING.view_spacing
        {
            self.views.pop_back();
        }
        self.views.push_back(view);
        while self.views.front().is_some_and(|first| first.driven[0] > MOVING.view_reach) {
            self.views.pop_front();
        }
    }
}

#[cfg(feature = "serde")]
impl LastViews {
    /// Whether these can be views.
    pub(super) fn check(&self) -> Result<(), RestoreError> {
        for View { odometry, driven, directions, beams } in &self.views {
            save::poses("views", [*odometry, directions.robot_from_laser])?;
            let of_beams = beams.iter().flatten().flat_map(|beam| [beam.length, beam.end[0], beam.end[1]]);
            save::finite("views", driven.iter().chain(&directions.angles).copied().chain(of_beams))?;
        }
        Ok(())
    }
}

/// How the robot moved since a view.
struct Since {
    /// Where it is now, seen from where it was, and the other way round.
    moved: Pose2,
    back: Pose2,
    /// Of `moved`.
    covariance: Matrix3<f64>,
}

impl Since {
    fn new(displacement: &Displacement) -> Self {
        let Displacement { mean: moved, covariance } = *displacement;
        Self { moved, back: moved.between(&Pose2::default()), covariance }
    }

    /// Radius \[m\] of the circle in which a point p of the robot's frame now lies for the view of then, and the other way round: [`MovingConfig::range_error`]
    /// and [`MovingConfig::seen_through_stds`] times the largest standard deviation of x ⊕ p by the motion x.
    fn radius(&self, p: [f64; 2]) -> f64 {
        let (sin, cos) = ops::sin_cos(self.moved.theta);
        let jacobian = Matrix2x3::new(1.0, 0.0, -sin * p[0] - cos * p[1], 0.0, 1.0, cos * p[0] - sin * p[1]);
        let covariance = jacobian * self.covariance * jacobian.transpose();
        let (mean, half) = (0.5 * (covariance.m11 + covariance.m22), 0.5 * (covariance.m11 - covariance.m22));
        MOVING.seen_through_stds * (mean + length([half, covariance.m12])).sqrt() + MOVING.range_error
    }
}

impl View {
    fn new(scan: &LaserScan, odometry: Pose2, beams: Vec<Option<Beam>>) -> Self {
        Self { odometry, driven: [0.0; 2], directions: Directions::of(scan), beams }
    }

    /// Marks the beams that ended on something that has moved since a view from `before`.
    fn mark_moving(&self, before: &Self, since: &Since, moving: &mut [bool]) {
        let walk = before.driven[0] + MOVING.walked_on;
        let is_gone = |end| {
            let now = since.back.transform(end);
            self.sees_through(now, since.radius(now))
        };
        let gone: Vec<bool> = before.ends().map(|end| end.is_some_and(is_gone)).collect();
        for (end, moving) in self.ends().zip(moving) {
            let Some(end) = end.filter(|_| !*moving) else { continue };
            let then = since.moved.transform(end);
            *moving = before.sees_through(then, since.radius(end)) || before.is_near_gone(&gone, then, walk);
        }
    }

    /// Where beams met something, in the robot's frame \[m\], by beam.
    fn ends(&self) -> impl Iterator<Item = Option<[f64; 2]>> {
        self.beams.iter().map(|beam| beam.filter(|beam| beam.met).map(|beam| beam.end))
    }

    /// Whether every beam towards a circle \[m\] went on beyond it. What no beam looked at was not seen to be free, nor was the place of the
    /// laser itself.
    fn sees_through(&self, center: [f64; 2], radius: f64) -> bool {
        let (distance, at) = self.directions.towards(center);
        let tangent2 = distance * distance - radius * radius;
        if tangent2 <= 0.0 {
            return false;
        }
        let half = ops::atan2(radius, tangent2.sqrt()) / self.directions.angles[1].abs();
        let [first, last] = [(at - half).floor(), (at + half).ceil()].map(|k| k as i64);
        (first..=last).all(|k| self.beam(k).is_some_and(|beam| beam.length > distance + radius))
    }

    /// Whether the beam towards a point met something that is `gone` now, no further from the point than `walk` \[m\].
    fn is_near_gone(&self, gone: &[bool], point: [f64; 2], walk: f64) -> bool {
        let (_, at) = self.directions.towards(point);
        let k = self.directions.index(at.round() as i64);
        let end = self.beams.get(k).copied().flatten().map(|beam| beam.end);
        gone.get(k) == Some(&true) && end.is_some_and(|end| length([end[0] - point[0], end[1] - point[1]]) < walk)
    }

    /// The k-th beam, counted all around.
    fn beam(&self, k: i64) -> Option<Beam> {
        self.beams.get(self.directions.index(k)).copied().flatten()
    }
}

/// Which way a laser's beams look.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Directions {
    robot_from_laser: Pose2,
    /// Direction of the first beam in the laser's frame, and from one beam to the next \[rad\].
    angles: [f64; 2],
    /// Beams in a full turn.
    around: i64,
}

impl Directions {
    pub(super) fn of(scan: &LaserScan) -> Self {
        Self {
            robot_from_laser: scan.robot_from_laser,
            angles: [scan.first_angle, scan.angle_step],
            around: (TAU / scan.angle_step.abs()).round() as i64,
        }
    }

    /// How far from the laser a point of the robot's frame is \[m\], and in which direction, in beams from the first.
    pub(super) fn towards(&self, point: [f64; 2]) -> (f64, f64) {
        let from_laser = self.robot_from_laser.between(&Pose2::new(point[0], point[1], 0.0));
        let [first, step] = self.angles;
        let bearing = ops::atan2(from_laser.y, from_laser.x);
        (length([from_laser.x, from_laser.y]), ops::wrap_angle(bearing - first) / step)
    }

    /// Index of the k-th beam, counted all around: below 0, that of a laser that looks all around begins again at its last one.
    pub(super) fn index(&self, k: i64) -> usize {
        k.checked_rem_euclid(self.around).unwrap_or(k) as usize
    }
}

/// Of a vector \[m\].
fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests;
