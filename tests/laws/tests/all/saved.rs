//! Laws of a saved state: it goes on with the same bits, it shares what was shared, and what is none is refused.

use fastslam::geometry::Pose2;
use fastslam::map::grid::{Grid, GridModel};
use fastslam::map::landmarks::{Balanced, Correspondence, Gate, Landmark, Landmarks, Store};
use fastslam::map::{ConditionalMap, Footprint, Observed};
use fastslam::mapper::{LaserMapper, LaserMapperSettings};
use fastslam::matching::{Matcher, ScanModel};
use fastslam::motion::{Odometry, OdometryModel};
use fastslam::particle::Particle;
use fastslam::proposal::{FromMeasurement, FromMotion, Proposal, ProposalTrace, Proposed};
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::{ResamplePolicy, Scheme};
use fastslam::save::{RestoreError, SaveShared};
use fastslam::sensor::LaserScan;
use fastslam::sensor::{BeamSensor, Feature, LandmarkSensor, RangeBearing, Scan};
use fastslam_lab::digest::Digest;
use fastslam_lab::experiment::ProposalKind;
use fastslam_lab::experiment::lap::{GRID, Lap, LapSetup, Proposals};
use fastslam_lab::experiment::log::Example;
use fastslam_lab::experiment::long_rings::LongRingSetup;
use fastslam_log::LaserLog;
use serde_json::{Value, json};
use std::borrow::Borrow;
use std::hash::Hasher;

/// A map that tells all that it holds, with what its population shares.
trait Told: ConditionalMap + SaveShared {
    fn hash<'a>(maps: impl Iterator<Item = &'a Self>, digest: &mut Digest)
    where
        Self: 'a;

    fn memory<'a>(maps: impl Iterator<Item = &'a Self>) -> Footprint
    where
        Self: 'a;
}

impl<const CELLS_PER_NDT: usize> Told for Grid<CELLS_PER_NDT> {
    fn hash<'a>(maps: impl Iterator<Item = &'a Self>, digest: &mut Digest) {
        Self::hash_all(maps, digest);
    }

    fn memory<'a>(maps: impl Iterator<Item = &'a Self>) -> Footprint {
        Self::footprint(maps)
    }
}

impl<S: Store + SaveShared> Told for Landmarks<RangeBearing, S> {
    fn hash<'a>(maps: impl Iterator<Item = &'a Self>, digest: &mut Digest)
    where
        Self: 'a,
    {
        for (index, Landmark { mean, covariance, existence_count, apart }) in maps.flat_map(Self::iter) {
            digest.u32(index);
            mean.iter().chain(covariance).for_each(|x| digest.f64(*x));
            digest.u32(existence_count.cast_unsigned());
            digest.u32(*apart);
        }
    }

    fn memory<'a>(maps: impl Iterator<Item = &'a Self>) -> Footprint
    where
        Self: 'a,
    {
        Self::footprint(maps)
    }
}

/// All poses, weights and maps, and what they hold of the memory: paths as nodes, maps in bytes.
fn state<M: Told, P: Proposal<M>>(filter: &Rbpf<M, P>) -> (Digest, u32, Footprint) {
    let mut digest = Digest::new();
    for pose in filter.particles().iter().flat_map(|p| p.path.poses().into_iter().chain([p.world_from_robot])) {
        [pose.x, pose.y, pose.theta].into_iter().for_each(|x| digest.f64(x));
    }
    let weights = filter.weights().as_slice().iter().chain(filter.path_weights().as_slice());
    weights.for_each(|weight| digest.f64(*weight));
    digest.write(&[filter.best() as u8]);
    let maps = || filter.particles().iter().map(|p| &p.map);
    M::hash(maps(), &mut digest);
    (digest, filter.descent().size(), M::memory(maps()))
}

fn written<M: Told, P: Proposal<M>>(filter: &Rbpf<M, P>) -> String {
    serde_json::to_string(&filter.save()).unwrap()
}

fn read<M: Told, P: Proposal<M>>(text: &str, proposal: P) -> Result<Rbpf<M, P>, String> {
    let saved = serde_json::from_str(text).map_err(|error| error.to_string())?;
    Rbpf::restore(saved, proposal).map_err(|error| error.to_string())
}

