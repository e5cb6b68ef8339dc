//! Why look first: poses that odometry leaves open lie along a bent stretch, and the scan fits in one small place of it.

use super::{Kind, MARGIN, label};
use crate::{
    decimal::fixed,
    scene::{Anchor, LINE, NINE_TENTHS, Plane, Rect, Role, Scene},
    words::vignette::{self, LookTold},
};
use fastslam::{
    geometry::Pose2,
    motion::{Motion as _, Odometry, OdometryModel},
    ops,
    random::{Purpose, Stream},
    weights::Weights,
};

const SAMPLES: u32 = 400;

/// A drive straight ahead, on wheels that lose their heading \[m\].
const DRIVE: Odometry = Odometry { rot1: 0.0, trans: 4.0, rot2: 0.0 };
const WHEELS: OdometryModel = OdometryModel { alphas: [0.0, 0.0016, 0.0004, 0.0] };

/// Standard deviation of where the scan fits \[m\], along both axes.
const FIT_STD: f64 = 0.05;

/// The handle's place where the scan fits where odometry leads, and how far it goes from place to place along the arc \[m\].
const MIDDLE: u32 = 20;
const STEP: f64 = 0.08;

pub const KIND: Kind = Kind {
    name: "look",
    handle: vignette::look_handle,
    last: 2 * MIDDLE,
    value: |at| (fixed(off(at), 2), "m"),
    number: vignette::look_number,
    result: |at| (weights(at).ess(), ess(at), ""),
    told: |at| LookTold { m: &SAMPLES, ess: &ess(at), off: &fixed(off(at).abs(), 2) }.say(),
    draw,
};

fn off(at: u32) -> f64 {
    STEP * (f64::from(at) - f64::from(MIDDLE))
}

/// Where the scan fits: as far ahead as odometry says, and so far to the right.
fn fit(at: u32) -> [f64; 2] {
    let (sin, cos) = ops::sin_cos(off(at) / DRIVE.trans);
    [DRIVE.trans * sin, DRIVE.trans * cos]
}

/// Drawn from odometry, for a robot that looks up.
fn drawn() -> impl Iterator<Item = [f64; 2]> {
    let start = Pose2::new(0.0, 0.0, core::f64::consts::FRAC_PI_2);
    (0..SAMPLES).map(move |slot| {
        let pose = WHEELS.sample(&start, &DRIVE, &mut Stream::at(1, Purpose::TRIAL, 0, slot));
        [pose.x, pose.y]
    })
}

/// What the scan makes of them.
fn weights(at: u32) -> Weights {
    let [x, y] = fit(at);
    let deviations = |[a, b]: [f64; 2]| ops::hypot(a - x, b - y) / FIT_STD;
    let log_likelihoods: Vec<f64> = drawn().map(|pose| -0.5 * deviations(pose) * deviations(pose)).collect();
    Weights::uniform(log_likelihoods.len()).reweighted(&log_likelihoods).0
}

fn ess(at: u32) -> String {
    fixed(weights(at).ess(), 1)
}

/// All draws, those that carry a share of the weight larger, and where the scan fits.
fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    let plane = Plane::around(area.inset(-MARGIN), [[-2.0, 3.35], [2.0, 4.25]], 4.0);
    let weights = weights(at);
    let counts = |weight: f64| weight * f64::from(SAMPLES) > 1.0;
    let draws = |heavy| {
        let shown = drawn().zip(weights.as_slice()).filter(move |(_, weight)| counts(**weight) == heavy);
        shown.map(|(pose, _)| plane.point(pose))
    };
    scene.cloud(draws(false), &plane.area, 1.8, Role::Prior);
    scene.cloud(draws(true), &plane.area, 3.2, Role::Posterior);
    let variance = FIT_STD * FIT_STD;
    scene.lines(plane.region(fit(at), [[variance, 0.0], [0.0, variance]], NINE_TENTHS), 2.0, Role::Accent);
    let line = Rect::new(area.x, area.bottom() - LINE, area.w, LINE);
    label(scene, line, Anchor::Start, Role::Prior, vignette::look_drawn());
    label(scene, line, Anchor::End, Role::Accent, vignette::look_fits());
}
