//! A map of echoes: the mean point of all that fell into a square, for each square. Neither a grid of occupancy nor landmarks.

use fastslam::geometry::Pose2;
use fastslam::map::ConditionalMap;
use fastslam::matching::{Likelihood, Score, ScoreNear};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Where the echoes of one ring of sonars came from, in the robot's frame \[m\].
pub type Echoes = Vec<[f64; 2]>;

/// Echoes of a square: how many, and the sum of their coordinates \[m\].
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Square {
    pub count: u32,
    pub sum: [f64; 2],
}

impl Square {
    pub fn mean(&self) -> [f64; 2] {
        self.sum.map(|sum| sum / f64::from(self.count))
    }
}

/// Squares by column and row. A clone shares them until one of both is written to.
#[derive(Clone, Debug)]
pub struct Points {
    side: f64,
    squares: Arc<BTreeMap<(i32, i32), Square>>,
}

impl Points {
    /// An empty map with squares of this side \[m\].
    pub fn new(side: f64) -> Self {
        Self { side, squares: Arc::default() }
    }

    pub fn squares(&self) -> &BTreeMap<(i32, i32), Square> {
        &self.squares
    }

    fn square_of(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        ((x / self.side).floor() as i32, (y / self.side).floor() as i32)
    }

    /// Squared distance \[m²\] to the nearest point of the nine squares around.
    fn nearest(&self, point: [f64; 2]) -> Option<f64> {
        let (i, j) = self.square_of(point);
        let around = (-1..=1).flat_map(|dj| (-1..=1).map(move |di| (i + di, j + dj)));
        let squares = around.filter_map(|key| self.squares.get(&key));
        let distances = squares.map(|square| {
            let [x, y] = square.mean();
            (x - point[0]) * (x - point[0]) + (y - point[1]) * (y - point[1])
        });
        distances.reduce(f64::min)
    }
}

impl ConditionalMap for Points {
    type Observation = Echoes;
    type Association = ();

    fn assimilate(&mut self, world_from_robot: &Pose2, echoes: &Echoes, (): &()) {
        let ends: Vec<[f64; 2]> = echoes.iter().map(|echo| world_from_robot.transform(*echo)).collect();
        let keys: Vec<(i32, i32)> = ends.iter().map(|end| self.square_of(*end)).collect();
        let squares = Arc::make_mut(&mut self.squares);
        for (key, [x, y]) in keys.into_iter().zip(ends) {
            let square = squares.entry(key).or_default();
            square.count += 1;
            square.sum = [square.sum[0] + x, square.sum[1] + y];
        }
    }
}

/// −½ Σ min(d², most²) / σ² over the echoes: d is the distance to the nearest point of the map.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Nearest {
    /// σ \[m\], wider than a sonar's: echoes of one wall err together.
    pub std: f64,
    /// Beyond this \[m\] an echo is of nothing in the map.
    pub most: f64,
}

impl Nearest {
    fn score(&self, map: &Points, pose: &Pose2, echoes: &[[f64; 2]]) -> f64 {
        let most = self.most * self.most;
        let cost = |echo: &[f64; 2]| map.nearest(pose.transform(*echo)).map_or(most, |d2| d2.min(most));
        -0.5 * echoes.iter().map(cost).sum::<f64>() / (self.std * self.std)
    }
}

impl Likelihood<Points> for Nearest {
    fn log_likelihood(&self, map: &Points, pose: &Pose2, echoes: &Echoes) -> (f64, ()) {
        (self.score(map, pose, echoes), ())
    }
}

impl Score<Points> for Nearest {
    type Near<'a> = Here<'a>;

    fn near<'a>(&'a self, map: &'a Points, _: &Pose2, echoes: &'a Echoes, _: usize) -> Here<'a> {
        Here { score: self, map, echoes }
    }
}

/// The score of one ring of echoes by one map.
pub struct Here<'a> {
    score: &'a Nearest,
    map: &'a Points,
    echoes: &'a Echoes,
}

impl ScoreNear for Here<'_> {
    fn log_score(&self, pose: &Pose2) -> f64 {
        self.score.score(self.map, pose, self.echoes)
    }
}