/// Steps a filter through a log; after every 20 steps it is written, read again, and its copy goes on beside it to the end.
fn assert_it_goes_on<M: Told, P: Proposal<M> + Clone>(
    mut filter: Rbpf<M, P>,
    proposal: &P,
    log: &[(P::Control, Observed<M>)],
) {
    let mut copies: Vec<Rbpf<M, P>> = Vec::new();
    let mut resampled = 0;
    for (k, (control, observation)) in log.iter().enumerate() {
        let observation = observation.borrow();
        if k % 20 == 0 {
            let text = written(&filter);
            let copy = read(&text, proposal.clone()).unwrap();
            assert_eq!(state(&copy), state(&filter), "restored at step {k}");
            assert_eq!(written(&copy), text, "written again at step {k}");
            copies.push(copy);
        }
        let report = filter.step(control, observation);
        resampled += u32::from(report.ancestors.is_some());
        for copy in &mut copies {
            let other = copy.step(control, observation);
            assert_eq!(
                (other.step, &other.weights, &other.ancestors),
                (report.step, &report.weights, &report.ancestors)
            );
            assert_eq!(other.log_evidence.to_bits(), report.log_evidence.to_bits());
        }
    }
    assert!(resampled > 2, "what is never resampled shares little: {resampled}");
    for copy in &copies {
        assert_eq!(state(copy), state(&filter));
    }
}

fn lap(proposal: ProposalKind) -> (Lap, Proposals) {
    let setup = LapSetup { particles: 6, proposal, odometry_scale: 1.5, ..LapSetup::default() };
    (Lap::new(&setup).unwrap(), setup.proposals())
}

#[test]
fn a_lap_goes_on_from_its_saved_state_with_the_same_bits_and_shares_the_same_memory() {
    for kind in [ProposalKind::Improved, ProposalKind::Motion] {
        let (lap, proposals) = lap(kind);
        let world = lap.world();
        let log: Vec<_> = world.controls.iter().copied().zip(world.scans.iter().cloned()).collect();
        assert_it_goes_on(lap.filter().clone(), &proposals, &log);
    }
}

const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.1, bearing_std: 0.03, max_range: 6.0, field_of_view: core::f64::consts::TAU };
const MOTION: OdometryModel = OdometryModel { alphas: [0.02, 0.004, 0.02, 0.004] };

/// Around a circle, past landmarks on both sides of it. Their signatures are far apart, so that the trees have several levels.
fn circle(steps: u32) -> Vec<(Odometry, Vec<Feature>)> {
    let landmarks: Vec<[f64; 2]> = (0..16_i32)
        .map(|k| Pose2::new(0.0, 4.0, f64::from(k) * 0.393).transform([if k % 2 == 0 { 6.0 } else { 3.0 }, 0.0]))
        .collect();
    let mut pose = Pose2::default();
    (0..steps)
        .map(|step| {
            let mut stream = Stream::at(3, Purpose::TRIAL, step, 0);
            let control = Odometry { rot1: 0.05, trans: 0.4, rot2: 0.05 };
            pose = control.apply(&pose);
            let see = |(k, &[x, y]): (u32, &[f64; 2])| {
                let landmark = fastslam::nalgebra::Vector2::new(x, y);
                let z = SENSOR.measure(&pose, &landmark, &mut stream);
                SENSOR.sees(&pose, &landmark, 0.0).then_some(Feature { z, signature: Some(k * 37) })
            };
            (
                MOTION.perturb(&control, &mut Stream::at(3, Purpose::TRIAL, step, 1)),
                (0..).zip(&landmarks).filter_map(see).collect(),
            )
        })
        .collect()
}

fn landmarks<S: Store>(
    correspondence: Correspondence,
) -> Rbpf<Landmarks<RangeBearing, S>, FromMeasurement<OdometryModel>> {
    let builder = Rbpf::builder(Landmarks::new(SENSOR, correspondence), FromMeasurement { motion: MOTION });
    builder.particles(12).seed(5).build().unwrap()
}

#[test]
fn a_map_of_landmarks_goes_on_from_its_saved_state_whatever_it_is_kept_in() {
    fn run<S: Store + SaveShared>(correspondence: Correspondence) {
        assert_it_goes_on(landmarks::<S>(correspondence), &FromMeasurement { motion: MOTION }, &circle(90));
    }
    let unknown = Correspondence::Unknown(Gate { removal: true, ..Gate::default() });
    for correspondence in [Correspondence::Known, unknown] {
        run::<fastslam::map::landmarks::Blocks>(correspondence);
        run::<Balanced>(correspondence);
        run::<Vec<Option<Landmark>>>(correspondence);
    }
}

