//! Mathematics in one line: letters with indices, exponents and accents, and matrices in brackets.
//!
//! Written as TeX writes it: `H_m^T` has the index and the raised T above each other, and braces hold more than one character
//! together. A letter before U+0302 or U+0303 wears a hat or a tilde; the font has neither those letters nor ᵀ.

use super::{Anchor, Mark, Point, Rect, Role, Scene, Text};
use crate::decimal;
use crate::font::{self, Weight};

/// Size of indices, exponents and accents, as a share of the size of the line.
const SMALL: f64 = 0.68;

/// Between a matrix and its brackets, and between its columns, as a share of the size of the line.
const PAD: f64 = 0.42;
const GAP: f64 = 0.95;

/// Distance of the rows of a matrix, likewise.
const PITCH: f64 = 1.45;

/// A line that is being written. Its texts stand relative to its left end and the middle of its capitals.
#[derive(Clone, Debug)]
pub struct Formula {
    size: f64,
    weight: Weight,
    role: Role,
    texts: Vec<Text>,
    brackets: Vec<Vec<Point>>,
    width: f64,
    /// Where the index or exponent before began: one of the other kind begins there too.
    script: Option<(char, f64)>,
}

impl Formula {
    /// An empty line of this font size \[css px\].
    pub fn new(size: f64, weight: Weight, role: Role) -> Self {
        let (texts, brackets) = (Vec::new(), Vec::new());
        Self { size, weight, role, texts, brackets, width: 0.0, script: None }
    }

    /// Width of what is written \[css px\].
    pub fn width(&self) -> f64 {
        self.width
    }

    /// The same with more at its end.
    pub fn tex(mut self, source: &str) -> Self {
        let (mut run, mut rest) = (String::new(), source.chars());
        while let Some(c) = rest.next() {
            match c {
                '_' | '^' => {
                    self.run(&mut run);
                    let inside = match rest.as_str().strip_prefix('{').and_then(|braced| braced.split_once('}')) {
                        Some((inside, after)) => {
                            rest = after.chars();
                            inside.into()
                        }
                        None => rest.next().into_iter().collect::<String>(),
                    };
                    self.raise(c, &inside);
                }
                '\u{302}' | '\u{303}' => {
                    let letter: String = run.chars().next_back().into_iter().collect();
                    self.run(&mut run);
                    let (accent, up) = if c == '\u{302}' { ("^", 0.3) } else { ("~", 0.42) };
                    let width = font::measure(&letter, self.size, self.weight)
                        + font::measure(accent, SMALL * self.size, self.weight);
                    self.put(accent, SMALL, self.width - 0.5 * width, -up);
                }
                _ => run.push(c),
            }
        }
        self.run(&mut run);
        self
    }

    /// The same with a matrix at its end, of entries row by row; the decimal points of a column are below each other.
    pub fn matrix(mut self, entries: &[f64], columns: usize, digits: i32) -> Self {
        let pad = PAD * self.size;
        let (left, rows) = (self.width, entries.len() / columns);
        let mut x = left + pad;
        for column in 0..columns {
            let mut written = Vec::new();
            let (mut before, mut after) = (0.0_f64, 0.0_f64);
            for entry in entries.iter().skip(column).step_by(columns) {
                let source = number(*entry, digits);
                let head = source.split(['.', '·']).next().unwrap_or_default();
                let head = font::measure(head, self.size, self.weight);
                let entry = Self::new(self.size, self.weight, self.role).tex(&source);
                (before, after) = (before.max(head), after.max(entry.width - head));
                written.push((entry, head));
            }
            for (row, (entry, head)) in written.into_iter().enumerate() {
                let y = (row as f64 - 0.5 * (rows as f64 - 1.0)) * PITCH * self.size;
                self.texts.extend(entry.texts.into_iter().map(|text| moved(text, [x + before - head, y])));
            }
            x += before + after + if column + 1 < columns { GAP * self.size } else { pad };
        }
        let (half, serif) = (0.5 * rows as f64 * PITCH * self.size, 0.26 * self.size);
        let bracket = |x: f64, serif: f64| vec![[x + serif, -half], [x, -half], [x, half], [x + serif, half]];
        self.brackets.extend([bracket(left + 1.0, serif), bracket(x - 1.0, -serif)]);
        self.width = x;
        self.script = None;
        self
    }

    /// Draws it: its left end and the middle of its capitals.
    pub fn draw(self, scene: &mut Scene, [x, y]: Point) {
        scene.marks.extend(self.texts.into_iter().map(|text| Mark::Text(moved(text, [x, y]))));
        let lines: Vec<_> =
            self.brackets.into_iter().map(|line| line.into_iter().map(|[u, v]| [x + u, y + v]).collect()).collect();
        if !lines.is_empty() {
            scene.lines(lines, 1.1, self.role);
        }
    }

