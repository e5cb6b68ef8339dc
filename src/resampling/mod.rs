//! Selection: *when* to resample ([`ResamplePolicy`]) apart from *how* ([`Scheme`]).

mod policy;
mod scheme;

pub use policy::ResamplePolicy;
pub use scheme::{Scheme, systematic};
