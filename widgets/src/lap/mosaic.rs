//! All universes small: their maps, weights and paths, and what a resampling did to them.

use super::{
    grid::Tiles,
    layout::{Layout, RING},
    map::{self, ASPECT},
    model::LapModel,
};
use crate::{
    font::{self, Weight},
    model::Model,
    scene::{Anchor, Mark, Point, Rect, Region, Role, Sample, Scene, Shading, cross, heading, legend, text},
    words::{common, lap},
};

/// Shares of weight (1 = 1/M) at which a border is full: a universe that weighs thrice its share.
const FULL_SHARE: f64 = 3.0;

/// Tiles narrower than this \[css px\] show no path, and those narrower than the next no labels, and so on.
const PATH_FROM: f64 = 26.0;
pub const LABEL_FROM: f64 = 36.0;
const GHOST_FROM: f64 = 58.0;

/// The border of a universe that weighs this share (1 = 1/M), inside of its tile: greener and wider with weight.
fn border(area: Rect, share: f64, full: f64) -> Mark {
    let t = (share / FULL_SHARE).clamp(0.0, 1.0);
    Mark::Frame { area, width: 1.0 + t * (full - 1.0), role: Role::Weight((255.0 * t).round() as u8) }
}

/// The sign of a copy: a lower left corner folded over.
fn fold([x, y]: Point, side: f64) -> Mark {
    Mark::Polygons { polygons: vec![vec![[x, y - side], [x + side, y], [x, y]]], role: Role::Copied }
}

/// The sign of a universe that died out: a cross on paper.
fn extinct_cross(area: &Rect) -> [Mark; 2] {
    let (lines, width) = (cross(area.inset(0.2 * area.w)), (0.16 * area.w).max(1.0));
    [Mark::Fill { area: *area, role: Role::Paper }, Mark::Lines { lines, width, dash: None, role: Role::Extinct }]
}

pub fn mosaic(scene: &mut Scene, model: &LapModel, layout: &Layout, tiles: &Tiles) {
    let (lap, selected) = (model.lap(), model.selected());
    let m = lap.particles().len();
    let extinct = model.extinct();
    let name = common::UniverseCount { m: &m }.say();
    let (title, role, rest) = match &model.report().ancestors {
        Some(_) if extinct.is_empty() => (name, Role::Ink, lap::none_died_out()),
        Some(_) => (lap::Resampled { dead: &extinct.len(), m: &m }.say(), Role::Extinct, ""),
        None if m == 1 => (name, Role::Ink, lap::only_hypothesis()),
        None if model.step() == 0 => (name, Role::Ink, lap::all_alike()),
        None => (name, Role::Ink, lap::map_each()),
    };
    heading(scene, &layout.mosaic_header, (&title, role), rest);

    let width = tiles.size[0];
    let full = (0.05 * width).clamp(2.0, 5.0);
    let map_area = |slot: usize| tiles.tile(slot).inset(full + if width < PATH_FROM { 0.0 } else { 1.0 });
    for (slot, particle) in lap.particles().iter().enumerate() {
        let tile = tiles.tile(slot);
        let cells = map::shades(&particle.map);
        scene.marks.push(Mark::Raster { area: map_area(slot), cells, shading: Shading::Map });
        scene.marks.push(border(tile, lap.weights()[slot] * m as f64, full));
        scene.regions.push(Region { area: tile, target: slot as u32 });
    }
    if width >= PATH_FROM {
        paths(scene, model, &map_area, width);
    }
    let ring = tiles.tile(selected as usize).inset(-(0.5 * tiles.gap[1]).clamp(1.0, RING));
    scene.marks.push(Mark::Frame { area: ring, width: if width < PATH_FROM { 1.0 } else { 1.5 }, role: Role::Ink });
    if m > 1 {
        for slot in 0..m as u32 {
            origin(scene, model, slot, &map_area(slot as usize), width);
        }
        extinct.iter().for_each(|&slot| ghost(scene, model, slot, &map_area(slot as usize), width));
    }
}

/// Paths and robots of all tiles, one mark for each kind.
fn paths(scene: &mut Scene, model: &LapModel, map_area: &dyn Fn(usize) -> Rect, width: f64) {
    let lap = model.lap();
    let (mut lines, mut robots) = (Vec::new(), Vec::new());
    let length = (0.06 * width).clamp(2.5, 6.0);
    for (slot, particle) in lap.particles().iter().enumerate() {
        let plane = map::plane(map_area(slot));
        lines.extend(plane.path(&lap.path(slot), 1.0));
        robots.extend(plane.robot(&particle.world_from_robot, length));
    }
    let thin = if width < GHOST_FROM { 1.0 } else { 1.5 };
    if width >= LABEL_FROM {
        scene.marks.push(Mark::Lines { lines: lines.clone(), width: thin + 1.5, dash: None, role: Role::Paper });
    }
    scene.marks.push(Mark::Lines { lines, width: thin, dash: None, role: Role::Path });
    scene.marks.push(Mark::Polygons { polygons: robots, role: Role::Path });
}

