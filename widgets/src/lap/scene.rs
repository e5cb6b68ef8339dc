//! What is to be seen of the lap: one universe large, all universes small, and N_eff over the steps.

use super::{
    grid::Tiles,
    layout::{LINE, Layout, NARROWEST, RING},
    model::LapModel,
    view::{self, ASPECT, View},
};
use crate::decimal::fixed;
use crate::{
    font::{self, Weight},
    model::Model,
    scene::{
        Anchor, Cells, FREE, Mark, OCCUPIED, Point, Rect, Region, Role, Scene, Shading, Text, UNKNOWN, heading, text,
    },
};
use fastslam::{geometry::Pose2, resampling::ResamplePolicy};

/// Width of the paper-coloured rim that lifts a line off the map \[css px\], on each side.
const RIM: f64 = 1.25;

/// Shares of weight (1 = 1/M) at which a border is full: a universe that weighs thrice its share.
const FULL_SHARE: f64 = 3.0;

/// Tiles narrower than this \[css px\] show no path, and those narrower than the next no labels, and so on.
const PATH_FROM: f64 = 26.0;
const LABEL_FROM: f64 = 36.0;
const GHOST_FROM: f64 = 58.0;

/// The whole figure at this size \[css px\].
pub fn build(model: &LapModel, width: f64, height: f64) -> Scene {
    let layout = Layout::new(width);
    let mut scene = Scene::new(width.max(NARROWEST), height.max(layout.height), model.describe());
    large(&mut scene, model, &layout);
    legend(&mut scene, model, &layout.legend);
    let tiles = Tiles::fit(&layout.mosaic.inset(RING), model.lap().particles().len(), ASPECT);
    mosaic(&mut scene, model, &layout, &tiles);
    notes(&mut scene, model, &layout.notes, tiles.size[0] >= LABEL_FROM);
    meter(&mut scene, model, &layout.meter);
    scene
}

fn large(scene: &mut Scene, model: &LapModel, layout: &Layout) {
    let (lap, slot) = (model.lap(), model.selected());
    let step = format!("step {} of {}", model.step(), model.step_count());
    let step_width = font::measure(&step, 12.5, Weight::Regular) + 2.0;
    let Rect { x, y, w, h } = layout.large_header;
    let weight = lap.weights()[slot as usize];
    let best = if slot == model.report().best { "best · " } else { "" };
    let title = Rect::new(x, y, w - step_width - 8.0, h);
    heading(scene, &title, (&format!("Universe {slot}"), Role::Ink), &format!("{best}weight {}", fixed(weight, 3)));
    let step_area = Rect::new(x + w - step_width, y, step_width, h);
    scene.marks.push(text(step_area, Anchor::End, 12.5, Weight::Regular, Role::Muted, step));

    let view = View { area: layout.large };
    let particle = &lap.particles()[slot as usize];
    scene.marks.push(Mark::Raster { area: view.area, cells: view::shades(&particle.map), shading: Shading::Map });
    let world = lap.world();
    let now = model.step() as usize;
    if model.shows_truth() {
        let walls = world.plan.walls.iter().chain(&world.plan.furniture);
        let walls = walls.map(|s| vec![view.point(s.a), view.point(s.b)]).collect();
        rimmed(scene, walls, 1.25, None, Role::Truth);
    }
    let hits = view::hits(&particle.map).into_iter().map(|p| view.point(p));
    let hits: Vec<Point> = hits.filter(|p| view.area.inset(2.0).contains(*p)).collect();
    scene.marks.push(Mark::Discs { centres: hits, radius: (0.035 * view.scale()).max(1.0), role: Role::Hit });
    if model.shows_raw() {
        let lines = view.path(&world.odometry[..=now], 0.5);
        rimmed(scene, lines, 2.0, Some([7.0, 4.0]), Role::Odometry);
        robot(scene, &view, &world.odometry[now], 7.0, Role::Odometry);
    }
    rimmed(scene, view.path(&lap.path(slot as usize), 0.5), 2.25, None, Role::Path);
    if model.shows_truth() {
        // Over the estimate, thin and dashed: where both agree, both are seen.
        let lines = view.path(&world.truth[..=now], 0.5);
        scene.marks.push(Mark::Lines { lines, width: 1.5, dash: Some([2.0, 3.0]), role: Role::Truth });
        robot(scene, &view, &world.truth[now], 7.0, Role::Truth);
    }
    robot(scene, &view, &particle.world_from_robot, 9.0, Role::Path);
    scale_bar(scene, &view);
    scene.marks.push(Mark::Frame { area: view.area, width: 1.0, role: Role::Frame });
}

