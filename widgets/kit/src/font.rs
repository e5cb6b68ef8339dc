//! The embedded typeface: Inter in two weights, as outlines that `build.rs` took from `fonts/`.
//!
//! A figure writes with these and not with the browser's fonts, so that its text has the same pixels on every machine and
//! is as crisp as its lines at any zoom. The subset's digits are tabular: a number that changes keeps its width.

use std::sync::LazyLock;
use tables::{CHARACTERS, UNITS_PER_EM};
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
    let advances = weight.table().advances;
    let units: u32 = text.chars().map(|c| u32::from(advances[rank(c)])).sum();
    f64::from(units) * size / f64::from(UNITS_PER_EM)
}

/// Height of a capital letter at this font size, in the unit of `size`.
pub fn cap_height(size: f64, weight: Weight) -> f64 {
    f64::from(weight.table().cap_height) * size / f64::from(UNITS_PER_EM)
}

/// Adds the outlines of a line of text at this font size to a path: its baseline begins at `origin`; y down, as in the picture.
pub fn outline(path: &mut PathBuilder, text: &str, weight: Weight, size: f32, origin: [f32; 2]) {
    let (advances, glyphs) = (weight.table().advances, &GLYPHS[weight as usize]);
    let unit = size / UNITS_PER_EM;
    let [mut pen, baseline] = origin;
    for rank in text.chars().map(rank) {
        let glyph = &glyphs[rank];
        let mut steps = glyph.steps.iter();
        let mut last = [0_i16; 2];
        let mut point = || {
            let step = steps.next().copied().unwrap_or_default();
            last = [last[0] + step[0], last[1] + step[1]];
            let [x, y] = last.map(f32::from);
            [pen + x * unit, baseline - y * unit]
        };
        for verb in glyph.verbs {
            match verb {
                b'M' => {
                    let [x, y] = point();
                    path.move_to(x, y);
                }
                b'L' => {
                    let [x, y] = point();
                    path.line_to(x, y);
                }
                _ => {
                    let [[x1, y1], [x2, y2], [x, y]] = [point(), point(), point()];
                    path.cubic_to(x1, y1, x2, y2, x, y);
                }
            }
        }
        pen += f32::from(advances[rank]) * unit;
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
pub fn has(character: char) -> bool {
    CHARACTERS.binary_search(&character).is_ok()
}

/// Rank of a character in the tables; of one that they lack, that of `?`.
fn rank(character: char) -> usize {
    let found = CHARACTERS.binary_search(&character).or_else(|_| CHARACTERS.binary_search(&'?'));
    found.expect("the font has a question mark")
}

/// What `build.rs` writes for one weight: a row for each of [`CHARACTERS`].
struct Table {
    cap_height: i16,
    advances: &'static [u16],
    /// `M`, `L` and `C`, up to an `E`.
    verbs: &'static [u8],
    /// From point to point; of the second weight, what each has more than that of the first.
    steps: &'static [i8],
}

/// The outline of a character: its verbs, and how far each of its points is from the one before.
struct Glyph {
    verbs: &'static [u8],
    steps: Vec<[i16; 2]>,
}

/// By weight and rank.
static GLYPHS: LazyLock<[Vec<Glyph>; 2]> = LazyLock::new(|| {
    let regular = tables::REGULAR.glyphs(&[]);
    let semi_bold = tables::SEMI_BOLD.glyphs(&regular);
    [regular, semi_bold]
});

impl Table {
    /// Its outlines, where they are told from those of another weight.
    fn glyphs(&self, before: &[Glyph]) -> Vec<Glyph> {
        let mut bytes = self.steps.iter();
        let read = |(verbs, rank): (&'static [u8], usize)| {
            let known = before.get(rank).map_or(&[][..], |glyph| &glyph.steps);
            let points: usize = verbs.iter().map(|verb| if *verb == b'C' { 3 } else { 1 }).sum();
            let steps =
                (0..points).map(|k| known.get(k).copied().unwrap_or_default().map(|axis| axis + step(&mut bytes)));
            Glyph { verbs, steps: steps.collect() }
        };
        self.verbs.split(|verb| *verb == b'E').zip(0..CHARACTERS.len()).map(read).collect()
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
    use super::Table;
    include!(concat!(env!("OUT_DIR"), "/font.rs"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_our_figures_write_is_embedded() {
        let symbols = "←→×±σαη√²³°–—−·…≤≥≈’†μνφθδκχπρτωΔΛΣΩ∂∑∏∫∞≠½¼⁻¹⁺⁰₀₁₂₃ₜₓᵢⱼ";
        for character in (' '..='~').chain(symbols.chars()) {
            assert!(has(character), "{character}");
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
