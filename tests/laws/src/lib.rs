//! Laws across layers: see `tests/`. Here is what they share with the benchmarks and with `tests/factrs`.

pub mod graphs;

use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::ops;
use fastslam::particle::Particle;
use fastslam::proposal::{Proposal, ProposalTrace, Proposed};
use fastslam::random::Stream;
use fastslam::rbpf::Rbpf;
use fastslam::resampling::{ResamplePolicy, Scheme};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

/// No map.
#[derive(Clone, Debug)]
pub struct Nothing;

impl ConditionalMap for Nothing {
    type Observation = ();
    type Association = ();

    fn assimilate(&mut self, _: &Pose2, (): &(), (): &()) {}
}

/// Poses that drift, and weights by lot: ln w is normal with a standard deviation of 1 nat, which brings N_eff to M / e.
#[derive(Clone, Debug)]
pub struct Drift;

impl Proposal<Nothing> for Drift {
    type Control = ();

    fn propose(&self, particle: &Particle<Nothing>, (): &(), (): &(), stream: &mut Stream) -> Proposed<()> {
        let [turned, log_increment] = stream.normals();
        let world_from_robot = particle.world_from_robot.compose(&Pose2::new(0.1, 0.0, 0.01 * turned));
        Proposed { world_from_robot, association: (), log_increment, trace: ProposalTrace::Motion }
    }
}

/// A filter of paths alone: what it holds is the tree. It begins at the origin.
pub fn drifting(policy: ResamplePolicy, scheme: Scheme, particles: usize) -> Rbpf<Nothing, Drift> {
    drifting_from(Pose2::default(), policy, scheme, particles)
}

/// The same from another start: the same draws, moved rigidly.
pub fn drifting_from(start: Pose2, policy: ResamplePolicy, scheme: Scheme, particles: usize) -> Rbpf<Nothing, Drift> {
    let builder = Rbpf::builder(Nothing, Drift).start(start).particles(particles).seed(1).policy(policy).scheme(scheme);
    builder.executor(Executor::Serial).build().expect("there are particles, and the policy is in its range")
}

/// The c of t + 1 + c M ln M: what a tree of so many nodes holds beyond one path.
pub fn crown(nodes: u32, steps: u32, particles: usize) -> f64 {
    let m = particles as f64;
    (f64::from(nodes) - f64::from(steps + 1)) / (m * ops::ln(m))
}

/// The system's allocator, which counts what was allocated and is not freed. For a program's `#[global_allocator]`.
#[derive(Debug, Default)]
pub struct Counting {
    blocks: AtomicUsize,
    bytes: AtomicUsize,
}

impl Counting {
    /// Nothing yet.
    pub const fn new() -> Self {
        Self { blocks: AtomicUsize::new(0), bytes: AtomicUsize::new(0) }
    }

    /// Allocations that are held now.
    pub fn blocks(&self) -> usize {
        self.blocks.load(Ordering::Relaxed)
    }

    /// Their bytes, as they were asked for.
    pub fn bytes(&self) -> usize {
        self.bytes.load(Ordering::Relaxed)
    }
}

#[expect(unsafe_code, reason = "an allocator is unsafe; the system's does the work")]
// SAFETY: every call goes on to the system's allocator as it came. `realloc` is the trait's own: allocate, copy, free.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        self.blocks.fetch_add(1, Ordering::Relaxed);
        self.bytes.fetch_add(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller keeps to the trait's contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        self.blocks.fetch_sub(1, Ordering::Relaxed);
        self.bytes.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as above, and `at` came from `alloc`.
        unsafe { System.dealloc(at, layout) }
    }
}
