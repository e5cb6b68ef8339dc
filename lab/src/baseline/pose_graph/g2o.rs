//! Graphs as text, in the format of g2o (Kümmerle, Grisetti, Strasdat, Konolige, Burgard 2011): what other programs read and write.
//!
//! `VERTEX_SE2 id x y θ` is a pose, `EDGE_SE2 i j x y θ Ω₁₁ Ω₁₂ Ω₁₃ Ω₂₂ Ω₂₃ Ω₃₃` a measurement, in metres and radians. The format does not
//! say where an edge comes from: the first between neighbours is taken for odometry, a second one for a match, any other for a loop.

use super::{Edge, EdgeKind, GraphError, MOST_POSES, PoseGraph};
use core::fmt::Write as _;
use fastslam::geometry::Pose2;
use fastslam::nalgebra::Matrix3;
use std::collections::{BTreeMap, BTreeSet};

/// Most edges that are read.
const MOST_EDGES: usize = 200_000;

/// Why a text is no graph.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum G2oError {
    /// A line that cannot be read.
    #[error("line {line}: {problem}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// What is wrong with it, and what it must be.
        problem: String,
    },
    /// All lines can be read, but together they are no graph.
    #[error(transparent)]
    Graph(#[from] GraphError),
}

/// Whether lines that begin so say nothing of motions between poses: what is held fast, parameters, priors, and scans that g2o writes behind a pose.
pub fn says_nothing_of_motion(word: &str) -> bool {
    const WORDS: [&str; 7] =
        ["FIX", "EDGE_PRIOR_SE2", "EDGE_SE2_PRIOR", "EDGE_PRIOR_XY", "EDGE_PRIOR_SE2_XY", "ROBOTLASER1", "RAWLASER1"];
    WORDS.contains(&word) || word.starts_with("PARAMS_")
}

/// What is said besides of a word that is of another kind of graph; nothing of others.
pub fn of_another_kind(word: &str) -> &'static str {
    match word {
        "VERTEX_SE3:QUAT" | "EDGE_SE3:QUAT" | "VERTEX_SE3" | "EDGE_SE3" | "VERTEX_TRACKXYZ" | "EDGE_SE3_TRACKXYZ" => {
            "; it is of a graph in space, and only graphs in the plane can be read"
        }
        "VERTEX2" | "EDGE2" | "VERTEX" | "EDGE" => {
            "; it is of a graph of TORO, which g2o reads (g2o -o FILE.g2o FILE.graph)"
        }
        "VERTEX_XY" | "EDGE_SE2_XY" => "; `fastslam landmarks --g2o` reads graphs with landmarks",
        "EDGE_BEARING_SE2_XY" | "EDGE_SE2_XY_BEARING" => "; a landmark needs a range as well",
        _ => "",
    }
}

/// Reads a graph. Poses are put in the order of their ids; comments, empty lines and what [`says_nothing_of_motion`] are passed over.
///
/// # Errors
/// With the number of the line: of an unknown word, a number that is none or not finite, too few numbers, an id that is there already or
/// not at all, an information that is not positive definite. And the errors of [`PoseGraph::new`].
pub fn read(text: &str) -> Result<PoseGraph, G2oError> {
    let mut poses = BTreeMap::new();
    let mut edges: Vec<(usize, [u64; 2], Pose2, Matrix3<f64>)> = Vec::new();
    for (line, content) in (1..).zip(text.lines()) {
        let fail = |problem: String| G2oError::Line { line, problem };
        let mut words = content.split_whitespace();
        match words.next() {
            None => (),
            Some(word) if word.starts_with('#') || says_nothing_of_motion(word) => (),
            Some("VERTEX_SE2") => {
                let id = id(words.next()).map_err(fail)?;
                let [x, y, theta] = numbers(words).map_err(fail)?;
                if poses.insert(id, Pose2::new(x, y, theta)).is_some() {
                    return Err(fail(format!("vertex {id} is there already")));
                }
                if poses.len() > MOST_POSES {
                    return Err(fail(format!("more than {MOST_POSES} vertices")));
                }
            }
            Some("EDGE_SE2") => {
                let ends = [id(words.next()).map_err(fail)?, id(words.next()).map_err(fail)?];
                let [x, y, theta, xx, xy, xt, yy, yt, tt] = numbers(words).map_err(fail)?;
                let information = Matrix3::new(xx, xy, xt, xy, yy, yt, xt, yt, tt);
                if information.cholesky().is_none() {
                    return Err(fail("the information matrix must be positive definite".into()));
                }
                edges.push((line, ends, Pose2::new(x, y, theta), information));
                if edges.len() > MOST_EDGES {
                    return Err(fail(format!("more than {MOST_EDGES} edges")));
                }
            }
            Some(word) => {
                let word: String = word.chars().take(40).collect();
                let known = "VERTEX_SE2, EDGE_SE2, FIX or a comment that begins with #";
                return Err(fail(format!("{word}: must be {known}{}", of_another_kind(&word))));
            }
        }
    }
    let ranks: BTreeMap<u64, usize> = poses.keys().copied().zip(0..).collect();
    let mut neighbours = BTreeSet::new();
    let mut kind = |i: usize, j: usize| match (i.abs_diff(j), neighbours.insert((i.min(j), i.max(j)))) {
        (1, true) => EdgeKind::Odometry,
        (1, false) => EdgeKind::Match,
        _ => EdgeKind::Loop,
    };
    let mut placed = Vec::with_capacity(edges.len());
    for (line, ends, i_from_j, information) in edges {
        let rank = |id: u64| {
            let problem = || format!("no vertex has the id {id}");
            ranks.get(&id).copied().ok_or_else(|| G2oError::Line { line, problem: problem() })
        };
        let (i, j) = (rank(ends[0])?, rank(ends[1])?);
        if i == j {
            return Err(G2oError::Line { line, problem: format!("an edge from vertex {} to itself", ends[0]) });
        }
        placed.push(Edge { i, j, i_from_j, information, kind: kind(i, j) });
    }
    Ok(PoseGraph::new(poses.into_values().collect(), placed)?)
}

fn id(word: Option<&str>) -> Result<u64, String> {
    let word = word.ok_or("an id is missing")?;
    word.parse().map_err(|_| format!("{}: must be an id, a whole number from 0", cut(word)))
}

fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>) -> Result<[f64; N], String> {
    let mut numbers = [0.0; N];
    for (k, number) in numbers.iter_mut().enumerate() {
        let word = words.next().ok_or_else(|| format!("{k} numbers after the ids: must be {N}"))?;
        let value = word.parse().ok().filter(|value: &f64| value.is_finite());
        *number = value.ok_or_else(|| format!("{}: must be a finite number", cut(word)))?;
    }
    Ok(numbers)
}

fn cut(word: &str) -> String {
    word.chars().take(40).collect()
}

/// Writes a graph, every number to its last bit.
pub fn write(graph: &PoseGraph) -> String {
    let mut text = String::new();
    for (id, Pose2 { x, y, theta }) in graph.poses().iter().enumerate() {
        let _ = writeln!(text, "VERTEX_SE2 {id} {x} {y} {theta}");
    }
    for Edge { i, j, i_from_j: Pose2 { x, y, theta }, information: o, .. } in graph.edges() {
        let [a, b, c, d, e, f] = [o.m11, o.m12, o.m13, o.m22, o.m23, o.m33];
        let _ = writeln!(text, "EDGE_SE2 {i} {j} {x} {y} {theta} {a} {b} {c} {d} {e} {f}");
    }
    text
}
