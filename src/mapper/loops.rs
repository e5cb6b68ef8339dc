//! What became of the places that a path comes back to.

use super::agreement::Agreement;
use crate::geometry::Relation;
#[cfg(feature = "serde")]
use crate::save::{self, RestoreError};

/// A place that a path comes back to after a loop.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Loop {
    /// Step of the filter at which the robot was there first.
    pub from: usize,
    /// Step at which it was back; of a loop that stays open, the last one of which that is known.
    pub to: usize,
    /// What became of it.
    pub end: LoopEnd,
}

/// What became of a loop.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LoopEnd {
    /// Its ends met as the path was.
    Met,
    /// The path was bent until they met.
    Bent {
        /// How far the later end moved \[m\].
        shift: f64,
        /// How much better the scans of the last metres fit there than where they were \[nats an end point, tempered\].
        gain: f64,
        /// Gain at the second-best place \[nats an end point, tempered\].
        second: f64,
    },
    /// Where the path has the robot, this share of the end points of the last metres, 0 to 1, lies in what the map of before knows to be free;
    /// and no other place was found beyond doubt.
    Open {
        /// The share.
        disputed: f64,
    },
}

impl Loop {
    /// Whether its ends do not meet.
    pub fn is_open(&self) -> bool {
        matches!(self.end, LoopEnd::Open { .. })
    }
}

/// What a path has come back to.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Account {
    pub(super) loops: Vec<Loop>,
    /// Those that are closed.
    pub(super) relations: Vec<Relation>,
    /// End points of which the map of before knew something, and those of them that it contradicts.
    compared: [f64; 2],
    /// How many checks in a row, the last one included, found it contradicted.
    doubts: u32,
}

impl Account {
    /// Share of the end points, 0 to 1, that lay where the map of before knew the space to be free.
    pub(super) fn disputed(&self) -> f64 {
        self.compared[1] / self.compared[0].max(1.0)
    }

    /// End points of which the map of before knew something.
    pub(super) fn seen_again(&self) -> f64 {
        self.compared[0]
    }

    /// The last metres agree with the map of before, and close this loop.
    pub(super) fn agrees(&mut self, agreement: &Agreement, closed: Option<Relation>) {
        self.compare(agreement);
        self.doubts = 0;
        if let Some(relation) = closed {
            self.close(relation, LoopEnd::Met);
        }
    }

    /// The map of before contradicts the last metres. A loop of which that is said once may have met people, or a door.
    pub(super) fn contradicts(&mut self, agreement: &Agreement, back: Option<Relation>) {
        self.compare(agreement);
        let Some(Relation { from, to, .. }) = back else {
            self.doubts = 0;
            return;
        };
        self.doubts += 1;
        let end = LoopEnd::Open { disputed: agreement.disputed() };
        match self.loops.last_mut() {
            Some(last) if self.doubts > 2 => (last.to, last.end) = (to, end),
            _ if self.doubts == 2 => self.loops.push(Loop { from, to, end }),
            _ => {}
        }
    }

    /// The path was bent.
    pub(super) fn bent(&mut self, relation: Relation, end: LoopEnd) {
        self.doubts = 0;
        self.close(relation, end);
    }

    /// What was open on the way is no longer.
    fn close(&mut self, relation: Relation, end: LoopEnd) {
        self.loops.retain(|one| !one.is_open() || one.to < relation.from);
        self.relations.push(relation);
        self.loops.push(Loop { from: relation.from, to: relation.to, end });
    }

    /// Whether this can be of a path of so many steps.
    #[cfg(feature = "serde")]
    pub(super) fn check(&self, steps: usize) -> Result<(), RestoreError> {
        let mut ends =
            self.relations.iter().map(|one| (one.from, one.to)).chain(self.loops.iter().map(|one| (one.from, one.to)));
        let are_known = ends.all(|(from, to)| from <= to && to <= steps);
        save::holds(are_known, "closings.accounts", "of steps so far")?;
        let numbers = self.loops.iter().flat_map(|one| match one.end {
            LoopEnd::Met => [0.0; 3],
            LoopEnd::Bent { shift, gain, second } => [shift, gain, second],
            LoopEnd::Open { disputed } => [disputed; 3],
        });
        let between = self.relations.iter().flat_map(|one| [one.between.x, one.between.y, one.between.theta]);
        save::finite("closings.accounts", numbers.chain(between).chain(self.compared))
    }

    fn compare(&mut self, agreement: &Agreement) {
        let [known, contradicted] = agreement.counts();
        self.compared = [self.compared[0] + known, self.compared[1] + contradicted];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;

    /// A tenth of the end points are unknown; of the others so many contradict.
    fn seen(contradict: usize) -> Agreement {
        let [wall, unknown, free] = [-0.1, -1.07, -2.0];
        Agreement::of(&[vec![unknown; 10], vec![free; contradict], vec![wall; 90 - contradict]].concat())
    }

    fn back(from: usize, to: usize) -> Relation {
        Relation { from, to, between: Pose2::default() }
    }

    #[test]
    fn a_loop_is_open_once_it_is_contradicted_twice_in_a_row() {
        let mut account = Account::default();
        account.contradicts(&seen(45), Some(back(0, 50)));
        account.agrees(&seen(0), None);
        account.contradicts(&seen(45), Some(back(3, 60)));
        assert!(account.loops.is_empty(), "people, or a door: {:?}", account.loops);
        account.contradicts(&seen(30), Some(back(4, 65)));
        account.contradicts(&seen(60), Some(back(5, 70)));
        let [Loop { from: 4, to: 70, end: LoopEnd::Open { disputed } }] = account.loops[..] else {
            panic!("{:?}", account.loops)
        };
        assert!((disputed - 60.0 / 90.0).abs() < 1e-12, "{disputed}");
        assert!((account.disputed() - (45.0 + 45.0 + 30.0 + 60.0) / 450.0).abs() < 1e-12, "{}", account.disputed());
    }

    #[test]
    fn a_path_that_meets_itself_at_the_next_check_has_left_nothing_open() {
        let mut account = Account::default();
        account.contradicts(&seen(45), Some(back(0, 50)));
        account.contradicts(&seen(45), Some(back(0, 55)));
        account.agrees(&seen(0), Some(back(20, 60)));
        assert_eq!(account.loops, [Loop { from: 20, to: 60, end: LoopEnd::Met }]);
    }

    #[test]
    fn a_loop_that_is_closed_closes_what_was_open_on_the_way() {
        let mut account = Account::default();
        for to in [20, 25, 40, 45, 90, 95] {
            if to == 40 {
                account.agrees(&seen(0), None);
            }
            if to == 90 {
                account.agrees(&seen(0), None);
                account.agrees(&seen(0), Some(back(30, 60)));
            }
            account.contradicts(&seen(45), Some(back(2, to)));
        }
        let open: Vec<usize> = account.loops.iter().filter(|one| one.is_open()).map(|one| one.to).collect();
        assert_eq!(open, [25, 95]);
        let end = LoopEnd::Bent { shift: 2.0, gain: 0.4, second: 0.1 };
        account.bent(back(50, 100), end);
        let ends: Vec<(usize, bool)> = account.loops.iter().map(|one| (one.to, one.is_open())).collect();
        assert_eq!(ends, [(25, true), (60, false), (100, false)]);
        assert_eq!(account.relations, [back(30, 60), back(50, 100)]);
    }
}
