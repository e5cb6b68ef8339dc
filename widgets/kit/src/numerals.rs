//! Numbers as readers are to see them: the one place where those of a picture, a readout or a sentence get a minus sign, and a decimal comma
//! for classes that write one. Attributes, links and files keep hyphen and point.

use crate::scene::{Mark, Scene};

/// What is written as a number and is a name, as that of a version: it keeps its point.
pub struct Names {
    /// Such names, of one digit before the point and one after it.
    pub names: &'static [&'static str],
    /// What a name follows; else it is a number.
    pub after: &'static [&'static str],
}

impl Names {
    /// All that is written as a number is one.
    pub const NONE: Self = Self { names: &[], after: &[] };
}

/// The text with a minus sign in place of a hyphen that stands before a number; and, if names are given that keep their point, with a comma
/// wherever a point parts two digits of a number.
pub fn in_text(text: &str, comma: Option<&Names>) -> String {
    let bytes = text.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let joins = |i: usize| bytes[i].is_ascii_alphanumeric() || bytes[i] == b'-';
    let name = |names: &Names, point: usize| {
        // Of bytes: what Rust says of a text cut in the middle of a letter would be 2 KB of every program.
        let (before, rest) = bytes.split_at(point - 1);
        names.names.iter().any(|name| rest.starts_with(name.as_bytes()))
            && !digit(point + 2)
            && names.after.iter().any(|word| before.ends_with(word.as_bytes()))
    };
    let mark = |(i, c)| match (c, comma) {
        ('-', _) if digit(i + 1) && (i == 0 || !joins(i - 1)) => '−',
        ('.', Some(names)) if i > 0 && digit(i - 1) && digit(i + 1) && !name(names, i) => ',',
        _ => c,
    };
    text.char_indices().map(mark).collect()
}

/// The same for all that is written in a picture. A comma is as wide as a point to a tenth of a px, so nothing moves.
pub fn in_scene(scene: &mut Scene, comma: Option<&Names>) {
    for mark in &mut scene.marks {
        if let Mark::Text(text) = mark {
            text.text = in_text(&text.text, comma);
        }
    }
    for handle in &mut scene.handles {
        handle.text = in_text(&handle.text, comma);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::font::{Weight, measure};

    const VERSIONS: Names = Names { names: &["1.0", "2.0"], after: &["FastSLAM ", "of ", "von "] };

    #[test]
    fn numbers_take_a_comma_and_names_and_sentences_keep_their_points() {
        for (text, comma) in [
            ("0.25 m", "0,25 m"),
            ("1.5·10^{−7}. Then 12.", "1,5·10^{−7}. Then 12."),
            ("FastSLAM 2.0: ratio 2.0", "FastSLAM 2.0: ratio 2,0"),
            ("one sample of 2.0 is worth 2.0 of 1.0", "one sample of 2.0 is worth 2,0 of 1.0"),
            ("Eine Stichprobe von 2.0 ist 2.0 von 1.0 wert", "Eine Stichprobe von 2.0 ist 2,0 von 1.0 wert"),
            ("FastSLAM 2.05", "FastSLAM 2,05"),
            ("of 12.0 m1.y", "of 12,0 m1.y"),
            (".5", ".5"),
            ("σ 1.0", "σ 1,0"),
        ] {
            assert_eq!(in_text(text, Some(&VERSIONS)), comma);
        }
    }

    #[test]
    fn a_hyphen_before_a_number_is_a_minus_sign_and_all_others_stay() {
        for (text, minus) in [
            ("-2.0 °", "−2.0 °"),
            ("between (-1, ±-0.5)", "between (−1, ±−0.5)"),
            ("scan-to-scan, steps 3-5, 1e-7, a -b, --2", "scan-to-scan, steps 3-5, 1e-7, a -b, --2"),
        ] {
            assert_eq!(in_text(text, None), minus);
        }
    }

    #[test]
    fn a_comma_is_as_wide_as_a_point_to_the_eye() {
        for weight in [Weight::Regular, Weight::SemiBold] {
            let [comma, point] = ["0,5", "0.5"].map(|text| measure(text, 12.0, weight));
            assert!((comma - point).abs() < 0.1, "{comma} px, {point} px");
        }
    }
}
