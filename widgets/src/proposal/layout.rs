//! Where the parts of the figure stand, and what part of the world the panels show.

use super::recipe::WORLD;
use crate::scene::{LINE, Plane, Rect};
use fastslam_lab::baseline::one_step::Area;

/// From this width on \[css px\], the panels stand side by side.
pub const WIDE: f64 = 640.0;

/// Narrowest width that is laid out \[css px\]; below, the figure is made smaller as a whole.
pub const NARROWEST: f64 = 300.0;

const HEADER: f64 = 26.0;
const COUNTERS: f64 = 48.0;
const PAD: f64 = 8.0;

/// One proposal's part.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Panel {
    /// Which proposal.
    pub header: Rect,
    /// Its samples.
    pub view: Rect,
    /// What they are worth, in large numbers.
    pub counters: [Rect; 2],
    /// What the numbers do not tell.
    pub note: Rect,
}

/// The parts of the figure \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// The motion prior's, and the measurement-aware proposal's.
    pub panels: [Panel; 2],
    /// The ratio in words, and below it what is asked or answered about it.
    pub ratio: [Rect; 2],
    /// Its scale.
    pub axis: Rect,
    /// What is drawn.
    pub legend: Rect,
    /// Of the whole figure.
    pub height: f64,
}

impl Layout {
    /// For a figure of this width.
    pub fn new(width: f64) -> Self {
        let width = if width.is_finite() { width.max(NARROWEST) } else { NARROWEST };
        let wide = width >= WIDE;
        let gap = 20.0;
        let w = if wide { (0.5 * (width - gap)).floor() } else { width };
        let Area { low, high } = WORLD;
        let h = w * (high[1] - low[1]) / (high[0] - low[0]);
        let panel = |x: f64, y: f64| {
            let header = Rect::new(x, y, w, HEADER);
            let view = Rect::new(x, header.bottom(), w, h);
            let counter = |k: f64| Rect::new(x + k * 0.5 * w, view.bottom() + PAD, 0.5 * w, COUNTERS);
            let counters = [counter(0.0), counter(1.0)];
            Panel { header, view, counters, note: Rect::new(x, counters[0].bottom(), w, LINE) }
        };
        let first = panel(0.0, 0.0);
        let second = if wide { panel(w + gap, 0.0) } else { panel(0.0, first.note.bottom() + 2.0 * PAD) };
        let line = |y: f64, h: f64| Rect::new(0.0, y, width, h);
        let words = line(second.note.bottom() + 2.0 * PAD, 22.0);
        let question = line(words.bottom(), LINE);
        // Room for half a handle at both ends.
        let axis = Rect::new(16.0, question.bottom() + 4.0, width - 32.0, 44.0);
        let lines =
            [1100.0, WIDE, 400.0].iter().fold(1.0, |lines, &limit| if width < limit { lines + 1.0 } else { lines });
        let legend = line(axis.bottom() + PAD, lines * LINE);
        Self { panels: [first, second], ratio: [words, question], axis, legend, height: legend.bottom().ceil() }
    }

    /// All parts.
    pub fn parts(&self) -> Vec<Rect> {
        let panels = self
            .panels
            .iter()
            .flat_map(|Panel { header, view, counters: [a, b], note }| [*header, *view, *a, *b, *note]);
        panels.chain([self.ratio[0], self.ratio[1], self.axis, self.legend]).collect()
    }
}

impl Panel {
    /// The world in it.
    pub fn plane(&self) -> Plane {
        let scale = self.view.w / (WORLD.high[0] - WORLD.low[0]);
        Plane::from_upper_left(self.view, [WORLD.low[0], WORLD.high[1]], scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::assert_apart;

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        for width in (300..2000).step_by(7).map(f64::from) {
            let layout = Layout::new(width);
            assert_apart(&layout.parts(), &Rect::new(0.0, 0.0, width, layout.height));
        }
    }

    #[test]
    fn both_panels_have_one_scale() {
        for width in [300.0, 639.0, 640.0, 1200.0] {
            let [first, second] = Layout::new(width).panels;
            assert_eq!(first.plane().scale, second.plane().scale);
        }
    }
}
