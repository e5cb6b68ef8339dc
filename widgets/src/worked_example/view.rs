//! What is to be seen: robots and landmark in the plane, the chain of steps with every number, and the decision.

use super::{
    layout::{CHAIN, Chain, Layout, NARROWEST, PLOT, Place, START},
    model::WorkedExampleModel,
    steps::{DIGITS, GIVEN, STEPS, Step},
};
use crate::decimal::write;
use crate::{
    font::{self, Weight},
    panels::Panels,
    scene::{
        Anchor, Formula, LINE, Mark, Plane, Point, Rect, Role, Sample, Scene, bar, closed, cross, ellipse, legend,
        number, rimmed_polygon, robot, text,
    },
    view::View,
    words::worked_example,
};
use fastslam::map::landmarks::Landmark;
use fastslam_lab::experiment::worked_example::{Update, WorkedExample};

/// Font sizes of formulas and values, and of words \[css px\].
const SIZE: f64 = 14.5;
const WORDS: f64 = 12.0;

/// Standard deviations from the middle of an ellipse to its edge.
const SIGMAS: f64 = 2.0;

/// The worked example, as it is seen.
#[derive(Default)]
pub struct WorkedExampleView;

impl View for WorkedExampleView {
    type Model = WorkedExampleModel;
    type Layout = Layout;
    const NARROWEST: f64 = NARROWEST;
    const PANELS: &'static [&'static str] = &[PLOT, START, CHAIN];

    fn layout(width: f64, panels: &Panels) -> Layout {
        Layout::of(width, panels)
    }

    fn draw(&self, model: &WorkedExampleModel, layout: &Layout, scene: &mut Scene) {
        let example = model.example();
        if let Some([drawing, names]) = &layout.plot {
            plot(scene, example, drawing);
            legend(scene, names, samples());
        }
        for (step, place) in GIVEN.iter().zip(&layout.given) {
            label(scene, step, &place.label);
            value(scene, &place.value, |line| (step.write)(line, example, 0));
        }
        if let Some(steps) = &layout.chain {
            chain(scene, model, steps, layout.wide);
        }
    }
}

/// The steps of both particles, and what follows.
fn chain(scene: &mut Scene, model: &WorkedExampleModel, chain: &Chain, wide: bool) {
    let mut rules = Vec::new();
    for slot in [0, 1] {
        let head = chain.heads[slot];
        let colour = Rect::new(head.x, head.y + 0.5 * head.h - 5.0, 10.0, 10.0);
        scene.marks.push(Mark::Fill { area: colour, role: Role::Particle(slot as u8) });
        let name = Rect::new(head.x + 17.0, head.y, head.w - 17.0, head.h);
        let title = worked_example::Particle { slot: &(slot + 1) }.say();
        scene.marks.push(text(name, Anchor::Start, SIZE, Weight::SemiBold, Role::Ink, title));
        for (step, place) in STEPS.iter().zip(&chain.steps[slot]) {
            if slot == 0 || !wide {
                label(scene, step, &place.label);
                rules.push(rule(chain, place));
            }
            value(scene, &place.value, |line| (step.write)(line, model.example(), slot));
        }
    }
    rules.push(rule(chain, &chain.selection));
    scene.marks.push(Mark::Lines { lines: rules, width: 1.0, dash: None, role: Role::Frame });
    selection(scene, model, &chain.selection);
}

/// The line above a step.
fn rule(chain: &Chain, place: &Place) -> Vec<Point> {
    let y = place.label.y.round() + 0.5;
    vec![[0.0, y], [chain.selection.value.right(), y]]
}

/// Caption and formula of a step, below each other.
fn label(scene: &mut Scene, step: &Step, area: &Rect) {
    let caption = Rect::new(area.x, area.y + 0.5 * area.h - LINE, area.w, LINE);
    let formula = Rect::new(area.x, caption.bottom(), area.w - 8.0, LINE);
    scene.marks.push(text(caption, Anchor::Start, WORDS, Weight::Regular, Role::Muted, (step.caption)()));
    value(scene, &formula, |line| line.tex(step.formula));
}

/// A line of mathematics at the left of an area, smaller if there is no room for it.
fn value(scene: &mut Scene, area: &Rect, write: impl Fn(Formula) -> Formula) {
    let line = |size| write(Formula::new(size, Weight::Regular, Role::Ink));
    let full = line(SIZE);
    let fitting = if full.width() > area.w { line(0.99 * SIZE * area.w / full.width()) } else { full };
    fitting.draw(scene, [area.x, area.y + 0.5 * area.h]);
}

