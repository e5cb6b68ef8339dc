//! What follows from what a figure declares of its parameters and its challenges.

use crate::{
    challenge::{Challenge, Chip, Verdict},
    error::FigureError,
    model::{Change, Declared, Parameters, Tells},
    param::{Group, ParamSpec},
    query, recipe,
};

/// The moment shown and the luck of the draw: neither makes a state another challenge.
const ANY: [&str; 2] = ["step", "seed"];

impl<M: Declared + Tells> Parameters for M {
    fn title(&self) -> &'static str {
        M::TITLE
    }

    fn changes(&self) -> &'static [Change] {
        M::CHANGES
    }

    fn unsaid(&self) -> usize {
        M::UNSAID
    }

    fn chips(&self) -> Vec<Chip> {
        chips(self)
    }

    fn params(&self) -> Vec<ParamSpec> {
        recipe::specs(self.recipe())
    }

    fn values(&self) -> Vec<(&'static str, String)> {
        recipe::values(self.recipe())
    }

    fn configure(&mut self, values: &[(String, String)]) -> Vec<FigureError> {
        let before = self.recipe().clone();
        adopted(self, &before, values)
    }

    fn load(&mut self, values: &[(String, String)]) -> Vec<FigureError> {
        adopted(self, &M::Recipe::default(), values)
    }
}

/// Has a model take over these values from a recipe on.
#[inline(never)] // a program has it once for each figure
fn adopted<M: Declared>(model: &mut M, before: &M::Recipe, values: &[(String, String)]) -> Vec<FigureError> {
    let (recipe, mut refused) = recipe::with(before, values);
    refused.extend(model.adopt(recipe).err());
    refused
}

/// The challenges of a model, and how it stands with them.
fn chips<M: Declared + Tells>(model: &M) -> Vec<Chip> {
    let challenges = M::challenges();
    let (specs, values) = (recipe::specs(model.recipe()), recipe::values(model.recipe()));
    let offers: Vec<Offer> = challenges.iter().map(Offer::of).collect();
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
    fn of<M>(challenge: &Challenge<M>) -> Self {
        let Challenge { name, title, query, ref check } = *challenge;
        Self { name, title, query, check: check.as_ref().map(|check| [check.goal, check.free]) }
    }

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
