//! Where the parts of the figure stand.

use super::recipe::WORLD;
use crate::{
    panels::Panels,
    scene::{LINE, Plane, Rect, parts},
    view,
};
use fastslam_lab::baseline::one_step::Area;

/// Names of the panels: what the motion prior drew, what the measurement-aware proposal drew, and what both are worth.
pub const MOTION: &str = "motion";
/// See [`MOTION`].
pub const AWARE: &str = "aware";
/// See [`MOTION`].
pub const RATIO: &str = "ratio";

/// From this width on \[css px\], the ratio stands beside the world and not above it.
pub const WIDE: f64 = 560.0;

const HEADER: f64 = 24.0;
const PAD: f64 = 6.0;
const COUNTERS: f64 = 44.0;

/// Height of a panel over its width.
const ASPECT: f64 = 0.6;

/// A panel beside the other is at least so high, and one alone at most \[css px\].
const HEIGHTS: [f64; 2] = [132.0, 300.0];

parts! {
    /// One proposal's part.
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
}

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// Which panels are shown.
        pub shown: Panels,
        /// The motion prior's, and the measurement-aware proposal's.
        pub panels: [Panel; 2],
        /// What can be done in the world, and the world: where the panels are in it, and the landmark.
        pub world: [Rect; 2],
        /// The ratio in words, and below it what is asked or answered about it.
        pub ratio: [Rect; 2],
        /// Its scale.
        pub axis: Rect,
        /// What is drawn.
        pub legend: Rect,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[MOTION, AWARE, RATIO];

    fn laid_out(width: f64, shown: &Panels) -> Self {
        let clouds = [MOTION, AWARE].map(|name| shown.has(name));
        let (beside, any, strip) = (clouds == [true; 2], clouds != [false; 2], shown.has(RATIO));
        let gap = if width < WIDE { 12.0 } else { 20.0 };
        let w = if beside { (0.5 * (width - gap)).floor() } else { width };
        let h = if beside { (ASPECT * w).max(HEIGHTS[0]) } else { (ASPECT * w).min(HEIGHTS[1]) };
        let panel = |shown: bool, x: f64| {
            let [header, h, pad, counters, note] =
                [HEADER, h, PAD, COUNTERS, LINE].map(|h| if shown { h } else { 0.0 });
            let header = Rect::new(x, 0.0, w, header);
            let view = Rect::new(x, header.bottom(), w, h);
            // The name of the second is the longer one.
            let first = if w < 160.0 { 0.46 } else { 0.5 } * w;
            let y = view.bottom() + pad;
            let counters = [Rect::new(x, y, first, counters), Rect::new(x + first, y, w - first, counters)];
            Panel { header, view, counters, note: Rect::new(x, counters[0].bottom(), w, note) }
        };
        let panels = [panel(clouds[0], 0.0), panel(clouds[1], if beside { w + gap } else { 0.0 })];
        let mut y = if any { panels[0].note.bottom().max(panels[1].note.bottom()) + PAD } else { 0.0 };

        // The world at the left; the ratio beside it or, where that is too narrow, above it; the legend in what is left.
        let left = if !any {
            0.0
        } else if width < WIDE {
            (0.45 * width).floor()
        } else {
            (0.29 * width).clamp(200.0, 250.0)
        };
        let beside = |x: f64, y: f64, h: f64| Rect::new(x, y, width - x, h);
        let right = if any { left + gap } else { 0.0 };
        let x = if width < WIDE { 0.0 } else { right };
        let [words, question, apart, axis] = [20.0, LINE, 2.0, 44.0].map(|h| if strip { h } else { 0.0 });
        let ratio = [beside(x, y, words), beside(x, y + words, question)];
        // Room for half a handle at both ends.
        let axis = Rect::new(x + 16.0, ratio[1].bottom() + apart, width - x - 32.0, axis);
        let below = if strip { axis.bottom() + if any { PAD } else { 0.0 } } else { y };
        if width < WIDE {
            y = below;
        }
        let [caption, world] = [16.0, left * (WORLD.high[1] - WORLD.low[1]) / (WORLD.high[0] - WORLD.low[0])]
            .map(|h| if any { h } else { 0.0 });
        let caption = Rect::new(0.0, y, left, caption);
        let world = [caption, Rect::new(0.0, caption.bottom(), left, world)];
        let lines = LINES.iter().find(|(from, _)| width >= *from).map_or(0.0, |(_, lines)| *lines);
        let legend = beside(right, below, if any { lines * LINE } else { 0.0 });
        let height = if any { legend.bottom().max(world[1].bottom()) } else { axis.bottom() }.ceil();
        Self { shown: shown.clone(), panels, world, ratio, axis, legend, height }
    }

    fn height(&self) -> f64 {
        self.height
    }
}

impl Layout {
    /// The world, where the landmark is moved.
    pub fn world_plane(&self) -> Plane {
        let (Area { low, high }, area) = (WORLD, self.world[1]);
        Plane::from_upper_left(area, [low[0], high[1]], area.w / (high[0] - low[0]))
    }
}

/// From which width on \[css px\] the legend has how many lines.
const LINES: [(f64, f64); 4] = [(1000.0, 2.0), (WIDE, 3.0), (400.0, 6.0), (0.0, 7.0)];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{assert_laid_out, assert_on_screens};
    use crate::view::Layout as _;

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        assert_laid_out::<Layout>(
            &[("all", 16), (MOTION, 8), (AWARE, 8), (RATIO, 3), ("motion aware", 13), ("aware ratio", 11)],
            1.0,
        );
    }

    #[test]
    fn the_picture_and_its_controls_are_on_one_screen() {
        assert_on_screens::<Layout>(&[
            (692.0, 452.0),
            (600.0, 452.0),
            (352.0, 450.0),
            (322.0, 450.0),
            (760.0, 490.0),
            (1112.0, 610.0),
        ]);
    }

    #[test]
    fn both_panels_have_one_size() {
        for width in [300.0, 559.0, 560.0, 1200.0] {
            let [first, second] = Layout::new(width).panels;
            assert_eq!([first.view.w, first.view.h], [second.view.w, second.view.h]);
        }
    }
}
