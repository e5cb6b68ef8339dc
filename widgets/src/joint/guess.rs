//! The reader's guess in the chart, where the sampled map's line is to reach the bottom, and what came.

use super::model::JointModel;
use crate::{
    decimal::write,
    prediction::{AROUND, State, no_guess, off_by},
    scene::{Chart, Handle, Role, Scene},
    words::joint,
};
use fastslam_lab::experiment::joint::MOST;

/// What a reader moves along the axis.
pub const GUESS: &str = "guess";

/// Where it stands before there is a guess: in the middle of the axis.
pub const MIDDLE: f64 = 12.0;

/// Height at which it is dragged, as a share of the chart's.
const LEVEL: f64 = 0.45;

/// A line at the guess with what is asked or said of it.
pub fn guess(scene: &mut Scene, model: &JointModel, chart: &Chart) {
    let state = model.state();
    let result = model.below_one();
    let (guess, said) = match (state, result) {
        (State::Off | State::Waived, _) => return,
        (State::Asked, _) => (MIDDLE, [joint::drag_here(), joint::drag_short()].map(String::from)),
        (State::Placed(guess), _) => (guess, [joint::GuessIs { guess: &write(guess) }.say(), write(guess)]),
        (State::Guessed(guess), Some(result)) => {
            let (guess_text, off) = (&write(guess), &off_by(guess, result.into()));
            let said = joint::GuessedShort { guess: guess_text, off }.say();
            (guess, [said, joint::GuessedIs { guess: guess_text }.say()])
        }
        (State::Guessed(guess), None) => {
            let guess_text = &write(guess);
            let said = joint::GuessedNever { guess: guess_text, all: &MOST }.say();
            (guess, [said, joint::GuessedIs { guess: guess_text }.say()])
        }
    };
    let open = matches!(state, State::Asked | State::Placed(_));
    let [x, y] = [chart.x(guess as u32), chart.y(LEVEL)];
    let dash = if state == State::Asked { [2.0, 4.0] } else { [5.0, 3.0] };
    scene.dash(&[[x, chart.area.y], [x, chart.area.bottom()]], 2.0, dash, Role::Accent);
    if open {
        scene.disc([x, y], 6.0, Role::Accent);
        let text =
            if state == State::Asked { no_guess().into() } else { joint::GuessIs { guess: &write(guess) }.say() };
        scene.handles.push(Handle::of(&[GUESS], joint::guess_handle(), [x, y], guess, text));
    }
    scene.label(&mut Vec::new(), &chart.area, [x, y], &said, &AROUND);
}