/// Lines with a rim, so that they are seen on walls too.
fn rimmed(scene: &mut Scene, lines: Vec<Vec<Point>>, width: f64, dash: Option<[f64; 2]>, role: Role) {
    let rim = Mark::Lines { lines: lines.clone(), width: width + 2.0 * RIM, dash: None, role: Role::Paper };
    scene.marks.extend([rim, Mark::Lines { lines, width, dash, role }]);
}

fn robot(scene: &mut Scene, view: &View, pose: &Pose2, length: f64, role: Role) {
    let Some(corners) = view.robot(pose, length) else { return };
    let outline: Vec<Point> = corners.iter().chain(&corners[..2]).copied().collect();
    let rim = Mark::Lines { lines: vec![outline], width: 2.0 * RIM, dash: None, role: Role::Paper };
    scene.marks.extend([rim, Mark::Polygons { polygons: vec![corners], role }]);
}

/// One metre, in the lower right corner.
fn scale_bar(scene: &mut Scene, view: &View) {
    let length = view.scale();
    let (right, y) = (view.area.right() - 10.0, view.area.bottom() - 8.0);
    let plate = Rect::new(right - length - 4.0, y - 13.0, length + 8.0, 17.0);
    scene.marks.push(Mark::Fill { area: plate, role: Role::Paper });
    let bar = vec![[right - length, y - 3.0], [right - length, y], [right, y], [right, y - 3.0]];
    scene.marks.push(Mark::Lines { lines: vec![bar], width: 1.0, dash: None, role: Role::Ink });
    let area = Rect::new(plate.x, plate.y, plate.w, 12.0);
    scene.marks.push(text(area, Anchor::Middle, 9.5, Weight::Regular, Role::Ink, "1 m"));
}

/// What a legend's sample looks like.
#[derive(Clone, Copy)]
enum Sample {
    Cell(u8),
    Hit,
    Line(Role, f64, Option<[f64; 2]>),
    Border(f64),
    Label,
    Fold,
    Cross,
    Dot,
}

/// Samples with their names, each group on a new line, in as many lines as it takes.
fn samples(scene: &mut Scene, area: &Rect, groups: &[&[(Sample, &str)]]) {
    let mut y = area.y;
    for group in groups {
        y = sample_group(scene, &Rect::new(area.x, y, area.w, area.bottom() - y), group);
    }
}

/// One group; returns where the next can begin.
fn sample_group(scene: &mut Scene, area: &Rect, items: &[(Sample, &str)]) -> f64 {
    let (size, width, gap) = (11.5, 18.0, 14.0);
    let [mut x, mut y] = [area.x, area.y];
    for &(sample, name) in items {
        let name_width = font::measure(name, size, Weight::Regular);
        if x > area.x && x + width + 6.0 + name_width > area.right() {
            (x, y) = (area.x, y + LINE);
        }
        let label =
            if let Sample::Label = sample { font::measure("← 7", 10.5, Weight::SemiBold) + 4.0 } else { width };
        let place = Rect::new(x, y + 0.5 * (LINE - 12.0), label, 12.0);
        draw_sample(scene, sample, &place);
        let name_area =
            Rect::new(place.right() + 6.0, y, (area.right() - place.right() - 6.0).min(name_width + 0.01), LINE);
        let line = Text::new(name_area, Anchor::Start, size, Weight::Regular, Role::Muted, name);
        x = name_area.x + line.width() + gap;
        scene.marks.push(Mark::Text(line));
    }
    y + LINE
}

