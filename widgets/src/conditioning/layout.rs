//! Where the parts of the figure stand: the graph beside the matrix where there is room, above it on a phone.

use crate::{
    panels::Panels,
    scene::{LINE, Parts, Rect, Stack, parts},
    view,
};
use fastslam_lab::experiment::conditioning::SIZE;

/// Names of the panels: the graph, and the covariance of the map.
pub const GRAPH: &str = "graph";
/// See [`GRAPH`].
pub const MATRIX: &str = "matrix";

/// What is shown around the place \[m\]: what is known of a landmark at its edge reaches beyond.
pub const MARGIN: f64 = 0.5;

/// From this width on \[css px\], the matrix stands beside the graph.
pub const WIDE: f64 = 560.0;

const HEADER: f64 = 26.0;
const PAD: f64 = 8.0;
/// Left of the matrix and above it, for the names of the landmarks.
const GUTTER: [f64; 2] = [26.0, 16.0];
/// Right of the matrix, for the frame of an entry at its edge.
const RING: f64 = 4.0;
const NOTES: f64 = 5.0 * LINE;
/// A button between graph and matrix, beside each other and one above the other.
const BUTTON: [f64; 2] = [112.0, 56.0];
const BUTTON_GAP: f64 = 8.0;
/// Largest side of a matrix that is shown alone, and of one below the graph: all of a wide figure would be more than a screen is high.
const ALONE: f64 = 380.0;
const BELOW: f64 = 205.0;

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// Which panels are shown.
        pub panels: Panels,
        /// What is known of the path.
        pub graph_header: Rect,
        /// Poses, landmarks and what connects them.
        pub graph: Rect,
        /// What is drawn in it.
        pub legend: Rect,
        /// What can be done to get from one to the other; nothing, where only one is shown.
        pub buttons: [Rect; 3],
        /// What the matrix is.
        pub matrix_header: Rect,
        /// Names of its columns.
        pub columns: Rect,
        /// Names of its rows.
        pub rows: Rect,
        /// The covariance, a square.
        pub matrix: Rect,
        /// The entry chosen, and what is counted.
        pub notes: Rect,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[GRAPH, MATRIX];

    fn laid_out(width: f64, panels: &Panels) -> Self {
        let [graph, matrix] = [GRAPH, MATRIX].map(|name| panels.has(name));
        let [across, up] = SIZE.map(|side| side + 2.0 * MARGIN);
        let aspect = across / up;
        let (wide, both) = (width >= WIDE, graph && matrix);
        let legend_height = if width < 780.0 { 3.0 } else { 2.0 } * LINE;
        let beside = wide && both;
        let gap = if beside { BUTTON[0] + 2.0 * 16.0 } else { 28.0 };
        // Side by side, both columns end at the same height: g / aspect + below the graph = m + around the matrix.
        let excess = GUTTER[1] - GUTTER[0] - RING + NOTES - legend_height;
        let graph_width = if beside { ((width - gap + excess) / (1.0 + 1.0 / aspect)).floor() } else { width };
        let mut column = Stack::new(0.0, graph_width);
        let graph_header = column.take(graph, HEADER, 0.0);
        let graph_area = column.take(graph, graph_width / aspect, PAD);
        let legend = column.take(graph, legend_height, PAD);
        let buttons = if beside {
            let x = graph_width + gap;
            column = Stack::new(x, width - x);
            let [w, h] = BUTTON;
            let middle = graph_area.centre()[1];
            let at = |k: f64| middle + k * (h + BUTTON_GAP) - 0.5 * h;
            [-1.0, 0.0, 1.0].map(|k| Rect::new(graph_width + 16.0, at(k), w, h))
        } else {
            let row = column.take(both, BUTTON[1], PAD);
            let w = (row.w - 2.0 * BUTTON_GAP) / 3.0;
            [0.0, 1.0, 2.0].map(|k| Rect::new(row.x + k * (w + BUTTON_GAP), row.y, w, row.h))
        };
        if !graph {
            column.w = column.w.min(GUTTER[0] + ALONE + RING);
        }
        let most = if both && !beside { BELOW } else { f64::INFINITY };
        let side = (column.w - GUTTER[0] - RING).min(most);
        let matrix_header = column.take(matrix, HEADER, 0.0);
        let names = column.take(matrix, GUTTER[1], 0.0);
        let Rect { x, y, h, .. } = column.take(matrix, side, PAD);
        // A name may be wider than its block: there is room at both ends.
        let columns = Rect::new(x + GUTTER[0] - 10.0, names.y, side + 10.0 + RING, names.h);
        let rows = Rect::new(x, y, GUTTER[0], h);
        let matrix_area = Rect::new(rows.right(), y, side, h);
        if !graph && wide {
            // Alone, it leaves room for its notes.
            let x = matrix_header.right() + gap;
            column = Stack { x, y, w: width - x };
        }
        let notes = column.take(matrix, NOTES, 0.0);
        let mut layout = Self {
            panels: panels.clone(),
            graph_header,
            graph: graph_area,
            legend,
            buttons,
            matrix_header,
            columns,
            rows,
            matrix: matrix_area,
            notes,
            height: 0.0,
        };
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
        assert_laid_out::<Layout>(&[("all", 11), ("graph", 3), ("matrix", 5)], 1.0);
    }

    #[test]
    fn side_by_side_both_columns_end_at_the_same_height() {
        for width in [600.0, 692.0, 800.0, 1280.0] {
            let layout = Layout::new(width);
            assert!((layout.legend.bottom() - layout.notes.bottom()).abs() < 2.0, "{width}");
            assert!(layout.graph.w > layout.matrix.w && layout.matrix.w > 0.25 * width, "{width}");
        }
    }
    #[test]
    fn the_matrix_alone_fits_on_a_screen() {
        let matrix = Panels::of(&[MATRIX]);
        for width in (300..2000).step_by(7).map(f64::from) {
            assert!(Layout::of(width, &matrix).height < 600.0, "{width}");
        }
    }
}
