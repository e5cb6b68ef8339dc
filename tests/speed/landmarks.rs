//! What FastSLAM costs with landmarks: a step of one particle, and a sighting in maps of ten to ten thousand landmarks.
#![allow(missing_docs, reason = "criterion's macros write undocumented functions")]

use core::hint::black_box;
use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::map::landmarks::{Balanced, Blocks, Correspondence, Gate, Landmark, Landmarks, Sighted, Store};
use fastslam::motion::{Odometry, OdometryModel};
use fastslam::proposal::FromMeasurement;
use fastslam::rbpf::Rbpf;
use fastslam::resampling::{ResamplePolicy, Scheme};
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use nalgebra::{Matrix2, Vector2};

const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.1, bearing_std: 0.03, max_range: 8.0, field_of_view: core::f64::consts::PI };
const MOTION: OdometryModel = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
const STEP: Odometry = Odometry { rot1: 0.05, trans: 0.2, rot2: 0.05 };

/// Landmarks a metre apart in rows of six, the first of them ahead.
fn field(count: u32) -> impl Iterator<Item = Landmark> {
    let at = |k| Vector2::new(1.5 + f64::from(k / 6), f64::from(k % 6) - 2.5);
    (0..count).map(move |k| Landmark { mean: at(k), covariance: Matrix2::identity() * 0.01, evidence: 1 })
}

/// The six nearest, all at their places to a few centimetres.
fn six() -> Vec<Feature> {
    let pose = STEP.apply(&Pose2::default());
    let see = |(signature, landmark): (u32, Landmark)| {
        let z = SENSOR.predict(&pose, &(landmark.mean + Vector2::new(0.03, -0.02))).z;
        Feature { z, signature: Some(signature) }
    };
    (0..).zip(field(6)).map(see).collect()
}

/// A step of a thousand particles with six sightings in a map of 24 landmarks, serially; divide by a thousand. The population is
/// the one that a first step left, as many as it had, and every copy writes to blocks that it shares.
fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("landmarks-step-1000-particles");
    group.sample_size(20);
    for (name, correspondence) in
        [("known", Correspondence::Known), ("unknown", Correspondence::Unknown(Gate::default()))]
    {
        let map = Landmarks::<_, Blocks>::new(SENSOR, correspondence).with(field(24));
        let (policy, scheme, proposal) =
            (ResamplePolicy::Never, Scheme::Systematic, FromMeasurement { motion: MOTION });
        let filter =
            Rbpf::new(proposal, policy, scheme, 1, 1000, Pose2::default(), map).with_executor(Executor::Serial);
        let features = six();
        group.bench_function(name, |bencher| {
            let step = |filter: &mut Rbpf<_, _>| filter.step(&STEP, &features);
            bencher.iter_batched_ref(|| filter.clone(), step, BatchSize::LargeInput);
        });
    }
    group.finish();
}

fn observation<S: Store>(criterion: &mut Criterion, name: &str) {
    let (features, sighted) = (six()[..1].to_vec(), vec![Sighted::Again(3)]);
    for count in [10, 100, 1000, 10_000] {
        let map = Landmarks::<_, S>::new(SENSOR, Correspondence::Known).with(field(count));
        criterion.benchmark_group("landmarks-copy-and-observe").bench_with_input(
            BenchmarkId::new(name, count),
            &map,
            |bencher, map| {
                bencher.iter(|| {
                    let mut copy = map.clone();
                    copy.assimilate(&Pose2::default(), &features, &sighted);
                    copy
                });
            },
        );
        let mut alone = map;
        criterion.benchmark_group("landmarks-observe").bench_function(BenchmarkId::new(name, count), |bencher| {
            bencher.iter(|| black_box(&mut alone).assimilate(&Pose2::default(), &features, &sighted));
        });
    }
}

fn observations(criterion: &mut Criterion) {
    observation::<Blocks>(criterion, "blocks");
    observation::<Balanced>(criterion, "balanced");
    observation::<Vec<Option<Landmark>>>(criterion, "vec");
}

criterion_group!(benches, steps, observations);
criterion_main!(benches);
