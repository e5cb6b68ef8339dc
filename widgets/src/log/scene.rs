//! What is to be seen of a log: the best universe's map with the paths of all, and N_eff and lineage over the scans.

use super::{
    layout::{LINE, Layout, NARROWEST},
    model::{BACK, LogModel, Moment},
    tree::{FADE, Tree},
    view::View,
};
use crate::decimal::{fixed, write};
use crate::{
    font::{self, Weight},
    model::Model,
    scene::{
        Anchor, Cells, FREE, Mark, OCCUPIED, Point, Rect, Role, Scene, Shading, Text, UNKNOWN, heading, text, thinned,
    },
};
use fastslam::{geometry::Pose2, mapper::LaserMapper, resampling::ResamplePolicy};

/// Font size of what is written beside the map \[css px\].
const SIZE: f64 = 11.5;

/// Width of the paper-coloured rim that lifts a line off the map \[css px\], on each side.
const RIM: f64 = 1.25;

/// Widths \[css px\] of a path that lives on, and of one that has just died out: it fades by growing thinner.
const LIVES: f64 = 1.25;
const DIED: f64 = 2.0;

/// Height of the mark of a scan that resampled \[css px\].
const TICK: f64 = 6.0;

/// The whole figure at this size \[css px\].
pub fn build(model: &LogModel, width: f64, height: f64) -> Scene {
    let layout = Layout::new(width);
    let mut scene = Scene::new(width.max(NARROWEST), height.max(layout.height), model.describe());
    map(&mut scene, model, &layout);
    header(&mut scene, model, &layout.header);
    ess(&mut scene, model, &layout);
    lineage(&mut scene, model, &layout);
    legend(&mut scene, &layout.legend);
    scene
}

fn header(scene: &mut Scene, model: &LogModel, area: &Rect) {
    let (step, last) = (model.step(), model.step_count());
    let (strong, rest) = match (model.log(), model.mapper()) {
        (None, _) => ("No log yet".into(), String::new()),
        (_, None) => (format!("{} scans", last + 1), "raw odometry".into()),
        _ => {
            let m = model.setup().particles;
            let universes = if m == 1 { "1 universe".into() } else { format!("{m} universes") };
            (format!("Scan {step} of {last}"), universes)
        }
    };
    heading(scene, area, (&strong, Role::Ink), &rest);
}

fn map(scene: &mut Scene, model: &LogModel, layout: &Layout) {
    let area = layout.map;
    let unknown = Cells { columns: 1, shades: vec![UNKNOWN] };
    scene.marks.push(Mark::Raster { area, cells: unknown, shading: Shading::Map });
    if let Some(view) = model.view(layout) {
        if let Some((area, cells)) = model.mapper().and_then(|mapper| view.cells(mapper.map())) {
            scene.marks.push(Mark::Raster { area, cells, shading: Shading::Map });
        }
        around(scene, &area);
        odometry(scene, model, &view);
        paths(scene, model, &view);
        scale_bar(scene, &view);
    } else {
        let [_, y] = area.centre();
        let lines = [
            (13.5, Weight::SemiBold, Role::Ink, "No log is open"),
            (12.5, Weight::Regular, Role::Muted, "Run the example, or choose or drop a log."),
        ];
        for (k, (size, weight, role, words)) in lines.into_iter().enumerate() {
            let area = Rect::new(area.x, y + 22.0 * (k as f64 - 1.0), area.w, 22.0);
            scene.marks.push(text(area, Anchor::Middle, size, weight, role, words));
        }
    }
    scene.marks.push(Mark::Frame { area, width: 1.0, role: Role::Frame });
}

/// Paper over the cells that reach beyond the edge of the map.
fn around(scene: &mut Scene, area: &Rect) {
    let (w, h) = (scene.width, scene.height);
    let strips = [
        Rect::new(0.0, 0.0, w, area.y),
        Rect::new(0.0, area.bottom(), w, h - area.bottom()),
        Rect::new(0.0, area.y, area.x, area.h),
        Rect::new(area.right(), area.y, w - area.right(), area.h),
    ];
    scene.marks.extend(strips.map(|area| Mark::Fill { area, role: Role::Paper }));
}

fn odometry(scene: &mut Scene, model: &LogModel, view: &View) {
    let Some(log) = model.log().filter(|_| model.shows_raw()) else { return };
    // From the first scan on, as the map has it; up to the scan that is mapped.
    let first = log.scans[0].odometry;
    let mapped = model.mapper().and_then(|mapper| mapper.path().last().map(|(time, _)| *time));
    let scans = log.scans.iter().take_while(|scan| mapped.is_none_or(|time| scan.time <= time));
    let placed = |pose: &Pose2| if model.mapper().is_some() { first.between(pose) } else { *pose };
    let lines = view.path(&scans.map(|scan| placed(&scan.odometry)).collect::<Vec<_>>(), 1.0);
    scene.marks.push(Mark::Lines { lines, width: 1.5, dash: Some([7.0, 4.0]), role: Role::Odometry });
}

