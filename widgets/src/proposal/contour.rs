//! The outline of a region of highest density, and how much of it all a Gaussian covers.

use crate::scene::NINE_TENTHS;
use fastslam::proposal::Measured;
use fastslam_lab::baseline::one_step::Posterior;

/// Share of the posterior inside the outline that holds nine tenths of a Gaussian, both of (x, y): 0.9 where they are the same. One that is
/// too small has its own samples well inside the posterior, and covers less of it.
pub fn covered(posterior: &Posterior, gaussian: &Measured) -> f64 {
    let Posterior { cells, densities, .. } = posterior;
    let (mean, c) = (&gaussian.mean, &gaussian.covariance);
    let most = NINE_TENTHS * NINE_TENTHS * (c[(0, 0)] * c[(1, 1)] - c[(0, 1)] * c[(0, 1)]);
    let holds = |k: &usize| {
        let [x, y] = cells.centre(*k);
        let (x, y) = (x - mean.x, y - mean.y);
        c[(1, 1)] * x * x - 2.0 * c[(0, 1)] * x * y + c[(0, 0)] * y * y <= most
    };
    (0..cells.count()).filter(holds).map(|k| densities[k]).sum::<f64>() / densities.iter().sum::<f64>()
}

/// No crossing follows.
const END: usize = usize::MAX;

/// The lines \[m\] on which the density between the middles of the cells is that of the region's edge, each closed where it does not
/// leave the grid: marching squares (Lorensen, Cline 1987, in the plane).
pub fn outline(posterior: &Posterior) -> Vec<Vec<[f64; 2]>> {
    let Posterior { cells, densities, level, .. } = posterior;
    // A crossing lies between the middle of a cell and the next one in its row, 2 k, or in its column, 2 k + 1.
    let crossing = |a: usize, b: usize| 2 * a.min(b) + usize::from(a.abs_diff(b) == cells.side);
    // From each crossing to the next: the region is always on the same side.
    let mut next = vec![END; 2 * densities.len()];
    for k in (0..cells.count() - cells.side).filter(|k| k % cells.side != cells.side - 1) {
        let corners = [k, k + 1, k + 1 + cells.side, k + cells.side];
        let inside = corners.map(|corner| densities[corner] >= *level);
        // A saddle is crossed twice: each way in is followed by the first way out after it.
        for enter in (0..4).filter(|side| !inside[*side] && inside[(side + 1) % 4]) {
            let leave = (1..4).map(|turn| (enter + turn) % 4).find(|side| inside[*side] && !inside[(side + 1) % 4]);
            let at = |side: usize| crossing(corners[side], corners[(side + 1) % 4]);
            next[at(enter)] = leave.map_or(END, at);
        }
    }
    let place = |crossing: usize| {
        let (a, b) = (crossing / 2, crossing / 2 + [1, cells.side][crossing % 2]);
        let t = (level - densities[a]) / (densities[b] - densities[a]);
        let (from, to) = (cells.centre(a), cells.centre(b));
        [0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis]))
    };
    let mut lines = Vec::new();
    for first in 0..next.len() {
        if next[first] == END {
            continue;
        }
        let (mut line, mut at) = (Vec::new(), first);
        while at != END {
            line.push(place(at));
            at = core::mem::replace(&mut next[at], END);
        }
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam_lab::experiment::proposal::{Proposals, ProposalsSetup};

    #[test]
    fn a_gaussian_covers_nine_tenths_of_its_own_kind_and_one_that_is_too_small_less_than_its_samples_tell() {
        let covered_by = |setup: &ProposalsSetup| {
            let found = Proposals::new(setup).unwrap();
            (covered(&found.exact, &found.gaussian), found.aware.share_inside(None))
        };
        let (usual, _) = covered_by(&ProposalsSetup::default());
        assert!((usual - 0.9).abs() < 0.02, "{usual}");
        let bent = ProposalsSetup {
            bearing_std: 0.3,
            range_std: 0.01,
            odometry_scale: 2.0,
            landmark: [1.5, 0.3],
            ..Default::default()
        };
        let (covered, inside) = covered_by(&bent);
        assert!(inside > 0.9 && covered < 0.8, "{covered} covered, {inside} inside");
    }

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