/// Stopped where a reader may stop: weighed, and resampled, but not moved on.
#[test]
fn a_state_between_the_halves_of_a_step_goes_on_as_well() {
    let proposal = FromMeasurement { motion: MOTION };
    let map = <Landmarks<RangeBearing, Balanced>>::new(SENSOR, Correspondence::Known);
    // A scheme that copies other particles at every draw, also where all weigh the same.
    let builder = Rbpf::builder(map, proposal.clone()).particles(12).seed(5).scheme(Scheme::Multinomial);
    let mut filter = builder.build().unwrap();
    for (control, features) in &circle(10) {
        filter.weigh(control, features);
        for _ in 0..2 {
            let mut copy: Rbpf<Landmarks<_, Balanced>, _> = read(&written(&filter), proposal.clone()).unwrap();
            assert_eq!(copy.resample(), filter.resample());
            assert_eq!(state(&copy), state(&filter));
        }
    }
}

/// A map of one's own that shares nothing: how often it was told of something.
#[derive(Clone)]
struct Count(u32);

impl ConditionalMap for Count {
    type Observation = ();
    type Association = ();

    fn assimilate(&mut self, _: &Pose2, (): &(), (): &()) {
        self.0 += 1;
    }
}

impl SaveShared for Count {
    type Saved = Vec<u32>;

    fn save_all<'a>(all: impl IntoIterator<Item = &'a Self>) -> Vec<u32> {
        all.into_iter().map(|count| count.0).collect()
    }

    fn restore_all(saved: Vec<u32>) -> Result<Vec<Self>, RestoreError> {
        Ok(saved.into_iter().map(Self).collect())
    }
}

/// Half of the particles, by lot, cannot explain what they see.
#[derive(Clone)]
struct Half;

impl Proposal<Count> for Half {
    type Control = ();

    fn propose(&self, _: &Particle<Count>, (): &(), (): &(), stream: &mut Stream) -> Proposed<()> {
        let log_increment = if stream.uniform() < 0.5 { f64::NEG_INFINITY } else { 0.0 };
        Proposed { world_from_robot: Pose2::default(), association: (), log_increment, trace: ProposalTrace::Motion }
    }
}

/// Their logarithms are infinite, which JSON cannot write.
#[test]
fn weights_that_are_lost_stay_lost() {
    let mut filter = Rbpf::builder(Count(0), Half).particles(16).policy(ResamplePolicy::Never).build().unwrap();
    filter.step(&(), &());
    let text = serde_json::to_string(&filter.save()).unwrap();
    let mut copy: Rbpf<Count, _> = Rbpf::restore(serde_json::from_str(&text).unwrap(), Half).unwrap();
    assert_eq!((copy.weights(), copy.path_weights()), (filter.weights(), filter.path_weights()));
    assert!(copy.weights().as_slice().contains(&0.0));
    copy.step(&(), &());
    filter.step(&(), &());
    assert_eq!(copy.weights(), filter.weights());
    assert!(copy.particles().iter().all(|particle| particle.map.0 == 2));
}

// What is no state.

/// A state, as small as can be that has all of a state's parts.
fn small_grid() -> (Rbpf<Grid<2>, FromMotion<OdometryModel, ScanModel>>, Odometry, Scan) {
    let model = GridModel { cell_size: 0.2, distance_reach: 2, lag: 2, ..GRID };
    let (scan, control) =
        (BeamSensor::panorama(8, 3.0, 0.0).scan(&[1.5; 8]), Odometry { rot1: 0.1, trans: 0.3, rot2: 0.0 });
    let proposal = FromMotion { motion: MOTION, likelihood: ScanModel::new(Matcher::SubCell, 0.3, 0.1) };
    let mut filter =
        Rbpf::builder(Grid::new(model), proposal).particles(3).policy(ResamplePolicy::Never).build().unwrap();
    (0..5).for_each(|_| drop(filter.step(&control, &scan)));
    filter.resample();
    (filter, control, scan)
}

type FastSlam2 = Rbpf<Landmarks<RangeBearing, Balanced>, FromMeasurement<OdometryModel>>;

