//! Writes what the kit itself says, the messages of its English catalogue (`OUT_DIR/words.rs`), and the outlines of the letters that figures
//! write with, in two weights (`OUT_DIR/font.rs`), so that they carry no parser of fonts. Coordinates are the font's own units, y up.

use fastslam_figures_catalogue::build;
use std::{collections::BTreeSet, env, fmt::Write, fs, path::Path};
use ttf_parser::{Face, OutlineBuilder};

/// What is written besides the words: by readers, and in formulas.
const SIGNS: &str = "←→×±σαη√²³°–—−·…≤≥≈’†μνφθδκχπρτωΔΛΣΩ∂∑∏∫∞≠½¼⁻¹⁺⁰₀₁₂₃ₜₓᵢⱼ";

/// Letters of languages that figures speak, besides those of the kit's own words. The fonts have those of all languages in Latin, Greek and
/// Cyrillic script: one that is named here can be written.
const LETTERS: &str = "Üßäöü„“”";

/// Units of the tables in an em: a quarter of Inter's, which is a 40th of a pixel in text of 28 px.
const UNITS: f32 = 704.0;

/// Outlines as `src/font.rs` reads them: each a row of verbs, and of steps from point to point.
struct Outlines {
    scale: f32,
    last: [i32; 2],
    verbs: String,
    steps: Vec<i8>,
}

impl Outlines {
    fn put(&mut self, verb: char, points: &[[f32; 2]]) {
        self.verbs.push(verb);
        for point in points {
            for (axis, &coordinate) in point.iter().enumerate() {
                let unit = (coordinate * self.scale).round() as i32;
                let mut step = unit - std::mem::replace(&mut self.last[axis], unit);
                // A byte at the end of the range is followed by more of the same step.
                loop {
                    let part = step.clamp(-128, 127) as i8;
                    self.steps.push(part);
                    step -= i32::from(part);
                    if !matches!(part, -128 | 127) {
                        break;
                    }
                }
            }
        }
    }
}

impl OutlineBuilder for Outlines {
    fn move_to(&mut self, x: f32, y: f32) {
        self.put('M', &[[x, y]]);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.put('L', &[[x, y]]);
    }
    fn quad_to(&mut self, _: f32, _: f32, _: f32, _: f32) {
        unimplemented!("the fonts are of cubic curves");
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.put('C', &[[x1, y1], [x2, y2], [x, y]]);
    }
    fn close(&mut self) {} // a fill closes every contour
}

/// A weight's characters, in code point order.
fn table(name: &str, weight: &str, characters: &BTreeSet<char>) -> String {
    let file = &format!("fonts/Inter-{weight}-subset.otf");
    println!("cargo:rerun-if-changed={file}");
    let data = fs::read(file).unwrap_or_else(|e| panic!("{file}: {e}"));
    let face = Face::parse(&data, 0).unwrap_or_else(|e| panic!("{file}: {e}"));
    let scale = UNITS / f32::from(face.units_per_em());
    let units = |x: f32| (x * scale).round() as i32;
    let mut all = Outlines { scale, last: [0, 0], verbs: String::new(), steps: Vec::new() };
    let mut rows = String::new();
    let glyph =
        |&c: &char| (c, face.glyph_index(c).unwrap_or_else(|| panic!("{file} has no {c:?}: see fonts/subset.py")));
    for (character, glyph) in characters.iter().map(glyph) {
        let advance = units(face.glyph_hor_advance(glyph).unwrap_or(0).into());
        let (verbs, steps) = (all.verbs.len(), all.steps.len());
        writeln!(rows, "    Glyph {{ character: {character:?}, advance: {advance}, verbs: {verbs}, steps: {steps} }},")
            .unwrap();
        all.last = [0, 0];
        face.outline_glyph(glyph, &mut all);
        all.verbs.push('E');
    }
    let cap_height = units(face.capital_height().expect("the font tells its cap height").into());
    let Outlines { verbs, steps, .. } = all;
    format!(
        "pub(super) static {name}: Table = Table {{\n  units_per_em: {UNITS:?}, cap_height: {cap_height},\n  glyphs: &[\n{rows}  ],\n  \
         verbs: b{verbs:?},\n  steps: &{steps:?},\n}};\n"
    )
}

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    build::write_words(&[]);
    let mut characters: BTreeSet<char> = (' '..='~').chain(SIGNS.chars()).chain(LETTERS.chars()).collect();
    characters.extend(build::characters(Path::new("words")));
    let [regular, bold] =
        [("REGULAR", "Regular"), ("SEMI_BOLD", "SemiBold")].map(|(name, weight)| table(name, weight, &characters));
    fs::write(Path::new(&env::var_os("OUT_DIR").unwrap()).join("font.rs"), regular + &bold).unwrap();
}
