//! What the chapter's figures and numbers come from: a world, a filter, and a comparison with the truth.

pub mod conditioning;
pub mod lap;
pub mod table;
