//! Challenges: states of a figure that are worth trying, in words, and what there may be to reach from them.
//!
//! A figure lists them beside its parameters ([`Declared::challenges`]). What a page shows of each is a [`Chip`].

use crate::{
    model::{Change, Declared, Group, ParamSpec},
    query, recipe,
};
use serde::Serialize;

/// The moment shown and the luck of the draw: neither makes a state another challenge.
const ANY: [&str; 2] = ["step", "seed"];

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
    done: bool,
    /// How near that is, from 0 to 1.
    near: f64,
    /// The numbers that count, in words.
    said: String,
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

    fn offer(&self) -> Offer {
        let Self { name, title, query, .. } = *self;
        Offer { name, title, query, check: self.check.as_ref().map(|check| [check.goal, check.free]) }
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

/// The challenges of a model, and how it stands with them.
pub fn chips<M: Declared>(model: &M) -> Vec<Chip> {
    let challenges = M::challenges();
    let (specs, values) = (recipe::specs(model.recipe()), recipe::values(model.recipe()));
    let offers: Vec<Offer> = challenges.iter().map(Challenge::offer).collect();
    let judge = |k: usize| challenges[k].check.as_ref().map(|check| (check.judge)(model));
    standing(&offers, M::CHANGES, &specs, &values, &judge)
}

/// A challenge without its model.
struct Offer {
    name: &'static str,
    title: &'static str,
    query: &'static str,
    /// [`Check::goal`] and [`Check::free`].
    check: Option<[&'static str; 2]>,
}

impl Offer {
    fn is_free(&self, name: &str) -> bool {
        self.check.is_some_and(|[_, free]| free.split(' ').any(|free| free == name))
    }
}

/// How it stands with what is offered, by these values and by what is found of the one of a rank: compiled once, and not for each figure.
fn standing(
    offers: &[Offer],
    changes: &[Change],
    specs: &[ParamSpec],
    values: &[(&'static str, String)],
    judge: &dyn Fn(usize) -> Option<Verdict>,
) -> Vec<Chip> {
    let asked: Vec<_> = offers.iter().map(|offer| query::pairs(offer.query)).collect();
    let names = |name: &str| asked.iter().flatten().any(|(asked, _)| asked == name);
    // Of what is only shown, that counts which a challenge is about.
    let counts = |name: &str, group| !ANY.contains(&name) && (group == Group::Setup || names(name));
    let differs = |k: usize, forgives: bool| {
        specs.iter().zip(values).any(|(spec, (name, value))| {
            let wanted = asked[k].iter().find(|(asked, _)| asked == name).map_or(&spec.default, |(_, wanted)| wanted);
            counts(name, spec.group) && value != wanted && !(forgives && offers[k].is_free(name))
        })
    };
    let chip = |(k, offer): (usize, &Offer)| {
        let (now, still) = (!differs(k, false), !differs(k, true));
        let verdict = if still { judge(k) } else { None };
        let Verdict { done, near, said } = verdict.unwrap_or(Verdict::new(false, &[0.0], String::new()));
        Chip {
            name: offer.name,
            title: offer.title,
            query: query::versioned(offer.query, changes),
            goal: offer.check.map_or(String::new(), |[goal, _]| goal.into()),
            free: offer.check.map_or(Vec::new(), |[_, free]| free.split(' ').collect()),
            now,
            still,
            done,
            near,
            said,
        }
    };
    offers.iter().enumerate().map(chip).collect()
}
