//! Figure w17.3, proposals compared: what FastSLAM 1.0 and 2.0 draw for one step, on what they ought to have drawn from.

mod challenges;
mod contour;
mod gauge;
mod ghost;
mod knob;
mod layout;
mod model;
mod names;
mod panel;
mod recipe;
mod strip;
mod told;
mod view;
mod world;
mod zoom;

pub use layout::Layout;
pub use model::ProposalModel;
pub use view::ProposalView;
