//! How large a picture is shown, and what is told with it.

use super::Figure;
use crate::{
    action::Size,
    export::Entries,
    frame::{Frame, Layout, News, State, Told, Watch, news},
};

/// A picture is not made smaller than that to fit, whatever the size of its letters …
const LEGIBLE: f64 = 0.6;

/// … nor so narrow that its letters, times the share of the room's width that it takes, are less.
const WORTH: f64 = 0.25;

impl Figure {
    /// What is set, and how far it is computed.
    pub fn state(&self) -> State {
        let (query, values, target) = (self.query(), self.values(), self.target());
        let arrived = self.asked.arrived;
        let (step, last, answer) = self.ask(|model| {
            let waits = arrived && model.pending() > 0 && model.files().is_none();
            (model.step(), model.step_count(), if waits { model.answer() } else { 1 })
        });
        State { values, query, step, target, last, answer, unfit: self.ready().err() }
    }

    /// Paints what there is to see, and tells what there is to know. That something has changed, and a trace, are told in one frame only,
    /// unless it is a look ahead.
    pub fn frame(&mut self, ahead: bool) -> Frame<'_> {
        let busy = self.ask(|model| model.pending() > 0 && model.files().is_none());
        self.place();
        self.paint_placed();
        let done = !busy && !ahead;
        let changed = done && core::mem::take(&mut self.asked.changed);
        let trace = (done && core::mem::take(&mut self.asked.traces)).then(|| self.trace());
        self.asked.arrived |= !busy;
        let css = self.css();
        let now = Told {
            specs: self.params(),
            readouts: self.readouts(),
            chips: self.chips(),
            handles: self.handles(css),
            rooms: self.rooms(css),
        };
        let scale = self.asked.layout.as_ref().map_or(1.0, |layout| layout.scale);
        let gist = self.gist(css / scale).scaled(scale);
        let (watch, pace, main, instead, prediction) = self.ask(|model| {
            let watch = model.watch().map(|(from, words)| Watch { from, words });
            let main = model.compared().first().copied().unwrap_or_default();
            (watch, model.pace(), main, model.instead(), model.prediction())
        });
        let (sentence, told, difference) = (self.describe(), self.told(), self.difference());
        let before = &mut self.told;
        Frame {
            news: News {
                specs: news(&mut before.specs, now.specs),
                readouts: news(&mut before.readouts, now.readouts),
                chips: news(&mut before.chips, now.chips),
                handles: news(&mut before.handles, now.handles),
                rooms: news(&mut before.rooms, now.rooms),
            },
            busy,
            watch,
            pace,
            sentence,
            told,
            difference,
            instead: Entries(instead.into_iter().collect()),
            main,
            changed,
            trace,
            prediction,
            layout: self.asked.layout.clone(),
            gist,
        }
    }

    /// Width of the canvas \[css px\].
    pub(super) fn css(&self) -> f64 {
        self.asked.size.as_ref().map_or(0.0, |size| size.css)
    }

    fn place(&mut self) {
        let Some(Size { room, height, font_scale, .. }) = self.asked.size.filter(|size| size.room > 0.0) else {
            return;
        };
        let (mut scene, mut scale) = (room / font_scale, font_scale);
        let natural = round(self.height(scene) * scale);
        let mut best = WORTH;
        let grows = font_scale > 1.0 && height < f64::INFINITY; // a projector's letters, with its screen
        if natural > height || grows {
            let most_scale = if grows { f64::INFINITY } else { font_scale };
            // Other widths have other layouts, so the one is looked for that can be shown largest: in its letters, and in the room that it
            // takes of that there is. What would be too small to read is scrolled.
            let (mut wide, most) = (0.5 * scene, room / LEGIBLE);
            while wide <= most {
                let found = most_scale.min(room / wide).min(height / self.height(wide));
                let large = found * ((found * wide) / room).min(1.0);
                if found >= LEGIBLE && large > best {
                    (scene, scale, best) = (wide, found, large);
                }
                wide += 10.0;
            }
        }
        let width = (best > WORTH).then(|| room.min(scene * scale).floor());
        self.asked.layout = Some(Layout { scale, width, height: round(self.height(scene) * scale), natural });
    }

    /// Where there is something to paint on.
    fn paint_placed(&mut self) {
        let (Some(size), Some(layout)) = (self.asked.size, &self.asked.layout) else { return };
        let Size { css, px: [width, height], theme, .. } = size;
        if width > 0 && height > 0 {
            let dpr = f64::from(width) / css * layout.scale;
            self.paint(width, height, dpr, theme);
        }
    }
}

/// To the nearest whole number, halves up.
fn round(x: f64) -> f64 {
    (x + 0.5).floor()
}
