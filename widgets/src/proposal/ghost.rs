//! What a pinned step drew, faint behind what this one draws: both clouds, the posterior's region, and the ratio.

use super::{gauge, model::ProposalModel};
use crate::{
    ghost::curve,
    scene::{GHOST, NINE_TENTHS, Plane, Point, Rect, Role, Scene, clip_polyline, joined},
};

/// Ranks of the curves: both clouds as x and y in turn \[m\], the Gaussian of 2.0 as its mean \[m\] and covariance \[m²\], the ratio,
/// and from then on the lines of the region's outline.
const GAUSSIAN: usize = 2;
const RATIO: usize = 3;
const OUTLINE: usize = 4;

/// Faintest: there are as many of them as of those of now.
const SAMPLES: Role = Role::Level(25);

fn points<'a>(numbers: &'a [f64], plane: &'a Plane) -> impl Iterator<Item = Point> + 'a {
    numbers.chunks_exact(2).map(|place| plane.point([place[0], place[1]]))
}

/// The samples of a panel, by its rank, and what they should be like.
pub fn panel(scene: &mut Scene, model: &ProposalModel, rank: usize, plane: &Plane, area: &Rect, radius: f64) {
    let pinned = model.pinned();
    scene.cloud(points(curve(pinned, rank), plane), &area.inset(radius), radius, SAMPLES);
    let outline = pinned.iter().skip(OUTLINE);
    let lines = joined(outline, |line| clip_polyline(&points(line, plane).collect::<Vec<_>>(), area));
    scene.lines(lines, 1.75, GHOST);
    if let (1, [x, y, xx, xy, yx, yy]) = (rank, curve(pinned, GAUSSIAN)) {
        scene.dashed(plane.region([*x, *y], [[*xx, *xy], [*yx, *yy]], NINE_TENTHS), 1.75, [5.0, 3.0], GHOST);
    }
}

/// The ratio on its scale, at this height \[css px\].
pub fn ratio(scene: &mut Scene, model: &ProposalModel, axis: &Rect, y: f64) {
    let centres = curve(model.pinned(), RATIO).iter().map(|ratio| [gauge::position(axis, *ratio), y]).collect();
    scene.discs(centres, 5.0, GHOST);
}
