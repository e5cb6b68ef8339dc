//! Decimal numbers as readers meet them: at most 15 significant digits, at most 15 decimals. Each of them has a floating-point
//! number of its own, which is written back with the same digits. What std does beyond that, all 17 digits of any number, takes
//! 20 KB of tables and code on every page.

/// Most significant digits, and most decimals.
const DIGITS: i32 = 15;

/// The number a text means; digits beyond those 15 are dropped. `None` for what is no number.
pub fn parse(text: &str) -> Option<f64> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let unsigned = mantissa.strip_prefix(['-', '+']).unwrap_or(mantissa);
    let mut scale = i32::from(exponent.parse::<i16>().ok()?);
    let (mut digits, mut point) = (0_u64, false);
    for byte in unsigned.bytes() {
        match byte {
            b'0'..=b'9' if digits < 10_u64.pow(DIGITS as u32 - 1) => {
                digits = 10 * digits + u64::from(byte - b'0');
                scale -= i32::from(point);
            }
            b'0'..=b'9' => scale += i32::from(!point),
            b'.' if !point => point = true,
            _ => return None,
        }
    }
    while scale < -DIGITS && digits > 0 {
        (digits, scale) = (digits / 10, scale + 1);
    }
    let some = unsigned.bytes().any(|byte| byte != b'.');
    // Both are whole numbers below 2⁵³, so that there is one rounding only.
    let x = if scale < 0 { digits as f64 / power(-scale) } else { digits as f64 * power(scale) };
    some.then_some(if mantissa.starts_with('-') { -x } else { x })
}

/// With as few decimals as read back as the same number, where it has at most 15. What is no such number is said in words.
pub fn write(x: f64) -> String {
    if x.is_nan() {
        return "NaN".into();
    }
    if x.abs() >= power(DIGITS) {
        return if x > 0.0 { "over 1e15" } else { "below -1e15" }.into();
    }
    let reads_back = |&k: &i32| (x.abs() * power(k) + 0.5).floor() / power(k) == x.abs();
    fixed(x, (0..DIGITS).find(reads_back).unwrap_or(DIGITS))
}

/// [`f64::clamp`] between ends that are known at run time only: where they could be in disorder, its panic has std's writing of floats with it.
pub fn between(x: f64, low: f64, high: f64) -> f64 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

/// The number that [`write()`] writes for it.
pub fn as_written(x: f64) -> f64 {
    parse(&write(x)).unwrap_or(x)
}

/// The number of so many decimals nearest to it.
pub fn rounded(x: f64, decimals: i32) -> f64 {
    parse(&fixed(x, decimals)).unwrap_or(x)
}

/// With this many decimals.
pub fn fixed(x: f64, decimals: i32) -> String {
    let scaled = (x.abs() * power(decimals) + 0.5).floor() as u64;
    let sign = if x < 0.0 && scaled > 0 { "-" } else { "" };
    let mut digits = format!("{scaled:0width$}", width = decimals as usize + 1);
    if decimals > 0 {
        digits.insert(digits.len() - decimals as usize, '.');
    }
    format!("{sign}{digits}")
}

/// With at most this many significant digits and no zeros at the end: the number, and the power of ten it is to be multiplied by,
/// which is 0 unless it would be below 0.001 or have more digits before the point than asked for.
pub fn significant(x: f64, digits: i32) -> (String, i32) {
    if x == 0.0 || !x.is_finite() {
        return (write(x), 0);
    }
    let (mut mantissa, mut exponent) = (x, 0);
    while mantissa.abs() >= 10.0 {
        (mantissa, exponent) = (mantissa / 10.0, exponent + 1);
    }
    while mantissa.abs() < 1.0 {
        (mantissa, exponent) = (mantissa * 10.0, exponent - 1);
    }
    let (number, exponent) = if (-3..digits).contains(&exponent) {
        (fixed(x, digits - 1 - exponent), 0)
    } else {
        (fixed(mantissa, digits - 1), exponent)
    };
    let short = if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { &number };
    (short.into(), exponent)
}