/// The paths of all universes, and of those that died out a short while ago.
fn paths(scene: &mut Scene, model: &LogModel, view: &View) {
    let Some(filter) = model.mapper().map(LaserMapper::filter) else { return };
    let tree = Tree::new(filter, model.deaths());
    for age in (0..FADE).rev() {
        let dead = tree.dead.iter().filter(|(a, _)| *a == age);
        let lines: Vec<_> = dead.flat_map(|(_, line)| view.path(line, 1.0)).collect();
        if !lines.is_empty() {
            let width = DIED * f64::from(FADE - age) / f64::from(FADE);
            scene.marks.push(Mark::Strands { lines, width, role: Role::Extinct });
        }
    }
    let others = tree.others.iter().flat_map(|line| view.path(line, 1.0)).collect();
    scene.marks.push(Mark::Strands { lines: others, width: LIVES, role: Role::Copied });
    let best = view.path(&tree.best, 1.0);
    scene.marks.push(Mark::Strands { lines: best, width: 2.0, role: Role::Path });
    let robots = filter.particles().iter().filter_map(|particle| view.robot(&particle.world_from_robot, 5.0));
    scene.marks.push(Mark::Polygons { polygons: robots.collect(), role: Role::Copied });
    let best = &filter.particles()[filter.best()].world_from_robot;
    if let Some(corners) = view.robot(best, 9.0) {
        let outline = corners.iter().chain(&corners[..2]).copied().collect();
        scene.marks.push(Mark::Lines { lines: vec![outline], width: 2.0 * RIM, dash: None, role: Role::Paper });
        scene.marks.push(Mark::Polygons { polygons: vec![corners], role: Role::Path });
    }
}

/// A round length, in the lower right corner.
fn scale_bar(scene: &mut Scene, view: &View) {
    let metres = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 5000.0, 20000.0];
    let room = 0.25 * view.area.w;
    let metres = metres.into_iter().rev().find(|metres| metres * view.scale <= room).unwrap_or(metres[0]);
    let length = (metres * view.scale).min(room);
    let label = format!("{} m", write(metres));
    let plate_width = length.max(font::measure(&label, 9.5, Weight::Regular)) + 8.0;
    let (right, y) = (view.area.right() - 10.0, view.area.bottom() - 8.0);
    let plate = Rect::new(right + 4.0 - plate_width, y - 13.0, plate_width, 17.0);
    scene.marks.push(Mark::Fill { area: plate, role: Role::Paper });
    let bar = vec![[right - length, y - 3.0], [right - length, y], [right, y], [right, y - 3.0]];
    scene.marks.push(Mark::Lines { lines: vec![bar], width: 1.0, dash: None, role: Role::Ink });
    let area = Rect::new(plate.x, plate.y, plate.w, 12.0);
    scene.marks.push(text(area, Anchor::Middle, 9.5, Weight::Regular, Role::Ink, label));
}

/// The end of a gauge's label, and what is left before it.
fn value(scene: &mut Scene, label: &Rect, words: String) -> Rect {
    let width = font::measure(&words, SIZE, Weight::SemiBold) + 0.01;
    let area = Rect::new(label.right() - width, label.y, width, label.h);
    scene.marks.push(text(area, Anchor::Start, SIZE, Weight::SemiBold, Role::Ink, words));
    Rect::new(label.x, label.y, (label.w - width - 6.0).max(0.0), label.h)
}

/// A curve over the scans: a share of the chart's height for each step.
fn curve(scene: &mut Scene, model: &LogModel, chart: &Rect, share: impl Fn(&Moment) -> f64) -> Vec<Point> {
    for y in [chart.y, chart.bottom()] {
        scene.marks.push(Mark::Fill { area: Rect::new(chart.x, y - 0.5, chart.w, 1.0), role: Role::Frame });
    }
    let last = f64::from(model.step_count().max(1));
    let at = |(k, moment): (usize, &Moment)| {
        [chart.x + chart.w * (k + 1) as f64 / last, chart.bottom() - chart.h * share(moment).clamp(0.0, 1.0)]
    };
    let points: Vec<Point> = model.history().iter().enumerate().map(at).collect();
    scene.marks.push(Mark::Strands {
        lines: vec![thinned(&mut points.iter().copied(), 0.5)],
        width: 1.25,
        role: Role::Ink,
    });
    points
}

