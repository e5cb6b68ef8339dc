//! The [mapper](fastslam::mapper) in worlds that ask more of it than [`Example`] does: worse wheels, worse lasers, people, and corridors
//! in which there is little to see.
//!
//! A change to the filter that pleases one building is to be held against all of these. The truth is known: errors are by the
//! benchmark's metric against the true relations.

use super::log::{Example, Recipe};
use crate::world::FloorPlan;
use fastslam::error::SettingError;
use fastslam::execute::Executor;
use fastslam::mapper::{LaserMapper, LaserMapperSettings, Replay};
use fastslam_log::{LaserLog, Relation, RelationErrors, relation_errors};
use std::sync::Arc;

/// A world and a robot by name.
#[derive(Clone, PartialEq, Debug)]
pub struct Variant {
    /// Its name on the command line.
    pub name: &'static str,
    /// What sets it apart, in a few words.
    pub title: &'static str,
    /// How its logs come about; the seed is another for each run.
    pub recipe: Recipe,
}

/// The example's own world first, then those in which one thing is worse, then several at once.
pub fn variants() -> Vec<Variant> {
    let base = Recipe::building();
    // A laser that sees one or two doors at a time.
    let corridors =
        Recipe { plan: FloorPlan::long_corridors(), route: LONG_ROUTE.to_vec(), max_range: 8.0, ..base.clone() };
    let with = |change: &dyn Fn(&mut Recipe)| {
        let mut recipe = base.clone();
        change(&mut recipe);
        recipe
    };
    let worse_wheels = base.wheels.scaled(3.0);
    [
        ("base", "the example's world", base.clone()),
        ("bias", "wheels turn 0.03 rad/m too far", with(&|r| r.bias = 0.03)),
        ("slip", "wheels slip in a tenth of the steps", with(&|r| r.slip = 0.1)),
        ("wheels", "wheel noise × 3", with(&|r| r.wheels = worse_wheels)),
        ("dense", "361 beams", with(&|r| r.beams = 361)),
        ("sparse", "1 m between scans", with(&|r| r.spacing = 1.0)),
        ("noisy", "ranges ± 0.06 m, wheel noise × 3", with(&|r| (r.range_std, r.wheels) = (0.06, worse_wheels))),
        ("people", "a third of the beams cut short", with(&|r| r.people = 1.0 / 3.0)),
        ("askew-30", "building 30° askew in the cells", with(&|r| r.askew = 30_f64.to_radians())),
        ("askew-45", "building 45° askew in the cells", with(&|r| r.askew = 45_f64.to_radians())),
        ("corridors", "long corridors, 8 m laser", corridors.clone()),
        ("corridors-slip", "the same with slip", Recipe { slip: 0.1, ..corridors }),
    ]
    .into_iter()
    .map(|(name, title, recipe)| Variant { name, title, recipe })
    .collect()
}

/// Through the long corridors \[m\]: round the west block, round both, and home through the middle.
const LONG_ROUTE: [[f64; 2]; 10] = [
    [8.0, 1.3],
    [31.0, 1.3],
    [31.0, 40.7],
    [1.3, 40.7],
    [1.3, 1.3],
    [60.7, 1.3],
    [60.7, 40.7],
    [31.0, 40.7],
    [31.0, 1.3],
    [8.0, 1.3],
];

/// A log of a variant under way, on the calling thread.
#[derive(Clone, Debug)]
pub struct VariantRun {
    replay: Replay<LaserLog>,
    log: Arc<LaserLog>,
    relations: Vec<Relation>,
}

impl VariantRun {
    /// At its start. The seed is that of the world's noises and of the filter's draws.
    ///
    /// # Errors
    /// Where the number of particles is out of its range.
    pub fn new(variant: &Variant, particles: usize, seed: u64) -> Result<Self, SettingError> {
        let settings = LaserMapperSettings { particles, seed, ..LaserMapperSettings::default() };
        let Example { log, relations, .. } = Example::of(&Recipe { seed, ..variant.recipe.clone() }, usize::MAX);
        let log = Arc::new(log);
        let replay = Replay::new(settings, Arc::clone(&log))?.with_executor(Executor::Serial);
        Ok(Self { replay, log, relations })
    }

