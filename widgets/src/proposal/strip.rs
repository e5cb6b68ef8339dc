//! What both proposals are worth: the ratio in words and on a scale, and the reader's guess.

use super::{
    gauge, ghost,
    layout::Layout,
    marks::{filled_diamond, line, pointer},
    model::ProposalModel,
    view::GUESS,
};
use crate::{
    decimal::{fixed, write},
    font::Weight,
    scene::{Anchor, Handle, Mark, Rect, Role, Scene, text},
    words::proposal,
};

/// The ratio in words and on a scale, with the reader's guess.
pub fn ratio(scene: &mut Scene, model: &ProposalModel, layout: &Layout) {
    let (now, [words, question], axis) = (model.proposals().ratio(), layout.ratio, layout.axis);
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
    let asked = match (model.guess(), model.at_half()) {
        (None, _) => [proposal::and_half().to_string(), proposal::and_half_short().into()],
        (Some(guess), None) => {
            let guess = &write(guess);
            [proposal::YourGuess { half: &half, guess }.say(), proposal::YourGuessShort { half: &half, guess }.say()]
        }
        (Some(guess), Some(ratio)) => {
            let (ratio, guess) = (&fixed(ratio, 1), &write(guess));
            [
                proposal::YouGuessed { half: &half, ratio, guess }.say(),
                proposal::YouGuessedShort { half: &half, ratio, guess }.say(),
            ]
        }
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
    if let (Some(guess), Some(ratio)) = (model.guess(), model.at_half()) {
        let between = vec![[at(guess), y - 9.0], [at(ratio), y - 9.0]];
        scene.marks.push(Mark::Lines { lines: vec![between], width: 2.0, dash: Some([3.0, 3.0]), role: Role::Accent });
        scene.marks.push(filled_diamond([at(ratio), y - 9.0], 7.0, Role::Ink));
    }
    ghost::ratio(scene, model, &axis, y);
    scene.marks.push(Mark::Discs { centres: vec![[at(now), y]], radius: 5.0, role: Role::Ink });
    if let Some(guess) = model.guess() {
        scene.marks.push(pointer([at(guess), y - 2.0], 8.0));
        scene.handles.push(Handle {
            name: GUESS,
            title: proposal::guess_handle().into(),
            at: [at(guess), y - 9.0],
            axes: &[GUESS],
            value: guess,
            text: proposal::TimesOf { n: &write(guess) }.say(),
            hover: None,
        });
    }
}
