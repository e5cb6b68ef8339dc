//! Clipping lines to a rectangle, so that what leaves a view is cut at its edge.

use super::{Point, Rect};

/// A polyline without the points nearer than `least` \[css px\] to the one before; its end stays.
pub fn thinned(points: &mut dyn Iterator<Item = Point>, least: f64) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    let mut left_out = None;
    for point in points {
        let far = kept.last().is_none_or(|last| {
            let [dx, dy] = [point[0] - last[0], point[1] - last[1]];
            dx * dx + dy * dy >= least * least
        });
        left_out = (!far).then_some(point);
        kept.extend(far.then_some(point));
    }
    kept.extend(left_out);
    kept
}

/// The lines of several things, one after the other. Not by `flat_map`: what that compiles to for each kind of thing takes a kilobyte.
pub fn joined<T>(things: impl Iterator<Item = T>, mut lines: impl FnMut(T) -> Vec<Vec<Point>>) -> Vec<Vec<Point>> {
    let mut all = Vec::new();
    things.for_each(|thing| all.append(&mut lines(thing)));
    all
}

/// The parts of a polyline inside a rectangle.
pub fn clip_polyline(points: &[Point], area: &Rect) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    let mut open = false; // does the last part end at the start of the next segment?
    for pair in points.windows(2) {
        let Some((enter, leave)) = clip_segment(pair[0], pair[1], area) else {
            open = false;
            continue;
        };
        match parts.last_mut() {
            Some(part) if open => part.push(leave),
            _ => parts.push(vec![enter, leave]),
        }
        open = leave == pair[1];
    }
    parts
}

/// Liang and Barsky: the parameters at which the segment enters and leaves the four half-planes.
fn clip_segment(a: Point, b: Point, area: &Rect) -> Option<(Point, Point)> {
    if !a.iter().chain(&b).all(|x| x.is_finite()) {
        return None;
    }
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (axis, low, high) in [(0, area.x, area.right()), (1, area.y, area.bottom())] {
        let along = b[axis] - a[axis];
        if along == 0.0 {
            if a[axis] < low || high < a[axis] {
                return None;
            }
            continue;
        }
        let (t0, t1) = ((low - a[axis]) / along, (high - a[axis]) / along);
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    let at = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    let end = |t: f64, exact: Point, at_end: f64| if t == at_end { exact } else { at(t) };
    (enter <= leave).then(|| (end(enter, a, 0.0), end(leave, b, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Rect = Rect::new(0.0, 0.0, 10.0, 10.0);

    #[test]
    fn a_thinned_line_keeps_its_ends_and_what_is_apart() {
        let line = [0.0, 0.4, 0.8, 1.2, 2.9, 3.0].map(|x| [x, 0.0]);
        assert_eq!(thinned(&mut line.into_iter(), 1.0), [0.0, 1.2, 2.9, 3.0].map(|x| [x, 0.0]));
        assert_eq!(thinned(&mut line[..2].iter().copied(), 1.0), line[..2]);
        assert_eq!(thinned(&mut core::iter::empty(), 1.0), [[0.0; 2]; 0]);
    }

    #[test]
    fn a_line_inside_stays_as_it_is() {
        let line = [[1.0, 1.0], [2.0, 5.0], [9.0, 9.0]];
        assert_eq!(clip_polyline(&line, &AREA), vec![line.to_vec()]);
    }

    #[test]
    fn a_line_that_leaves_and_returns_becomes_two() {
        let line = [[5.0, 5.0], [15.0, 5.0], [15.0, 8.0], [5.0, 8.0]];
        assert_eq!(clip_polyline(&line, &AREA), vec![vec![[5.0, 5.0], [10.0, 5.0]], vec![[10.0, 8.0], [5.0, 8.0]]]);
    }

    #[test]
    fn a_line_outside_vanishes_and_one_across_is_cut_at_both_ends() {
        assert!(clip_polyline(&[[-5.0, -1.0], [20.0, -1.0]], &AREA).is_empty());
        assert_eq!(clip_polyline(&[[-5.0, 5.0], [20.0, 5.0]], &AREA), vec![vec![[0.0, 5.0], [10.0, 5.0]]]);
    }

    #[test]
    fn positions_that_are_no_numbers_draw_nothing() {
        assert!(clip_polyline(&[[f64::NAN, 5.0], [5.0, 5.0]], &AREA).is_empty());
        assert!(clip_polyline(&[[f64::INFINITY, 5.0], [5.0, 5.0]], &AREA).is_empty());
    }
}
