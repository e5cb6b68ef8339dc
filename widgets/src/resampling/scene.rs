//! What is to be seen of the three filters: curves over the steps, the tree of their ancestry, and where their particles are.

use super::{
    layout::{Column, LINE, Layout, NARROWEST},
    model::{Moment, ResamplingModel, SELECTIVE},
};
use crate::decimal::{fixed, write};
use crate::{
    font::{self, Weight},
    model::Model,
    scene::{Anchor, Handle, Mark, Point, Rect, Role, Scene, Text, clip_polyline, heading, text},
};
use fastslam::{geometry::Pose2, ops};

/// Name of the handle that chooses the step read.
pub const CURSOR: &str = "cursor";

/// Font size of what is written above the charts \[css px\].
const SIZE: f64 = 11.5;

/// Dash and gap of the second curve of a chart and of the threshold, and from dot to dot where something happens \[css px\].
const SECOND: [f64; 2] = [4.0, 3.0];
const THRESHOLD: [f64; 2] = [2.0, 2.0];
const EVENT: f64 = 4.0;

/// Strength of a branch that died out, of 255.
const DEAD: u8 = 25;

/// The whole figure at this size \[css px\].
pub fn build(model: &ResamplingModel, width: f64, height: f64) -> Scene {
    let layout = Layout::new(width);
    let mut scene = Scene {
        width: width.max(NARROWEST),
        height: height.max(layout.height),
        marks: Vec::new(),
        regions: Vec::new(),
        handles: Vec::new(),
        description: model.describe(),
    };
    let error_scale = error_scale(model.largest_error());
    for (policy, column) in layout.columns.iter().enumerate() {
        let filter = Filter { model, policy, column, error_scale };
        filter.header(&mut scene);
        filter.cursor(&mut scene);
        filter.ess(&mut scene);
        filter.lineage(&mut scene);
        filter.errors(&mut scene);
        filter.tree(&mut scene);
        filter.axis(&mut scene);
        filter.map(&mut scene, layout.wide);
    }
    legend(&mut scene, model, &layout.legend);
    let (chart, step) = (&layout.columns[0].charts[0], model.cursor());
    scene.handles.push(Handle {
        name: CURSOR,
        title: "Step read".into(),
        at: [chart.x + chart.w * share(model, step), chart.centre()[1]],
        value: f64::from(step),
        text: told(model),
        hover: Some(layout.charts()),
    });
    scene
}

/// What the cursor reads, in words.
fn told(model: &ResamplingModel) -> String {
    let of = |policy| {
        let Moment { report, .. } = model.read(policy);
        format!("N_eff {}, lineage {}", fixed(report.ess, 1), report.descent.lineage(report.step))
    };
    format!("step {}: never {}; every step {}; selective {}", model.cursor(), of(0), of(1), of(2))
}

const NAMES: [&str; 3] = ["Never", "Every step", "Selective"];

/// Where a step is, as a share of the timeline.
fn share(model: &ResamplingModel, step: u32) -> f64 {
    f64::from(step) / f64::from(model.step_count())
}

/// The end of the axis for errors up to this \[m\]: a round number.
fn error_scale(largest: f64) -> f64 {
    [0.2, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0]
        .into_iter()
        .find(|end| largest <= *end)
        .unwrap_or(50.0)
}

/// A line of descent in the tree.
#[derive(Clone)]
struct Line {
    points: Vec<Point>,
    lives: bool,
}

impl Line {
    /// On to a point; what goes straight on in its slot is one piece.
    fn go(&mut self, [x, y]: Point) {
        match &mut self.points[..] {
            [.., [_, y0], last @ [_, _]] if *y0 == y && last[1] == y => last[0] = x,
            _ => self.points.push([x, y]),
        }
    }
}

/// One filter in its column.
struct Filter<'a> {
    model: &'a ResamplingModel,
    policy: usize,
    column: &'a Column,
    /// End of the axis of errors \[m\].
    error_scale: f64,
}

