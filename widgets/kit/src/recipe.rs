//! A figure's declaration: one typed table, from which its attributes, controls, links and files all follow.
//!
//! A [`Recipe`] is a plain struct of everything that a link can say of a figure. Its table has a [`Param`] a row: what a parameter
//! is called and may be ([`ParamSpec`]), and the [`Field`] of the recipe that holds it.
//!
//! ```
//! use fastslam_figures_kit::{field, recipe::{Param, Recipe, with}};
//!
//! #[derive(Clone, PartialEq, Default)]
//! struct Walk {
//!     steps: u32,
//! }
//!
//! impl Recipe for Walk {
//!     fn table() -> Vec<Param<Self>> {
//!         vec![Param::integer("steps", "Steps", "", (0, 9), field!(steps), "How far it goes.")]
//!     }
//! }
//!
//! let (walk, refused) = with(&Walk::default(), &[("steps".into(), "7".into()), ("steps".into(), "x".into())]);
//! assert_eq!((walk.steps, refused.len()), (7, 1));
//! ```
//!
//! A parameter that cannot be set does not compile, nor one whose field is of another type than its values:
//!
//! ```compile_fail,E0063
//! # use fastslam_figures_kit::recipe::Field;
//! let field: Field<u32, f64> = Field { get: |_| 0.0 };
//! ```

mod held;
mod menu;
mod place;

pub use menu::Menu;
pub use place::{Field, Whole};

use crate::decimal;
use crate::error::FigureError;
use crate::param::{Choice, Group, Kind, ParamSpec, Value, quoted, unknown};
use crate::words::kit;
use held::{Chosen, Held, Written};
use std::fmt::Display;
use std::str::FromStr;

/// A name for readers in a state, or `None` for the usual one.
type Title<R> = fn(&R) -> Option<&'static str>;

/// A row of a figure's table: a parameter, and where its recipe holds it.
pub struct Param<R> {
    spec: ParamSpec,
    /// Its largest number, where that depends on rows above.
    most: Option<fn(&R) -> f64>,
    /// Its name for readers, where that depends on the state.
    title: Option<Title<R>>,
    /// Whether it means anything, where that depends on the state.
    applies: Option<fn(&R) -> bool>,
    held: Held<R>,
}

/// Everything that a link can say of a figure, and nothing else.
pub trait Recipe: Clone + PartialEq + Default + 'static {
    /// A row for each parameter. The range of one may depend on those above it.
    fn table() -> Vec<Param<Self>>;

    /// Changes what has to change along with what was changed: an answer goes with its question.
    fn follow(&mut self, _before: &Self) {}

    /// Refuses values that are each in range but do not go together: they become what they were `before`.
    fn refuse(&mut self, _before: &Self) -> Vec<FigureError> {
        Vec::new()
    }
}

impl<R: Recipe> Param<R> {
    #[inline(never)] // a table of rows that are built in place takes three times as much
    fn new(name: &'static str, title: &'static str, kind: Kind, held: Held<R>, help: &'static str) -> Self {
        let range = if matches!(kind, Kind::Choice | Kind::Text) { (0.0, 0.0, 0.0) } else { (0.0, 1.0, 1.0) };
        let spec = ParamSpec::new(name, title, kind, range, help);
        Self { spec, most: None, title: None, applies: None, held }
    }

    /// A number of the setup, from the first of the range to the second; a slider goes by the third.
    #[inline(never)]
    pub fn number(
        name: &'static str,
        title: &'static str,
        unit: &'static str,
        (min, max, step): (f64, f64, f64),
        field: Field<R, f64>,
        help: &'static str,
    ) -> Self {
        let param = Self::new(name, title, Kind::Number, Held::Number(field), help);
        // A sum of decimals is a little beside the decimal that is written for it.
        let [min, max] = [min, max].map(decimal::as_written);
        Self { spec: ParamSpec { unit, min, max, step, ..param.spec }, ..param }
    }

    /// A whole number of the setup, from the first of the range to the second.
    #[inline(never)]
    pub fn integer<I: Whole>(
        name: &'static str,
        title: &'static str,
        unit: &'static str,
        (min, max): (u32, u32),
        field: Field<R, I>,
        help: &'static str,
    ) -> Self {
        let param = Self::new(name, title, Kind::Integer, I::held(field), help);
        Self { spec: ParamSpec { unit, min: min.into(), max: max.into(), ..param.spec }, ..param }
    }

    /// The seed, of whatever it picks.
    pub fn seed(field: Field<R, u64>, help: &'static str) -> Self {
        Self::integer("seed", kit::seed(), "", (0, u32::MAX), field, help)
    }