fn small_landmarks() -> (FastSlam2, Odometry, Vec<Feature>) {
    let mut filter = landmarks::<Balanced>(Correspondence::Unknown(Gate::default()));
    let log = circle(6);
    log.iter().for_each(|(control, features)| drop(filter.step(control, features)));
    let (control, features) = log[0].clone();
    (filter, control, features)
}

/// The places in a document of all that it holds.
fn places(value: &Value, at: String, found: &mut Vec<String>) {
    match value {
        Value::Array(values) => {
            // The ends of a long list are as good as all of it.
            let ends = values.iter().enumerate().filter(|(k, _)| *k < 3 || k + 2 > values.len());
            ends.for_each(|(k, value)| places(value, format!("{at}/{k}"), found));
        }
        Value::Object(fields) => fields.iter().for_each(|(name, value)| places(value, format!("{at}/{name}"), found)),
        _ => (),
    }
    found.push(at);
}

/// At every place each of several values that do not belong there, and each list too short and too long. What can still be read is
/// used: most of it is a state like any other. Returns how many were refused and how many were not.
fn mutilate<M: Told, P: Proposal<M> + Clone>(
    filter: &Rbpf<M, P>,
    proposal: &P,
    control: &P::Control,
    observation: &M::Observation,
) -> [u32; 2] {
    let document = serde_json::to_value(filter.save()).unwrap();
    let (mut all, mut outcomes) = (Vec::new(), [0, 0]);
    places(&document, String::new(), &mut all);
    for place in &all {
        let was = document.pointer(place).unwrap();
        let numbers = [0, 1, 3, 7, 64, 200, 255, 1 << 20, u64::from(u32::MAX), u64::MAX].map(Value::from);
        let mut values =
            [numbers.as_slice(), &[Value::Null, (-1).into(), 0.5.into(), 1e300.into(), "x".into()]].concat();
        if let Value::Array(list) = was {
            let last = list.len().saturating_sub(1);
            values.extend([list[..last].into(), [list, &list[last..]].concat().into(), Value::Array(Vec::new())]);
        }
        for value in values {
            let mut changed = document.clone();
            *changed.pointer_mut(place).unwrap() = value;
            let restored =
                serde_json::from_value(changed).ok().and_then(|saved| Rbpf::restore(saved, proposal.clone()).ok());
            outcomes[usize::from(restored.is_some())] += 1;
            if let Some(mut filter) = restored {
                (0..3).for_each(|_| drop(filter.step(control, observation)));
                filter.resample();
                state(&filter);
                filter.estimate();
            }
        }
    }
    outcomes
}

#[test]
fn a_mutilated_state_is_refused_or_used_and_never_panics() {
    let (filter, control, scan) = small_grid();
    let proposal = FromMotion { motion: MOTION, likelihood: ScanModel::new(Matcher::SubCell, 0.3, 0.1) };
    let [refused, used] = mutilate(&filter, &proposal, &control, &scan);
    assert!(refused > 1000 && used > 100, "{refused} refused, {used} used");
    let (filter, control, features) = small_landmarks();
    let [refused, used] = mutilate(&filter, &FromMeasurement { motion: MOTION }, &control, &features);
    assert!(refused > 1000 && used > 100, "{refused} refused, {used} used");
}

#[test]
fn what_is_wrong_with_a_state_is_named() {
    let (filter, ..) = small_grid();
    let document = serde_json::to_value(filter.save()).unwrap();
    let refused = |place: &str, value: Value| {
        let mut changed = document.clone();
        *changed.pointer_mut(place).unwrap_or_else(|| panic!("{place}")) = value;
        let proposal = FromMotion { motion: MOTION, likelihood: ScanModel::new(Matcher::SubCell, 0.3, 0.1) };
        let restored: Result<Rbpf<Grid<2>, _>, _> = Rbpf::restore(serde_json::from_value(changed).unwrap(), proposal);
        restored.unwrap_err().to_string()
    };
    assert_eq!(refused("/version", 2.into()), "version = 2: must be 3");
    let tiles = document["maps"]["tiles"].as_array().unwrap().len();
    assert_eq!(
        refused("/maps/directories/0/tiles/0", 999.into()),
        format!("maps.tiles: number 999 is referred to, of {tiles}")
    );
    assert_eq!(refused("/paths/nodes/0/before", 0.into()), "paths.nodes: number 0 is referred to, of 0");
    assert_eq!(refused("/weights/weights/0", 0.5.into()), "weights: must be what their logarithms are of");
    assert_eq!(
        refused("/maps/grids/0/model/cell_size", 0.into()),
        "grid.cell_size = 0: must be a number from 0.000001 to 1000000 [m]"
    );
    assert_eq!(refused("/policy", serde_json::json!({ "EssBelow": 2 })), "policy = 2: must be a number from 0 to 1");
    assert_eq!(refused("/maps/grids", Value::Array(Vec::new())), "maps: 0 of them, where there must be 3");
    assert_eq!(
        refused("/paths/ends", Value::Array(Vec::new())),
        "particles = 0: must be a whole number from 1 to 4294967295"
    );
    assert_eq!(refused("/paths/ends/1", 0.into()), "paths: must be all of one step");
}

