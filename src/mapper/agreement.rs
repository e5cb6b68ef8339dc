//! Whether what was seen agrees with a map.

/// Constants of what counts as agreement.
pub(super) struct AgreementConfig {
    /// What an end point adds to a score where it lies on a wall, at the least \[nats, before tempering\]: three
    /// quarters of what an end point far from any wall loses.
    pub on_a_wall: f64,
    /// What an end point adds to a score where it lies in space that was seen to be free, at the most \[nats, before tempering\]: by one beam
    /// that passed. In unknown space it is −1.07.
    in_free_space: f64,
    /// Share of the end points of which the map knows anything that lies in free space where a loop was missed. Less than half of it is
    /// hardly anything: people and doors.
    pub disputed: f64,
}

/// See [`AgreementConfig`].
pub(super) const AGREEMENT: AgreementConfig = AgreementConfig { on_a_wall: -0.75, in_free_space: -1.3, disputed: 0.25 };

/// How well a picture agrees with a map.
pub(super) struct Agreement {
    /// Share of the end points that lie on a wall.
    pub(super) fits: f64,
    /// Share of those that lie where it was seen to be free.
    contradicts: f64,
    /// How many there are.
    count: f64,
}

impl Agreement {
    /// Of what each end point adds to a score \[nats\].
    pub(super) fn of(beams: &[f64]) -> Self {
        let share = |is: fn(f64) -> bool| beams.iter().filter(|log| is(**log)).count() as f64 / beams.len() as f64;
        Self {
            fits: share(|log| log > AGREEMENT.on_a_wall),
            contradicts: share(|log| log < AGREEMENT.in_free_space),
            count: beams.len() as f64,
        }
    }

    /// Whether hardly anything is disputed.
    pub(super) fn is_undisputed(&self) -> bool {
        self.disputed() < 0.5 * AGREEMENT.disputed
    }

    /// How many end points the map knows something about, and how many of them contradict.
    pub(super) fn counts(&self) -> [f64; 2] {
        [(self.fits + self.contradicts) * self.count, self.contradicts * self.count]
    }

    /// Share of the end points that contradict, of those of which the map knows anything.
    pub(super) fn disputed(&self) -> f64 {
        let known = self.fits + self.contradicts;
        if known > 0.0 { self.contradicts / known } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::models::{Map, grid, score};
    use super::*;
    use crate::geometry::Pose2;
    use crate::map::ConditionalMap;
    use crate::sensor::Scan;

    #[test]
    fn a_map_that_knows_nothing_of_a_picture_disputes_none_of_it() {
        let [wall, unknown, free] = [-0.1, -1.07, -2.0];
        let strange = Agreement::of(&[unknown; 4]);
        assert_eq!([strange.fits, strange.contradicts, strange.disputed()], [0.0; 3]);
        let missed = Agreement::of(&[wall, unknown, unknown, free, free, free, wall, free]);
        assert_eq!([missed.fits, missed.contradicts, missed.disputed()], [0.25, 0.5, 2.0 / 3.0]);
    }

    /// By what a beam adds where the mapper's score knows one of three things.
    #[test]
    fn what_is_unknown_lies_neither_on_a_wall_nor_in_free_space() {
        // Along the middle of a row of NDT cells, by which space is judged.
        let (mut map, pose) = (Map::new(grid(0.05)), Pose2::new(0.02, 0.12, 0.0));
        let ahead = Scan { hits: vec![[3.0, 0.0]], ..Scan::default() };
        map.assimilate(&pose, &ahead, &());
        let points = Scan { hits: vec![[3.0, 0.02], [5.0, 0.0], [1.0, 0.0]], ..Scan::default() };
        let beams = score().log_beams(&map, &pose, &points);
        let kinds =
            beams.iter().map(|log| [*log > AGREEMENT.on_a_wall, *log < AGREEMENT.in_free_space]).collect::<Vec<_>>();
        assert_eq!(kinds, [[true, false], [false, false], [false, true]], "{beams:?}");
    }
}
