//! What both proposals are worth: the ratio in words and on a scale, and the reader's guess.

use super::{gauge, ghost, layout::Layout, model::ProposalModel, recipe::RATIOS};
use crate::{
    decimal::{fixed, write},
    prediction::{State, no_guess, off_by},
    scene::{Handle, Rect, Role, Scene, plain, strong},
    words::proposal,
};

/// The guess on the scale of ratios.
pub const GUESS: &str = "guess";

/// The ratio in words and on a scale, with the reader's guess.
pub fn ratio(scene: &mut Scene, model: &ProposalModel, layout: &Layout) {
    let (now, [words, question], axis) = (model.ratio(), layout.ratio, layout.axis);
    let times = fixed(now, 1);
    let wordings = match model.lost().map(|lost| ["A", "B"][lost]) {
        Some(lost) => [
            proposal::RatioLost { times: &times, lost: &lost }.say(),
            proposal::RatioLostShort { times: &times, lost: &lost }.say(),
        ],
        None => [proposal::RatioIs { times: &times }.say(), proposal::RatioShort { times: &times }.say()],
    };
    scene.fit(words, strong(14.0, Role::Ink), &wordings);

    let half = model.half();
    let asked = match (model.state(), model.at_half()) {
        (State::Asked, _) => [proposal::YourTurn { half: &half }.say(), proposal::YourTurnShort { half: &half }.say()],
        (State::Placed(guess), _) => {
            let guess = &write(guess);
            [proposal::YourGuess { half: &half, guess }.say(), proposal::YourGuessShort { half: &half, guess }.say()]
        }
        (State::Guessed(guess), Some(ratio)) => {
            let (off, ratio, guess) = (&off_by(guess, ratio), &fixed(ratio, 1), &write(guess));
            [
                proposal::YouGuessed { half: &half, ratio, guess, off }.say(),
                proposal::YouGuessedShort { half: &half, ratio, guess }.say(),
            ]
        }
        (State::Waived, Some(ratio)) => {
            let ratio = &fixed(ratio, 1);
            [proposal::HalfIs { half: &half, ratio }.say(), proposal::HalfIsShort { half: &half, ratio }.say()]
        }
        _ => [proposal::and_half().to_string(), proposal::and_half_short().into()],
    };
    scene.fit(question, plain(13.0, Role::Ink), &asked);

    // The scale, with a tick and a name at every round ratio.
    let y = axis.y + 24.0;
    let at = |ratio: f64| gauge::position(&axis, ratio);
    let ticks = gauge::TICKS.iter().map(|&tick| vec![[at(tick), y], [at(tick), y + 5.0]]);
    scene.lines(ticks.chain([vec![[axis.x, y], [axis.right(), y]]]).collect(), 1.0, Role::Muted);
    for tick in gauge::TICKS {
        let name = Rect::new(at(tick) - 15.0, y + 6.0, 30.0, 13.0);
        scene.text(name, plain(11.0, Role::Muted).middle(), &format!("{}×", write(tick)));
    }
    let guess = match model.state() {
        State::Placed(guess) | State::Guessed(guess) => Some(guess),
        _ => None,
    };
    if let Some(ratio) = model.at_half() {
        let from = guess.unwrap_or(now);
        scene.dash(&[[at(from), y - 9.0], [at(ratio), y - 9.0]], 2.0, [3.0, 3.0], Role::Accent);
        scene.filled_diamond([at(ratio), y - 9.0], 7.0, Role::Ink);
    }
    ghost::ratio(scene, model, &axis, y);
    scene.disc([at(now), y], 5.0, Role::Ink);
    if matches!(model.state(), State::Off | State::Waived) {
        return;
    }
    // Before there is a guess, the marker stands empty at the end of the scale.
    let place = guess.unwrap_or(RATIOS[0]);
    match guess {
        Some(_) => scene.pointer([at(place), y - 2.0], 8.0),
        None => scene.empty_pointer([at(place), y - 2.0], 8.0),
    }
    scene.handles.push(Handle::of(
        &[GUESS],
        proposal::guess_handle(),
        [at(place), y - 9.0],
        place,
        guess.map_or(no_guess().into(), |guess| proposal::TimesOf { n: &write(guess) }.say()),
    ));
}
