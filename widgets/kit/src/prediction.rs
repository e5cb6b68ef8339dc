//! A prediction: what a reader is asked for before a result is shown, the same in every figure that asks.
//!
//! Three parameters hold it: `predict` asks, `guess` is what the reader expects, and `run` lets the result be seen. Who runs without a
//! guess has waived it. Until then a figure shows, tells and writes nothing that the result could be read from; and whatever changes what
//! is asked for takes guess and result away.

mod level;

pub use level::{AROUND, GUESS, Level, level};

use crate::{
    decimal::fixed,
    recipe::{Field, Param, Recipe},
    words::prediction,
};
use serde::Serialize;

/// What a recipe holds of it.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Prediction {
    /// Whether the reader is asked.
    pub predict: bool,
    /// What the reader expects, once that was placed.
    pub guess: Option<f64>,
    /// Whether the result is to be seen.
    pub run: bool,
}

/// How far a prediction is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum State {
    /// Nobody is asked.
    Off,
    /// There is no guess yet.
    Asked,
    /// There is one, and the result is still hidden.
    Placed(f64),
    /// Guess and result stand side by side.
    Guessed(f64),
    /// The result is shown to a reader who did not guess.
    Waived,
}

/// What comes of a prediction: for events, and for data.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Outcome {
    /// Name of what is predicted.
    pub name: &'static str,
    /// What the reader expected; `None` where that was waived, or is not yet placed.
    pub guess: Option<f64>,
    /// What it is, once it is shown. `None` before that, and where it never comes.
    pub result: Option<f64>,
    /// Whether the reader has seen the result without a guess.
    pub waived: bool,
    /// Whether the result is shown.
    pub shown: bool,
}

impl Prediction {
    /// How far it is.
    pub fn state(&self) -> State {
        match (self.predict, self.guess, self.run) {
            (false, ..) => State::Off,
            (_, None, false) => State::Asked,
            (_, None, true) => State::Waived,
            (_, Some(guess), false) => State::Placed(guess),
            (_, Some(guess), true) => State::Guessed(guess),
        }
    }

    /// Whether the result must not be seen yet.
    pub fn hides(&self) -> bool {
        self.predict && !self.run
    }

    /// Whether the result is shown, with a guess or without.
    pub fn is_shown(&self) -> bool {
        self.predict && self.run
    }

    /// Takes guess and result away: what is asked for is another question now.
    pub fn ask_anew(&mut self) {
        (self.guess, self.run) = (None, false);
    }

    /// Places a guess. Another one than before is another try.
    pub fn place(&mut self, guess: Option<f64>) {
        (self.run, self.guess) = (self.run && self.guess == guess, guess);
    }

    /// What comes of it, if the reader is asked.
    pub fn outcome(&self, name: &'static str, result: Option<f64>) -> Option<Outcome> {
        let (shown, guess) = (self.is_shown(), self.guess);
        let result = result.filter(|x| shown && x.is_finite());
        self.predict.then(|| Outcome { name, guess, result, waived: shown && guess.is_none(), shown })
    }
}

/// A recipe with a prediction.
pub trait Predicts: Recipe {
    /// The prediction.
    fn prediction(&self) -> &Prediction;
    /// The same, to be changed.
    fn prediction_mut(&mut self) -> &mut Prediction;
}

/// Makes a recipe one that [`Predicts`]: its field `prediction` holds it.
#[macro_export]
macro_rules! predicts {
    ($recipe:ty) => {
        impl $crate::prediction::Predicts for $recipe {
            fn prediction(&self) -> &$crate::prediction::Prediction {
                &self.prediction
            }

            fn prediction_mut(&mut self) -> &mut $crate::prediction::Prediction {
                &mut self.prediction
            }
        }
    };
}
pub use predicts;

/// What the parameters are called and what they do, in the words of the figure.
pub struct Asks {
    /// What `predict` asks.
    pub predict_help: &'static str,
    /// What `guess` is.
    pub guess_help: &'static str,
    /// The unit of the guess, and its range and step.
    pub unit: &'static str,
    /// See there.
    pub range: (f64, f64, f64),
    /// What `run` is called once there is a guess, and what it does.
    pub run: [&'static str; 2],
}

/// Whether a reader predicts: only then there is anything to guess and to run.
pub fn is_asked<R: Predicts>(recipe: &R) -> bool {
    recipe.prediction().predict
}

/// The rows of a table that hold a prediction. They stand below all that it asks about, and above what shows it.
pub fn rows<R: Predicts>(asks: Asks) -> [Param<R>; 3] {
    let predict = Field {
        get: |recipe: &R| recipe.prediction().predict,
        set: |recipe: &mut R, on| {
            let prediction = recipe.prediction_mut();
            prediction.predict = on;
            if !on {
                prediction.ask_anew();
            }
        },
    };
    let guess = Field {
        get: |recipe: &R| recipe.prediction().guess,
        set: |recipe: &mut R, guess| recipe.prediction_mut().place(guess),
    };
    let run = Field {
        get: |recipe: &R| recipe.prediction().run,
        set: |recipe: &mut R, on| {
            let prediction = recipe.prediction_mut();
            match (prediction.predict, on) {
                (true, true) => prediction.run = true,
                // Nobody was asked yet: now one is.
                (false, true) => prediction.predict = true,
                (_, false) if prediction.run => prediction.ask_anew(),
                _ => (),
            }
        },
    };
    [
        Param::toggle("predict", prediction::predict(), predict, asks.predict_help).view().in_sight(),
        Param::number_or(
            "guess",
            prediction::guess(),
            asks.unit,
            asks.range,
            ("none", prediction::none()),
            guess,
            asks.guess_help,
        )
        .view()
        .without_slider()
        .in_sight()
        .only_where(is_asked),
        Param::toggle("run", asks.run[0], run, asks.run[1]).view().in_sight().only_where(is_asked).titled(
            |recipe: &R| {
                let asked = recipe.prediction().state() == State::Asked;
                asked.then(prediction::show_me)
            },
        ),
    ]
}

/// What stands in the place of a guess before there is one.
pub fn no_guess() -> &'static str {
    prediction::none()
}

/// How far a guess is off, in words.
pub fn off_by(guess: f64, result: f64) -> String {
    let percent = fixed(100.0 * (guess / result - 1.0).abs(), 0);
    match percent.as_str() {
        "0" => prediction::right().into(),
        _ if guess < result => prediction::TooLow { percent: &percent }.say(),
        _ => prediction::TooHigh { percent: &percent }.say(),
    }
}
