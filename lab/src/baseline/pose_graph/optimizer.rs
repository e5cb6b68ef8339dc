//! Gauss and Newton's step, damped until it pays.

use super::envelope::Envelope;
use super::{EdgeKind, GraphError, PoseGraph, Repair, Residual};
use fastslam::geometry::Pose2;
use fastslam::nalgebra::{Matrix3, Vector3};

/// λ of the first step: nearly the undamped one.
const FIRST_DAMPING: f64 = 1e-4;
/// λ from which on a step is too short to be one.
const MOST_DAMPING: f64 = 1e12;
/// By what λ grows after a step that did not pay, and falls after one that did.
const DAMPING: f64 = 10.0;
/// A step that lowers the cost by a smaller share of it is the last.
const LEAST_GAIN: f64 = 1e-10;

/// What one iteration did.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Iteration {
    /// Cost before it \[nats\].
    pub cost_before: f64,
    /// Cost after it \[nats\]: never more.
    pub cost_after: f64,
    /// λ that it was taken with.
    pub damping: f64,
    /// Whether there is nothing more to gain.
    pub converged: bool,
}

/// The poses of a graph on their way to the least cost.
#[derive(Clone, Debug)]
pub struct Optimizer {
    graph: PoseGraph,
    repair: Repair,
    /// s of each edge, where the repair has switches; else 1.
    switches: Vec<f64>,
    damping: f64,
    cost: f64,
    /// First column of each row of the normal equations, which are those of all poses but the first.
    first: Vec<usize>,
}

/// The normal equations without their damping: H δ = −g, and what a switch that was eliminated follows by.
struct Normal {
    h: Envelope,
    g: Vec<f64>,
    switches: Vec<SwitchRow>,
}

/// δs = −(g_s + h_iᵀ δ_i + h_jᵀ δ_j) / h_s.
struct SwitchRow {
    edge: usize,
    h_i: Vector3<f64>,
    h_j: Vector3<f64>,
    h_s: f64,
    g_s: f64,
}

impl Optimizer {
    /// At the graph's own poses, every switch on.
    pub fn new(graph: PoseGraph, repair: Repair) -> Self {
        let first = first_columns(&graph);
        let switches = vec![1.0; graph.edges.len()];
        let mut optimizer = Self { graph, repair, switches, damping: FIRST_DAMPING, cost: 0.0, first };
        optimizer.cost = optimizer.cost_of(&optimizer.graph.poses, &optimizer.switches);
        optimizer
    }

    /// The graph with its poses as they are now.
    pub fn graph(&self) -> &PoseGraph {
        &self.graph
    }

    /// The poses as they are now.
    pub fn poses(&self) -> &[Pose2] {
        &self.graph.poses
    }

    /// F \[nats\] as it is now.
    pub fn cost(&self) -> f64 {
        self.cost
    }

    /// The share of each edge's information that pulls, by the order of the edges.
    pub fn weights(&self) -> Vec<f64> {
        (0..self.graph.edges.len()).map(|edge| self.weight(edge)).collect()
    }

    /// F \[nats\] of other poses with the switches as they are now.
    ///
    /// # Panics
    /// Where there are fewer poses than in the graph.
    pub fn cost_at(&self, poses: &[Pose2]) -> f64 {
        self.cost_of(poses, &self.switches)
    }

    fn weight(&self, edge: usize) -> f64 {
        self.repair_of(edge).weight(self.chi_squared(&self.graph.poses, edge), self.switches[edge])
    }

    fn repair_of(&self, edge: usize) -> Repair {
        if self.graph.edges[edge].kind == EdgeKind::Loop { self.repair } else { Repair::LeastSquares }
    }

    fn chi_squared(&self, poses: &[Pose2], edge: usize) -> f64 {
        let edge = &self.graph.edges[edge];
        edge.chi_squared(&poses[edge.i], &poses[edge.j])
    }

    fn cost_of(&self, poses: &[Pose2], switches: &[f64]) -> f64 {
        let cost = |edge: usize| self.repair_of(edge).cost(self.chi_squared(poses, edge), switches[edge]);
        (0..self.graph.edges.len()).map(cost).sum()
    }

    /// One iteration: linearises, and takes the damped step; the damping grows until the cost falls. At the optimum the poses stay as they
    /// are.
    ///
    /// # Errors
    /// [`GraphError::Singular`] where no damping makes the equations solvable.
    pub fn step(&mut self) -> Result<Iteration, GraphError> {
        let (normal, cost_before) = (self.linearize(), self.cost);
        let mut solved = false;
        while self.damping <= MOST_DAMPING {
            let damping = self.damping;
            if let Some((poses, switches)) = self.damped(&normal, damping) {
                solved = true;
                let cost = self.cost_of(&poses, &switches);
                if cost <= cost_before {
                    let converged = cost_before - cost <= LEAST_GAIN * cost_before;
                    (self.graph.poses, self.switches, self.cost) = (poses, switches, cost);
                    self.damping = (damping / DAMPING).max(1e-12);
                    return Ok(Iteration { cost_before, cost_after: cost, damping, converged });
                }
            }
            self.damping *= DAMPING;
        }
        self.damping = FIRST_DAMPING;
        let stays = Iteration { cost_before, cost_after: cost_before, damping: MOST_DAMPING, converged: true };
        if solved { Ok(stays) } else { Err(GraphError::Singular) }
    }

