//! What it costs to map a log: a ring of 60 m with people in it, 16 particles, on one thread and on all. Divide by scans and particles,
//! which the name tells.
#![allow(missing_docs, reason = "criterion's macros write undocumented functions")]

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use fastslam::execute::Executor;
use fastslam_lab::experiment::long_rings::LongRingSetup;

fn ring(criterion: &mut Criterion) {
    let setup = LongRingSetup::default();
    let start = setup.start().expect("the setup is in range");
    let name = format!("{}m-{}-particles", setup.length, setup.particles);
    let mut group = criterion.benchmark_group("log-ring");
    group.sample_size(10);
    for (kind, executor) in [("serial", Executor::Serial), ("rayon", Executor::Rayon)] {
        let start = start.clone().with_executor(executor);
        // The simulation of the log is no part of it.
        group.bench_with_input(
            BenchmarkId::new(kind, format!("{name}-{}-scans", start.log().scans.len())),
            &start,
            |bencher, start| {
                bencher.iter_batched_ref(|| start.clone(), |run| while run.step() {}, BatchSize::LargeInput);
            },
        );
    }
    group.finish();
}

criterion_group!(benches, ring);
criterion_main!(benches);
