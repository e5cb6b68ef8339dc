//! The setting that a reader has left last, beside the one of now: its curves, and what is different at the same step.

use crate::{
    ghost::Curves,
    model::{Group, Kind, Model, ParamSpec, Readout},
    words::kit::DiffersAt,
};

/// What is compared.
#[derive(Default)]
pub(crate) struct Comparison {
    /// The control that was moved last: a setting on its way is none that was left.
    pub control: String,
    /// The setting that it left.
    pub before: Option<Before>,
    /// Whether nobody wants to know.
    pub off: bool,
    /// Whether its curves are drawn.
    pub drawn: bool,
}

/// A setting, and what came out.
pub(crate) struct Before {
    /// Of the parameters that decide the numbers, the rank and the value.
    setup: Vec<(usize, String)>,
    step: u32,
    /// Whether that was the last one.
    ended: bool,
    readouts: Vec<Readout>,
    /// [`Model::curves`].
    pub curves: Curves,
}

impl Before {
    /// What is shown.
    pub fn of(model: &dyn Model) -> Self {
        let mut curves = model.curves();
        curves.iter_mut().flatten().filter(|x| !x.is_finite()).for_each(|x| *x = 0.0);
        let mut setup = Vec::new();
        for (rank, (spec, (_, value))) in model.params().iter().zip(model.values()).enumerate() {
            if spec.group == Group::Setup && spec.kind != Kind::Text {
                setup.push((rank, value));
            }
        }
        Self { setup, step: model.step(), ended: ended(model), readouts: model.readouts(), curves }
    }

    /// Whether something else is set now.
    pub fn differs(&self, model: &dyn Model) -> bool {
        let now = model.values();
        self.setup.iter().any(|(rank, before)| now[*rank].1 != *before)
    }

    /// Whether nothing else but numbers is set otherwise: what they change, numbers tell. Another choice is another subject, which the
    /// figure's own sentence explains.
    pub fn in_numbers(&self, model: &dyn Model) -> bool {
        let (specs, now) = (model.params(), model.values());
        let mut changed = self.setup.iter().filter(|(rank, before)| now[*rank].1 != *before);
        changed.all(|(rank, _)| matches!(specs[*rank].kind, Kind::Integer | Kind::Number))
    }

    /// What is set otherwise now and, at the same step or at both ends, what has come of it. Of another step nothing is told: what is
    /// different there is the step; nor where a reader is asked to predict it.
    pub fn told(&self, model: &dyn Model) -> String {
        let (specs, now) = (model.params(), model.values());
        let asked = now.iter().any(|(name, value)| *name == "predict" && value == "on");
        if asked || (model.step() != self.step && !(self.ended && ended(model))) {
            return String::new();
        }
        let mut changes = Vec::new();
        for (rank, before) in &self.setup {
            let (spec, now) = (&specs[*rank], &now[*rank].1);
            if before != now {
                changes.push(change(spec.title, &written(spec, before), &written(spec, now), spec.unit));
            }
        }
        let (mut numbers, now) = (Vec::new(), model.readouts());
        for name in model.compared() {
            let [before, now] = [&self.readouts, &now].map(|all| all.iter().find(|readout| readout.name == name));
            if let (Some(before), Some(now)) = (before, now) {
                numbers.push(change(now.title, &before.text, &now.text, now.unit));
            }
        }
        let (changes, numbers) = (changes.join(", "), numbers.join(", "));
        match (numbers.is_empty(), model.step_count()) {
            (true, _) => changes,
            (_, 0) => [changes, numbers].join(". "),
            _ => DiffersAt { step: &model.step(), changes: &changes, numbers: &numbers }.say(),
        }
    }
}

/// Something before and now, in words.
fn change(title: &str, before: &str, now: &str, unit: &str) -> String {
    let unit = if now.ends_with(['✓', '–']) { "" } else { unit };
    [title, " ", before, " → ", now, if unit.is_empty() { "" } else { " " }, unit].concat()
}

/// Whether the last step is shown.
fn ended(model: &dyn Model) -> bool {
    model.step() == model.step_count()
}

/// A value for readers.
fn written(spec: &ParamSpec, value: &str) -> String {
    match (spec.choices.iter().find(|choice| choice.value == value), value) {
        (Some(choice), _) => choice.title.into(),
        (_, "on") => "✓".into(),
        (_, "off") => "–".into(),
        _ => value.into(),
    }
}
