//! What is to be seen of a log: the best universe's map with the paths of all, and N_eff and lineage over the scans.

use super::{
    kept::Seen,
    laid::Laid,
    layout::{Gauge, Layout},
    map::{Frame, MapView},
    model::{BACK, LogModel, Moment},
    tree::{FADE, Tree},
    verb::Verb,
};
use crate::decimal::fixed;
use crate::{
    action::Own,
    model::{FigureError, Model},
    panels::Panels,
    robot::{Poses, Robots},
    scene::{
        Cells, Chart, FREE, Letters, OCCUPIED, Plane, Point, Rect, Role, Sample, Scene, Shading, UNKNOWN, joined,
        legend, plain, strong, thinned,
    },
    view::{Layout as _, View},
    words::{common, log as words},
};
use fastslam::{geometry::Pose2, resampling::ResamplePolicy};

/// Font size of what is written beside the map \[css px\].
const SIZE: f64 = 11.5;
const NAME: Letters = plain(SIZE, Role::Muted);

/// Dashes and gaps of raw odometry and of the threshold \[css px\].
const RAW: [f64; 2] = [7.0, 4.0];
const THRESHOLD: [f64; 2] = [2.0, 2.0];

/// Widths \[css px\] of a path that lives on, and of one that has just died out: it fades by growing thinner.
const LIVES: f64 = 1.25;
const DIED: f64 = 2.0;

/// Height of the mark of a scan that resampled \[css px\].
const TICK: f64 = 6.0;

/// A recorded log, as it is seen.
#[derive(Default)]
pub struct LogView {
    /// What the reader looks at, and in which log; `None` is the whole, as it is for every other log.
    frame: Option<(u32, Frame)>,
}

impl View for LogView {
    type Model = LogModel;
    type Layout = Layout;

    fn draw(&self, model: &LogModel, layout: &Layout, scene: &mut Scene) {
        if let Some(area) = layout.map {
            map(scene, model, area, self.map_view(model, area).as_ref());
        }
        header(scene, model, &layout.header);
        if let Some([first, second]) = &layout.gauges {
            ess(scene, model, first);
            lineage(scene, model, second);
        }
        names(scene, layout, model.compared().is_some());
    }

    fn own(
        &mut self,
        model: &mut LogModel,
        own: &Own,
        (width, scale): (f64, f64),
        panels: &Panels,
    ) -> Result<(), FigureError> {
        let layout = Layout::of(width, panels);
        let finite = |point: Point| Some(point.map(|c| c * scale)).filter(|at| at.iter().all(|c| c.is_finite()));
        match Verb::of(own) {
            Some(Verb::Zoom(factor, at)) if factor.is_finite() && factor > 0.0 => {
                let at = at.and_then(finite);
                self.look(model, &layout, |view| view.zoomed(factor, at.unwrap_or(view.0.area.centre())));
            }
            Some(Verb::Pan(by)) => {
                if let Some(by) = finite(by) {
                    self.look(model, &layout, |view| view.panned(by));
                }
            }
            Some(Verb::Fit) => self.frame = None,
            _ => (),
        }
        Ok(())
    }
}

impl LogView {
    /// The part of the world that is shown.
    fn map_view(&self, model: &LogModel, area: Rect) -> Option<MapView> {
        let chosen = self.frame.filter(|(log, _)| *log == model.log_number());
        let frame = chosen.map(|(_, frame)| frame).or_else(|| whole(model))?;
        Some(MapView::new(area, &frame))
    }

    fn look(&mut self, model: &LogModel, layout: &Layout, move_to: impl Fn(MapView) -> MapView) {
        if let Some(area) = layout.map {
            let view = self.map_view(model, area);
            self.frame = view.map(|view| (model.log_number(), move_to(view).frame()));
        }
    }
}

/// All that there is to see: of the newest map, whichever is shown, or before there is one, of raw odometry.
fn whole(model: &LogModel) -> Option<Frame> {
    match (model.mapper(), model.log()) {
        (Some(mapper), _) => {
            let frame = Frame::of_map(mapper.map());
            let size = mapper.settings().cell_size;
            let laid = model.compared().and_then(Laid::corners);
            let laid = laid.map(|corners| corners.map(|corner| corner.map(|k| f64::from(k) * size)));
            Some(laid.map_or(frame, |[low, high]| frame.both(Frame::around(low, high.map(|c| c + size)))))
        }
        (None, Some(log)) => {
            let corner = |pick: fn(f64, f64) -> f64, start: f64| {
                let fold = |corner: [f64; 2], x, y| [pick(corner[0], x), pick(corner[1], y)];
                log.scans.iter().fold([start; 2], |c, scan| fold(c, scan.odometry.x, scan.odometry.y))
            };
            Some(Frame::around(corner(f64::min, f64::INFINITY), corner(f64::max, f64::NEG_INFINITY)))
        }
        _ => None,
    }
}

