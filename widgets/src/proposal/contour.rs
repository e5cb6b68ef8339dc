//! The outline of a region of highest density.

use crate::scene::Point;
use fastslam::exact::one_step::Posterior;
use std::collections::BTreeMap;

/// The lines \[m\] on which the density between the middles of the cells is that of the region's edge, each closed where it does not
/// leave the grid: marching squares (Lorensen, Cline 1987, in the plane).
pub fn outline(posterior: &Posterior) -> Vec<Vec<Point>> {
    let Posterior { cells, densities, level, .. } = posterior;
    // From each crossing, named by the two middles it lies between, to the next: the region is always on the same side.
    let mut next = BTreeMap::new();
    for k in (0..cells.count() - cells.side).filter(|k| k % cells.side != cells.side - 1) {
        let corners = [k, k + 1, k + 1 + cells.side, k + cells.side];
        let (mut leaves, mut enters) = (Vec::new(), Vec::new());
        for side in 0..4 {
            let (a, b) = (corners[side], corners[(side + 1) % 4]);
            match (densities[a] >= *level, densities[b] >= *level) {
                (true, false) => leaves.push((a.min(b), a.max(b))),
                (false, true) => enters.push((a.min(b), a.max(b))),
                _ => (),
            }
        }
        next.extend(enters.into_iter().zip(leaves));
    }
    let place = |(a, b): (usize, usize)| {
        let t = (level - densities[a]) / (densities[b] - densities[a]);
        let (from, to) = (cells.centre(a), cells.centre(b));
        [0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis]))
    };
    let mut lines = Vec::new();
    while let Some((first, mut crossing)) = next.pop_first() {
        let mut line = vec![place(first), place(crossing)];
        while let Some(following) = next.remove(&crossing) {
            line.push(place(following));
            crossing = following;
        }
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::experiment::proposals::{Proposals, ProposalsSetup};

    #[test]
    fn the_outline_lies_on_the_edge_of_the_region_and_is_closed() {
        for twins in [false, true] {
            let posterior = Proposals::new(&ProposalsSetup { twins, samples: 1, ..Default::default() }).unwrap().exact;
            let lines = outline(&posterior);
            assert!(!lines.is_empty());
            let size = posterior.cells.size();
            for line in &lines {
                assert!(line.len() > 40 && line[0] == line[line.len() - 1], "{line:?}");
                for pair in line.windows(2) {
                    let [x, y] = [0, 1].map(|axis| 0.5 * (pair[0][axis] + pair[1][axis]));
                    let around = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]]
                        .map(|[u, v]| [x + u * size[0], y + v * size[1]]);
                    let inside = around.iter().filter(|place| posterior.in_region(**place)).count();
                    assert!((1..=3).contains(&inside), "{pair:?}");
                }
            }
        }
    }
}
