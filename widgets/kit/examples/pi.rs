//! A whole figure: π by throwing darts at a square. The README goes through it; the tests of the crate build and run it.
//!
//! `cargo run -p fastslam-figures-kit --example pi` tells what it shows.

use fastslam_figures_kit::prelude::*;

/// Everything that a link can say. There is no state besides: it is the model, too.
#[derive(Clone, PartialEq)]
struct Darts {
    darts: u32,
    seed: u64,
}

impl Default for Darts {
    fn default() -> Self {
        Self { darts: 500, seed: 1 }
    }
}

impl Recipe for Darts {
    fn table() -> Vec<Param<Self>> {
        vec![
            Param::integer("darts", "Darts", "", (1, 5000), field!(darts), "How many darts are thrown."),
            Param::seed(field!(seed), "Picks where they land."),
        ]
    }
}

impl Stateless for Darts {
    const TITLE: &'static str = "π by darts";
}

impl Darts {
    fn landed(&self) -> Vec<[f64; 2]> {
        // Evenly over the square, and on no two places alike: fractions of multiples of irrational numbers (Roberts, 2018).
        let from = self.seed as f64 * 0.618_033_988_75;
        let dart =
            |k| [0.754_877_666_25, 0.569_840_290_998].map(|step| 2.0 * (from + f64::from(k) * step).fract() - 1.0);
        (0..self.darts).map(dart).collect()
    }

    fn pi(&self) -> f64 {
        let inside = self.landed().iter().filter(|[x, y]| x * x + y * y < 1.0).count();
        4.0 * inside as f64 / f64::from(self.darts)
    }
}

/// Readouts and a sentence: no pixels.
impl Model for Darts {
    fn readouts(&self) -> Vec<Readout> {
        vec![Readout::new("pi", "π", self.pi(), fixed(self.pi(), 3), "", "Four times the share in the circle.")]
    }

    fn describe(&self) -> String {
        format!("{} darts say that π is {}.", self.darts, fixed(self.pi(), 3))
    }
}

/// Layout and scene; it knows the model, and the model does not know it.
#[derive(Default)]
struct DartsView;

impl View for DartsView {
    type Model = Darts;
    type Layout = Rect;

    fn layout(width: f64, _: &Panels) -> Rect {
        Rect::new(0.0, 0.0, width, 0.6 * width)
    }

    fn draw(&self, model: &Darts, area: &Rect, scene: &mut Scene) {
        let plane = Plane::around(*area, [[-1.0; 2], [1.0; 2]], 8.0);
        let landed = model.landed().into_iter().map(|dart| plane.point(dart));
        scene.cloud(landed, area, 1.5, Role::Prior);
        scene.lines(plane.region([0.0; 2], [[1.0, 0.0], [0.0, 1.0]], 1.0), 2.0, Role::Ink);
    }
}

fn main() {
    println!("{}", Figure::of::<DartsView>("fastslam-pi").describe());
}

#[test]
fn the_figure_of_the_readme_is_set_by_a_link_and_painted() {
    let mut figure = Figure::of::<DartsView>("fastslam-pi");
    assert!(figure.load("darts=0").iter().any(|error| error.message.contains("from 1 to 5000")));
    assert_eq!((figure.load("darts=4000&seed=7"), figure.query().as_str()), (vec![], "darts=4000&seed=7"));
    let pi = figure.model().readouts()[0].value.unwrap();
    assert!((pi - core::f64::consts::PI).abs() < 0.1, "{pi}");
    figure.paint(400, figure.height(400.0) as u32, 1.0, Default::default());
    let paper = figure.canvas().pixels()[..4].to_vec();
    assert!(figure.canvas().pixels().chunks_exact(4).filter(|pixel| **pixel != paper).count() > 4000);
}