fn draw_sample(scene: &mut Scene, sample: Sample, place: &Rect) {
    let [cx, cy] = place.centre();
    let marks = &mut scene.marks;
    let mut cell = |shade| {
        let cells = Cells { columns: 1, shades: vec![shade] };
        marks.push(Mark::Raster { area: *place, cells, shading: Shading::Map });
        marks.push(Mark::Frame { area: *place, width: 1.0, role: Role::Weight(0) });
    };
    match sample {
        Sample::Cell(shade) => cell(shade),
        Sample::Hit => {
            cell(OCCUPIED);
            marks.push(Mark::Discs { centres: vec![[cx, cy]], radius: 1.5, role: Role::Hit });
        }
        Sample::Line(role, width, dash) => {
            let lines = vec![vec![[place.x, cy], [place.right(), cy]]];
            marks.push(Mark::Lines { lines, width, dash, role });
        }
        Sample::Border(share) => marks.push(border(*place, share, 4.0)),
        Sample::Label => marks.push(text(*place, Anchor::Start, 10.5, Weight::SemiBold, Role::Copied, "← 7")),
        Sample::Dot => marks.push(Mark::Discs { centres: vec![[cx, cy]], radius: 2.5, role: Role::Copied }),
        Sample::Fold => marks.push(fold([cx - 5.0, cy + 5.0], 10.0)),
        Sample::Cross => cross(scene, &Rect::new(cx - 5.0, cy - 5.0, 10.0, 10.0)),
    }
}

fn legend(scene: &mut Scene, model: &LapModel, area: &Rect) {
    let mut items = vec![
        (Sample::Cell(OCCUPIED), "wall"),
        (Sample::Cell(FREE), "free"),
        (Sample::Cell(UNKNOWN), "unknown"),
        (Sample::Hit, "mean of hits"),
        (Sample::Line(Role::Path, 2.25, None), "its path"),
    ];
    if model.shows_truth() {
        items.push((Sample::Line(Role::Truth, 1.5, Some([2.0, 3.0])), "truth"));
    }
    if model.shows_raw() {
        items.push((Sample::Line(Role::Odometry, 2.0, Some([7.0, 4.0])), "raw odometry"));
    }
    samples(scene, area, &[&items]);
}

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
fn cross(scene: &mut Scene, area: &Rect) {
    let Rect { x, y, w, h } = area.inset(0.2 * area.w);
    let lines = vec![vec![[x, y], [x + w, y + h]], vec![[x, y + h], [x + w, y]]];
    scene.marks.push(Mark::Fill { area: *area, role: Role::Paper });
    scene.marks.push(Mark::Lines { lines, width: (0.16 * area.w).max(1.0), dash: None, role: Role::Extinct });
}

fn mosaic(scene: &mut Scene, model: &LapModel, layout: &Layout, tiles: &Tiles) {
    let (lap, selected) = (model.lap(), model.selected());
    let m = lap.particles().len();
    let extinct = model.extinct();
    let name = if m == 1 { "1 universe".into() } else { format!("{m} universes") };
    match &model.report().ancestors {
        Some(_) if extinct.is_empty() => {
            heading(scene, &layout.mosaic_header, (&name, Role::Ink), "resampled: none died out")
        }
        Some(_) => {
            let title = format!("Resampled: {} of {m} died out", extinct.len());
            heading(scene, &layout.mosaic_header, (&title, Role::Extinct), "");
        }
        None if m == 1 => heading(scene, &layout.mosaic_header, (&name, Role::Ink), "the only hypothesis"),
        None if model.step() == 0 => {
            heading(scene, &layout.mosaic_header, (&name, Role::Ink), "all alike at the start")
        }
        None => heading(scene, &layout.mosaic_header, (&name, Role::Ink), "each with a map of its own"),
    }

    let width = tiles.size[0];
    let full = (0.05 * width).clamp(2.0, 5.0);
    let map_area = |slot: usize| tiles.tile(slot).inset(full + if width < PATH_FROM { 0.0 } else { 1.0 });
    for (slot, particle) in lap.particles().iter().enumerate() {
        let tile = tiles.tile(slot);
        let cells = view::shades(&particle.map);
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
        let view = View { area: map_area(slot) };
        lines.extend(view.path(&lap.path(slot), 1.0));
        robots.extend(view.robot(&particle.world_from_robot, length));
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
            let d = 0.35 * map.h;
            let (x, y) = (map.x, map.bottom());
            scene
                .marks
                .push(Mark::Polygons { polygons: vec![vec![[x, y - d], [x + d, y], [x, y]]], role: Role::Copied });
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
            let cells = view::shades(&before.particles()[slot as usize].map);
            let Rect { x, y, w, h } = area;
            let lines = vec![vec![[x, y], [x + w, y + h]], vec![[x, y + h], [x + w, y]]];
            scene.marks.extend([
                Mark::Fill { area: area.inset(-1.0), role: Role::Paper },
                Mark::Raster { area, cells, shading: Shading::Ghost },
                Mark::Lines { lines, width: 1.0, dash: None, role: Role::Extinct },
                Mark::Frame { area, width: 1.0, role: Role::Extinct },
            ]);
        }
        _ => {
            let side = (0.42 * map.h).clamp(5.0, 11.0);
            cross(scene, &corner(side, side));
        }
    }
}

