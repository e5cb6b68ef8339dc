//! One filter's part: its estimates of a landmark in all repeats, what they are worth, and the particles that are left.

use super::{
    layout::{PITCH, Panel, ROWS},
    model::JointModel,
    told::length,
};
use crate::{
    scene::{Letters, NINE_TENTHS, Plane, Point, Rect, Role, Scene, plain, strong},
    told::count,
    words::{common, joint},
};

/// Radius of an estimate, and of a particle \[css px\].
const ESTIMATE: f64 = 2.6;
const PARTICLE: f64 = 1.25;

/// What a number is.
const NAME: Letters = plain(11.5, Role::Muted);

/// A filter, as it is named and drawn.
pub struct Drawn {
    /// Its rank.
    pub filter: usize,
    /// Its name, and what it does in fewer and fewer words.
    pub name: &'static str,
    /// See [`Self::name`].
    pub what: [&'static str; 2],
    /// Colour of all that is of it.
    pub role: Role,
}

/// Draws all of one filter's part.
pub fn panel(scene: &mut Scene, model: &JointModel, panel: &Panel, drawn: &Drawn) {
    scene.heading_fit(&panel.header, (drawn.name, Role::Ink), &drawn.what);
    estimates(scene, model, panel, drawn);
    counters(scene, model, panel, drawn);
    particles(scene, model, panel, drawn);
}

/// Where the filter has the first landmark, once for each repeat, in what was known of it before.
fn estimates(scene: &mut Scene, model: &JointModel, panel: &Panel, drawn: &Drawn) {
    let (area, known) = (panel.view, &model.filters().log().known[0]);
    let (mean, covariance) = ([known.mean.x, known.mean.y], known.covariance.into());
    let reach = [0, 1].map(|axis| NINE_TENTHS * known.covariance[(axis, axis)].sqrt());
    let corner = |sign: f64| [0, 1].map(|axis| mean[axis] + sign * reach[axis]);
    let plane = Plane::around(area, [corner(-1.0), corner(1.0)], 8.0);
    scene.dashed(plane.region(mean, covariance, NINE_TENTHS), 1.5, [4.0, 3.0], Role::Feature);
    scene.cross(Rect::around(plane.point(mean), 5.0), 1.5, Role::Truth);
    let places = if model.hides(drawn.filter) { Vec::new() } else { model.estimates(drawn.filter) };
    scene.cloud(places.into_iter().map(|place| plane.point(place)), &area.inset(ESTIMATE), ESTIMATE, drawn.role);
    scene.frame(area, 1.0, Role::Frame);
    scene.scale_bar(&plane, 0.5, 60.0);
}

fn counters(scene: &mut Scene, model: &JointModel, panel: &Panel, drawn: &Drawn) {
    let m = model.particles();
    let shown = !model.hides(drawn.filter);
    let ess = model.population(drawn.filter).filter(|_| shown).map(|found| count(found.ess));
    let spread = Some(model.spread(drawn.filter)).filter(|x| shown && x.is_finite()).map(length);
    let [done, _] = model.repeats();
    let told = [
        (ess, [joint::EssOf { m: &m }.say(), joint::ess_short().into()]),
        (spread, [joint::SpreadOver { n: &done }.say(), joint::spread_short().into()]),
    ];
    for (area, (number, names)) in panel.counters.iter().zip(told) {
        let number = number.unwrap_or_else(|| if shown { "…" } else { "?" }.into());
        let size = if panel.counters[0].w < 100.0 { 17.0 } else { 23.0 };
        scene.text(Rect { h: 26.0, ..*area }, strong(size, Role::Ink), &number);
        let name = NAME.fitting(area.w - 6.0, &names).unwrap_or(&names[1]);
        scene.text(Rect::new(area.x, area.y + 26.0, area.w, 16.0), NAME, name);
    }
}

/// The particles, from the left on those that a resampling would continue.
fn particles(scene: &mut Scene, model: &JointModel, panel: &Panel, drawn: &Drawn) {
    let (area, m) = (panel.particles, model.particles() as usize);
    let columns = ((area.w / PITCH) as usize).min(m.div_ceil(ROWS));
    let all = (columns * ROWS).min(m);
    let found = model.population(drawn.filter).filter(|_| !model.hides(drawn.filter));
    let left = found.map_or(m, |found| found.left as usize);
    // One at least, as there is one at least.
    let alive = (all * left).div_ceil(m);
    let place = |k: usize| -> Point {
        [area.x + PITCH * ((k / ROWS) as f64 + 0.5), area.y + PITCH * ((k % ROWS) as f64 + 0.5)]
    };
    scene.discs((alive..all).map(place).collect(), PARTICLE, Role::Frame);
    scene.discs((0..alive).map(place).collect(), PARTICLE, drawn.role);
    let said = match found {
        Some(found) => {
            let left = &common::Of { n: &found.left, all: &m }.say();
            vec![joint::Left { left }.say(), joint::LeftShort { left }.say()]
        }
        None if !model.hides(drawn.filter) => vec![common::OfAll { all: &m }.say()],
        None => vec![joint::Left { left: &common::Of { n: &"?", all: &m }.say() }.say()],
    };
    scene.fit(panel.left, plain(12.0, Role::Ink), &said);
}
