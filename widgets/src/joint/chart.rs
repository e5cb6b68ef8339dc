//! N_eff of both filters over the landmarks, on a logarithmic axis: measured as points, and as a line what it is to be.

use super::{guess::guess, layout::Layout, model::JointModel};
use crate::{
    decimal::{fixed, write},
    ghost::curve,
    scene::{Chart, Handle, LINE, Point, Rect, Role, Sample, Scene, legend, plain, strong},
    words::{common, joint},
};
use fastslam::ops;
use fastslam_lab::experiment::joint::{COMPUTED, MOST, SAMPLED};

/// What a reader moves along the axis.
pub const LANDMARKS: &str = "landmarks";

/// Radius of a measured point \[css px\].
const POINT: f64 = 2.5;

/// Share of the chart's height of a number of particles, of so many.
fn share(ess: f64, particles: u32) -> f64 {
    ops::ln(ess) / ops::ln(f64::from(particles.max(2)))
}

/// The chart in a layout.
pub fn place(layout: &Layout) -> Chart {
    Chart { area: layout.chart, last: MOST }
}

/// Draws all of it.
pub fn chart(scene: &mut Scene, model: &JointModel, layout: &Layout, roles: [Role; 2]) {
    let (chart, m) = (place(layout), model.particles());
    names(scene, model, layout, roles);
    ticks(scene, layout, m);
    chart.edges(scene);
    let at = |ess: f64| share(ess, m);
    for filter in [SAMPLED, COMPUTED].into_iter().filter(|filter| !model.hides(*filter)) {
        let pinned = curve(model.pinned(), filter).iter().map(|ess| at(ess.max(1.0)));
        chart.ghost(scene, pinned);
    }
    let shown = || [SAMPLED, COMPUTED].into_iter().zip(roles).filter(|(filter, _)| !model.hides(*filter));
    for (filter, role) in shown() {
        let line = line(&chart, &(0..=MOST).map(|n| at(model.predicted(filter, n))).collect::<Vec<_>>());
        scene.line(&line, 1.75, role);
    }
    // Of now, through both.
    let n = model.landmarks();
    let x = chart.x(n);
    scene.line(&[[x, chart.area.y], [x, chart.area.bottom() + 5.0]], 1.5, Role::Accent);
    for (filter, role) in shown() {
        let found = model.ess(filter);
        let centres: Vec<Point> = (0..).zip(&found).map(|(n, ess)| [chart.x(n), chart.y(at(*ess))]).collect();
        let here = centres.get(n as usize).copied();
        scene.discs(centres, POINT, role);
        scene.discs(here.into_iter().collect(), 2.0 * POINT, role);
    }
    let grip = [x, chart.area.bottom() + 5.0];
    scene.disc(grip, 5.0, Role::Accent);
    scene.handles.push(Handle::of(
        &[LANDMARKS],
        joint::landmarks(),
        grip,
        n.into(),
        common::Of { n: &n, all: &MOST }.say(),
    ));
    guess(scene, model, &chart);
}

/// A line through shares of the height, as far as it is above the lower edge.
fn line(chart: &Chart, shares: &[f64]) -> Vec<Point> {
    let above = shares.iter().take_while(|share| **share >= 0.0).count();
    let mut line = chart.curve((0..).zip(shares.iter().copied()).take(above));
    if let Some(&[last, next]) =
        above.checked_sub(1).and_then(|last| shares.get(last..last + 2)).and_then(|two| two.first_chunk())
    {
        let part = last / (last - next);
        let [a, b] = [above - 1, above].map(|n| chart.x(n as u32));
        line.push([a + part * (b - a), chart.y(0.0)]);
    }
    line
}

fn names(scene: &mut Scene, model: &JointModel, layout: &Layout, roles: [Role; 2]) {
    let area = &layout.legend;
    let first = Rect { h: LINE, ..*area };
    let end = scene.n_eff(&first, strong(12.5, Role::Ink)) + 6.0;
    let (rest, letters) = (joint::over_landmarks(), plain(12.0, Role::Muted));
    let words = letters.width(rest);
    scene.text(Rect::new(end, area.y, (area.right() - end).max(0.0), LINE), letters, rest);
    let samples = [joint::sampled_dot(), joint::computed_dot()].into_iter().zip(roles);
    let mut items: Vec<_> =
        samples.map(|(name, role)| (Sample::dot(role, POINT).wide(8.0), name.to_string())).collect();
    let rho = if model.hides(SAMPLED) { "?".into() } else { fixed(model.filters().log().rho(), 2) };
    let narrow = area.h > LINE;
    let line = if narrow { joint::LineShort { rho: &rho }.say() } else { joint::Line { rho: &rho }.say() };
    items.push((Sample::line(roles[0], 1.75, None), line));
    if !model.pinned().is_empty() {
        items.push((Sample::pinned(), common::pinned_mark().into()));
    }
    let taken = end + words + 16.0;
    let below = Rect::new(area.x, area.y + LINE, area.w, LINE);
    let beside = Rect::new(taken, area.y, area.right() - taken, LINE);
    legend(scene, if narrow { &below } else { &beside }, items);
}

fn ticks(scene: &mut Scene, layout: &Layout, m: u32) {
    let (chart, scale) = (place(layout), layout.scale);
    let tens = core::iter::successors(Some(1_u32), |ten| ten.checked_mul(10)).take_while(|ten| *ten < m);
    let top = Some(m);
    // A power of ten right below the top would be written over it.
    let values = tens.filter(|ten| share(f64::from(*ten), m) < 0.86).chain(top);
    for value in values {
        let y = chart.y(if value == m { 1.0 } else { share(f64::from(value), m) });
        chart.rule(scene, y);
        let area = Rect::new(scale.x, y - 7.0, scale.w - 6.0, 14.0);
        scene.text(area, plain(11.0, Role::Muted).end(), &write(value.into()));
    }
    for n in [0, 6, 12, 18, 24] {
        let area = Rect::new(chart.x(n) - 12.0, layout.axis.y + 12.0, 24.0, 14.0);
        scene.text(area, plain(11.0, Role::Muted).middle(), &n.to_string());
    }
}