fn notes(scene: &mut Scene, model: &LapModel, area: &Rect, labels: bool) {
    if model.lap().particles().len() == 1 {
        return samples(scene, area, &[&[(Sample::Border(1.0), "weight: all of it")]]);
    }
    let weights =
        [(Sample::Border(0.0), "weight 0"), (Sample::Border(1.0), "1/M"), (Sample::Border(FULL_SHARE), "3/M or more")];
    let resampling = [
        (Sample::Dot, "resampled"),
        (if labels { Sample::Label } else { Sample::Fold }, if labels { "copied from" } else { "copied" }),
        (Sample::Cross, "died out"),
    ];
    samples(scene, area, &[&weights, &resampling]);
}

/// N_eff over the steps, with the threshold that calls for resampling and the steps that did.
fn meter(scene: &mut Scene, model: &LapModel, area: &Rect) {
    let count = model.lap().particles().len();
    let m = count as f64;
    let label_width = 66.0;
    let chart = Rect::new(area.x + label_width, area.y + 4.0, area.w - label_width - 3.0, area.h - 8.0);
    let line = |k: f64| Rect::new(area.x, chart.y + 0.5 * chart.h - 17.0 + 17.0 * k, label_width - 6.0, 17.0);
    // N with its index: smaller, and lower.
    let n = Text::new(line(0.0), Anchor::Start, 12.5, Weight::SemiBold, Role::Ink, "N");
    let index = Rect::new(area.x + n.width() + 0.5, n.area.y + 3.5, 20.0, 17.0);
    let ess = fixed(model.report().ess, 1);
    let value = Rect::new(index.x + 16.0, n.area.y, label_width - 6.0 - (index.x + 16.0 - area.x), 17.0);
    scene.marks.push(Mark::Text(n));
    scene.marks.push(text(index, Anchor::Start, 8.5, Weight::SemiBold, Role::Ink, "eff"));
    scene.marks.push(text(value, Anchor::End, 12.5, Weight::Regular, Role::Ink, ess));
    scene.marks.push(text(line(1.0), Anchor::Start, 11.5, Weight::Regular, Role::Muted, format!("of {count}")));

    let at = |step: u32, ess: f64| {
        [chart.x + chart.w * f64::from(step) / f64::from(model.step_count()), chart.bottom() - chart.h * ess / m]
    };
    let ends = |y: f64| vec![at(0, y), at(model.step_count(), y)];
    scene.marks.push(Mark::Lines { lines: vec![ends(0.0), ends(m)], width: 1.0, dash: None, role: Role::Frame });
    if let ResamplePolicy::EssBelow(fraction) = model.setup().policy {
        let lines = vec![ends(fraction * m)];
        scene.marks.push(Mark::Lines { lines, width: 1.0, dash: Some([3.0, 3.0]), role: Role::Weight(0) });
    }
    let history = model.history();
    let curve: Vec<Point> = history.iter().map(|r| at(r.step, r.ess)).collect();
    let resampled = history.iter().filter(|r| r.ancestors.is_some()).map(|r| at(r.step, r.ess)).collect();
    let now = curve[curve.len() - 1];
    scene.marks.push(Mark::Lines { lines: vec![curve], width: 1.25, dash: None, role: Role::Muted });
    scene.marks.push(Mark::Discs { centres: resampled, radius: 2.0, role: Role::Copied });
    scene.marks.push(Mark::Discs { centres: vec![now], radius: 3.0, role: Role::Ink });
}
