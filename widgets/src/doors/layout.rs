//! Where the parts of the figure stand: the corridor between the particles and the Gaussian, and what became of the explanations below.

use crate::{
    panels::Panels,
    scene::{LINE, Rect, Stack, parts},
    view,
};

/// Names of the panels: the corridor with both beliefs, and how they went on since the ride.
pub const CORRIDOR: &str = "corridor";
/// See [`CORRIDOR`].
pub const HISTORY: &str = "history";

/// From this width on \[css px\] there is room for long names.
pub const WIDE: f64 = 560.0;

const HEADER: f64 = 22.0;
const PARTICLES: f64 = 92.0;
const STRIP: f64 = 56.0;
const EKF: f64 = 62.0;
const PAD: f64 = 8.0;
/// Height of the row of an explanation.
const ROW: f64 = 12.0;
/// Left of the history, for what an explanation is called, and right of it, for the shares.
const NAMES: f64 = 30.0;
const SHARES: [f64; 2] = [78.0, 132.0];

/// The most doors that an explanation of the history is off, on either side.
pub const MOST_OFF: i32 = 5;

parts! {
    /// The parts of the figure \[css px\].
    pub struct Layout {
        /// Which panels are shown.
        pub panels: Panels,
        /// Whether there is room for long names.
        pub wide: bool,
        /// What the particles hold.
        pub particles_header: Rect,
        /// The particles, piled up where they are.
        pub particles: Rect,
        /// The corridor.
        pub strip: Rect,
        /// The Gaussian of EKF-SLAM, hanging from the corridor.
        pub ekf: Rect,
        /// What it holds.
        pub ekf_header: Rect,
        /// What the history shows, and what is drawn in it.
        pub history_header: Rect,
        /// Names of its rows.
        pub names: Rect,
        /// The share of the weight of every explanation, by step.
        pub history: Rect,
        /// The same at the step shown, as bars.
        pub shares: Rect,
        /// Names of steps.
        pub axis: Rect,
        /// Of the whole figure.
        pub height: f64,
    }
}

impl view::Layout for Layout {
    const PANELS: &'static [&'static str] = &[CORRIDOR, HISTORY];

    fn laid_out(width: f64, panels: &Panels) -> Self {
        let [corridor, history] = [CORRIDOR, HISTORY].map(|name| panels.has(name));
        let wide = width >= WIDE;
        let mut column = Stack::new(0.0, width);
        let particles_header = column.take(corridor, HEADER, 0.0);
        let particles = column.take(corridor, PARTICLES, 0.0);
        let strip = column.take(corridor, STRIP, 0.0);
        let ekf = column.take(corridor, EKF, 2.0);
        let ekf_header = column.take(corridor, HEADER, PAD);
        let lines = if wide { 1.0 } else { 2.0 };
        let history_header = column.take(history, lines * LINE + 4.0, 0.0);
        let rows = f64::from(2 * MOST_OFF + 1);
        let whole = column.take(history, rows * ROW, 0.0);
        let right = SHARES[usize::from(wide)];
        let names = Rect { w: NAMES, ..whole };
        let area = Rect { x: NAMES, w: width - NAMES - right, ..whole };
        let shares = Rect { x: area.right() + 6.0, w: right - 6.0, ..whole };
        let axis = Rect { x: area.x, w: area.w, ..column.take(history, 18.0, 0.0) };
        let bottom = column.y.ceil();
        Self {
            panels: panels.clone(),
            wide,
            particles_header,
            particles,
            strip,
            ekf,
            ekf_header,
            history_header,
            names,
            history: area,
            shares,
            axis,
            height: bottom,
        }
    }

    fn height(&self) -> f64 {
        self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{assert_laid_out, assert_on_screens};

    #[test]
    fn parts_lie_inside_the_figure_and_never_overlap() {
        assert_laid_out::<Layout>(&[("all", 10), ("corridor", 5), ("history", 5)], PAD);
    }

    #[test]
    fn all_of_it_fits_on_a_screen_with_its_controls() {
        assert_on_screens::<Layout>(&[(352.0, 460.0), (588.0, 460.0), (728.0, 460.0), (804.0, 460.0), (1112.0, 460.0)]);
    }
}
