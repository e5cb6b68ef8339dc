//! Loops that no particle closes by itself.
//!
//! On a long loop a path drifts, however well each scan fits upon those before it, and M particles reach no further than what they have drawn.
//! Where the robot comes back, the nearest of them may be off by more than a matcher finds, and all map the building a second time
//! beside the first. So every few metres the scans of the last metres are held, as one rigid picture, against the map as it was before what
//! they show came in sight. Where end points lie in what that map knows to be free, the picture is searched for as far as the path
//! may have drifted by its own covariance, up to 12 m to each side. If it fits somewhere else much better than here and than
//! anywhere else, the path is bent until it ends there, each motion by its share, with the loops closed so far as they are
//! ([`Chain::bent`](crate::geometry::Chain::bent)); and it is mapped again.
//!
//! A loop whose ends seem to meet is searched for just so, and counts as closed only if the picture fits nowhere else nearly as well. Along a corridor with doors
//! that look alike a path may be off by one door and agree with the map; closed there, it would be taken as certain, and the right place be
//! out of reach when the next corner shows it.
//!
//! Where a step of odometry was doubted, the path may be off by as much as lies between the places that were in question; where a scan met nothing, by what wheels
//! err. Until a loop is closed over such a step, what the robot sees is searched for as far, even where nothing contradicts: a copy of the building that is
//! drawn beside it contradicts nothing. And it is at that step that the path gives way most.
//!
//! This is a heuristic. Weights are not changed, as if the move left the posterior as it is: a motion's share is within what matching leaves open,
//! so that the scans on the way fit about as they did. A particle that is bent to a wrong place contradicts what it sees next, and its weight
//! falls. Mapping again takes as long as the mapping so far, once for each path that is bent; it may be spread over the scans that follow, and the
//! path is corrected when all are mapped ([`Correction`]).
//!
//! References: Gutmann and Konolige, *Incremental mapping of large cyclic environments*, CIRA 1999 (the last scans as one picture, found again by
//! correlation); Lu and Milios 1997 (bending the path); Gilks and Berzuini, *Following a moving target: Monte Carlo inference for dynamic
//! Bayesian models*, JRSS B 2001 (moving particles between steps).

mod config;
mod correction;
mod kept;
mod place;
#[cfg(feature = "serde")]
mod saved;

pub(super) use config::CLOSING;
#[cfg(feature = "serde")]
pub(super) use saved::SavedClosings;

use self::correction::Correction;
use self::kept::{Keeping, View};
use self::place::{Now, Place};
use super::Filter;
use super::agreement::{AGREEMENT, Agreement};
use super::loops::{Account, Loop};
use super::models::Map;
use crate::geometry::Relation;
use crate::ops;
use crate::particle::Particle;
use std::collections::VecDeque;
use std::sync::Mutex;

/// What finds the loops that were missed, and closes them: all scans, and maps of before.
#[derive(Clone, Debug, Default)]
pub(super) struct Closings {
    /// By step of the filter, from the first scan on.
    views: Vec<View>,
    /// The oldest first.
    before: VecDeque<Before>,
    /// By slot, what its path has come back to.
    accounts: Vec<Account>,
    /// By slot, the path that will be the particle's as soon as it is mapped; empty where no path ever was.
    corrections: Vec<Option<Correction>>,
    /// Step of the last check.
    checked: usize,
    /// Particles that were bent.
    bent: u32,
    /// Whether the maps were marked since the last view.
    marked: bool,
    /// Standard deviations of position and heading \[m, rad\] that steps since the last view add, where they were doubted or nothing was seen; 0 else.
    doubt: [f64; 2],
    /// How the scans are kept.
    keeping: Keeping,
}

/// The particles' maps after a step.
#[derive(Clone, Debug)]
struct Before {
    step: usize,
    maps: Vec<Map>,
}

/// What a check found of a particle.
enum Found {
    /// It is nowhere back.
    Nothing,
    /// What it sees agrees with the map of before; and the loop that is closed by it.
    Agrees(Agreement, Option<Relation>),
    /// That map contradicts what it sees; and the loop of which that may be the end.
    Contradicts(Agreement, Option<Relation>),
    /// A loop that was missed: the path that closes it, of which nothing is mapped yet.
    Missed(Correction),
}