    /// The mapper, as far as it has come.
    pub fn mapper(&self) -> &LaserMapper {
        self.replay.mapper()
    }

    /// One scan; `false` after the last.
    pub fn step(&mut self) -> bool {
        self.replay.next().is_some()
    }

    /// How far the best path so far is from the true relations.
    pub fn errors(&self) -> RelationErrors {
        relation_errors(&self.mapper().path(), &self.log.odometry, &self.relations)
            .expect("a world of ours has relations")
    }

    /// The same of raw odometry.
    pub fn odometry_errors(&self) -> RelationErrors {
        relation_errors(&self.log.odometry, &self.log.odometry, &self.relations).expect("a world of ours has relations")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::geometry::Pose2;
    use std::collections::BTreeSet;

    #[test]
    fn every_variant_is_a_world_of_its_own_that_raw_odometry_fails_in() {
        let mut logs: Vec<LaserLog> = Vec::new();
        let mut names = BTreeSet::new();
        for variant in variants() {
            let run = VariantRun::new(&variant, 1, 1).unwrap();
            let raw = run.odometry_errors();
            // Beside those between neighbours, as a robot of some loops has.
            let returns = raw.relations as usize + 1 - run.log.scans.len();
            assert!(raw.translation_mean > 0.4 && returns > 50, "{}: {returns} returns, {raw:?}", variant.name);
            assert!(names.insert(variant.name) && !logs.contains(&run.log), "{}", variant.name);
            logs.push(LaserLog::clone(&run.log));
        }
        let other = VariantRun::new(&variants()[0], 1, 2).unwrap();
        assert!(*other.log != logs[0], "the seed is the world's too");
    }

    #[test]
    fn no_robot_drives_through_a_wall() {
        for variant in variants() {
            let truth = Example::of(&variant.recipe, usize::MAX).truth;
            for (k, pair) in truth.windows(2).enumerate() {
                let [dx, dy] = [pair[1].x - pair[0].x, pair[1].y - pair[0].y];
                let free = variant.recipe.plan.raycast([pair[0].x, pair[0].y], fastslam::ops::atan2(dy, dx));
                assert!(free > pair[0].distance(&pair[1]) + 0.1, "{}, step {k}: a wall after {free} m", variant.name);
            }
        }
    }

    #[test]
    fn a_robot_that_starts_askew_turns_on_the_spot_and_goes_the_same_way() {
        let recipe = Recipe { askew: -1.0, ..Recipe::building() };
        let (straight, askew) = (Example::new(20).truth, Example::of(&recipe, 24).truth);
        // −1 rad in steps of up to 15°: four of them.
        assert_eq!(askew[4..], straight[..]);
        for (k, left) in [(0, -1.0), (1, -0.75), (2, -0.5), (3, -0.25)] {
            let turned: Pose2 = straight[0].between(&askew[k]);
            assert!(turned.distance(&Pose2::default()) < 1e-12 && (turned.theta - left).abs() < 1e-12, "{turned:?}");
        }
    }

    #[test]
    fn people_cut_as_many_beams_short_as_they_should_and_slips_are_as_frequent() {
        let (plain, scans) = (Example::new(200), 200.0 * 180.0);
        let people = Example::of(&Recipe { people: 0.25, ..Recipe::building() }, 200);
        let ranges = |example: &Example| -> Vec<f32> {
            example.log.scans.iter().flat_map(|scan| scan.ranges.iter().copied()).collect()
        };
        let cut = ranges(&people).iter().zip(ranges(&plain)).filter(|(a, b)| **a < b - 0.005).count() as f64;
        // Five standard deviations of a share of 36 000, and the few that are cut by less than half a centimetre.
        assert!((cut / scans - 0.25).abs() < 0.0115 + 0.005, "{cut} of {scans}");
        let slips = Example::of(&Recipe { slip: 0.2, ..Recipe::building() }, 200);
        let length =
            |example: &Example, k: usize| example.log.scans[k - 1].odometry.distance(&example.log.scans[k].odometry);
        let longer = (1..200).filter(|k| length(&slips, *k) > length(&plain, *k) + 0.05).count() as f64;
        // Five standard deviations of a share of 199.
        assert!((longer / 199.0 - 0.2).abs() < 0.142, "{longer} of 199");
    }
}
