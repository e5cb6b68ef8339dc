//! Where the parts stand: the drawing, below it a table with a column for each particle, and at the end the decision. What a row says of
//! itself stands beside its values: caption and formula in one line, below each other, or on a phone the symbol with its unit.

use super::steps::{GIVEN, Step, steps};
use crate::{
    panels::Panels,
    scene::{LINE, Parts, Rect, parts},
    view,
};

/// Names of the panels: the drawing, what both particles begin with, the five numbers that decide, and the whole chain of steps.
pub const PLOT: &str = "plot";
/// See [`PLOT`].
pub const START: &str = "given";
/// See [`PLOT`].
pub const FIVE: &str = "five";
/// See [`PLOT`].
pub const CHAIN: &str = "steps";

/// The corner of the figure is paper: the page takes its colour from there.
const TOP: f64 = 2.0;
const GAP: f64 = 8.0;
const HEAD: f64 = 24.0;
const TALL: f64 = 42.0;
/// Room for the longest formula of a row.
const FORMULA: f64 = 168.0;
/// Room for the formula of N_eff.
const N_EFF: f64 = 96.0;
/// Space at the right of a column.
const APART: f64 = 12.0;

/// How the rows are labelled.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Labels {
    /// Caption and formula in one line.
    Line,
    /// The caption above the formula.
    Stacked,
    /// The symbol, and its unit.
    Short,
}

impl Parts for Labels {}

impl Labels {
    fn of(width: f64) -> Self {
        match width {
            610.0.. => Self::Line,
            520.0.. => Self::Stacked,
            _ => Self::Short,
        }
    }

    /// Width of the captions, where formulas stand beside them; those of all steps are longer.
    pub fn captions(all: bool) -> f64 {
        if all { 164.0 } else { 138.0 }
    }

    /// Width of the column of labels.
    fn column(self, width: f64, all: bool) -> f64 {
        match self {
            Self::Line => Self::captions(all) + FORMULA + (0.12 * (width - 800.0)).max(0.0).floor(),
            Self::Stacked => 200.0,
            Self::Short => 70.0,
        }
    }

    /// Height of a row of one line.
    fn row(self) -> f64 {
        if self == Self::Stacked { 2.0 * LINE } else { 26.0 }
    }

    /// Height of the decision.
    fn selection(self) -> f64 {
        if self == Self::Line { 38.0 } else { 52.0 }
    }

    /// Height of the drawing in a figure of this width: what the five rows leave of a screen.
    fn drawing(self, width: f64) -> f64 {
        match self {
            Self::Short => (0.46 * width).clamp(150.0, 190.0),
            Self::Stacked => 154.0,
            // Only a whole screen is as wide as that.
            Self::Line => (206.0 + 1.5 * (width - 1000.0)).clamp(206.0, 370.0),
        }
        .floor()
    }
}

parts! {
    /// Where a row is named, and where its values are written.
    pub struct Place {
        /// Caption and formula.
        pub label: Rect,
        /// The value of each particle.
        pub values: [Rect; 2],
    }
}

parts! {
    /// Steps of both particles, and what follows \[css px\].
    pub struct Chain {
        /// Heading of each particle, and in front of them room for what the drawing has besides.
        pub head: Place,
        /// Whether all steps are shown, not only the five that decide.
        pub all: bool,
        /// Of each step.
        pub places: Vec<Place>,
        /// N_eff and the verdict: their name, the words, and the bar.
        pub selection: [Rect; 3],
    }
}

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// How the rows are labelled.
        pub labels: Labels,
        /// The drawing, if it is shown.
        pub plot: Option<Rect>,
        /// What is drawn in it, where the heading of a chain has no room to say it.
        pub names: Option<Rect>,
        /// What both begin with; nothing, if it is not shown.
        pub given: Vec<Rect>,
        /// The steps, if they are shown.
        pub chain: Option<Chain>,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const NARROWEST: f64 = 330.0;
    const PANELS: &'static [&'static str] = &[PLOT, START, FIVE, CHAIN];

    /// Of some panels: the others have no places. Of all that there are, the drawing and the five rows are shown.
    fn laid_out(width: f64, panels: &Panels) -> Self {
        let labels = Labels::of(width);
        let all = !panels.are_all() && panels.has(CHAIN);
        let steps = all || panels.has(FIVE);
        let mut y = 0.0;
        let mut take = |shown: bool, h: f64, gap: f64| {
            shown.then(|| {
                let part = Rect::new(0.0, y, width, h);
                y = part.bottom() + gap;
                part
            })
        };
        let plot = take(panels.has(PLOT), TOP + labels.drawing(width), 4.0)
            .map(|Rect { y, h, .. }| Rect::new(0.0, y + TOP, width, h - TOP));
        let lines = if !steps && labels == Labels::Short { 3.0 } else { 1.0 };
        let names = take(plot.is_some() && (!steps || labels != Labels::Line), lines * LINE, 0.0);
        let given = take(!panels.are_all() && panels.has(START), TALL + GAP, 0.0);
        let chain = steps.then(|| Chain::below(&mut y, width, labels, all));
        let given = given.map_or(Vec::new(), |row| {
            // A vector, and two matrices.
            let ends = [0.0, 0.22, 0.58, 1.0].map(|share| (share * width).floor());
            GIVEN.iter().zip(ends.windows(2)).map(|(_, x)| Rect::new(x[0], row.y, x[1] - x[0], TALL)).collect()
        });
        Self { labels, plot, names, given, chain, height: y.ceil() }
    }

    fn height(&self) -> f64 {
        self.height
    }
}

