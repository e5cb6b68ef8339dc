//! Six identical doors: particles that each decide which one they see, and an EKF that decides once for all.

mod challenges;
mod count;
mod history;
mod layout;
mod model;
mod recipe;
mod strip;
mod told;
mod view;

pub use count::DOORS;
pub use layout::Layout;
pub use model::DoorsModel;
pub use view::DoorsView;
