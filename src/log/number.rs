//! Numbers of logs, all of them read in one place.

use lexical_parse_float::FromLexical;

/// The number nearest to what is written, as std's `parse` reads it: with a sign or none, digits with a point anywhere or none, an exponent or
/// none; `inf`, `infinity` and `nan` in any case. It comes from a crate that needs no table of powers of ten: std's makes the program of a page 8 KB heavier.
pub(crate) fn number(text: &str) -> Option<f64> {
    f64::from_lexical(text.as_bytes()).ok()
}

#[cfg(test)]
mod tests {
    use super::number;

    /// As std reads it, to the bit; any NaN is as good as any other.
    fn is_read_as_by_std(text: &str) {
        let bits = |x: f64| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() };
        assert_eq!(number(text).map(bits), text.parse().ok().map(bits), "{text}");
    }

    #[test]
    fn every_way_to_write_a_number_is_read_as_std_reads_it() {
        let digits = "0123456789".repeat(80);
        let half =
            ["9007199254740993", "9007199254740993.0000000000000000000000000000001", "2.4703282292062327208e-324"];
        let ends = [
            "1.7976931348623157e308",
            "1.7976931348623159e308",
            "5e-324",
            "2e-324",
            "1e999",
            "1e-999",
            "-0",
            "0e99999",
        ];
        let ways =
            ["1", "+1", "-1.", ".5", "-.5e+3", "5.E-3", "007", "inf", "-Infinity", "NAN", "1e22", "1e23", "0.1", "0.3"];
        let none =
            ["", "-", ".", "+.", "e5", "1e", "1e+", "0x3", "1.2.3", "--1", "1 ", "1_0", "1f", "infin", "٣", "1,5"];
        for text in half.iter().chain(&ends).chain(&ways).chain(&none) {
            is_read_as_by_std(text);
        }
        is_read_as_by_std(&digits);
        is_read_as_by_std(&format!("0.{digits}e-200"));
    }

    #[test]
    fn any_bits_are_read_back_as_they_were_written() {
        let mut bits = 7_u64;
        for _ in 0..20_000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let x = f64::from_bits(bits);
            let written = [
                format!("{x}"),
                format!("{x:e}"),
                format!("{x:.20e}"),
                format!("{}.{}", bits >> 50, bits & 0xffff_ffff_ffff),
            ];
            written.iter().for_each(|text| is_read_as_by_std(text));
        }
    }
}
