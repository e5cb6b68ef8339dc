//! Where the parts stand: a table with a column for each particle, or on a phone one particle below the other.

use super::steps::{GIVEN, STEPS, Step};
use crate::{
    panels::Panels,
    scene::{LINE, Rect},
    view,
};

/// Names of the panels: the drawing, what both particles begin with, and the chain of steps with what follows from it.
pub const PLOT: &str = "plot";
/// See [`PLOT`].
pub const START: &str = "given";
/// See [`PLOT`].
pub const CHAIN: &str = "steps";

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
/// Height of the drawing where nothing stands beside it: a share of its width, and at most so much \[css px\].
const SHARE: f64 = 0.46;
const HIGHEST: f64 = 330.0;

/// Where a step is named, and where its value is written.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Place {
    /// Caption and formula; in the second column of a table this is the label of the first.
    pub label: Rect,
    /// The value.
    pub value: Rect,
}

/// The chain of steps \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Chain {
    /// Heading of each particle.
    pub heads: [Rect; 2],
    /// The steps of each.
    pub steps: [Vec<Place>; 2],
    /// N_eff and the verdict.
    pub selection: Place,
}

/// The parts of the figure \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// Whether the particles stand side by side.
    pub wide: bool,
    /// The drawing of robot and landmark, and what is drawn in it; if it is shown.
    pub plot: Option<[Rect; 2]>,
    /// What both begin with; nothing, if it is not shown.
    pub given: Vec<Place>,
    /// The steps, if they are shown.
    pub chain: Option<Chain>,
    /// Of the whole figure.
    pub height: f64,
}

impl Layout {
    /// Of all panels, for a figure of this width.
    pub fn new(width: f64) -> Self {
        Self::of(width, &Panels::default())
    }

    /// Of some panels: the others have no places.
    pub fn of(width: f64, panels: &Panels) -> Self {
        let width = if width.is_finite() { width.max(NARROWEST) } else { NARROWEST };
        if width >= WIDE { Self::wide(width, panels) } else { Self::narrow(width, panels) }
    }

    fn wide(width: f64, panels: &Panels) -> Self {
        let label = (0.34 * width).floor();
        let column = 0.5 * (width - label);
        // Beside the drawing, if there is one.
        let x = if panels.has(PLOT) { label + column } else { 0.0 };
        let mut y = 0.0;
        let given = rows(x, &mut y, [GIVEN_LABEL, column - GIVEN_LABEL], given(panels));
        let plot = panels.has(PLOT).then(|| {
            let [w, h] = if given.is_empty() { alone(width) } else { [x - 1.5 * GAP, y + 20.0] };
            let plot = Rect::new(0.0, TOP, w, h);
            [plot, Rect::new(0.0, plot.bottom() + 8.0, width, LINE)]
        });
        y = plot.map_or(y, |[_, legend]| legend.bottom());
        let chain = panels.has(CHAIN).then(|| {
            y = below(y);
            let heads = [0.0, 1.0].map(|k| Rect::new(label + k * column, y, column, HEAD));
            y += HEAD;
            let first = rows(0.0, &mut y, [label, column - GAP], STEPS);
            let beside = |place: &Place| Place { value: Rect { x: place.value.x + column, ..place.value }, ..*place };
            let second = first.iter().map(beside).collect();
            let [label, value] = [[0.0, label], [label, width - label]].map(|[x, w]| Rect::new(x, y, w, SELECTION));
            y = value.bottom();
            Chain { heads, steps: [first, second], selection: Place { label, value } }
        });
        Self { wide: true, plot, given, chain, height: y.ceil() }
    }

    fn narrow(width: f64, panels: &Panels) -> Self {
        let plot = panels.has(PLOT).then(|| {
            let [w, h] = alone(width);
            let plot = Rect::new(0.0, TOP, w, h);
            [plot, Rect::new(0.0, plot.bottom() + 8.0, width, 3.0 * LINE)]
        });
        let columns = [(0.48 * width).floor(), width - (0.48 * width).floor()];
        let mut y = plot.map_or(0.0, |[_, legend]| legend.bottom());
        if panels.has(START) {
            y = below(y);
        }
        let given = rows(0.0, &mut y, columns, given(panels));
        let chain = panels.has(CHAIN).then(|| {
            let mut particle = || {
                let head = Rect::new(0.0, below(y), width, HEAD);
                y = head.bottom();
                (head, rows(0.0, &mut y, columns, STEPS))
            };
            let [(head1, first), (head2, second)] = [particle(), particle()];
            let label = Rect::new(0.0, y + GAP, width, SHORT);
            let selection = Place { label, value: Rect::new(0.0, label.bottom(), width, SELECTION) };
            y = selection.value.bottom();
            Chain { heads: [head1, head2], steps: [first, second], selection }
        });
        Self { wide: false, plot, given, chain, height: y.ceil() }
    }
}

impl view::Layout for Layout {
    fn height(&self) -> f64 {
        self.height
    }
}

/// Size of a drawing with nothing beside it.
fn alone(width: f64) -> [f64; 2] {
    [width, (SHARE * width).floor().min(HIGHEST)]
}

/// Where a part begins, below those that end here.
fn below(y: f64) -> f64 {
    if y > 0.0 { y + GAP } else { y }
}

/// What both begin with, if it is shown.
fn given(panels: &Panels) -> &'static [Step] {
    if panels.has(START) { GIVEN } else { &[] }
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

    /// All parts that have a place.
    fn parts(Layout { wide, plot, given, chain, .. }: &Layout) -> Vec<Rect> {
        let mut parts: Vec<Rect> = plot.iter().flatten().copied().collect();
        parts.extend(given.iter().flat_map(|place| [place.label, place.value]));
        if let Some(Chain { heads, steps: [first, second], selection }) = chain {
            parts.extend(heads);
            parts.extend(first.iter().chain([selection]).flat_map(|place| [place.label, place.value]));
            let labels = second.iter().map(|place| place.label).filter(|_| !wide);
            parts.extend(second.iter().map(|place| place.value).chain(labels));
        }
        parts
    }

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        for names in ["all", "plot", "given", "steps", "plot given", "plot steps", "given steps"] {
            let panels = Panels::named(names, &[PLOT, START, CHAIN]).unwrap();
            for width in (330..1600).step_by(7).map(f64::from) {
                let layout = Layout::of(width, &panels);
                let parts = parts(&layout);
                assert_apart(&parts, &Rect::new(0.0, 0.0, width, layout.height));
                let last = parts.iter().map(Rect::bottom).fold(0.0, f64::max);
                assert!(layout.height - last < 1.0, "{names} at {width}: nothing is left below");
            }
        }
    }
}
