//! Lines of text that fit the box they were given.

use super::{Mark, Point, Rect, Role, Scene};
use crate::font::{self, Weight};

/// Which end of a line stays where it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Anchor {
    /// The left.
    Start,
    /// The middle.
    Middle,
    /// The right.
    End,
}

/// One line of text, its capitals centred between the upper and lower edge of its box.
#[derive(Clone, PartialEq, Debug)]
pub struct Text {
    /// The box; nothing is drawn outside.
    pub area: Rect,
    /// Where in its box.
    pub anchor: Anchor,
    /// Font size \[css px\].
    pub size: f64,
    /// Font weight.
    pub weight: Weight,
    /// Its meaning.
    pub role: Role,
    /// What is written.
    pub text: String,
}

impl Text {
    /// A line that is shortened with "…" if it is too long for its box.
    pub fn new(area: Rect, anchor: Anchor, size: f64, weight: Weight, role: Role, text: impl Into<String>) -> Self {
        let mut text: String = text.into();
        if font::measure(&text, size, weight) > area.w {
            text.push('…');
            while font::measure(&text, size, weight) > area.w && text.pop().is_some() {
                text.pop();
                text.truncate(text.trim_end().len());
                if !text.is_empty() {
                    text.push('…');
                }
            }
        }
        Self { area, anchor, size, weight, role, text }
    }

    /// Width of what is written \[css px\].
    pub fn width(&self) -> f64 {
        font::measure(&self.text, self.size, self.weight)
    }

    /// Left end of the baseline \[css px\].
    pub fn origin(&self) -> Point {
        let slack = self.area.w - self.width();
        let x = match self.anchor {
            Anchor::Start => self.area.x,
            Anchor::Middle => self.area.x + 0.5 * slack,
            Anchor::End => self.area.x + slack,
        };
        [x, self.area.y + 0.5 * (self.area.h + font::cap_height(self.size, self.weight))]
    }
}

/// A line of text as a mark.
pub fn text(area: Rect, anchor: Anchor, size: f64, weight: Weight, role: Role, text: impl Into<String>) -> Mark {
    Mark::Text(Text::new(area, anchor, size, weight, role, text))
}

/// The first of these texts that has room in its box; where none has, the last, shortened.
pub fn fitting(area: Rect, anchor: Anchor, size: f64, weight: Weight, role: Role, texts: &[&str]) -> Mark {
    let fits = |text: &&&str| font::measure(text, size, weight) <= area.w;
    let chosen = texts.iter().find(fits).or(texts.last()).copied().unwrap_or_default();
    text(area, anchor, size, weight, role, chosen)
}

/// A heading: a strong part, and more after it, in one line.
pub fn heading(scene: &mut Scene, area: &Rect, strong: (&str, Role), rest: &str) {
    let size = 13.5;
    let line = Text::new(*area, Anchor::Start, size, Weight::SemiBold, strong.1, strong.0);
    let used = line.width() + font::measure("  ", size, Weight::Regular);
    scene.marks.push(Mark::Text(line));
    if rest.is_empty() {
        return;
    }
    let rest_area = Rect::new(area.x + used, area.y, (area.w - used).max(0.0), area.h);
    scene.marks.push(text(rest_area, Anchor::Start, 12.5, Weight::Regular, Role::Muted, rest));
}

/// A heading whose second part is left out where there is no room for it.
pub fn heading_if_fits(scene: &mut Scene, area: &Rect, strong: (&str, Role), rest: &str) {
    let used = font::measure(strong.0, 13.5, Weight::SemiBold) + font::measure("  ", 13.5, Weight::Regular);
    let fits = used + font::measure(rest, 12.5, Weight::Regular) <= area.w;
    heading(scene, area, strong, if fits { rest } else { "" });
}

/// N with the index "eff", smaller and lower; returns where it ends \[css px\].
pub fn n_eff(scene: &mut Scene, area: &Rect, size: f64, weight: Weight, role: Role) -> f64 {
    let n = Text::new(*area, Anchor::Start, size, weight, role, "N");
    let index = Rect::new(area.x + n.width() + 0.5, area.y + 3.5, 20.0, area.h);
    scene.marks.push(Mark::Text(n));
    scene.marks.push(text(index, Anchor::Start, 8.5, weight, role, "eff"));
    index.x + 16.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_long_ends_in_dots_and_fits() {
        for width in 0..200 {
            let area = Rect::new(0.0, 0.0, f64::from(width), 20.0);
            let line = Text::new(area, Anchor::Start, 12.0, Weight::Regular, Role::Ink, "sixteen universes, ← 7");
            assert!(line.width() <= area.w, "{width}: {}", line.text);
            assert!(line.text.is_empty() || line.text.ends_with('…') || line.text.ends_with('7'));
        }
    }

    #[test]
    fn anchors_hold_their_end_of_the_line() {
        let area = Rect::new(10.0, 0.0, 100.0, 20.0);
        let x = |anchor| Text::new(area, anchor, 12.0, Weight::Regular, Role::Ink, "abc").origin()[0];
        let width = font::measure("abc", 12.0, Weight::Regular);
        assert_eq!(x(Anchor::Start), 10.0);
        assert_eq!(x(Anchor::End), 110.0 - width);
        assert!((x(Anchor::Middle) - (60.0 - 0.5 * width)).abs() < 1e-12);
    }
}
