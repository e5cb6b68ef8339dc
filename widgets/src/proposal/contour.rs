//! The outline of a region of highest density.

use crate::scene::Point;
use fastslam::exact::one_step::Posterior;

/// Pieces of the line \[m\] on which the density between the middles of the cells is that of the region's edge: marching squares
/// (Lorensen, Cline 1987, in the plane). Saddles are joined through the middle.
pub fn outline(posterior: &Posterior) -> Vec<Vec<Point>> {
    let Posterior { cells, densities, level, .. } = posterior;
    let mut pieces = Vec::new();
    for k in 0..cells.count() - cells.side {
        if k % cells.side == cells.side - 1 {
            continue;
        }
        // Around a square of four middles.
        let corners = [k, k + 1, k + 1 + cells.side, k + cells.side];
        let mut crossings: Vec<Point> = Vec::new();
        for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0)].map(|(a, b)| (corners[a], corners[b])) {
            let (above, below) = (densities[a] - level, level - densities[b]);
            if (above >= 0.0) == (below > 0.0) {
                let t = above / (above + below);
                let (from, to) = (cells.centre(a), cells.centre(b));
                crossings.push([0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis])));
            }
        }
        pieces.extend(crossings.chunks_exact(2).map(<[Point]>::to_vec));
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::experiment::proposals::{Proposals, ProposalsSetup};

    #[test]
    fn the_outline_lies_on_the_edge_of_the_region_and_is_closed() {
        for twins in [false, true] {
            let posterior = Proposals::new(&ProposalsSetup { twins, samples: 1, ..Default::default() }).unwrap().exact;
            let pieces = outline(&posterior);
            assert!(pieces.len() > 40, "{}", pieces.len());
            let size = posterior.cells.size();
            for piece in &pieces {
                // Every end is the end of another piece.
                for end in piece {
                    let near = |other: &Point| (0..2).all(|axis| (other[axis] - end[axis]).abs() < 1e-9);
                    assert_eq!(pieces.iter().flatten().filter(|other| near(other)).count(), 2, "{end:?}");
                }
                let [x, y] = [0, 1].map(|axis| 0.5 * (piece[0][axis] + piece[1][axis]));
                let around =
                    [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]].map(|[u, v]| [x + u * size[0], y + v * size[1]]);
                let inside = around.iter().filter(|place| posterior.in_region(**place)).count();
                assert!((1..=3).contains(&inside), "{piece:?}");
            }
        }
    }
}
