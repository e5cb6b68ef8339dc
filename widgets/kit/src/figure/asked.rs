//! What a figure is asked, and which of it holds. What is locked keeps its author's value; else a reader's link stands over what the
//! author gave, and that over the default. What is set later, by whomever, stands over what was set before.

use super::Figure;
use crate::{
    action::{Action, Beginning, Size, Touch},
    decimal,
    frame::Layout,
    model::FigureError,
    query,
};

/// What was asked until now, as far as it is no part of the figure's state.
#[derive(Default)]
pub(super) struct Asked {
    pub size: Option<Size>,
    pub layout: Option<Layout>,
    /// Whether a parameter was changed, and nobody knows yet.
    pub changed: bool,
    /// Whether a trace is to be told.
    pub traces: bool,
    /// Whether it was at what was asked for, at least once.
    pub arrived: bool,
    began: bool,
    /// The step, as it was asked for.
    target: f64,
    /// The code that the page's author gave, with its version, and the defaults of that version where they are others now.
    authored: String,
    usual: Vec<(String, String)>,
    lock: String,
    /// What a pointer has changed by passing over it: the values to go back to.
    followed: Vec<(&'static str, String)>,
}

type Refused = Vec<FigureError>;

impl Figure {
    /// Does what is asked, and returns what is refused of it. An empty message says that nothing is wrong any more; that of `locked` is the
    /// name of a parameter, which the page says to be fixed.
    pub fn act(&mut self, action: &Action) -> Vec<FigureError> {
        let mut refused = Vec::new();
        match action {
            Action::Author(code) => {
                self.asked.usual = self.meant(code).unwrap_or_else(|error| {
                    refused.push(error);
                    Vec::new()
                });
                self.asked.authored.clone_from(code);
            }
            Action::Begin(beginning) => self.begin(beginning, &mut refused),
            Action::Set { name, value, hand } => {
                self.asked.followed.clear(); // what was chosen stays
                self.give(name, value.clone(), *hand, &mut refused);
            }
            Action::Lock(names) => self.asked.lock.clone_from(names),
            Action::Show(names) => refused.extend(self.show(names).err()),
            Action::Words(messages) => self.set_words(messages),
            Action::Comma(on) => self.set_decimal_comma(*on),
            Action::Light(symbol) => self.light(symbol),
            Action::Compare(on) => self.compare(*on),
            Action::Seek(step) => {
                self.asked.target = *step;
                let target = self.target();
                self.tell(|model| model.seek(target));
            }
            Action::Tell => {
                let step = self.telling(&self.asked.authored);
                if step > 0 {
                    self.tell(|model| model.seek(step));
                }
                self.adopt_target();
            }
            Action::Trace => self.asked.traces = true,
            Action::Size(size) => self.asked.size = Some(*size),
            Action::Leave => {
                for (name, value) in core::mem::take(&mut self.asked.followed) {
                    self.give(name, Some(value), false, &mut refused);
                }
            }
            Action::Touch(touch) => self.touch(touch, &mut refused),
        }
        refused
    }

    /// The step asked for, among those there are.
    pub(super) fn target(&self) -> u32 {
        // Halves up; what is no number is the first.
        ((self.asked.target + 0.5).floor() as u32).min(self.ask(|model| model.step_count()))
    }

    fn adopt_target(&mut self) {
        let named = self.ask(|model| model.value("step")).and_then(|step| decimal::parse(&step));
        self.asked.target = named.unwrap_or_else(|| self.ask(|model| model.step()).into());
    }

