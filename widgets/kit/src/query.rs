//! Links: the parameters of a figure that differ from their defaults, written as the query of a URL.
//!
//! A link says of which version of the figure it is, `v=2`, and says nothing where that is 1. What is left out of a link is at its default,
//! and what is in it is simulated: a figure that changes a default, the meaning of a parameter or its numbers has another version. What an
//! older link leaves out is at the default of its version; of what else has changed, those who come by it are told.
//!
//! A code that was pasted into a page, as attributes or as the query of a frame, means by its `v` what a link means, but nobody is told
//! of changes: its readers have not come by it. One without `v` is of the version that was shown when codes began to say theirs,
//! [`Declared::UNSAID`](crate::model::Declared::UNSAID), for ever; one that follows the figure says `v=latest`.

use crate::{
    decimal,
    model::{Change, FigureError, Model},
    param::{flag, quoted},
    words::kit::{AWholeNumber, EarlierLink, LaterLink, WordsOrRange},
};

/// Name of the version in a link.
const VERSION: &str = "v";

/// In place of a version: whatever is the newest.
const LATEST: &str = "latest";

/// What a link of the present version says before its values; nothing in version 1.
fn version(changes: &[Change]) -> Option<String> {
    (!changes.is_empty()).then(|| format!("{VERSION}={}", changes.len() + 1))
}

/// Names and values of the present version, as a link that says so.
pub fn versioned(pairs: &str, changes: &[Change]) -> String {
    version(changes).into_iter().chain((!pairs.is_empty()).then(|| pairs.into())).collect::<Vec<_>>().join("&")
}

/// `v=version&name=value&…`, in the order of the parameters, percent-encoded; empty for a figure of version 1 of which nothing was asked.
pub fn write(model: &dyn Model) -> String {
    let mut pairs: Vec<String> = version(model.changes()).into_iter().collect();
    for (spec, (name, value)) in model.params().into_iter().zip(model.values()) {
        if value != spec.default {
            pairs.push(format!("{name}={}", encode(&value)));
        }
    }
    pairs.join("&")
}

/// Makes the figure what the link says, and everything it does not name the default. What is refused is returned, and so is what has
/// changed since the link was made; the rest is applied. One that is empty asks for nothing: it is of no version.
pub fn read(model: &mut dyn Model, query: &str) -> Vec<FigureError> {
    if query.is_empty() {
        return model.load(&[]);
    }
    let (mut said, mut values) = since(query, model.changes());
    values.extend(pairs(query));
    said.extend(model.load(&values));
    said
}

/// Whether a pasted code is of a version that opens at the figure's telling step: the others open at the first step, as they did.
pub fn opens_telling(model: &dyn Model, code: &str) -> bool {
    let (changes, given) = (model.changes(), given(code));
    let since = changes.iter().position(|change| *change == Change::Opens).map_or(1, |at| at + 2);
    let unsaid = model.unsaid();
    given.map_or(unsaid, |text| if text.trim() == LATEST { usize::MAX } else { text.trim().parse().unwrap_or(unsaid) })
        >= since
}

/// What a pasted code means without saying so: names of parameters and the defaults of its version, where these are others now.
///
/// # Errors
/// For a version that there is not; the code is then taken for one of the newest.
pub fn meant(model: &dyn Model, code: &str) -> Result<Vec<(String, String)>, FigureError> {
    implied(code, model.unsaid(), model.changes())
}

fn implied(code: &str, unsaid: usize, changes: &[Change]) -> Result<Vec<(String, String)>, FigureError> {
    let newest = changes.len() + 1;
    let version = match given(code) {
        None => unsaid,
        Some(latest) if latest == LATEST => newest,
        Some(version) => checked(&version, newest, LATEST)?,
    };
    Ok(after(code, version, changes).1)
}

/// What a reader is told of a link of another version, and what it means without saying so: `changes` has one for each version from the
/// second on.
fn since(query: &str, changes: &[Change]) -> (Vec<FigureError>, Vec<(String, String)>) {
    match checked(&given(query).unwrap_or("1".into()), changes.len() + 1, "") {
        Ok(version) => after(query, version, changes),
        Err(error) => (vec![error], Vec::new()),
    }
}

