//! All universes in one picture: where their walls agree and where they differ, every path and robot, and those that died out lately.

use super::{
    drive,
    layout::Layout,
    map,
    model::LapModel,
    paths::{RAW, TRUTH, branches, odometry, true_path, true_walls},
};
use crate::{
    robot::{self, Poses, Robots},
    scene::{FREE, Plane, Rect, Role, Sample, Scene, Shading, UNKNOWN, legend, lens},
    words::{common, lap},
};
use fastslam::{genealogy::Path, particle::Particle};
use std::collections::BTreeSet;

/// How strongly universes are drawn that died out at the step shown, one step before it, and two.
const FADING: [u8; 3] = [255, 150, 80];

/// Lengths of robots from centre to nose \[css px\]: of the living, and of those that died out.
const LIVING: f64 = 8.0;
const DEAD: f64 = 6.5;

/// How far apart \[css px\] robots are seen to be, and how far they are where they are as good as one.
const SEEN: f64 = 10.0;
const ALIKE: f64 = 0.1;

/// All of them. How far they are apart is said over the picture.
pub fn overlay(scene: &mut Scene, model: &LapModel, layout: &Layout) {
    let (lap, course) = (model.lap(), model.setup().course);
    let title = if model.closes() {
        (lap::closes(), Role::Extinct)
    } else {
        (&*lap::Overlaid { m: &lap.particles().len() }.say(), Role::Ink)
    };
    scene.heading(&layout.large_header, title, "");

    let plane = map::plane(layout.large, course);
    scene.raster(plane.area, map::shares(lap, &model.shares(), course), Shading::Share);
    true_walls(scene, model, &plane);
    paths(scene, model, &plane);
    odometry(scene, model, &plane);
    true_path(scene, model, &plane);
    for particle in lap.particles() {
        scene.rimmed_robot(&plane, &particle.world_from_robot, LIVING, Role::Path);
    }
    nearby(scene, model, &plane);
    drive::draw(scene, model, &plane);
    scene.scale_bar(&plane, 1.0, f64::INFINITY);
    scene.frame(plane.area, 1.0, Role::Frame);
}

/// How far they are apart on new ground, as long as it is too little to be seen.
fn nearby(scene: &mut Scene, model: &LapModel, plane: &Plane) {
    let across = 2.0 * model.spread() * plane.scale;
    if !model.drifts() || !(ALIKE..SEEN).contains(&across) {
        return;
    }
    let (particles, shares) = (model.lap().particles(), model.shares());
    let mean = particles
        .iter()
        .zip(&shares)
        .fold([0.0; 2], |[x, y], (Particle { world_from_robot: at, .. }, share)| [x + share * at.x, y + share * at.y]);
    lens(scene, plane, mean, &mut |scene, near| {
        paths(scene, model, &near);
        for particle in particles {
            scene.rimmed_robot(&near, &particle.world_from_robot, LIVING, Role::Path);
        }
    });
}

/// Those that died out lately, the fainter the longer ago, and over them the living: what paths have in common once.
fn paths(scene: &mut Scene, model: &LapModel, plane: &Plane) {
    let mut drawn = BTreeSet::new();
    let living = branches(&mut drawn, plane, &mut model.lap().particles().iter().map(|particle| &particle.path));
    let ages: Vec<_> = FADING.iter().zip(model.dead()).collect();
    let mut robots = Vec::new();
    for (&level, dead) in ages.into_iter().rev() {
        scene.lines(branches(&mut drawn, plane, &mut dead.iter()), 1.5, Role::Fading(level));
        robots.extend(dead.iter().filter_map(|path: &Path| Some((plane.robot(&path.pose(), DEAD)?, level))));
    }
    scene.lines(living, 1.25, Role::Path);
    for (corners, level) in robots {
        scene.rimmed_polygon(corners, Role::Fading(level));
    }
}

/// What its colours and lines mean.
pub fn names(scene: &mut Scene, model: &LapModel, area: &Rect) {
    let share = |shares: &[f64]| Sample::cells(shares.iter().map(|p| map::share(*p)).collect(), Shading::Share);
    let several = model.lap().particles().len() > 1;
    let mut items = Vec::new();
    items.push((share(&[1.0]), if several { lap::wall_in_all() } else { common::wall() }));
    if several {
        items.push((share(&[0.1, 0.3, 0.5, 0.7, 0.9]).wide(34.0), lap::disagree()));
    }
    items.push((Sample::cell(FREE), common::free()));
    items.push((Sample::cell(UNKNOWN), common::unknown()));
    items.push((robot::sample(Role::Path), if several { lap::all_paths() } else { lap::its_path() }));
    if model.dead().any(|dead| !dead.is_empty()) {
        items.push((robot::sample(Role::Extinct), lap::died_lately()));
    }
    if model.shows_truth() {
        items.push((Sample::line(Role::Truth, 1.5, Some(TRUTH)), common::truth()));
    }
    if model.shows_raw() {
        items.push((Sample::line(Role::Raw, 2.0, Some(RAW)), common::raw_odometry_line()));
    }
    legend(scene, area, items);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Layout as _;
    use crate::{
        model::Model as _,
        scene::{Mark, SHARES},
        view::{self, View as _},
    };

    #[test]
    fn what_is_told_of_universes_on_new_ground_is_seen_by_eye_or_in_a_lens() {
        let view = super::super::LapView;
        for width in [322.0, 692.0, 1112.0] {
            let layout = Layout::new(width);
            let mut model = LapModel::default();
            let mut seen = Vec::new();
            for step in 0..=model.step_count() {
                model.seek(step);
                while model.pending() > 0 {
                    model.work();
                }
                let mut scene = Scene::new(width, view::Layout::height(&layout), String::new());
                view.draw(&model, &layout, &mut scene);
                let lens = scene.marks.iter().any(|mark| matches!(mark, Mark::Text(text) if text.text == "× 8"));
                let across = 2.0 * model.spread() * map::plane(layout.large, model.setup().course).scale;
                if step > 0 && step < model.closing().unwrap() {
                    assert!(across >= 10.0 || lens, "{width}: {across} px at step {step}");
                    seen.push(lens);
                } else {
                    assert!(!lens, "{width}: step {step}");
                }
            }
            assert!(seen.contains(&true) && !seen.ends_with(&[true]), "{width}: at last the eye is enough");
        }
    }

    #[test]
    fn a_share_of_universes_with_a_wall_is_a_shade_above_all_without() {
        assert_eq!([map::share(0.0), map::share(1.0)], [SHARES, 255]);
        assert!(map::share(0.5) > map::share(0.1));
    }
}
