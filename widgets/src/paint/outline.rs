//! Outlines of lines, discs and curves, for [`super::coverage`] to fill. Only square roots and the four operations: the same bits
//! everywhere.

use super::coverage::Coverage;

/// A point or a direction \[px\].
type Vector = [f64; 2];

/// The outline of a polyline of this width, solid, with round ends where `round`; corners are filled up round.
///
/// Every segment is a rectangle, every corner a wedge between two of them. All turn the same way, so that they add up to
/// the stroke, and neighbours share their edges, so that they leave no seam.
pub fn stroke(coverage: &mut Coverage, points: &[Vector], width: f64, round: bool) {
    let half = 0.5 * width;
    let mut before: Option<Vector> = None;
    let mut end = None;
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let Some(along) = unit([b[0] - a[0], b[1] - a[1]]) else { continue };
        let side = [-along[1], along[0]];
        contour(coverage, &[at(a, half, side), at(a, -half, side), at(b, -half, side), at(b, half, side)]);
        match before {
            Some(before) => corner(coverage, a, half, before, side),
            None if round => arc(coverage, a, half, side, [-along[0], -along[1]], [-side[0], -side[1]]),
            None => (),
        }
        before = Some(side);
        end = Some((b, along));
    }
    if let (Some((b, along)), Some(side), true) = (end, before, round) {
        arc(coverage, b, half, [-side[0], -side[1]], along, side);
    }
}

/// The pieces of a polyline that a dash pattern draws: dash and gap \[px\], beginning with a dash.
pub fn dashes(points: &[Vector], [dash, gap]: [f64; 2]) -> Vec<Vec<Vector>> {
    if !(dash > 0.0 && gap > 0.0) {
        return vec![points.to_vec()];
    }
    let mut pieces = Vec::new();
    let (mut piece, mut drawn, mut left) = (Vec::from_iter(points.first().copied()), true, dash);
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let delta = [b[0] - a[0], b[1] - a[1]];
        let length = norm(delta);
        let mut walked = 0.0;
        while length - walked > left {
            walked += left;
            let point = at(a, walked / length, delta);
            if drawn {
                piece.push(point);
                pieces.push(core::mem::take(&mut piece));
            } else {
                piece = vec![point];
            }
            drawn = !drawn;
            left = if drawn { dash } else { gap };
        }
        left -= length - walked;
        if drawn {
            piece.push(b);
        }
    }
    if drawn && piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

/// The outline of a disc.
pub fn disc(coverage: &mut Coverage, centre: Vector, radius: f64) {
    arc(coverage, centre, radius, [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]);
    arc(coverage, centre, radius, [0.0, -1.0], [1.0, 0.0], [0.0, 1.0]);
}

/// A quadratic curve as straight pieces.
pub fn quad(coverage: &mut Coverage, [a, c, b]: [Vector; 3]) {
    let bend = norm([0, 1].map(|k| a[k] - 2.0 * c[k] + b[k]));
    let n = pieces(0.25 * bend);
    for k in 1..=n {
        let t = f64::from(k) / f64::from(n);
        let s = 1.0 - t;
        coverage.line_to([0, 1].map(|k| s * s * a[k] + 2.0 * s * t * c[k] + t * t * b[k]));
    }
}

/// A cubic curve as straight pieces.
pub fn cubic(coverage: &mut Coverage, [a, c, d, b]: [Vector; 4]) {
    let bend = |p: Vector, q: Vector, r: Vector| norm([0, 1].map(|k| p[k] - 2.0 * q[k] + r[k]));
    let n = pieces(0.75 * bend(a, c, d).max(bend(c, d, b)));
    for k in 1..=n {
        let t = f64::from(k) / f64::from(n);
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        coverage.line_to([0, 1].map(|k| weights[0] * a[k] + weights[1] * c[k] + weights[2] * d[k] + weights[3] * b[k]));
    }
}

/// Pieces that keep a curve within a 20th of a pixel, for its largest distance \[px\] from its chord.
fn pieces(distance: f64) -> u32 {
    ((20.0 * distance).sqrt().ceil() as u32).clamp(1, 64)
}

/// Fills the outer side of a corner, between the ends of two segments with these normals.
fn corner(coverage: &mut Coverage, point: Vector, half: f64, before: Vector, after: Vector) {
    let turn = before[0] * after[1] - before[1] * after[0];
    let (from, to) = if turn > 0.0 {
        ([-before[0], -before[1]], [-after[0], -after[1]]) // turns towards the normals: the other side gapes
    } else {
        (after, before)
    };
    match unit([from[0] + to[0], from[1] + to[1]]) {
        Some(middle) => arc(coverage, point, half, from, middle, to),
        None => arc(coverage, point, half, from, [from[1], -from[0]], to), // straight back
    }
}

/// A sector of a disc: from one direction over the one in the middle to another, less than a full turn.
fn arc(coverage: &mut Coverage, centre: Vector, radius: f64, from: Vector, middle: Vector, to: Vector) {
    coverage.move_to(centre);
    coverage.line_to(at(centre, radius, from));
    bow(coverage, centre, radius, from, middle, 3);
    bow(coverage, centre, radius, middle, to, 3);
    coverage.close();
}