/// The version as it is written; `None` where nothing is said of it.
fn given(query: &str) -> Option<String> {
    decoded(query).find(|(name, _)| name == VERSION).map(|(_, version)| version)
}

/// A version from 1 to the newest, or what is wrong with it: it may be `word` as well, where there is one.
#[inline(never)] // a program has it once
fn checked(given: &str, newest: usize, word: &str) -> Result<usize, FigureError> {
    match given.trim().parse::<usize>() {
        Ok(version) if (1..=newest).contains(&version) => Ok(version),
        Ok(version) if version > newest => Err(about(LaterLink { version: &version, newest: &newest }.say())),
        _ => {
            let range = AWholeNumber { min: &1, max: &newest, unit: &"" }.say();
            let allowed = if word.is_empty() { range } else { WordsOrRange { words: &word, range: &range }.say() };
            Err(FigureError::new(VERSION, quoted(given), allowed))
        }
    }
}

fn about(message: String) -> FigureError {
    FigureError { parameter: VERSION.into(), message }
}

/// What has changed since a version: what there is to tell, and the defaults of then that are others now.
#[inline(never)]
fn after(query: &str, version: usize, changes: &[Change]) -> (Vec<FigureError>, Vec<(String, String)>) {
    let (mut said, mut meant) = (Vec::new(), Vec::new());
    // The default that held in the version of the link is the one before the first change after it.
    for change in changes.iter().skip(version - 1).rev().flat_map(|change| applying(query, change)) {
        match *change {
            Change::Told(change) => said.insert(0, about(EarlierLink { change: &change }.say())),
            Change::ToldAt { name, value, change } => {
                if decoded(query).any(|(n, text)| n == name && decimal::parse(&text) == Some(value)) {
                    said.insert(0, about(EarlierLink { change: &change }.say()));
                }
            }
            Change::Default { name, was } => meant.push((name.into(), was.into())),
            Change::DefaultUnless { name, was, unless: (other, value) } => {
                if !decoded(query).any(|(n, text)| n == other && text.trim() == value) {
                    meant.push((name.into(), was.into()));
                }
            }
            // They are not nested.
            Change::Opens | Change::Switched { .. } => (),
        }
    }
    (said, meant)
}

/// What of a change holds for the link.
fn applying<'a>(query: &str, change: &'a Change) -> &'a [Change] {
    match change {
        Change::Switched { name, changes } if switched_on(query, name) => changes,
        Change::Switched { .. } => &[],
        change => core::slice::from_ref(change),
    }
}

/// Whether the link switches a parameter on.
fn switched_on(query: &str, name: &str) -> bool {
    decoded(query).any(|(n, text)| n == name && flag(text.trim()) == Some(true))
}

/// Names and values of the parameters as they are written, decoded.
pub fn pairs(query: &str) -> Vec<(String, String)> {
    decoded(query).filter(|(name, _)| name != VERSION).collect()
}

