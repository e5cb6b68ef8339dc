//! Decimal commas, for classes that write them: the one place where the numbers of a picture, a readout or a sentence change their
//! mark. Attributes, links and files keep the point.

use crate::scene::{Mark, Scene};

/// What FastSLAM's versions are called; `2.0` there is a name and no number.
const VERSIONS: [&str; 2] = ["1.0", "2.0"];
/// Words that a version follows.
const BEFORE_VERSION: [&str; 4] = ["FastSLAM ", "of ", "but ", "von "];

/// The text with a comma wherever a point parts two digits of a number.
pub fn in_text(text: &str) -> String {
    let bytes = text.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let version = |point: usize| {
        // Of bytes: what Rust says of a text cut in the middle of a letter would be 2 KB of every program.
        let (before, rest) = bytes.split_at(point - 1);
        VERSIONS.iter().any(|v| rest.starts_with(v.as_bytes()))
            && !digit(point + 2)
            && BEFORE_VERSION.iter().any(|word| before.ends_with(word.as_bytes()))
    };
    let mark = |(i, c)| if c == '.' && i > 0 && digit(i - 1) && digit(i + 1) && !version(i) { ',' } else { c };
    text.char_indices().map(mark).collect()
}

/// The same for all that is written in a picture. A comma is as wide as a point to a tenth of a px, so nothing moves.
pub fn in_scene(scene: &mut Scene) {
    for mark in &mut scene.marks {
        if let Mark::Text(text) = mark {
            text.text = in_text(&text.text);
        }
    }
    for handle in &mut scene.handles {
        handle.text = in_text(&handle.text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        figure::Figure,
        font::{Weight, measure},
        registry::FIGURES,
    };

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
            assert_eq!(in_text(text), comma);
        }
    }

    #[test]
    fn a_comma_is_as_wide_as_a_point_to_the_eye() {
        for weight in [Weight::Regular, Weight::SemiBold] {
            let [comma, point] = ["0,5", "0.5"].map(|text| measure(text, 12.0, weight));
            assert!((comma - point).abs() < 0.1, "{comma} px, {point} px");
        }
    }

    /// Words of one figure: picture, readouts, sentence, and what is said of its handles.
    fn words(figure: &mut Figure) -> Vec<String> {
        let scene = figure.scene(800.0, 500.0);
        let written = scene.marks.into_iter().filter_map(|m| if let Mark::Text(t) = m { Some(t.text) } else { None });
        let handles = scene.handles.into_iter().map(|h| h.text);
        let readouts = figure.readouts().into_iter().map(|r| r.text);
        written.chain(handles).chain(readouts).chain([figure.describe()]).collect()
    }

    #[test]
    fn every_number_of_every_figure_takes_a_comma_and_no_version_does() {
        let mut changed = 0;
        for entry in FIGURES {
            let mut figure = Figure::new(entry.tag).unwrap();
            figure.model_mut().seek(3);
            figure.model_mut().settle();
            let points = words(&mut figure);
            figure.set_decimal_comma(true);
            for (comma, point) in words(&mut figure).iter().zip(&points) {
                assert_eq!(comma, &in_text(point));
                assert!(!comma.contains("FastSLAM 1,0") && !comma.contains("FastSLAM 2,0"), "{comma}");
                changed += usize::from(comma != point);
            }
            assert!(!figure.query().contains(','), "links keep the point");
        }
        assert!(changed > 20, "{changed} texts changed");
    }
}
