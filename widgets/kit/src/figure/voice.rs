//! The one place where a language is spoken.

use crate::{view::Shown, words::Language};

/// A model with its view. Whatever is asked of them is asked in the figure's language: there is no other way to them.
pub(super) struct Voice {
    language: Language,
    shown: Box<dyn Shown>,
}

impl Voice {
    /// Speaks English.
    pub fn of(shown: Box<dyn Shown>) -> Self {
        Self { language: Language::default(), shown }
    }

    /// Speaks another language from now on.
    pub fn learn(&mut self, catalogue: &str) {
        self.language = Language::learnt(catalogue);
    }

    pub fn ask<T>(&self, ask: impl FnOnce(&dyn Shown) -> T) -> T {
        let _speaking = self.language.spoken();
        ask(&*self.shown)
    }

    pub fn tell<T>(&mut self, tell: impl FnOnce(&mut dyn Shown) -> T) -> T {
        let _speaking = self.language.spoken();
        tell(&mut *self.shown)
    }

    /// What can be looked at without a word: tests and tools, which speak English.
    pub fn mute(&self) -> &dyn Shown {
        &*self.shown
    }

    /// See [`Voice::mute`].
    pub fn mute_mut(&mut self) -> &mut dyn Shown {
        &mut *self.shown
    }
}