fn decoded(query: &str) -> impl Iterator<Item = (String, String)> {
    let pairs = query.trim_start_matches(['?', '#']).split('&').filter(|p| !p.is_empty());
    pairs.map(|pair| pair.split_once('=').unwrap_or((pair, ""))).map(|(name, value)| (decode(name), decode(value)))
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
    fn a_link_of_an_earlier_version_tells_what_has_changed_since() {
        let changes = &[Change::Told("Ranges are in metres."), Change::Told("The seed is another.")];
        let told = |query| since(query, changes).0.into_iter().map(|error| error.message).collect::<Vec<_>>();
        assert_eq!(told("v=3&seed=4"), [""; 0]);
        assert_eq!(told("v=2").len(), 1);
        assert!(told("v=2")[0].ends_with("The seed is another."));
        // The links of the first version do not say so.
        assert_eq!(told("seed=4").len(), 2);
        assert!(told("v=4")[0].contains("version 4") && told("v=4")[0].contains("version 3"));
        for bad in ["v=0", "v=-1", "v=", "v=x"] {
            assert!(told(bad)[0].ends_with("must be a whole number from 1 to 3"), "{bad}");
        }
    }

    #[test]
    fn what_a_link_leaves_out_is_at_the_default_of_its_version() {
        let was = |name, was| Change::Default { name, was };
        let changes = &[was("raw", "off"), Change::Told("The seed is another."), was("cell", "0.1"), was("raw", "on")];
        let meant = |query| since(query, changes).1;
        let pair = |name: &str, value: &str| (name.to_owned(), value.to_owned());
        // Of a name that is there twice the last one counts.
        assert_eq!(meant("seed=4"), [pair("raw", "on"), pair("cell", "0.1"), pair("raw", "off")]);
        assert_eq!(meant("v=3&raw=off"), [pair("raw", "on"), pair("cell", "0.1")]);
        assert_eq!((meant("v=5"), since("v=2", changes).0.len()), (vec![], 1));
    }

    #[test]
    fn a_default_that_changed_for_some_links_only_is_that_of_the_others_as_it_was() {
        let changes = &[Change::DefaultUnless { name: "weight", was: "old", unless: ("proposal", "motion") }];
        let meant = |query| since(query, changes).1.len();
        assert_eq!(["seed=1", "proposal=aware", "proposal=motion", "v=2&seed=1"].map(meant), [1, 1, 0, 0]);
    }

    #[test]
    fn what_has_changed_at_one_value_is_told_to_links_with_that_value() {
        let changes = &[Change::ToldAt { name: "odometry", value: 0.0, change: "The path is known." }];
        let told = |query| since(query, changes).0.len();
        assert_eq!(["odometry=0", "odometry=0.0&seed=4"].map(told), [1, 1]);
        assert_eq!(["odometry=0.05", "range-std=0", "v=2&odometry=0"].map(told), [0, 0, 0]);
    }

    #[test]
    fn what_has_changed_where_a_parameter_is_on_holds_for_links_that_switch_it_on() {
        const ON: &[Change] = &[Change::Default { name: "guess", was: "2" }, Change::Told("The samples move.")];
        let changes = &[Change::Switched { name: "run", changes: ON }];
        let of = |query| since(query, changes);
        assert_eq!(of("run=on&seed=1").1, [("guess".to_owned(), "2".to_owned())]);
        assert_eq!(["run=on", "run=true", "run=off", "seed=1", "v=2&run=on"].map(|q| of(q).0.len()), [1, 1, 0, 0, 0]);
    }

    #[test]
    fn a_code_means_what_the_link_of_its_version_means_and_tells_nothing() {
        let was = |name, was| Change::Default { name, was };
        let changes = &[was("raw", "off"), Change::Told("The seed is another."), was("cell", "0.1"), was("raw", "on")];
        for query in ["v=1", "v=2&raw=off", "v=3", "v=4", "v=5&seed=4"] {
            for unsaid in 1..=5 {
                assert_eq!(implied(query, unsaid, changes).unwrap(), since(query, changes).1, "{query}");
            }
        }
        // Without one it stays at the version of its time, whatever has changed since.
        for unsaid in 1..=5 {
            let then = since(&format!("v={unsaid}&seed=4"), changes).1;
            assert_eq!(implied("seed=4", unsaid, changes).unwrap(), then);
            assert_eq!(implied("seed=4&v=latest", unsaid, changes).unwrap(), []);
        }
        let wrong = |code| implied(code, 2, changes).unwrap_err().message;
        for bad in ["v=0", "v=", "v=last", "v=1.5"] {
            assert!(wrong(bad).ends_with("must be latest or a whole number from 1 to 5"), "{}", wrong(bad));
        }
        assert!(wrong("v=6").contains("version 6"));
    }

    #[test]
    fn a_version_is_no_parameter() {
        assert_eq!(pairs("v=2&seed=4"), [("seed".to_owned(), "4".to_owned())]);
    }

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
