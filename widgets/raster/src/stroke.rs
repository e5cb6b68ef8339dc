//! The outline of a line of some width: a walk along the line and back, half the width to its left.
//!
//! Where the walk turns right, the corner is filled as the joint says. Where it turns left it goes by the line's own point: what it goes
//! around there is inside anyway. The ends are turns too, by half a circle.

use crate::path::{Path, Point, Segment, add, ahead, along, dot};

/// How a line is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stroke {
    /// \[px\]
    pub width: f32,
    /// At the ends, half a disc beyond them; else nothing.
    pub round_ends: bool,
    /// At the corners, a piece of a disc; else a tip where the corner is not too sharp.
    pub round_joints: bool,
    /// Lengths of dashes and gaps \[px\].
    pub dash: Option<[f32; 2]>,
}

/// Lines of more dashes than these are drawn whole.
const DASHES: f32 = 10_000.0;

/// A tip goes up to 4 times the width of the line, which is as far as 1 + cos of the turn is above this.
const SHARPEST: f32 = 2.0 / (4.0 * 4.0);

#[derive(Clone, Copy)]
enum Joint {
    Flat,
    Round,
    Tip,
}

impl Stroke {
    /// Adds the outline of a line through points.
    pub fn outline(&self, path: &mut Path, points: &[Point]) {
        match self.dash {
            Some(dash) => dashes(points, dash, |piece| self.whole(path, piece)),
            None => self.whole(path, points),
        }
    }

    fn whole(&self, path: &mut Path, points: &[Point]) {
        // Where each piece starts, and half the width to its left. Those without length have no left.
        let pieces: Vec<_> =
            points.windows(2).filter_map(|ends| Some((ends[0], self.left(ends[0], ends[1])?))).collect();
        let (Some(&(start, left)), Some(&(_, last)), Some(&end)) = (pieces.first(), pieces.last(), points.last())
        else {
            return;
        };
        let (joint, ends) = (
            if self.round_joints { Joint::Round } else { Joint::Tip },
            if self.round_ends { Joint::Round } else { Joint::Flat },
        );
        path.push(Segment::Move(add(start, left)));
        for pair in pieces.windows(2) {
            turn(path, pair[1].0, pair[0].1, pair[1].1, joint);
        }
        turn(path, end, last, last.map(|c| -c), ends);
        for pair in pieces.windows(2).rev() {
            let [before, after] = [pair[1].1, pair[0].1].map(|left| left.map(|c| -c));
            turn(path, pair[1].0, before, after, joint);
        }
        turn(path, start, left.map(|c| -c), left, ends);
    }

    /// Half the width to the left of the way from one point to another.
    fn left(&self, [x0, y0]: Point, [x1, y1]: Point) -> Option<Point> {
        let left = [y1 - y0, x0 - x1];
        let length = dot(left, left).sqrt();
        (length > 1e-4).then(|| left.map(|c| 0.5 * self.width / length * c))
    }
}

/// From the left side of one piece to that of the next.
fn turn(path: &mut Path, point: Point, from: Point, to: Point, joint: Joint) {
    let (right, square) = (dot(ahead(from), to), dot(from, from));
    let straight = square + dot(from, to);
    let outside = right >= 0.0 || straight <= 0.0;
    if matches!(joint, Joint::Tip) && outside && straight > SHARPEST * square {
        return path.push(Segment::Line(along(point, square / straight, add(from, to))));
    }
    path.push(Segment::Line(add(point, from)));
    if matches!(joint, Joint::Round) && outside {
        return path.arc(point, from, to);
    }
    if !outside {
        path.push(Segment::Line(point));
    }
    path.push(Segment::Line(add(point, to)));
}

