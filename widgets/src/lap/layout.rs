//! Where the parts of the figure stand: side by side where there is room, below each other on a phone.

use super::map::ASPECT;
use crate::scene::{LINE, Rect};

/// From this width on \[css px\], the mosaic stands beside the large view.
pub const WIDE: f64 = 640.0;

/// Narrowest width that is laid out \[css px\]; below, the figure is made smaller as a whole.
pub const NARROWEST: f64 = 300.0;

/// How far the ring around the chosen tile reaches beyond it \[css px\].
pub const RING: f64 = 3.0;

const HEADER: f64 = 26.0;
const PAD: f64 = 8.0;
const METER: f64 = 46.0;

/// The parts of the figure \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// Which universe is shown large, and the step.
    pub large_header: Rect,
    /// Its map.
    pub large: Rect,
    /// What is drawn in it.
    pub legend: Rect,
    /// How many universes there are, and what became of them.
    pub mosaic_header: Rect,
    /// All of them, and a margin of `RING` around them.
    pub mosaic: Rect,
    /// What borders and marks of the mosaic mean.
    pub notes: Rect,
    /// N_eff over the steps.
    pub meter: Rect,
    /// Of the whole figure.
    pub height: f64,
}

impl Layout {
    /// For a figure of this width.
    pub fn new(width: f64) -> Self {
        let width = if width.is_finite() { width.max(NARROWEST) } else { NARROWEST };
        let (legend, notes) = (if width < 340.0 { 3.0 } else { 2.0 } * LINE, 2.0 * LINE);
        let below_mosaic = PAD + notes + PAD + METER;
        let column = |x: f64, y: f64, w: f64, ring: f64| {
            let header = Rect::new(x, y, w, HEADER);
            (header, Rect::new(x, header.bottom(), w, (w - 2.0 * ring) / ASPECT + 2.0 * ring))
        };
        let below = |area: &Rect, h: f64| Rect::new(area.x, area.bottom() + PAD, area.w, h);
        let wide = width >= WIDE;
        // Side by side, the large view is so much larger that both columns end at the same height.
        let gap = 28.0;
        let excess = (below_mosaic - PAD - legend) * ASPECT + 2.0 * RING * (ASPECT - 1.0);
        let large_width = if wide { (0.5 * (width - gap + excess)).floor() } else { width };
        let (large_header, large) = column(0.0, 0.0, large_width, 0.0);
        let legend = below(&large, legend);
        let (mosaic_header, mosaic) = if wide {
            column(large.right() + gap, 0.0, width - large_width - gap, RING)
        } else {
            column(0.0, legend.bottom() + PAD, width, RING)
        };
        let notes = below(&mosaic, notes);
        let meter = below(&notes, METER);
        let height = legend.bottom().max(meter.bottom()).ceil();
        Self { large_header, large, legend, mosaic_header, mosaic, notes, meter, height }
    }

    /// All parts.
    pub fn parts(&self) -> [Rect; 7] {
        [self.large_header, self.large, self.legend, self.mosaic_header, self.mosaic, self.notes, self.meter]
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
    fn the_large_view_is_the_larger_one() {
        for width in [640.0, 800.0, 1280.0] {
            let layout = Layout::new(width);
            assert!(layout.large.w > layout.mosaic.w && layout.mosaic.w > 0.35 * width, "{width}");
        }
    }
}
