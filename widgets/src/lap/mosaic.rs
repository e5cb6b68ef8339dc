//! Universes small: their maps, weights and paths, and what a resampling did to them.

use super::{
    grid::Tiles,
    layout::{Layout, RING},
    map::{self, ASPECT},
    model::LapModel,
};
use crate::{
    model::Model,
    order::ascending,
    robot::Poses,
    scene::{HEADING, Letters, Rect, Region, Role, Sample, Scene, Shading, legend, plain, strong},
    words::{common, lap},
};
use fastslam::{genealogy::Path, order::sorted};

/// Share of weight (1 = 1/M) at which a bar is full: a universe that weighs thrice its share.
const FULL_SHARE: f64 = 3.0;

/// Most universes that have a tile: of more, none could be read.
const TILES: usize = 16;

/// And most of those that a closed loop has left: few enough to be compared.
const SURVIVORS: usize = 4;

/// The slots that have a tile, in ascending order: the heaviest, and the one shown large; once the loop is closed, those of
/// [`least_alike`].
fn shown(model: &LapModel) -> Vec<u32> {
    let (weights, selected) = (model.lap().weights(), model.selected());
    // After a resampling all weigh the same: last come those that took the place of one who has just died, and are crossed out for that.
    let crossed = if model.closed() { model.extinct() } else { Vec::new() };
    // Of equals, those in the first slots.
    let lightness = |(slot, weight): (usize, &f64)| match slot as u32 {
        slot if slot == selected => f64::NEG_INFINITY,
        slot => f64::from(u8::from(crossed.contains(&slot))) - weight,
    };
    let lightness: Vec<f64> = weights.iter().enumerate().map(lightness).collect();
    let mut slots: Vec<u32> = ascending(&lightness).into_iter().map(|slot| slot as u32).collect();
    if model.closed() {
        slots = least_alike(model, slots);
    }
    slots.truncate(TILES);
    sorted(slots, Ord::cmp)
}

/// The first of these, and by turns the one whose path parted first from those of all before it, of equals the earlier.
fn least_alike(model: &LapModel, mut left: Vec<u32>) -> Vec<u32> {
    let nodes = |slot: u32| model.lap().particles()[slot as usize].path.back().map(Path::id);
    let (mut slots, mut known) = (Vec::new(), Vec::new());
    while slots.len() < SURVIVORS && !left.is_empty() {
        let (mut next, mut most) = (0, 0);
        for (rank, &slot) in left.iter().enumerate() {
            let own = nodes(slot).take_while(|node| !known.contains(node)).count();
            if own > most {
                (next, most) = (rank, own);
            }
        }
        let slot = left.remove(next);
        known.extend(nodes(slot));
        slots.push(slot);
    }
    slots
}

/// The border of a universe that weighs this share (1 = 1/M), inside of its tile, and at its lower edge a bar as long as that weight.
fn border(scene: &mut Scene, area: Rect, share: f64, high: f64) {
    let bar = Rect::new(area.x, area.bottom() - high, area.w * (share / FULL_SHARE).clamp(0.0, 1.0), high);
    scene.frame(area, 1.0, Role::Weight(0));
    scene.fill(bar, Role::Weight(255));
}

/// The sign of a universe that died out: a cross on paper.
fn extinct_cross(scene: &mut Scene, area: Rect) {
    scene.fill(area, Role::Paper);
    scene.cross(area.inset(0.2 * area.w), (0.16 * area.w).max(1.0), Role::Extinct);
}

/// What a resampling did, as long as there is room for \[css px\].
fn resampled(dead: usize, m: usize, room: f64) -> String {
    let long = lap::Resampled { dead: &dead, m: &m }.say();
    let fits = HEADING.width(&long) <= room;
    if fits { long } else { lap::DiedOf { dead: &dead, m: &m }.say() }
}

/// Up to [`TILES`] universes, each in a tile that can be chosen.
pub fn mosaic(scene: &mut Scene, model: &LapModel, layout: &Layout) {
    let (lap, selected) = (model.lap(), model.selected());
    let m = lap.particles().len();
    let slots = shown(model);
    let extinct = model.extinct();
    let name = common::UniverseCount { m: &m }.say();
    let few = if model.closed() && slots.len() < m { lap::LeastAlike { n: &slots.len() }.say() } else { String::new() };
    let (title, role, rest) = match &model.report().ancestors {
        Some(_) if extinct.is_empty() => (name, Role::Ink, lap::none_died_out().into()),
        Some(_) => (resampled(extinct.len(), m, layout.mosaic_header.w), Role::Extinct, few),
        None if m == 1 => (name, Role::Ink, lap::only_hypothesis().into()),
        None if model.step() == 0 => (name, Role::Ink, lap::all_alike().into()),
        None if !few.is_empty() => (name, Role::Ink, few),
        None if slots.len() < m => (name, Role::Ink, lap::Heaviest { n: &slots.len() }.say()),
        None => (name, Role::Ink, lap::map_each().into()),
    };
    scene.heading_fit(&layout.mosaic_header, (&title, role), &[rest]);

    let tiles = Tiles::fit(&layout.mosaic.inset(RING), slots.len(), ASPECT);
    let width = tiles.size[0];
    let full = (0.05 * width).clamp(2.0, 5.0);
    let map_area = |rank: usize| tiles.tile(rank).inset(full + 1.0);
    for (rank, &slot) in slots.iter().enumerate() {
        let tile = tiles.tile(rank);
        let cells = map::shades(&lap.particles()[slot as usize].map, model.setup().course);
        scene.raster(map_area(rank), cells, Shading::Map);
        border(scene, tile, lap.weights()[slot as usize] * m as f64, full);
        scene.regions.push(Region { area: tile, target: slot });
        if slot == selected && !model.overlaid() {
            scene.frame(tile.inset(-(0.5 * tiles.gap[1]).clamp(1.0, RING)), 1.5, Role::Ink);
        }
    }
    paths(scene, model, &slots, &map_area, width);
    if m > 1 {
        for (rank, &slot) in slots.iter().enumerate() {
            origin(scene, model, slot, &map_area(rank), width);
            if extinct.contains(&slot) {
                let Rect { x, y, w, .. } = map_area(rank);
                let side = (0.16 * w).clamp(8.0, 14.0);
                extinct_cross(scene, Rect::new(x + w - side, y, side, side));
            }
        }
    }
}

