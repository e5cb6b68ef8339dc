//! Where the parts stand: a table with a column for each particle, or on a phone one particle below the other.

use super::steps::{GIVEN, STEPS, Step};
use crate::scene::{LINE, Rect};

/// From this width on \[css px\], the particles stand side by side.
pub const WIDE: f64 = 720.0;

/// Narrowest width that is laid out \[css px\]; below, the figure is made smaller as a whole.
pub const NARROWEST: f64 = 330.0;

/// The corner of the figure is paper: the page takes its colour from there.
const TOP: f64 = 2.0;
const GAP: f64 = 16.0;
const HEAD: f64 = 34.0;
const TALL: f64 = 50.0;
const SHORT: f64 = 42.0;
const SELECTION: f64 = 80.0;
const GIVEN_LABEL: f64 = 112.0;

/// Where a step is named, and where its value is written.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Place {
    /// Caption and formula; in the second column of a table this is the label of the first.
    pub label: Rect,
    /// The value.
    pub value: Rect,
}

/// The parts of the figure \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// Whether the particles stand side by side.
    pub wide: bool,
    /// The drawing of robot and landmark.
    pub plot: Rect,
    /// What is drawn in it.
    pub legend: Rect,
    /// What both begin with.
    pub given: Vec<Place>,
    /// Heading of each particle.
    pub heads: [Rect; 2],
    /// The steps of each.
    pub steps: [Vec<Place>; 2],
    /// N_eff and the verdict.
    pub selection: Place,
    /// Of the whole figure.
    pub height: f64,
}

impl Layout {
    /// For a figure of this width.
    pub fn new(width: f64) -> Self {
        let width = if width.is_finite() { width.max(NARROWEST) } else { NARROWEST };
        if width >= WIDE { Self::wide(width) } else { Self::narrow(width) }
    }

    fn wide(width: f64) -> Self {
        let label = (0.34 * width).floor();
        let column = 0.5 * (width - label);
        let given_x = label + column;
        let mut y = 0.0;
        let given = rows(given_x, &mut y, [GIVEN_LABEL, column - GIVEN_LABEL], GIVEN);
        let plot = Rect::new(0.0, TOP, given_x - 1.5 * GAP, y + 20.0);
        let legend = Rect::new(0.0, plot.bottom() + 8.0, width, LINE);
        let mut y = legend.bottom() + GAP;
        let heads = [0.0, 1.0].map(|k| Rect::new(label + k * column, y, column, HEAD));
        y += HEAD;
        let first = rows(0.0, &mut y, [label, column - GAP], STEPS);
        let beside = |place: &Place| Place { value: Rect { x: place.value.x + column, ..place.value }, ..*place };
        let second = first.iter().map(beside).collect();
        let selection =
            Place { label: Rect::new(0.0, y, label, SELECTION), value: Rect::new(label, y, width - label, SELECTION) };
        let height = selection.value.bottom().ceil();
        Self { wide: true, plot, legend, given, heads, steps: [first, second], selection, height }
    }

    fn narrow(width: f64) -> Self {
        let plot = Rect::new(0.0, TOP, width, (0.46 * width).floor());
        let legend = Rect::new(0.0, plot.bottom() + 8.0, width, 3.0 * LINE);
        let columns = [(0.48 * width).floor(), width - (0.48 * width).floor()];
        let mut y = legend.bottom() + GAP;
        let given = rows(0.0, &mut y, columns, GIVEN);
        let mut particle = || {
            let head = Rect::new(0.0, y + GAP, width, HEAD);
            y = head.bottom();
            (head, rows(0.0, &mut y, columns, STEPS))
        };
        let [(head1, first), (head2, second)] = [particle(), particle()];
        let label = Rect::new(0.0, y + GAP, width, SHORT);
        let selection = Place { label, value: Rect::new(0.0, label.bottom(), width, SELECTION) };
        let height = selection.value.bottom().ceil();
        Self { wide: false, plot, legend, given, heads: [head1, head2], steps: [first, second], selection, height }
    }
}

/// A place for each step, from this corner on down, labels and values so wide.
fn rows(x: f64, y: &mut f64, [label, value]: [f64; 2], steps: &[Step]) -> Vec<Place> {
    let row = |step: &Step| {
        let (h, top) = (if step.tall { TALL } else { SHORT }, *y);
        *y += h;
        Place { label: Rect::new(x, top, label, h), value: Rect::new(x + label, top, value, h) }
    };
    steps.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::assert_apart;

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        for width in (330..1600).step_by(7).map(f64::from) {
            let layout = Layout::new(width);
            let mut parts = vec![layout.plot, layout.legend, layout.selection.label, layout.selection.value];
            parts.extend(layout.heads);
            parts.extend(layout.given.iter().chain(&layout.steps[0]).flat_map(|place| [place.label, place.value]));
            let labels = layout.steps[1].iter().map(|place| place.label).filter(|_| !layout.wide);
            parts.extend(layout.steps[1].iter().map(|place| place.value).chain(labels));
            assert_apart(&parts, &Rect::new(0.0, 0.0, width, layout.height));
        }
    }
}