impl Closings {
    /// The particles' maps are marked now: [`Map::mark`].
    pub(super) fn mark(&mut self) {
        self.marked = true;
    }

    /// The pose of the next view may be off by this much besides: standard deviations of position and heading \[m, rad\].
    pub(super) fn doubt(&mut self, stds: [f64; 2]) {
        self.doubt = [0, 1].map(|k| ops::hypot(self.doubt[k], stds[k]));
    }

    /// Particles have become copies of those in these slots.
    pub(super) fn resampled(&mut self, ancestors: &[u32]) {
        fn copied<T: Clone>(of: &[T], ancestors: &[u32]) -> Vec<T> {
            ancestors.iter().map(|slot| of[*slot as usize].clone()).collect()
        }
        self.before.iter_mut().for_each(|before| before.maps = copied(&before.maps, ancestors));
        if !self.accounts.is_empty() {
            self.accounts = copied(&self.accounts, ancestors);
        }
        if !self.corrections.is_empty() {
            self.corrections = copied(&self.corrections, ancestors);
        }
    }

    /// How many times a particle's path was bent.
    pub(super) fn bent(&self) -> u32 {
        self.bent
    }

    /// What the path in this slot has come back to, and the share of what it saw there that the map of before contradicts.
    pub(super) fn of(&self, slot: usize) -> (&[Loop], f64) {
        self.accounts.get(slot).map_or((&[], 0.0), |account| (&account.loops, account.disputed()))
    }

    /// How many end points were compared with the map of before on the path of a slot.
    pub(super) fn seen_again(&self, slot: usize) -> f64 {
        self.accounts.get(slot).map_or(0.0, Account::seen_again)
    }

    /// The maps that are kept besides those of the particles: of before, and of paths that are being corrected.
    pub(super) fn maps(&self) -> impl Iterator<Item = &Map> {
        let of_corrections = self
            .corrections
            .iter()
            .flatten()
            .flat_map(|correction| correction.before.iter().map(|(_, map)| map).chain([&correction.map]));
        self.before.iter().flat_map(|before| &before.maps).chain(of_corrections)
    }

    /// Looks for loops every few metres, and corrects the paths of the heaviest particles that have missed one, for which so many scans are mapped again.
    pub(super) fn check(&mut self, filter: &mut Filter, budget: usize) {
        let now = self.views.len() - 1;
        let is_due = self.way(self.checked, now) >= CLOSING.every;
        if is_due {
            self.checked = now;
            self.find(filter, now);
        }
        self.correct(filter, budget);
        if is_due && self.before.back().is_none_or(|last| self.way(last.step, now) >= CLOSING.spacing) {
            let maps = filter.particles().iter().map(|particle| particle.map.present()).collect();
            self.before.push_back(Before { step: now, maps });
        }
    }

    /// Maps paths again that close a loop: so many scans, which they share. A path that is mapped as far as the robot is takes the place of the particle's.
    pub(super) fn correct(&mut self, filter: &mut Filter, budget: usize) {
        let pending = self.corrections.iter().flatten().count();
        if pending == 0 {
            return;
        }
        // The robot goes on by a scan meanwhile, and is caught up with.
        let share = (budget / pending).max(2);
        self.make_room(filter, share);
        let corrections: Vec<_> = core::mem::take(&mut self.corrections).into_iter().map(Mutex::new).collect();
        let corrected = filter.revise(|slot, particle| {
            let mut correction = corrections[slot].lock().expect("no thread panics with it");
            let Some(correction) = &mut *correction else { return (None, false) };
            let poses = particle.path.poses();
            let is_done = correction.advance(self, &poses, share);
            (is_done.then(|| correction.particle(particle, &poses)), is_done)
        });
        for (slot, (correction, is_done)) in corrections.into_iter().zip(corrected).enumerate() {
            let mut correction = correction.into_inner().expect("no thread panics with it");
            if let Some(Correction { relation, end, before: maps, .. }) = correction.take_if(|_| is_done) {
                self.accounts[slot].bent(relation, end);
                for (step, map) in maps {
                    if let Some(before) = self.before.iter_mut().find(|before| before.step == step) {
                        before.maps[slot] = map;
                    }
                }
                self.bent += 1;
            }
            self.corrections.push(correction);
        }
    }