    /// A whole number from 0 on, up to a bound that depends on rows above; or none of them, which is the word, and −1.
    #[inline(never)]
    pub fn integer_or(
        name: &'static str,
        title: &'static str,
        (word, word_title): (&'static str, &'static str),
        most: fn(&R) -> f64,
        field: Field<R, Option<u32>>,
        help: &'static str,
    ) -> Self {
        let param = Self::new(name, title, Kind::Integer, Held::U32OrNone(field), help);
        let choices = vec![Choice::new(word, word_title)];
        Self { spec: ParamSpec { min: -1.0, choices, ..param.spec }, ..param }.at_most(most)
    }

    /// A number in a range, or none, which is the word.
    #[inline(never)]
    pub fn number_or(
        name: &'static str,
        title: &'static str,
        unit: &'static str,
        (min, max, step): (f64, f64, f64),
        (word, word_title): (&'static str, &'static str),
        field: Field<R, Option<f64>>,
        help: &'static str,
    ) -> Self {
        let param = Self::new(name, title, Kind::Number, Held::NumberOrNone(field), help);
        let choices = vec![Choice::new(word, word_title)];
        Self { spec: ParamSpec { unit, min, max, step, choices, ..param.spec }, ..param }
    }

    /// One of some words.
    pub fn choice<T: PartialEq + Copy + 'static>(
        name: &'static str,
        title: &'static str,
        Menu { choices, meanings }: Menu<T>,
        field: Field<R, T>,
        help: &'static str,
    ) -> Self {
        let held = Held::Other(Box::new(Chosen { meanings, field }));
        let param = Self::new(name, title, Kind::Choice, held, help);
        Self { spec: ParamSpec { choices, ..param.spec }, ..param }
    }

    /// A checkbox.
    #[inline(never)]
    pub fn flag(name: &'static str, title: &'static str, field: Field<R, bool>, help: &'static str) -> Self {
        Self::new(name, title, Kind::Flag, Held::Flag(field), help)
    }

    /// A button that stays pressed.
    #[inline(never)]
    pub fn toggle(name: &'static str, title: &'static str, field: Field<R, bool>, help: &'static str) -> Self {
        let param = Self::flag(name, title, field, help);
        Self { spec: ParamSpec { kind: Kind::Toggle, ..param.spec }, ..param }
    }

    /// A text, as its type writes and reads it; `allowed` says what it may be where it cannot be read, in words that follow *must be*.
    pub fn text<T: Display + FromStr + 'static>(
        name: &'static str,
        title: &'static str,
        field: Field<R, T>,
        allowed: fn(T::Err) -> String,
        help: &'static str,
    ) -> Self {
        Self::new(name, title, Kind::Text, Held::Other(Box::new(Written { field, allowed })), help)
    }

    /// The same as a parameter of what is shown.
    #[inline(never)]
    pub fn view(mut self) -> Self {
        self.spec.group = Group::View;
        self
    }

    /// The same set by its box alone: where there are twenty numbers, a slider each is too much.
    #[inline(never)]
    pub fn without_slider(mut self) -> Self {
        self.spec.slider = false;
        self
    }

    /// The same in first sight: of a figure's parameters one or two that it is about.
    #[inline(never)]
    pub fn in_sight(mut self) -> Self {
        self.spec.sight = true;
        self
    }

    /// The same offered only in states where it means anything.
    #[inline(never)]
    pub fn only_where(self, applies: fn(&R) -> bool) -> Self {
        Self { applies: Some(applies), ..self }
    }

    /// The same folded away, among *More settings*.
    #[inline(never)]
    pub fn folded(mut self) -> Self {
        self.spec.folded = true;
        self
    }

    /// The same up to a bound that depends on rows above.
    #[inline(never)]
    pub fn at_most(self, most: fn(&R) -> f64) -> Self {
        Self { most: Some(most), ..self }
    }

    /// The same under another name where the state asks for that.
    #[inline(never)]
    pub fn titled(self, title: Title<R>) -> Self {
        Self { title: Some(title), ..self }
    }

    /// Its range and its name in this recipe, and its value in the default one.
    fn spec(&self, recipe: &R) -> ParamSpec {
        let most = self.most.map(|most| most(recipe));
        let title = self.title.and_then(|title| title(recipe));
        let applies = self.applies.is_none_or(|applies| applies(recipe));
        in_state(&self.spec, self.held.get(&R::default()), most, title, applies)
    }

    /// Brings a value that is out of its range to the nearest in it, or where there is a word besides, to that.
    fn confine(&self, recipe: &mut R) {
        if let Some(near) = near(&self.spec(recipe), &self.held.get(recipe)) {
            self.held.set(recipe, near);
        }
    }
}

