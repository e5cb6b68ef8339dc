//! Laws of maps.
//!
//! Each takes a way to make an empty map, the [`Likelihood`] that says what an observation is taken to be of, observations with the poses
//! they were taken at, and `content`: all that the map says to whoever asks, as something that can be compared.

use crate::geometry::Pose2;
use crate::map::{ConditionalMap, Observed};
use crate::matching::Likelihood;
use crate::sensor::Scan;
use core::borrow::Borrow;
use core::fmt::Debug;

/// A `#[test]` of every law in [`laws::map`](crate::laws::map): `map_laws!(name, empty, likelihood, observations, content)` makes a module
/// `name`. `empty` is a function that makes a [`ConditionalMap`](crate::map::ConditionalMap), `observations` an array or a vector of
/// (pose, observation), `content` a function of a reference to a map.
///
/// ```
/// use fastslam::geometry::Pose2;
/// use fastslam::map::landmarks::{Correspondence, Landmark, Landmarks};
/// use fastslam::nalgebra::Vector2;
/// use fastslam::proposal::Marginal;
/// use fastslam::sensor::{Feature, RangeBearing};
///
/// type Map = Landmarks<RangeBearing>;
///
/// fn empty() -> Map {
///     let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
///     Landmarks::new(sensor, Correspondence::Known)
/// }
///
/// fn observations() -> Vec<(Pose2, Vec<Feature>)> {
///     let sighting = |k: u32| Feature { z: Vector2::new(3.0, 0.1 * f64::from(k)), signature: Some(k % 5) };
///     (0..12).map(|k| (Pose2::new(0.1 * f64::from(k), 0.0, 0.0), vec![sighting(k), sighting(k + 1)])).collect()
/// }
///
/// fn content(map: &Map) -> Vec<(u32, Landmark)> {
///     map.iter().map(|(index, landmark)| (index, *landmark)).collect()
/// }
///
/// fastslam::map_laws!(landmarks, empty, Marginal, observations(), content);
/// ```
#[macro_export]
macro_rules! map_laws {
    ($name:ident, $empty:expr, $likelihood:expr, $observations:expr, $content:expr $(,)?) => {
        $crate::tests_of_laws!(
            $name,
            map,
            [an_observation_changes_the_map, assimilating_is_deterministic, clones_never_see_each_others_writes],
            ($empty, &$likelihood, &$observations, $content)
        );
    };
}

/// Assimilates what was observed, taken for what the likelihood takes it for.
fn assimilate<M: ConditionalMap>(
    map: &mut M,
    likelihood: &impl Likelihood<M>,
    (pose, observation): &(Pose2, Observed<M>),
) {
    let observation = observation.borrow();
    let (_, association) = likelihood.log_likelihood(map, pose, observation);
    map.assimilate(pose, observation, &association);
}

/// A map of its own with all of these.
fn mapped<'a, M: ConditionalMap>(
    empty: &impl Fn() -> M,
    likelihood: &impl Likelihood<M>,
    observations: impl IntoIterator<Item = &'a (Pose2, Observed<M>)>,
) -> M
where
    Observed<M>: 'a,
{
    let mut map = empty();
    observations.into_iter().for_each(|observation| assimilate(&mut map, likelihood, observation));
    map
}

/// p(m | x₁..ₜ, z₁..ₜ) is not p(m): the content is another one after the observations. Without this the laws below say nothing.
///
/// The example of [`map_laws!`](crate::map_laws) shows the arguments.
pub fn an_observation_changes_the_map<M: ConditionalMap, C: PartialEq + Debug>(
    empty: impl Fn() -> M,
    likelihood: &impl Likelihood<M>,
    observations: &[(Pose2, Observed<M>)],
    content: impl Fn(&M) -> C,
) {
    let before = content(&empty());
    assert_ne!(content(&mapped(&empty, likelihood, observations)), before, "the observations changed nothing");
}

/// The same observations make the same map, and the same likelihood \[nats\] of each, bit for bit.
///
/// The example of [`map_laws!`](crate::map_laws) shows the arguments.
pub fn assimilating_is_deterministic<M: ConditionalMap, C: PartialEq + Debug>(
    empty: impl Fn() -> M,
    likelihood: &impl Likelihood<M>,
    observations: &[(Pose2, Observed<M>)],
    content: impl Fn(&M) -> C,
) {
    let [one, other] = [(), ()].map(|()| mapped(&empty, likelihood, observations));
    assert_eq!(content(&one), content(&other), "the same observations made two maps");
    for (k, (pose, observation)) in observations.iter().enumerate() {
        let [a, b] = [&one, &other].map(|map| likelihood.log_likelihood(map, pose, observation.borrow()).0);
        assert_eq!(a.to_bits(), b.to_bits(), "observation {k}: two likelihoods, {a} and {b}, of one map");
    }
}

