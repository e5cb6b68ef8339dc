//! What both proposals are worth: the ratio in words and on a scale, and the reader's guess.

use super::{gauge, ghost, layout::Layout, model::ProposalModel, recipe::RATIOS, view::GUESS};
use crate::{
    decimal::{fixed, write},
    font::Weight,
    marks::{empty_pointer, filled_diamond, line, pointer},
    prediction::{State, off_by},
    scene::{Anchor, Handle, Mark, Rect, Role, Scene, text},
    words::{prediction, proposal},
};

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
    line(scene, &words, 14.0, Weight::SemiBold, Role::Ink, wordings);

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
    line(scene, &question, 13.0, Weight::Regular, Role::Ink, asked);

    // The scale, with a tick and a name at every round ratio.
    let y = axis.y + 24.0;
    let at = |ratio: f64| gauge::position(&axis, ratio);
    let ticks = gauge::TICKS.iter().map(|&tick| vec![[at(tick), y], [at(tick), y + 5.0]]);
    let lines = ticks.chain([vec![[axis.x, y], [axis.right(), y]]]).collect();
    scene.marks.push(Mark::Lines { lines, width: 1.0, dash: None, role: Role::Muted });
    for tick in gauge::TICKS {
        let name = Rect::new(at(tick) - 15.0, y + 6.0, 30.0, 13.0);
        scene.marks.push(text(name, Anchor::Middle, 11.0, Weight::Regular, Role::Muted, format!("{}×", write(tick))));
    }
    let guess = match model.state() {
        State::Placed(guess) | State::Guessed(guess) => Some(guess),
        _ => None,
    };
    if let Some(ratio) = model.at_half() {
        let from = guess.unwrap_or(now);
        let between = vec![[at(from), y - 9.0], [at(ratio), y - 9.0]];
        scene.marks.push(Mark::Lines { lines: vec![between], width: 2.0, dash: Some([3.0, 3.0]), role: Role::Accent });
        scene.marks.push(filled_diamond([at(ratio), y - 9.0], 7.0, Role::Ink));
    }
    ghost::ratio(scene, model, &axis, y);
    scene.marks.push(Mark::Discs { centres: vec![[at(now), y]], radius: 5.0, role: Role::Ink });
    if matches!(model.state(), State::Off | State::Waived) {
        return;
    }
    // Before there is a guess, the marker stands empty at the end of the scale.
    let place = guess.unwrap_or(RATIOS[0]);
    scene.marks.push(if guess.is_some() {
        pointer([at(place), y - 2.0], 8.0)
    } else {
        empty_pointer([at(place), y - 2.0], 8.0)
    });
    scene.handles.push(Handle {
        name: GUESS,
        title: proposal::guess_handle().into(),
        at: [at(place), y - 9.0],
        axes: &[GUESS],
        value: place,
        text: guess.map_or(prediction::none().into(), |guess| proposal::TimesOf { n: &write(guess) }.say()),
        hover: None,
    });
}