impl Filter<'_> {
    /// Position of a step \[css px\].
    fn x(&self, step: u32) -> f64 {
        let chart = &self.column.charts[0];
        chart.x + chart.w * share(self.model, step)
    }

    fn particles(&self) -> usize {
        self.model.setup().particles
    }

    fn header(&self, scene: &mut Scene) {
        let Rect { x, y, w, h } = self.column.header;
        let step = format!("step {}", self.model.cursor());
        let role = if self.model.looks_back() { Role::Accent } else { Role::Muted };
        let step_width = font::measure(&step, 12.5, Weight::Regular) + 2.0;
        let rest = match self.policy {
            0 => "weights only multiply".into(),
            1 => "weights reset".into(),
            _ => format!("below {} M", write(self.model.setup().threshold)),
        };
        let title = Rect::new(x, y, w - step_width - 8.0, h);
        let room = title.w - font::measure(NAMES[self.policy], 13.5, Weight::SemiBold) - 8.0;
        let rest = if font::measure(&rest, 12.5, Weight::Regular) < room { &rest } else { "" };
        heading(scene, &title, (NAMES[self.policy], Role::Ink), rest);
        let area = Rect::new(x + w - step_width, y, step_width, h);
        scene.marks.push(text(area, Anchor::End, 12.5, Weight::Regular, role, step));
    }

    /// A line through all charts at the step read, and at what happens on the course.
    fn cursor(&self, scene: &mut Scene) {
        let through = |step: u32| {
            let x = self.x(step);
            self.column.charts.iter().map(move |chart| (x, chart.y, chart.bottom()))
        };
        let events = self.events().into_iter().flat_map(|(step, _)| through(step));
        let dots = events.flat_map(|(x, y0, y1)| {
            let count = ((y1 - y0) / EVENT) as usize;
            (0..count).map(move |k| y0 + EVENT * k as f64).map(move |y| vec![[x, y], [x, y + 1.0]])
        });
        scene.marks.push(Mark::Strands { lines: dots.collect(), width: 1.0, role: Role::Muted });
        let role = if self.model.looks_back() { Role::Accent } else { Role::Muted };
        let lines = through(self.model.cursor()).map(|(x, y0, y1)| vec![[x, y0], [x, y1]]).collect();
        scene.marks.push(Mark::Strands { lines, width: 1.0, role });
    }

    /// Steps of the course that have a name.
    fn events(&self) -> Vec<(u32, &'static str)> {
        let run = self.model.run();
        let named = [(run.lost_from(), "lost"), (run.evidence_at(), "sign")];
        named.into_iter().filter_map(|(step, name)| Some((step?, name))).collect()
    }

    /// Name of a chart at the left of its line, and at the right what is written beside its curves.
    fn label(&self, scene: &mut Scene, chart: usize, values: &[(String, Weight, Role)]) -> Rect {
        let Rect { x, y, w, h } = self.column.labels[chart];
        let mut right = x + w;
        for (value, weight, role) in values.iter().rev() {
            let width = font::measure(value, SIZE, *weight) + 0.01;
            scene.marks.push(text(
                Rect::new(right - width, y, width, h),
                Anchor::Start,
                SIZE,
                *weight,
                *role,
                value.clone(),
            ));
            right -= width + 8.0;
        }
        Rect::new(x, y, right - x, h)
    }

    fn name(&self, scene: &mut Scene, area: &Rect, name: &str) {
        scene.marks.push(text(*area, Anchor::Start, SIZE, Weight::Regular, Role::Muted, name));
    }

    /// A curve over the steps shown, by the share of the chart's height.
    fn curve(&self, chart: usize, height: impl Fn(&Moment) -> f64) -> Vec<Point> {
        let area = &self.column.charts[chart];
        let point = |m: &Moment| [self.x(m.report.step), area.bottom() - area.h * height(m).clamp(0.0, 1.0)];
        self.model.history(self.policy).map(point).collect()
    }

    /// The ends of a chart's axis.
    fn frame(&self, scene: &mut Scene, chart: usize) {
        let Rect { x, y, w, h } = self.column.charts[chart];
        for y in [y, y + h] {
            scene.marks.push(Mark::Fill { area: Rect::new(x, y - 0.5, w, 1.0), role: Role::Frame });
        }
    }

    /// Where N_eff calls for resampling.
    fn threshold(&self, scene: &mut Scene) {
        let Rect { x, w, h, .. } = self.column.charts[0];
        let y = self.column.charts[0].bottom() - h * self.model.setup().threshold;
        let [dash, gap] = THRESHOLD;
        let count = ((w / (dash + gap)) as usize).min(1000); // whatever the width of the figure
        let dashes = (0..count).map(|k| x + (dash + gap) * k as f64);
        let lines = dashes.map(|x| vec![[x, y], [x + dash, y]]).collect();
        let role = if self.policy == SELECTIVE { Role::Accent } else { Role::Muted };
        scene.marks.push(Mark::Strands { lines, width: 1.0, role });
    }

    /// Two curves, the second dashed below the first, and dots where the cursor cuts them.
    fn curves(&self, scene: &mut Scene, first: Vec<Point>, second: Option<Vec<Point>>) {
        let at = self.model.cursor() as usize;
        let mut dots = vec![first[at]];
        if let Some(second) = second {
            dots.push(second[at]);
            scene.marks.push(Mark::Lines { lines: vec![second], width: 1.25, dash: Some(SECOND), role: Role::Muted });
        }
        scene.marks.push(Mark::Lines { lines: vec![first], width: 1.5, dash: None, role: Role::Ink });
        scene.marks.push(Mark::Discs { centres: dots, radius: 3.0, role: Role::Ink });
    }

    /// N_eff, the threshold, and the steps that resampled.
    fn ess(&self, scene: &mut Scene) {
        let (m, Moment { report, resampled, .. }) = (self.particles() as f64, self.model.read(self.policy));
        let times = format!("resampled {resampled}×");
        let values = [
            (times, Weight::Regular, if *resampled > 0 { Role::Copied } else { Role::Muted }),
            (format!("{} of {}", fixed(report.ess, 1), self.particles()), Weight::SemiBold, Role::Ink),
        ];
        let rest = self.label(scene, 0, &values);
        n_eff(scene, &rest, Role::Muted);
        self.frame(scene, 0);
        self.threshold(scene);
        let curve = self.curve(0, |moment| moment.report.ess / m);
        let history = self.model.history(self.policy).zip(&curve);
        let centres = history.filter(|(moment, _)| moment.report.resampled()).map(|(_, at)| *at).collect();
        self.curves(scene, curve.clone(), None);
        scene.marks.push(Mark::Discs { centres, radius: 1.75, role: Role::Copied });
    }

    /// Distinct ancestors at the start, and some steps back.
    fn lineage(&self, scene: &mut Scene) {
        let (m, back) = (self.particles() as f64, self.model.back());
        let Moment { report, .. } = self.model.read(self.policy);
        let values = [
            (format!("{back} back: {}", report.descent.lineage(back)), Weight::Regular, Role::Muted),
            (format!("at the start: {}", report.descent.lineage(report.step)), Weight::SemiBold, Role::Ink),
        ];
        let rest = self.label(scene, 1, &values);
        self.name(scene, &rest, "Ancestors");
        self.frame(scene, 1);
        let of = |back: u32| self.curve(1, |moment| f64::from(moment.report.descent.lineage(back)) / m);
        self.curves(scene, of(u32::MAX), Some(of(back)));
    }

    /// Position errors of the best particle and of the weighted mean.
    fn errors(&self, scene: &mut Scene) {
        let Moment { report, .. } = self.model.read(self.policy);
        // Three digits, for want of room.
        let metres = |x: f64| fixed(x, if x < 10.0 { 2 } else { 1 });
        let values = [
            (format!("mean {}", metres(report.error_mean)), Weight::Regular, Role::Muted),
            (format!("best {} m", metres(report.error_best)), Weight::SemiBold, Role::Ink),
        ];
        let rest = self.label(scene, 2, &values);
        self.name(scene, &rest, &format!("Error to {} m", write(self.error_scale)));
        self.frame(scene, 2);
        let best = self.curve(2, |moment| moment.report.error_best / self.error_scale);
        let mean = self.curve(2, |moment| moment.report.error_mean / self.error_scale);
        self.curves(scene, best, Some(mean));
    }

    /// Who descends from whom: every edge once.
    fn tree(&self, scene: &mut Scene) {
        let Moment { report, .. } = self.model.read(self.policy);
        let size = format!("{} of {} nodes", report.tree_nodes(), report.path_nodes(self.particles()));
        let rest = self.label(scene, 3, &[(size, Weight::SemiBold, Role::Ink)]);
        self.name(scene, &rest, "Ancestry tree");

        let alive = self.model.alive(self.policy);
        let [mut dead, mut living] = [Vec::new(), Vec::new()];
        let mut close = |line: Line| if line.lives { living.push(line.points) } else { dead.push(line.points) };
        // The lines that end at the step before, by slot: one child of each goes on with its line.
        let mut open: Vec<Option<Line>> = vec![None; self.particles()];
        for ((before, step), alive) in self.model.history(self.policy).zip(1..).zip(&alive[1..]) {
            let mut longer = vec![None; self.particles()];
            for (to, &lives) in alive.iter().enumerate() {
                let from = before.copied_from(to);
                let line = open[from].take_if(|line| line.lives == lives);
                let mut line = line.unwrap_or_else(|| Line { points: vec![self.node(step - 1, from)], lives });
                line.go(self.node(step, to));
                longer[to] = Some(line);
            }
            core::mem::replace(&mut open, longer).into_iter().flatten().for_each(&mut close);
        }
        open.into_iter().flatten().for_each(close);
        let apart = self.column.charts[3].h / self.particles() as f64;
        scene.marks.push(Mark::Strands { lines: dead, width: (0.16 * apart).clamp(0.6, 1.0), role: Role::Level(DEAD) });
        scene.marks.push(Mark::Strands { lines: living, width: (0.3 * apart).clamp(1.0, 2.0), role: Role::Path });
        self.coalescence(scene, &alive);
    }

    /// The latest common ancestor of all particles.
    fn coalescence(&self, scene: &mut Scene, alive: &[Vec<bool>]) {
        let Some(step) = self.model.now(self.policy).report.descent.coalescence() else { return };
        let Some(slot) = alive[step as usize].iter().position(|alive| *alive) else { return };
        let at = self.node(step, slot);
        scene.marks.push(Mark::Discs { centres: vec![at], radius: 6.0, role: Role::Paper });
        common(scene, at);
    }

    /// Where a particle of a step is drawn.
    fn node(&self, step: u32, slot: usize) -> Point {
        let area = &self.column.charts[3];
        [self.x(step), area.y + area.h * (slot as f64 + 0.5) / self.particles() as f64]
    }

    /// Steps below the tree.
    fn axis(&self, scene: &mut Scene) {
        let Rect { x, y, w, h } = self.column.axis;
        let size = 10.5;
        let mut taken: Vec<[f64; 2]> = Vec::new();
        let last = self.model.step_count();
        let ancestor = self.model.now(self.policy).report.descent.coalescence();
        let ancestor = ancestor.map(|step| (step, format!("step {step}"), true));
        let [start, end] = [(0, "step 0".to_string(), false), (last, last.to_string(), false)];
        let events = self.events().into_iter().map(|(step, name)| (step, name.to_string(), false));
        for (step, label, ring) in ancestor.into_iter().chain([start]).chain(events).chain([end]) {
            let room = if ring { 12.0 } else { 0.0 };
            let width = room + font::measure(&label, size, Weight::Regular) + 0.01;
            // A ring stands below the one in the tree, with its step beside it.
            let wanted = self.x(step) - if ring { 4.5 } else { 0.5 * width };
            let left = wanted.min(x + w - width).max(x);
            if taken.iter().any(|[from, to]| left < *to + 6.0 && *from < left + width + 6.0) {
                continue;
            }
            taken.push([left, left + width]);
            if ring {
                common(scene, [left + 4.5, y + 0.5 * h]);
            }
            let role = if ring { Role::Ink } else { Role::Muted };
            let area = Rect::new(left + room, y, width - room, h);
            scene.marks.push(text(area, Anchor::Start, size, Weight::Regular, role, label));
        }
    }

    /// Where the particles are, and the robot.
    fn map(&self, scene: &mut Scene, wide: bool) {
        let (model, area, label) = (self.model, self.column.map, self.column.map_label);
        let Moment { report, poses, best, .. } = model.read(self.policy);
        let lines = [0.0, 1.0].map(|k| Rect::new(label.x, label.y + k * LINE, label.w, LINE));
        let (name, says) = if wide { ("Particles", lines[0]) } else { (NAMES[self.policy], lines[1]) };
        let role = if wide { Role::Muted } else { Role::Ink };
        let weight = if wide { Weight::Regular } else { Weight::SemiBold };
        let anchor = if wide { Anchor::End } else { Anchor::Start };
        scene.marks.push(text(lines[0], Anchor::Start, SIZE, weight, role, name));
        let m = self.particles();
        match (report.right, model.run().lost_from()) {
            (Some(0), _) => {
                scene.marks.push(text(says, anchor, SIZE, Weight::SemiBold, Role::Extinct, "right wing lost"))
            }
            (Some(n), _) if wide => {
                let says_it = format!("right wing: {n} of {m}");
                scene.marks.push(text(says, anchor, SIZE, Weight::SemiBold, Role::Accent, says_it));
            }
            (Some(n), _) => {
                scene.marks.push(text(says, anchor, SIZE, Weight::Regular, Role::Accent, format!("{n} of {m} right")));
            }
            (None, Some(_)) => scene.marks.push(text(says, anchor, SIZE, Weight::Regular, Role::Muted, "not lost yet")),
            (None, None) => (),
        }

        let view = View::new(model, &area);
        let role = Role::Muted;
        if let Some(world) = model.run().lap_world() {
            let lines = world.plan.walls.iter().map(|s| vec![view.point(s.a), view.point(s.b)]).collect();
            scene.marks.push(Mark::Lines { lines, width: 1.0, dash: None, role });
        }
        if let Some(log) = model.run().wings_log() {
            let diamonds = log.landmarks.iter().map(|m| diamond(view.point([m.x, m.y]), 2.75)).collect();
            scene.marks.push(Mark::Polygons { polygons: diamonds, role: Role::Landmark });
        }
        let truth = &model.run().truth()[..=report.step as usize];
        let path: Vec<Point> = truth.iter().map(|p| view.point([p.x, p.y])).collect();
        scene.marks.push(Mark::Lines { lines: vec![path], width: 1.0, dash: Some([2.0, 3.0]), role: Role::Truth });
        let noses = poses.iter().map(|pose| view.nose(pose, 6.0));
        let noses = noses.flat_map(|line| clip_polyline(&line, &area)).collect();
        scene.marks.push(Mark::Lines { lines: noses, width: 1.0, dash: None, role: Role::Path });
        let dots = poses.iter().map(|p| view.point([p.x, p.y])).filter(|p| area.inset(2.0).contains(*p)).collect();
        scene.marks.push(Mark::Discs { centres: dots, radius: 2.0, role: Role::Path });
        let there = truth[truth.len() - 1];
        let ring = [view.robot(&there, 9.0)].into_iter().filter(|c| c.iter().all(|p| area.contains(*p)));
        let outlines = ring.map(crate::scene::closed).collect();
        scene.marks.push(Mark::Lines { lines: outlines, width: 1.5, dash: None, role: Role::Truth });
        let head = [view.robot(&poses[*best], 6.0)].into_iter().filter(|c| c.iter().all(|p| area.contains(*p)));
        scene.marks.push(Mark::Polygons { polygons: head.collect(), role: Role::Path });
        scene.marks.push(Mark::Frame { area, width: 1.0, role: Role::Frame });
    }
}

