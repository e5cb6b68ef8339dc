//! Where the parts of the figure stand.

use crate::{
    panels::Panels,
    scene::{LINE, Rect, parts},
    view,
};

/// Names of the panels: the share of laps that end well over M, what the rule makes of it, and the depletion over the range noise.
pub const SHARE: &str = "share";
/// See [`SHARE`].
pub const RULE: &str = "rule";
/// See [`SHARE`].
pub const DEPLETION: &str = "depletion";

/// Left of a chart's area: the names of its levels \[css px\].
pub const SCALE: f64 = 40.0;

/// A line of text, and between a chart's head and its area: room for a pointer, or none \[css px\].
const HEADER: f64 = 20.0;
const POINTER: f64 = 14.0;
const APART: f64 = 4.0;

/// Below a chart: names of its places, and what they are \[css px\].
const TICKS: f64 = 16.0;
const AXIS: f64 = 16.0;

/// Between the charts beside and below each other \[css px\].
const GAP: [f64; 2] = [16.0, 8.0];

/// Right of an area: half of a name, or of a handle \[css px\].
const RIGHT: f64 = 14.0;

parts! {
    /// A chart with what stands around it.
    pub struct Part {
        /// What it shows.
        pub header: Rect,
        /// What its marks are.
        pub legend: Rect,
        /// Its curves.
        pub area: Rect,
        /// Names of places on its lower axis.
        pub ticks: Rect,
        /// What these places are.
        pub axis: Rect,
    }
}

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// Shares over M.
        pub share: Part,
        /// The rule's operating curve, on the same levels.
        pub rule: Part,
        /// N_eff / M over the range noise.
        pub depletion: Part,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[SHARE, RULE, DEPLETION];

    fn laid_out(width: f64, shown: &Panels) -> Self {
        let [share, rule, depletion] = [SHARE, RULE, DEPLETION].map(|name| shown.has(name));
        let left = if share && rule { (0.68 * width).floor() } else { width };
        let x = if share && rule { left + GAP[0] } else { 0.0 };
        let [high, low] = [(0.27 * width).clamp(160.0, 300.0), (0.14 * width).clamp(88.0, 150.0)].map(f64::floor);
        let lines = if width < 520.0 { 2.0 } else { 1.0 };
        let mut share = Part::of(share, Rect::new(0.0, 0.0, left, high), lines, SCALE, POINTER);
        // With the names of its levels where there are none beside it.
        let scale = if x > 0.0 { 4.0 } else { SCALE };
        let mut rule = Part::of(rule, Rect::new(x, 0.0, width - x, high), lines, scale, POINTER);
        if share.is_shown() {
            // What its marks are, those of the rule are too.
            (share.legend.w, rule.legend.h) = (width, 0.0);
        }
        let above = share.axis.bottom().max(rule.axis.bottom());
        let y = if depletion && above > 0.0 { above + GAP[1] } else { above };
        let depletion = Part::of(depletion, Rect::new(0.0, y, width, low), 1.0, SCALE, APART);
        let height = above.max(depletion.axis.bottom()).ceil();
        Self { share, rule, depletion, height }
    }

    fn height(&self) -> f64 {
        self.height
    }
}

impl Part {
    /// From a place's upper edge on, with an area as high as it.
    fn of(shown: bool, Rect { x, y, w, h }: Rect, lines: f64, scale: f64, above: f64) -> Self {
        let [header, legend, above, h, ticks, axis] =
            [HEADER, lines * LINE, above, h, TICKS, AXIS].map(|h| if shown { h } else { 0.0 });
        let header = Rect::new(x, y, w, header);
        let legend = Rect::new(x, header.bottom(), w, legend);
        let area = Rect::new(x + scale, legend.bottom() + above, w - scale - RIGHT, h);
        let ticks = Rect::new(x, area.bottom(), w, ticks);
        Self { header, legend, area, ticks, axis: Rect::new(x, ticks.bottom(), w, axis) }
    }

    /// Whether it is to be seen.
    pub fn is_shown(&self) -> bool {
        self.area.h > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{assert_laid_out, assert_on_screens};

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        assert_laid_out::<Layout>(
            &[
                ("all", 14),
                (SHARE, 5),
                (RULE, 5),
                (DEPLETION, 5),
                ("share rule", 9),
                ("rule depletion", 10),
                ("share depletion", 10),
            ],
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
            (1112.0, 620.0),
        ]);
    }
}
