//! Marks and lines of text that several figures have.

use crate::scene::{Letters, Point, Rect, Role, Scene, clip_polyline, closed, diamond, ellipse, strong};

impl Scene {
    /// A diamond, filled.
    pub fn filled_diamond(&mut self, at: Point, r: f64, role: Role) {
        self.polygon(diamond(at, r), role);
    }

    /// Around what can be moved.
    pub fn ring(&mut self, centre: Point, radius: f64) {
        self.line(&circle(centre, radius), 2.0, Role::Accent);
    }

    /// The part of it that is in an area.
    pub fn ring_within(&mut self, area: &Rect, centre: Point, radius: f64) {
        self.lines(clip_polyline(&circle(centre, radius), area), 2.0, Role::Accent);
    }

    /// A triangle that points down at its place.
    pub fn pointer(&mut self, at: Point, r: f64) {
        self.polygon(triangle(at, r), Role::Accent);
    }

    /// The outline of one, for what is still to be placed.
    pub fn empty_pointer(&mut self, at: Point, r: f64) {
        self.line(&closed(triangle(at, r)), 2.0, Role::Accent);
    }

    /// Words beside a point on a plate: at the first place that is free and in the area for one of the texts, which then is taken. Where
    /// there is none, they are left out.
    pub fn label<T: AsRef<str>>(
        &mut self,
        taken: &mut Vec<Rect>,
        area: &Rect,
        at: Point,
        texts: &[T],
        places: &[Place],
    ) {
        let texts: Vec<&str> = texts.iter().map(AsRef::as_ref).collect();
        if let Some((words, plate)) = room(taken, area, at, &texts, places) {
            self.fill(plate, Role::Paper);
            self.text(plate, NAME.middle(), words);
            taken.push(plate);
        }
    }
}

fn circle(centre: Point, radius: f64) -> Vec<Point> {
    closed(ellipse(centre, [[1.0, 0.0], [0.0, 1.0]], radius))
}

fn triangle([x, y]: Point, r: f64) -> Vec<Point> {
    vec![[x, y], [x - r, y - 1.7 * r], [x + r, y - 1.7 * r]]
}

/// Where words have room on a plate beside a point: at the first place that is free and in the area for one of the texts.
fn room<'a>(
    taken: &[Rect],
    area: &Rect,
    [x, y]: Point,
    texts: &[&'a str],
    places: &[Place],
) -> Option<(&'a str, Rect)> {
    let plate = |words: &str, place: &Place| {
        let (w, h) = (NAME.width(words) + 4.0, 14.0);
        match *place {
            Place::Right(away) => Rect::new(x + away, y - 0.5 * h, w, h),
            Place::Left(away) => Rect::new(x - away - w, y - 0.5 * h, w, h),
            Place::Above(away) => Rect::new(x - 0.5 * w, y - away - h, w, h),
            Place::Below(away) => Rect::new(x - 0.5 * w, y + away, w, h),
        }
    };
    let free =
        |(_, plate): &(&str, Rect)| area.inset(2.0).encloses(plate) && !taken.iter().any(|other| other.overlaps(plate));
    let mut plates = places.iter().flat_map(|place| texts.iter().map(move |words| (*words, plate(words, place))));
    plates.find(free)
}

/// Words in a panel.
const NAME: Letters = strong(11.0, Role::Ink);

/// Where words stand, and how far from their point \[css px\].
#[derive(Clone, Copy)]
pub enum Place {
    /// To the right of it.
    Right(f64),
    /// To the left.
    Left(f64),
    /// Above it.
    Above(f64),
    /// Below it.
    Below(f64),
}
