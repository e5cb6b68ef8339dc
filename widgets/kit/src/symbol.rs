//! A symbol of the chapter that a reader points at, lit wherever a picture writes it.

use crate::{
    font,
    scene::{Mark, Rect, Role, Scene, Text},
};

/// Font size above which a text is no index \[css px\].
const LARGEST_INDEX: f64 = 10.0;

/// Between the letters and the frame, and thickness of the frame \[css px\].
const PAD: f64 = 2.0;
const WIDTH: f64 = 1.5;

/// Frames each place where the picture writes the symbol: a letter, or a letter and its index with `_` between them. An accent is an index too.
pub fn light(scene: &mut Scene, symbol: &str) {
    let (base, index) = symbol.split_once('_').unwrap_or((symbol, ""));
    if base.is_empty() {
        return;
    }
    let texts: Vec<&Text> =
        scene.marks.iter().filter_map(|mark| if let Mark::Text(text) = mark { Some(text) } else { None }).collect();
    let mut frames = Vec::new();
    for (i, text) in texts.iter().enumerate() {
        frame(text, texts.get(i + 1).copied(), base, index, &mut frames);
    }
    scene.marks.extend(frames);
}

/// Frames a symbol in a text; its index is in the text after it.
fn frame(text: &Text, next: Option<&Text>, base: &str, index: &str, frames: &mut Vec<Mark>) {
    if text.size < LARGEST_INDEX {
        return;
    }
    let written = next.filter(|next| next.size < LARGEST_INDEX).map_or("", |next| &next.text);
    let lower = next.is_some_and(|next| next.area.y > text.area.y);
    let letters = written.starts_with(is_letter) && lower;
    let [x, baseline] = text.origin();
    // Not by ranges: what a string says where one is between letters weighs more than all of this.
    let end = |to: usize| x + font::measure(text.text.get(..to).unwrap_or_default(), text.size, text.weight);
    let mut of_a_word = false;
    for (at, letter) in text.text.char_indices() {
        // What π is a factor of stands by itself.
        let apart = !core::mem::replace(&mut of_a_word, letter != 'π' && is_of_a_word(letter));
        let Some(after) = text.text.get(at..).and_then(|rest| rest.strip_prefix(base)).filter(|_| apart) else {
            continue;
        };
        let other = after.is_empty() && (letters || written == "^" || written == "~");
        let whole = if index.is_empty() { !other } else { after.is_empty() && written == index };
        if !whole || after.starts_with(|c| is_of_a_word(c) || c == '_') {
            continue;
        }
        let mut right = end(at + base.len());
        if let Some(next) = next.filter(|_| !index.is_empty()) {
            right = right.max(next.origin()[0] + next.width());
        }
        let area = Rect::new(end(at) - PAD, baseline - text.size, right - end(at) + 2.0 * PAD, 1.35 * text.size);
        frames.push(Mark::Frame { area, width: WIDTH, role: Role::Accent });
    }
}

/// Of the alphabets in which figures are written. Not `char::is_alphabetic`, whose tables of all scripts weigh more than the rest of this.
fn is_letter(c: char) -> bool {
    matches!(c, 'A'..='Z' | 'a'..='z' | 'À'..='Ö' | 'Ø'..='ö' | 'ø'..='ž' | 'Α'..='ω')
}

fn is_of_a_word(c: char) -> bool {
    is_letter(c) || c.is_ascii_digit()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        font::Weight,
        scene::{Formula, plain},
    };

    /// Left edges of the frames, in px beside the left edge of the picture.
    fn lit(symbol: &str) -> Vec<f64> {
        let mut scene = Scene::new(400.0, 100.0, String::new());
        Formula::new(13.0, Weight::Regular, Role::Ink).tex("S = H_m Σ H_m^T + Q, 2πS").draw(&mut scene, [0.0, 20.0]);
        Formula::new(13.0, Weight::Regular, Role::Ink).tex("w\u{303} = w").draw(&mut scene, [200.0, 20.0]);
        scene.n_eff(&Rect::new(0.0, 40.0, 200.0, 20.0), plain(12.0, Role::Ink));
        scene.text(Rect::new(0.0, 70.0, 200.0, 20.0), plain(12.0, Role::Ink), "Six Sigma of N, M");
        let before = scene.marks.len();
        light(&mut scene, symbol);
        let left = |mark: &Mark| if let Mark::Frame { area, .. } = mark { area.x.round() } else { panic!("{mark:?}") };
        scene.marks[before..].iter().map(left).collect()
    }

    #[test]
    fn a_symbol_is_lit_where_it_is_written_and_no_part_of_a_word_or_of_another_symbol_is() {
        assert!(matches!(lit("S")[..], [-2.0, _]));
        assert_eq!(lit("H_m").len(), 2);
        assert!(lit("H").is_empty());
        assert_eq!(lit("Q").len(), 1);
        assert!(lit("Q_j").is_empty());
        assert_eq!(lit("N_eff"), [-2.0]);
        assert_eq!(lit("N").len(), 1);
        assert_eq!(lit("M").len(), 1);
        assert_eq!(lit("w_~"), [198.0]);
        assert!(matches!(lit("w")[..], [x] if x > 210.0));
        assert!(lit("i").is_empty());
        assert!(lit("").is_empty());
    }
}