/// Everything that is drawn, at a place in the figure.
fn whole(example: &WorkedExample, area: Rect) -> Plane {
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
    let [x, y] = ends;
    Plane::around(area, [[x[0], y[0]], [x[1], y[1]]], 18.0)
}

/// Robots, what they see, and the landmark before and after.
fn plot(scene: &mut Scene, example: &WorkedExample, area: &Rect) {
    let plane = whole(example, *area);
    let marks = &mut scene.marks;
    let ring = |landmark: &Landmark, width: f64, role: Role| {
        let mean = [landmark.mean.x, landmark.mean.y];
        [
            Mark::Lines { lines: plane.region(mean, landmark.covariance.into(), SIGMAS), width, dash: None, role },
            Mark::Discs { centres: vec![plane.point(mean)], radius: 2.5, role },
        ]
    };
    marks.extend(ring(&example.before, 2.0, Role::Landmark));
    for (slot, update) in example.updates.iter().enumerate() {
        let role = Role::Particle(slot as u8);
        let [from, to] = [plane.position(&update.world_from_robot), plane.point(update.seen_at.into())];
        marks.push(Mark::Lines { lines: vec![vec![from, to]], width: 1.25, dash: Some([5.0, 4.0]), role });
        marks.extend(ring(&update.after, 1.25, role));
        marks.push(seen_at(to, role));
    }
    for (slot, length) in [(0, 13.0), (1, 8.0)] {
        let pose = &example.updates[slot].world_from_robot;
        let corners = robot(plane.position(pose), pose.theta, length);
        rimmed_polygon(scene, corners, Role::Particle(slot as u8));
    }
    // The power of ten that takes up to half of the width.
    let mut length = 1e-3;
    while 10.0 * length * plane.scale <= 0.5 * area.w {
        length *= 10.0;
    }
    let (x, y) = (area.x + 10.0, area.bottom() - 8.0);
    scene.marks.push(bar([x, y], (length * plane.scale).min(area.w - 20.0)));
    let name = Rect::new(x, y - 17.0, 70.0, 14.0);
    scene.marks.push(text(name, Anchor::Start, 10.5, Weight::Regular, Role::Ink, format!("{} m", write(length))));
    scene.marks.push(Mark::Frame { area: *area, width: 1.0, role: Role::Frame });
}

fn seen_at([x, y]: Point, role: Role) -> Mark {
    let lines = cross(Rect::new(x - 4.0, y - 4.0, 8.0, 8.0));
    Mark::Lines { lines, width: 2.0, dash: None, role }
}

/// What the drawing shows.
fn samples() -> [(Sample<'static>, &'static str); 3] {
    let landmark = |[x, y]: Point, width: f64, role: Role| {
        let lines = vec![closed(ellipse([x, y], [[64.0, 0.0], [0.0, 25.0]], 1.0))];
        [Mark::Lines { lines, width, dash: None, role }, Mark::Discs { centres: vec![[x, y]], radius: 2.0, role }]
    };
    let before =
        Sample::new(move |place| landmark([place.right() - 9.0, place.centre()[1]], 2.0, Role::Landmark).into());
    let of = |slot: u8| {
        let role = Role::Particle(slot);
        let draw = move |place: &Rect| {
            let (x, y) = (place.x, place.centre()[1]);
            let lines = vec![vec![[x, y], [x + 20.0, y]]];
            let sight = Mark::Lines { lines, width: 1.25, dash: Some([5.0, 4.0]), role };
            let after = landmark([place.right() - 9.0, y], 1.25, role);
            [sight, seen_at([x + 22.0, y], role)].into_iter().chain(after).collect()
        };
        Sample::new(draw).wide(53.0)
    };
    [(before.wide(19.0), worked_example::before()), (of(0), worked_example::of_1()), (of(1), worked_example::of_2())]
}

/// N_eff on its scale from nothing to M, against the threshold, and what follows.
fn selection(scene: &mut Scene, model: &WorkedExampleModel, place: &Place) {
    let WorkedExample { ess, limit, resamples, .. } = model.example();
    let Place { label: place, value: area } = *place;
    let caption = Rect::new(place.x, place.y + 0.5 * place.h - LINE, place.w, LINE);
    let words = worked_example::effective();
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
    let name = worked_example::ThresholdM { limit: &number(*limit, DIGITS) }.say();
    let w = font::measure(&name, WORDS, Weight::Regular);
    // Not `clamp`: its panic writes both ends, which takes 20 KB.
    let left = (x - 0.5 * w).min(area.right() - w).max(area.x);
    let under = Rect::new(left, bar.bottom() + 6.0, w, LINE);
    scene.marks.push(text(under, Anchor::Start, WORDS, Weight::Regular, Role::Ink, name));
}
