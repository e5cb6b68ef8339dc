//! Where the robot is, by what it saw on the last metres: the search for the place that it has come back to.

use super::{Before, CLOSING, Closings};
use crate::geometry::{Chain, Gaussian3, Pose2, Relation, driven};
use crate::mapper::agreement::Agreement;
use crate::mapper::loops::LoopEnd;
use crate::mapper::models::{Map, score};
use crate::matching::{Score, ScoredPose, hill_climb};
use crate::ops;
use crate::order::sorted;
use crate::proposal::{CorrelativeSearch, Search, Target};
use crate::sensor::Scan;
use nalgebra::Matrix3;

/// Where a particle is, and what it may have come back to.
pub(super) struct Now<'a> {
    pub(super) closings: &'a Closings,
    /// Its path.
    pub(super) poses: &'a [Pose2],
    /// What the robot saw on the last metres, in its frame.
    pub(super) picture: Scan,
    pub(super) old: &'a Before,
    /// The particle's map of then.
    pub(super) map: &'a Map,
    /// The loops that its path has closed.
    pub(super) relations: &'a [Relation],
}

impl Now<'_> {
    fn step(&self) -> usize {
        self.poses.len() - 1
    }

    pub(super) fn here(&self) -> Pose2 {
        self.poses[self.step()]
    }

    /// Of the poses from which the old map was drawn the nearest to this one, if it is near.
    pub(super) fn nearest(&self, to: &Pose2) -> Option<usize> {
        let distances = (0..=self.old.step).map(|step| (self.poses[step].distance(to), step));
        let (distance, step) = distances.reduce(|a, b| if b.0 < a.0 { b } else { a })?;
        (distance < CLOSING.reach).then_some(step)
    }

    /// That the robot is back there at this pose, if the way since is a loop.
    pub(super) fn relation(&self, to: &Pose2) -> Option<Relation> {
        let from = self.nearest(to)?;
        let way = self.closings.way(from, self.step());
        let is_loop = way > CLOSING.loop_way && way > CLOSING.loop_times * self.poses[from].distance(to);
        is_loop.then(|| Relation { from, to: self.step(), between: self.poses[from].between(to) })
    }

    pub(super) fn agreement(&self, pose: &Pose2) -> Agreement {
        Agreement::of(&score().log_beams(self.map, pose, &self.picture))
    }

    /// The loop that is closed as the path is, if that is beyond doubt and some metres after the last one.
    pub(super) fn closed(&self, agreement: &Agreement) -> Option<Relation> {
        let is_sure = agreement.fits >= CLOSING.sure && agreement.is_undisputed();
        let is_new = self.relations.last().is_none_or(|last| self.closings.way(last.to, self.step()) >= CLOSING.apart);
        self.relation(&self.here()).filter(|_| is_sure && is_new)
    }

    /// The loop that was missed, and the path that closes it, where the robot is at this place.
    pub(super) fn bent(&self, place: &Pose2) -> Option<(Relation, Vec<Pose2>)> {
        let relation = self.relation(place)?;
        let relations: Vec<Relation> = self.relations.iter().copied().chain([relation]).collect();
        Some((relation, self.chain().bent(&relations)?))
    }

    /// Whether any step since the nearest earlier place was doubted, and no loop has been closed over it.
    pub(super) fn is_doubted(&self) -> bool {
        let is_closed = |step| self.relations.iter().any(|one| one.from < step && step <= one.to);
        let is_open = |step: usize| self.closings.views[step].doubt != [0.0; 2] && !is_closed(step);
        self.nearest(&self.here()).is_some_and(|from| (from + 1..=self.step()).any(is_open))
    }

    /// The path with the uncertainty that matching leaves, which grows with the root of the way, and a turn of a radian counts as a metre; and that of steps that
    /// were doubted. What the path was bent by before is not taken off.
    fn chain(&self) -> Chain<'_> {
        /// What is left where the robot did not move \[m, rad\].
        const LEAST: [f64; 2] = [1e-4, 1e-5];
        let stds = |step: usize, motion: &Pose2| {
            let ([way, turn], doubt) = (driven(motion), self.closings.views[step].doubt);
            let [position, heading] = CLOSING.drift;
            let position = position * way.sqrt() + LEAST[0] + doubt[0];
            [position, position, heading * (way + turn).sqrt() + LEAST[1] + doubt[1]]
        };
        Chain::new(self.poses, stds, CLOSING.relation)
    }

    /// Where the robot may be as far as matching and the loops so far know.
    fn prior(&self) -> Option<Gaussian3> {
        let from = self.nearest(&self.here())?;
        let covariance = self.chain().covariance(self.relations, from, self.step())?;
        let (sin, cos) = ops::sin_cos(self.poses[from].theta);
        let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        Gaussian3::new(self.here(), turn * covariance * turn.transpose())
    }

    /// Where the picture fits the old map, and nowhere else nearly as well.
    pub(super) fn search(&self) -> Place {
        let Some(prior) = self.prior() else { return Place::Unclear };
        let (score, here) = (score(), self.here());
        // A climb asks which of two poses is better, for which every second end point will do.
        let target = Target::new(&prior, score.near(self.map, &here, &self.picture, 2), 0.0);
        let climbed = |start| hill_climb(start, CLOSING.climb, |pose, floor| target.log_posterior(pose, floor));
        let starts = CLOSING.search.all_round(&prior).starts(&target).poses;
        let tops: Vec<ScoredPose> = sorted(starts.into_iter().map(climbed).collect(), ScoredPose::highest_first);
        let stay = target.log_posterior(&here, f64::NEG_INFINITY);
        let gain = |top: &ScoredPose| (top.value - stay) / self.picture.hits.len() as f64;
        let Some(top) = tops.iter().find(|top| is_elsewhere(&top.pose, &here) && gain(top) > -CLOSING.gain) else {
            return Place::Here;
        };
        let second = tops.iter().find(|other| are_apart(&other.pose, &top.pose)).map_or(0.0, gain);
        let there = self.agreement(&top.pose);
        let is_there = there.fits >= CLOSING.fits && there.is_undisputed();
        let (shift, gain) = (here.distance(&top.pose), gain(top));
        if is_there && gain - f64::max(second, 0.0) >= CLOSING.gain {
            Place::Elsewhere(top.pose, LoopEnd::Bent { shift, gain, second })
        } else {
            Place::Unclear
        }
    }
}

/// Where the robot is, by what it saw on the last metres.
pub(super) enum Place {
    /// Where the path has it: they fit much better there than anywhere else.
    Here,
    /// At another place: they fit much better there than where the path has it, and than anywhere else.
    Elsewhere(Pose2, LoopEnd),
    /// They do not tell.
    Unclear,
}

/// Whether a place that was found is another than where the path has the robot.
fn is_elsewhere(there: &Pose2, here: &Pose2) -> bool {
    let [position, heading] = CLOSING.elsewhere;
    let [way, turn] = driven(&here.between(there));
    way > position || turn > heading
}

/// Whether two poses are of two hills: more than a step of the lattice from each other, or more than two of its turns. What is nearer the
/// particle's own search finds.
fn are_apart(a: &Pose2, b: &Pose2) -> bool {
    let (d, CorrelativeSearch { linear, angular, .. }) = (a.minus(b), CLOSING.search);
    d.x.abs().max(d.y.abs()) > linear || d.z.abs() > 2.0 * angular
}