fn header(scene: &mut Scene, model: &LogModel, area: &Rect) {
    let (step, last) = (model.step(), model.step_count());
    let (strong, rest) = match (model.log(), model.mapper()) {
        (None, _) => (words::no_log().into(), String::new()),
        (_, None) => (words::ScanCount { n: &(last + 1) }.say(), common::raw_odometry_line().into()),
        _ => {
            let scan = words::ScanOf { step: &step, last: &last }.say();
            (scan, common::UniverseCount { m: &model.setup().particles }.say())
        }
    };
    scene.heading(area, (&strong, Role::Ink), &rest);
}

fn map(scene: &mut Scene, model: &LogModel, area: Rect, view: Option<&MapView>) {
    scene.raster(area, Cells::row(&[UNKNOWN]), Shading::Map);
    if let Some(view) = view {
        if let Some((area, cells)) = model.seen().and_then(|seen| view.cells(&seen.map)) {
            scene.raster(area, cells, Shading::Map);
        }
        laid(scene, model, view);
        around(scene, &area);
        odometry(scene, model, &view.0);
        paths(scene, model, &view.0);
        astray(scene, model, &view.0);
        round_scale_bar(scene, &view.0);
    } else {
        let [_, y] = area.centre();
        let line = |y: f64| Rect::new(area.x, y, area.w, 22.0);
        scene.text(line(y - 22.0), strong(13.5, Role::Ink).middle(), words::no_log_open());
        scene.text(line(y), plain(12.5, Role::Muted).middle(), words::run_example());
    }
    scene.frame(area, 1.0, Role::Frame);
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
    for strip in strips {
        scene.fill(strip, Role::Paper);
    }
}

fn odometry(scene: &mut Scene, model: &LogModel, plane: &Plane) {
    let Some(log) = model.log().filter(|_| model.shows_raw()) else { return };
    // From the first scan on, as the map has it; up to the scan that is shown.
    let first = log.scans[0].odometry;
    let scans = &log.scans[..model.seen().map_or(log.scans.len(), |seen| seen.scans)];
    let placed = |pose: &Pose2| if model.mapper().is_some() { first.between(pose) } else { *pose };
    let lines = plane.path(&scans.iter().map(|scan| placed(&scan.odometry)).collect::<Vec<_>>(), 1.0);
    scene.dashed(lines, 1.5, RAW, Role::Raw);
}

/// What raw odometry alone would have drawn, over what is mapped.
fn laid(scene: &mut Scene, model: &LogModel, view: &MapView) {
    let (Some(laid), Some(seen)) = (model.compared(), model.seen()) else { return };
    let (area, cells) = view.marked(laid.cells(seen.step), seen.map.cell_size());
    scene.raster(area, cells, Shading::Glaze);
}

/// Where raw odometry has the robot, and from where the best universe has it.
fn astray(scene: &mut Scene, model: &LogModel, plane: &Plane) {
    let (Some(laid), Some(seen)) = (model.compared(), model.seen()) else { return };
    let Some(odometry) = laid.odometry(seen.step) else { return };
    scene.dashed(plane.path(&[seen.paths[seen.best].pose(), odometry], 0.0), 1.25, THRESHOLD, Role::Ink);
    scene.rimmed_robot(plane, &odometry, 9.0, Role::Raw);
}

/// The paths of all universes, and of those that died out a short while ago.
fn paths(scene: &mut Scene, model: &LogModel, plane: &Plane) {
    let Some(seen) = model.seen() else { return };
    let tree = Tree::new(seen);
    for age in (0..FADE).rev() {
        let dead = tree.dead.iter().filter(|(a, _)| *a == age);
        let lines = joined(dead, |(_, line)| plane.path(line, 1.0));
        if !lines.is_empty() {
            scene.lines(lines, DIED * f64::from(FADE - age) / f64::from(FADE), Role::Extinct);
        }
    }
    scene.lines(joined(tree.others.iter(), |line| plane.path(line, 1.0)), LIVES, Role::Copied);
    scene.lines(plane.path(&tree.best, 1.0), 2.0, Role::Path);
    let Seen { paths, best, .. } = seen;
    scene.polygons(paths.iter().filter_map(|path| plane.robot(&path.pose(), 5.0)).collect(), Role::Copied);
    scene.rimmed_robot(plane, &paths[*best].pose(), 9.0, Role::Path);
}

/// A round length, in the lower right corner.
fn round_scale_bar(scene: &mut Scene, plane: &Plane) {
    let metres = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 5000.0, 20000.0];
    let room = 0.25 * plane.area.w;
    let fitting = metres.into_iter().rev().find(|metres| metres * plane.scale <= room);
    scene.scale_bar(plane, fitting.unwrap_or(metres[0]), room);
}

