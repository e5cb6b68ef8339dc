//! The motion prior as proposal: move first, judge afterwards.

use super::{Proposal, ProposalTrace, Proposed};
use crate::map::grid::Grid;
use crate::matching::ScanModel;
use crate::motion::{Odometry, OdometryModel};
use crate::random::Stream;
use crate::rbpf::Particle;
use crate::sensor::Scan;

/// x_t ~ p(x_t | x_{t−1}, u_t), with ln w += ln p(z_t | x_t, m): prior and proposal cancel.
#[derive(Clone, Debug)]
pub struct FromMotion {
    /// Noise of the odometry.
    pub motion: OdometryModel,
    /// Likelihood of a scan.
    pub scan: ScanModel,
}

impl Proposal<Grid> for FromMotion {
    type Control = Odometry;

    fn propose(&self, particle: &Particle<Grid>, u: &Odometry, scan: &Scan, stream: &mut Stream) -> Proposed {
        let pose = self.motion.sample(&particle.world_from_robot, u, stream);
        let log_increment = self.scan.log_likelihood(&particle.map, &pose, scan);
        Proposed { world_from_robot: pose, log_increment, trace: ProposalTrace::Motion }
    }
}
