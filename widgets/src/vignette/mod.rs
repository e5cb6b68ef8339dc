//! Small figures beside a sentence of the chapter: one handle, one picture, and one line that holds the number. All are one figure to the
//! kit, with two parameters: which of them it is, and where its handle stands.

mod beams;
mod cells;
mod comb;
mod halves;
mod look;
mod lottery;
mod names;
mod overlap;
mod slip;
mod surface;
mod tiles;
mod tree;

use crate::{
    field,
    model::Readout,
    recipe::{self, Menu, Param},
    scene::{Anchor, Cells, Rect, Role, Scene, Shading, plain, shade},
    sketch::Sketch,
    words::vignette,
};
use fastslam::map::grid::Grid;

/// Height of every picture \[css px\].
const HEIGHT: f64 = 150.0;

/// Free around every picture \[css px\].
const MARGIN: f64 = 10.0;

/// What one of them is.
pub struct Kind {
    /// Its name in the chapter's source.
    pub name: &'static str,
    /// What its handle sets, for readers.
    handle: fn() -> &'static str,
    /// The last place of the handle; the first is 0.
    pub last: u32,
    /// What the handle sets at a place, as text and unit.
    value: fn(u32) -> (String, &'static str),
    /// What the number in the line is, for readers.
    number: fn() -> &'static str,
    /// The number in the line, its text and its unit.
    result: fn(u32) -> (f64, String, &'static str),
    /// The line.
    told: fn(u32) -> String,
    draw: fn(u32, &Rect, &mut Scene),
}

/// All there are.
pub const KINDS: &[Kind] = &[
    comb::KIND,
    halves::KIND,
    overlap::KIND,
    tree::KIND,
    beams::KIND,
    slip::KIND,
    look::KIND,
    names::KIND,
    tiles::KIND,
    surface::KIND,
    cells::KIND,
    lottery::KIND,
];

/// Words in a picture.
#[inline(never)]
fn label(scene: &mut Scene, area: Rect, anchor: Anchor, role: Role, words: &str) {
    scene.text(area, plain(12.0, role).at(anchor), words);
}

/// A part of a map, so many columns and rows of cells from a cell on.
fn cells(scene: &mut Scene, area: Rect, map: &Grid, [i, j]: [i32; 2], [columns, rows]: [i32; 2]) {
    scene.raster(area, Cells::of(i..i + columns, j..j + rows, |i, j| shade(map.log_odds(i, j))), Shading::Map);
}

/// One of them, and where its handle stands.
#[derive(Clone, PartialEq, Default)]
pub struct Vignette {
    which: usize,
    at: u32,
}

impl Vignette {
    fn kind(&self) -> &'static Kind {
        &KINDS[self.which]
    }
}

impl recipe::Recipe for Vignette {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Vignette>;
        let kinds = KINDS.iter().enumerate().map(|(rank, kind)| (kind.name, (kind.handle)(), rank));
        vec![
            P::choice("which", vignette::which(), Menu::new(kinds), field!(which), vignette::which_help()),
            P::integer("at", vignette::at(), "", (0, 0), field!(at), vignette::at_help())
                .at_most(|recipe| recipe.kind().last.into())
                .titled(|recipe| Some((recipe.kind().handle)()))
                .in_sight(),
        ]
    }
}

impl Sketch for Vignette {
    const TITLE: &'static str = "A small figure of the chapter";

    fn height(_: &str, _: f64) -> f64 {
        HEIGHT
    }

    /// What the handle sets, and what comes of it.
    fn readouts(&self) -> Vec<Readout> {
        let Kind { handle, value, number, result, .. } = self.kind();
        let ((set, unit), (came, text, of)) = (value(self.at), result(self.at));
        let help = [vignette::at_help(), vignette::number_help()];
        vec![
            Readout::new("value", handle(), self.at.into(), set, unit, help[0]),
            Readout::new("number", number(), came, text, of, help[1]),
        ]
    }

    fn describe(&self) -> String {
        (self.kind().told)(self.at)
    }

    fn draw(&self, _: &str, area: Rect, scene: &mut Scene) {
        (self.kind().draw)(self.at, &area.inset(MARGIN), scene);
    }
}
