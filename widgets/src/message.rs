//! What a message of a catalogue looks like: for the program, and for its build script, which reads the same file.
//!
//! `{name}` stands for a value, and `{name:universe|universes}` for the first word where that value is 1, and else for the second. It is
//! all that these figures need: a library of messages (Fluent, ICU) knows of much more, and would be fetched by every reader.

/// A part of a message.
pub(crate) enum Piece<'a> {
    /// As it stands.
    Text(&'a str),
    /// The value of this name.
    Value(&'a str),
    /// One of two words, by the value of this name.
    Plural(&'a str, [&'a str; 2]),
}

/// The parts of a message in their order; `None` if a brace is not closed, or a plural has no second word.
pub(crate) fn pieces(message: &str) -> Option<Vec<Piece<'_>>> {
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
pub(crate) fn key(name: &str) -> u32 {
    name.bytes().fold(0x811c_9dc5_u32, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)) >> 12
}
