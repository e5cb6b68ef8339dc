//! What is to be seen: robots and landmark in the plane, the steps with their numbers, and the decision.

use super::{
    hands::{self, ROW, THRESHOLD},
    layout::{CHAIN, Chain, FIVE, Labels, Layout, PLOT, Place, START},
    model::WorkedExampleModel,
    plot::{after, before, plot},
    steps::{self, GIVEN, Step, Writing},
};
use crate::{
    font::{self, Weight},
    model::Declared,
    panels::Panels,
    scene::{Anchor, Formula, Handle, LINE, Point, Rect, Role, Sample, Scene, legend, number, plain, strong},
    view::{Layout as _, View},
    words::worked_example,
};
use fastslam_lab::experiment::worked_example::WorkedExample;

/// Font sizes of formulas and values, the least of values before they lose digits, and of words \[css px\].
const SIZE: f64 = 13.0;
const SMALLEST: f64 = 11.0;
const WORDS: f64 = 12.0;

/// Significant digits of what is shown, and the fewest where there is little room.
const DIGITS: i32 = 5;
const FEWEST: i32 = 3;

/// Width of a column in which it can be said how a value comes about \[css px\].
const SPACIOUS: f64 = 176.0;

/// The worked example, as it is seen.
#[derive(Default)]
pub struct WorkedExampleView;

impl View for WorkedExampleView {
    type Model = WorkedExampleModel;
    type Layout = Layout;

    fn parts(model: &WorkedExampleModel, asked: &Panels) -> Panels {
        match asked {
            _ if !model.recipe().all_steps => asked.clone(),
            _ if asked.are_all() => Panels::of(&[PLOT, START, CHAIN]),
            _ if !asked.has(FIVE) => asked.clone(),
            // In the place of the five.
            _ => {
                let shown = Layout::PANELS.iter().copied().filter(|panel| asked.has(panel) || *panel == CHAIN);
                Panels::of(&shown.collect::<Vec<_>>())
            }
        }
    }

    fn draw(&self, model: &WorkedExampleModel, layout: &Layout, scene: &mut Scene) {
        let example = model.example();
        let shown = layout.chain.as_ref().map_or(&[][..], Chain::steps);
        let pointed = steps::pointed(model.recipe().row, shown);
        let lit = pointed.map_or(Vec::new(), |rank| shown[rank].entering(shown));
        if let Some(area) = &layout.plot {
            plot(scene, example, area, &lit);
        }
        if let Some(area) = &layout.names {
            names(scene, area, layout.chain.is_none());
        }
        for (step, area) in GIVEN.iter().zip(&layout.given) {
            given(scene, step, area, example);
        }
        if let Some(steps) = &layout.chain {
            chain(scene, model, layout, steps);
            light(scene, steps, pointed, &lit);
        }
    }

    fn drag(&self, model: &mut WorkedExampleModel, layout: &Layout, handle: &str, to: Point) {
        hands::drag(model, layout, handle, to);
    }

    fn nudge(&self, model: &mut WorkedExampleModel, handle: &str, steps: [f64; 2]) {
        hands::nudge(model, handle, steps);
    }
}

/// What is drawn, and whose it is where there are no headings that say it.
fn names(scene: &mut Scene, area: &Rect, particles: bool) {
    let whose = |slot: usize| {
        let name = worked_example::Particle { slot: &(slot + 1) }.say();
        (after(Role::Series(slot as u8)), format!("{name}: {}", worked_example::seen_after()))
    };
    let what = || (after(Role::Muted), worked_example::seen_after().to_string());
    let others = if particles { vec![whose(0), whose(1)] } else { vec![what()] };
    legend(scene, area, [(before(), worked_example::before().to_string())].into_iter().chain(others));
}

/// One of the matrices that both begin with, after its symbol.
fn given(scene: &mut Scene, step: &Step, area: &Rect, example: &WorkedExample) {
    let writing = Writing { size: SIZE, digits: DIGITS, brief: false };
    let name = writing.line().tex(step.formula).tex(" = ");
    let used = name.width();
    name.draw(scene, [area.x, area.centre()[1]]);
    let room = Rect::new(area.x + used, area.y, area.w - used - 8.0, area.h);
    value(scene, &room, &|writing| (step.write)(writing, example, 0));
}

