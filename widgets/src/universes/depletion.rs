//! What is left of the motion prior's samples after one sighting, over the range noise: the closed form as a line, samples as dots.

use super::{
    layout::Part,
    model::{MEASURED, UniversesModel},
    recipe::NOISES,
    share::{SIZE, axis, chart, frame},
};
use crate::{
    decimal::{fixed, write},
    marks::Place,
    scene::{Point, Rect, Role, Sample, Scene, legend, plain, strong},
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
        room -= sample.width + plain(SIZE, Role::Muted).width(name) + 18.0;
        room > -12.0
    });
    legend(scene, &part.legend, fit.collect::<Vec<_>>());
    frame(scene, part, &[(0.0, Role::Muted), (1.0, Role::Muted)]);
    let names = MEASURED.map(|noise| (x(&area, noise), write(noise)));
    axis(scene, part, &names, [words::axis_noise().into(), words::axis_noise_short().into()]);
    if model.hides() {
        return;
    }
    let point = |[noise, share]: [f64; 2]| [x(&area, noise), chart.y(share)];
    let map = x(&area, model.map_std());
    scene.dash(&[[map, area.y], [map, area.bottom()]], 1.0, [2.0, 3.0], Role::Muted);
    scene.line(&chart.level(1.0), 2.0, Role::Posterior);
    let curve: Vec<Point> = model.closed_form().map(point).collect();
    scene.line(&curve, 2.0, Role::Prior);
    scene.discs(model.measured().map(point).collect(), 3.5, Role::Prior);
    let std = &fixed(model.map_std(), 2);
    let wordings = [words::MapKnows { std }.say(), words::MapKnowsShort { std }.say()];
    let at = [map, area.y + 13.0];
    scene.label(taken, &area, at, &wordings, &[Place::Left(5.0), Place::Right(5.0)]);
    let floor = format!("{} %", fixed(model.floor(), 0));
    let at = [area.x, chart.y(0.01 * model.floor())];
    scene.label(taken, &area, at, &[&floor], &[Place::Right(3.0)]);
}

/// What it shows: a sentence that ends in N_eff / M.
fn title(scene: &mut Scene, header: &Rect) {
    let letters = strong(SIZE, Role::Ink);
    let names = [words::depletion(), words::depletion_short()];
    let words = letters.fitting(header.w - 65.0, &names).unwrap_or(names[1]);
    let place = Rect { w: letters.width(words) + 5.0, ..*header };
    scene.text(place, letters, words);
    let rest = |x: f64| Rect { x, w: header.right() - x, ..*header };
    let end = scene.n_eff(&rest(place.right()), letters);
    scene.text(rest(end), letters, "/ M");
}
