//! What FastSLAM costs with landmarks: a step of one particle, and a sighting in maps of ten to ten thousand landmarks.
#![allow(missing_docs, reason = "criterion's macros write undocumented functions")]

use core::hint::black_box;
use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::map::landmarks::{Association, Balanced, Blocks, Correspondence, Landmark, Landmarks, Store};
use speed::{SENSOR, Thousand, field, six};

/// A step of a thousand particles; divide by a thousand.
fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("landmarks-step-1000-particles");
    group.sample_size(20);
    for (name, known) in [("known", true), ("unknown", false)] {
        let start = Thousand::new(known);
        group.bench_function(name, |bencher| {
            bencher.iter_batched_ref(|| start.again(), Thousand::step, BatchSize::LargeInput);
        });
    }
    group.finish();
}

fn observation<S: Store>(criterion: &mut Criterion, name: &str) {
    let (features, sighted) = (six()[..1].to_vec(), vec![Association::Matched(3)]);
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
