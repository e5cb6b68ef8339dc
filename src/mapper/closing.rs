//! Loops that no particle closes by itself.
//!
//! On a long loop a path drifts, however well each scan fits upon those before it, and M particles reach no further than what they have drawn.
//! Where the robot comes back, the nearest of them may be off by more than a matcher finds, and all map the building a second time
//! beside the first. So every few metres the scans of the last metres are held, as one rigid picture, against the map as it was before what
//! they show came in sight. Where end points lie in what that map knows to be free, the picture is searched for as far as the path
//! may have drifted by its own covariance, up to 12 m to each side. If it fits somewhere else much better than here and than
//! anywhere else, the path is bent until it ends there, each motion by its share, with the loops closed so far as they are ([`Chain::bent`]); and
//! it is mapped again.
//!
//! A loop whose ends seem to meet is searched for just so, and counts as closed only if the picture fits nowhere else nearly as well. Along a corridor with doors
//! that look alike a path may be off by one door and agree with the map; closed there, it would be taken as certain, and the right place be
//! out of reach when the next corner shows it.
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

pub(super) use config::CLOSING;

use super::Filter;
use super::agreement::{AGREEMENT, Agreement};
use super::loops::{Account, Loop, LoopEnd};
use super::models::{Map, score};
use crate::geometry::{Chain, Gaussian3, Pose2, Relation, driven};
use crate::map::ConditionalMap;
use crate::matching::{Score, ScoredPose, hill_climb};
use crate::ops;
use crate::order::sorted;
use crate::particle::Particle;
use crate::proposal::{CorrelativeSearch, Search, Target};
#[cfg(feature = "serde")]
use crate::save::{self, RestoreError};
use crate::sensor::Scan;
use nalgebra::Matrix3;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

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
    /// How the scans are kept.
    keeping: Keeping,
}

/// Which scans are kept: all of the last metres, and of those before them every 2ⁿ-th, with n as small as the bound allows.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Keeping {
    /// n.
    halvings: u32,
    /// How many are kept.
    kept: usize,
    /// The scans before this step are not of the last metres.
    past: usize,
}

/// A scan that the filter took.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct View {
    /// Metres driven up to here, by odometry.
    way: f64,
    /// Distance within which nine of ten beams end that met something \[m\].
    reach: f64,
    /// `None` of one that is not kept.
    #[cfg_attr(feature = "serde", serde(with = "shared"))]
    scan: Option<Arc<KeptScan>>,
    /// Whether the maps before it were marked.
    marked: bool,
}

/// A scan, in single precision: it is kept as long as the mapper is.
#[derive(Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct KeptScan {
    origin: [f32; 2],
    hits: Box<[[f32; 2]]>,
    misses: Box<[[f32; 2]]>,
}

impl KeptScan {
    fn new(scan: &Scan) -> Self {
        let single = |point: &[f64; 2]| point.map(|c| c as f32);
        let keep = |ends: &[[f64; 2]]| ends.iter().map(single).collect();
        Self { origin: single(&scan.origin), hits: keep(&scan.hits), misses: keep(&scan.misses) }
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&*self.hits) + size_of_val(&*self.misses)
    }

    fn scan(&self) -> Scan {
        let ends = |kept: &[[f32; 2]]| kept.iter().map(|end| end.map(f64::from)).collect();
        Scan { origin: self.origin.map(f64::from), hits: ends(&self.hits), misses: ends(&self.misses) }
    }
}

/// The particles' maps after a step.
#[derive(Clone, Debug)]
struct Before {
    step: usize,
    maps: Vec<Map>,
}

/// A path that closes a loop, and its map as far as it is mapped again.
#[derive(Clone, Debug)]
struct Correction {
    relation: Relation,
    end: LoopEnd,
    /// Poses up to the end of the loop. The motions since are as the particle makes them.
    bent: Vec<Pose2>,
    map: Map,
    /// Of the first so many scans.
    mapped: usize,
    /// The maps of [`Closings::before`] as they would have been, by step.
    before: Vec<(usize, Map)>,
}

