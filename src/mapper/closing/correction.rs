//! A path that closes a loop, mapped again.

use super::Closings;
use crate::geometry::{Pose2, Relation};
use crate::map::ConditionalMap;
use crate::mapper::loops::LoopEnd;
use crate::mapper::models::Map;
use crate::particle::Particle;

/// A path that closes a loop, and its map as far as it is mapped again.
#[derive(Clone, Debug)]
pub(super) struct Correction {
    pub(super) relation: Relation,
    pub(super) end: LoopEnd,
    /// Poses up to the end of the loop. The motions since are as the particle makes them.
    pub(super) bent: Vec<Pose2>,
    pub(super) map: Map,
    /// Of the first so many scans.
    pub(super) mapped: usize,
    /// The maps of [`Closings::before`] as they would have been, by step.
    pub(super) before: Vec<(usize, Map)>,
}

impl Correction {
    /// The pose of a step, of a particle with these poses as it has them.
    fn pose(&self, poses: &[Pose2], step: usize) -> Pose2 {
        let last = self.bent.len() - 1;
        if step <= last { self.bent[step] } else { self.bent[last].compose(&poses[last].between(&poses[step])) }
    }

    /// Maps so many more scans, and no more than there are; tells whether all of them are mapped.
    pub(super) fn advance(&mut self, closings: &Closings, poses: &[Pose2], scans: usize) -> bool {
        let end = self.mapped.saturating_add(scans).min(poses.len());
        for step in self.mapped..end {
            let (view, pose) = (&closings.views[step], self.pose(poses, step));
            if view.marked {
                self.map.mark();
            }
            if let Some(scan) = &view.scan {
                self.map.assimilate(&pose, &scan.scan(), &());
            }
            if step == 0 {
                self.map.settle();
            }
            if closings.before.iter().any(|before| before.step == step) {
                self.before.push((step, self.map.present()));
            }
        }
        self.mapped = end;
        end == poses.len()
    }

    /// The particle that was corrected.
    pub(super) fn particle(&self, particle: &Particle<Map>, poses: &[Pose2]) -> Particle<Map> {
        let corrected: Vec<Pose2> = (0..poses.len()).map(|step| self.pose(poses, step)).collect();
        let same = corrected.iter().zip(poses).take_while(|(corrected, pose)| corrected == pose).count();
        let mut path = particle.path.back().nth(poses.len() - same).expect("the first pose stays").clone();
        corrected[same..].iter().for_each(|pose| path.push(*pose));
        Particle { world_from_robot: path.pose(), map: self.map.clone(), path }
    }
}
