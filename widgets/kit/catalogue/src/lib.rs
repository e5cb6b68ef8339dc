#![doc = include_str!("../README.md")]

/// A part of a message.
pub enum Piece<'a> {
    /// As it stands.
    Text(&'a str),
    /// The value of this name.
    Value(&'a str),
    /// One of two words, by the value of this name.
    Plural(&'a str, [&'a str; 2]),
}

/// The parts of a message in their order; `None` if a brace is not closed, or a plural has no second word.
pub fn pieces(message: &str) -> Option<Vec<Piece<'_>>> {
    let (mut pieces, mut rest) = (Vec::new(), message);
    while let Some((text, after)) = rest.split_once('{') {
        let (inner, after) = after.split_once('}')?;
        pieces.push(Piece::Text(text));
        pieces.push(match inner.split_once(':') {
            Some((name, words)) => Piece::Plural(name, words.split_once('|')?.into()),
            None => Piece::Value(inner),
        });
        rest = after;
    }
    pieces.push(Piece::Text(rest));
    Some(pieces)
}

/// A message's name as the program knows it, `section.key` as a hash (FNV-1a, 20 bits of it): names themselves would be a tenth of its
/// words.
pub fn key(name: &str) -> u32 {
    name.bytes().fold(0x811c_9dc5_u32, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)) >> 12
}

/// Names of a message's values in their order; none of a malformed one.
pub fn names(message: &str) -> Vec<&str> {
    let mut names = Vec::new();
    for piece in pieces(message).unwrap_or_default() {
        if let Piece::Value(name) | Piece::Plural(name, _) = piece {
            let at = names.partition_point(|known| *known < name);
            if names.get(at) != Some(&name) {
                names.insert(at, name);
            }
        }
    }
    names
}

#[cfg(feature = "build")]
pub mod build;