/// Maps that were cloned from one, and are then written to in turn, hold what maps hold that never shared anything; and so does the one
/// that they were cloned from.
///
/// The first half of the observations goes into the trunk; three clones get the others, each in another order, and then the trunk. Use
/// [`a_family_of_clones_is_independent`] for families of your own.
///
/// The example of [`map_laws!`](crate::map_laws) shows the arguments.
pub fn clones_never_see_each_others_writes<M: ConditionalMap, C: PartialEq + Debug>(
    empty: impl Fn() -> M,
    likelihood: &impl Likelihood<M>,
    observations: &[(Pose2, Observed<M>)],
    content: impl Fn(&M) -> C,
) {
    let (trunk, rest) = observations.split_at(observations.len() / 2);
    let rotated = |by: usize| rest.iter().cycle().skip(by).take(rest.len()).collect();
    let branches: Vec<Vec<_>> = (0..3).map(|k| rotated(k * rest.len() / 3)).collect();
    a_family_of_clones_is_independent(empty, likelihood, trunk, &branches, content);
}

/// The same with `trunk` and `branches` as they are given, such as a generator of random tests makes them.
///
/// ```
/// # use fastslam::{geometry::Pose2, laws, nalgebra::Vector2, sensor::{Feature, RangeBearing}};
/// # use fastslam::{map::landmarks::{Correspondence, Landmarks}, proposal::Marginal};
/// let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 6.3 };
/// let empty = || <Landmarks<_>>::new(sensor, Correspondence::Known);
/// let content = |map: &Landmarks<_>| map.iter().map(|(index, landmark)| (index, *landmark)).collect::<Vec<_>>();
/// let seen = |k| (Pose2::default(), vec![Feature { z: Vector2::new(3.0, 0.1), signature: Some(k) }]);
///
/// let [a, b, c] = [seen(0), seen(1), seen(2)];
/// laws::map::a_family_of_clones_is_independent(empty, &Marginal, &[a], &[vec![&b], vec![&c, &b]], content);
/// ```
pub fn a_family_of_clones_is_independent<M: ConditionalMap, C: PartialEq + Debug>(
    empty: impl Fn() -> M,
    likelihood: &impl Likelihood<M>,
    trunk: &[(Pose2, Observed<M>)],
    branches: &[Vec<&(Pose2, Observed<M>)>],
    content: impl Fn(&M) -> C,
) {
    let mut shared = mapped(&empty, likelihood, trunk);
    let before = content(&shared);
    let mut family = vec![shared.clone(); branches.len()];
    // Interleaved, as particles write in turn.
    for turn in 0..branches.iter().map(Vec::len).max().unwrap_or(0) {
        for (map, branch) in family.iter_mut().zip(branches) {
            branch.get(turn).into_iter().for_each(|observation| assimilate(map, likelihood, observation));
        }
    }
    assert_eq!(content(&shared), before, "clones were written to, and the original holds it");
    // And the other way round.
    let late = shared.clone();
    branches.iter().flatten().for_each(|observation| assimilate(&mut shared, likelihood, observation));
    assert_eq!(content(&late), before, "the original was written to, and its clone holds it");
    for (k, (map, branch)) in family.iter().zip(branches).enumerate() {
        let alone = mapped(&empty, likelihood, trunk.iter().chain(branch.iter().copied()));
        assert_eq!(content(map), content(&alone), "clone {k} does not hold what it would without its siblings");
    }
}

/// Where a range finder is mounted is nothing to the map: with the robot moved so that the range finder stands in the same place, `alike`
/// is told two maps that hold the same, but for rounding.
///
/// `scans` are of a range finder in the robot's centre, each with the pose it was taken at, so that no end point lies on the border of a
/// cell.
///
/// ```
/// use fastslam::{geometry::Pose2, laws, map::grid::{Grid, GridModel}, sensor::BeamSensor};
/// # use fastslam::mapper::LaserMapperSettings;
/// let empty = || <Grid<4>>::new(LaserMapperSettings::default().grid());
/// let scan = BeamSensor::panorama(90, 8.0, 0.0).scan(&[2.0; 90]);
/// let occupied = |map: &Grid<4>| (0..60).filter(|i| map.log_odds(*i, 0) > 0.0).count();
/// let alike = |a: &Grid<4>, b: &Grid<4>| assert_eq!(occupied(a), occupied(b));
///
/// let (scans, mountings) = ([(Pose2::new(0.013, 0.007, 0.1), scan)], [Pose2::new(0.6, -0.4, 1.0)]);
/// laws::map::a_mounting_changes_nothing(empty, &scans, &mountings, alike);
/// ```
pub fn a_mounting_changes_nothing<M: ConditionalMap<Observation = Scan, Association = ()>>(
    empty: impl Fn() -> M,
    scans: &[(Pose2, Scan)],
    mountings: &[Pose2],
    alike: impl Fn(&M, &M),
) {
    let mapped = |robot_from_sensor: &Pose2| {
        let sensor_from_robot = robot_from_sensor.between(&Pose2::default());
        let mut map = empty();
        for (world_from_sensor, scan) in scans {
            map.assimilate(&world_from_sensor.compose(&sensor_from_robot), &scan.mounted(robot_from_sensor), &());
        }
        map
    };
    let centred = mapped(&Pose2::default());
    mountings.iter().for_each(|mounting| alike(&mapped(mounting), &centred));
}
