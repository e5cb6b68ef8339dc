//! How the value of a row is read from its recipe, and written into it: a table knows of its rows no more than that.

use super::Field;
use crate::param::Value;
use std::{fmt::Display, str::FromStr};

/// Where a recipe R holds a value. Plain functions wherever they suffice: what is done with them is then the same code for all recipes.
pub enum Held<R> {
    /// A number.
    Number(Field<R, f64>),
    /// A number, or none, which is the only word.
    NumberOrNone(Field<R, Option<f64>>),
    /// On or off.
    Flag(Field<R, bool>),
    /// A whole number.
    U32(Field<R, u32>),
    /// A whole number, or none, which is the only word, and any negative number.
    U32OrNone(Field<R, Option<u32>>),
    /// A whole number.
    U64(Field<R, u64>),
    /// A whole number.
    Usize(Field<R, usize>),
    /// What has types of its own.
    Other(Box<dyn Other<R>>),
}

impl<R> Held<R> {
    /// The value in a recipe.
    #[inline(never)]
    pub fn get(&self, recipe: &R) -> Value {
        match self {
            Self::Number(field) => Value::Number((field.get)(recipe)),
            Self::NumberOrNone(field) => (field.get)(recipe).map_or(Value::Word(0), Value::Number),
            Self::Flag(field) => Value::Flag((field.get)(recipe)),
            Self::U32(field) => Value::Number((field.get)(recipe).into()),
            Self::U32OrNone(field) => (field.get)(recipe).map_or(Value::Word(0), |i| Value::Number(i.into())),
            Self::U64(field) => Value::Number((field.get)(recipe) as f64),
            Self::Usize(field) => Value::Number((field.get)(recipe) as f64),
            Self::Other(other) => other.get(recipe),
        }
    }

    /// Gives a recipe a value that its parameter has checked.
    #[inline(never)]
    pub fn set(&self, recipe: &mut R, value: Value) {
        match (self, value) {
            (Self::Number(field), Value::Number(x)) => (field.set)(recipe, x),
            (Self::NumberOrNone(field), Value::Number(x)) => (field.set)(recipe, Some(x)),
            (Self::NumberOrNone(field), _) => (field.set)(recipe, None),
            (Self::Flag(field), Value::Flag(on)) => (field.set)(recipe, on),
            (Self::U32(field), Value::Number(x)) => (field.set)(recipe, x as u32),
            (Self::U32OrNone(field), Value::Number(x)) => (field.set)(recipe, (x >= 0.0).then_some(x as u32)),
            (Self::U32OrNone(field), _) => (field.set)(recipe, None),
            (Self::U64(field), Value::Number(x)) => (field.set)(recipe, x as u64),
            (Self::Usize(field), Value::Number(x)) => (field.set)(recipe, x as usize),
            (Self::Other(other), value) => other.set(recipe, value),
            _ => (),
        }
    }

    /// Whether a text means anything.
    ///
    /// # Errors
    /// What is allowed, for one that means nothing.
    pub fn read(&self, text: &str) -> Result<(), String> {
        if let Self::Other(other) = self { other.read(text) } else { Ok(()) }
    }
}

/// A value of a type of its own.
pub trait Other<R> {
    /// [`Held::get`].
    fn get(&self, recipe: &R) -> Value;

    /// [`Held::set`].
    fn set(&self, recipe: &mut R, value: Value);

    /// [`Held::read`].
    fn read(&self, _text: &str) -> Result<(), String> {
        Ok(())
    }
}

/// One of several meanings, each at the rank of its word.
pub(super) struct Chosen<R, T> {
    pub meanings: Vec<T>,
    pub field: Field<R, T>,
}

impl<R, T: PartialEq + Copy> Other<R> for Chosen<R, T> {
    fn get(&self, recipe: &R) -> Value {
        let now = (self.field.get)(recipe);
        Value::Word(self.meanings.iter().position(|meaning| *meaning == now).unwrap_or(0))
    }

    fn set(&self, recipe: &mut R, value: Value) {
        if let Value::Word(rank) = value {
            (self.field.set)(recipe, self.meanings[rank]);
        }
    }
}

/// What a text means, and what it may be where it means nothing.
pub(super) struct Written<R, T: FromStr> {
    pub field: Field<R, T>,
    pub allowed: fn(T::Err) -> String,
}

impl<R, T: Display + FromStr> Other<R> for Written<R, T> {
    fn get(&self, recipe: &R) -> Value {
        Value::Text((self.field.get)(recipe).to_string())
    }

    fn set(&self, recipe: &mut R, value: Value) {
        if let Value::Text(text) = value
            && let Ok(read) = text.parse()
        {
            (self.field.set)(recipe, read);
        }
    }

    fn read(&self, text: &str) -> Result<(), String> {
        text.parse::<T>().map(drop).map_err(self.allowed)
    }
}
