//! Where the parts of the figure stand: gauges beside the map where there is room, below it on a phone.

use crate::{
    panels::Panels,
    scene::{LINE, Rect, parts},
    view,
};

/// Names of the panels: the map with the paths, and N_eff and lineage over the scans.
pub const MAP: &str = "map";
/// See [`MAP`].
pub const GAUGES: &str = "gauges";

/// From this width on \[css px\], the gauges stand beside the map.
pub const WIDE: f64 = 560.0;

/// Height where the gauges stand beside the map \[css px\], and share of the width: with what plays it on the screen of a small laptop, and
/// on the whole of a large one. The element keeps the same free before the program is there (figure.css, `.idle`).
const HEIGHT: f64 = 430.0;
const SHARE: f64 = 0.545;

const HEADER: f64 = 26.0;
const PAD: f64 = 8.0;

parts! {
    /// A gauge over the scans \[css px\].
    pub struct Gauge {
        /// Its name and its value.
        pub label: Rect,
        /// The curve.
        pub chart: Rect,
    }
}

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// How far the log is mapped.
        pub header: Rect,
        /// The map, if it is shown.
        pub map: Option<Rect>,
        /// N_eff and lineage, if they are shown.
        pub gauges: Option<[Gauge; 2]>,
        /// What marks mean.
        pub legend: Rect,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[MAP, GAUGES];

    fn laid_out(width: f64, panels: &Panels) -> Self {
        let wide = width >= WIDE;
        let header = Rect::new(0.0, 0.0, width, HEADER);
        let beside = wide && panels.has(MAP) && panels.has(GAUGES);
        let side = if beside { (0.27 * width).clamp(176.0, 260.0) } else { 0.0 };
        let map = panels.has(MAP).then(|| {
            let w = if beside { width - side - 16.0 } else { width };
            let h = if wide { (SHARE * width).max(HEIGHT) - HEADER } else { (0.72 * width).min(280.0) };
            Rect::new(0.0, HEADER, w, h.round())
        });
        let chart = if wide { (0.14 * width).clamp(80.0, 130.0) } else { 44.0 };
        let gauge = |x: f64, y: f64, w: f64| Gauge {
            label: Rect::new(x, y, w, LINE),
            chart: Rect::new(x, y + LINE + 2.0, w, chart),
        };
        if let (true, Some(map)) = (beside, map) {
            let (x, step) = (map.right() + 16.0, LINE + 2.0 + chart + 2.0 * PAD);
            let gauges = [0.0, 1.0].map(|k| gauge(x, map.y + k * step, side));
            let y = gauges[1].chart.bottom() + 2.0 * PAD;
            let legend = Rect::new(x, y, side, map.bottom() - y);
            return Self { header, map: Some(map), gauges: Some(gauges), legend, height: map.bottom() };
        }
        let mut y = map.map_or(header.bottom(), |map| map.bottom() + PAD);
        let gauges = panels.has(GAUGES).then(|| {
            let w = 0.5 * (width - 2.0 * PAD);
            [0.0, 1.0].map(|k| gauge(k * (w + 2.0 * PAD), y, w))
        });
        y = gauges.as_ref().map_or(y, |[first, _]| first.chart.bottom() + PAD);
        let lines = match width {
            _ if map.is_none() => 1.0,
            560.0.. => 2.0,
            400.0.. => 3.0,
            _ => 4.0,
        };
        let legend = Rect::new(0.0, y, width, lines * LINE);
        Self { header, map, gauges, legend, height: legend.bottom().ceil() }
    }

    fn height(&self) -> f64 {
        self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::assert_laid_out;
    use crate::view::Layout as _;

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        assert_laid_out::<Layout>(&[("all", 7), (MAP, 3), (GAUGES, 6)], 1.0);
    }

    #[test]
    fn picture_and_what_plays_it_are_on_one_screen() {
        for (widths, most) in [(300..=560, 460.0), (561..=780, 430.0), (781..=807, 440.0)] {
            for width in widths.map(f64::from) {
                let height = Layout::new(width).height;
                assert!(height <= most, "{height} at {width}");
            }
        }
        // A phone of 380 px, and the whole of a 16:9 screen.
        assert!(Layout::new(352.0).height <= 450.0);
        assert!(Layout::new(1112.0).height <= 610.0 && Layout::new(1112.0).height > 580.0);
    }
}