    /// Steps to the optimum, or so many.
    ///
    /// # Errors
    /// Those of [`Self::step`].
    pub fn run(&mut self, most: u32) -> Result<u32, GraphError> {
        for step in 1..=most {
            if self.step()?.converged {
                return Ok(step);
            }
        }
        Ok(most)
    }

    /// H = Σ Jᵀ Ω J and g = Σ Jᵀ Ω e over all edges, each with the share of its information that pulls.
    fn linearize(&self) -> Normal {
        let size = self.first.len();
        let mut normal = Normal { h: Envelope::new(self.first.clone()), g: vec![0.0; size], switches: Vec::new() };
        for (k, edge) in self.graph.edges.iter().enumerate() {
            let Residual { error, by_i, by_j } = edge.residual(&self.graph.poses[edge.i], &self.graph.poses[edge.j]);
            let weighted = edge.information * self.weight(k);
            let (pull_i, pull_j) = (by_i.transpose() * weighted, by_j.transpose() * weighted);
            normal.add(edge.i, edge.i, &(pull_i * by_i));
            normal.add(edge.j, edge.j, &(pull_j * by_j));
            normal.add(edge.j, edge.i, &(pull_j * by_i));
            normal.pull(edge.i, &(pull_i * error));
            normal.pull(edge.j, &(pull_j * error));
            if let Repair::Switchable { prior } = self.repair_of(k) {
                normal.eliminate_switch(
                    k,
                    [edge.i, edge.j],
                    [by_i, by_j],
                    edge.information * error,
                    error,
                    self.switches[k],
                    prior,
                );
            }
        }
        normal
    }

    /// Poses and switches after the step (H + λ diag H) δ = −g; `None` where that cannot be solved.
    fn damped(&self, normal: &Normal, damping: f64) -> Option<(Vec<Pose2>, Vec<f64>)> {
        let mut h = normal.h.clone();
        for row in 0..h.size() {
            *h.diagonal(row) *= 1.0 + damping;
        }
        let delta = h.factor()?.solve(normal.g.iter().map(|g| -g).collect());
        let of = |pose: usize| match pose.checked_sub(1) {
            Some(k) => Vector3::new(delta[3 * k], delta[3 * k + 1], delta[3 * k + 2]),
            None => Vector3::zeros(),
        };
        let moved = |(k, pose): (usize, &Pose2)| {
            let step = of(k);
            pose.compose(&Pose2::new(step.x, step.y, step.z))
        };
        let poses: Vec<Pose2> = self.graph.poses.iter().enumerate().map(moved).collect();
        let mut switches = self.switches.clone();
        for SwitchRow { edge, h_i, h_j, h_s, g_s } in &normal.switches {
            let [i, j] = [self.graph.edges[*edge].i, self.graph.edges[*edge].j];
            let step = -(g_s + h_i.dot(&of(i)) + h_j.dot(&of(j))) / h_s;
            switches[*edge] = (switches[*edge] + step).clamp(0.0, 1.0);
        }
        Some((poses, switches))
    }
}

impl Normal {
    /// Adds a block to H; those of pose 0, which is held, are left out.
    fn add(&mut self, row: usize, column: usize, block: &Matrix3<f64>) {
        let (Some(row_block), Some(column_block)) = (row.checked_sub(1), column.checked_sub(1)) else { return };
        for (r, c) in (0..3).flat_map(|r| (0..3).map(move |c| (r, c))) {
            // Of a block on the diagonal, one half.
            if row != column || c <= r {
                self.h.add(3 * row_block + r, 3 * column_block + c, block[(r, c)]);
            }
        }
    }

    fn pull(&mut self, pose: usize, g: &Vector3<f64>) {
        if let Some(block) = pose.checked_sub(1) {
            (0..3).for_each(|r| self.g[3 * block + r] += g[r]);
        }
    }

    /// The row of an edge's switch: it meets the poses of its own edge only, so that it can be solved for and taken out (Schur).
    #[expect(clippy::too_many_arguments, reason = "all that an edge has, from its only caller")]
    fn eliminate_switch(
        &mut self,
        edge: usize,
        [i, j]: [usize; 2],
        [by_i, by_j]: [Matrix3<f64>; 2],
        pull: Vector3<f64>,
        error: Vector3<f64>,
        switch: f64,
        prior: f64,
    ) {
        let chi_squared = error.dot(&pull);
        let (h_s, g_s) = (chi_squared + prior, switch * chi_squared - prior * (1.0 - switch));
        let [h_i, h_j] = [by_i, by_j].map(|by| by.transpose() * pull * switch);
        self.add(i, i, &(h_i * h_i.transpose() / -h_s));
        self.add(j, j, &(h_j * h_j.transpose() / -h_s));
        self.add(j, i, &(h_j * h_i.transpose() / -h_s));
        self.pull(i, &(h_i * (-g_s / h_s)));
        self.pull(j, &(h_j * (-g_s / h_s)));
        self.switches.push(SwitchRow { edge, h_i, h_j, h_s, g_s });
    }
}

/// Where the rows of the normal equations begin: at the first pose that an edge ties theirs to.
fn first_columns(graph: &PoseGraph) -> Vec<usize> {
    let mut least: Vec<usize> = (0..graph.poses.len()).collect();
    for edge in &graph.edges {
        let (low, high) = (edge.i.min(edge.j), edge.i.max(edge.j));
        least[high] = least[high].min(low.max(1));
    }
    (1..graph.poses.len()).flat_map(|pose| [3 * (least[pose] - 1); 3]).collect()
}
