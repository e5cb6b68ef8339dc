//! The reader's guess in the chart of ancestors, and beside it what came.

use super::{
    charts::{Picture, SIZE},
    stroke,
};
use crate::{
    decimal::write,
    model::Model,
    prediction::{State, no_guess, off_by},
    scene::{Handle, Rect, Role, Scene, strong},
    words::resampling,
};

/// The guess on the axis of time.
pub const GUESS: &str = "guess";

impl Picture<'_> {
    /// A line at the guess, another at the result, and what is asked or said about them.
    pub fn predicted(&self, scene: &mut Scene) {
        let Rect { y, h, .. } = self.parts.charts[1];
        let (state, result) = (self.model.state(), self.model.one_left());
        let line = |step: f64| [y, y + h].map(|y| [self.x(step as u32), y]);
        if let Some(result) = result {
            scene.line(&line(result.into()), 2.0, Role::Ink);
        }
        let wordings = match (state, result) {
            (State::Off, _) => return,
            (State::Asked, _) => {
                let policy = &stroke::NAMES[self.chosen()]();
                vec![resampling::When { policy }.say(), resampling::when_short().into()]
            }
            (State::Placed(guess), _) => vec![resampling::WhenPlaced { guess: &write(guess) }.say()],
            (State::Guessed(guess), Some(result)) => {
                let (guess, off) = (&write(guess), &off_by(guess, result.into()));
                vec![resampling::CameShort { guess, result: &result, off }.say()]
            }
            (State::Waived, Some(result)) => vec![resampling::CameAlone { result: &result }.say()],
            _ if self.model.pending() > 0 => Vec::new(),
            (State::Guessed(guess), None) => {
                let guess = &write(guess);
                vec![resampling::NeverCameShort { guess }.say(), resampling::never_came_alone().into()]
            }
            (State::Waived, None) => vec![resampling::never_came_alone().into()],
        };
        match state {
            State::Asked => scene.dash(&line(self.middle()), 2.0, [2.0, 4.0], Role::Accent),
            State::Placed(guess) | State::Guessed(guess) => scene.dash(&line(guess), 2.0, [5.0, 3.0], Role::Accent),
            _ => (),
        }
        self.say(scene, &wordings);
        if let State::Asked | State::Placed(_) = state {
            let x = self.x(if let State::Placed(guess) = state { guess } else { self.middle() } as u32);
            scene.polygon(vec![[x, y + 10.0], [x - 6.0, y], [x + 6.0, y]], Role::Accent);
            scene.handles.push(self.guess(state));
        }
    }

    /// The first wording that fits into the chart, on a plate in its lower half, where no curve is before it is known.
    fn say(&self, scene: &mut Scene, wordings: &[String]) {
        let Rect { x, y, w, h } = self.parts.charts[1];
        let letters = strong(SIZE, Role::Ink).middle();
        let Some(words) = letters.fitting(w - 16.0, wordings) else { return };
        let width = letters.width(words) + 8.0;
        let plate = Rect::new(x + w - width - 4.0, y + 0.5 * h - 8.0, width, 16.0);
        scene.fill(plate, Role::Paper);
        scene.text(plate, letters, words);
    }

    /// Where the line stands before there is a guess.
    fn middle(&self) -> f64 {
        f64::from(self.model.course_steps() / 2)
    }

    /// Moves the guess.
    fn guess(&self, state: State) -> Handle {
        let (guess, text) = match state {
            State::Placed(guess) => (guess, resampling::StepIs { step: &write(guess) }.say()),
            _ => (self.middle(), no_guess().into()),
        };
        let chart = self.parts.charts[1];
        Handle::of(&[GUESS], resampling::guess_handle(), [self.x(guess as u32), chart.y + 5.0], guess, text)
    }
}
