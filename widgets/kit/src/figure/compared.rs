//! The setting that a reader has left last, and the one of now: what is compared, and what is said of it.

use super::Figure;
use crate::comparison::Before;
use crate::ghost::Curves;

impl Figure {
    /// What a reader is about to change by a control: the setting that it leaves is compared with what comes then, unless the same control has
    /// left another one just before.
    pub(super) fn about_to_leave(&self, control: &str) -> Option<Before> {
        let another = self.comparison.control != control;
        self.ask(|model| (another && model.pending() == 0).then(|| Before::of(model)))
    }

    /// A reader has moved the control.
    pub(super) fn left(&mut self, control: &str, before: Option<Before>) {
        if let Some(before) = before.filter(|before| self.ask(|model| before.differs(model))) {
            self.comparison.control = control.into();
            self.comparison.before = Some(before);
        } else if self.comparison.drawn == self.differs() {
            return;
        }
        self.haunt();
    }

    /// Whether there is anything to compare.
    fn differs(&self) -> bool {
        let before = self.comparison.before.as_ref().filter(|_| !self.comparison.off);
        before.is_some_and(|before| self.ask(|model| before.differs(model)))
    }

    /// Whether the setting before is compared with that of now.
    pub fn compare(&mut self, on: bool) {
        self.comparison.off = !on;
        self.haunt();
    }

    pub(super) fn haunt(&mut self) {
        let drawn = self.differs();
        let before = self.comparison.before.as_ref().filter(|_| drawn);
        let curves = before.map_or_else(Curves::new, |before| before.curves.clone());
        self.comparison.drawn = drawn;
        self.tell(|model| model.haunt(curves));
    }

    /// What is different from the setting that a reader has left last, in the figure's language and way of writing numbers: what was set,
    /// and at the same step what came out. Empty where nothing is, or nothing is to be compared.
    pub fn difference(&self) -> String {
        let before = self.comparison.before.as_ref().filter(|_| self.differs());
        self.written(before.map_or(String::new(), |before| self.ask(|model| before.told(model))))
    }

    /// What stands over the picture: where a number was changed what it changed, else what happens now.
    pub fn told(&self) -> String {
        let before = self.comparison.before.as_ref();
        let difference = if before.is_some_and(|before| self.ask(|model| before.in_numbers(model))) {
            self.difference()
        } else {
            String::new()
        };
        if difference.is_empty() { self.written(self.ask(|model| model.narrate())) } else { difference }
    }
}