/// The steps of both particles, and what follows.
fn chain(scene: &mut Scene, model: &WorkedExampleModel, layout: &Layout, chain: &Chain) {
    let drawn = layout.plot.is_some();
    if drawn && layout.names.is_none() {
        names(scene, &middle_line(&chain.head.label), false);
    }
    for (slot, area) in chain.head.values.iter().enumerate() {
        heading(scene, slot, area, drawn);
    }
    for (step, place) in chain.steps().iter().zip(&chain.places) {
        label(scene, step, &place.label, layout.labels, chain.all);
        for (slot, area) in place.values.iter().enumerate() {
            value(scene, area, &|writing| (step.write)(writing, model.example(), slot));
        }
    }
    let [name, ..] = chain.selection;
    let tops = chain.places.iter().map(|Place { label, .. }| label.y).chain([name.y]);
    let right = scene.width;
    scene.lines(tops.map(|y| vec![[0.0, y.round() + 0.5], [right, y.round() + 0.5]]).collect(), 1.0, Role::Frame);
    selection(scene, model, chain, layout.labels);
}

/// The step that is pointed at between two lines, and those that enter it on one each.
fn light(scene: &mut Scene, chain: &Chain, pointed: Option<usize>, lit: &[&str]) {
    let (rows, shown) = (chain.rows(), chain.steps());
    let line = |y: f64| vec![[rows.x, y.round() + 0.5], [rows.right(), y.round() + 0.5]];
    let row = |rank: usize| &chain.places[rank].label;
    let entering = lit.iter().filter_map(|symbol| steps::row_of(shown, symbol)).map(|rank| line(row(rank).bottom()));
    scene.lines(entering.collect(), 3.0, Role::Accent);
    let edges = pointed.into_iter().flat_map(|rank| [row(rank).y, row(rank).bottom()]).map(line);
    scene.lines(edges.collect(), 2.0, Role::Ink);
    let rank = pointed.unwrap_or(0);
    scene.handles.push(Handle {
        name: ROW,
        title: worked_example::row().into(),
        at: [rows.x + 0.5 * rows.w, row(rank).centre()[1]],
        axes: &[ROW],
        value: pointed.map_or(0.0, |rank| steps::number_of(shown, rank).into()),
        text: pointed.map_or(worked_example::row_none().into(), |rank| shown[rank].told(shown)),
        hover: Some(rows),
    });
}

/// A line of text in the middle of a row.
fn middle_line(row: &Rect) -> Rect {
    Rect { y: row.y + 0.5 * (row.h - LINE), h: LINE, ..*row }
}

/// Whose column it is, after what is drawn of it.
fn heading(scene: &mut Scene, slot: usize, area: &Rect, drawn: bool) {
    let (line, role) = (middle_line(area), Role::Series(slot as u8));
    let sample = if drawn { after(role) } else { Sample::dot(role, 5.0).wide(12.0) };
    let place = Rect::new(line.x, line.y + 3.0, sample.width, LINE - 6.0);
    sample.draw(scene, &place);
    let name = Rect::new(place.right() + 6.0, line.y, line.right() - place.right() - 6.0, LINE);
    let title = worked_example::Particle { slot: &(slot + 1) }.say();
    scene.text(name, strong(SIZE, Role::Ink), &title);
}

/// What a row says of itself.
fn label(scene: &mut Scene, step: &Step, area: &Rect, labels: Labels, all: bool) {
    let caption = (step.caption)();
    let middle = area.centre()[1];
    let formula = |scene: &mut Scene, tex: &str, at: Point| {
        Formula::new(SIZE, Weight::Regular, Role::Ink).tex(tex).draw(scene, at);
    };
    let words = |scene: &mut Scene, area: Rect, words: &str| {
        scene.text(area, plain(WORDS, Role::Muted), words);
    };
    match labels {
        Labels::Line => {
            let captions = Labels::captions(all);
            words(scene, Rect::new(area.x, middle - 0.5 * LINE, captions, LINE), caption);
            formula(scene, step.formula, [area.x + captions, middle]);
        }
        Labels::Stacked => {
            words(scene, Rect::new(area.x, middle - LINE, area.w, LINE), caption);
            formula(scene, step.formula, [area.x, middle + 0.5 * LINE]);
        }
        Labels::Short => {
            let unit = step.unit().filter(|_| step.tall);
            let up = if unit.is_some() { 0.5 * LINE } else { 0.0 };
            formula(scene, step.symbol(), [area.x, middle - up]);
            if let Some(unit) = unit {
                words(scene, Rect::new(area.x, middle, area.w, LINE), unit);
            }
        }
    }
}

