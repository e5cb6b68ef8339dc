//! Curves over steps.

use super::{Point, Rect, Role, Scene};

/// Whatever is drawn of a run that is pinned.
pub const GHOST: Role = Role::Level(48);

/// A place for curves: steps from left to right, shares of its height from the bottom up.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Chart {
    /// \[css px\]
    pub area: Rect,
    /// The step at its right edge.
    pub last: u32,
}

impl Chart {
    /// Where a step is \[css px\].
    pub fn x(&self, step: u32) -> f64 {
        self.area.x + self.area.w * f64::from(step) / f64::from(self.last.max(1))
    }

    /// Where a share of the height is \[css px\]; at the nearer edge for what is beyond.
    pub fn y(&self, share: f64) -> f64 {
        self.area.bottom() - self.area.h * share.clamp(0.0, 1.0)
    }

    /// A curve through shares of the height by their steps.
    pub fn curve(&self, shares: impl Iterator<Item = (u32, f64)>) -> Vec<Point> {
        shares.map(|(step, share)| [self.x(step), self.y(share)]).collect()
    }

    /// A line across.
    pub fn level(&self, share: f64) -> Vec<Point> {
        [self.area.x, self.area.right()].map(|x| [x, self.y(share)]).to_vec()
    }

    /// A line across, as thin as a pixel.
    pub fn rule(&self, scene: &mut Scene, y: f64) {
        scene.fill(Rect::new(self.area.x, y - 0.5, self.area.w, 1.0), Role::Frame);
    }

    /// Draws its lower and upper edge.
    pub fn edges(&self, scene: &mut Scene) {
        self.rule(scene, self.area.y);
        self.rule(scene, self.area.y + self.area.h);
    }

    /// A curve of a run that is pinned, by step, behind those of the run that is shown: of the steps that both have. None where nothing is
    /// pinned.
    pub fn ghost(&self, scene: &mut Scene, shares: impl Iterator<Item = f64>) {
        let curve = self.curve((0..=self.last).zip(shares));
        if !curve.is_empty() {
            scene.line(&curve, 1.75, GHOST);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_stay_in_their_chart_from_its_first_step_to_its_last() {
        let chart = Chart { area: Rect::new(10.0, 20.0, 100.0, 40.0), last: 4 };
        let curve = chart.curve([(0, 0.0), (1, 0.5), (4, 7.0)].into_iter());
        assert_eq!(curve, [[10.0, 60.0], [35.0, 40.0], [110.0, 20.0]]);
        assert_eq!(chart.level(1.0), [[10.0, 20.0], [110.0, 20.0]]);
        assert_eq!(Chart { last: 0, ..chart }.x(0), 10.0, "of a figure that has no steps yet");
    }
}