    /// Lets go of the maps of paths whose corrections end with so many more scans each: the new ones need as much room.
    fn make_room(&mut self, filter: &mut Filter, share: usize) {
        for (slot, map) in filter.maps_mut().enumerate() {
            let Some(correction) = &self.corrections[slot] else { continue };
            if correction.mapped.saturating_add(share) >= self.views.len() {
                *map = map.blank();
                for k in 0..self.before.len() {
                    self.before[k].maps[slot].clone_from(map);
                }
            }
        }
    }

    /// Looks at what the robot has come back to.
    fn find(&mut self, filter: &mut Filter, now: usize) {
        let particles = filter.particles().len();
        self.accounts.resize(particles, Account::default());
        self.corrections.resize_with(particles, || None);
        let reach = self.last_steps(now).map(|step| self.views[step].reach).fold(0.0, f64::max);
        let least = CLOSING.window + reach.min(CLOSING.farthest);
        let is_old = |before: &Before| self.way(before.step, now) >= least;
        // The newest of the old ones, and all that are newer.
        let old = self.before.iter().filter(|before| is_old(before)).count();
        self.before.drain(..old.saturating_sub(1));
        if old > 0 {
            let heavy = heaviest(filter.weights().as_slice(), CLOSING.searched);
            let found = filter.revise(|slot, particle| (None, self.look(slot, particle, heavy[slot])));
            for (slot, found) in found.into_iter().enumerate() {
                let account = &mut self.accounts[slot];
                match found {
                    Found::Nothing => {}
                    Found::Agrees(agreement, closed) => account.agrees(&agreement, closed),
                    Found::Contradicts(agreement, back) => account.contradicts(&agreement, back),
                    Found::Missed(correction) => self.corrections[slot] = Some(correction),
                }
            }
        }
    }

    /// Whether this particle is back somewhere, and the path that closes the loop, if it has missed that and is `searched` for.
    fn look(&self, slot: usize, particle: &Particle<Map>, searched: bool) -> Found {
        if self.corrections[slot].is_some() {
            return Found::Nothing;
        }
        let poses = particle.path.poses();
        let now = Now {
            closings: self,
            picture: self.picture(&poses),
            old: &self.before[0],
            map: &self.before[0].maps[slot],
            relations: &self.accounts[slot].relations,
            poses: &poses,
        };
        if now.picture.hits.len() < CLOSING.picture / 4 || now.nearest(&now.here()).is_none() {
            return Found::Nothing;
        }
        let agreement = now.agreement(&now.here());
        let is_contradicted = agreement.disputed() >= AGREEMENT.disputed;
        let closed = now.closed(&agreement).filter(|_| !is_contradicted);
        let is_asked = closed.is_some() || searched && (is_contradicted || now.is_doubted());
        match if is_asked { now.search() } else { Place::Unclear } {
            Place::Elsewhere(pose, end) if searched => {
                if let Some((relation, bent)) = now.bent(&pose) {
                    let map = particle.map.blank();
                    return Found::Missed(Correction { relation, end, bent, map, mapped: 0, before: Vec::new() });
                }
            }
            Place::Here if !is_contradicted => return Found::Agrees(agreement, closed),
            _ => {}
        }
        if is_contradicted {
            Found::Contradicts(agreement, now.relation(&now.here()))
        } else {
            Found::Agrees(agreement, None)
        }
    }
}

/// Marks the heaviest slots, of equals the lower.
fn heaviest(weights: &[f64], count: usize) -> Vec<bool> {
    let is_ahead = |of: usize, other: usize| weights[other].total_cmp(&weights[of]).then(of.cmp(&other)).is_gt();
    let slots = 0..weights.len();
    slots.clone().map(|of| slots.clone().filter(|other| is_ahead(of, *other)).count() < count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_heaviest_are_marked_and_of_equals_the_lower() {
        assert_eq!(heaviest(&[0.1, 0.4, 0.1, 0.4], 3), [true, true, false, true]);
        assert_eq!(heaviest(&[1.0], 4), [true]);
    }
}