    /// Writes what came so far, if anything did.
    fn run(&mut self, text: &mut String) {
        if !text.is_empty() {
            self.put(text, 1.0, self.width, 0.0);
            self.width += font::measure(text, self.size, self.weight);
            self.script = None;
            text.clear();
        }
    }

    fn raise(&mut self, sign: char, text: &str) {
        let x = self.script.filter(|(other, _)| *other != sign).map_or(self.width, |(_, x)| x);
        let small = SMALL * self.size;
        self.put(text, SMALL, x, if sign == '^' { -0.36 } else { 0.2 });
        self.width = self.width.max(x + font::measure(text, small, self.weight));
        self.script = Some((sign, x));
    }

    /// Text of a share of the font size, its baseline so much below that of the line.
    fn put(&mut self, text: &str, share: f64, x: f64, down: f64) {
        let size = share * self.size;
        let capital = |size| font::cap_height(size, self.weight);
        let middle = 0.5 * (capital(self.size) - capital(size)) + down * self.size;
        let (w, h) = (font::measure(text, size, self.weight), 1.2 * size);
        let area = Rect::new(x, middle - 0.5 * h, w, h);
        self.texts.push(Text::new(area, Anchor::Start, size, self.weight, self.role, text));
    }
}

fn moved(text: Text, [x, y]: Point) -> Text {
    Text { area: Rect { x: text.area.x + x, y: text.area.y + y, ..text.area }, ..text }
}

/// A number with at most so many significant digits, as the source of a formula.
pub fn number(x: f64, digits: i32) -> String {
    let (number, exponent) = decimal::significant(x, digits);
    let number = if exponent == 0 { number } else { format!("{number}·10^{{{exponent}}}") };
    number.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(source: &str) -> Formula {
        Formula::new(20.0, Weight::Regular, Role::Ink).tex(source)
    }

    fn at(formula: &Formula, text: &str) -> Point {
        formula.texts.iter().find(|t| t.text == text).unwrap_or_else(|| panic!("{text} in {formula:?}")).origin()
    }

    #[test]
    fn an_index_is_lowered_an_exponent_raised_and_both_begin_where_the_letter_ends() {
        let formula = line("H_m^T S^{−1}");
        let [[h, base], [m, low], [t, high], [s, same]] = ["H", "m", "T", " S"].map(|text| at(&formula, text));
        assert!(low > base && high < base - 5.0 && same == base);
        assert!(m == t && m > h + 10.0 && s > t + 5.0);
        let [minus, up] = at(&formula, "−1");
        assert!(up == high && minus > s);
        assert_eq!(line("ab").width(), font::measure("ab", 20.0, Weight::Regular));
    }

    #[test]
    fn two_exponents_follow_each_other() {
        let formula = line("x^a^b");
        assert!(at(&formula, "b")[0] > at(&formula, "a")[0]);
    }

    #[test]
    fn a_hat_stands_over_the_middle_of_its_letter() {
        let formula = line("h = z\u{302}z");
        let accent = formula.texts.iter().find(|t| t.text == "^").unwrap();
        let [end, start] = ["h = z", "h = "].map(|text| font::measure(text, 20.0, Weight::Regular));
        assert!((accent.area.centre()[0] - 0.5 * (start + end)).abs() < 1e-9);
        assert!((formula.width() - font::measure("h = zz", 20.0, Weight::Regular)).abs() < 1e-9);
    }

    #[test]
    fn decimal_points_of_a_column_are_below_each_other() {
        let formula = line("").matrix(&[0.25, 100.0, -12.5, 1e-9], 2, 5);
        let point =
            |text: &str| at(&formula, text)[0] + font::measure(text.split('.').next().unwrap(), 20.0, Weight::Regular);
        assert!((point("0.25") - point("−12.5")).abs() < 1e-9);
        assert!(at(&formula, "0.25")[1] < at(&formula, "−12.5")[1]);
        let right = formula.brackets[1].iter().map(|p| p[0]).fold(0.0, f64::max);
        assert!(right <= formula.width());
        assert!(formula.texts.iter().all(|t| t.area.x > formula.brackets[0][1][0] && t.area.right() < right));
    }

    #[test]
    fn sources_that_end_too_early_are_written_as_they_are() {
        for source in ["", "_", "^", "a^{b", "\u{302}", "x_{}"] {
            assert!(line(source).width().is_finite());
        }
    }

    #[test]
    fn numbers_have_a_minus_sign_and_a_raised_power_of_ten() {
        assert_eq!(number(-0.5, 5), "−0.5");
        assert_eq!(number(1.5e-7, 5), "1.5·10^{−7}");
    }
}
