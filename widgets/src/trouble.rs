//! Ways to die on purpose. Only the test of `tests/e2e/trap.spec.ts` is built with the feature `trouble`, and no program that is shipped:
//! what a page does after a trap can only be tested with a real one.

use crate::{
    action::{Action, Beginning},
    query,
};
use core::hint::black_box;

/// Dies where the parameter `trouble` is set, in the way its value names: "panic", "stack" or "memory". All else goes by.
pub fn die_if_asked(action: &Action) {
    let set = match action {
        Action::Set { name, value: Some(value), .. } => vec![(name.clone(), value.clone())],
        Action::Begin(Beginning { settings, .. }) => query::pairs(settings),
        _ => Vec::new(),
    };
    match set.iter().find(|(name, _)| name == "trouble").map(|(_, way)| way.as_str()) {
        Some("panic") => panic!("trouble was asked for"),
        Some("stack") => {
            black_box(overflow(0));
        }
        Some("memory") => exhaust(),
        _ => {}
    }
}

/// Calls itself until the stack is full.
fn overflow(depth: u64) -> u64 {
    if depth == u64::MAX { 0 } else { 1 + black_box(overflow(black_box(depth + 1))) }
}

/// Asks for memory until there is no more. None of it is written to, so that the machine of the test does not feel it.
fn exhaust() -> ! {
    loop {
        core::mem::forget(black_box(Vec::<u8>::with_capacity(1 << 26)));
    }
}