/// A row in a state.
fn in_state(
    usual: &ParamSpec,
    default: Value,
    most: Option<f64>,
    title: Option<&'static str>,
    applies: bool,
) -> ParamSpec {
    let (default, max, title) = (usual.text(default), most.unwrap_or(usual.max), title.unwrap_or(usual.title));
    ParamSpec { title, max, default, applies, ..usual.clone() }
}

/// What stands in the place of a value that is out of its range.
fn near(spec: &ParamSpec, value: &Value) -> Option<Value> {
    let Value::Number(x) = *value else { return None };
    let near = if spec.choices.is_empty() { Value::Number(x.max(spec.min).min(spec.max)) } else { Value::Word(0) };
    spec.within(x).is_none().then_some(near)
}

/// A table and the recipe that is filled by it, of whichever figure: what is done with the rows is compiled once, and not for each.
trait Rows {
    /// Brings the value of a row into its range, as the rows above it have it now; its range. None beyond the last.
    fn confined(&mut self, row: usize) -> Option<ParamSpec>;

    /// Whether a text means anything in a row; if not, what is allowed.
    fn read(&self, row: usize, text: &str) -> Result<(), String>;

    fn set(&mut self, row: usize, value: Value);
}

struct Filled<R> {
    table: Vec<Param<R>>,
    recipe: R,
}

impl<R: Recipe> Rows for Filled<R> {
    fn confined(&mut self, row: usize) -> Option<ParamSpec> {
        let param = self.table.get(row)?;
        param.confine(&mut self.recipe);
        Some(param.spec(&self.recipe))
    }

    fn read(&self, row: usize, text: &str) -> Result<(), String> {
        self.table[row].held.read(text)
    }

    fn set(&mut self, row: usize, value: Value) {
        self.table[row].held.set(&mut self.recipe, value);
    }
}

/// Gives the rows these values, and returns what is refused of them, and for how many there was a row.
fn fill(rows: &mut dyn Rows, values: &[(String, String)]) -> (Vec<FigureError>, usize) {
    let (mut refused, mut known) = (Vec::new(), 0);
    let mut row = 0;
    while let Some(spec) = rows.confined(row) {
        let named = values.iter().filter(|(name, _)| name == spec.name);
        for (_, text) in named {
            known += 1;
            match meaning(&spec, text, |text| rows.read(row, text)) {
                Ok(value) => rows.set(row, value),
                Err(error) => refused.push(error),
            }
        }
        row += 1;
    }
    (refused, known)
}

/// The value that `text` means, or what is wrong with it.
fn meaning(spec: &ParamSpec, text: &str, read: impl FnOnce(&str) -> Result<(), String>) -> Result<Value, FigureError> {
    let value = spec.check(text)?;
    if let Value::Text(text) = &value {
        read(text).map_err(|allowed| FigureError::new(spec.name, quoted(text), allowed))?;
    }
    Ok(value)
}

/// What is refused of values because no row has their name.
fn strangers(values: &[(String, String)], specs: &[ParamSpec]) -> Vec<FigureError> {
    let others = values.iter().filter(|(name, _)| !specs.iter().any(|spec| spec.name == name));
    others.map(|(name, _)| unknown(name, specs)).collect()
}

/// All parameters with their ranges in this recipe.
pub fn specs<R: Recipe>(recipe: &R) -> Vec<ParamSpec> {
    R::table().iter().map(|param| param.spec(recipe)).collect()
}

/// The values of all parameters by name, as text.
pub fn values<R: Recipe>(recipe: &R) -> Vec<(&'static str, String)> {
    R::table().iter().map(|param| (param.spec.name, param.spec.text(param.held.get(recipe)))).collect()
}

/// The recipe with these values by name, and what was refused of them. Row by row, whatever the order of the values: a row finds the ones
/// above it as they will be, and what no longer fits to them is brought into its range.
#[inline(never)] // figures with a job call it twice
pub fn with<R: Recipe>(before: &R, values: &[(String, String)]) -> (R, Vec<FigureError>) {
    let mut filled = Filled { table: R::table(), recipe: before.clone() };
    let (mut refused, known) = fill(&mut filled, values);
    let mut recipe = filled.recipe;
    recipe.follow(before);
    refused.extend(recipe.refuse(before));
    if known < values.len() {
        refused.extend(strangers(values, &specs(&recipe)));
    }
    (recipe, refused)
}

/// The recipe with every number in its range.
pub fn confined<R: Recipe>(mut recipe: R) -> R {
    R::table().iter().for_each(|param| param.confine(&mut recipe));
    recipe
}

#[cfg(test)]
mod tests;
