//! The curse of dimension: every further axis leaves half of the samples.

use super::Kind;
use crate::{
    decimal::significant,
    scene::{Mark, Rect, Role, Scene},
    words::vignette::{self, HalvesTold},
};
use fastslam::random::{Purpose, Stream};

const SAMPLES: u32 = 2048;

/// Of a pose and 24 landmarks.
const AXES: u32 = 51;

pub const KIND: Kind = Kind {
    name: "halves",
    handle: vignette::halves_handle,
    last: AXES,
    value: |axes| (axes.to_string(), ""),
    number: vignette::halves_number,
    result: |axes| (left(axes).count() as f64, left(axes).count().to_string(), ""),
    told,
    draw,
};

/// The samples that so many axes leave: along each, one draw decides whether a sample is in the right half.
fn left(axes: u32) -> impl Iterator<Item = u32> {
    (0..SAMPLES).filter(move |sample| {
        let mut stream = Stream::at(1, Purpose::TRIAL, *sample, 0);
        (0..axes).all(|_| stream.uniform() < 0.5)
    })
}

fn told(axes: u32) -> String {
    let (number, power) = significant((1_u64 << axes) as f64, 7);
    let odds = if power == 0 { number } else { scientific((1_u64 << axes) as f64) };
    HalvesTold { n: &axes, left: &left(axes).count(), m: &SAMPLES, odds: &odds }.say()
}

/// Two digits and a power of ten.
fn scientific(x: f64) -> String {
    let (number, power) = significant(x, 2);
    let raised = |digit: char| ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize - '0' as usize];
    format!("{number} × 10{}", power.to_string().chars().map(raised).collect::<String>())
}

/// All samples as dots, in rows; those that are left stand out.
fn draw(axes: u32, area: &Rect, scene: &mut Scene) {
    let columns = (f64::from(SAMPLES) * area.w / area.h).sqrt().ceil();
    let pitch = (area.w / columns).min(area.h / (f64::from(SAMPLES) / columns).ceil());
    let place = |sample: u32| {
        let (row, column) = (sample / columns as u32, sample % columns as u32);
        [column, row].map(|k| (f64::from(k) + 0.5) * pitch)
    };
    let at = |sample| {
        let [x, y] = place(sample);
        [area.x + x, area.y + y]
    };
    let dots = |centres, share: f64, role| Mark::Discs { centres, radius: share * pitch, role };
    scene.marks.push(dots((0..SAMPLES).map(at).collect(), 0.22, Role::Level(70)));
    scene.marks.push(dots(left(axes).map(at).collect(), 0.48, Role::Accent));
}