// Of a mapper.

/// Path, weights and maps of a mapper, with what is known besides of the way, to the bit; and its memory, with what is kept.
fn mapped(mapper: &LaserMapper) -> (Digest, Footprint, String) {
    let (mut digest, _, _) = state(mapper.filter());
    for (time, pose) in mapper.path() {
        [time, pose.x, pose.y, pose.theta].into_iter().for_each(|x| digest.f64(x));
    }
    [mapper.wheels().drift(), mapper.wheels().heading_std()].into_iter().for_each(|x| digest.f64(x));
    let counts = (mapper.steps(), mapper.closings(), mapper.single_lineage_since(), mapper.resampled_fraction());
    let now = mapper.pose_with_covariance();
    let said = format!("{now:?} {counts:?} {:?} {:?} {:?}", mapper.loops(), mapper.unbelieved(), mapper.remarks());
    (digest, mapper.footprint_with_kept(), said)
}

fn saved_and_restored(mapper: &LaserMapper) -> LaserMapper {
    let text = serde_json::to_string(&mapper.save()).unwrap();
    let restored = LaserMapper::restore(serde_json::from_str(&text).unwrap()).unwrap();
    assert_eq!(mapped(&restored), mapped(mapper), "after {} steps", mapper.steps());
    assert_eq!(serde_json::to_string(&restored.save()).unwrap(), text, "after {} steps", mapper.steps());
    restored
}

/// Pushes a log into a mapper, and into one that is stopped before the first scan, after it, and after every 29 scans.
fn assert_a_session_goes_on(log: &LaserLog, settings: LaserMapperSettings) -> LaserMapper {
    let mut whole = LaserMapper::new(settings.for_scans(&log.scans)).unwrap();
    let mut stopped = saved_and_restored(&whole);
    for (number, scan) in log.scans.iter().enumerate() {
        _ = (whole.push(scan), stopped.push(scan));
        if number % 29 == 0 {
            stopped = saved_and_restored(&stopped);
        }
    }
    assert_eq!(mapped(&stopped), mapped(&whole));
    whole
}

/// Round a corner where particles are resampled and a loop is closed, and odometry starts anew on the way.
#[test]
fn a_session_that_is_stopped_goes_on_to_the_path_of_one_run_to_the_bit() {
    let mut log = ring(60, 8);
    let at = log.scans.len() / 4;
    let back = log.scans[at].odometry;
    log.scans[at..].iter_mut().for_each(|scan| scan.odometry = back.between(&scan.odometry));
    let mapper =
        assert_a_session_goes_on(&log, LaserMapperSettings { particles: 4, seed: 8, ..LaserMapperSettings::default() });
    assert!(mapper.resampled_fraction() > 0.0 && !mapper.loops().is_empty(), "{:?}", mapped(&mapper).2);
    assert_eq!(mapper.unbelieved().len(), 1);
}

/// All scans are mapped again then, with the maps of before, a few at a time. Seeds are taken from the first on, until a path is bent.
#[test]
fn a_session_that_is_stopped_while_a_path_is_corrected_bends_the_same_paths() {
    let is_bent = |seed| {
        let settings =
            LaserMapperSettings { particles: 1, seed, remapped_per_scan: 6, ..LaserMapperSettings::default() };
        let mut mapper = assert_a_session_goes_on(&ring(120, seed), settings);
        mapper.finish();
        mapper.closings() > 0
    };
    assert!((1..=6).any(is_bent), "none of six loops was left open");
}