/// N_eff, the threshold, and the steps that resampled.
fn ess(scene: &mut Scene, model: &LogModel, layout: &Layout) {
    let (gauge, m) = (&layout.gauges[0], model.setup().particles);
    let now = model.history().last().map_or("–".into(), |moment| fixed(moment.ess, 1));
    let name = value(scene, &gauge.label, format!("{now} of {m}"));
    // N with its index: smaller, and lower.
    let n = Text::new(name, Anchor::Start, SIZE, Weight::Regular, Role::Muted, "N");
    let index = Rect::new(name.x + n.width() + 0.5, name.y + 3.5, 20.0, name.h);
    scene.marks.push(Mark::Text(n));
    scene.marks.push(text(index, Anchor::Start, 8.5, Weight::Regular, Role::Muted, "eff"));
    let chart = &gauge.chart;
    let points = curve(scene, model, chart, |moment| moment.ess / m as f64);
    if let ResamplePolicy::EssBelow(fraction) = model.setup().policy {
        let y = chart.bottom() - chart.h * fraction;
        let lines = vec![vec![[chart.x, y], [chart.right(), y]]];
        scene.marks.push(Mark::Lines { lines, width: 1.0, dash: Some([2.0, 2.0]), role: Role::Accent });
    }
    let resampled = points.iter().zip(model.history()).filter(|(_, moment)| moment.resampled);
    let lines = thinned(&mut resampled.map(|(at, _)| [at[0], chart.bottom()]), 0.75);
    let lines = lines.into_iter().map(|[x, y]| vec![[x, y], [x, y - TICK]]).collect();
    scene.marks.push(Mark::Strands { lines, width: 1.0, role: Role::Extinct });
}

/// Distinct ancestors some scans ago.
fn lineage(scene: &mut Scene, model: &LogModel, layout: &Layout) {
    let (gauge, m) = (&layout.gauges[1], model.setup().particles);
    let now = model.history().last().map_or("–".into(), |moment| moment.lineage.to_string());
    let name = value(scene, &gauge.label, format!("{now} of {m}"));
    let names = [format!("Ancestors {BACK} scans ago"), format!("Lineage, {BACK} back")];
    let fits = |label: &String| font::measure(label, SIZE, Weight::Regular) < name.w;
    let label = names.into_iter().find(fits).unwrap_or("Lineage".into());
    scene.marks.push(text(name, Anchor::Start, SIZE, Weight::Regular, Role::Muted, label));
    curve(scene, model, &gauge.chart, |moment| f64::from(moment.lineage) / m as f64);
}

/// What a legend's sample looks like.
#[derive(Clone, Copy)]
enum Sample {
    Cell(u8),
    Line(Role, f64, Option<[f64; 2]>),
    Tick,
}

fn legend(scene: &mut Scene, area: &Rect) {
    let items = [
        (Sample::Cell(OCCUPIED), "wall"),
        (Sample::Cell(FREE), "free"),
        (Sample::Cell(UNKNOWN), "unknown"),
        (Sample::Line(Role::Path, 2.0, None), "best universe"),
        (Sample::Line(Role::Copied, LIVES, None), "the others"),
        (Sample::Line(Role::Extinct, DIED, None), "just died out"),
        (Sample::Line(Role::Odometry, 1.5, Some([7.0, 4.0])), "raw odometry"),
        (Sample::Tick, "resampled"),
        (Sample::Line(Role::Accent, 1.0, Some([2.0, 2.0])), "threshold"),
    ];
    let (width, gap) = (18.0, 14.0);
    let [mut x, mut y] = [area.x, area.y];
    for (sample, name) in items {
        let name_width = font::measure(name, SIZE, Weight::Regular) + 0.01;
        if x > area.x && x + width + 5.0 + name_width > area.right() {
            (x, y) = (area.x, y + LINE);
        }
        let place = Rect::new(x, y + 0.5 * (LINE - 12.0), width, 12.0);
        let cy = place.centre()[1];
        match sample {
            Sample::Cell(shade) => {
                let cells = Cells { columns: 1, shades: vec![shade] };
                scene.marks.push(Mark::Raster { area: place, cells, shading: Shading::Map });
                scene.marks.push(Mark::Frame { area: place, width: 1.0, role: Role::Weight(0) });
            }
            Sample::Line(role, width, dash) => {
                let lines = vec![vec![[place.x, cy], [place.right(), cy]]];
                scene.marks.push(Mark::Lines { lines, width, dash, role });
            }
            Sample::Tick => {
                let [x, y] = place.centre();
                let lines = vec![vec![[x, y - 0.5 * TICK], [x, y + 0.5 * TICK]]];
                scene.marks.push(Mark::Lines { lines, width: 1.25, dash: None, role: Role::Extinct });
            }
        }
        let words = Rect::new(place.right() + 5.0, y, name_width, LINE);
        scene.marks.push(text(words, Anchor::Start, SIZE, Weight::Regular, Role::Muted, name));
        x = words.right() + gap;
    }
}
