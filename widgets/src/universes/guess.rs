//! The reader's guesses: how many universes each proposal needs, and what is left of the motion prior with the sharpest sensor.

use super::{
    layout::{Layout, Part},
    model::{PROPOSALS, UniversesModel},
    recipe::MOST,
    share::{self, role},
    told::name,
};
use crate::{
    decimal::write,
    model::Declared,
    prediction::{AROUND, no_guess},
    scene::{Handle, Point, Rect, Role, Scene},
    words::universes as words,
};
use fastslam_lab::experiment::ProposalKind;

/// The guesses.
pub const GUESS: &str = "guess";
/// See [`GUESS`].
pub const GUESS_AWARE: &str = "guess-aware";
/// See [`GUESS`].
pub const GUESS_FLOOR: &str = "guess-floor";

/// Where the markers stand before there is a guess, apart from each other and away from the ends: the motion prior's, the aware
/// proposal's, and that of N_eff \[%\].
pub const MIDDLE: [f64; 3] = [8.0, 4.0, 50.0];

/// Levels of the two markers: they may be of one number.
const LEVELS: [f64; 2] = [0.62, 0.36];

/// Lines at the guesses, what can be dragged, and what is asked or said of it.
pub fn guesses(scene: &mut Scene, model: &UniversesModel, layout: &Layout, taken: &mut Vec<Rect>) {
    let prediction = &model.recipe().prediction;
    if !prediction.predict {
        return;
    }
    if layout.share.is_shown() {
        let judged = prediction.is_shown();
        let guesses = [prediction.guess, model.recipe().guess_aware];
        let asked = (0..2).filter(|k| !judged || guesses[*k].is_some()).map(|k| Guess {
            proposal: PROPOSALS[k],
            guess: guesses[k],
            at: [
                share::x(&layout.share.area, guesses[k].unwrap_or(MIDDLE[k])),
                share::chart(&layout.share).y(LEVELS[k]),
            ],
            value: guesses[k].unwrap_or(MIDDLE[k]),
        });
        let asked: Vec<Guess> = asked.collect();
        // All lines first: the words of one may stand on the line of the other.
        asked.iter().for_each(|guess| guess.line(scene, &layout.share.area));
        asked.iter().for_each(|guess| guess.mark(scene, &layout.share.area, taken, judged));
    }
    if layout.depletion.is_shown() {
        floor(scene, model, &layout.depletion, taken);
    }
}

/// How many universes a proposal is expected to need.
struct Guess {
    proposal: ProposalKind,
    guess: Option<f64>,
    /// Its place, and what is placed there first.
    at: Point,
    value: f64,
}

impl Guess {
    fn line(&self, scene: &mut Scene, area: &Rect) {
        let [x, _] = self.at;
        let dash = if self.guess.is_some() { [5.0, 3.0] } else { [2.0, 4.0] };
        scene.dash(&[[x, area.y], [x, area.bottom()]], 2.0, dash, role(self.proposal));
    }

    fn mark(&self, scene: &mut Scene, area: &Rect, taken: &mut Vec<Rect>, judged: bool) {
        let of = name(self.proposal);
        let said = match self.guess {
            Some(guess) => [
                words::GuessIs { of: &of, guess: &write(guess) }.say(),
                words::GuessShort { guess: &write(guess) }.say(),
            ],
            None => [words::DragHere { of: &of }.say(), of.into()],
        };
        marker(scene, taken, area, self.at, &said);
        if judged {
            return;
        }
        let (axes, title): (&'static [&'static str], _) = match self.proposal {
            ProposalKind::Motion => (&[GUESS], words::guess_handle()),
            ProposalKind::Improved => (&[GUESS_AWARE], words::guess_aware()),
        };
        let text = self.guess.map_or(no_guess().into(), |guess| words::CountOf { m: &write(guess) }.say());
        scene.handles.push(Handle::of(axes, title, self.at, self.value, text));
    }
}

fn floor(scene: &mut Scene, model: &UniversesModel, part: &Part, taken: &mut Vec<Rect>) {
    let guess = model.recipe().guess_floor;
    let judged = model.recipe().prediction.is_shown();
    if judged && guess.is_none() {
        return;
    }
    let area = part.area;
    let percent = guess.unwrap_or(MIDDLE[2]);
    let [x, y] = [area.x + 12.0, share::chart(part).y(0.01 * percent)];
    let dash = if guess.is_some() { [5.0, 3.0] } else { [2.0, 4.0] };
    scene.dash(&[[area.x, y], [area.x + 0.3 * area.w, y]], 2.0, dash, Role::Accent);
    let said = match guess {
        Some(guess) => {
            [words::FloorIs { guess: &write(guess) }.say(), words::FloorShort { guess: &write(guess) }.say()]
        }
        None => [words::drag_floor().into(), words::drag_floor_short().into()],
    };
    marker(scene, taken, &area, [x, y], &said);
    if !judged {
        let text = guess.map_or(no_guess().into(), |guess| format!("{} %", write(guess)));
        scene.handles.push(Handle::of(&[GUESS_FLOOR], words::guess_floor(), [x, y], percent, text));
    }
}

/// A disc that is dragged, and words beside it.
fn marker(scene: &mut Scene, taken: &mut Vec<Rect>, area: &Rect, at: Point, said: &[String; 2]) {
    scene.disc(at, 6.0, Role::Accent);
    scene.label(taken, area, at, said, &AROUND);
}

/// The nearest that can be guessed.
pub fn within(universes: f64) -> f64 {
    universes.round().clamp(1.0, MOST.into())
}
