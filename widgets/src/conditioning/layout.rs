//! Where the parts of the figure stand: the graph beside the matrix where there is room, above it on a phone.

use crate::scene::{LINE, Rect};
use fastslam_lab::experiment::conditioning::SIZE;

/// What is shown around the place \[m\]: what is known of a landmark at its edge reaches beyond.
pub const MARGIN: f64 = 0.5;

/// From this width on \[css px\], the matrix stands beside the graph.
pub const WIDE: f64 = 720.0;

/// Narrowest width that is laid out \[css px\]; below, the figure is made smaller as a whole.
pub const NARROWEST: f64 = 300.0;

const HEADER: f64 = 26.0;
const PAD: f64 = 8.0;
/// Left of the matrix and above it, for the names of the landmarks.
const GUTTER: [f64; 2] = [26.0, 16.0];
/// Right of the matrix, for the frame of an entry at its edge.
const RING: f64 = 4.0;
const NOTES: f64 = 5.0 * LINE;

/// The parts of the figure \[css px\].
#[derive(Clone, PartialEq, Debug)]
pub struct Layout {
    /// What is known of the path.
    pub graph_header: Rect,
    /// Poses, landmarks and what connects them.
    pub graph: Rect,
    /// What is drawn in it.
    pub legend: Rect,
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

impl Layout {
    /// For a figure of this width.
    pub fn new(width: f64) -> Self {
        let width = if width.is_finite() { width.max(NARROWEST) } else { NARROWEST };
        let [across, up] = SIZE.map(|side| side + 2.0 * MARGIN);
        let aspect = across / up;
        let wide = width >= WIDE;
        let legend_height = if width < 340.0 { 3.0 } else { 2.0 } * LINE;
        let gap = 28.0;
        // Side by side, both columns end at the same height: g / aspect + below the graph = m + around the matrix.
        let excess = GUTTER[1] - GUTTER[0] - RING + NOTES - legend_height;
        let graph_width = if wide { ((width - gap + excess) / (1.0 + 1.0 / aspect)).floor() } else { width };
        let graph_header = Rect::new(0.0, 0.0, graph_width, HEADER);
        let graph = Rect::new(0.0, HEADER, graph_width, graph_width / aspect);
        let legend = Rect::new(0.0, graph.bottom() + PAD, graph_width, legend_height);
        let (x, y) = if wide { (graph_width + gap, 0.0) } else { (0.0, legend.bottom() + PAD) };
        let matrix_header = Rect::new(x, y, width - x, HEADER);
        let side = matrix_header.w - GUTTER[0] - RING;
        // A name may be wider than its block: there is room at both ends.
        let columns = Rect::new(x + GUTTER[0] - 10.0, matrix_header.bottom(), side + 10.0 + RING, GUTTER[1]);
        let rows = Rect::new(x, columns.bottom(), GUTTER[0], side);
        let matrix = Rect::new(rows.right(), rows.y, side, side);
        let notes = Rect::new(x, matrix.bottom() + PAD, matrix_header.w, NOTES);
        let height = legend.bottom().max(notes.bottom()).ceil();
        Self { graph_header, graph, legend, matrix_header, columns, rows, matrix, notes, height }
    }

    /// All parts.
    pub fn parts(&self) -> [Rect; 8] {
        let Self { graph_header, graph, legend, matrix_header, columns, rows, matrix, notes, .. } = self;
        [*graph_header, *graph, *legend, *matrix_header, *columns, *rows, *matrix, *notes]
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
    fn side_by_side_both_columns_end_at_the_same_height() {
        for width in [720.0, 800.0, 1280.0] {
            let layout = Layout::new(width);
            assert!((layout.legend.bottom() - layout.notes.bottom()).abs() < 2.0, "{width}");
            assert!(layout.graph.w > layout.matrix.w && layout.matrix.w > 0.3 * width, "{width}");
        }
    }
}
