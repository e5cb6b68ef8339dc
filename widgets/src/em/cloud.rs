//! The particles on the same log: their paths, and where they were right after the robot was carried.

use super::{
    layout::Layout,
    model::EmModel,
    strips::{self, SIZE, strip, truth, y},
    told::percent,
};
use crate::{
    scene::{Rect, Role, Scene, plain, strong},
    words::em as words,
};
use fastslam_lab::experiment::em::{AGAIN_BELOW, CORRIDOR, LENGTH};

/// Draws all of it.
pub fn cloud(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let (area, steps) = (layout.cloud.area, model.log().steps());
    let m = &model.log().setup().particles;
    let name = words::ParticlesAre { m }.say();
    let what = [words::cloud_what(), words::cloud_what_short()];
    scene.heading_fit(&layout.cloud.header, (&name, Role::Ink), &what);
    strips::scale(scene, &layout.cloud_scale);
    let columns: Vec<_> = (0..=steps).map(|step| model.cloud().shares(step).map(<[f64]>::to_vec)).collect();
    strip(scene, area, &columns);
    strips::carried(scene, model, &area);
    if model.again().is_some() {
        truth(scene, model, &area);
    } else {
        let done = &(steps - model.cloud().pending(model.log()) as usize);
        let line = Rect::new(area.x, area.centre()[1] - 9.0, area.w, 18.0);
        scene.text(line, plain(12.0, Role::Muted).middle(), &words::Running { done, all: &steps }.say());
    }
    scene.frame(area, 1.0, Role::Frame);
    peaks(scene, model, layout);
}

/// Both answers, as far as the particles hold them, and the one of EM mapping.
fn peaks(scene: &mut Scene, model: &EmModel, layout: &Layout) {
    let area = layout.peaks.area;
    scene.text(layout.peaks.header, strong(12.5, Role::Ink), words::put_down_at());
    let limit = y(&area, AGAIN_BELOW);
    scene.dash(&[[area.x, limit], [area.right(), limit]], 1.0, [1.0, 3.0], Role::Muted);
    if let Some(shares) = log_shares(model) {
        let most = shares.iter().copied().fold(0.0, f64::max);
        let height = area.h * CORRIDOR.cell_size / LENGTH;
        for (cell, share) in shares.iter().enumerate().filter(|(_, share)| **share > 0.0) {
            let top = area.bottom() - height * (cell + 1) as f64;
            let bar = Rect::new(area.x, top + 0.25, (0.42 * area.w * share / most).max(1.0), height - 0.5);
            scene.fill(bar, Role::Prior);
        }
    }
    if let Some(again) = model.again() {
        let answers = [
            (1.0 - again, words::new_doors(), 0.5 * (LENGTH + AGAIN_BELOW)),
            (again, words::again_doors(), 0.5 * AGAIN_BELOW),
        ];
        for (share, what, at) in answers {
            let left = area.x + 0.46 * area.w;
            let middle = y(&area, at);
            let line = |y: f64, h: f64| Rect::new(left, y, area.right() - left - 3.0, h);
            let (percent, told) = (format!("{} %", percent(share)), plain(SIZE, Role::Muted));
            if area.h > 100.0 {
                scene.text(line(middle - 16.0, 17.0), strong(14.0, Role::Ink), &percent);
                if let Some(what) = told.fitting(area.right() - left - 3.0, &[what]) {
                    scene.text(line(middle + 1.0, 14.0), told, what);
                }
            } else {
                scene.text(line(middle - 8.0, 16.0), strong(12.5, Role::Ink), &percent);
            }
        }
    }
    // Of EM mapping: one.
    if let Some((place, _)) = model.put_down() {
        let y = y(&area, place);
        scene.polygon(vec![[area.x - 7.0, y - 5.0], [area.x + 1.0, y], [area.x - 7.0, y + 5.0]], Role::Posterior);
    }
    scene.frame(area, 1.0, Role::Frame);
}

fn log_shares(model: &EmModel) -> Option<&[f64]> {
    model.cloud().shares(model.log().carried)
}
