//! Steps of the three filters that two programs work out together, as [`lap::shared`](crate::experiment::lap::shared) has it.

use super::run::Run;
use super::{ALWAYS, NEVER, Policies, SELECTIVE};
use crate::experiment::lap::shared::{NUMBERS, from_numbers, slots, to_numbers};

impl Policies {
    /// The filters that draw in the next step. Until the selective one resamples, it draws what the one that never does draws.
    fn drawing(&self) -> impl Iterator<Item = &Run> {
        [&self.never, &self.always].into_iter().chain(&self.selective)
    }

    /// What a part of two, 0 or 1, of each filter's particles draws in the next step on the lap, one filter after the other; nothing in the middle of
    /// a step.
    pub fn propose(&self, part: usize) -> Vec<f64> {
        let draws = |run: &Run| match run {
            Run::Lap(lap) if self.next.is_empty() => to_numbers(&lap.propose(slots(part, self.setup.particles))),
            _ => Vec::new(),
        };
        self.drawing().flat_map(draws).collect()
    }

    /// [`Self::step`] with what [`Self::propose`] has for both parts. What does not belong to this step is drawn anew.
    pub fn step_by(&mut self, parts: [&[f64]; 2]) {
        let mut proposed = [None, None, None];
        let drawn = |part: usize| slots(part, self.setup.particles).len() * NUMBERS;
        let each: Vec<_> = parts[0].chunks_exact(drawn(0).max(1)).zip(parts[1].chunks_exact(drawn(1).max(1))).collect();
        if self.next.is_empty() && each.len() == self.drawing().count() {
            for (policy, (first, second)) in [NEVER, ALWAYS, SELECTIVE].into_iter().zip(&each) {
                proposed[policy] = Some(from_numbers(&[*first, *second].concat()));
            }
            proposed[SELECTIVE] = proposed[SELECTIVE].take().or_else(|| proposed[NEVER].clone());
        }
        while self.advance_by(&mut proposed) == Some(false) {}
    }
}