/// A value at the left of an area: where there is little room, with fewer digits rather than too small to read.
fn value(scene: &mut Scene, area: &Rect, write: &dyn Fn(&Writing) -> Formula) {
    let brief = area.w < SPACIOUS;
    let fitting = |digits: i32| {
        let full = write(&Writing { size: SIZE, digits, brief }).width();
        Writing { size: if full > area.w { 0.99 * SIZE * area.w / full } else { SIZE }, digits, brief }
    };
    let legible = (FEWEST..=DIGITS).rev().map(fitting).find(|writing| writing.size >= SMALLEST);
    write(&legible.unwrap_or_else(|| fitting(FEWEST))).draw(scene, [area.x, area.centre()[1]]);
}

/// N_eff on its scale from nothing to M, against the threshold, and what follows.
fn selection(scene: &mut Scene, model: &WorkedExampleModel, chain: &Chain, labels: Labels) {
    let WorkedExample { ess, limit, resamples, .. } = model.example();
    let [name, words, _] = chain.selection;
    let (caption, formula) = (worked_example::effective, "N_{eff} = 1 / Σ w\u{303}^2");
    match labels {
        Labels::Short => {
            Formula::new(SIZE, Weight::Regular, Role::Ink).tex("N_{eff}").draw(scene, [name.x, name.centre()[1]])
        }
        _ => label(
            scene,
            &Step { caption, formula, enters: "", tall: false, write: |to, _, _| to.line() },
            &name,
            labels,
            chain.all,
        ),
    }
    let role = if *resamples { Role::Copied } else { Role::Accent };
    let verdict = model.verdict();
    let full = font::measure(&verdict, 14.5, Weight::SemiBold);
    scene.text(words, strong(if full > words.w { 0.99 * 14.5 * words.w / full } else { 14.5 }, role), &verdict);

    let bar = chain.bar();
    let at = |ess: f64| bar.x + bar.w * ess / model.example().updates.len() as f64;
    for (name, x, anchor) in [("0", bar.x - 14.0, Anchor::Start), ("2", bar.right() + 4.0, Anchor::End)] {
        scene.text(Rect::new(x, bar.y - 3.0, 14.0, 16.0), plain(WORDS, Role::Muted).at(anchor), name);
    }
    scene.fill(Rect { w: at(*ess) - bar.x, ..bar }, role);
    scene.frame(bar, 1.0, Role::Weight(0));
    let x = at(*limit);
    let lines = vec![vec![[x, bar.y - 2.0], [x, bar.bottom() + 5.0]]];
    scene.lines(lines.clone(), 5.0, Role::Paper);
    scene.lines(lines, 2.0, Role::Ink);
    // It can be moved.
    let grip = [x, bar.centre()[1]];
    scene.knob(grip, 6.0, Role::Ink);
    let name = worked_example::ThresholdM { limit: &number(*limit, DIGITS) }.say();
    let w = font::measure(&name, WORDS, Weight::Regular) + 0.01;
    // Not `clamp`: its panic writes both ends, which takes 20 KB.
    let left = (x - 0.5 * w).min(bar.right() + 18.0 - w).max(bar.x - 14.0);
    scene.text(Rect::new(left, bar.bottom() + 3.0, w, LINE), plain(WORDS, Role::Ink), &name);
    let value = model.recipe().inputs.threshold;
    scene.handles.push(Handle::of(&[THRESHOLD], worked_example::threshold_handle(), grip, value, name));
}
