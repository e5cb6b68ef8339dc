//! A whole figure: π by throwing darts at a square. `widgets/README.md` goes through it; the tests of the crate build and run it.
//!
//! `cargo run -p fastslam-widgets --example pi` tells what it shows.

use fastslam_widgets::{
    decimal::fixed,
    fastslam::random::{Purpose, Stream},
    field,
    figure::Figure,
    model::{Column, Declared, FigureError, Model, Readout, Series},
    recipe::{Param, Recipe},
    scene::{Mark, Plane, Rect, Role, Scene, closed, cloud, ellipse},
    view::View,
};
use std::sync::LazyLock;

/// Everything that a link can say.
#[derive(Clone, PartialEq)]
struct Throws {
    darts: usize,
    seed: u64,
}

impl Default for Throws {
    fn default() -> Self {
        Self { darts: 500, seed: 1 }
    }
}

impl Recipe for Throws {
    fn table() -> &'static [Param<Self>] {
        type P = Param<Throws>;
        static TABLE: LazyLock<Vec<P>> = LazyLock::new(|| {
            vec![
                P::integer("darts", "Darts", "", (1, 5000), field!(darts), "How many darts are thrown."),
                P::seed(field!(seed), "Picks where they land."),
            ]
        });
        &TABLE
    }
}

/// State, readouts, sentence and data: no pixels.
#[derive(Default)]
struct Darts {
    recipe: Throws,
}

impl Darts {
    fn landed(&self) -> Vec<[f64; 2]> {
        let dart = |k| {
            let mut stream = Stream::at(self.recipe.seed, Purpose::TRIAL, k as u32, 0);
            [0, 1].map(|_| 2.0 * stream.uniform() - 1.0)
        };
        (0..self.recipe.darts).map(dart).collect()
    }

    fn pi(&self) -> f64 {
        let inside = self.landed().iter().filter(|[x, y]| x * x + y * y < 1.0).count();
        4.0 * inside as f64 / self.recipe.darts as f64
    }
}

impl Declared for Darts {
    type Recipe = Throws;
    const TITLE: &'static str = "π by darts";

    fn recipe(&self) -> &Throws {
        &self.recipe
    }

    fn adopt(&mut self, recipe: Throws) -> Result<(), FigureError> {
        self.recipe = recipe;
        Ok(())
    }
}

impl Model for Darts {
    fn readouts(&self) -> Vec<Readout> {
        vec![Readout::new(
            "pi",
            "π",
            self.pi(),
            fixed(self.pi(), 3),
            "",
            "Four times the share of darts in the circle.",
        )]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[Column::new("x", "where a dart landed"), Column::new("y", "where it landed")];
        Series { columns: COLUMNS, rows: self.landed().into_iter().map(Vec::from).collect() }
    }

    fn describe(&self) -> String {
        format!("{} darts say that π is {}.", self.recipe.darts, fixed(self.pi(), 3))
    }
}

/// Layout and scene; it knows the model, and the model does not know it.
#[derive(Default)]
struct DartsView;

impl View for DartsView {
    type Model = Darts;
    const NARROWEST: f64 = 200.0;

    fn layout_height(&self, width: f64) -> f64 {
        0.6 * width.max(Self::NARROWEST)
    }

    fn draw(&self, model: &Darts, scene: &mut Scene) {
        let area = Rect::new(0.0, 0.0, scene.width, scene.height);
        let plane = Plane::around(area, [[-1.0; 2], [1.0; 2]], 8.0);
        let circle = closed(ellipse(plane.point([0.0; 2]), [[1.0, 0.0], [0.0, 1.0]], plane.scale));
        scene.marks.push(cloud(model.landed().into_iter().map(|dart| plane.point(dart)), &area, 1.5, Role::Prior));
        scene.marks.push(Mark::Lines { lines: vec![circle], width: 2.0, dash: None, role: Role::Ink });
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
