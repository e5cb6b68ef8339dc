//! What is to be seen: robots and landmark in the plane, the chain of steps with every number, and the decision.

use super::{
    layout::{LINE, Layout, NARROWEST, Place},
    model::WorkedExampleModel,
    steps::{DIGITS, GIVEN, STEPS, Step},
};
use crate::decimal::write;
use crate::{
    font::{self, Weight},
    model::Model,
    scene::{Anchor, Formula, Mark, Point, Rect, Role, Scene, closed, ellipse, number, robot, text},
};
use fastslam::map::landmarks::Landmark;
use fastslam_lab::experiment::worked_example::{Update, WorkedExample};

/// Font sizes of formulas and values, and of words \[css px\].
const SIZE: f64 = 14.5;
const WORDS: f64 = 12.0;

/// Standard deviations from the middle of an ellipse to its edge.
const SIGMAS: f64 = 2.0;

/// The whole figure at this width \[css px\].
pub fn build(model: &WorkedExampleModel, width: f64) -> Scene {
    let layout = Layout::new(width);
    let example = model.example();
    let mut scene = Scene::new(width.max(NARROWEST), layout.height, model.describe());
    plot(&mut scene, example, &layout.plot);
    legend(&mut scene, &layout.legend);
    for (step, place) in GIVEN.iter().zip(&layout.given) {
        label(&mut scene, step, &place.label);
        value(&mut scene, &place.value, |line| (step.write)(line, example, 0));
    }
    let mut rules = Vec::new();
    for slot in [0, 1] {
        let head = layout.heads[slot];
        let colour = Rect::new(head.x, head.y + 0.5 * head.h - 5.0, 10.0, 10.0);
        scene.marks.push(Mark::Fill { area: colour, role: Role::Particle(slot as u8) });
        let name = Rect::new(head.x + 17.0, head.y, head.w - 17.0, head.h);
        let title = format!("Particle {}", slot + 1);
        scene.marks.push(text(name, Anchor::Start, SIZE, Weight::SemiBold, Role::Ink, title));
        for (step, place) in STEPS.iter().zip(&layout.steps[slot]) {
            if slot == 0 || !layout.wide {
                label(&mut scene, step, &place.label);
                rules.push(rule(&layout, place));
            }
            value(&mut scene, &place.value, |line| (step.write)(line, example, slot));
        }
    }
    rules.push(rule(&layout, &layout.selection));
    scene.marks.push(Mark::Lines { lines: rules, width: 1.0, dash: None, role: Role::Frame });
    selection(&mut scene, model, &layout);
    scene
}

/// The line above a step.
fn rule(layout: &Layout, place: &Place) -> Vec<Point> {
    let y = place.label.y.round() + 0.5;
    vec![[0.0, y], [layout.selection.value.right(), y]]
}

/// Caption and formula of a step, below each other.
fn label(scene: &mut Scene, step: &Step, area: &Rect) {
    let caption = Rect::new(area.x, area.y + 0.5 * area.h - LINE, area.w, LINE);
    let formula = Rect::new(area.x, caption.bottom(), area.w - 8.0, LINE);
    scene.marks.push(text(caption, Anchor::Start, WORDS, Weight::Regular, Role::Muted, step.caption));
    value(scene, &formula, |line| line.tex(step.formula));
}

/// A line of mathematics at the left of an area, smaller if there is no room for it.
fn value(scene: &mut Scene, area: &Rect, write: impl Fn(Formula) -> Formula) {
    let line = |size| write(Formula::new(size, Weight::Regular, Role::Ink));
    let full = line(SIZE);
    let fitting = if full.width() > area.w { line(0.99 * SIZE * area.w / full.width()) } else { full };
    fitting.draw(scene, [area.x, area.y + 0.5 * area.h]);
}

/// From metres to css px.
struct View {
    area: Rect,
    scale: f64,
    /// What is in the middle \[m\].
    middle: [f64; 2],
}

