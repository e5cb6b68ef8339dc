//! Writes what the figures say and what they say it with: the messages of the English catalogue as constants (`OUT_DIR/words.rs`), and
//! the outlines of the letters that it takes to write any catalogue, in two weights (`OUT_DIR/font.rs`), so that the figures carry no
//! parser of fonts. Coordinates are the font's own units, y up.

// It reads what the program also writes.
#[allow(dead_code)]
#[path = "src/message.rs"]
mod message;

use message::Piece;
use std::{
    collections::{BTreeMap, BTreeSet},
    env,
    fmt::Write,
    fs,
    path::Path,
};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// What is written besides the words: by readers, and in formulas.
const SIGNS: &str = "←→×±σαη√²³°–—−·…≤≥≈’†μνφθδκχπρτωΔΛΣΩ∂∑∏∫∞≠½¼⁻¹⁺⁰₀₁₂₃ₜₓᵢⱼ";

/// Sections of a catalogue that the program has nothing to say of: its language, and what the elements around the picture say.
const NOT_OURS: [&str; 2] = ["language", "elements"];

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

/// Those characters in code point order, with the glyph of each.
fn glyphs(face: &Face, characters: &BTreeSet<char>, file: &str) -> Vec<(char, GlyphId)> {
    let glyph =
        |&c: &char| (c, face.glyph_index(c).unwrap_or_else(|| panic!("{file} has no {c:?}: see fonts/subset.py")));
    characters.iter().map(glyph).collect()
}

fn table(name: &str, weight: &str, characters: &BTreeSet<char>) -> String {
    let file = &format!("fonts/Inter-{weight}-subset.otf");
    println!("cargo:rerun-if-changed={file}");
    let data = fs::read(file).unwrap_or_else(|e| panic!("{file}: {e}"));
    let face = Face::parse(&data, 0).unwrap_or_else(|e| panic!("{file}: {e}"));
    let scale = UNITS / f32::from(face.units_per_em());
    let units = |x: f32| (x * scale).round() as i32;
    let mut all = Outlines { scale, last: [0, 0], verbs: String::new(), steps: Vec::new() };
    let mut rows = String::new();
    for (character, glyph) in glyphs(&face, characters, file) {
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

/// A catalogue's messages: by section, and there by key.
type Catalogue = BTreeMap<String, BTreeMap<String, String>>;

fn catalogue(path: &Path) -> Catalogue {
    let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut sections: Catalogue = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    sections.retain(|section, _| !NOT_OURS.contains(&section.as_str()));
    sections
}

/// A function for a message, or a struct with its values. Titles are said before any language is known: a constant.
fn message(section: &str, key: &str, english: &str) -> String {
    let hash = message::key(&format!("{section}.{key}"));
    let pieces = message::pieces(english).unwrap_or_else(|| panic!("{section}.{key} is malformed: {english}"));
    let value = |piece| if let Piece::Value(name) | Piece::Plural(name, _) = piece { Some(name) } else { None };
    let values: BTreeSet<&str> = pieces.into_iter().filter_map(value).collect();
    let doc = format!("    #[doc = {english:?}]\n");
    if key == "title" {
        return format!("{doc}    pub(crate) const TITLE: &str = {english:?};\n");
    }
    if values.is_empty() {
        return format!(
            "{doc}    pub(crate) fn {key}() -> &'static str {{\n        text({english:?}, {hash})\n    }}\n"
        );
    }
    let name: String = key.split('_').map(capital).collect();
    let join = |row: &dyn Fn(&str) -> String| values.iter().map(|name| row(name)).collect::<String>();
    let fields = join(&|name| format!("pub(crate) {name}: &'a dyn Display, "));
    let own = join(&|name| format!("self.{name}, "));
    format!(
        "{doc}    pub(crate) struct {name}<'a> {{ {fields}}}\n    impl {name}<'_> {{\n        pub(crate) fn say(&self) -> String {{\n            \
         fill({english:?}, {hash}, &[{own}])\n        }}\n    }}\n"
    )
}

fn capital(word: &str) -> String {
    let (first, rest) = word.split_at(1);
    first.to_uppercase() + rest
}

/// The module of the messages, a module for each section.
fn words(english: &Catalogue) -> String {
    let mut module = String::new();
    for (section, messages) in english {
        writeln!(
            module,
            "pub(crate) mod {section} {{\n    #[allow(unused_imports)]\n    use super::{{Display, fill, text}};"
        )
        .unwrap();
        module.extend(messages.iter().map(|(key, english)| message(section, key, english)));
        module.push_str("}\n");
    }
    module
}

fn main() {
    let out = env::var_os("OUT_DIR").unwrap();
    let out = Path::new(&out);
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=src/message.rs");
    println!("cargo:rerun-if-changed=words");
    fs::write(out.join("words.rs"), words(&catalogue(Path::new("words/en.json")))).unwrap();
    let mut characters: BTreeSet<char> = (' '..='~').chain(SIGNS.chars()).collect();
    for file in fs::read_dir("words").expect("the folder of the catalogues") {
        let words = fs::read_to_string(file.unwrap().path()).unwrap();
        // Formulas draw accents by themselves.
        characters.extend(words.chars().filter(|c| !c.is_control() && !('\u{300}'..='\u{36f}').contains(c)));
    }
    fs::write(
        out.join("font.rs"),
        table("REGULAR", "Regular", &characters) + &table("SEMI_BOLD", "SemiBold", &characters),
    )
    .unwrap();
}
