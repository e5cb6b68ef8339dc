//! Links: the parameters of a figure that differ from their defaults, written as the query of a URL.

use crate::model::{FigureError, Model};

/// `name=value&…`, in the order of the parameters, percent-encoded; empty for a figure of which nothing was asked.
pub fn write(model: &dyn Model) -> String {
    let mut pairs = Vec::new();
    for spec in model.params() {
        match model.value(spec.name) {
            Some(value) if value != spec.default => pairs.push(format!("{}={}", spec.name, encode(&value))),
            _ => (),
        }
    }
    pairs.join("&")
}

/// Makes the figure what the link says, and everything it does not name the default. What is refused is returned, and the
/// rest is applied.
pub fn read(model: &mut dyn Model, query: &str) -> Vec<FigureError> {
    model.load(&pairs(query))
}

/// Names and values as they are written, decoded.
pub fn pairs(query: &str) -> Vec<(String, String)> {
    let pairs = query.trim_start_matches(['?', '#']).split('&').filter(|p| !p.is_empty());
    pairs
        .map(|pair| pair.split_once('=').unwrap_or((pair, "")))
        .map(|(name, value)| (decode(name), decode(value)))
        .collect()
}

fn encode(text: &str) -> String {
    let mut encoded = String::new();
    for byte in text.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => encoded.push(char::from(byte)),
            _ => encoded.push_str(&format!("%{byte:02X}")),
        }
    }
    encoded
}

/// Undoes [`encode`], takes + for a space as forms write it, and leaves what is no encoding as it is.
fn decode(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, tail @ ..] = rest {
        rest = tail;
        let hex = |digit: u8| char::from(digit).to_digit(16).map(|d| d as u8);
        match (first, tail) {
            (b'%', [high, low, after @ ..]) if hex(*high).is_some() && hex(*low).is_some() => {
                bytes.push(16 * hex(*high).unwrap_or(0) + hex(*low).unwrap_or(0));
                rest = after;
            }
            (b'+', _) => bytes.push(b' '),
            _ => bytes.push(*first),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encoding_is_undone() {
        for text in ["", "16", "neff:0.5", "a b&c=d%", "σ√²", "100%"] {
            assert_eq!(decode(&encode(text)), text);
        }
        assert_eq!(encode("a b"), "a%20b");
    }

    #[test]
    fn what_is_no_encoding_stays() {
        assert_eq!(decode("100%"), "100%");
        assert_eq!(decode("%zz%4"), "%zz%4");
        assert_eq!(decode("a+b"), "a b");
        assert_eq!(decode("%ff"), "\u{fffd}");
    }
}