impl View {
    /// With everything that is drawn in it.
    fn new(example: &WorkedExample, area: Rect) -> Self {
        let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let mut put = |x: f64, y: f64, [dx, dy]: [f64; 2]| {
            for ([low, high], (x, d)) in ends.iter_mut().zip([(x, dx), (y, dy)]) {
                (*low, *high) = (low.min(x - d), high.max(x + d));
            }
        };
        let reach = |landmark: &Landmark| {
            let covariance = &landmark.covariance;
            [covariance.m11, covariance.m22].map(|variance| SIGMAS * variance.max(0.0).sqrt())
        };
        put(example.before.mean.x, example.before.mean.y, reach(&example.before));
        for Update { world_from_robot, seen_at, after, .. } in &example.updates {
            put(world_from_robot.x, world_from_robot.y, [0.0; 2]);
            put(seen_at.x, seen_at.y, [0.0; 2]);
            put(after.mean.x, after.mean.y, reach(after));
        }
        let [w, h] = ends.map(|[low, high]| (high - low).max(1e-3));
        let inner = area.inset(18.0);
        Self { area, scale: (inner.w / w).min(inner.h / h), middle: ends.map(|[low, high]| 0.5 * (low + high)) }
    }

    fn at(&self, x: f64, y: f64) -> Point {
        let [u, v] = self.area.centre();
        [u + self.scale * (x - self.middle[0]), v - self.scale * (y - self.middle[1])]
    }

    fn ellipse(&self, landmark: &Landmark) -> Vec<Point> {
        let (c, px) = (&landmark.covariance, self.scale * self.scale);
        let covariance = [[px * c.m11, -px * c.m12], [-px * c.m21, px * c.m22]];
        closed(ellipse(self.at(landmark.mean.x, landmark.mean.y), covariance, SIGMAS))
    }
}

/// Robots, what they see, and the landmark before and after.
fn plot(scene: &mut Scene, example: &WorkedExample, area: &Rect) {
    let view = View::new(example, *area);
    let marks = &mut scene.marks;
    let mean = |landmark: &Landmark| view.at(landmark.mean.x, landmark.mean.y);
    let ring = |landmark: &Landmark, width: f64, role: Role| {
        [
            Mark::Lines { lines: vec![view.ellipse(landmark)], width, dash: None, role },
            Mark::Discs { centres: vec![mean(landmark)], radius: 2.5, role },
        ]
    };
    marks.extend(ring(&example.before, 2.0, Role::Landmark));
    for (slot, update) in example.updates.iter().enumerate() {
        let role = Role::Particle(slot as u8);
        let [from, to] =
            [[update.world_from_robot.x, update.world_from_robot.y], update.seen_at.into()].map(|[x, y]| view.at(x, y));
        marks.push(Mark::Lines { lines: vec![vec![from, to]], width: 1.25, dash: Some([5.0, 4.0]), role });
        marks.extend(ring(&update.after, 1.25, role));
        marks.push(cross(to, role));
    }
    for (slot, length) in [(0, 13.0), (1, 8.0)] {
        let pose = &example.updates[slot].world_from_robot;
        let corners = robot(view.at(pose.x, pose.y), pose.theta, length);
        let rim = Mark::Lines { lines: vec![closed(corners.clone())], width: 2.5, dash: None, role: Role::Paper };
        marks.extend([rim, Mark::Polygons { polygons: vec![corners], role: Role::Particle(slot as u8) }]);
    }
    // The power of ten that takes up to half of the width.
    let mut length = 1e-3;
    while 10.0 * length * view.scale <= 0.5 * area.w {
        length *= 10.0;
    }
    let (x, y) = (area.x + 10.0, area.bottom() - 8.0);
    let end = x + (length * view.scale).min(area.w - 20.0);
    let bar = vec![[x, y - 3.0], [x, y], [end, y], [end, y - 3.0]];
    marks.push(Mark::Lines { lines: vec![bar], width: 1.0, dash: None, role: Role::Ink });
    let name = Rect::new(x, y - 17.0, 70.0, 14.0);
    marks.push(text(name, Anchor::Start, 10.5, Weight::Regular, Role::Ink, format!("{} m", write(length))));
    marks.push(Mark::Frame { area: *area, width: 1.0, role: Role::Frame });
}

fn cross([x, y]: Point, role: Role) -> Mark {
    let d = 4.0;
    let lines = vec![vec![[x - d, y - d], [x + d, y + d]], vec![[x - d, y + d], [x + d, y - d]]];
    Mark::Lines { lines, width: 2.0, dash: None, role }
}

