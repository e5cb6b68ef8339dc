//! The covariance of the map as a heat map.

use super::{layout::Layout, model::ConditioningModel};
use crate::{
    font::{self, Weight},
    scene::{Cells, Handle, Letters, Rect, Role, Scene, Shading, plain},
    words::conditioning,
};

/// Name of the handle that chooses an entry of the matrix.
pub const ENTRY: &str = "entry";

/// All of it, with the names of the landmarks and the entry that is named.
pub fn matrix(scene: &mut Scene, model: &ConditioningModel, layout: &Layout) {
    let (n, area) = (model.drive().landmarks().len(), layout.matrix);
    scale(scene, &layout.matrix_header);
    let places: Vec<Option<usize>> = (0..n).map(|j| model.place(j)).collect();
    let shade = |row: usize, column: usize| match (places[row / 2], places[column / 2]) {
        (Some(i), Some(j)) => {
            let rho = model.map().correlation(2 * i + row % 2, 2 * j + column % 2);
            // Rounded up: an entry that is not 0 is never drawn as one that is.
            (255.0 * rho.abs()).ceil() as u8
        }
        _ => 0,
    };
    let shades = (0..2 * n).flat_map(|row| (0..2 * n).map(move |column| (row, column))).map(|(r, c)| shade(r, c));
    scene.raster(area, Cells { columns: 2 * n, shades: shades.collect() }, Shading::Correlation);

    let block = area.w / n as f64;
    for along in (1..n).map(|k| k as f64 * block) {
        for area in [Rect::new(area.x, area.y + along, area.w, 1.0), Rect::new(area.x + along, area.y, 1.0, area.h)] {
            scene.fill(area, Role::Frame);
        }
    }
    // A landmark without a row and a column yet: struck through.
    let (mut struck, inset) = (Vec::new(), 0.15 * block);
    for j in (0..n).filter(|&j| places[j].is_none()) {
        let at = (j as f64 + 0.5) * block;
        struck.push(vec![[area.x + inset, area.y + at], [area.right() - inset, area.y + at]]);
        struck.push(vec![[area.x + at, area.y + inset], [area.x + at, area.bottom() - inset]]);
    }
    scene.dashed(struck, 1.0, [1.0, 3.0], Role::Muted);
    scene.frame(area, 1.0, Role::Muted);
    names(scene, model, layout, block);
    cursor(scene, model, &area, 0.5 * block);
}

/// What the shades mean, at the right end of the header, and the header.
fn scale(scene: &mut Scene, header: &Rect) {
    let Rect { x, y, w, h } = *header;
    let bar = Rect::new(x + w - 72.0, y + 0.5 * (h - 11.0), 56.0, 11.0);
    let cells = Cells { columns: 14, shades: (0..14).map(|k| (k * 255 / 13) as u8).collect() };
    scene.raster(bar, cells, Shading::Correlation);
    scene.frame(bar, 1.0, Role::Muted);
    for (end, label) in [(bar.x - 14.0, "0"), (bar.right() + 4.0, "1")] {
        scene.text(Rect::new(end, y, 10.0, h), plain(11.5, Role::Muted).middle(), label);
    }
    scene.heading_fit(&Rect::new(x, y, w - 94.0, h), (conditioning::covariance(), Role::Ink), &["|ρ|"]);
}

/// Names of the landmarks along the matrix: as many as fit, and always those of the entry.
fn names(scene: &mut Scene, model: &ConditioningModel, layout: &Layout, block: f64) {
    let Layout { rows, columns, matrix, .. } = layout;
    let ([row, column], size) = (model.entry().map(|k| k / 2), 10.0);
    let widest = font::measure("m24", size, Weight::SemiBold) + 4.0;
    let down = (row, true, size + 1.0, [matrix.y, rows.y, rows.bottom()]);
    let across = (column, false, widest, [matrix.x, columns.x, columns.right()]);
    for (chosen, is_row, room, [origin, start, end]) in [down, across] {
        let apart = (room / block).ceil() as usize;
        for j in 0..model.drive().landmarks().len() {
            let wanted = origin + (j as f64 + 0.5) * block - 0.5 * room;
            let at = within(wanted, start, end - room);
            if j != chosen && (at != wanted || j % apart != 0 || j.abs_diff(chosen) < apart) {
                continue;
            }
            let area = if is_row {
                Rect::new(rows.x, at, rows.w - 2.0, room)
            } else {
                Rect::new(at, columns.y, room, columns.h)
            };
            let (weight, role) =
                if j == chosen { (Weight::SemiBold, Role::Accent) } else { (Weight::Regular, Role::Muted) };
            scene.text(area, Letters { weight, ..plain(size, role) }.middle(), &format!("m{}", j + 1));
        }
    }
}

/// The entry that is named.
fn cursor(scene: &mut Scene, model: &ConditioningModel, area: &Rect, cell: f64) {
    let [row, column] = model.entry();
    let at = Rect::new(area.x + column as f64 * cell, area.y + row as f64 * cell, cell, cell);
    scene.frame(at.inset(-3.5), 3.5, Role::Paper);
    scene.frame(at.inset(-3.0), 2.0, Role::Accent);
    scene.handles.push(Handle {
        name: ENTRY,
        title: conditioning::entry_handle().into(),
        at: at.centre(),
        axes: &["column", "row"],
        value: model.correlation().unwrap_or(0.0),
        text: model.entry_text(),
        hover: Some(*area),
    });
}

/// As `clamp`, but with room for nothing it is the upper end that gives way, and no panic.
pub fn within(x: f64, least: f64, most: f64) -> f64 {
    x.min(most).max(least)
}