/// The mark of a common ancestor.
fn common(scene: &mut Scene, at: Point) {
    for (radius, role) in [(4.5, Role::Ink), (2.5, Role::Paper)] {
        scene.marks.push(Mark::Discs { centres: vec![at], radius, role });
    }
}

/// N with its index.
fn n_eff(scene: &mut Scene, area: &Rect, role: Role) {
    let n = Text::new(*area, Anchor::Start, SIZE, Weight::Regular, role, "N");
    let index = Rect::new(area.x + n.width() + 0.5, area.y + 3.5, 20.0, area.h);
    scene.marks.push(Mark::Text(n));
    scene.marks.push(text(index, Anchor::Start, 8.5, Weight::Regular, role, "eff"));
}

/// The course at a place in the figure.
struct View {
    /// Middle of the course \[m\], and where it is drawn \[css px\].
    middle: [f64; 2],
    at: Point,
    /// Css px per metre.
    scale: f64,
}

impl View {
    fn new(model: &ResamplingModel, area: &Rect) -> Self {
        let run = model.run();
        let mut points: Vec<[f64; 2]> = run.truth().iter().map(|pose| [pose.x, pose.y]).collect();
        points.extend(run.wings_log().iter().flat_map(|log| log.landmarks.iter().map(|m| [m.x, m.y])));
        points.extend(run.lap_world().iter().flat_map(|world| [[0.0, 0.0], world.plan.size]));
        let least = [0, 1].map(|k| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min));
        let most = [0, 1].map(|k| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max));
        let room = area.inset(6.0);
        let scale = (room.w / (most[0] - least[0])).min(room.h / (most[1] - least[1]));
        Self { middle: [0, 1].map(|k| 0.5 * (least[k] + most[k])), at: area.centre(), scale }
    }

    fn point(&self, [x, y]: [f64; 2]) -> Point {
        [self.at[0] + (x - self.middle[0]) * self.scale, self.at[1] - (y - self.middle[1]) * self.scale]
    }

    /// From a pose to where it looks.
    fn nose(&self, pose: &Pose2, length: f64) -> Vec<Point> {
        let [x, y] = self.point([pose.x, pose.y]);
        let (sin, cos) = ops::sin_cos(pose.theta);
        vec![[x, y], [x + length * cos, y - length * sin]]
    }

    /// An arrow head that points where the robot looks.
    fn robot(&self, pose: &Pose2, length: f64) -> Vec<Point> {
        let [x, y] = self.point([pose.x, pose.y]);
        let (sin, cos) = ops::sin_cos(pose.theta);
        let corners = [[1.0, 0.0], [-0.8, 0.75], [-0.4, 0.0], [-0.8, -0.75]];
        let corner = |[along, across]: [f64; 2]| {
            [x + length * (along * cos - across * sin), y - length * (along * sin + across * cos)]
        };
        corners.map(corner).to_vec()
    }
}