/// The end of a gauge's label, and what is left before it.
fn value(scene: &mut Scene, label: &Rect, words: String) -> Rect {
    let letters = strong(SIZE, Role::Ink);
    let width = letters.width(&words) + 0.01;
    scene.text(Rect::new(label.right() - width, label.y, width, label.h), letters, &words);
    Rect::new(label.x, label.y, (label.w - width - 6.0).max(0.0), label.h)
}

/// A curve over the scans: a share of the chart's height for each step.
fn curve(scene: &mut Scene, model: &LogModel, chart: &Chart, share: impl Fn(&Moment) -> f64) -> Vec<Point> {
    chart.edges(scene);
    let points = chart.curve((1..).zip(model.all_history().iter().map(share)));
    let (shown, later) = points.split_at(model.history().len());
    let line = |points: &[Point]| thinned(&mut points.iter().copied(), 0.5);
    // What came after the scan that is shown steps back.
    if !later.is_empty() {
        let x = chart.x(model.step());
        scene.line(&line(later), 1.25, Role::Frame);
        scene.line(&[[x, chart.area.y], [x, chart.area.bottom()]], 1.5, Role::Path);
    }
    scene.line(&line(shown), 1.25, Role::Ink);
    points
}

/// N_eff, the threshold, and the steps that resampled.
fn ess(scene: &mut Scene, model: &LogModel, gauge: &Gauge) {
    let m = model.setup().particles;
    let now = model.history().last().map_or("–".into(), |moment| fixed(moment.ess, 1));
    let name = value(scene, &gauge.label, common::Of { n: &now, all: &m }.say());
    scene.n_eff(&name, NAME);
    let chart = &Chart { area: gauge.chart, last: model.step_count() };
    let points = curve(scene, model, chart, |moment| moment.ess / m as f64);
    if let ResamplePolicy::EssBelow(fraction) = model.setup().policy {
        scene.dash(&chart.level(fraction), 1.0, THRESHOLD, Role::Accent);
    }
    let resampled = points.iter().zip(model.all_history()).filter(|(_, moment)| moment.resampled);
    let lines = thinned(&mut resampled.map(|(at, _)| [at[0], chart.area.bottom()]), 0.75);
    scene.lines(lines.into_iter().map(|[x, y]| vec![[x, y], [x, y - TICK]]).collect(), 1.0, Role::Extinct);
}

/// Distinct ancestors some scans ago.
fn lineage(scene: &mut Scene, model: &LogModel, gauge: &Gauge) {
    let m = model.setup().particles;
    let now = model.history().last().map_or("–".into(), |moment| moment.lineage.to_string());
    let name = value(scene, &gauge.label, common::Of { n: &now, all: &m }.say());
    let names = [words::AncestorsAgo { back: &BACK }.say(), words::LineageBack { back: &BACK }.say()];
    scene.fit(name, NAME, &[&names[0], &names[1], common::lineage()]);
    let chart = Chart { area: gauge.chart, last: model.step_count() };
    curve(scene, model, &chart, |moment| f64::from(moment.lineage) / m as f64);
}

fn names(scene: &mut Scene, layout: &Layout, compared: bool) {
    let tick = |scene: &mut Scene, [x, y]: Point| {
        scene.line(&[[x, y - 0.5 * TICK], [x, y + 0.5 * TICK]], 1.25, Role::Extinct);
    };
    let of_map = [
        (Sample::cell(OCCUPIED), common::wall()),
        (Sample::cell(FREE), common::free()),
        (Sample::cell(UNKNOWN), common::unknown()),
        (Sample::line(Role::Path, 2.0, None), words::best()),
        (Sample::line(Role::Copied, LIVES, None), words::others()),
        (Sample::line(Role::Extinct, DIED, None), words::just_died()),
        (Sample::line(Role::Raw, 1.5, Some(RAW)), common::raw_odometry_line()),
    ];
    let of_gauges = [
        (Sample::at(tick), common::resampled()),
        (Sample::line(Role::Accent, 1.0, Some(THRESHOLD)), words::threshold()),
    ];
    let by_odometry = Sample::new(|scene, place| {
        let area = Rect::new(place.x, place.y + 0.5 * place.h - 2.0, place.w, 4.0);
        scene.raster(area, Cells::row(&[OCCUPIED]), Shading::Glaze);
    });
    let by_odometry = Some((by_odometry, words::by_odometry())).filter(|_| compared);
    let of_map = of_map.into_iter().chain(by_odometry).filter(|_| layout.map.is_some());
    let of_gauges = of_gauges.into_iter().filter(|_| layout.gauges.is_some());
    legend(scene, &layout.legend, of_map.chain(of_gauges));
}
