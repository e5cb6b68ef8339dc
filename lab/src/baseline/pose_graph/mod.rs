//! A pose graph: one path that is bent as a whole until what was measured between its poses fits.
//!
//! Nodes are poses x_k of the robot, edges say how one was seen from another: z_ij with an information matrix Ω_ij. The best path is
//! the one of least cost
//!
//! F(x) = ½ Σ_ij e_ijᵀ Ω_ij e_ij, with e_ij = z_ij⁻¹ · (x_i⁻¹ · x_j) as (x, y, θ), the angle wrapped,
//!
//! which is −ln p(x | z) up to a constant for Gaussian measurements. [`Optimizer`] finds it by Gauss and Newton's steps, damped after
//! Levenberg and Marquardt. Nothing here is sampled, and there is one map: that of the path. What a particle filter holds as two
//! universes, a graph must decide: an edge is in or out, and a wrong one folds the map. [`Repair`] has three ways to soften that.
//!
//! A step of a pose is taken in its own frame, x ← x · (δx, δy, δθ), so that neither the cost nor any iterate depends on where the
//! origin is. The cost does not change when all poses move together: pose 0 is held.
//!
//! References: Lu and Milios, *Globally consistent range scan alignment* (Autonomous Robots 1997); Grisetti, Kümmerle, Stachniss,
//! Burgard, *A tutorial on graph-based SLAM* (ITS Magazine 2010), §II; Sünderhauf and Protzel, *Switchable constraints* (IROS 2012);
//! Olson and Agarwal, *Inference on networks of mixtures* (IJRR 2013).

mod envelope;
pub mod g2o;
mod manhattan;
mod optimizer;
mod repair;

pub use manhattan::manhattan;
pub use optimizer::{Iteration, Optimizer};
pub use repair::Repair;

use fastslam::geometry::Pose2;
use fastslam::nalgebra::{Matrix2, Matrix3, Vector3};
use fastslam::ops;

/// Most poses of a graph: of more, an optimisation by this module would not end in a sitting.
pub const MOST_POSES: usize = 20_000;

/// Where an edge comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::VariantArray)]
#[strum(serialize_all = "lowercase")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum EdgeKind {
    /// What the wheels reported between two steps.
    Odometry,
    /// A scan held against those just before it.
    Match,
    /// A scan held against those of a visit long ago. The only kind that can be wholly wrong, and that a [`Repair`] guards.
    Loop,
}

/// A measurement of one pose as seen from another.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Edge {
    /// The pose that is measured from.
    pub i: usize,
    /// The pose that is measured.
    pub j: usize,
    /// z_ij: pose j in the frame of pose i.
    pub i_from_j: Pose2,
    /// Ω_ij (3 × 3, \[1/m², 1/rad²\]), the inverse of the measurement's covariance; of (x, y, θ) in the frame of z_ij.
    pub information: Matrix3<f64>,
    /// Where it comes from.
    pub kind: EdgeKind,
}

/// Why a graph cannot be used.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GraphError {
    /// There is nothing to move.
    #[error("the graph has no poses")]
    NoPoses,
    /// Too many.
    #[error("the graph has {poses} poses: must be {MOST_POSES} at most")]
    TooManyPoses {
        /// How many.
        poses: usize,
    },
    /// A pose that is not a place.
    #[error("pose {pose} is not finite")]
    NotFinite {
        /// Its index.
        pose: usize,
    },
    /// An edge ends nowhere.
    #[error("edge {edge} leads to pose {pose}: must be below {poses}, the number of poses")]
    MissingPose {
        /// Index of the edge.
        edge: usize,
        /// The pose that is not there.
        pose: usize,
        /// Number of poses.
        poses: usize,
    },
    /// An edge from a pose to itself.
    #[error("edge {edge} leads from pose {pose} to itself")]
    Loose {
        /// Index of the edge.
        edge: usize,
        /// Both its ends.
        pose: usize,
    },
    /// A measurement that is no number, or an information without an inverse.
    #[error("edge {edge}: its information must be finite, symmetric and positive definite, and its measurement finite")]
    NotPositiveDefinite {
        /// Index of the edge.
        edge: usize,
    },
    /// Poses that nothing ties to the first one: they could be anywhere.
    #[error("no edges lead from pose 0 to pose {pose}: the graph is in parts, and must be one")]
    Disconnected {
        /// The first of them.
        pose: usize,
    },
    /// The normal equations cannot be solved, however strongly they are damped.
    #[error("the graph is singular: its informations differ by too many orders of magnitude to be solved")]
    Singular,
}

/// Poses and what was measured between them.
#[derive(Clone, PartialEq, Debug)]
pub struct PoseGraph {
    poses: Vec<Pose2>,
    edges: Vec<Edge>,
}

