//! A reader's guess as a level across a chart or a strip.

use super::State;
use crate::{
    marks::{Place, label},
    scene::{Handle, Mark, Point, Rect, Role, Scene},
    words::prediction,
};

/// What a reader moves up and down.
pub const GUESS: &str = "guess";

/// The level, and what is asked or said of it.
pub struct Level<'a> {
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
    pub said: [&'a str; 2],
}

/// Draws it across an area, with the words where nothing is taken: nothing where nobody is asked, or where it was waived.
pub fn level(scene: &mut Scene, area: &Rect, taken: &mut Vec<Rect>, level: Level<'_>) {
    let Level { state, at, title, value, text, said } = level;
    if matches!(state, State::Off | State::Waived) {
        return;
    }
    let dash = Some(if state == State::Asked { [2.0, 4.0] } else { [5.0, 3.0] });
    let line = vec![vec![[area.x, at[1]], [area.right(), at[1]]]];
    scene.marks.push(Mark::Lines { lines: line, width: 2.0, dash, role: Role::Accent });
    if matches!(state, State::Asked | State::Placed(_)) {
        scene.marks.push(Mark::Discs { centres: vec![at], radius: 6.0, role: Role::Accent });
        let text = if state == State::Asked { prediction::none().into() } else { text };
        let title = title.into();
        scene.handles.push(Handle { name: GUESS, title, at, axes: &[GUESS], value, text, hover: None });
    }
    let places = [Place::Right(11.0), Place::Left(11.0), Place::Above(9.0), Place::Below(9.0)];
    label(scene, taken, area, at, &said, &places);
}
