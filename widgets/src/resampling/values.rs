//! What the cursor reads of each policy, beside a chart: as near to its curve as the others leave room.

use super::{charts::Picture, stroke};
use crate::{
    order::ascending,
    scene::{Rect, Region, Scene, plain, strong},
};

/// Font size, and from line to line \[css px\].
const SIZE: f64 = 11.5;
const APART: f64 = 13.0;
/// Width of a piece of a policy's line, where its name has no room, and what is left free after it \[css px\].
const PIECE: f64 = 15.0;
const AFTER: f64 = 4.0;

/// Heights as near to those wanted as they can be, in their order, this far from each other and between two ends.
fn spread(wanted: [f64; 3], [first, last]: [f64; 2]) -> [f64; 3] {
    let order = ascending(&wanted);
    let mut at = wanted;
    let mut least = first;
    for &k in &order {
        at[k] = at[k].max(least);
        least = at[k] + APART;
    }
    let mut most = last;
    for &k in order.iter().rev() {
        at[k] = at[k].min(most);
        most = at[k] - APART;
    }
    at
}

impl Picture<'_> {
    /// A value of each policy beside a chart, at the heights of their curves. A click on one chooses its policy.
    pub fn values(
        &self,
        scene: &mut Scene,
        place: &Rect,
        value: &dyn Fn(usize) -> String,
        height: &dyn Fn(usize) -> f64,
    ) {
        // Into the line above the chart, where the chart is low: nothing stands there at this side.
        let last = place.bottom() - 4.0;
        let ends = [(place.y - 4.0).min(last - 2.0 * APART), last];
        for (policy, y) in spread([0, 1, 2].map(height), ends).into_iter().enumerate() {
            self.value(scene, policy, &Rect::new(place.x, y - 0.5 * APART, place.w, APART), &value(policy));
        }
    }

    /// A value in its line, with the name of its policy, or with a piece of its line.
    pub fn value(&self, scene: &mut Scene, policy: usize, line: &Rect, value: &str) {
        let chosen = policy == self.chosen();
        let letters = if chosen { strong } else { plain }(SIZE, stroke::role(policy));
        let (written, x) = if self.parts.named {
            (format!("{} {value}", stroke::NAMES[policy]()), line.x)
        } else {
            stroke::sample(scene, policy, chosen, &Rect::new(line.x, line.y, PIECE, line.h));
            (value.into(), line.x + PIECE + AFTER)
        };
        scene.text(Rect::new(x, line.y, letters.width(&written) + 0.01, line.h), letters, &written);
        scene.regions.push(Region { area: *line, target: policy as u32 });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_keep_their_order_and_stand_apart_between_the_ends() {
        let ends = [10.0, 60.0];
        for wanted in [[30.0, 30.0, 30.0], [0.0, 1.0, 99.0], [60.0, 59.0, 58.0], [10.0, 35.0, 60.0], [99.0, 99.0, 99.0]]
        {
            let at = spread(wanted, ends);
            for (a, b) in [(0, 1), (0, 2), (1, 2)] {
                assert!((at[a] - at[b]).abs() >= APART - 1e-9, "{wanted:?}: {at:?}");
                assert!(wanted[a] == wanted[b] || (wanted[a] < wanted[b]) == (at[a] < at[b]), "{wanted:?}: {at:?}");
            }
            assert!(at.iter().all(|y| (ends[0]..=ends[1]).contains(y)), "{wanted:?}: {at:?}");
        }
        assert_eq!(spread([10.0, 35.0, 60.0], ends), [10.0, 35.0, 60.0], "what has room stays where it is");
    }
}
