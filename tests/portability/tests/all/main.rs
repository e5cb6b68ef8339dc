//! What this build computes against what is kept, in one program: linked with link-time optimisation, as releases are, that is what takes time.

mod numbers;
mod same_bits;
