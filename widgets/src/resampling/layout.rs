//! Where the parts of the figure stand: a column for each filter where there is room, the filters below each other on a phone.

use crate::{
    panels::Panels,
    scene::{LINE, Rect},
    view,
};

/// Names of the panels: four charts, and where the particles are.
pub const ESS: &str = "n-eff";
/// See [`ESS`].
pub const LINEAGE: &str = "ancestors";
/// See [`ESS`].
pub const ERROR: &str = "error";
/// See [`ESS`].
pub const TREE: &str = "tree";
/// See [`ESS`].
pub const PARTICLES: &str = "particles";
/// The charts, by rank.
pub const CHARTS: [&str; 4] = [ESS, LINEAGE, ERROR, TREE];

/// From this width on \[css px\], the filters stand side by side.
pub const WIDE: f64 = 720.0;

/// Narrowest width that is laid out \[css px\]; below, the figure is made smaller as a whole.
pub const NARROWEST: f64 = 300.0;

const HEADER: f64 = 26.0;
const PAD: f64 = 8.0;
const AXIS: f64 = 15.0;
/// Left and right of a chart, for half of a marker at its end.
const EDGE: f64 = 4.0;

/// What is shown of one filter \[css px\].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Column {
    /// Its policy.
    pub header: Rect,
    /// A line with names and values, above N_eff, lineage, errors and tree each.
    pub labels: [Rect; 4],
    /// N_eff, lineage, errors and tree over the steps: one width, so that one cursor goes through all.
    pub charts: [Rect; 4],
    /// Below the tree, for steps.
    pub axis: Rect,
    /// What is said of the map.
    pub map_label: Rect,
    /// Where the particles are.
    pub map: Rect,
}

/// The parts of the figure \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// Which panels are shown.
    pub panels: Panels,
    /// Whether the filters stand side by side.
    pub wide: bool,
    /// One for each filter.
    pub columns: [Column; 3],
    /// What marks mean.
    pub legend: Rect,
    /// Of the whole figure.
    pub height: f64,
}

impl Layout {
    /// Of all panels, for a figure of this width.
    pub fn new(width: f64) -> Self {
        Self::of(width, &Panels::default())
    }

    /// Of some panels: those that are not shown have no height.
    pub fn of(width: f64, panels: &Panels) -> Self {
        let width = if width.is_finite() { width.max(NARROWEST) } else { NARROWEST };
        let wide = width >= WIDE;
        let gap = if wide { 26.0 } else { 10.0 };
        let third = (width - 2.0 * gap) / 3.0;
        let place = |k: usize| k as f64 * (third + gap);
        let (map_lines, map_height) = if wide { (1.0, 0.42 * third) } else { (2.0, 0.8 * third) };
        let (chart, tree) = if wide { (46.0, 0.42 * third.clamp(240.0, 400.0)) } else { (40.0, 108.0) };

        let charts = CHARTS.iter().any(|name| panels.has(name));
        let maps = panels.has(PARTICLES);
        let mut top = 0.0;
        let mut columns = [0, 1, 2].map(|k| {
            let (x, w) = if wide { (place(k), third) } else { (0.0, width) };
            let mut y = if wide { 0.0 } else { top };
            let mut take = |h: f64, pad: f64| {
                let area = Rect::new(x, y, w, h);
                y += h + pad;
                area
            };
            let header = if charts { take(HEADER, 0.0) } else { take(0.0, 0.0) };
            let parts = [(ESS, chart, 5.0), (LINEAGE, chart, 5.0), (ERROR, chart, 5.0), (TREE, tree, 1.0)];
            let parts = parts.map(|(name, h, pad)| {
                let shown = panels.has(name);
                let mut take = |h: f64, pad: f64| if shown { take(h, pad) } else { take(0.0, 0.0) };
                let label = take(LINE, 2.0);
                let Rect { x, y, w, h } = take(h, pad);
                (label, Rect::new(x + EDGE, y, w - 2.0 * EDGE, h))
            });
            let axis = if charts { take(AXIS, PAD) } else { take(0.0, 0.0) };
            top = y + if wide || !charts { 0.0 } else { PAD };
            let nothing = Rect::new(0.0, 0.0, 0.0, 0.0);
            Column {
                header,
                labels: parts.map(|p| p.0),
                charts: parts.map(|p| p.1),
                axis,
                map_label: nothing,
                map: nothing,
            }
        });
        for (k, column) in columns.iter_mut().enumerate() {
            let [label, map] = [map_lines * LINE, map_height].map(|h| if maps { h } else { 0.0 });
            column.map_label = Rect::new(place(k), top, third, label);
            column.map = Rect::new(place(k), column.map_label.bottom(), third, map);
        }
        let lines = if wide {
            2.0
        } else if width >= 460.0 {
            3.0
        } else if width >= 370.0 {
            4.0
        } else {
            5.0
        };
        // What all marks mean is said below all of them.
        let (pad, lines) = if panels.are_all() { (PAD, lines) } else { (0.0, 0.0) };
        let legend = Rect::new(0.0, columns[0].map.bottom() + pad, width, lines * LINE);
        Self { panels: panels.clone(), wide, columns, legend, height: legend.bottom().ceil() }
    }

    /// The first chart that is shown.
    pub fn first_chart(&self) -> Rect {
        let charts = self.columns[0].charts;
        charts.into_iter().find(|chart| chart.h > 0.0).unwrap_or(charts[0])
    }

    /// Where the cursor follows a pointer: over all charts.
    pub fn charts(&self) -> Rect {
        let (start, end) = (self.first_chart(), self.columns[2].charts[3]);
        Rect::new(start.x, start.y, end.right() - start.x, end.bottom() - start.y)
    }

    /// All parts.
    pub fn parts(&self) -> Vec<Rect> {
        let of = |c: &Column| [&c.labels[..], &c.charts[..], &[c.header, c.axis, c.map_label, c.map]].concat();
        self.columns.iter().flat_map(of).chain([self.legend]).collect()
    }
}

impl view::Layout for Layout {
    fn height(&self) -> f64 {
        self.height
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
            let parts = layout.parts();
            let figure = Rect::new(0.0, 0.0, width, layout.height);
            for (k, a) in parts.iter().enumerate() {
                assert!(figure.encloses(a) && a.w > 0.0 && a.h > 0.0, "{width}: part {k}");
                assert!(parts[..k].iter().all(|b| !a.overlaps(b)), "{width}: part {k}");
            }
        }
    }

    #[test]
    fn one_cursor_goes_through_all_charts_of_a_filter() {
        for width in [300.0, 719.0, 720.0, 1280.0] {
            let Layout { columns, .. } = Layout::new(width);
            for Column { charts, .. } in columns {
                assert!(charts.iter().all(|c| (c.x, c.w) == (charts[0].x, charts[0].w)), "{width}");
            }
        }
    }

    #[test]
    fn panels_shown_alone_leave_no_place_for_the_others() {
        for (names, shown) in [("tree", 12), ("n-eff error", 18), ("particles", 6), ("ancestors particles", 18)] {
            let panels = Panels::named(names, &[ESS, LINEAGE, ERROR, TREE, PARTICLES]).unwrap();
            for width in (300..2000).step_by(7).map(f64::from) {
                let layout = Layout::of(width, &panels);
                let parts: Vec<Rect> = layout.parts().into_iter().filter(|part| part.h > 0.0).collect();
                assert_eq!(parts.len(), shown, "{names} at {width}");
                assert_apart(&parts, &Rect::new(0.0, 0.0, width, layout.height));
                assert!(layout.height < 0.8 * Layout::new(width).height, "{names} at {width}");
            }
        }
    }
}
