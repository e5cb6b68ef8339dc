//! What the maps are worth, from the first guess on: a curve that never falls; and where other guesses end.

use super::{
    layout::{ENDS, Layout},
    model::EmModel,
    strips::SIZE,
};
use crate::{
    decimal::fixed,
    scene::{Chart, LINE, Point, Rect, Role, Sample, Scene, legend, plain, strong},
    words::{common, em as words},
};

/// The values at the lower and the upper edge \[nats\]: where anything ends, and the curve from its first iteration on.
fn range(model: &EmModel) -> [f64; 2] {
    let own = model.iterates().iter().skip(1).map(|iterate| iterate.log_posterior);
    let ends = model.others().ends().iter().map(|end| end.log_posterior);
    let pinned = model.pinned().iter().skip(1).copied();
    let [low, high] =
        own.chain(ends).chain(pinned).fold([f64::MAX, f64::MIN], |[low, high], x| [low.min(x), high.max(x)]);
    // There is only the first guess.
    let [low, high] = if low > high { [model.shown().log_posterior; 2] } else { [low, high] };
    let margin = 0.06 * (high - low).max(1.0);
    [low - margin, high + margin]
}

/// Draws all of it.
pub fn chart(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let chart = Chart { area: layout.chart.area, last: model.iterations() };
    let [low, high] = range(model);
    let share = |x: f64| (x - low) / (high - low);
    names(scene, model, layout);
    chart.edges(scene);
    ticks(scene, layout, [low, high], model.iterations());
    chart.ghost(scene, model.pinned().iter().map(|x| share(*x)));
    let values: Vec<f64> = model.iterates().iter().map(|iterate| share(iterate.log_posterior)).collect();
    // What the reader has not come to yet is drawn, but as what it is.
    let rank = model.rank() as usize;
    let ahead = chart.curve((rank as u32..).zip(values[rank..].iter().copied()));
    scene.dash(&ahead, 1.0, [2.0, 3.0], Role::Muted);
    let curve = chart.curve((0..).zip(values[..=rank].iter().copied()));
    let now = curve.last().copied();
    scene.line(&curve, 2.0, Role::Posterior);
    scene.discs(curve, 2.0, Role::Posterior);
    scene.discs(now.into_iter().collect(), 4.5, Role::Posterior);
    // Where others end, in an order that says nothing.
    let ends = model.others().ends().iter().enumerate().map(|(k, end)| -> Point {
        let x = chart.area.right() + 6.0 + (ENDS - 10.0) * ((k * 7 % 20) as f64 + 0.5) / 20.0;
        [x, chart.y(share(end.log_posterior))]
    });
    scene.discs(ends.collect(), 2.25, Role::Prior);
}

fn names(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let header = layout.chart.header;
    let (letters, name) = (strong(13.0, Role::Ink), words::log_posterior());
    scene.text(Rect { h: LINE, ..header }, letters, name);
    let left = header.x + letters.width(name) + 12.0;
    let others = words::OtherGuesses { n: &model.others().ends().len() }.say();
    let mut items = vec![(Sample::dot(Role::Prior, 2.25).wide(7.0), others)];
    if !model.pinned().is_empty() {
        items.push((Sample::pinned().wide(14.0), common::pinned_mark().into()));
    }
    let wanted = |items: &[(Sample<'_>, String)]| -> f64 {
        items.iter().map(|(sample, name)| sample.width + 17.0 + plain(11.5, Role::Muted).width(name)).sum()
    };
    // On a phone, the pinned run's line speaks for itself.
    while wanted(&items) > header.right() - left && items.len() > 1 {
        items.pop();
    }
    if wanted(&items) <= header.right() - left + 12.0 {
        legend(scene, &Rect::new(left, header.y, header.right() - left, LINE), items);
    }
}

fn ticks(scene: &mut Scene, layout: &Layout, [low, high]: [f64; 2], iterations: u32) {
    let chart = layout.chart.area;
    let steps = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0];
    let room = (chart.h / 26.0).floor().max(1.0);
    let step = steps.into_iter().find(|step| (high - low) / step <= room).unwrap_or(1000.0);
    let mut value = (low / step).ceil() * step;
    while value <= high {
        let y = chart.bottom() - chart.h * (value - low) / (high - low);
        if y > chart.y + 5.0 && y < chart.bottom() - 5.0 {
            scene.fill(Rect::new(chart.x, y - 0.5, chart.w, 1.0), Role::Frame);
            let place = Rect::new(layout.numbers.x, y - 7.0, layout.numbers.w - 6.0, 14.0);
            scene.text(place, plain(SIZE, Role::Muted).end(), &fixed(value, 0));
        }
        value += step;
    }
    let name = plain(SIZE, Role::Muted);
    scene.text(Rect { w: 20.0, ..layout.axis }, name, "0");
    scene.text(Rect { x: chart.right() - 26.0, w: 30.0, ..layout.axis }, name.end(), &iterations.to_string());
    let rest = Rect { x: layout.axis.x + 24.0, w: layout.axis.w - 24.0 - 30.0, ..layout.axis };
    scene.text(rest, name.middle(), words::iterations());
}