fn diamond([x, y]: Point, r: f64) -> Vec<Point> {
    vec![[x - r, y], [x, y - r], [x + r, y], [x, y + r]]
}

/// What a legend's sample looks like.
#[derive(Clone, Copy)]
enum Sample {
    Line(Role, f64, Option<[f64; 2]>),
    Dot(Role, f64),
    Ring,
    Robot(Role),
    Landmark,
}

fn legend(scene: &mut Scene, model: &ResamplingModel, area: &Rect) {
    let back = format!("{} back, or weighted mean", model.back());
    let mut items = vec![
        (Sample::Line(Role::Ink, 1.5, None), "at the start, or best particle"),
        (Sample::Line(Role::Muted, 1.25, Some(SECOND)), back.as_str()),
        (Sample::Line(Role::Accent, 1.0, Some(THRESHOLD)), "threshold"),
        (Sample::Dot(Role::Copied, 1.75), "resampled"),
        (Sample::Line(Role::Path, 2.0, None), "lives on"),
        (Sample::Line(Role::Level(DEAD), 1.0, None), "died out"),
        (Sample::Ring, "last common ancestor"),
        (Sample::Dot(Role::Path, 2.0), "particle"),
        (Sample::Robot(Role::Truth), "truth"),
    ];
    if model.run().wings_log().is_some() {
        items.push((Sample::Landmark, "landmark"));
    }
    let (width, gap) = (18.0, 14.0);
    let [mut x, mut y] = [area.x, area.y];
    for (sample, name) in items {
        let name_width = font::measure(name, SIZE, Weight::Regular) + 0.01;
        if x > area.x && x + width + 5.0 + name_width > area.right() {
            (x, y) = (area.x, y + LINE);
        }
        draw_sample(scene, sample, &Rect::new(x, y, width, LINE));
        let place = Rect::new(x + width + 5.0, y, name_width, LINE);
        scene.marks.push(text(place, Anchor::Start, SIZE, Weight::Regular, Role::Muted, name));
        x = place.right() + gap;
    }
}

fn draw_sample(scene: &mut Scene, sample: Sample, place: &Rect) {
    let ([cx, cy], marks) = (place.centre(), &mut scene.marks);
    match sample {
        Sample::Line(role, width, dash) => {
            marks.push(Mark::Lines { lines: vec![vec![[place.x, cy], [place.right(), cy]]], width, dash, role });
        }
        Sample::Dot(role, radius) => marks.push(Mark::Discs { centres: vec![[cx, cy]], radius, role }),
        Sample::Ring => common(scene, [cx, cy]),
        Sample::Robot(role) => {
            let view = View { middle: [0.0; 2], at: [cx - 1.0, cy], scale: 1.0 };
            let lines = vec![crate::scene::closed(view.robot(&Pose2::default(), 7.0))];
            marks.push(Mark::Lines { lines, width: 1.5, dash: None, role });
        }
        Sample::Landmark => marks.push(Mark::Polygons { polygons: vec![diamond([cx, cy], 3.5)], role: Role::Landmark }),
    }
}
