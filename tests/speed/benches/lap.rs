//! What a whole lap costs, by number of particles and proposal, on one thread and on all. `npm run bench` sets the first of these
//! beside the same laps in WebAssembly.
#![allow(missing_docs, reason = "criterion's macros write undocumented functions")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use fastslam::execute::Executor;
use fastslam::matching::Matcher;
use fastslam_lab::experiment::ProposalKind;
use fastslam_lab::experiment::lap::{Lap, LapSetup};

fn drive(setup: &LapSetup, executor: &Executor) -> f64 {
    let mut lap = Lap::new(setup).expect("the setup is in range").with_executor(executor.clone());
    while lap.step().is_some() {}
    lap.report().rms_best
}

fn laps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("lap");
    group.sample_size(10);
    let mut bench = |name: &str, executor: Executor, setup: LapSetup| {
        let id = BenchmarkId::new(name, setup.particles);
        group.bench_with_input(id, &setup, |bencher, setup| bencher.iter(|| drive(setup, &executor)));
    };
    for particles in [16, 64] {
        let setup = || LapSetup { particles, ..LapSetup::default() };
        bench("serial", Executor::Serial, setup());
        bench("rayon", Executor::Rayon, setup());
        bench("serial-cell", Executor::Serial, LapSetup { matcher: Matcher::Cell, ..setup() });
        bench("serial-motion", Executor::Serial, LapSetup { proposal: ProposalKind::Motion, ..setup() });
    }
    group.finish();
}

criterion_group!(benches, laps);
criterion_main!(benches);
