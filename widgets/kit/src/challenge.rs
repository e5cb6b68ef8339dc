//! Challenges: states of a figure that are worth trying, in words, and what there may be to reach from them.
//!
//! A figure lists them beside its parameters ([`Tells::challenges`](crate::model::Tells::challenges)). What a page shows of each is a [`Chip`].

use serde::Serialize;

/// A state to try.
pub struct Challenge<M> {
    /// Identifier, unique in the figure.
    pub name: &'static str,
    /// What it is, in a few words for readers.
    pub title: &'static str,
    /// The state, as a link of the present version has it, without its version.
    pub query: &'static str,
    /// What there is to reach.
    pub check: Option<Check<M>>,
}

/// Something to reach from the state of a challenge.
pub struct Check<M> {
    /// What, in a few words for readers.
    pub goal: &'static str,
    /// Names of the parameters that are left to the reader, apart by spaces. With other values than those of the challenge it is the same
    /// challenge still.
    pub free: &'static str,
    /// Whether the state shown, with what led to it, is what was asked for.
    pub judge: fn(&M) -> Verdict,
}

/// What a check finds.
pub struct Verdict {
    /// Whether the goal is reached.
    pub(crate) done: bool,
    /// How near that is, from 0 to 1.
    pub(crate) near: f64,
    /// The numbers that count, in words.
    pub(crate) said: String,
}

impl Verdict {
    /// Reached or not, how near in parts that have all to be 1 (more counts as 1, and what is no number as 0), and the numbers in words.
    pub fn new(done: bool, parts: &[f64], said: String) -> Self {
        // A goal that is almost reached looks so.
        let near = if done {
            1.0
        } else {
            parts.iter().map(|part| if *part > 0.0 { part.min(1.0) } else { 0.0 }).product::<f64>().min(0.97)
        };
        Self { done, near, said }
    }
}

impl<M> Challenge<M> {
    /// One that is to be looked at.
    pub const fn new(name: &'static str, title: &'static str, query: &'static str) -> Self {
        Self { name, title, query, check: None }
    }

    /// The same with something to reach.
    pub fn with(self, goal: &'static str, free: &'static str, judge: fn(&M) -> Verdict) -> Self {
        Self { check: Some(Check { goal, free, judge }), ..self }
    }
}

/// A challenge as a page shows it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Chip {
    /// [`Challenge::name`].
    pub name: &'static str,
    /// [`Challenge::title`].
    pub title: &'static str,
    /// The link to its state.
    pub query: String,
    /// [`Check::goal`]; empty where there is nothing to reach.
    pub goal: String,
    /// [`Check::free`].
    pub free: Vec<&'static str>,
    /// Whether the figure is in its state now, at whatever step and seed.
    pub now: bool,
    /// The same but for the parameters that it leaves to the reader.
    pub still: bool,
    /// Whether its goal is reached, where it is still the challenge.
    pub done: bool,
    /// How near that is, from 0 to 1.
    pub near: f64,
    /// What its check finds; empty where it is not the challenge, or there is nothing to reach.
    pub said: String,
}
