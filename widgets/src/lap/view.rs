//! What is to be seen of the lap: one universe large, all universes small, and N_eff over the steps.

use super::{
    drive,
    layout::{ESS, Layout, MAP, MOSAIC},
    map,
    model::LapModel,
    mosaic::{mosaic, notes},
    overlay,
    paths::{RAW, TRUTH, branches, odometry, true_path, true_walls},
    verb::Verb,
};
use crate::decimal::fixed;
use crate::{
    action::Own,
    model::{FigureError, Model},
    panels::Panels,
    robot::{Poses, Robots},
    scene::{
        Chart, FREE, LINE, OCCUPIED, Plane, Point, Rect, Role, Sample, Scene, Shading, UNKNOWN, legend, plain, strong,
    },
    view::{Layout as _, View},
    words::{common, lap},
};
use fastslam::resampling::ResamplePolicy;
use std::collections::BTreeSet;

/// The paths of universes that are not shown large.
const OTHERS: Role = Role::Level(110);

/// Figure w17.1, as it is seen.
#[derive(Default)]
pub struct LapView;

impl View for LapView {
    type Model = LapModel;
    type Layout = Layout;

    fn gist(_model: &LapModel, layout: &Layout, width: f64) -> Rect {
        if layout.panels.has(MAP) { layout.large } else { Rect::new(0.0, 0.0, width, layout.height) }
    }

    fn draw(&self, model: &LapModel, layout: &Layout, scene: &mut Scene) {
        if layout.panels.has(MAP) {
            if model.overlaid() {
                overlay::overlay(scene, model, layout);
                overlay::names(scene, model, &layout.legend);
            } else {
                large(scene, model, layout);
                names(scene, model, &layout.legend);
            }
        }
        if layout.panels.has(MOSAIC) {
            mosaic(scene, model, layout);
            notes(scene, model, &layout.notes);
        }
        if layout.panels.has(ESS) {
            meter(scene, model, &layout.meter);
        }
    }

    fn pick(&self, model: &mut LapModel, target: u32) {
        model.pick(target);
    }

    fn own(
        &mut self,
        model: &mut LapModel,
        own: &Own,
        (width, scale): (f64, f64),
        panels: &Panels,
    ) -> Result<(), FigureError> {
        match Verb::of(own) {
            Some(Verb::Take(tool)) => model.take(tool),
            Some(Verb::Press(key, steps)) if steps.iter().all(|steps| steps.is_finite()) => {
                return model.press(key, steps);
            }
            Some(Verb::Stroke(line)) => {
                let plane = map::plane(Layout::of(width, panels).large, model.setup().course);
                let (points, _) = line.as_chunks();
                let points = points.iter().map(|point: &Point| point.map(|c| c * scale));
                let points = points.filter(|point| point.iter().all(|c| c.is_finite()));
                return model.stroke(&points.map(|point| plane.world(point)).collect::<Vec<_>>());
            }
            _ => (),
        }
        Ok(())
    }
}

fn large(scene: &mut Scene, model: &LapModel, layout: &Layout) {
    let (lap, slot) = (model.lap(), model.selected());
    let (weights, best) = (lap.weights(), slot == model.report().best);
    let weight = &fixed(weights[slot as usize], 3);
    let weight = match weights.iter().all(|weight| *weight == weights[0]) {
        true if best => lap::best_of_all().into(),
        true => lap::equal_weight().into(),
        false if best => lap::BestWeight { weight }.say(),
        false => lap::Weight { weight }.say(),
    };
    let name = lap::UniverseSlot { slot: &slot }.say();
    scene.heading(&layout.large_header, (&name, Role::Ink), &weight);

    let course = model.setup().course;
    let plane = map::plane(layout.large, course);
    let particle = &lap.particles()[slot as usize];
    scene.raster(plane.area, map::shades(&particle.map, course), Shading::Map);
    true_walls(scene, model, &plane);
    let hits = map::hits(&particle.map, course).into_iter().map(|place| plane.point(place));
    scene.cloud(hits, &plane.area.inset(2.0), (0.035 * plane.scale).max(1.0), Role::Hit);
    others(scene, model, &plane);
    odometry(scene, model, &plane);
    scene.rimmed(plane.path(&lap.path(slot as usize), 0.5), 2.25, None, Role::Path);
    true_path(scene, model, &plane);
    scene.rimmed_robot(&plane, &particle.world_from_robot, 9.0, Role::Path);
    drive::draw(scene, model, &plane);
    scene.scale_bar(&plane, 1.0, f64::INFINITY);
    scene.frame(plane.area, 1.0, Role::Frame);
}

