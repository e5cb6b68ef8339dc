//! What is left of the motion prior's samples after one sighting, over the range noise: the closed form as a line, samples as dots.

use super::{
    layout::Part,
    model::{MEASURED, UniversesModel},
    recipe::NOISES,
    share::{SIZE, axis, chart, frame},
};
use crate::{
    decimal::{fixed, write},
    font::{self, Weight},
    marks::{Place, label},
    scene::{Anchor, Mark, Point, Rect, Role, Sample, Scene, legend, n_eff, text},
    words::universes as words,
};
use fastslam::ops;

/// Where a range noise is \[css px\].
pub fn x(area: &Rect, noise: f64) -> f64 {
    let [low, high] = NOISES.map(ops::ln);
    area.x + area.w * ((ops::ln(noise) - low) / (high - low)).clamp(0.0, 1.0)
}

/// Draws it.
pub fn depletion(scene: &mut Scene, model: &UniversesModel, part: &Part, taken: &mut Vec<Rect>) {
    let (area, chart) = (part.area, chart(part));
    title(scene, &part.header);
    let items = [
        (Sample::line(Role::Prior, 2.0, None), words::closed_form()),
        (Sample::dot(Role::Prior, 3.5).wide(8.0), words::measured()),
        (Sample::line(Role::Posterior, 2.0, None), words::aware()),
    ];
    // As many as have room in the one line.
    let mut room = part.legend.w;
    let fit = items.into_iter().take_while(|(sample, name)| {
        room -= sample.width() + font::measure(name, SIZE, Weight::Regular) + 18.0;
        room > -12.0
    });
    legend(scene, &part.legend, fit.collect::<Vec<_>>());
    frame(scene, part, &[(0.0, Role::Muted), (1.0, Role::Muted)]);
    let names = MEASURED.map(|noise| (x(&area, noise), write(noise)));
    axis(scene, part, names.into_iter(), [words::axis_noise().into(), words::axis_noise_short().into()]);
    if model.hides() {
        return;
    }
    let point = |[noise, share]: [f64; 2]| [x(&area, noise), chart.y(share)];
    let map = x(&area, model.map_std());
    let down = vec![[map, area.y], [map, area.bottom()]];
    scene.marks.push(Mark::Lines { lines: vec![down], width: 1.0, dash: Some([2.0, 3.0]), role: Role::Muted });
    let aware = vec![chart.level(1.0)];
    scene.marks.push(Mark::Lines { lines: aware, width: 2.0, dash: None, role: Role::Posterior });
    let curve: Vec<Point> = model.closed_form().map(point).collect();
    scene.marks.push(Mark::Lines { lines: vec![curve], width: 2.0, dash: None, role: Role::Prior });
    let centres = model.measured().map(point).collect();
    scene.marks.push(Mark::Discs { centres, radius: 3.5, role: Role::Prior });
    let std = &fixed(model.map_std(), 2);
    let wordings = [words::MapKnows { std }.say(), words::MapKnowsShort { std }.say()];
    let at = [map, area.y + 13.0];
    label(scene, taken, &area, at, &wordings.each_ref().map(String::as_str), &[Place::Left(5.0), Place::Right(5.0)]);
    let floor = format!("{} %", fixed(model.floor(), 0));
    let at = [area.x, chart.y(0.01 * model.floor())];
    label(scene, taken, &area, at, &[&floor], &[Place::Right(3.0)]);
}

/// What it shows: a sentence that ends in N_eff / M.
fn title(scene: &mut Scene, header: &Rect) {
    let width = |words: &str| font::measure(words, SIZE, Weight::SemiBold) + 5.0;
    let fits = |words: &&str| width(words) + 60.0 < header.w;
    let words = Some(words::depletion()).filter(fits).unwrap_or(words::depletion_short());
    let place = Rect { w: width(words), ..*header };
    scene.marks.push(text(place, Anchor::Start, SIZE, Weight::SemiBold, Role::Ink, words));
    let after = Rect::new(place.right(), header.y, header.right() - place.right(), header.h);
    let end = n_eff(scene, &after, SIZE, Weight::SemiBold, Role::Ink);
    let rest = Rect::new(end, header.y, header.right() - end, header.h);
    scene.marks.push(text(rest, Anchor::Start, SIZE, Weight::SemiBold, Role::Ink, "/ M"));
}
