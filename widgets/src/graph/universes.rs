//! The particle filter on the same log: all universes laid over each other at its end.

use super::{layout::Layout, model::GraphModel, told};
use crate::{
    font::Weight,
    lap::map,
    scene::{Anchor, LINE, Mark, Rect, Role, Scene, Shading, heading_if_fits, rimmed_robot, text},
    words::{common, graph as words},
};

pub fn draw(scene: &mut Scene, model: &GraphModel, layout: &Layout) {
    let lap = model.graph().universes();
    let (course, m) = (model.setup().lap.course, lap.particles().len());
    let title = common::UniverseCount { m: &m }.say();
    let done = model.universes();
    let rest = match done {
        Some(_) => words::same_log().to_string(),
        None => words::UniversesStep { step: &lap.report().step, last: &lap.step_count() }.say(),
    };
    heading_if_fits(scene, &layout.universes_header, (&title, Role::Ink), &rest);
    let area = centred(&layout.universes);
    let plane = map::plane(area, course);
    scene.marks.push(Mark::Raster { area, cells: map::shares(lap, lap.weights(), course), shading: Shading::Share });
    let paths = (0..m).flat_map(|slot| plane.path(&lap.path(slot), 1.0)).collect();
    scene.marks.push(Mark::Lines { lines: paths, width: 1.0, dash: None, role: Role::Path });
    for particle in lap.particles() {
        rimmed_robot(scene, &plane, &particle.world_from_robot, 6.0, Role::Path);
    }
    scene.marks.push(Mark::Frame { area, width: 1.0, role: Role::Frame });
    let bytes = told::kilobytes(model.graph().build().bytes());
    let [first, second] = match done {
        Some(report) => {
            let best = words::BestOff { rms: &told::metres(report.rms_best) }.say();
            let maps = &told::kilobytes(report.map_bytes_unique);
            let wide = words::Bytes { m: &m, maps, graph: &bytes }.say();
            let short = words::BytesShort { maps, graph: &bytes }.say();
            let fits = crate::font::measure(&wide, 11.5, Weight::Regular) <= layout.universes_told.w;
            [best, if fits { wide } else { short }]
        }
        None => [words::driving().into(), String::new()],
    };
    for (k, line) in [first, second].into_iter().enumerate() {
        let place = Rect { y: layout.universes_told.y + k as f64 * LINE, h: LINE, ..layout.universes_told };
        let role = if k == 0 { Role::Ink } else { Role::Muted };
        scene.marks.push(text(place, Anchor::Start, 11.5, Weight::Regular, role, line));
    }
}

/// As much of the area as has the maps' shape.
fn centred(area: &Rect) -> Rect {
    let w = (area.h * map::ASPECT).min(area.w);
    Rect { x: area.x, w, ..*area }
}
