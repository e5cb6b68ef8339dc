//! Where the parts of the figure stand.

use crate::{
    panels::Panels,
    scene::{LINE, Rect, parts},
    view,
};

/// Names of the panels: the building with the graph, the universes on the same log, and the error over the iterations.
pub const GRAPH: &str = "graph";
/// See [`GRAPH`].
pub const UNIVERSES: &str = "universes";
/// See [`GRAPH`].
pub const ERROR: &str = "error";

/// From this width on \[css px\] the others stand beside the building.
pub const WIDE: f64 = 560.0;

const HEADER: f64 = 22.0;
const GAP: f64 = 16.0;
const PAD: f64 = 4.0;
/// Below the chart, for its numbers.
const AXIS: f64 = 16.0;
/// Left of the chart, for the names of its levels.
const SCALE: f64 = 34.0;
/// Width over height of the building, and most of its height.
const ASPECT: f64 = 1.28;
const MOST: f64 = 510.0;
/// Width over height of a universe.
const UNIVERSE: f64 = crate::lap::ASPECT;

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// Whether there is room for long names.
        pub wide: bool,
        /// What the building shows.
        pub city_header: Rect,
        /// The building, and the graph in it.
        pub city: Rect,
        /// What its marks are.
        pub city_legend: Rect,
        /// What the universes show.
        pub universes_header: Rect,
        /// The universes, laid over each other.
        pub universes: Rect,
        /// How far they are off, and how large.
        pub universes_told: Rect,
        /// What the chart shows.
        pub error_header: Rect,
        /// What its lines are.
        pub error_legend: Rect,
        /// The error over the iterations.
        pub error: Rect,
        /// Left of it.
        pub scale: Rect,
        /// Below it.
        pub axis: Rect,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[GRAPH, UNIVERSES, ERROR];

    fn laid_out(width: f64, shown: &Panels) -> Self {
        let [graph, universes, error] = [GRAPH, UNIVERSES, ERROR].map(|name| shown.has(name));
        let wide = width >= WIDE;
        let beside = wide && graph && (universes || error);
        // The building.
        let left = if beside { (0.62 * width).floor() } else { width };
        let high = if wide { (left / ASPECT).min(MOST) } else { (0.62 * width).min(226.0) };
        let of = |there: bool, h: f64| if there { h } else { 0.0 };
        let city_header = Rect::new(0.0, 0.0, left, of(graph, HEADER));
        let city = Rect::new(0.0, city_header.bottom(), left, of(graph, high.floor()));
        let city_legend = Rect::new(0.0, city.bottom() + of(graph, PAD), left, of(graph, 2.0 * LINE));
        let below = city_legend.bottom();
        // What stands beside it or below it.
        let x = if beside { left + GAP } else { 0.0 };
        let top = if beside || !graph { 0.0 } else { below + PAD };
        let room = width - x;
        let both = universes && error;
        // In one row where there is no column for them.
        let row = !beside && both;
        let column = if row { ((room - GAP) / 2.0).floor() } else { room };
        let lines = if row { 2.0 } else { 1.0 } * LINE;
        let map = if row { (column / UNIVERSE).min(108.0) } else { (column / UNIVERSE).min(300.0) }.floor();
        let universes_header = Rect::new(x, top, column, of(universes, HEADER));
        let drawn = Rect::new(x, universes_header.bottom(), column, of(universes, map));
        let universes_told = Rect::new(x, drawn.bottom(), column, of(universes, 2.0 * LINE));
        let under = universes_told.bottom();
        let [chart_x, chart_y] =
            if row { [x + column + GAP, top] } else { [x, if universes { under + PAD } else { top }] };
        let error_header = Rect::new(chart_x, chart_y, column, of(error, HEADER));
        let error_legend = Rect::new(chart_x, error_header.bottom(), column, of(error, lines));
        let above = error_legend.bottom() + of(error, PAD);
        let least = if row { under - above - AXIS } else { 96.0 };
        let free = if beside { (below - above - AXIS).max(least) } else { least };
        let area = Rect::new(chart_x + SCALE, above, column - SCALE - 10.0, of(error, free));
        let scale = Rect::new(chart_x, above, SCALE, area.h);
        let axis = Rect::new(chart_x, area.bottom(), column, of(error, AXIS));
        let height = below.max(under).max(axis.bottom()).ceil();
        Self {
            wide,
            city_header,
            city,
            city_legend,
            universes_header,
            universes: drawn,
            universes_told,
            error_header,
            error_legend,
            error: area,
            scale,
            axis,
            height,
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
    use crate::view::Layout as _;

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        assert_laid_out::<Layout>(
            &[
                ("all", 11),
                (GRAPH, 3),
                (UNIVERSES, 3),
                (ERROR, 5),
                ("graph universes", 6),
                ("graph error", 8),
                ("universes error", 8),
            ],
            PAD,
        );
    }

    #[test]
    fn the_picture_and_its_controls_are_on_one_screen() {
        assert_on_screens::<Layout>(&[
            (692.0, 452.0),
            (600.0, 452.0),
            (352.0, 452.0),
            (322.0, 452.0),
            (760.0, 490.0),
            (1112.0, 610.0),
        ]);
    }
    #[test]
    fn the_chart_is_high_enough_to_be_read() {
        for names in ["all", ERROR, "graph error", "universes error"] {
            let panels = Panels::named(names, &[GRAPH, UNIVERSES, ERROR]).unwrap();
            for width in (300..2000).step_by(7).map(f64::from) {
                assert!(Layout::of(width, &panels).error.h > 60.0, "{names} at {width}");
            }
        }
    }
}
