//! Where the parts of the figure stand: side by side where there is room, below each other on a phone.

use super::map::ASPECT;
use crate::{
    panels::Panels,
    scene::{LINE, Parts, Rect, Stack, parts},
    view,
};

/// Names of the panels: one universe large, all of them small, and N_eff over the steps.
pub const MAP: &str = "map";
/// See [`MAP`].
pub const MOSAIC: &str = "mosaic";
/// See [`MAP`].
pub const ESS: &str = "n-eff";

/// From this width on \[css px\], the mosaic stands beside the large view.
pub const WIDE: f64 = 560.0;

/// How far the ring around the chosen tile reaches beyond it \[css px\].
pub const RING: f64 = 3.0;

const HEADER: f64 = 26.0;
const PAD: f64 = 8.0;
const METER: f64 = 64.0;

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// Which panels are shown.
        pub panels: Panels,
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
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[MAP, MOSAIC, ESS];

    fn laid_out(width: f64, panels: &Panels) -> Self {
        let [map, mosaic, meter] = [MAP, MOSAIC, ESS].map(|name| panels.has(name));
        // Side by side, the large view is so much larger that both columns end at the same height.
        let beside = width >= WIDE && map && mosaic;
        let gap = 28.0;
        let legend = if width < 880.0 { 3.0 } else { 2.0 } * LINE;
        let notes = if beside && width < 680.0 { 3.0 } else { 2.0 } * LINE;
        let below_mosaic = notes + if meter { PAD + METER } else { 0.0 };
        let excess = (below_mosaic - legend) * ASPECT + 2.0 * RING * (ASPECT - 1.0);
        let large_width = if beside { (0.5 * (width - gap + excess)).floor() } else { width };

        let mut column = Stack::new(0.0, large_width);
        let large_header = column.take(map, HEADER, 0.0);
        let large = column.take(map, column.w / ASPECT, PAD);
        let legend = column.take(map, legend, PAD);
        if beside {
            let x = large.right() + gap;
            column = Stack::new(x, width - x);
        }
        let mosaic_header = column.take(mosaic, HEADER, 0.0);
        let tiles = column.take(mosaic, (column.w - 2.0 * RING) / ASPECT + 2.0 * RING, PAD);
        let notes = column.take(mosaic, notes, PAD);
        let meter = column.take(meter, METER, PAD);
        let panels = panels.clone();
        let mut layout =
            Self { panels, large_header, large, legend, mosaic_header, mosaic: tiles, notes, meter, height: 0.0 };
        layout.height = layout.lowest().ceil();
        layout
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
        assert_laid_out::<Layout>(
            &[("all", 7), (MAP, 3), (MOSAIC, 3), (ESS, 1), ("map n-eff", 4), ("map mosaic", 6)],
            1.0,
        );
    }

    #[test]
    fn the_large_view_is_the_larger_one() {
        for width in [640.0, 800.0, 1280.0] {
            let layout = Layout::new(width);
            assert!(layout.large.w > layout.mosaic.w && layout.mosaic.w > 0.35 * width, "{width}");
        }
    }
}
