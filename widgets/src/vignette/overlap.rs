//! A weight as the overlap of two ellipses: what the map says of a landmark, and what the measurement says of it.

use super::{Kind, label};
use crate::{
    decimal::fixed,
    scene::{Anchor, LINE, NINE_TENTHS, Plane, Rect, Role, Sample, Scene, legend},
    words::vignette::{self, OverlapTold},
};
use fastslam::{
    geometry::Pose2,
    map::landmarks::Landmark,
    nalgebra::{Matrix2, Vector2},
    ops,
    sensor::RangeBearing,
};

const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.12, bearing_std: 0.06, max_range: 10.0, field_of_view: core::f64::consts::TAU };

/// Where the landmark is expected, straight ahead of a robot at the origin \[m\].
const RANGE: f64 = 3.0;

/// The handle's place where the measurement is as expected, and how far it goes from place to place \[m\].
const MIDDLE: u32 = 20;
const STEP: f64 = 0.05;

pub const KIND: Kind = Kind {
    name: "overlap",
    handle: vignette::overlap_handle,
    last: 2 * MIDDLE,
    value: |at| (fixed(off(at), 2), "m"),
    number: vignette::overlap_number,
    result: |at| (100.0 * share(at), percent(at), "%"),
    told: |at| OverlapTold { off: &fixed(off(at).abs(), 2), share: &percent(at) }.say(),
    draw,
};

fn off(at: u32) -> f64 {
    STEP * (f64::from(at) - f64::from(MIDDLE))
}

fn map() -> Landmark {
    let covariance = Matrix2::new(0.06, 0.03, 0.03, 0.05);
    Landmark { mean: Vector2::new(RANGE, 0.0), covariance, existence_count: 1, apart: 0 }
}

fn measured(at: u32) -> Vector2<f64> {
    Vector2::new(RANGE + off(at), 0.0)
}

/// The weight, as a share of that of a measurement that is as expected.
fn share(at: u32) -> f64 {
    let log_weight = |at| map().innovation(&SENSOR, &Pose2::default(), &measured(at)).log_likelihood();
    ops::exp(log_weight(at) - log_weight(MIDDLE))
}

fn percent(at: u32) -> String {
    fixed(100.0 * share(at), if share(at) < 0.1 { 1 } else { 0 })
}

fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    let robot = Pose2::default();
    let measurement = Landmark::first(&SENSOR, &robot, &measured(at));
    let mut both = map();
    both.update(&SENSOR, &robot, &measured(at));
    let bar = Rect::new(area.right() - 44.0, area.y + LINE, 34.0, area.h - 2.0 * LINE - 6.0);
    let plane = Plane::around(
        Rect::new(area.x, area.y, area.w - 60.0, area.h - LINE),
        [[RANGE - 1.5, -0.55], [RANGE + 1.5, 0.55]],
        0.0,
    );
    let said = [
        (map(), Role::Feature, 2.0, vignette::overlap_map()),
        (measurement, Role::Accent, 2.0, vignette::overlap_measured()),
        (both, Role::Ink, 3.0, vignette::overlap_both()),
    ];
    for (landmark, role, width, _) in &said {
        let [[xx, xy], [yx, yy]]: [[f64; 2]; 2] = landmark.covariance.into();
        let lines = plane.region([landmark.mean.x, landmark.mean.y], [[xx, xy], [yx, yy]], NINE_TENTHS);
        scene.lines(lines, *width, *role);
    }
    let line = Rect::new(area.x, area.bottom() - LINE, area.w, LINE);
    legend(scene, &line, said.map(|(_, role, width, words)| (Sample::line(role, width, None), words)));
    let full = share(at) * bar.h;
    scene.fill(Rect::new(bar.x, bar.bottom() - full, bar.w, full), Role::Weight(255));
    scene.frame(bar, 1.0, Role::Muted);
    let over = Rect::new(area.right() - 60.0, area.y, 60.0, LINE);
    label(scene, over, Anchor::Middle, Role::Muted, vignette::overlap_weight());
}
