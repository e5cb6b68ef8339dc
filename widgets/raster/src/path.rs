//! Outlines of what is filled.

/// A point \[px\], x right and y down.
pub type Point = [f32; 2];

/// A piece of an outline.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Segment {
    /// Starts a contour.
    Move(Point),
    /// Straight to the point.
    Line(Point),
    /// Cubic curve by its two control points.
    Cubic(Point, Point, Point),
}

impl Segment {
    /// With all its points where `at` takes them.
    pub fn map(self, at: impl Fn(Point) -> Point) -> Self {
        match self {
            Self::Move(p) => Self::Move(at(p)),
            Self::Line(p) => Self::Line(at(p)),
            Self::Cubic(c, d, p) => Self::Cubic(at(c), at(d), at(p)),
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let finite = |p: &Point| p.iter().all(|c| c.is_finite());
        match self {
            Self::Move(p) | Self::Line(p) => finite(p),
            Self::Cubic(c, d, p) => finite(c) && finite(d) && finite(p),
        }
    }
}

/// Contours; a fill closes each.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Path {
    segments: Vec<Segment>,
}

impl Path {
    /// All pieces in order.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Forgets them; keeps their memory.
    pub fn clear(&mut self) {
        self.segments.clear();
    }

    /// Goes on.
    pub fn push(&mut self, segment: Segment) {
        self.segments.push(segment);
    }

    /// A contour of straight lines.
    pub fn polygon(&mut self, points: impl IntoIterator<Item = Point>) {
        let mut start = true;
        self.segments.extend(
            points
                .into_iter()
                .map(|point| if core::mem::take(&mut start) { Segment::Move(point) } else { Segment::Line(point) }),
        );
    }

    /// A contour around a circle.
    pub fn circle(&mut self, centre: Point, radius: f32) {
        let quarters =
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]].map(|q: Point| q.map(|c| c * radius));
        self.push(Segment::Move([centre[0] + radius, centre[1]]));
        quarters.windows(2).for_each(|ends| self.arc(centre, ends[0], ends[1]));
    }

    /// Goes on from `centre + from` around the centre to `centre + to`, clockwise to the eye; both are as far from it.
    pub(crate) fn arc(&mut self, centre: Point, from: Point, to: Point) {
        let cos = dot(from, to) / dot(from, from);
        if cos < -1e-3 {
            self.arc(centre, from, ahead(from));
            return self.arc(centre, ahead(from), to);
        }
        // 4/3 tan(angle/4): a cubic is 1/3700 of the radius from a quarter of the circle.
        let [half_sin, half_cos] = [1.0 - cos, 1.0 + cos].map(|x| (0.5 * x.max(0.0)).sqrt());
        let reach = 4.0 / 3.0 * half_sin / (1.0 + half_cos);
        let [end, start] = [add(centre, to), add(centre, from)];
        self.push(Segment::Cubic(along(start, reach, ahead(from)), along(end, -reach, ahead(to)), end));
    }
}

/// A quarter turn clockwise to the eye, from right to down.
pub(crate) fn ahead([x, y]: Point) -> Point {
    [-y, x]
}

pub(crate) fn dot(a: Point, b: Point) -> f32 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn along(a: Point, t: f32, b: Point) -> Point {
    [a[0] + t * b[0], a[1] + t * b[1]]
}
