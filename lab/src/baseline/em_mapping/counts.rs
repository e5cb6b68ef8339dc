//! The same corridor for particles: given its path, a particle only has to count.

use super::corridor::{Beta, Corridor, Kernel};
use fastslam::error::SettingError;
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::particle::Particle;
use fastslam::proposal::{Proposal, ProposalTrace, Proposed};
use fastslam::random::Stream;
use std::sync::Arc;

/// p(m | x₁..ₜ, z₁..ₜ) of the corridor: a [`Beta`] for each cell, by how often the sensor said *door* there, and how often not.
#[derive(Clone, Debug)]
pub struct DoorCounts {
    corridor: Corridor,
    counts: Arc<[[u32; 2]]>,
}

impl DoorCounts {
    /// Nothing is counted yet.
    pub fn new(corridor: Corridor) -> Self {
        Self { corridor, counts: vec![[0; 2]; corridor.cells as usize].into() }
    }

    /// What is known of a cell; of one that does not exist, what is known of the last.
    pub fn get(&self, cell: usize) -> Beta {
        let [yes, no] = self.counts[cell.min(self.counts.len() - 1)];
        self.corridor.known.after(yes.into(), no.into())
    }
}

impl ConditionalMap for DoorCounts {
    /// Whether the sensor says *door*.
    type Observation = bool;
    type Association = ();

    fn assimilate(&mut self, world_from_robot: &Pose2, says_door: &bool, (): &()) {
        let cell = self.corridor.cell(world_from_robot.x);
        Arc::make_mut(&mut self.counts)[cell][usize::from(!says_door)] += 1;
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.corridor.validate()
    }
}

/// Draws the next cell from the wheels, and weighs it by what the counts foretell there: ln w += ln ∫ p(z | x, m) p(m | x₁..ₜ₋₁, z₁..ₜ₋₁) dm.
/// A pose is the middle of its cell. Takes one `u64`.
#[derive(Clone, Copy, Debug)]
pub struct ByWheels;

impl Proposal<DoorCounts> for ByWheels {
    type Control = Kernel;

    fn propose(
        &self,
        particle: &Particle<DoorCounts>,
        control: &Kernel,
        says_door: &bool,
        stream: &mut Stream,
    ) -> Proposed<()> {
        let corridor = &particle.map.corridor;
        let cell = control.draw(corridor.cell(particle.world_from_robot.x), stream.uniform());
        let door = particle.map.get(cell).mean();
        let log_increment = fastslam::ops::ln(if *says_door { door } else { 1.0 - door });
        let world_from_robot = Pose2::new(corridor.place(cell), 0.0, 0.0);
        Proposed { world_from_robot, association: (), log_increment, trace: ProposalTrace::Motion }
    }
}
