//! Steps in which one particle is led along a given path: what a smoother is made of.

use super::{Rbpf, Report};
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::proposal::Retrace;

impl<M: ConditionalMap, P: Retrace<M>> Rbpf<M, P> {
    /// [`Rbpf::weigh`], but for two things. The last slot does not draw its pose: it takes this one. And every slot pays for the very pose
    /// that it has, so that the weights are those of paths, whoever drew them.
    pub(crate) fn weigh_along(
        &mut self,
        control: &P::Control,
        observation: &M::Observation,
        given: &Pose2,
    ) -> Report<M::Association> {
        let last = self.particles().len() - 1;
        let proposed = self.propose_by(0..last + 1, |proposal, first, particle, streams| {
            let one = |(slot, stream)| {
                if slot == last {
                    proposal.retrace(particle, control, observation, given)
                } else {
                    proposal.draw_and_retrace(particle, control, observation, stream)
                }
            };
            (first..).zip(streams).map(one).collect()
        });
        self.weigh_proposed(control, observation, proposed)
    }
}
