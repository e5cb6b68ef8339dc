//! A reader's guess as a level across a chart or a strip.

use super::State;
use crate::{
    marks::Place,
    scene::{Handle, Point, Rect, Role, Scene},
    words::prediction,
};

/// What a reader moves up and down.
pub const GUESS: &str = "guess";

/// Where words stand about what is grasped, from the best place on.
pub const AROUND: [Place; 4] = [Place::Right(11.0), Place::Left(11.0), Place::Above(9.0), Place::Below(9.0)];

/// The level, and what is asked or said of it.
pub struct Level {
    /// How far the prediction is.
    pub state: State,
    /// Where it is grasped, at the height of the guess, or where that would begin.
    pub at: Point,
    /// What the handle is called, the guess there, and how that is written.
    pub title: &'static str,
    /// See there.
    pub value: f64,
    /// See there.
    pub text: String,
    /// The same in the picture, from long to short.
    pub said: [String; 2],
}

/// Draws it across an area, with the words where nothing is taken: nothing where nobody is asked, or where it was waived.
pub fn level(scene: &mut Scene, area: &Rect, taken: &mut Vec<Rect>, level: Level) {
    let Level { state, at, title, value, text, said } = level;
    if matches!(state, State::Off | State::Waived) {
        return;
    }
    let dash = if state == State::Asked { [2.0, 4.0] } else { [5.0, 3.0] };
    scene.dash(&[[area.x, at[1]], [area.right(), at[1]]], 2.0, dash, Role::Accent);
    if matches!(state, State::Asked | State::Placed(_)) {
        scene.disc(at, 6.0, Role::Accent);
        let text = if state == State::Asked { prediction::none().into() } else { text };
        scene.handles.push(Handle::of(&[GUESS], title, at, value, text));
    }
    scene.label(taken, area, at, &said, &AROUND);
}
