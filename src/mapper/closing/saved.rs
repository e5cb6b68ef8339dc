//! What is saved of the closing of loops.

use super::correction::Correction;
use super::kept::{Keeping, View};
use super::{Before, Closings};
use crate::geometry::{Pose2, Relation};
use crate::mapper::loops::{Account, LoopEnd};
use crate::mapper::models::Map;
use crate::save::{self, RestoreError};
use serde::{Deserialize, Serialize};

/// [`Closings`] without the maps, which share tiles with those of the particles.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::mapper) struct SavedClosings {
    views: Vec<View>,
    /// Steps of the maps of before.
    before: Vec<usize>,
    accounts: Vec<Account>,
    corrections: Vec<Option<SavedCorrection>>,
    checked: usize,
    bent: u32,
    marked: bool,
    doubt: [f64; 2],
    keeping: Keeping,
}

/// [`Correction`] without its maps.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct SavedCorrection {
    relation: Relation,
    end: LoopEnd,
    bent: Vec<Pose2>,
    mapped: usize,
    /// Steps of its maps of before.
    before: Vec<usize>,
}

impl Closings {
    /// Without the maps, which are [`Self::maps`].
    pub(in crate::mapper) fn save(&self) -> SavedClosings {
        let saved = |correction: &Correction| SavedCorrection {
            relation: correction.relation,
            end: correction.end,
            bent: correction.bent.clone(),
            mapped: correction.mapped,
            before: correction.before.iter().map(|(step, _)| *step).collect(),
        };
        SavedClosings {
            views: self.views.clone(),
            before: self.before.iter().map(|before| before.step).collect(),
            accounts: self.accounts.clone(),
            corrections: self.corrections.iter().map(|one| one.as_ref().map(saved)).collect(),
            checked: self.checked,
            bent: self.bent,
            marked: self.marked,
            doubt: self.doubt,
            keeping: self.keeping.clone(),
        }
    }

    /// What was saved of a filter with so many particles after so many steps, or before the first scan; with the maps, in the order of [`Self::maps`].
    pub(in crate::mapper) fn restore(
        saved: SavedClosings,
        maps: Vec<Map>,
        particles: usize,
        steps: Option<usize>,
    ) -> Result<Self, RestoreError> {
        let SavedClosings { views, before, accounts, corrections, checked, bent, marked, doubt, keeping } = saved;
        let last = steps.unwrap_or(0);
        save::count("closings.views", views.len(), steps.map_or(0, |steps| steps + 1))?;
        save::finite("closings.doubt", doubt)?;
        for View { way, reach, scan, doubt: [position, heading], .. } in &views {
            save::finite("closings.views", [*way, *reach, *position, *heading])?;
            let points = scan.iter().flat_map(|scan| [&scan.origin].into_iter().chain(&scan.hits).chain(&scan.misses));
            save::finite("closings.views", points.flatten().map(|c| f64::from(*c)))?;
        }
        save::holds(views.is_sorted_by_key(|view| view.way), "closings.views", "along the way")?;
        let are_known = |of: &[usize]| of.is_sorted() && of.iter().all(|step| steps.is_some() && *step <= last);
        save::holds(are_known(&before), "closings.before", "in order, and of steps so far")?;
        save::holds(checked <= last, "closings.checked", "a step so far")?;
        save::count("closings.keeping", keeping.kept, views.iter().flat_map(|view| &view.scan).count())?;
        let is_known = keeping.past <= last && keeping.halvings < u32::BITS - 1;
        save::holds(is_known, "closings.keeping", "of steps so far")?;
        let count = accounts.len();
        save::holds(count == 0 || count == particles, "closings.accounts", "one for each particle")?;
        save::count("closings.corrections", corrections.len(), count)?;
        accounts.iter().try_for_each(|account| account.check(last))?;
        let of_corrections = corrections.iter().flatten().map(|one| one.before.len() + 1).sum::<usize>();
        save::count("closings.maps", maps.len(), before.len() * particles + of_corrections)?;
        let mut maps = maps.into_iter();
        let before = before.into_iter().map(|step| Before { step, maps: maps.by_ref().take(particles).collect() });
        let before = before.collect();
        let mut restored = |one: SavedCorrection| {
            let SavedCorrection { relation, end, bent, mapped, before } = one;
            save::poses("closings.corrections", bent.iter().copied().chain([relation.between]))?;
            save::holds(bent.first() == Some(&Pose2::default()), "closings.corrections", "from the origin on")?;
            let is_known = relation.from <= relation.to && relation.to <= last && relation.to + 1 == bent.len();
            save::holds(is_known && mapped <= last && are_known(&before), "closings.corrections", "of steps so far")?;
            let before = before.into_iter().zip(maps.by_ref()).collect();
            let map = maps.next().expect("as many as were counted");
            Ok(Correction { relation, end, bent, map, mapped, before })
        };
        let corrections = corrections.into_iter().map(|one| one.map(&mut restored).transpose());
        let corrections = corrections.collect::<Result<_, RestoreError>>()?;
        Ok(Self { before, views, accounts, corrections, checked, bent, marked, doubt, keeping })
    }
}