    fn begin(&mut self, Beginning { query, settings, linked, changed }: &Beginning, refused: &mut Refused) {
        self.asked.followed.clear();
        if self.asked.began || query.is_some() {
            let said = self.load(query.as_deref().unwrap_or_default());
            if query.is_some() {
                let lines: Vec<String> = said.into_iter().map(|error| error.message).collect();
                refused.push(FigureError { parameter: "link".into(), message: lines.join("\n") });
            }
        }
        self.asked.began = true;
        if *linked {
            let given = query::pairs(&self.asked.authored);
            let mut kept = self.values().0;
            for (name, value) in &mut kept {
                let given = given.iter().find(|(given, _)| given == name).map(|(_, value)| value.clone());
                *value = given.or_else(|| self.usual(name)).unwrap_or_default();
            }
            self.keep_locked(&kept, refused);
        }
        // Together, so that their order makes no difference.
        let mut all = if query.is_none() { self.asked.usual.clone() } else { Vec::new() };
        for (name, value) in query::pairs(settings) {
            let default = settings.split('&').any(|pair| pair == name);
            let value = if default { self.usual(&name) } else { Some(value) };
            all.extend(value.map(|value| (name, value)));
        }
        if !all.is_empty() {
            refused.extend(self.tell(|model| model.configure(&all)));
        }
        self.asked.changed = *changed;
        self.adopt_target();
    }

    /// Gives a parameter a value; without one, its default.
    fn give(&mut self, name: &str, value: Option<String>, hand: bool, refused: &mut Refused) {
        // A name that nobody knows was taken away again.
        let Some(value) = value.or_else(|| self.usual(name)) else { return };
        match if hand { self.set_by_hand(name, &value) } else { self.set(name, &value) } {
            Ok(()) => self.changes(),
            Err(error) => refused.push(error),
        }
    }

    /// The value of a parameter of which the author says nothing.
    fn usual(&self, name: &str) -> Option<String> {
        // Where a default has changed twice, the one of then is the last.
        let meant = self.asked.usual.iter().rfind(|(meant, _)| meant == name).map(|(_, value)| value.clone());
        meant.or_else(|| self.params().into_iter().find(|spec| spec.name == name).map(|spec| spec.default))
    }

    fn changes(&mut self) {
        self.asked.changed = true;
        self.adopt_target();
    }

    /// What a pointer, a key or a tool does. A move that changes no parameter, because it ended where it began or at a limit, is none.
    fn touch(&mut self, touch: &Touch, refused: &mut Refused) {
        let scale = self.asked.layout.as_ref().map_or(1.0, |layout| layout.scale);
        let width = self.css() / scale;
        let (before, values) = (self.query(), self.values().0);
        if matches!(touch, Touch::Drag(..) | Touch::Nudge(..)) {
            self.asked.followed.clear();
        }
        match touch {
            Touch::Pick([x, y]) => {
                self.pick(x / scale, y / scale, width);
            }
            Touch::Drag(handle, [x, y]) | Touch::Follow(handle, [x, y]) => {
                self.drag(handle, x / scale, y / scale, width);
            }
            Touch::Nudge(handle, [right, up]) => self.nudge(handle, *right, *up),
            // It may do a part of what it was to do before it refuses the rest.
            Touch::Own(own) => refused.extend(self.own_at(own, width, scale).err()),
        }
        self.keep_locked(&values, refused);
        if self.query() != before {
            self.changes();
        }
        if matches!(touch, Touch::Follow(..)) {
            for ((name, before), (_, now)) in values.into_iter().zip(self.values().0) {
                if now != before && !self.asked.followed.iter().any(|(followed, _)| *followed == name) {
                    self.asked.followed.push((name, before));
                }
            }
        }
    }

    /// Puts back what is locked, where a reader's link or hand has moved it.
    fn keep_locked(&mut self, before: &[(&'static str, String)], refused: &mut Refused) {
        let lock = self.asked.lock.clone();
        let locks = |name: &str| lock.split(' ').any(|word| word == "all" || word == name);
        for (name, kept) in before.iter().filter(|(name, _)| locks(name)) {
            let value = |figure: &Self| figure.ask(|model| model.value(name)).unwrap_or_default();
            let moved = value(self);
            if moved == *kept {
                continue;
            }
            // Where the author's own value is refused, that has been said.
            if self.set(name, kept).is_ok() && moved != value(self) {
                refused.push(FigureError { parameter: "locked".into(), message: (*name).into() });
            }
        }
    }
}
