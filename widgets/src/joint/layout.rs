//! Where the parts of the figure stand.

use crate::{
    panels::Panels,
    scene::{LINE, Rect, Stack, parts},
    view,
};

/// Names of the panels: the estimates of both filters, and N_eff over the landmarks.
pub const MAPS: &str = "maps";
/// See [`MAPS`].
pub const ESS: &str = "n-eff";

/// From this width of a panel on \[css px\], its numbers stand beside its view and not below it.
const BESIDE: f64 = 260.0;

const HEADER: f64 = 24.0;
const PAD: f64 = 8.0;
const COUNTER: f64 = 44.0;
/// Height of a view with its numbers beside it, and below it.
const VIEWS: [f64; 2] = [140.0, 96.0];
/// Rows of particles, and from one to the next.
pub const ROWS: usize = 8;
/// See [`ROWS`].
pub const PITCH: f64 = 3.5;
/// Left of the chart and below it, for numbers.
const SCALE: f64 = 44.0;
const CHART: f64 = 112.0;

parts! {
    /// One filter's part.
    pub struct Panel {
        /// Which filter.
        pub header: Rect,
        /// Where it believes the landmark to be, in each repeat.
        pub view: Rect,
        /// N_eff, and the spread.
        pub counters: [Rect; 2],
        /// How many particles are left, in words.
        pub left: Rect,
        /// And one by one.
        pub particles: Rect,
    }
}

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// Which panels are shown.
        pub shown: Panels,
        /// The sampled map's, and the computed one's.
        pub panels: [Panel; 2],
        /// What computing has removed of the variance, in words and as a bar.
        pub removed: [Rect; 2],
        /// What the chart is, with a legend.
        pub legend: Rect,
        /// N_eff over the landmarks.
        pub chart: Rect,
        /// The scale left of it.
        pub scale: Rect,
        /// The one below.
        pub axis: Rect,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[MAPS, ESS];

    fn laid_out(width: f64, shown: &Panels) -> Self {
        let [maps, ess] = [MAPS, ESS].map(|name| shown.has(name));
        let gap = if width < 560.0 { 12.0 } else { 20.0 };
        let w = (0.5 * (width - gap)).floor();
        let panels = [0.0, w + gap].map(|x| Self::panel(maps, x, w));
        let mut stack = Stack::new(0.0, width);
        stack.y = if maps { panels[0].particles.bottom() + PAD } else { 0.0 };
        let removed = [stack.take(maps, 20.0, 0.0), stack.take(maps, 8.0, if ess { PAD } else { 0.0 })];
        // On a phone the legend takes two more lines, and the chart is lower by as much.
        let more = if width < 560.0 { 2.0 * LINE } else { 0.0 };
        let legend = stack.take(ess, LINE + more, 8.0);
        let row = stack.take(ess, CHART - 0.5 * more, 0.0);
        let axis = stack.take(ess, 30.0, 0.0);
        let [scale, chart] = [Rect { w: SCALE, ..row }, Rect::new(row.x + SCALE, row.y, row.w - SCALE - 12.0, row.h)];
        Self { shown: shown.clone(), panels, removed, legend, chart, scale, axis, height: stack.y.ceil() }
    }

    fn height(&self) -> f64 {
        self.height
    }
}

impl Layout {
    fn panel(shown: bool, x: f64, w: f64) -> Panel {
        let [header, line, gap] = [HEADER, LINE, 4.0].map(|h| if shown { h } else { 0.0 });
        let of = |h: f64| if shown { h } else { 0.0 };
        let header = Rect::new(x, 0.0, w, header);
        let (view, counters) = if w < BESIDE {
            let view = Rect::new(x, header.bottom(), w, of(VIEWS[1]));
            let y = view.bottom() + gap;
            let half = 0.5 * w;
            (view, [0.0, half].map(|left| Rect::new(x + left, y, half, of(COUNTER))))
        } else {
            let view = Rect::new(x, header.bottom(), (0.58 * w).floor(), of(VIEWS[0]));
            let left = view.right() + 12.0;
            let counter = |y: f64| Rect::new(left, y, x + w - left, of(COUNTER));
            (view, [counter(view.y + of(14.0)), counter(view.y + of(74.0))])
        };
        let y = view.bottom().max(counters[1].bottom()) + gap;
        let left = Rect::new(x, y, w, line);
        let particles = Rect::new(x, left.bottom() + gap, w, of(ROWS as f64 * PITCH));
        Panel { header, view, counters, left, particles }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{assert_laid_out, assert_on_screens};

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        assert_laid_out::<Layout>(&[("all", 18), (MAPS, 14), (ESS, 4)], 1.0);
    }

    #[test]
    fn the_picture_and_its_controls_are_on_one_screen() {
        assert_on_screens::<Layout>(&[(692.0, 452.0), (600.0, 452.0), (352.0, 452.0), (322.0, 452.0), (1112.0, 610.0)]);
    }
}