/// The number of a slot, and at a resampling whom its universe was copied from.
fn origin(scene: &mut Scene, model: &LapModel, slot: u32, map: &Rect, width: f64) {
    let parent = model.report().ancestors.as_ref().map(|a| a[slot as usize]).filter(|&parent| parent != slot);
    if width < LABEL_FROM {
        if parent.is_some() {
            // Too small for words: a corner folded in the colour of a copy.
            scene.marks.push(fold([map.x, map.bottom()], 0.35 * map.h));
        }
        return;
    }
    let size = (0.12 * width).clamp(8.5, 11.0);
    let plate = |label: &str, weight, bottom: bool| {
        let (w, h) = (font::measure(label, size, weight) + 5.0, size + 2.0);
        Rect::new(map.x, if bottom { map.bottom() - h } else { map.y }, w.min(map.w), h)
    };
    let chosen = slot == model.selected();
    let number = slot.to_string();
    let area = plate(&number, Weight::Regular, false);
    let (ground, role) = if chosen { (Role::Ink, Role::Paper) } else { (Role::Paper, Role::Muted) };
    scene.marks.push(Mark::Fill { area, role: ground });
    scene.marks.push(text(area, Anchor::Middle, size, Weight::Regular, role, number));
    if let Some(parent) = parent {
        let label = if width < GHOST_FROM { format!("←{parent}") } else { format!("← {parent}") };
        let area = plate(&label, Weight::SemiBold, true);
        scene.marks.push(Mark::Fill { area, role: Role::Paper });
        scene.marks.push(text(area, Anchor::Middle, size, Weight::SemiBold, Role::Copied, label));
    }
}

/// The universe that died out in this slot: its last map, faded and crossed out, or where there is no room a cross.
fn ghost(scene: &mut Scene, model: &LapModel, slot: u32, map: &Rect, width: f64) {
    let w = 0.46 * map.w;
    let corner = |w: f64, h: f64| Rect::new(map.right() - w, map.bottom() - h, w, h);
    match model.before() {
        Some(before) if width >= GHOST_FROM => {
            let area = corner(w, w / ASPECT);
            let cells = map::shades(&before.particles()[slot as usize].map);
            let lines = cross(area);
            scene.marks.extend([
                Mark::Fill { area: area.inset(-1.0), role: Role::Paper },
                Mark::Raster { area, cells, shading: Shading::Ghost },
                Mark::Lines { lines, width: 1.0, dash: None, role: Role::Extinct },
                Mark::Frame { area, width: 1.0, role: Role::Extinct },
            ]);
        }
        _ => {
            let side = (0.42 * map.h).clamp(5.0, 11.0);
            scene.marks.extend(extinct_cross(&corner(side, side)));
        }
    }
}

/// What borders and marks mean.
pub fn notes(scene: &mut Scene, model: &LapModel, area: &Rect, labels: bool) {
    let weight = |share| Sample::new(move |place| vec![border(*place, share, 4.0)]);
    if model.lap().particles().len() == 1 {
        legend(scene, area, [(weight(1.0), lap::all_weight())]);
        return;
    }
    let weights = [(weight(0.0), lap::no_weight()), (weight(1.0), "1/M"), (weight(FULL_SHARE), lap::much_weight())];
    let label = |place: &Rect| vec![text(*place, Anchor::Start, 10.5, Weight::SemiBold, Role::Copied, "← 7")];
    let copied = if labels {
        (Sample::new(label).wide(font::measure("← 7", 10.5, Weight::SemiBold) + 4.0), lap::copied_from())
    } else {
        (Sample::at(|[x, y]| fold([x - 5.0, y + 5.0], 10.0)), lap::copied())
    };
    let died = |place: &Rect| {
        let [x, y] = place.centre();
        extinct_cross(&Rect::new(x - 5.0, y - 5.0, 10.0, 10.0)).into()
    };
    let resampling =
        [(Sample::dot(Role::Copied, 2.5), common::resampled()), copied, (Sample::new(died), common::died_out())];
    let y = legend(scene, area, weights);
    legend(scene, &Rect { y, ..*area }, resampling);
}