impl PoseGraph {
    /// A graph whose optimisation starts at these poses.
    ///
    /// # Errors
    /// Where there are no poses or too many, an edge ends nowhere or at its own beginning, a number is not finite, an information is
    /// not positive definite, or a pose is tied to the first one by no edges.
    pub fn new(poses: Vec<Pose2>, edges: Vec<Edge>) -> Result<Self, GraphError> {
        let count = poses.len();
        match count {
            0 => return Err(GraphError::NoPoses),
            1..=MOST_POSES => (),
            _ => return Err(GraphError::TooManyPoses { poses: count }),
        }
        if let Some(pose) = poses.iter().position(|pose| !is_finite(pose)) {
            return Err(GraphError::NotFinite { pose });
        }
        for (edge, &Edge { i, j, i_from_j, information, .. }) in edges.iter().enumerate() {
            if let Some(pose) = [i, j].into_iter().find(|pose| *pose >= count) {
                return Err(GraphError::MissingPose { edge, pose, poses: count });
            }
            if i == j {
                return Err(GraphError::Loose { edge, pose: i });
            }
            // A Cholesky factor of its own reads one half of the matrix only.
            let symmetric = (information - information.transpose()).norm() <= 1e-9 * information.norm();
            if !symmetric || !is_finite(&i_from_j) || information.cholesky().is_none() {
                return Err(GraphError::NotPositiveDefinite { edge });
            }
        }
        let graph = Self { poses, edges };
        graph.first_apart().map_or(Ok(graph), |pose| Err(GraphError::Disconnected { pose }))
    }

    /// The first pose that no edges lead to from pose 0.
    fn first_apart(&self) -> Option<usize> {
        let mut neighbours = vec![Vec::new(); self.poses.len()];
        for edge in &self.edges {
            neighbours[edge.i].push(edge.j);
            neighbours[edge.j].push(edge.i);
        }
        let (mut reached, mut open) = (vec![false; self.poses.len()], vec![0]);
        while let Some(pose) = open.pop() {
            if !core::mem::replace(&mut reached[pose], true) {
                open.extend_from_slice(&neighbours[pose]);
            }
        }
        reached.iter().position(|reached| !reached)
    }

    /// The poses, by index.
    pub fn poses(&self) -> &[Pose2] {
        &self.poses
    }

    /// The edges, in the order in which they were given.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Edges of a kind.
    pub fn count(&self, kind: EdgeKind) -> usize {
        self.edges.iter().filter(|edge| edge.kind == kind).count()
    }
}

fn is_finite(pose: &Pose2) -> bool {
    [pose.x, pose.y, pose.theta].iter().all(|c| c.is_finite())
}

/// What an edge says of two poses.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Residual {
    /// e_ij \[m, m, rad\].
    pub error: Vector3<f64>,
    /// ∂e/∂δ_i (3 × 3), for a step of pose i in its own frame.
    pub by_i: Matrix3<f64>,
    /// ∂e/∂δ_j (3 × 3), for a step of pose j in its own frame.
    pub by_j: Matrix3<f64>,
}

impl Edge {
    /// e_ij = z_ij⁻¹ · (x_i⁻¹ · x_j), and how it changes when pose i or pose j is moved in its own frame.
    pub fn residual(&self, world_from_i: &Pose2, world_from_j: &Pose2) -> Residual {
        let seen = world_from_i.between(world_from_j);
        let off = self.i_from_j.between(&seen);
        // Turns from the frame of pose i, and from that of pose j, into the frame of the measurement.
        let (from_i, from_j) = (turn(-self.i_from_j.theta), turn(off.theta));
        let swept = from_i * fastslam::nalgebra::Vector2::new(seen.y, -seen.x);
        let by_i = -from_i;
        Residual {
            error: Vector3::new(off.x, off.y, off.theta),
            by_i: Matrix3::new(by_i.m11, by_i.m12, swept.x, by_i.m21, by_i.m22, swept.y, 0.0, 0.0, -1.0),
            by_j: Matrix3::new(from_j.m11, from_j.m12, 0.0, from_j.m21, from_j.m22, 0.0, 0.0, 0.0, 1.0),
        }
    }

    /// χ² = eᵀ Ω e: how far the poses are from what was measured, in standard deviations squared.
    pub fn chi_squared(&self, world_from_i: &Pose2, world_from_j: &Pose2) -> f64 {
        let off = self.i_from_j.between(&world_from_i.between(world_from_j));
        let e = Vector3::new(off.x, off.y, off.theta);
        e.dot(&(self.information * e))
    }
}

/// The matrix of a turn by so much \[rad\].
fn turn(angle: f64) -> Matrix2<f64> {
    let (sin, cos) = ops::sin_cos(angle);
    Matrix2::new(cos, -sin, sin, cos)
}

/// Information of a measurement from its covariance (3 × 3, \[m², rad²\]).
///
/// # Errors
/// [`GraphError::NotPositiveDefinite`] for a covariance that is not, of the edge with this index.
pub fn information_of(covariance: &Matrix3<f64>, edge: usize) -> Result<Matrix3<f64>, GraphError> {
    let inverse = covariance.cholesky().ok_or(GraphError::NotPositiveDefinite { edge })?.inverse();
    Ok((inverse + inverse.transpose()) * 0.5)
}

#[cfg(test)]
mod tests;