impl Chain {
    /// The steps that have a place.
    pub fn steps(&self) -> &'static [Step] {
        steps(self.all)
    }

    /// The bar that N_eff fills, from 0 to both particles.
    pub fn bar(&self) -> Rect {
        let [.., area] = self.selection;
        Rect::new(area.x + 14.0, area.bottom() - 31.0, area.w - 32.0, 10.0)
    }

    /// All its rows, over the whole width.
    pub fn rows(&self) -> Rect {
        let (first, last) = (self.places[0].label, self.places[self.places.len() - 1].values[1]);
        Rect::new(first.x, first.y, last.right() + APART - first.x, last.bottom() - first.y)
    }

    /// From this height on, which becomes that of its end.
    fn below(y: &mut f64, width: f64, labels: Labels, all: bool) -> Self {
        let label = labels.column(width, all);
        let column = 0.5 * (width - label);
        let mut row = |h: f64| {
            let top = *y;
            *y += h;
            let value = |k: f64| Rect::new(label + k * column, top, column - APART, h);
            Place { label: Rect::new(0.0, top, label - 0.5 * APART, h), values: [value(0.0), value(1.0)] }
        };
        let mut head = row(HEAD);
        head.values.iter_mut().for_each(|value| value.w = column);
        let places = steps(all).iter().map(|step| row(if step.tall { TALL } else { labels.row() })).collect();
        let h = labels.selection();
        let Place { label: name, values: [one, two] } = row(h);
        let selection = match labels {
            // From the first column on, or where that is too narrow, from the formula on.
            Labels::Line => {
                let x = if one.w < 200.0 { Labels::captions(all) + N_EFF } else { one.x };
                [Rect { w: x - APART, ..name }, Rect { x, w: one.right() - x, ..one }, two]
            }
            // Words above the bar; on a phone the name stands in front of the words.
            Labels::Stacked | Labels::Short => {
                let words = 22.0;
                let name = if labels == Labels::Short { Rect { h: words, ..name } } else { name };
                let x = if labels == Labels::Short { 0.0 } else { one.x };
                let bar = Rect::new(x, one.y + words, width - x, h - words);
                [name, Rect::new(one.x, one.y, width - one.x, words), bar]
            }
        };
        Self { head, all, places, selection }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::assert_apart;
    use crate::view::Layout as _;

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        for names in ["all", "plot", "given", "five", "steps", "plot given", "plot five", "plot steps", "given steps"] {
            let panels = Panels::named(names, &[PLOT, START, FIVE, CHAIN]).unwrap();
            for width in (330..1600).step_by(7).map(f64::from) {
                let layout = Layout::of(width, &panels);
                let parts = layout.parts();
                assert_apart(&parts, &Rect::new(0.0, 0.0, width, layout.height));
                assert!(layout.height - layout.lowest() <= GAP, "{names} at {width}: nothing is left below");
            }
        }
    }

    #[test]
    fn with_five_rows_it_is_as_high_as_a_screen_has_room_for() {
        let height = |width: f64| Layout::of(width, &Panels::default()).height;
        for (widths, most) in [(352..353, 450.0), (520..1001, 452.0)] {
            for width in widths {
                let height = height(f64::from(width));
                assert!(height <= most, "{height} at {width}");
            }
        }
        assert!((610..761).all(|width| height(f64::from(width)) >= 430.0));
        assert!((1000..1400).all(|width| height(f64::from(width)) <= 0.56 * f64::from(width)));
    }
}