/// A piece of a circle from one direction to another, halved until it is within a 20th of a pixel of its chord.
fn bow(coverage: &mut Coverage, centre: Vector, radius: f64, from: Vector, to: Vector, depth: u32) {
    let sum = [from[0] + to[0], from[1] + to[1]];
    let flat = radius * (1.0 - 0.5 * norm(sum)) < 0.05;
    match unit(sum) {
        Some(middle) if !flat && depth > 0 => {
            bow(coverage, centre, radius, from, middle, depth - 1);
            bow(coverage, centre, radius, middle, to, depth - 1);
        }
        _ => coverage.line_to(at(centre, radius, to)),
    }
}

fn contour(coverage: &mut Coverage, corners: &[Vector]) {
    coverage.move_to(corners[0]);
    corners[1..].iter().for_each(|&corner| coverage.line_to(corner));
    coverage.close();
}

fn at(from: Vector, distance: f64, direction: Vector) -> Vector {
    [from[0] + distance * direction[0], from[1] + distance * direction[1]]
}

fn norm([x, y]: Vector) -> f64 {
    (x * x + y * y).sqrt()
}

fn unit(v: Vector) -> Option<Vector> {
    let length = norm(v);
    (length > 1e-9 && length.is_finite()).then(|| [v[0] / length, v[1] / length])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paint::Pixels;

    fn dark(size: [u32; 2], outline: impl FnOnce(&mut Coverage)) -> Vec<f64> {
        let mut pixels = Pixels::default();
        pixels.clear(size, [255; 3]);
        let mut coverage = Coverage::default();
        coverage.resize(size);
        outline(&mut coverage);
        coverage.fill(&mut pixels, [0; 3]);
        pixels.bytes().chunks_exact(4).map(|p| f64::from(255 - p[0]) / 255.0).collect()
    }

    #[test]
    fn a_stroke_has_its_width_in_every_direction() {
        for (dx, dy) in [(60.0, 0.0), (0.0, -60.0), (36.0, 48.0), (-48.0, 36.0), (-36.0, -48.0)] {
            let line = [[50.0 - 0.5 * dx, 50.0 - 0.5 * dy], [50.0 + 0.5 * dx, 50.0 + 0.5 * dy]];
            let total: f64 = dark([100, 100], |c| stroke(c, &line, 3.0, false)).iter().sum();
            assert!((total - 180.0).abs() < 1.5, "{dx}, {dy}: {total}");
        }
    }

    #[test]
    fn round_ends_and_corners_add_sectors() {
        let pi = core::f64::consts::PI;
        let straight = [[10.0, 20.0], [30.0, 20.0], [50.0, 20.0]];
        let total: f64 = dark([60, 40], |c| stroke(c, &straight, 8.0, true)).iter().sum();
        assert!((total - (320.0 + 16.0 * pi)).abs() < 1.5, "{total}");
        // A right angle, either way: two rectangles overlap in a square of 4 px, and a quarter disc fills the outside.
        for y in [10.0, 50.0] {
            let bent = [[10.0, 30.0], [30.0, 30.0], [30.0, y]];
            let total: f64 = dark([60, 60], |c| stroke(c, &bent, 8.0, false)).iter().sum();
            assert!((total - (320.0 - 16.0 + 4.0 * pi)).abs() < 1.5, "{total}");
        }
    }

    #[test]
    fn discs_are_as_large_as_they_should_be() {
        for radius in [1.0, 2.5, 9.0] {
            let total: f64 = dark([20, 20], |c| disc(c, [10.2, 9.7], radius)).iter().sum();
            let area = core::f64::consts::PI * radius * radius;
            assert!((total - area).abs() < 0.03 * area, "{radius}: {total}");
        }
    }

    #[test]
    fn dashes_go_round_corners_and_leave_gaps() {
        let pieces = dashes(&[[0.0, 0.0], [5.0, 0.0], [5.0, 6.0]], [4.0, 2.0]);
        assert_eq!(pieces, [vec![[0.0, 0.0], [4.0, 0.0]], vec![[5.0, 1.0], [5.0, 5.0]]]);
        let pieces = dashes(&[[0.0, 0.0], [3.0, 0.0], [3.0, 9.0]], [4.0, 2.0]);
        assert_eq!(pieces[0], [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0]]);
        assert!(dashes(&[], [4.0, 2.0]).is_empty());
    }

    #[test]
    fn a_line_without_length_draws_nothing() {
        assert_eq!(dark([4, 4], |c| stroke(c, &[[2.0, 2.0], [2.0, 2.0]], 3.0, true)).iter().sum::<f64>(), 0.0);
        assert_eq!(dark([4, 4], |c| stroke(c, &[[2.0, 2.0]], 3.0, true)).iter().sum::<f64>(), 0.0);
    }
}
