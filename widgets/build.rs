//! Writes the glyph outlines of the two embedded fonts into one table each (`OUT_DIR/font.rs`), so that the figures carry
//! no font parser. Coordinates are the font's own units, y up.

use std::{env, fmt::Write, fs, path::Path};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Verbs and coordinates of one outline, in the order that `src/font.rs` reads them.
#[derive(Default)]
struct Outline {
    verbs: Vec<u8>,
    coordinates: Vec<i16>,
}

impl Outline {
    fn put(&mut self, verb: u8, coordinates: &[f32]) {
        self.verbs.push(verb);
        self.coordinates.extend(coordinates.iter().map(|&c| c.round() as i16));
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.put(b'M', &[x, y]);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.put(b'L', &[x, y]);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.put(b'Q', &[x1, y1, x, y]);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.put(b'C', &[x1, y1, x2, y2, x, y]);
    }
    fn close(&mut self) {
        self.put(b'Z', &[]);
    }
}

/// All characters of the font in code point order, with the glyph of each.
fn characters(face: &Face) -> Vec<(char, GlyphId)> {
    let mut found = Vec::new();
    for table in face.tables().cmap.expect("the font has a cmap").subtables.into_iter().filter(|t| t.is_unicode()) {
        table.codepoints(|code| {
            if let (Some(character), Some(glyph)) = (char::from_u32(code), face.glyph_index_or_none(code)) {
                found.push((character, glyph));
            }
        });
    }
    found.sort();
    found.dedup();
    found
}

trait GlyphOf {
    fn glyph_index_or_none(&self, code: u32) -> Option<GlyphId>;
}

impl GlyphOf for Face<'_> {
    fn glyph_index_or_none(&self, code: u32) -> Option<GlyphId> {
        char::from_u32(code).and_then(|character| self.glyph_index(character))
    }
}

fn table(name: &str, file: &str) -> String {
    println!("cargo:rerun-if-changed={file}");
    let data = fs::read(file).unwrap_or_else(|e| panic!("{file}: {e}"));
    let face = Face::parse(&data, 0).unwrap_or_else(|e| panic!("{file}: {e}"));
    let mut all = Outline::default();
    let mut glyphs = String::new();
    for (character, glyph) in characters(&face) {
        let (verbs, coordinates) = (all.verbs.len(), all.coordinates.len());
        face.outline_glyph(glyph, &mut all);
        let advance = face.glyph_hor_advance(glyph).unwrap_or(0);
        let end = all.verbs.len();
        writeln!(
            glyphs,
            "    Glyph {{ character: {character:?}, advance: {advance}, verbs: ({verbs}, {end}), coordinates: {coordinates} }},"
        )
        .unwrap();
    }
    let cap_height = face.capital_height().expect("the font tells its cap height");
    let verbs = String::from_utf8(all.verbs).unwrap();
    format!(
        "pub(super) static {name}: Table = Table {{\n  units_per_em: {}, cap_height: {cap_height},\n  glyphs: &[\n{glyphs}  ],\n  \
         verbs: b{verbs:?},\n  coordinates: &{:?},\n}};\n",
        face.units_per_em(),
        all.coordinates
    )
}

fn main() {
    let out = Path::new(&env::var_os("OUT_DIR").unwrap()).join("font.rs");
    let regular = table("REGULAR", "fonts/Inter-Regular-subset.otf");
    let semi_bold = table("SEMI_BOLD", "fonts/Inter-SemiBold-subset.otf");
    fs::write(out, regular + &semi_bold).unwrap();
    println!("cargo:rerun-if-changed=build.rs");
}
