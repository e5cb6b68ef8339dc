//! What the tree of all paths holds over 10⁵ steps: not a time, so criterion has no part in it. Writes a line of JSON for each way to
//! resample, which `npm run bench` reads.

use fastslam::resampling::{ResamplePolicy, Scheme};
use laws::{Counting, crown, drifting};

#[global_allocator]
static ALLOCATED: Counting = Counting::new();

const STEPS: u32 = 100_000;
const PARTICLES: usize = 64;

fn main() {
    for (name, policy, scheme) in [
        ("multinomial, every step", ResamplePolicy::Always, Scheme::Multinomial),
        ("systematic, every step", ResamplePolicy::Always, Scheme::Systematic),
        ("systematic, N_eff below M / 2", ResamplePolicy::EssBelow(0.5), Scheme::Systematic),
    ] {
        let before = (ALLOCATED.blocks(), ALLOCATED.bytes());
        let mut filter = drifting(policy, scheme, PARTICLES);
        let (mut sum, mut most) = (0.0, f64::NEG_INFINITY);
        for step in 1..=STEPS {
            filter.step(&(), &());
            let c = crown(filter.descent().size(), step, PARTICLES);
            sum += c;
            most = f64::max(most, c);
        }
        let (nodes, mean) = (filter.descent().size(), sum / f64::from(STEPS));
        let (blocks, bytes) = (ALLOCATED.blocks() - before.0, ALLOCATED.bytes() - before.1);
        println!(
            r#"{{"tree":"{name}","steps":{STEPS},"particles":{PARTICLES},"nodes":{nodes},"blocks":{blocks},"bytes":{bytes},"c_mean":{mean:.3},"c_most":{most:.3}}}"#
        );
    }
}
