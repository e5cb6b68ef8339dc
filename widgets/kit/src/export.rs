//! A figure's measured data, for files.

use crate::{
    model::{Column, Model},
    prediction::Outcome,
    query,
};
use serde::{Serialize, Serializer};

/// The figure, the link that makes it again, what the columns are, and every step.
#[derive(Serialize)]
pub struct Export {
    figure: &'static str,
    query: String,
    columns: Entries<&'static str>,
    steps: Vec<Entries<Option<f64>>>,
}

/// An object: names with values, in this order.
pub struct Entries<V>(pub Vec<(&'static str, V)>);

impl<V: Serialize> Serialize for Entries<V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// Of a figure that asks for a prediction, the same in every row.
const PREDICTION: [Column; 3] = [
    Column::new("guess", "what the reader predicted"),
    Column::new("waived", "1 where the reader saw the result without predicting it"),
    Column::new("result", "what was to be predicted, once it was shown"),
];

impl Export {
    /// Everything simulated so far.
    pub fn new(figure: &'static str, model: &dyn Model) -> Self {
        let mut series = model.series();
        if let Some(Outcome { guess, result, waived, .. }) = model.prediction() {
            series.columns.to_mut().extend(PREDICTION);
            let of = [guess, Some(f64::from(u8::from(waived))), result].map(|x| x.unwrap_or(f64::NAN));
            series.rows.iter_mut().for_each(|row| row.extend(of));
        }
        let step = |row: &Vec<f64>| {
            Entries(series.columns.iter().map(|c| c.name).zip(row.iter().map(|&x| number(x))).collect())
        };
        Self {
            figure,
            query: query::write(model),
            columns: Entries(series.columns.iter().map(|c| (c.name, c.help)).collect()),
            steps: series.rows.iter().map(step).collect(),
        }
    }

    /// The names of the columns.
    pub fn header(&self) -> Vec<&'static str> {
        self.columns.0.iter().map(|(name, _)| *name).collect()
    }

    /// The rows without their names.
    pub fn rows(&self) -> Vec<Vec<Option<f64>>> {
        self.steps.iter().map(|step| step.0.iter().map(|(_, value)| *value).collect()).collect()
    }
}

/// Not every step has every number.
fn number(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}
