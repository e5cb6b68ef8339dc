//! Beams that stack into over-confidence: they share one error, and are counted as if each erred by itself.

use super::{Kind, label};
use crate::{
    decimal::fixed,
    scene::{Anchor, Rect, Role, Scene},
    words::vignette::{self, BeamsTold},
};
use fastslam::weights::Weights;

/// Where they are, from left to right, about the true pose \[m\].
const PARTICLES: u32 = 101;
const APART: f64 = 0.01;

/// How far off the map has the wall that all beams meet \[m\].
const OFF: f64 = 0.1;

/// Standard deviation of what a beam measures \[m\].
const RANGE_STD: f64 = 0.15;

pub const KIND: Kind = Kind {
    name: "beams",
    handle: vignette::beams_handle,
    last: 71,
    value: |at| (count(at).to_string(), ""),
    number: vignette::beams_number,
    result: |at| (weights(at).ess(), fixed(weights(at).ess(), 1), ""),
    told,
    draw,
};

fn count(at: u32) -> u32 {
    at + 1
}

fn place(particle: u32) -> f64 {
    APART * (f64::from(particle) - f64::from(PARTICLES / 2))
}

/// Beams that all say the same multiply to a power of what one of them says.
fn weights(at: u32) -> Weights {
    let log_likelihood = |particle| {
        let deviations = (place(particle) - OFF) / RANGE_STD;
        -0.5 * deviations * deviations
    };
    let one: Vec<f64> = (0..PARTICLES).map(log_likelihood).collect();
    Weights::uniform(one.len()).reweighted(&one).0.tempered(count(at).into())
}

/// The weights, as shares of the largest.
fn shares(at: u32) -> Vec<f64> {
    let weights = weights(at);
    let most = weights.as_slice()[weights.heaviest()];
    weights.as_slice().iter().map(|weight| weight / most).collect()
}

fn told(at: u32) -> String {
    let true_pose = shares(at)[PARTICLES as usize / 2];
    let percent =
        if true_pose < 1e-4 { "< 0.01".into() } else { fixed(100.0 * true_pose, if true_pose < 0.1 { 2 } else { 0 }) };
    BeamsTold { n: &count(at), ess: &fixed(weights(at).ess(), 1), m: &PARTICLES, share: &percent }.say()
}

/// A bar for each particle, those of a single beam pale behind them, and the true pose.
fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    let (line, pitch) = (18.0, area.w / f64::from(PARTICLES));
    let (ground, high) = (area.bottom(), area.h - line - 6.0);
    let x = |particle: u32| area.x + (f64::from(particle) + 0.5) * pitch;
    let bars = |at| {
        let bar = |(particle, share): (u32, f64)| vec![[x(particle), ground], [x(particle), ground - share * high]];
        (0..PARTICLES).zip(shares(at)).map(bar).collect()
    };
    for (lines, role) in [(bars(0), Role::Level(48)), (bars(at), Role::Posterior)] {
        scene.lines(lines, 0.6 * pitch, role);
    }
    let middle = x(PARTICLES / 2);
    scene.dash(&[[middle, area.y + line], [middle, ground]], 2.0, [5.0, 3.0], Role::Truth);
    let beside = Rect::new(area.x, area.y, middle - area.x, line);
    label(scene, beside, Anchor::End, Role::Muted, vignette::beams_truth());
    for (below, (count, role)) in [(count(0), Role::Muted), (count(at), Role::Posterior)].into_iter().enumerate() {
        let names = Rect { y: area.y + line * (below + 1) as f64, ..beside };
        label(scene, names, Anchor::Start, role, &format!("{}: {count}", vignette::beams_handle()));
    }
}
