//! Marks and lines of text that several figures have.

use crate::{
    font::{self, Weight},
    scene::{Anchor, Mark, Point, Rect, Role, Scene, clip_polyline, closed, diamond, ellipse, text},
};

/// A diamond, filled.
pub fn filled_diamond(at: Point, r: f64, role: Role) -> Mark {
    Mark::Polygons { polygons: vec![diamond(at, r)], role }
}

/// Around what can be moved.
pub fn ring(centre: Point, radius: f64) -> Mark {
    Mark::Lines { lines: vec![circle(centre, radius)], width: 2.0, dash: None, role: Role::Accent }
}

/// The part of it that is in an area.
pub fn ring_within(area: &Rect, centre: Point, radius: f64) -> Mark {
    let lines = clip_polyline(&circle(centre, radius), area);
    Mark::Lines { lines, width: 2.0, dash: None, role: Role::Accent }
}

fn circle(centre: Point, radius: f64) -> Vec<Point> {
    closed(ellipse(centre, [[1.0, 0.0], [0.0, 1.0]], radius))
}

/// A triangle that points down at its place.
pub fn pointer(at: Point, r: f64) -> Mark {
    Mark::Polygons { polygons: vec![triangle(at, r)], role: Role::Accent }
}

/// The outline of one, for what is still to be placed.
pub fn empty_pointer(at: Point, r: f64) -> Mark {
    Mark::Lines { lines: vec![closed(triangle(at, r))], width: 2.0, dash: None, role: Role::Accent }
}

fn triangle([x, y]: Point, r: f64) -> Vec<Point> {
    vec![[x, y], [x - r, y - 1.7 * r], [x + r, y - 1.7 * r]]
}

/// The first of some wordings that fits, else the last.
pub fn line<const N: usize>(
    scene: &mut Scene,
    area: &Rect,
    size: f64,
    weight: Weight,
    role: Role,
    wordings: [String; N],
) {
    let fits = |words: &&String| font::measure(words, size, weight) <= area.w;
    let words = wordings.iter().find(fits).or(wordings.last()).cloned().unwrap_or_default();
    scene.marks.push(text(*area, Anchor::Start, size, weight, role, words));
}

/// Words beside a point on a plate: at the first place that is free and in the area for one of the wordings. Where there is none, they are
/// left out.
pub fn label(scene: &mut Scene, taken: &mut Vec<Rect>, area: &Rect, at: Point, wordings: &[&str], places: &[Place]) {
    let [x, y] = at;
    let plate = |words: &str, place: &Place| {
        let (w, h) = (font::measure(words, SIZE, Weight::SemiBold) + 4.0, 14.0);
        match *place {
            Place::Right(away) => Rect::new(x + away, y - 0.5 * h, w, h),
            Place::Left(away) => Rect::new(x - away - w, y - 0.5 * h, w, h),
            Place::Above(away) => Rect::new(x - 0.5 * w, y - away - h, w, h),
            Place::Below(away) => Rect::new(x - 0.5 * w, y + away, w, h),
        }
    };
    let free =
        |(_, plate): &(&str, Rect)| area.inset(2.0).encloses(plate) && !taken.iter().any(|other| other.overlaps(plate));
    let mut plates = places.iter().flat_map(|place| wordings.iter().map(move |words| (*words, plate(words, place))));
    if let Some((words, plate)) = plates.find(free) {
        scene.marks.push(Mark::Fill { area: plate, role: Role::Paper });
        scene.marks.push(text(plate, Anchor::Middle, SIZE, Weight::SemiBold, Role::Ink, words));
        taken.push(plate);
    }
}

/// Font size of words in a panel \[css px\].
const SIZE: f64 = 11.0;

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