/// The pieces of a line that are drawn: it starts with a dash.
fn dashes(points: &[Point], dash: [f32; 2], mut put: impl FnMut(&[Point])) {
    let length = |ends: &[Point]| {
        let way = along(ends[1], -1.0, ends[0]);
        dot(way, way).sqrt()
    };
    let whole: f32 = points.windows(2).map(length).sum();
    // False as well where one of them is no number.
    let countable = whole <= DASHES * (dash[0] + dash[1]);
    if !countable {
        return put(points);
    }
    let mut piece: Vec<Point> = points.first().copied().into_iter().collect();
    let (mut gap, mut rest) = (0, dash[0]);
    for ends in points.windows(2) {
        let (length, mut at) = (length(ends), 0.0);
        while rest < length - at {
            at += rest;
            piece.push(along(ends[0], at / length, along(ends[1], -1.0, ends[0])));
            if gap == 0 {
                put(&piece);
            }
            piece.drain(..piece.len() - 1);
            gap = 1 - gap;
            rest = dash[gap];
        }
        rest -= length - at;
        piece.push(ends[1]);
    }
    if gap == 0 {
        put(&piece);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Pixels, fill::Filler};
    use tiny_skia_path as oracle;

    const SIZE: [u32; 2] = [64, 48];

    fn filled(path: &Path) -> Vec<u8> {
        let mut pixels = Pixels::new(SIZE);
        Filler::default().fill(&mut pixels, path, [255; 4]);
        pixels.bytes().iter().step_by(4).copied().collect()
    }

    fn ours(points: &[Point], stroke: &Stroke) -> Vec<u8> {
        let mut path = Path::default();
        stroke.outline(&mut path, points);
        filled(&path)
    }

    /// What tiny-skia-path makes of it, its curves as cubics.
    fn theirs(points: &[Point], stroke: &Stroke) -> Vec<u8> {
        let mut line = oracle::PathBuilder::new();
        for (k, &[x, y]) in points.iter().enumerate() {
            if k == 0 { line.move_to(x, y) } else { line.line_to(x, y) }
        }
        let line = line.finish().unwrap();
        let dash = stroke.dash.and_then(|dash| oracle::StrokeDash::new(dash.to_vec(), 0.0));
        let line = dash.map_or(line.clone(), |dash| line.dash(&dash, 1.0).unwrap());
        let pen = oracle::Stroke {
            width: stroke.width,
            line_cap: if stroke.round_ends { oracle::LineCap::Round } else { oracle::LineCap::Butt },
            line_join: if stroke.round_joints { oracle::LineJoin::Round } else { oracle::LineJoin::Miter },
            ..oracle::Stroke::default()
        };
        let mut path = Path::default();
        let mut at = [0.0; 2];
        for segment in line.stroke(&pen, 1.0).unwrap().segments() {
            let point = |p: oracle::Point| [p.x, p.y];
            let segment = match segment {
                oracle::PathSegment::MoveTo(p) => Segment::Move(point(p)),
                oracle::PathSegment::LineTo(p) => Segment::Line(point(p)),
                oracle::PathSegment::QuadTo(c, p) => {
                    let thirds = |end: Point| along(along([0.0; 2], 2.0 / 3.0, point(c)), 1.0 / 3.0, end);
                    Segment::Cubic(thirds(at), thirds(point(p)), point(p))
                }
                oracle::PathSegment::CubicTo(c, d, p) => Segment::Cubic(point(c), point(d), point(p)),
                oracle::PathSegment::Close => continue,
            };
            let (Segment::Move(end) | Segment::Line(end) | Segment::Cubic(_, _, end)) = segment;
            at = end;
            path.push(segment);
        }
        filled(&path)
    }

    /// Numbers from 0 to 1.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 1_u32;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        }
    }

    #[test]
    fn strokes_are_those_of_tiny_skia_at_any_corner_end_and_dash() {
        let mut next = numbers();
        for k in 0..300 {
            let points: Vec<Point> = (0..2 + k % 5).map(|_| [next() * 80.0 - 8.0, next() * 60.0 - 6.0]).collect();
            let dash = (k % 3 == 0).then(|| [1.0 + 5.0 * next(), 1.0 + 5.0 * next()]);
            let stroke = Stroke { width: 0.5 + 8.0 * next(), round_ends: k % 2 == 0, round_joints: k % 4 < 2, dash };
            let (ours, theirs) = (ours(&points, &stroke), theirs(&points, &stroke));
            let apart = || ours.iter().zip(&theirs).map(|(a, b)| f64::from(a.abs_diff(*b)));
            let [far, sum] = [apart().fold(0.0, f64::max), apart().sum()];
            let ink: f64 = theirs.iter().map(|&a| f64::from(a)).sum();
            // Chords of an arc are up to a 16th of a pixel from it, and a fill looks along four lines of a pixel: one of them may miss.
            let (most, mean) = if stroke.round_ends || stroke.round_joints { (64.0, 0.02) } else { (1.0, 0.001) };
            assert!(far <= most && sum <= mean * ink, "{k} {points:?} {stroke:?}: {far} of 255, {sum} of {ink}");
        }
    }

    #[test]
    fn a_line_without_length_or_number_draws_nothing() {
        for points in [vec![], vec![[9.0, 9.0]], vec![[9.0, 9.0]; 3], vec![[f32::NAN, 9.0], [20.0, 9.0]]] {
            for dash in [None, Some([2.0, 3.0])] {
                let stroke = Stroke { width: 5.0, round_ends: true, round_joints: true, dash };
                assert!(ours(&points, &stroke).iter().all(|&share| share == 0), "{points:?}");
            }
        }
    }

    #[test]
    fn dashes_too_many_or_without_length_are_a_line() {
        let solid = Stroke { width: 2.0, round_ends: false, round_joints: false, dash: None };
        for (dash, end) in [([0.0, 0.0], 40.0), ([f32::NAN, 1.0], 40.0), ([1.0, 1.0], 1e30), ([1e-9, 1e-9], 40.0)] {
            let points = [[5.0, 5.0], [end, 5.0]];
            assert_eq!(ours(&points, &Stroke { dash: Some(dash), ..solid }), ours(&points, &solid), "{dash:?}");
        }
    }
}
