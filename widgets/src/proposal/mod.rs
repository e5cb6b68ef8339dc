//! Figure w17.3, proposals compared: what FastSLAM 1.0 and 2.0 draw for one step, on what they ought to have drawn from.

mod contour;
mod gauge;
mod layout;
mod model;
mod recipe;
mod view;

pub use layout::Layout;
pub use model::ProposalModel;
pub use view::ProposalView;
