//! A figure's measured data as files: CSV for spreadsheets, JSON for programs. Numbers are written with the fewest digits that
//! read back as the same bits.

use crate::{model::Model, query};
use core::fmt::Write;

/// A header, and one line a step.
pub fn csv(model: &dyn Model) -> String {
    let series = model.series();
    let names: Vec<&str> = series.columns.iter().map(|c| c.name).collect();
    let mut text = names.join(",") + "\n";
    for row in &series.rows {
        let cells: Vec<String> =
            row.iter().map(|x| if x.is_finite() { x.to_string() } else { String::new() }).collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

/// One object: the figure, the link that makes it again, what the columns are, and the rows as objects.
pub fn json(tag: &str, model: &dyn Model) -> String {
    let series = model.series();
    let mut text = format!("{{\"figure\":{tag:?},\"query\":{:?},\"columns\":{{", query::write(model));
    for (k, column) in series.columns.iter().enumerate() {
        let comma = if k == 0 { "" } else { "," };
        write!(text, "{comma}{:?}:{:?}", column.name, column.help).expect("a String takes everything");
    }
    text.push_str("},\"steps\":[");
    for (k, row) in series.rows.iter().enumerate() {
        text.push_str(if k == 0 { "\n{" } else { ",\n{" });
        for (k, (column, x)) in series.columns.iter().zip(row).enumerate() {
            let comma = if k == 0 { "" } else { "," };
            let x = if x.is_finite() { x.to_string() } else { "null".into() };
            write!(text, "{comma}{:?}:{x}", column.name).expect("a String takes everything");
        }
        text.push('}');
    }
    text.push_str("\n]}\n");
    text
}
