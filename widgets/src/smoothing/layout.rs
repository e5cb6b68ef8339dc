//! Where the parts of the figure stand.

use crate::{
    panels::Panels,
    scene::{LINE, Rect, Stack, parts},
    view,
};

/// Names of the panels: both maps, and the curves over the steps.
pub const MAPS: &str = "maps";
/// See [`MAPS`].
pub const CURVES: &str = "curves";

/// From this width on \[css px\] the drive lies on its side.
const WIDE: f64 = 560.0;

const HEADER: f64 = 22.0;
const GAP: f64 = 6.0;
/// Left of a chart and below it, for numbers.
const SCALE: f64 = 30.0;
const AXIS: f64 = 32.0;

parts! {
    /// The parts of the figure \[css px\]; of each pair first the filter's record and the counts, then the draws and the errors.
    pub struct Layout {
        /// Which panels are shown.
        pub shown: Panels,
        /// Whether the drive lies on its side.
        pub wide: bool,
        /// What is to be seen below.
        pub headers: [Rect; 2],
        /// The drive.
        pub maps: [Rect; 2],
        /// What lines and dots are.
        pub legend: Rect,
        /// What the curves are.
        pub names: [Rect; 2],
        /// The curves.
        pub charts: [Rect; 2],
        /// Left of them.
        pub scales: [Rect; 2],
        /// Below them.
        pub axes: [Rect; 2],
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[MAPS, CURVES];

    fn laid_out(width: f64, shown: &Panels) -> Self {
        let [maps, curves] = [MAPS, CURVES].map(|name| shown.has(name));
        let wide = width >= WIDE;
        let gap = if wide { 20.0 } else { 12.0 };
        let w = (0.5 * (width - gap)).floor();
        let mut stack = Stack::new(0.0, width);
        let header = stack.take(maps, HEADER, 0.0);
        let high = if wide { (0.53 * w).clamp(150.0, 300.0) } else { (1.22 * w).min(250.0) }.floor();
        let map = stack.take(maps, high, GAP);
        let lines = if width >= 800.0 {
            1.0
        } else if wide {
            2.0
        } else {
            3.0
        };
        let legend = stack.take(maps || curves, lines * LINE, GAP);
        let name = stack.take(curves, LINE, 4.0);
        let chart = stack.take(curves, if wide { (0.11 * width).clamp(84.0, 124.0) } else { 78.0 }.floor(), 0.0);
        let axis = stack.take(curves, AXIS, 0.0);
        let pair = |row: Rect| [Rect { w, ..row }, Rect { x: w + gap, w, ..row }];
        let charts = pair(chart).map(|part| Rect { x: part.x + SCALE, w: part.w - SCALE - 14.0, ..part });
        let scales = pair(chart).map(|part| Rect { w: SCALE, ..part });
        Self {
            shown: shown.clone(),
            wide,
            headers: pair(header),
            maps: pair(map),
            legend,
            names: pair(name),
            charts,
            scales,
            axes: pair(axis),
            height: stack.y.ceil(),
        }
    }

    fn height(&self) -> f64 {
        self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{assert_laid_out, assert_on_screens};

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        assert_laid_out::<Layout>(&[("all", 13), (MAPS, 5), (CURVES, 9)], GAP);
    }

    #[test]
    fn the_picture_and_its_controls_are_on_one_screen() {
        assert_on_screens::<Layout>(&[(692.0, 452.0), (600.0, 452.0), (352.0, 452.0), (322.0, 452.0), (1112.0, 610.0)]);
    }
}
