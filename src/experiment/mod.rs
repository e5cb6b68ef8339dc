//! What the chapter's figures and numbers come from: a world, a filter, and a comparison with the truth.

pub mod lap;
pub mod proposals;
pub mod table;