/// The log of a ring of so many metres.
fn ring(length: u32, seed: u64) -> LaserLog {
    Example::of(&LongRingSetup { length, seed, ..LongRingSetup::default() }.recipe(), usize::MAX).log
}

#[test]
fn a_mutilated_session_is_refused_or_used_and_never_panics() {
    let mut log = ring(60, 1);
    for scan in &mut log.scans {
        scan.ranges = scan.ranges.iter().step_by(12).copied().collect();
        scan.angle_step *= 12.0;
    }
    let settings =
        LaserMapperSettings { particles: 2, cell_size: 0.2, max_range: 2.0, ..LaserMapperSettings::default() };
    let mut mapper = LaserMapper::new(settings.for_scans(&log.scans)).unwrap();
    let (first, rest) = log.scans.split_at(40);
    first.iter().for_each(|scan| drop(mapper.push(scan)));
    let mut document = serde_json::to_value(mapper.save()).unwrap();
    // What is in filter and maps is mutilated above.
    let own = |place: &str| !place.starts_with("/filter/") && !place.starts_with("/maps/");
    let [refused, used] = mutilate_session(&document, own, rest);
    assert!(refused > 500 && used > 100, "{refused} refused, {used} used");
    under_correction(&mut document);
    let mut mapper = LaserMapper::restore(serde_json::from_value(document.clone()).unwrap()).unwrap();
    rest[..3].iter().for_each(|scan| drop(mapper.push(scan)));
    assert_eq!(mapper.closings(), 0);
    mapper.finish();
    assert_eq!((mapper.closings(), mapper.loops().len()), (1, 1));
    let own = |place: &str| place.starts_with("/closings/corrections") || place.starts_with("/closings/accounts");
    let [refused, used] = mutilate_session(&document, own, rest);
    assert!(refused > 100 && used > 20, "{refused} refused, {used} used");
}

/// Puts a path into a session that is being corrected: that of the last particle, which is back at step 20 where it was at step 2, and mapped again up to step 10. The map
/// that it has so far is taken to be that of the first particle, and the one of before as well.
fn under_correction(document: &mut Value) {
    let poses: Vec<Pose2> = (0..=20).map(|step| Pose2::new(0.1 * f64::from(step), 0.0, 0.0)).collect();
    let relation = json!({ "from": 2, "to": 20, "between": { "x": 0.1, "y": 0.0, "theta": 0.0 } });
    let end = json!({ "Bent": { "shift": 0.5, "gain": 0.3, "second": 0.1 } });
    let correction = json!({ "relation": relation, "end": end, "bent": poses, "mapped": 10, "before": [5] });
    assert_eq!(document["closings"]["accounts"].as_array().unwrap().len(), 2, "it has been looked for loops");
    document["settings"]["remapped_per_scan"] = 2.into();
    document["closings"]["corrections"] = json!([null, correction]);
    let grids = document["maps"]["grids"].as_array_mut().unwrap();
    let map = grids[0].clone();
    grids.extend([map.clone(), map]);
}

/// Puts several values that do not belong there at each place of a session that is its `own`. What can still be read goes on, and completes what is under way. Returns how
/// many were refused and how many were not.
fn mutilate_session(document: &Value, own: impl Fn(&str) -> bool, scans: &[LaserScan]) -> [u32; 2] {
    let (mut all, mut outcomes) = (Vec::new(), [0, 0]);
    places(document, String::new(), &mut all);
    for place in all.iter().filter(|place| own(place)) {
        for value in [
            0.into(),
            1.into(),
            7.into(),
            u64::from(u32::MAX).into(),
            Value::Null,
            (-1).into(),
            1e300.into(),
            Value::Array(Vec::new()),
        ] {
            let mut changed = document.clone();
            *changed.pointer_mut(place).unwrap() = value;
            let restored = serde_json::from_value(changed).ok().and_then(|saved| LaserMapper::restore(saved).ok());
            outcomes[usize::from(restored.is_some())] += 1;
            if let Some(mut mapper) = restored {
                scans.iter().take(3).for_each(|scan| drop(mapper.push(scan)));
                mapper.finish();
                drop((mapper.path(), mapper.remarks(), mapper.pose_with_covariance(), mapper.memory()));
            }
        }
    }
    outcomes
}
