//! What marks mean: samples of them with their names, in as many lines as it takes.

use super::{Anchor, Cells, Mark, Point, Rect, Role, Scene, Shading, robot, text};
use crate::font::{self, Weight};

/// Height of a line of text \[css px\].
pub const LINE: f64 = 18.0;

/// Height of a sample \[css px\].
const SAMPLE: f64 = 12.0;

/// Font size, between a sample and its name, and between a name and the next sample \[css px\].
const SIZE: f64 = 11.5;
const APART: f64 = 5.0;
const GAP: f64 = 12.0;

type Draw<'a> = Box<dyn Fn(&Rect) -> Vec<Mark> + 'a>;

/// How a mark looks that a legend names.
pub struct Sample<'a> {
    width: f64,
    draw: Draw<'a>,
}

impl<'a> Sample<'a> {
    /// Marks in a place.
    pub fn new(draw: impl Fn(&Rect) -> Vec<Mark> + 'a) -> Self {
        Self { width: 18.0, draw: Box::new(draw) }
    }

    /// A mark about a point.
    pub fn at(draw: impl Fn(Point) -> Mark + 'a) -> Self {
        Self::new(move |place| vec![draw(place.centre())])
    }

    /// Width of the place that it takes \[css px\].
    pub fn width(&self) -> f64 {
        self.width
    }

    /// It, in a place.
    pub fn marks(&self, place: &Rect) -> Vec<Mark> {
        (self.draw)(place)
    }

    /// The same in a place of this width \[css px\].
    pub fn wide(self, width: f64) -> Self {
        Self { width, ..self }
    }

    /// A line of this kind.
    pub fn line(role: Role, width: f64, dash: Option<[f64; 2]>) -> Self {
        Self::new(move |place| {
            let y = place.centre()[1];
            vec![Mark::Lines { lines: vec![vec![[place.x, y], [place.right(), y]]], width, dash, role }]
        })
    }

    /// A cell of a map.
    pub fn cell(shade: u8) -> Self {
        Self::new(move |place| {
            let cells = Cells { columns: 1, shades: vec![shade] };
            vec![
                Mark::Raster { area: *place, cells, shading: Shading::Map },
                Mark::Frame { area: *place, width: 1.0, role: Role::Weight(0) },
            ]
        })
    }

    /// A robot that looks to the right.
    pub fn robot(role: Role) -> Self {
        Self::at(move |[x, y]| Mark::Polygons { polygons: vec![robot([x - 1.0, y], 0.0, 7.0)], role })
    }

    /// A disc.
    pub fn dot(role: Role, radius: f64) -> Self {
        Self::at(move |centre| Mark::Discs { centres: vec![centre], radius, role })
    }
}

/// Draws samples with their names from the upper left of an area on; returns the lower edge of the last line \[css px\].
pub fn legend<'a>(
    scene: &mut Scene,
    area: &Rect,
    items: impl IntoIterator<Item = (Sample<'a>, impl AsRef<str>)>,
) -> f64 {
    let [mut x, mut y] = [area.x, area.y];
    for (Sample { width, draw }, name) in items {
        let name = name.as_ref();
        let words = font::measure(name, SIZE, Weight::Regular) + 0.01;
        if x > area.x && x + width + APART + words > area.right() {
            (x, y) = (area.x, y + LINE);
        }
        let place = Rect::new(x, y + 0.5 * (LINE - SAMPLE), width, SAMPLE);
        scene.marks.extend(draw(&place));
        let place = Rect::new(place.right() + APART, y, words, LINE);
        scene.marks.push(text(place, Anchor::Start, SIZE, Weight::Regular, Role::Muted, name));
        x = place.right() + GAP;
    }
    y + LINE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_legend_goes_on_in_another_line_where_its_area_ends() {
        let items = || ["one", "two", "three"].map(|name| (Sample::dot(Role::Path, 2.0), name));
        let lines = |width: f64| {
            let mut scene = Scene::new(width, 90.0, String::new());
            let bottom = legend(&mut scene, &Rect::new(10.0, 5.0, width, 80.0), items());
            assert_eq!(scene.marks.len(), 6, "a sample and a name each");
            (bottom - 5.0) / LINE
        };
        assert_eq!([lines(300.0), lines(130.0), lines(1.0)], [1.0, 2.0, 3.0]);
    }
}
