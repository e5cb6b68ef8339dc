//! What marks mean: samples of them with their names, in as many lines as it takes.

use super::{Cells, GHOST, Letters, Point, Rect, Role, Scene, Shading, plain};

/// Height of a line of text \[css px\].
pub const LINE: f64 = 18.0;

/// Height of a sample \[css px\].
const SAMPLE: f64 = 12.0;

/// Names.
const NAME: Letters = plain(11.5, Role::Muted);

/// Between a sample and its name, and between a name and the next sample \[css px\].
const APART: f64 = 5.0;
const GAP: f64 = 12.0;

type Draw<'a> = Box<dyn Fn(&mut Scene, &Rect) + 'a>;

/// How a mark looks that a legend names.
pub struct Sample<'a> {
    /// Width of the place that it takes \[css px\].
    pub width: f64,
    draw: Draw<'a>,
}

impl<'a> Sample<'a> {
    /// What is drawn in a place.
    pub fn new(draw: impl Fn(&mut Scene, &Rect) + 'a) -> Self {
        Self { width: 18.0, draw: Box::new(draw) }
    }

    /// What is drawn about a point.
    pub fn at(draw: impl Fn(&mut Scene, Point) + 'a) -> Self {
        Self::new(move |scene, place| draw(scene, place.centre()))
    }

    /// Draws it in a place.
    pub fn draw(&self, scene: &mut Scene, place: &Rect) {
        (self.draw)(scene, place);
    }

    /// The same in a place of this width \[css px\].
    pub fn wide(self, width: f64) -> Self {
        Self { width, ..self }
    }

    /// A line of this kind.
    pub fn line(role: Role, width: f64, dash: Option<[f64; 2]>) -> Self {
        Self::new(move |scene, place| {
            let y = place.centre()[1];
            scene.strokes(vec![vec![[place.x, y], [place.right(), y]]], width, dash, role);
        })
    }

    /// A curve of a run that is pinned.
    pub fn pinned() -> Self {
        Self::line(GHOST, 1.75, None)
    }

    /// Cells in a row, in a frame.
    pub fn cells(shades: Vec<u8>, shading: Shading) -> Self {
        Self::new(move |scene, place| {
            scene.raster(*place, Cells::row(&shades), shading);
            scene.frame(*place, 1.0, Role::Weight(0));
        })
    }

    /// A cell of a map.
    pub fn cell(shade: u8) -> Self {
        Self::cells(vec![shade], Shading::Map)
    }

    /// A disc.
    pub fn dot(role: Role, radius: f64) -> Self {
        Self::at(move |scene, centre| scene.disc(centre, radius, role))
    }
}

/// Draws samples with their names from the upper left of an area on; returns the lower edge of the last line \[css px\].
pub fn legend<'a>(
    scene: &mut Scene,
    area: &Rect,
    items: impl IntoIterator<Item = (Sample<'a>, impl AsRef<str>)>,
) -> f64 {
    let place = |at, (sample, name): (Sample<'a>, _)| put(scene, area, at, &sample, AsRef::as_ref(&name));
    items.into_iter().fold([area.x, area.y], place)[1] + LINE
}

/// Draws one of them at a place, or where the next line begins; returns the place of the next.
#[inline(never)]
fn put(scene: &mut Scene, area: &Rect, [mut x, mut y]: Point, sample: &Sample<'_>, name: &str) -> Point {
    let words = NAME.width(name) + 0.01;
    if x > area.x && x + sample.width + APART + words > area.right() {
        (x, y) = (area.x, y + LINE);
    }
    let place = Rect::new(x, y + 0.5 * (LINE - SAMPLE), sample.width, SAMPLE);
    sample.draw(scene, &place);
    let place = Rect::new(place.right() + APART, y, words, LINE);
    scene.text(place, NAME, name);
    [place.right() + GAP, y]
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