impl Correction {
    /// The pose of a step, of a particle with these poses as it has them.
    fn pose(&self, poses: &[Pose2], step: usize) -> Pose2 {
        let last = self.bent.len() - 1;
        if step <= last { self.bent[step] } else { self.bent[last].compose(&poses[last].between(&poses[step])) }
    }

    /// Maps so many more scans, and no more than there are; tells whether all of them are mapped.
    fn advance(&mut self, closings: &Closings, poses: &[Pose2], scans: usize) -> bool {
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
    fn particle(&self, particle: &Particle<Map>, poses: &[Pose2]) -> Particle<Map> {
        let corrected: Vec<Pose2> = (0..poses.len()).map(|step| self.pose(poses, step)).collect();
        let same = corrected.iter().zip(poses).take_while(|(corrected, pose)| corrected == pose).count();
        let mut path = particle.path.back().nth(poses.len() - same).expect("the first pose stays").clone();
        corrected[same..].iter().for_each(|pose| path.push(*pose));
        Particle { world_from_robot: path.pose(), map: self.map.clone(), path }
    }
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
    /// A scan that the filter took after so many metres, where at most so many are kept.
    pub(super) fn take(&mut self, scan: &Scan, driven: f64, most: usize) {
        let way = self.views.last().map_or(0.0, |last| last.way) + driven;
        let [x0, y0] = scan.origin;
        let mut distances: Vec<f64> = scan.hits.iter().map(|[x, y]| ops::hypot(x - x0, y - y0)).collect();
        distances.sort_unstable_by(f64::total_cmp);
        let reach = distances.get(distances.len() * 9 / 10).copied().unwrap_or(0.0);
        let marked = core::mem::take(&mut self.marked);
        self.views.push(View { way, reach, scan: Some(KeptScan::new(scan).into()), marked });
        self.keep(most);
    }

    /// Lets go of scans, so that at most so many are kept: not of the first, and of the last metres of no more than half of the bound allows.
    fn keep(&mut self, most: usize) {
        let now = self.views.len() - 1;
        self.keeping.kept += 1;
        while self.way(self.keeping.past, now) >= CLOSING.window || now - self.keeping.past >= most / 2 {
            self.let_go(self.keeping.past);
            self.keeping.past += 1;
        }
        while self.keeping.kept > most {
            self.keeping.halvings += 1;
            (0..self.keeping.past).for_each(|step| self.let_go(step));
        }
    }

    /// Lets go of the scan of a step, if it is not the 2ⁿ-th.
    fn let_go(&mut self, step: usize) {
        if !step.is_multiple_of(1 << self.keeping.halvings) && self.views[step].scan.take().is_some() {
            self.keeping.kept -= 1;
        }
    }

    /// How many of the scans that the filter took are kept, how many it took, and the bytes of those that are kept.
    pub(super) fn kept_scans(&self) -> [usize; 3] {
        let bytes = self.views.iter().flat_map(|view| &view.scan).map(|scan| scan.bytes()).sum::<usize>();
        [self.keeping.kept, self.views.len(), bytes + size_of_val(&self.views[..])]
    }

    /// The particles' maps are marked now: [`Map::mark`].
    pub(super) fn mark(&mut self) {
        self.marked = true;
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

    /// Whether no scan has met anything.
    pub(super) fn met_nothing(&self) -> bool {
        self.views.iter().all(|view| view.reach == 0.0)
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

    /// Steps of the last metres, the newest first.
    fn last_steps(&self, now: usize) -> impl Iterator<Item = usize> {
        (0..=now).rev().take_while(move |step| self.way(*step, now) < CLOSING.window)
    }

    /// Metres driven between two steps.
    fn way(&self, from: usize, to: usize) -> f64 {
        self.views[to].way - self.views[from].way
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
        let is_asked = closed.is_some() || (is_contradicted && searched);
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

    /// The end points of the last metres in the robot's frame, evenly picked. They were seen from many places: no one origin is theirs.
    fn picture(&self, poses: &[Pose2]) -> Scan {
        let now = poses.len() - 1;
        let scans = || self.last_steps(now).filter_map(|step| Some((step, self.views[step].scan.as_ref()?)));
        let count: usize = scans().map(|(_, scan)| scan.hits.len()).sum();
        let ends = scans().flat_map(|(step, scan)| {
            let seen = poses[now].between(&poses[step]);
            scan.hits.iter().map(move |end| (seen, end))
        });
        let picked = ends.step_by(count.div_ceil(CLOSING.picture).max(1));
        Scan { hits: picked.map(|(seen, end)| seen.transform(end.map(f64::from))).collect(), ..Scan::default() }
    }
}

/// Where a particle is, and what it may have come back to.
struct Now<'a> {
    closings: &'a Closings,
    /// Its path.
    poses: &'a [Pose2],
    /// What the robot saw on the last metres, in its frame.
    picture: Scan,
    old: &'a Before,
    /// The particle's map of then.
    map: &'a Map,
    /// The loops that its path has closed.
    relations: &'a [Relation],
}

impl Now<'_> {
    fn step(&self) -> usize {
        self.poses.len() - 1
    }

    fn here(&self) -> Pose2 {
        self.poses[self.step()]
    }

    /// Of the poses from which the old map was drawn the nearest to this one, if it is near.
    fn nearest(&self, to: &Pose2) -> Option<usize> {
        let distances = (0..=self.old.step).map(|step| (self.poses[step].distance(to), step));
        let (distance, step) = distances.reduce(|a, b| if b.0 < a.0 { b } else { a })?;
        (distance < CLOSING.reach).then_some(step)
    }

    /// That the robot is back there at this pose, if the way since is a loop.
    fn relation(&self, to: &Pose2) -> Option<Relation> {
        let from = self.nearest(to)?;
        let way = self.closings.way(from, self.step());
        let is_loop = way > CLOSING.loop_way && way > CLOSING.loop_times * self.poses[from].distance(to);
        is_loop.then(|| Relation { from, to: self.step(), between: self.poses[from].between(to) })
    }

    fn agreement(&self, pose: &Pose2) -> Agreement {
        Agreement::of(&score().log_beams(self.map, pose, &self.picture))
    }

    /// The loop that is closed as the path is, if that is beyond doubt and some metres after the last one.
    fn closed(&self, agreement: &Agreement) -> Option<Relation> {
        let is_sure = agreement.fits >= CLOSING.sure && agreement.is_undisputed();
        let is_new = self.relations.last().is_none_or(|last| self.closings.way(last.to, self.step()) >= CLOSING.apart);
        self.relation(&self.here()).filter(|_| is_sure && is_new)
    }

    /// The loop that was missed, and the path that closes it, where the robot is at this place.
    fn bent(&self, place: &Pose2) -> Option<(Relation, Vec<Pose2>)> {
        let relation = self.relation(place)?;
        let relations: Vec<Relation> = self.relations.iter().copied().chain([relation]).collect();
        Some((relation, chain(self.poses).bent(&relations)?))
    }

    /// Where the robot may be as far as matching and the loops so far know.
    fn prior(&self) -> Option<Gaussian3> {
        let from = self.nearest(&self.here())?;
        let covariance = chain(self.poses).covariance(self.relations, from, self.step())?;
        let (sin, cos) = ops::sin_cos(self.poses[from].theta);
        let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        Gaussian3::new(self.here(), turn * covariance * turn.transpose())
    }

    /// Where the picture fits the old map, and nowhere else nearly as well.
    fn search(&self) -> Place {
        let Some(prior) = self.prior() else { return Place::Unclear };
        let (score, here) = (score(), self.here());
        // A climb asks which of two poses is better, for which every second end point will do.
        let target = Target::new(&prior, score.near(self.map, &here, &self.picture, 2), 0.0);
        let climbed = |start| hill_climb(start, CLOSING.climb, |pose, floor| target.log_posterior(pose, floor));
        let starts = CLOSING.search.starts(&target).poses;
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
enum Place {
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

/// A path with the uncertainty that matching leaves: it grows with the root of the way, and a turn of a radian counts as a metre. What a path
/// was bent by before is not taken off.
fn chain(poses: &[Pose2]) -> Chain<'_> {
    /// What is left where the robot did not move \[m, rad\].
    const LEAST: [f64; 2] = [1e-4, 1e-5];
    let stds = |motion: &Pose2| {
        let [way, turn] = driven(motion);
        let [position, heading] = CLOSING.drift;
        let position = position * way.sqrt() + LEAST[0];
        [position, position, heading * (way + turn).sqrt() + LEAST[1]]
    };
    Chain::new(poses, stds, CLOSING.relation)
}

/// Marks the heaviest slots, of equals the lower.
fn heaviest(weights: &[f64], count: usize) -> Vec<bool> {
    let is_ahead = |of: usize, other: usize| weights[other].total_cmp(&weights[of]).then(of.cmp(&other)).is_gt();
    let slots = 0..weights.len();
    slots.clone().map(|of| slots.clone().filter(|other| is_ahead(of, *other)).count() < count).collect()
}

/// What is behind an [`Arc`] of its own, if it is there.
#[cfg(feature = "serde")]
mod shared {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::sync::Arc;

    pub fn serialize<T: Serialize, S: Serializer>(shared: &Option<Arc<T>>, serializer: S) -> Result<S::Ok, S::Error> {
        shared.as_deref().serialize(serializer)
    }

    pub fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Arc<T>>, D::Error> {
        Ok(Option::deserialize(deserializer)?.map(Arc::new))
    }
}

/// [`Closings`] without the maps, which share tiles with those of the particles.
#[cfg(feature = "serde")]
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub(super) struct SavedClosings {
    views: Vec<View>,
    /// Steps of the maps of before.
    before: Vec<usize>,
    accounts: Vec<Account>,
    corrections: Vec<Option<SavedCorrection>>,
    checked: usize,
    bent: u32,
    marked: bool,
    keeping: Keeping,
}

/// [`Correction`] without its maps.
#[cfg(feature = "serde")]
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
struct SavedCorrection {
    relation: Relation,
    end: LoopEnd,
    bent: Vec<Pose2>,
    mapped: usize,
    /// Steps of its maps of before.
    before: Vec<usize>,
}

#[cfg(feature = "serde")]
impl Closings {
    /// Without the maps, which are [`Self::maps`].
    pub(super) fn save(&self) -> SavedClosings {
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
            keeping: self.keeping.clone(),
        }
    }

    /// What was saved of a filter with so many particles after so many steps, or before the first scan; with the maps, in the order of [`Self::maps`].
    pub(super) fn restore(
        saved: SavedClosings,
        maps: Vec<Map>,
        particles: usize,
        steps: Option<usize>,
    ) -> Result<Self, RestoreError> {
        let SavedClosings { views, before, accounts, corrections, checked, bent, marked, keeping } = saved;
        let last = steps.unwrap_or(0);
        save::count("closings.views", views.len(), steps.map_or(0, |steps| steps + 1))?;
        for View { way, reach, scan, .. } in &views {
            save::finite("closings.views", [*way, *reach])?;
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
        Ok(Self { before, views, accounts, corrections, checked, bent, marked, keeping })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_heaviest_are_marked_and_of_equals_the_lower() {
        assert_eq!(heaviest(&[0.1, 0.4, 0.1, 0.4], 3), [true, true, false, true]);
        assert_eq!(heaviest(&[1.0], 4), [true]);
    }

    #[test]
    fn a_scan_is_kept_to_less_than_a_millionth_of_its_range() {
        let scan = Scan { origin: [0.6, -0.4], hits: vec![[12.345_678_9, -0.1]], misses: vec![[29.999_999_9, 3.3]] };
        let kept = KeptScan::new(&scan).scan();
        let points = |scan: &Scan| [&[scan.origin][..], &scan.hits, &scan.misses].concat();
        for (kept, given) in points(&kept).iter().zip(&points(&scan)) {
            assert!((0..2).all(|k| (kept[k] - given[k]).abs() <= 1e-7 * given[k].abs()), "{kept:?} {given:?}");
        }
    }
}