/// Paths and robots of all tiles, one mark for each kind.
fn paths(scene: &mut Scene, model: &LapModel, slots: &[u32], map_area: &dyn Fn(usize) -> Rect, width: f64) {
    let (mut lines, mut robots) = (Vec::new(), Vec::new());
    let length = (0.06 * width).clamp(2.5, 6.0);
    for (rank, &slot) in slots.iter().enumerate() {
        let plane = map::plane(map_area(rank), model.setup().course);
        lines.extend(plane.path(&model.lap().path(slot as usize), 1.0));
        robots.extend(plane.robot(&model.lap().particles()[slot as usize].world_from_robot, length));
    }
    scene.lines(lines.clone(), 3.0, Role::Paper);
    scene.lines(lines, 1.5, Role::Path);
    scene.polygons(robots, Role::Path);
}

/// The number of a slot, and at a resampling whom its universe was copied from.
fn origin(scene: &mut Scene, model: &LapModel, slot: u32, map: &Rect, width: f64) {
    let size = (0.12 * width).clamp(8.5, 11.0);
    let mut plate = |label: &str, ground, letters: Letters, bottom: bool| {
        let (w, h) = (letters.width(label) + 5.0, size + 2.0);
        let area = Rect::new(map.x, if bottom { map.bottom() - h } else { map.y }, w.min(map.w), h);
        scene.fill(area, ground);
        scene.text(area, letters.middle(), label);
    };
    let chosen = slot == model.selected() && !model.overlaid();
    let (ground, role) = if chosen { (Role::Ink, Role::Paper) } else { (Role::Paper, Role::Muted) };
    plate(&slot.to_string(), ground, plain(size, role), false);
    let parent = model.report().ancestors.as_ref().map(|ancestors| ancestors[slot as usize]);
    if let Some(parent) = parent.filter(|&parent| parent != slot) {
        plate(&format!("← {parent}"), Role::Paper, strong(size, Role::Copied), true);
    }
}

/// What bars and marks mean.
pub fn notes(scene: &mut Scene, model: &LapModel, area: &Rect) {
    let weight = |share| Sample::new(move |scene, place| border(scene, *place, share, 4.0));
    if model.lap().particles().len() == 1 {
        legend(scene, area, [(weight(1.0), lap::all_weight())]);
        return;
    }
    let weights = [(weight(0.0), lap::no_weight()), (weight(1.0), "1/M"), (weight(FULL_SHARE), lap::much_weight())];
    let letters = strong(10.5, Role::Copied);
    let copied = Sample::new(move |scene, place| scene.text(*place, letters, "← 7")).wide(letters.width("← 7") + 4.0);
    let died = Sample::at(|scene, at| extinct_cross(scene, Rect::around(at, 5.0)));
    let resampled = Sample::dot(Role::Copied, 2.5);
    let resampling = [(resampled, common::resampled()), (copied, lap::copied_from()), (died, common::died_out())];
    let y = legend(scene, area, weights);
    legend(scene, &Rect { y, ..*area }, resampling);
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::genealogy::Descent;

    fn at(model: &mut LapModel, step: u32) {
        model.seek(step);
        while model.pending() > 0 {
            model.work();
        }
    }

    #[test]
    fn sixteen_tiles_give_way_to_the_four_least_alike_once_the_loop_is_closed() {
        let mut model = LapModel::default();
        for step in 0..=model.step_count() {
            at(&mut model, step);
            let slots = shown(&model);
            assert!(slots.is_sorted() && slots.contains(&model.report().best));
            assert_eq!(slots.len(), if model.closed() { 4 } else { 16 }, "step {step}");
            // No two of all parted before two of these did.
            let of =
                |slots: &[u32]| Descent::of(slots.iter().map(|&slot| &model.lap().particles()[slot as usize].path));
            assert_eq!(of(&slots).coalescence(), of(&(0..16).collect::<Vec<_>>()).coalescence(), "step {step}");
            // Nobody is crossed out while an equal who is not could be shown.
            if let Some(ancestors) = model.report().ancestors.clone().filter(|_| model.closed()) {
                let extinct = model.extinct();
                let crossed = |slot: &&u32| **slot != model.selected() && extinct.contains(slot);
                for &slot in slots.iter().filter(crossed) {
                    let equal = |other: &u32| ancestors[*other as usize] == ancestors[slot as usize];
                    let mut better = (0..16).filter(equal).filter(|other| !extinct.contains(other));
                    assert!(better.all(|other| slots.contains(&other)), "step {step}: {slot} of {slots:?}");
                }
            }
        }
        assert!(model.closed());
        let other = (0..16).find(|slot| !shown(&model).contains(slot)).unwrap();
        model.pick(other);
        assert!(shown(&model).contains(&other), "a universe that is shown large has its tile");
    }
}
