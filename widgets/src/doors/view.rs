//! What is to be seen of the corridor and of both beliefs, and what of it can be moved.

use super::{
    history::History,
    layout::{CORRIDOR, HISTORY, Layout},
    model::DoorsModel,
    recipe::{DOOR, NAMES},
    strip::Strip,
};
use crate::{
    decimal::write,
    model::Declared,
    scene::{Handle, Point, Scene},
    view::View,
    words::doors as words,
};

/// Name of the handle, and of its parameter, that says where the ride ends.
const END: &str = "end";

/// What the doors are called.
const TITLES: [fn() -> &'static str; NAMES.len()] =
    [words::door_1, words::door_2, words::door_3, words::door_4, words::door_5, words::door_6, words::door_7];

/// The figure of the doors, as it is seen.
#[derive(Default)]
pub struct DoorsView;

impl View for DoorsView {
    type Model = DoorsModel;
    type Layout = Layout;

    fn draw(&self, model: &DoorsModel, layout: &Layout, scene: &mut Scene) {
        if layout.panels.has(CORRIDOR) {
            let strip = Strip { model, layout };
            strip.draw(scene);
            let metres = |place: f64| words::Metres { place: &write(place) }.say();
            for (rank, place) in model.setup().doors.iter().enumerate() {
                scene.handles.push(Handle {
                    name: NAMES[rank],
                    title: TITLES[rank]().into(),
                    at: strip.door(rank),
                    axes: axis(rank),
                    value: *place,
                    text: metres(*place),
                    hover: None,
                });
            }
            if model.will_be_carried() {
                scene.handles.push(Handle::of(&[END], words::end(), strip.end(), model.end(), metres(model.end())));
            }
        }
        if layout.panels.has(HISTORY) {
            History { model, layout }.draw(scene);
        }
    }

    fn drag(&self, model: &mut DoorsModel, layout: &Layout, handle: &str, [x, _]: Point) {
        let place = Strip { model, layout }.place(x);
        put(model, handle, (place / DOOR.2).round() * DOOR.2);
    }

    fn nudge(&self, model: &mut DoorsModel, handle: &str, [right, _]: [f64; 2]) {
        let doors = &model.setup().doors;
        let from = rank(handle).map_or(Some(model.end()), |rank| doors.get(rank).copied());
        if let Some(from) = from {
            put(model, handle, from + DOOR.2 * right);
        }
    }
}

/// The door of a handle.
fn rank(handle: &str) -> Option<usize> {
    NAMES.iter().position(|name| *name == handle)
}

/// The parameter that a door's handle moves.
fn axis(rank: usize) -> &'static [&'static str] {
    core::slice::from_ref(&NAMES[rank])
}

/// Puts what a handle stands for to a place \[m\], or as near to it as it can be.
fn put(model: &mut DoorsModel, handle: &str, place: f64) {
    match rank(handle) {
        _ if !place.is_finite() => (),
        Some(rank) => model.change(|recipe| recipe.put_door(rank, place)),
        None if handle == END => model.change(|recipe| recipe.put_end(place)),
        None => (),
    }
}
