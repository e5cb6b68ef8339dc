//! The embedded typeface: Inter in two weights, as outlines that `build.rs` took from `fonts/`.
//!
//! A figure writes with these and not with the browser's fonts, so that its text has the same pixels on every machine and
//! is as crisp as its lines at any zoom. The subset's digits are tabular: a number that changes keeps its width.

use tiny_skia::PathBuilder;

/// Weight of the strokes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Weight {
    /// Inter Regular.
    Regular,
    /// Inter SemiBold.
    SemiBold,
}

/// Width of a line of text at this font size, in the unit of `size`. Characters the font lacks are as wide as `?`.
pub fn measure(text: &str, size: f64, weight: Weight) -> f64 {
    let table = weight.table();
    let units: u32 = text.chars().map(|c| u32::from(table.glyph(c).advance)).sum();
    f64::from(units) * size / f64::from(table.units_per_em)
}

/// Height of a capital letter at this font size, in the unit of `size`.
pub fn cap_height(size: f64, weight: Weight) -> f64 {
    let table = weight.table();
    f64::from(table.cap_height) * size / f64::from(table.units_per_em)
}

/// Adds the outlines of a line of text at this font size to a path: its baseline begins at `origin`; y down, as in the picture.
pub fn outline(path: &mut PathBuilder, text: &str, weight: Weight, size: f32, origin: [f32; 2]) {
    let table = weight.table();
    let unit = size / table.units_per_em;
    let [mut pen, baseline] = origin;
    for glyph in text.chars().map(|c| table.glyph(c)) {
        let mut steps = table.steps[usize::from(glyph.steps)..].iter();
        let mut last = [0_i16; 2];
        let mut point = || {
            last = last.map(|from| from + step(&mut steps));
            let [x, y] = last.map(f32::from);
            [pen + x * unit, baseline - y * unit]
        };
        for verb in &table.verbs[usize::from(glyph.verbs)..] {
            match verb {
                b'M' => {
                    let [x, y] = point();
                    path.move_to(x, y);
                }
                b'L' => {
                    let [x, y] = point();
                    path.line_to(x, y);
                }
                b'C' => {
                    let [[x1, y1], [x2, y2], [x, y]] = [point(), point(), point()];
                    path.cubic_to(x1, y1, x2, y2, x, y);
                }
                _ => break,
            }
        }
        pen += f32::from(glyph.advance) * unit;
    }
}

/// A step in one axis: bytes up to the first that is not at the end of its range.
fn step<'a>(bytes: &mut impl Iterator<Item = &'a i8>) -> i16 {
    let mut sum = 0;
    for &byte in bytes {
        sum += i16::from(byte);
        if !matches!(byte, i8::MIN | i8::MAX) {
            break;
        }
    }
    sum
}

/// True if the font has this character.
pub fn has(character: char, weight: Weight) -> bool {
    weight.table().find(character).is_some()
}

/// What `build.rs` writes for one weight.
struct Table {
    units_per_em: f32,
    cap_height: i16,
    glyphs: &'static [Glyph],
    verbs: &'static [u8],
    steps: &'static [i8],
}

/// Where a character's outline begins in its table, in code point order.
struct Glyph {
    character: char,
    advance: u16,
    verbs: u16,
    steps: u16,
}

impl Table {
    fn find(&self, character: char) -> Option<&Glyph> {
        self.glyphs.binary_search_by_key(&character, |g| g.character).ok().map(|i| &self.glyphs[i])
    }

    fn glyph(&self, character: char) -> &Glyph {
        self.find(character).or_else(|| self.find('?')).expect("the font has a question mark")
    }
}

impl Weight {
    fn table(self) -> &'static Table {
        match self {
            Weight::Regular => &tables::REGULAR,
            Weight::SemiBold => &tables::SEMI_BOLD,
        }
    }
}

mod tables {
    use super::{Glyph, Table};
    include!(concat!(env!("OUT_DIR"), "/font.rs"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_our_figures_write_is_embedded() {
        let symbols = "←→×±σαη√²³°–—−·…≤≥≈’†μνφθδκχπρτωΔΛΣΩ∂∑∏∫∞≠½¼⁻¹⁺⁰₀₁₂₃ₜₓᵢⱼ";
        for weight in [Weight::Regular, Weight::SemiBold] {
            for character in (' '..='~').chain(symbols.chars()) {
                assert!(has(character, weight), "{character}");
            }
        }
    }

    #[test]
    fn numbers_keep_their_width_when_a_digit_changes() {
        for weight in [Weight::Regular, Weight::SemiBold] {
            let widths: Vec<f64> = ('0'..='9').map(|c| measure(&c.to_string(), 1.0, weight)).collect();
            // Inter's 4 is a few units of 2816 narrower: a fiftieth of a pixel.
            assert!(widths.iter().all(|w| (w - widths[0]).abs() < 0.002), "{widths:?}");
        }
    }

    #[test]
    fn an_unknown_character_is_drawn_as_a_question_mark() {
        assert_eq!(measure("\u{1F600}", 2.0, Weight::Regular), measure("?", 2.0, Weight::Regular));
    }

    #[test]
    fn a_capital_stands_on_the_baseline_and_reaches_the_cap_height() {
        let mut path = PathBuilder::new();
        outline(&mut path, "H", Weight::Regular, 10.0, [3.0, 20.0]);
        let bounds = path.finish().unwrap().bounds();
        assert_eq!(bounds.bottom(), 20.0);
        assert!((f64::from(20.0 - bounds.top()) - cap_height(10.0, Weight::Regular)).abs() < 1e-3);
    }
}
