//! A tree that loses branches: the paths of a population that resamples at every step.

use super::{Kind, label};
use crate::{
    scene::{Anchor, LINE, Point, Rect, Role, Scene},
    words::vignette::{self, TreeTold},
};
use fastslam::{
    genealogy::{Descent, Path},
    geometry::Pose2,
    random::{Purpose, Stream},
    resampling::Scheme,
    weights::Weights,
};

const PARTICLES: usize = 12;

const STEPS: u32 = 24;

/// Standard deviation of what a step adds to a particle's log weight \[nats\].
const SPREAD: f64 = 0.7;

pub const KIND: Kind = Kind {
    name: "tree",
    handle: vignette::tree_handle,
    last: STEPS,
    value: |step| (step.to_string(), ""),
    number: vignette::tree_number,
    result: |step| (lineage(step).into(), lineage(step).to_string(), ""),
    told,
    draw,
};

/// Of each step up to this one, where its particles come from.
fn ancestors(last: u32) -> impl Iterator<Item = Vec<u32>> {
    (0..last).map(|step| {
        let increment = |slot| SPREAD * Stream::at(1, Purpose::TRIAL, step, slot).normal();
        let increments: Vec<f64> = (0..PARTICLES as u32).map(increment).collect();
        let (weights, _) = Weights::uniform(PARTICLES).reweighted(&increments);
        Scheme::Systematic.ancestors(&weights, PARTICLES, &mut Stream::at(1, Purpose::RESAMPLING, step, 0))
    })
}

fn descent(last: u32) -> Descent {
    let mut paths: Vec<Path> = (0..PARTICLES).map(|_| Path::start(Pose2::default())).collect();
    for ancestors in ancestors(last) {
        paths = ancestors.iter().map(|ancestor| paths[*ancestor as usize].clone()).collect();
        paths.iter_mut().for_each(|path| path.push(Pose2::default()));
    }
    Descent::of(&paths)
}

fn lineage(step: u32) -> u32 {
    descent(step).lineage(step)
}

fn told(step: u32) -> String {
    let made = PARTICLES as u32 * (step + 1);
    TreeTold { step: &step, m: &PARTICLES, left: &lineage(step), kept: &descent(step).size(), made: &made }.say()
}

/// Every particle of every step; what nobody descends from has died out.
fn draw(last: u32, area: &Rect, scene: &mut Scene) {
    let place = |step: usize, slot: u32| -> Point {
        let share = (f64::from(slot) + 0.5) / PARTICLES as f64;
        [area.x + 4.0 + (area.w - 8.0) * step as f64 / f64::from(STEPS), area.y + (area.h - LINE) * share]
    };
    let ancestors: Vec<Vec<u32>> = ancestors(last).collect();
    let mut living = [true; PARTICLES];
    let (mut alive, mut dead, mut nodes, mut gone) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for step in (0..=last as usize).rev() {
        let mut parents = [false; PARTICLES];
        for slot in 0..PARTICLES {
            let at = place(step, slot as u32);
            if living[slot] { &mut nodes } else { &mut gone }.push(at);
            let Some(parent) = step.checked_sub(1).map(|before| ancestors[before][slot]) else { continue };
            parents[parent as usize] |= living[slot];
            if living[slot] { &mut alive } else { &mut dead }.push(vec![place(step - 1, parent), at]);
        }
        living = parents;
    }
    for (lines, centres, width, role) in [(dead, gone, 1.0, Role::Fading(120)), (alive, nodes, 2.0, Role::Path)] {
        scene.lines(lines, width, role);
        scene.discs(centres, width + 0.5, role);
    }
    let names = Rect::new(area.x, area.bottom() - LINE, area.w, LINE);
    label(scene, names, Anchor::Start, Role::Path, vignette::lottery_left());
    label(scene, names, Anchor::End, Role::Extinct, vignette::lottery_gone());
}
