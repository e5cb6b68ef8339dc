//! The errors that come with the figure of universes are those of the chapter's data, which `fastslam-lab numbers` measures and
//! `tests/portability` runs again: `UPDATE_GOLDENS=1` writes them anew.

use fastslam_lab::experiment::universes::TRIED;
use fastslam_widgets::universes::{AWARE, LAPS, MOTION};
use std::{collections::BTreeMap, fs};

const KEPT: &str = include_str!("../../../../www/data/lap-table.json");
const SHIPPED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../widgets/src/universes/shipped.rs");

/// Whole millimetres rounded down, the best lap first.
fn millimetres(proposal: &str, particles: usize) -> Vec<u16> {
    let kept: BTreeMap<String, Vec<f64>> = serde_json::from_str(KEPT).unwrap();
    let of = |group: &str| kept.get(&format!("{group}.{proposal}.subcell.m{particles}"));
    let errors = of("lap").or_else(|| of("lap.tried")).unwrap();
    let mut errors: Vec<u16> = errors.iter().map(|error| (1000.0 * error) as u16).collect();
    errors.sort_unstable();
    errors
}

#[test]
fn the_errors_shipped_are_those_of_the_lap_table() {
    let both = [("motion", &MOTION), ("aware", &AWARE)];
    if std::env::var_os("UPDATE_GOLDENS").is_some() {
        let before = fs::read_to_string(SHIPPED).unwrap();
        let mut text = before[..before.find("\n/// The motion prior.").unwrap()].to_owned();
        for (proposal, doc) in [("motion", "The motion prior."), ("aware", "The measurement-aware proposal.")] {
            let row = |m: usize| millimetres(proposal, m).iter().map(u16::to_string).collect::<Vec<_>>().join(",");
            let rows: String = TRIED.iter().map(|m| format!("    [{}],\n", row(*m))).collect();
            let name = proposal.to_uppercase();
            text += &format!("\n/// {doc}\n#[rustfmt::skip]\npub static {name}: Errors = [\n{rows}];\n");
        }
        fs::write(SHIPPED, text).unwrap();
        return;
    }
    for (proposal, shipped) in both {
        for (particles, errors) in TRIED.iter().zip(shipped) {
            assert_eq!(errors[..], millimetres(proposal, *particles), "{proposal} {particles}");
            assert_eq!(errors.len(), LAPS);
        }
    }
}