/// 10ᵏ for a k that is not negative; exact up to 10²².
fn power(k: i32) -> f64 {
    (0..k.min(400)).fold(1.0, |power, _| 10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_written_is_said() {
        let said = [f64::NAN, f64::INFINITY, -1e300, 999_999_999_999_999.0].map(write);
        assert_eq!(said, ["NaN", "over 1e15", "below -1e15", "999999999999999"]);
    }

    #[test]
    fn short_decimals_are_read_and_written_as_std_does() {
        for text in
            ["0", "0.05", "0.3", "1.95", "16", "-1", "-0.75", "4294967295", "123456789.012345", "0.000000000000001"]
        {
            let x: f64 = text.parse().unwrap();
            assert_eq!(parse(text).map(f64::to_bits), Some(x.to_bits()), "{text}");
            assert_eq!(write(x), text);
        }
        for k in 0..=100_000 {
            let x = f64::from(k) / 1000.0;
            let text = x.to_string();
            assert_eq!(parse(&text), Some(x), "{text}");
            assert_eq!(write(x), text);
        }
    }

    #[test]
    fn other_spellings_of_a_number_are_read() {
        for (text, x) in
            [("8e0", 8.0), ("+5", 5.0), (".5", 0.5), ("5.", 5.0), ("1E-2", 0.01), ("25e-2", 0.25), ("1e3", 1000.0)]
        {
            assert_eq!(parse(text), Some(x), "{text}");
        }
        assert_eq!(parse("0.30000000000000004"), Some(0.3), "what JavaScript makes of 6 × 0.05");
        assert_eq!(parse("1e-30"), Some(0.0));
        assert_eq!(parse("1e400"), Some(f64::INFINITY));
        assert_eq!(parse(&"9".repeat(30)), Some(999_999_999_999_999e15));
    }

    #[test]
    fn what_is_no_number_is_none() {
        for text in [
            "", ".", "-", "-.", "e5", "1e", "1e5.0", "1e99999", "0x3", "1.2.3", "--1", "1 2", "inf", "NaN", "٣", "1\n2",
        ] {
            assert_eq!(parse(text), None, "{text:?}");
        }
    }

    #[test]
    fn what_was_read_is_written_so_that_it_reads_the_same() {
        let mut x = 7_u64;
        for _ in 0..20_000 {
            x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            for text in [format!("0.{x}"), format!("{}.{}", x >> 58, x & 0xffff_ffff), format!("{}", x >> 40)] {
                let value = parse(&text).unwrap();
                assert_eq!(parse(&write(value)), Some(value), "{text}");
            }
        }
    }

    #[test]
    fn significant_digits_are_all_that_is_written() {
        let cases = [
            (0.0, "0", 0),
            (-0.0, "0", 0),
            (0.09999999999999964, "0.1", 0),
            (-31.41592653, "-31.416", 0),
            (0.00123456, "0.0012346", 0),
            (-0.000123456, "-1.2346", -4),
            (12345.6, "12346", 0),
            (99999.9, "100000", 0),
            (123456.0, "1.2346", 5),
            (4.5e-300, "4.5", -300),
            (-2e300, "-2", 300),
            (5e-324, "4.9407", -324),
            (f64::NAN, "NaN", 0),
        ];
        for (x, number, exponent) in cases {
            assert_eq!(significant(x, 5), (number.into(), exponent));
        }
    }

    #[test]
    fn fixed_decimals_are_rounded() {
        let cases = [
            (0.1234, 3, "0.123"),
            (0.9996, 3, "1.000"),
            (12.0, 0, "12"),
            (7.25, 1, "7.3"),
            (-0.04, 1, "0.0"),
            (-1.26, 1, "-1.3"),
        ];
        for (x, decimals, text) in cases {
            assert_eq!(fixed(x, decimals), text);
        }
    }
}
