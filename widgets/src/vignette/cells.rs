//! Two poses that one grid score cannot tell apart: by its cells a scan fits as well anywhere that leaves its end points in their cells, and by
//! where in them the wall is, in one place only.

use super::{Kind, cells, label};
use crate::{
    decimal::fixed,
    scene::{Anchor, LINE, Rect, Role, Scene},
    words::vignette::{self, CellsTold},
};
use fastslam::{geometry::Pose2, map::grid::Grid, matching::Matcher, sensor::Scan};
use fastslam_lab::experiment::close_up;

/// Where the wall is, and where its end points were mapped \[m\].
const WALL: f64 = 0.69;
const ENDS: [[f64; 2]; 6] = [[-0.02, 0.05], [0.01, 0.11], [0.0, 0.16], [0.02, 0.2], [-0.01, 0.24], [0.0, 0.28]];

/// Cells from left to right.
const COLUMNS: i32 = 5;

/// The handle's place where the scan fits, and how far it goes from place to place \[m\].
const MIDDLE: u32 = 60;
const STEP: f64 = 0.01;

pub const KIND: Kind = Kind {
    name: "cells",
    handle: vignette::cells_handle,
    last: 2 * MIDDLE,
    value: |at| (fixed(off(at), 2), "m"),
    number: vignette::cells_number,
    result: |at| (same(at), fixed(same(at), 2), "m"),
    told,
    draw,
};

fn off(at: u32) -> f64 {
    STEP * (f64::from(at) - f64::from(MIDDLE))
}

/// The end points, for a robot in the origin.
fn scan() -> Scan {
    Scan { hits: ENDS.map(|[x, y]| [WALL + x, y]).to_vec(), ..Scan::default() }
}

fn map() -> Grid {
    let mut map = close_up::map();
    close_up::see(&mut map, &Pose2::default(), &scan());
    map
}

/// The score at every place of the handle \[nats\].
fn scores(matcher: Matcher) -> Vec<f64> {
    let places: Vec<Pose2> = (0..=2 * MIDDLE).map(|at| Pose2::new(off(at), 0.0, 0.0)).collect();
    close_up::scores(matcher, &map(), &scan(), &places)
}

/// How long the stretch is, of all places of the handle, on which the score of cells is the same \[m\].
fn same(at: u32) -> f64 {
    let scores = scores(Matcher::Cell);
    STEP * scores.iter().filter(|score| **score == scores[at as usize]).count() as f64
}

fn extreme(scores: &[f64], of: fn(f64, f64) -> f64) -> f64 {
    scores.iter().copied().fold(scores[0], of)
}

fn told(at: u32) -> String {
    let scores = scores(Matcher::SubCell);
    let worse = extreme(&scores, f64::max) - scores[at as usize];
    CellsTold { off: &fixed(off(at).abs(), 2), same: &fixed(same(at), 2), worse: &fixed(worse, 1) }.say()
}

/// A row of cells with the end points as they were mapped and as they fall now; below it both scores, each where it puts the wall.
fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    let pitch = area.w / f64::from(COLUMNS);
    let row = Rect::new(area.x, area.y, area.w, 44.0);
    let map = map();
    cells(scene, row, &map, [0, 0], [COLUMNS, 1]);
    let side = map.cell_size();
    for column in 0..COLUMNS {
        scene.frame(Rect::new(row.x + f64::from(column) * pitch, row.y, pitch, row.h), 0.5, Role::Frame);
    }
    let x = |metres: f64| area.x + metres / side * pitch;
    for (off, radius, role) in [(0.0, 2.5, Role::Hit), (off(at), 4.9, Role::Paper), (off(at), 3.6, Role::Accent)] {
        let end = |[dx, y]: [f64; 2]| [x(WALL + dx + off), row.bottom() - y / side * row.h];
        scene.discs(ENDS.map(end).to_vec(), radius, role);
    }
    let line = Rect::new(area.x, area.bottom() - LINE, area.w, LINE);
    let chart = Rect::new(area.x, row.bottom() + 8.0, area.w, line.y - row.bottom() - 12.0);
    let now = vec![vec![[x(WALL + off(at)), row.bottom()], [x(WALL + off(at)), chart.bottom()]]];
    scene.dashed(now, 1.5, [3.0, 3.0], Role::Accent);
    for (matcher, role, anchor, words) in [
        (Matcher::Cell, Role::Prior, Anchor::Start, vignette::cells_cell()),
        (Matcher::SubCell, Role::Posterior, Anchor::End, vignette::cells_ndt()),
    ] {
        let scores = scores(matcher);
        let (least, most) = (extreme(&scores, f64::min), extreme(&scores, f64::max));
        let y = |score: f64| chart.bottom() - chart.h * (score - least) / (most - least);
        let curve = scores.iter().zip(0..).map(|(score, at)| [x(WALL + off(at)), y(*score)]).collect();
        scene.rimmed(vec![curve], 2.0, None, role);
        label(scene, line, anchor, role, words);
    }
}
