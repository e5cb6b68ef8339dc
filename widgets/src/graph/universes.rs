//! The particle filter on the same log: all universes laid over each other at its end.

use super::{layout::Layout, model::GraphModel, told};
use crate::{
    lap::map,
    robot::{Poses, Robots},
    scene::{LINE, Rect, Role, Scene, Shading, joined, plain},
    told::metres,
    words::{common, graph as words},
};

pub fn draw(scene: &mut Scene, model: &GraphModel, layout: &Layout) {
    let lap = model.graph().universes();
    let (course, m) = (model.setup().lap.course, lap.particles().len());
    let title = common::UniverseCount { m: &m }.say();
    let done = model.universes();
    let rest = match done {
        Some(_) => words::same_log().to_string(),
        None => words::UniversesStep { step: &lap.step_now(), last: &lap.step_count() }.say(),
    };
    scene.heading_fit(&layout.universes_header, (&title, Role::Ink), &[rest]);
    let area = centred(&layout.universes);
    let plane = map::plane(area, course);
    scene.raster(area, map::shares(lap, lap.weights(), course), Shading::Share);
    scene.lines(joined(0..m, |slot| plane.path(&lap.path(slot), 1.0)), 1.0, Role::Path);
    for particle in lap.particles() {
        scene.rimmed_robot(&plane, &particle.world_from_robot, 6.0, Role::Path);
    }
    scene.frame(area, 1.0, Role::Frame);
    let bytes = told::kilobytes(model.graph().build().bytes());
    let [first, second] =
        [0.0, 1.0].map(|k| Rect { y: layout.universes_told.y + k * LINE, h: LINE, ..layout.universes_told });
    let Some(report) = done else { return scene.text(first, plain(11.5, Role::Ink), words::driving()) };
    scene.text(first, plain(11.5, Role::Ink), &words::BestOff { rms: &metres(report.rms_best) }.say());
    let (maps, graph) = (&told::kilobytes(report.map_bytes_unique), &bytes);
    let bytes = [words::Bytes { m: &m, maps, graph }.say(), words::BytesShort { maps, graph }.say()];
    scene.fit(second, plain(11.5, Role::Muted), &bytes);
}

/// As much of the area as has the maps' shape.
fn centred(area: &Rect) -> Rect {
    let w = (area.h * map::ASPECT).min(area.w);
    Rect { x: area.x, w, ..*area }
}
