//! A whole figure: π by throwing darts at a square. The README goes through it; the tests of the crate build and run it.
//!
//! `cargo run -p fastslam-figures-kit --example pi` tells what it shows.

use fastslam_figures_kit::prelude::*;

recipe! {
    /// Everything that a link can say of it. There is no state besides.
    pub struct Darts {
        darts: u32 = 500, integer("darts", "Darts", "", (1, 5000)), "How many darts are thrown.", in_sight();
        seed: u64 = 1, seed(), "Picks where they land.";
    }
}

impl Darts {
    /// Where they land: evenly, and never twice in one place (fractions of multiples of irrational numbers).
    fn landed(&self) -> impl Iterator<Item = [f64; 2]> {
        let place = |k| [0.754_877_666, 0.569_840_291].map(|step| 2.0 * (step * k as f64).fract() - 1.0);
        (5000 * self.seed..).take(self.darts as usize).map(place)
    }

    fn pi(&self) -> f64 {
        4.0 * self.landed().filter(|[x, y]| x * x + y * y < 1.0).count() as f64 / f64::from(self.darts)
    }
}

impl Sketch for Darts {
    const TITLE: &'static str = "π by darts";

    fn readouts(&self) -> Vec<Readout> {
        vec![Readout::new("pi", "π", self.pi(), fixed(self.pi(), 3), "", "Four times the share in the circle.")]
    }

    fn describe(&self) -> String {
        format!("{} darts say that π is {}.", self.darts, fixed(self.pi(), 3))
    }

    fn draw(&self, _panel: &str, area: Rect, scene: &mut Scene) {
        let plane = Plane::around(area, [[-1.0; 2], [1.0; 2]], 8.0);
        scene.cloud(self.landed().map(|dart| plane.point(dart)), &area, 1.5, Role::Prior);
        scene.lines(plane.region([0.0; 2], [[1.0, 0.0], [0.0, 1.0]], 1.0), 2.0, Role::Ink);
    }
}

fn main() {
    println!("{}", Figure::of::<Darts>("pi").describe());
}

#[test]
fn the_figure_of_the_readme_is_set_by_a_link_and_drawn() {
    let mut figure = Figure::of::<Darts>("pi");
    assert!(figure.load("darts=6000&seed=7")[0].message.contains("from 1 to 5000") && figure.query() == "seed=7");
    assert_eq!(figure.describe(), "500 darts say that π is 3.152.");
    assert_eq!(figure.scene(400.0, 240.0).marks.len(), 2);
}
