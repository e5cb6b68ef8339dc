//! The comb of systematic resampling, which a reader shifts.

use super::{Kind, label};
use crate::{
    decimal::fixed,
    scene::{Anchor, Rect, Role, Scene, strong},
    words::vignette::{self, CombTold},
};
use fastslam::resampling::systematic;

/// Normalised. The lightest can go without a copy, and the heaviest gets two or three.
const WEIGHTS: [f64; 8] = [0.12, 0.05, 0.3, 0.02, 0.14, 0.22, 0.04, 0.11];

const HEAVIEST: usize = 2;

/// Places of the handle from one tooth to the next.
const PLACES: u32 = 50;

pub const KIND: Kind = Kind {
    name: "comb",
    handle: vignette::comb_handle,
    last: PLACES - 1,
    value: |at| (fixed(shift(at), 2), ""),
    number: vignette::comb_number,
    result: |at| (dead(at) as f64, dead(at).to_string(), ""),
    told,
    draw,
};

fn shift(at: u32) -> f64 {
    f64::from(at) / f64::from(PLACES)
}

/// How many copies each particle gets.
fn copies(at: u32) -> [usize; WEIGHTS.len()] {
    let ancestors = systematic(&WEIGHTS, WEIGHTS.len(), shift(at));
    core::array::from_fn(|slot| ancestors.iter().filter(|ancestor| **ancestor as usize == slot).count())
}

fn dead(at: u32) -> usize {
    copies(at).iter().filter(|copies| **copies == 0).count()
}

fn told(at: u32) -> String {
    let share = fixed(100.0 * WEIGHTS[HEAVIEST], 0);
    CombTold { share: &share, copies: &copies(at)[HEAVIEST], m: &WEIGHTS.len(), dead: &dead(at) }.say()
}

/// The comb over a bar of all weights, and under each piece its copies.
fn draw(at: u32, area: &Rect, scene: &mut Scene) {
    let (left, n) = (area.x, WEIGHTS.len() as f64);
    let [spine, top, below, line] = [area.y + 24.0, area.y + 56.0, area.y + 92.0, 18.0];
    let mut from = 0.0;
    for (weight, copies) in WEIGHTS.into_iter().zip(copies(at)) {
        let x = left + from * area.w;
        from += weight;
        let piece = Rect::new(x + 0.5, top, weight * area.w - 1.0, below - top);
        let role = if copies == 0 { Role::Extinct } else { Role::Posterior };
        scene.fill(piece, role);
        let under = Rect::new(x, below + 2.0, weight * area.w, line);
        let (long, short) = (format!("× {copies}"), copies.to_string());
        scene.fit(under, strong(13.0, role).middle(), &[&long, &short, ""]);
    }
    let tooth = |k: usize| {
        let x = left + (k as f64 + shift(at)) / n * area.w;
        vec![[x, spine], [x, below]]
    };
    let teeth: Vec<_> = (0..WEIGHTS.len()).map(tooth).collect();
    let back = vec![teeth[0][0], teeth[WEIGHTS.len() - 1][0]];
    scene.rimmed(teeth, 2.0, None, Role::Accent);
    scene.line(&back, 4.0, Role::Accent);
    for (y, words) in [(area.y, vignette::comb_teeth()), (area.bottom() - line, vignette::comb_weights())] {
        label(scene, Rect::new(left, y, area.w, line), Anchor::Start, Role::Muted, words);
    }
}
