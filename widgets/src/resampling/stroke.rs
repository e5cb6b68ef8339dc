//! How the three policies are told apart: by colour and by dash, and the one that is chosen by its width.

use crate::{
    scene::{Point, Rect, Role, Scene},
    words::resampling,
};

/// Names of the policies for readers.
pub const NAMES: [fn() -> &'static str; 3] = [resampling::never, resampling::every_step, resampling::selective];

/// Dash and gap of each \[css px\]. The last one is solid.
const DASHES: [Option<[f64; 2]>; 3] = [Some([2.0, 2.0]), Some([8.0, 2.0]), None];

/// The colour of a policy.
pub fn role(policy: usize) -> Role {
    Role::Variant(policy as u8)
}

/// Lines of a policy.
pub fn lines(scene: &mut Scene, policy: usize, chosen: bool, lines: Vec<Vec<Point>>) {
    scene.strokes(lines, if chosen { 2.25 } else { 1.25 }, DASHES[policy], role(policy));
}

/// A piece of such a line across the middle of a place.
pub fn sample(scene: &mut Scene, policy: usize, chosen: bool, place: &Rect) {
    let y = place.centre()[1];
    lines(scene, policy, chosen, vec![vec![[place.x, y], [place.right(), y]]]);
}
