//! The reader's guess in the chart of ancestors, and beside it what came.

use super::{
    charts::{Picture, SIZE},
    stroke,
};
use crate::{
    decimal::write,
    font::{self, Weight},
    model::Model,
    prediction::{State, off_by},
    scene::{Anchor, Handle, Mark, Rect, Role, Scene, text},
    words::{prediction, resampling},
};

/// The guess on the axis of time.
pub const GUESS: &str = "guess";

impl Picture<'_> {
    /// A line at the guess, another at the result, and what is asked or said about them.
    pub fn predicted(&self, scene: &mut Scene) {
        let Rect { y, h, .. } = self.parts.charts[1];
        let (state, result) = (self.model.state(), self.model.one_left());
        let line = |step: f64, dash, role| {
            let x = self.x(step as u32);
            Mark::Lines { lines: vec![vec![[x, y], [x, y + h]]], width: 2.0, dash, role }
        };
        if let Some(result) = result {
            scene.marks.push(line(result.into(), None, Role::Ink));
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
            State::Asked => scene.marks.push(line(self.middle(), Some([2.0, 4.0]), Role::Accent)),
            State::Placed(guess) | State::Guessed(guess) => {
                scene.marks.push(line(guess, Some([5.0, 3.0]), Role::Accent));
            }
            _ => (),
        }
        self.say(scene, wordings);
        if let State::Asked | State::Placed(_) = state {
            let x = self.x(if let State::Placed(guess) = state { guess } else { self.middle() } as u32);
            let marker = vec![[x, y + 10.0], [x - 6.0, y], [x + 6.0, y]];
            scene.marks.push(Mark::Polygons { polygons: vec![marker], role: Role::Accent });
        }
        if let State::Asked | State::Placed(_) = state {
            scene.handles.push(self.guess(state));
        }
    }

    /// The first wording that fits into the chart, on a plate in its lower half, where no curve is before it is known.
    fn say(&self, scene: &mut Scene, wordings: Vec<String>) {
        let Rect { x, y, w, h } = self.parts.charts[1];
        let width = |words: &String| font::measure(words, SIZE, Weight::SemiBold) + 8.0;
        let Some(words) = wordings.into_iter().find(|words| width(words) <= w - 8.0) else { return };
        let plate = Rect::new(x + w - width(&words) - 4.0, y + 0.5 * h - 8.0, width(&words), 16.0);
        scene.marks.push(Mark::Fill { area: plate, role: Role::Paper });
        scene.marks.push(text(plate, Anchor::Middle, SIZE, Weight::SemiBold, Role::Ink, words));
    }

    /// Where the line stands before there is a guess.
    fn middle(&self) -> f64 {
        f64::from(self.model.course_steps() / 2)
    }

    /// Moves the guess.
    fn guess(&self, state: State) -> Handle {
        let (guess, text) = match state {
            State::Placed(guess) => (guess, resampling::StepIs { step: &write(guess) }.say()),
            _ => (self.middle(), prediction::none().into()),
        };
        let chart = self.parts.charts[1];
        Handle {
            name: GUESS,
            title: resampling::guess_handle().into(),
            at: [self.x(guess as u32), chart.y + 5.0],
            axes: &[GUESS],
            value: guess,
            text,
            hover: None,
        }
    }
}
