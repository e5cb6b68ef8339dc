//! How many universes are enough: what share of the laps of exercise 5 ends well, over M, for both proposals; what a rule such as *four of
//! five seeds* makes of that share; and why the motion prior needs so many, which is the depletion of exercise 4.

mod challenges;
mod depletion;
mod guess;
mod layout;
mod model;
mod recipe;
mod share;
mod shipped;
mod told;
mod view;

pub use layout::Layout;
pub use model::UniversesModel;
pub use shipped::{AWARE, LAPS, MOTION};
pub use view::UniversesView;
