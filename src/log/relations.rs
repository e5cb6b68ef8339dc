//! The benchmark's metric: relations between poses that are known to be true, by the rule of the published figures.
//!
//! The relations name stamps, and not at every stamp there is an estimate. A stamp within [`NEAR`] of an estimate takes it
//! as it stands; any other takes the nearest one, moved by raw odometry. Moving it in every case gives smaller errors, of any
//! program: figures by the two rules are never to be set side by side.
//!
//! Reference: Kümmerle et al., *On measuring the accuracy of SLAM algorithms*, Autonomous Robots 2009.

use super::number::number;
use super::{LogError, LogProblem, odometry_at};
use fastslam::geometry::Pose2;

/// Where a robot was at one time, seen from where it was at another.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Relation {
    /// The two times \[s\].
    pub times: [f64; 2],
    /// The pose at the second in the frame of the pose at the first.
    pub first_from_second: Pose2,
}

/// How far an estimated path is from the relations.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RelationErrors {
    /// Relations that were held against the path.
    pub relations: u32,
    /// Mean of the translational errors \[m\].
    pub translation_mean: f64,
    /// Their standard deviation \[m\].
    pub translation_std: f64,
    /// Mean of the absolute rotational errors \[deg\].
    pub rotation_mean_deg: f64,
    /// Their standard deviation \[deg\].
    pub rotation_std_deg: f64,
}

/// Reads lines `t1 t2 x y z roll pitch yaw`, of which x, y and yaw are used; lines that begin with # are comments.
///
/// # Errors
/// The first line that is not eight numbers; with line 0, that there is none.
pub fn parse_relations(bytes: &[u8]) -> Result<Vec<Relation>, LogError> {
    let mut relations = Vec::new();
    for (line, bytes) in (1..).zip(bytes.split(|byte| *byte == b'\n')) {
        let text = core::str::from_utf8(bytes).unwrap_or("?").trim();
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        let numbers: Option<Vec<f64>> =
            text.split_ascii_whitespace().map(|word| number(word).filter(|x| x.is_finite())).collect();
        let Some([t1, t2, x, y, _, _, _, yaw]) = numbers.and_then(|numbers| <[f64; 8]>::try_from(numbers).ok()) else {
            return Err(LogError { line, problem: LogProblem::Relation });
        };
        relations.push(Relation { times: [t1, t2], first_from_second: Pose2::new(x, y, yaw) });
    }
    if relations.is_empty() {
        return Err(LogError::whole(LogProblem::NoRelation));
    }
    Ok(relations)
}

/// Time \[s\] within which an estimate is taken as it stands.
pub const NEAR: f64 = 0.1;

/// δ = x_{t1}⁻¹ ⊕ x_{t2} of the estimate against δ\* of each relation: ‖t(δ) − t(δ\*)‖ \[m\] and |θ(δ) − θ(δ\*)| \[deg\], their means and
/// standard deviations.
///
/// `path` and `odometry` are poses by ascending time \[s\]. A time takes the nearest estimate, of two as near the earlier: as it
/// stands within [`NEAR`], and beyond that moved by raw odometry. Relations that reach out of the time of both are left out;
/// `None` if no relation is left, or there is no pose: then nothing has been judged.
pub fn relation_errors(
    path: &[(f64, Pose2)],
    odometry: &[(f64, Pose2)],
    relations: &[Relation],
) -> Option<RelationErrors> {
    let times = || path.iter().chain(odometry).map(|(time, _)| *time);
    let (first, last) = (times().fold(f64::INFINITY, f64::min), times().fold(f64::NEG_INFINITY, f64::max));
    let known = |relation: &&Relation| relation.times.iter().all(|time| (first..=last).contains(time));
    let relations: Vec<&Relation> = relations.iter().filter(known).collect();
    if path.is_empty() || relations.is_empty() {
        return None;
    }
    let first_from = |time: f64| path.partition_point(|(t, _)| *t < time);
    let pose_at = |time: f64| {
        let after = first_from(time).min(path.len() - 1);
        // Of estimates with one stamp the first.
        let before = first_from(path[after.saturating_sub(1)].0);
        let nearest = if (path[after].0 - time).abs() < (path[before].0 - time).abs() { after } else { before };
        let (estimated, pose) = path[nearest];
        match (odometry_at(odometry, estimated), odometry_at(odometry, time)) {
            (Some(from), Some(to)) if (estimated - time).abs() > NEAR => pose.compose(&from.between(&to)),
            _ => pose,
        }
    };
    let errors = relations.iter().map(|Relation { times: [t1, t2], first_from_second: truth }| {
        let delta = pose_at(*t1).between(&pose_at(*t2));
        [delta.distance(truth), delta.minus(truth).z.abs().to_degrees()]
    });
    let errors: Vec<[f64; 2]> = errors.collect();
    let n = errors.len() as f64;
    let moments = |k: usize| {
        let mean = errors.iter().map(|e| e[k]).sum::<f64>() / n;
        let variance = errors.iter().map(|e| (e[k] - mean) * (e[k] - mean)).sum::<f64>() / n;
        (mean, variance.sqrt())
    };
    let ((translation_mean, translation_std), (rotation_mean_deg, rotation_std_deg)) = (moments(0), moments(1));
    let relations = errors.len() as u32;
    Some(RelationErrors { relations, translation_mean, translation_std, rotation_mean_deg, rotation_std_deg })
}
