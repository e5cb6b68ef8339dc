//! Where the parts of the figure stand: gauges beside the map where there is room, below it on a phone.

use crate::scene::{LINE, Rect};

/// From this width on \[css px\], the gauges stand beside the map.
pub const WIDE: f64 = 640.0;

/// Narrowest width that is laid out \[css px\]; below, the figure is made smaller as a whole.
pub const NARROWEST: f64 = 300.0;

const HEADER: f64 = 26.0;
const PAD: f64 = 8.0;

/// A gauge over the scans \[css px\].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Gauge {
    /// Its name and its value.
    pub label: Rect,
    /// The curve.
    pub chart: Rect,
}

/// The parts of the figure \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// How far the log is mapped.
    pub header: Rect,
    /// The map.
    pub map: Rect,
    /// N_eff and lineage.
    pub gauges: [Gauge; 2],
    /// What marks mean.
    pub legend: Rect,
    /// Of the whole figure.
    pub height: f64,
}

impl Layout {
    /// For a figure of this width.
    pub fn new(width: f64) -> Self {
        let width = if width.is_finite() { width.max(NARROWEST) } else { NARROWEST };
        let header = Rect::new(0.0, 0.0, width, HEADER);
        let wide = width >= WIDE;
        let side = if wide { (0.27 * width).clamp(190.0, 260.0) } else { 0.0 };
        let map = if wide {
            let w = width - side - 16.0;
            Rect::new(0.0, HEADER, w, (0.78 * w).clamp(380.0, 760.0))
        } else {
            Rect::new(0.0, HEADER, width, 0.9 * width)
        };
        let chart = if wide { (0.12 * width).clamp(70.0, 130.0) } else { 56.0 };
        let gauge = |x: f64, y: f64, w: f64| Gauge {
            label: Rect::new(x, y, w, LINE),
            chart: Rect::new(x, y + LINE + 2.0, w, chart),
        };
        let (gauges, legend) = if wide {
            let (x, step) = (map.right() + 16.0, LINE + 2.0 + chart + 2.0 * PAD);
            let gauges = [0.0, 1.0].map(|k| gauge(x, map.y + k * step, side));
            let y = gauges[1].chart.bottom() + 2.0 * PAD;
            (gauges, Rect::new(x, y, side, map.bottom() - y))
        } else {
            let w = 0.5 * (width - 2.0 * PAD);
            let gauges = [0.0, 1.0].map(|k| gauge(k * (w + 2.0 * PAD), map.bottom() + PAD, w));
            let lines = if width >= 560.0 {
                2.0
            } else if width >= 400.0 {
                3.0
            } else {
                4.0
            };
            (gauges, Rect::new(0.0, gauges[0].chart.bottom() + PAD, width, lines * LINE))
        };
        let height = if wide { map.bottom() } else { legend.bottom() }.ceil();
        Self { header, map, gauges, legend, height }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::assert_apart;

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        for width in (300..2000).step_by(7).map(f64::from) {
            let Layout { header, map, gauges, legend, height } = Layout::new(width);
            let parts = [header, map, gauges[0].label, gauges[0].chart, gauges[1].label, gauges[1].chart, legend];
            assert!(parts.iter().all(|part| part.w > 0.0 && part.h > 0.0), "{width}");
            assert_apart(&parts, &Rect::new(0.0, 0.0, width, height));
        }
    }
}