/// The paths of all other universes, and for the one step at which they died out, those that did: what they have in common once.
fn others(scene: &mut Scene, model: &LapModel, plane: &Plane) {
    let mut drawn = BTreeSet::new();
    let living = branches(&mut drawn, plane, &mut model.lap().particles().iter().map(|particle| &particle.path));
    scene.lines(branches(&mut drawn, plane, &mut model.dead().take(1).flatten()), 1.25, Role::Extinct);
    scene.lines(living, 1.0, OTHERS);
}

fn names(scene: &mut Scene, model: &LapModel, area: &Rect) {
    let hit = |scene: &mut Scene, place: &Rect| {
        Sample::cell(OCCUPIED).draw(scene, place);
        scene.disc(place.centre(), 1.5, Role::Hit);
    };
    let mut items = vec![
        (Sample::cell(OCCUPIED), common::wall()),
        (Sample::cell(FREE), common::free()),
        (Sample::cell(UNKNOWN), common::unknown()),
        (Sample::new(hit), lap::hits()),
        (Sample::line(Role::Path, 2.25, None), lap::its_path()),
    ];
    if model.lap().particles().len() > 1 {
        items.push((Sample::line(OTHERS, 1.0, None), lap::other_paths()));
    }
    if !model.extinct().is_empty() {
        items.push((Sample::line(Role::Extinct, 1.25, None), lap::dead_paths()));
    }
    if model.shows_truth() {
        items.push((Sample::line(Role::Truth, 1.5, Some(TRUTH)), common::truth()));
    }
    if model.shows_raw() {
        items.push((Sample::line(Role::Raw, 2.0, Some(RAW)), common::raw_odometry_line()));
    }
    legend(scene, area, items);
}

/// N_eff over the steps, with the threshold that calls for resampling and the steps that did.
fn meter(scene: &mut Scene, model: &LapModel, area: &Rect) {
    let count = model.lap().particles().len();
    let m = count as f64;
    let label_width = 66.0;
    let chart = Rect::new(area.x + label_width, area.y + 4.0, area.w - label_width - 3.0, area.h - 8.0);
    let pinned = model.pinned_ess();
    let rows = if pinned.is_empty() { 2.0 } else { 3.0 };
    let line = |k: f64| Rect::new(area.x, chart.y + 0.5 * chart.h + 17.0 * (k - 0.5 * rows), label_width - 6.0, 17.0);
    let end = scene.n_eff(&line(0.0), strong(12.5, Role::Ink));
    let value = Rect::new(end, line(0.0).y, label_width - 6.0 - (end - area.x), 17.0);
    scene.text(value, plain(12.5, Role::Ink).end(), &fixed(model.report().ess, 1));
    scene.text(line(1.0), plain(11.5, Role::Muted), &common::OfAll { all: &count }.say());
    if !pinned.is_empty() {
        legend(scene, &Rect { h: LINE, ..line(2.0) }, [(Sample::pinned().wide(12.0), common::pinned_mark())]);
    }

    let chart = Chart { area: chart, last: model.step_count() };
    scene.lines(vec![chart.level(0.0), chart.level(1.0)], 1.0, Role::Frame);
    if let ResamplePolicy::EssBelow(fraction) = model.setup().policy {
        scene.dash(&chart.level(fraction), 1.0, [3.0, 3.0], Role::Weight(0));
    }
    chart.ghost(scene, pinned.iter().copied());
    let history = model.history();
    let curve = chart.curve(history.iter().map(|r| (r.step, r.ess / m)));
    let resampled = history.iter().zip(&curve).filter(|(r, _)| r.ancestors.is_some()).map(|(_, at)| *at).collect();
    let now = curve[curve.len() - 1];
    scene.line(&curve, 1.25, Role::Muted);
    scene.discs(resampled, 2.0, Role::Copied);
    scene.disc(now, 3.0, Role::Ink);
}
