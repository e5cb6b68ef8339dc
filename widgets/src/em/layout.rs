//! Where the parts of the figure stand: guess, product and map on one axis, the corridor; below, what never falls, and the particles.

use crate::{
    panels::Panels,
    scene::{Rect, Stack, parts},
    view,
};

/// Names of the panels: one iteration of EM mapping, what its maps are worth, and the particles on the same log.
pub const PASSES: &str = "passes";
/// See [`PASSES`].
pub const LIKELIHOOD: &str = "likelihood";
/// See [`PASSES`].
pub const PARTICLES: &str = "particles";

/// From this width on \[css px\], all of an iteration stands in a row.
pub const WIDE: f64 = 560.0;

const HEADER: f64 = 22.0;
/// Names of metres, and the marks of the guess.
const SCALE: f64 = 22.0;
const GUESS: f64 = 42.0;
const GAP: f64 = 10.0;
const PAD: f64 = 8.0;
/// Names of times below a strip, and of iterations below the chart.
const TIMES: f64 = 15.0;
/// Height of the product.
const PRODUCT: f64 = 196.0;
/// Height of chart and particles beside each other; on a phone, of either.
const BELOW: [f64; 3] = [128.0, 52.0, 74.0];
/// Left of the chart, for its numbers, and right of it, for where other guesses end.
const NUMBERS: f64 = 40.0;
pub const ENDS: f64 = 24.0;

parts! {
    /// A part with its name above.
    pub struct Part {
        /// What it is.
        pub header: Rect,
        /// What is drawn.
        pub area: Rect,
    }
}

impl Part {
    fn new(header: &Rect, row: &Rect, x: f64, w: f64) -> Self {
        let [header, area] = [header, row].map(|of| Rect { x, w, ..*of });
        Self { header, area }
    }
}

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// Which panels are shown.
        pub shown: Panels,
        /// Whether there is room for long names.
        pub wide: bool,
        /// Where the robot was, over time: the forward pass, and what the backward one makes of it.
        pub product: Part,
        /// Names of places, left of the marks.
        pub scale: Rect,
        /// The marks of the first guess, left of what is made of them.
        pub guess: Part,
        /// The map, right of the product.
        pub map: Part,
        /// Names of times, below the product.
        pub times: Rect,
        /// What never falls, over the iterations.
        pub chart: Part,
        /// Its numbers.
        pub numbers: Rect,
        /// Names of iterations below it.
        pub axis: Rect,
        /// Where the particles were, by their paths.
        pub cloud: Part,
        /// Names of places left of them.
        pub cloud_scale: Rect,
        /// Where they were right after the robot was carried.
        pub peaks: Part,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[PASSES, LIKELIHOOD, PARTICLES];

    fn laid_out(width: f64, shown: &Panels) -> Self {
        let wide = width >= WIDE;
        let [passes, likelihood, particles] = [PASSES, LIKELIHOOD, PARTICLES].map(|name| shown.has(name));
        let below = likelihood || particles;
        let mut stack = Stack::new(0.0, width);
        let map = if wide { (0.13 * width).clamp(84.0, 130.0) } else { 76.0 }.floor();
        let left = SCALE + GUESS;
        let header = stack.take(passes, HEADER, 0.0);
        let row = stack.take(passes, PRODUCT, 0.0);
        let product = Part::new(&header, &row, left, width - left - map - GAP);
        let times =
            Rect { x: product.area.x, w: product.area.w, ..stack.take(passes, TIMES, if below { PAD } else { 0.0 }) };
        let map = Part::new(&header, &row, width - map, map);
        let guess = Part::new(&header, &row, 0.0, left);
        let guess = Part { area: Rect { x: SCALE, w: GUESS, ..guess.area }, ..guess };
        let scale = Rect { w: SCALE, ..row };

        let half = if wide && likelihood && particles { (0.5 * (width - 2.0 * GAP)).floor() } else { width };
        let top = stack.y;
        let chart_header = stack.take(likelihood, HEADER, 0.0);
        let chart_row = stack.take(likelihood, BELOW[usize::from(!wide)], 0.0);
        let axis = stack.take(likelihood, TIMES, if wide { 0.0 } else { PAD });
        let bottom = stack.y;
        let chart = Part::new(&chart_header, &chart_row, 0.0, half);
        let numbers = Rect { w: NUMBERS, ..chart_row };
        let chart = Part { area: Rect { x: NUMBERS, w: half - NUMBERS - ENDS, ..chart.area }, ..chart };
        let axis = Rect { x: chart.area.x, w: chart.area.w, ..axis };

        let beside = wide && likelihood && particles;
        if beside {
            stack.y = top;
        }
        let x = if beside { half + 2.0 * GAP } else { 0.0 };
        let cloud_header = stack.take(particles, HEADER, 0.0);
        let cloud_row = stack.take(particles, BELOW[if wide { 0 } else { 2 }], 0.0);
        let cloud_scale = Rect { x, w: SCALE, ..cloud_row };
        // Below the map, the peaks are as wide as that.
        let w = map.area.w.max(0.3 * (width - x)).floor();
        let cloud_x = x + SCALE;
        let cloud = Part::new(&cloud_header, &cloud_row, cloud_x, width - w - GAP - cloud_x);
        let cloud = Part { header: Rect { x, w: cloud.area.right() - x, ..cloud.header }, ..cloud };
        let peaks = Part::new(&cloud_header, &cloud_row, width - w, w);
        let height = bottom.max(stack.y).ceil();
        let shown = shown.clone();
        Self { shown, wide, product, scale, guess, map, times, chart, numbers, axis, cloud, cloud_scale, peaks, height }
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
        assert_laid_out::<Layout>(
            &[
                ("all", 17),
                (PASSES, 8),
                (LIKELIHOOD, 4),
                (PARTICLES, 5),
                ("likelihood particles", 9),
                ("passes particles", 13),
            ],
            PAD,
        );
    }

    #[test]
    fn the_picture_and_its_controls_are_on_one_screen() {
        assert_on_screens::<Layout>(&[(692.0, 452.0), (600.0, 452.0), (352.0, 452.0), (322.0, 452.0), (1112.0, 610.0)]);
    }
}