/// What the drawing shows.
fn legend(scene: &mut Scene, area: &Rect) {
    let [mut x, mut y] = [area.x, area.y];
    for (name, role) in [
        ("landmark before, 2 σ", Role::Landmark),
        ("particle 1: sighting, landmark after", Role::Particle(0)),
        ("particle 2: sighting, landmark after", Role::Particle(1)),
    ] {
        let (sees, w) = (role != Role::Landmark, font::measure(name, WORDS, Weight::Regular));
        let sample = if sees { 60.0 } else { 26.0 };
        if x > area.x && x + sample + w > area.right() {
            (x, y) = (area.x, y + LINE);
        }
        let middle = y + 0.5 * LINE;
        if sees {
            let lines = vec![vec![[x, middle], [x + 20.0, middle]]];
            scene.marks.push(Mark::Lines { lines, width: 1.25, dash: Some([5.0, 4.0]), role });
            scene.marks.push(cross([x + 22.0, middle], role));
        }
        let centre = [x + sample - 16.0, middle];
        let lines = vec![closed(ellipse(centre, [[64.0, 0.0], [0.0, 25.0]], 1.0))];
        scene.marks.push(Mark::Lines { lines, width: if sees { 1.25 } else { 2.0 }, dash: None, role });
        scene.marks.push(Mark::Discs { centres: vec![centre], radius: 2.0, role });
        let words = Rect::new(x + sample, y, w, LINE);
        scene.marks.push(text(words, Anchor::Start, WORDS, Weight::Regular, Role::Muted, name));
        x = words.right() + 14.0;
    }
}

/// N_eff on its scale from nothing to M, against the threshold, and what follows.
fn selection(scene: &mut Scene, model: &WorkedExampleModel, layout: &Layout) {
    let WorkedExample { ess, limit, resamples, .. } = model.example();
    let Place { label: place, value: area } = layout.selection;
    let caption = Rect::new(place.x, place.y + 0.5 * place.h - LINE, place.w, LINE);
    let words = "Effective number of particles";
    scene.marks.push(text(caption, Anchor::Start, WORDS, Weight::Regular, Role::Muted, words));
    let formula = Rect::new(place.x, caption.bottom(), place.w, LINE);
    let number_of = format!("N_{{eff}} = 1 / Σ w\u{303}^2 = {}", number(*ess, DIGITS));
    value(scene, &formula, |line| line.tex(&number_of));
    let role = if *resamples { Role::Copied } else { Role::Accent };
    let line = Rect::new(area.x, area.y + 6.0, area.w, 26.0);
    scene.marks.push(text(line, Anchor::Start, 17.0, Weight::SemiBold, role, model.verdict()));

    let bar = Rect::new(area.x + 14.0, line.bottom() + 8.0, area.w - 32.0, 10.0);
    let at = |ess: f64| bar.x + bar.w * ess / model.example().updates.len() as f64;
    for (name, x, anchor) in [("0", area.x, Anchor::Start), ("2", bar.right() + 4.0, Anchor::End)] {
        let end = Rect::new(x, bar.y - 3.0, 14.0, 16.0);
        scene.marks.push(text(end, anchor, WORDS, Weight::Regular, Role::Muted, name));
    }
    scene.marks.push(Mark::Fill { area: Rect { w: at(*ess) - bar.x, ..bar }, role });
    scene.marks.push(Mark::Frame { area: bar, width: 1.0, role: Role::Weight(0) });
    let x = at(*limit);
    let lines = vec![vec![[x, bar.y - 5.0], [x, bar.bottom() + 5.0]]];
    scene.marks.push(Mark::Lines { lines: lines.clone(), width: 5.0, dash: None, role: Role::Paper });
    scene.marks.push(Mark::Lines { lines, width: 2.0, dash: None, role: Role::Ink });
    let name = format!("threshold · M = {}", number(*limit, DIGITS));
    let w = font::measure(&name, WORDS, Weight::Regular);
    // Not `clamp`: its panic writes both ends, which takes 20 KB.
    let left = (x - 0.5 * w).min(area.right() - w).max(area.x);
    let under = Rect::new(left, bar.bottom() + 6.0, w, LINE);
    scene.marks.push(text(under, Anchor::Start, WORDS, Weight::Regular, Role::Ink, name));
}
