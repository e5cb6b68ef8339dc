//! Where the parts of the figure stand, and what part of the world the panels show.

use super::recipe::WORLD;
use crate::{
    panels::Panels,
    scene::{LINE, Plane, Rect},
    view,
};
use fastslam_lab::baseline::one_step::Area;

/// Names of the panels: what the motion prior drew, what the measurement-aware proposal drew, and what both are worth.
pub const MOTION: &str = "motion";
/// See [`MOTION`].
pub const AWARE: &str = "aware";
/// See [`MOTION`].
pub const RATIO: &str = "ratio";

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
    /// Which panels are shown.
    pub shown: Panels,
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
    /// Of all panels, for a figure of this width.
    pub fn new(width: f64) -> Self {
        Self::of(width, &Panels::default())
    }

    /// Of some panels: those that are not shown have no height.
    pub fn of(width: f64, shown: &Panels) -> Self {
        let width = if width.is_finite() { width.max(NARROWEST) } else { NARROWEST };
        let clouds = [MOTION, AWARE].map(|name| shown.has(name));
        let beside = width >= WIDE && clouds == [true; 2];
        let gap = 20.0;
        let w = if beside { (0.5 * (width - gap)).floor() } else { width };
        let Area { low, high } = WORLD;
        let h = w * (high[1] - low[1]) / (high[0] - low[0]);
        let panel = |shown: bool, x: f64, y: f64| {
            let [header, h, pad, counters, note] =
                [HEADER, h, PAD, COUNTERS, LINE].map(|h| if shown { h } else { 0.0 });
            let header = Rect::new(x, y, w, header);
            let view = Rect::new(x, header.bottom(), w, h);
            let counter = |k: f64| Rect::new(x + k * 0.5 * w, view.bottom() + pad, 0.5 * w, counters);
            let counters = [counter(0.0), counter(1.0)];
            Panel { header, view, counters, note: Rect::new(x, counters[0].bottom(), w, note) }
        };
        // Below a part, if it is shown.
        let below = |part: &Rect, gap: f64| if part.h > 0.0 { part.bottom() + gap } else { part.y };
        let first = panel(clouds[0], 0.0, 0.0);
        let [x, y] = if beside { [w + gap, 0.0] } else { [0.0, below(&first.note, 2.0 * PAD)] };
        let second = panel(clouds[1], x, y);
        let line = |y: f64, h: f64| Rect::new(0.0, y, width, h);
        let [words, question, apart, axis] = [22.0, LINE, 4.0, 44.0].map(|h| if shown.has(RATIO) { h } else { 0.0 });
        let words = line(below(&second.note, 2.0 * PAD), words);
        let question = line(words.bottom(), question);
        // Room for half a handle at both ends.
        let axis = Rect::new(16.0, question.bottom() + apart, width - 32.0, axis);
        // Most of what it names is in the clouds.
        let lines = [1100.0, WIDE, 400.0].iter().filter(|&&limit| width < limit).count();
        let lines = if clouds == [false; 2] { 0.0 } else { (1 + lines) as f64 };
        let legend = line(below(&axis, PAD), lines * LINE);
        let height = if lines > 0.0 { legend.bottom() } else { axis.bottom() }.ceil();
        Self { shown: shown.clone(), panels: [first, second], ratio: [words, question], axis, legend, height }
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

impl view::Layout for Layout {
    fn height(&self) -> f64 {
        self.height
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
    fn panels_shown_alone_leave_no_place_for_the_others() {
        for (names, shown) in [("motion", 6), ("aware", 6), ("ratio", 3), ("motion aware", 11), ("aware ratio", 9)] {
            let panels = Panels::named(names, &[MOTION, AWARE, RATIO]).unwrap();
            for width in (300..2000).step_by(7).map(f64::from) {
                let layout = Layout::of(width, &panels);
                let parts: Vec<Rect> = layout.parts().into_iter().filter(|part| part.h > 0.0).collect();
                assert_eq!(parts.len(), shown, "{names} at {width}");
                assert_apart(&parts, &Rect::new(0.0, 0.0, width, layout.height));
                let [first, last] = [parts[0].y, parts.iter().map(Rect::bottom).fold(0.0, f64::max)];
                assert!(first == 0.0 && layout.height - last < 1.0, "{names} at {width}: nothing is left around");
            }
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
