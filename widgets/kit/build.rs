//! Writes what the kit itself says, the messages of its English catalogue (`OUT_DIR/words.rs`), and the outlines of the letters that figures
//! write with, in two weights (`OUT_DIR/font.rs`), so that they carry no parser of fonts. Coordinates are the font's own units, y up.

use fastslam_figures_catalogue::build;
use std::{collections::BTreeSet, env, fs, path::Path};
use ttf_parser::{Face, OutlineBuilder};

/// What is written besides the words: by readers, and in formulas.
const SIGNS: &str = "←→×±σαη√²³°–—−·…≤≥≈’†μνφθδκχπρτωΔΛΣΩ∂∑∏∫∞≠½¼⁻¹⁺⁰₀₁₂₃ₜₓᵢⱼ";

/// Letters of languages that figures speak, besides those of the kit's own words. The fonts have those of all languages in Latin, Greek and
/// Cyrillic script: one that is named here can be written.
const LETTERS: &str = "Üßäöü„“”";

/// Units of the tables in an em: a quarter of Inter's, which is a 40th of a pixel in text of 28 px.
const UNITS: f32 = 704.0;

/// The outline of a character, in units: its verbs, and how far each of its points is from the one before.
#[derive(Default)]
struct Outline {
    scale: f32,
    last: [i32; 2],
    verbs: String,
    steps: Vec<[i32; 2]>,
}

impl Outline {
    fn put(&mut self, verb: char, points: &[[f32; 2]]) {
        self.verbs.push(verb);
        for point in points {
            let [x, y] = point.map(|coordinate| (coordinate * self.scale).round() as i32);
            let [last_x, last_y] = std::mem::replace(&mut self.last, [x, y]);
            self.steps.push([x - last_x, y - last_y]);
        }
    }
}

impl OutlineBuilder for Outline {
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

/// A step in one axis as bytes: one at the end of its range is followed by more of the same step.
fn bytes(mut step: i32, into: &mut Vec<i8>) {
    loop {
        let part = step.clamp(-128, 127) as i8;
        into.push(part);
        step -= i32::from(part);
        if !matches!(part, -128 | 127) {
            break;
        }
    }
}

/// A weight's table, and the outlines of its characters, of which those of a weight before are told from: the letters of two weights differ by
/// little.
fn table(name: &str, weight: &str, characters: &BTreeSet<char>, before: &[Outline]) -> (String, Vec<Outline>) {
    let file = &format!("fonts/Inter-{weight}-subset.otf");
    println!("cargo:rerun-if-changed={file}");
    let data = fs::read(file).unwrap_or_else(|e| panic!("{file}: {e}"));
    let face = Face::parse(&data, 0).unwrap_or_else(|e| panic!("{file}: {e}"));
    let scale = UNITS / f32::from(face.units_per_em());
    let units = |x: f32| (x * scale).round() as i32;
    let (mut advances, mut verbs, mut steps, mut outlines) = (Vec::new(), String::new(), Vec::new(), Vec::new());
    for (rank, &c) in characters.iter().enumerate() {
        let glyph = face.glyph_index(c).unwrap_or_else(|| panic!("{file} has no {c:?}: see fonts/subset.py"));
        advances.push(units(face.glyph_hor_advance(glyph).unwrap_or(0).into()));
        let mut outline = Outline { scale, ..Outline::default() };
        face.outline_glyph(glyph, &mut outline);
        verbs += &outline.verbs;
        verbs.push('E');
        let known = before.get(rank).map_or(&[][..], |outline| &outline.steps);
        for (k, step) in outline.steps.iter().enumerate() {
            let known = known.get(k).copied().unwrap_or_default();
            step.iter().zip(known).for_each(|(step, known)| bytes(step - known, &mut steps));
        }
        outlines.push(outline);
    }
    let cap_height = units(face.capital_height().expect("the font tells its cap height").into());
    let table = format!(
        "pub(super) static {name}: Table = Table {{\n  cap_height: {cap_height},\n  advances: &{advances:?},\n  verbs: \
         b{verbs:?},\n  steps: &{steps:?},\n}};\n"
    );
    (table, outlines)
}

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    build::write_words(&[]);
    let mut characters: BTreeSet<char> = (' '..='~').chain(SIGNS.chars()).chain(LETTERS.chars()).collect();
    characters.extend(build::characters(Path::new("words")));
    let (regular, outlines) = table("REGULAR", "Regular", &characters, &[]);
    let (bold, _) = table("SEMI_BOLD", "SemiBold", &characters, &outlines);
    let characters: Vec<char> = characters.into_iter().collect();
    let em = format!("pub(super) const UNITS_PER_EM: f32 = {UNITS:?};\n");
    let characters = format!("pub(super) static CHARACTERS: &[char] = &{characters:?};\n");
    fs::write(Path::new(&env::var_os("OUT_DIR").unwrap()).join("font.rs"), em + &characters + &regular + &bold)
        .unwrap();
}
