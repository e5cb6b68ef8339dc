//! Landmark graphs in the format of g2o, as a drive: `VERTEX_SE2`, `VERTEX_XY`, `EDGE_SE2` between successive poses, `EDGE_SE2_XY`.
//!
//! A filter goes along the poses in the order of their ids; where landmarks are seen from the first of them, it begins with a step in which
//! the robot stands. Edges between other poses say what it finds out by itself, and are passed over, as are parameters, priors and the scans that
//! g2o writes behind a pose. An edge that leads back from a pose to the one before it is turned. The
//! vertices are what errors are told against: the optimum, or what the file has for a start.

use crate::{Usage, in_file};
use anyhow::{Context, Result, bail};
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::Gate;
use fastslam::motion::{Displaced, Displacement};
use fastslam::ops;
use fastslam::sensor::{Feature, RangeBearing};
use fastslam_lab::baseline::pose_graph::g2o;
use fastslam_lab::experiment::landmarks::{LandmarkLog, Tuning};
use nalgebra::{Matrix2, Matrix3, Vector2};
use std::collections::BTreeMap;
use std::path::Path;

/// Where the tuning comes from.
pub const NOISES: &str = "those of the graph's edges";

/// Most vertices, and most edges, that are read.
const MOST: usize = 1_000_000;

/// Reads a graph: the drive, and the mean noise of its sightings.
pub fn read(path: &Path) -> Result<(LandmarkLog<Displacement>, Tuning<Displaced>)> {
    let text = std::fs::read_to_string(path).with_context(in_file(path))?;
    let fail = |line: usize, what: String| Usage::of_file(path, format_args!("line {line}: {what}"));
    let (mut poses, mut points) = (BTreeMap::new(), BTreeMap::new());
    let (mut driven, mut seen) = (BTreeMap::new(), Vec::new());
    for (line, content) in (1..).zip(text.lines()) {
        let words: Vec<&str> = content.split_whitespace().collect();
        let Some((&kind, rest)) = words.split_first() else { continue };
        let (ids, numbers) = match kind {
            _ if kind.starts_with('#') || g2o::says_nothing_of_motion(kind) => continue,
            "VERTEX_SE2" => (1, 3),
            "VERTEX_XY" => (1, 2),
            "EDGE_SE2" => (2, 9),
            "EDGE_SE2_XY" => (2, 5),
            _ => {
                let kind: String = kind.chars().take(40).collect();
                let known = "VERTEX_SE2, VERTEX_XY, EDGE_SE2, EDGE_SE2_XY, FIX or a comment that begins with #";
                let why = g2o::of_another_kind(&kind);
                bail!(fail(line, format!("{kind}: must be {known}{why}")));
            }
        };
        if rest.len() != ids + numbers {
            bail!(fail(line, format!("{kind} needs {ids} ids and {numbers} numbers, not {} words", rest.len())));
        }
        let id: Option<Vec<u64>> = rest[..ids].iter().map(|word| word.parse().ok()).collect();
        let Some(id) = id else { bail!(fail(line, "an id must be a whole number from 0".into())) };
        let number: Option<Vec<f64>> =
            rest[ids..].iter().map(|word| word.parse().ok().filter(|x: &f64| x.is_finite())).collect();
        let Some(x) = number else { bail!(fail(line, format!("{kind} needs {numbers} finite numbers"))) };
        let singular = || fail(line, "the information matrix must be positive definite".into());
        match kind {
            "VERTEX_SE2" | "VERTEX_XY" if poses.contains_key(&id[0]) || points.contains_key(&id[0]) => {
                bail!(fail(line, format!("vertex {} is there already", id[0])));
            }
            "VERTEX_SE2" => drop(poses.insert(id[0], Pose2::new(x[0], x[1], x[2]))),
            "VERTEX_XY" => drop(points.insert(id[0], Vector2::new(x[0], x[1]))),
            "EDGE_SE2" => {
                let information = Matrix3::new(x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8]);
                let covariance = information.cholesky().ok_or_else(singular)?.inverse();
                let mean = Pose2::new(x[0], x[1], x[2]);
                driven.entry((id[0], id[1])).or_insert(Displacement { mean, covariance });
            }
            _ => {
                let information = Matrix2::new(x[2], x[3], x[3], x[4]);
                let covariance = information.cholesky().ok_or_else(singular)?.inverse();
                seen.push((line, id[0], id[1], Vector2::new(x[0], x[1]), covariance));
            }
        }
        if poses.len() + points.len() > MOST || driven.len() + seen.len() > MOST {
            bail!(fail(line, format!("more than {MOST} vertices or edges")));
        }
    }
    if poses.len() < 2 || seen.is_empty() {
        let needed = "needs two poses (VERTEX_SE2) or more and a sighting (EDGE_SE2_XY) or more";
        let only_poses = "; `fastslam-lab lap --method graph --from-g2o` optimizes a graph of poses";
        let more = if poses.len() > 1 { only_poses } else { "" };
        bail!(Usage::of_file(path, format_args!("{needed}{more}")));
    }

    let signatures: BTreeMap<u64, u32> = points.keys().copied().zip(0..).collect();
    let mut looks: BTreeMap<u64, Vec<Feature>> = BTreeMap::new();
    let mut variances = Vector2::zeros();
    for (line, pose, point, at, covariance) in &seen {
        // Whichever is named first, it is the landmark as seen from the pose.
        let is_turned = points.contains_key(pose) && poses.contains_key(point);
        let (pose, point) = if is_turned { (point, pose) } else { (pose, point) };
        let Some(signature) = signatures.get(point) else {
            bail!(fail(*line, format!("no VERTEX_XY has the id {point}")))
        };
        if !poses.contains_key(pose) {
            bail!(fail(*line, format!("no VERTEX_SE2 has the id {pose}")));
        }
        let range = at.norm();
        if range < 1e-6 {
            bail!(fail(*line, "a landmark at the robot's own place has no bearing".into()));
        }
        let (ahead, aside) = (at / range, Vector2::new(-at.y, at.x) / range);
        variances += Vector2::new(ahead.dot(&(covariance * ahead)), aside.dot(&(covariance * aside)) / (range * range));
        let z = Vector2::new(range, ops::atan2(at.y, at.x));
        looks.entry(*pose).or_default().push(Feature { z, signature: Some(*signature) });
    }
    let [range_std, bearing_std] = <[f64; 2]>::from(variances / seen.len() as f64).map(f64::sqrt);

    let mut log = LandmarkLog { landmarks: points.into_values().collect(), ..LandmarkLog::default() };
    let ids: Vec<u64> = poses.keys().copied().collect();
    log.truth = poses.into_values().collect();
    log.odometry.push(log.truth[0]);
    if let Some(features) = looks.remove(&ids[0]) {
        // What is seen from the first pose is seen before the robot moves: by a step in which it stands.
        log.truth.insert(0, log.truth[0]);
        log.odometry.push(log.truth[0]);
        log.controls.push(Displacement { mean: Pose2::default(), covariance: Matrix3::zeros() });
        log.sightings.push(features);
    }
    for pair in ids.windows(2) {
        let back = || driven.get(&(pair[1], pair[0])).map(turned);
        let Some(step) = driven.get(&(pair[0], pair[1])).copied().or_else(back) else {
            bail!(Usage::of_file(path, format_args!("no EDGE_SE2 leads from vertex {} to {}", pair[0], pair[1])));
        };
        log.odometry.push(log.odometry[log.odometry.len() - 1].compose(&step.mean));
        log.controls.push(step);
        log.sightings.push(looks.remove(&pair[1]).unwrap_or_default());
    }
    let sensor = RangeBearing { range_std, bearing_std, max_range: 1e6, field_of_view: core::f64::consts::TAU };
    Ok((log, Tuning { motion: Displaced, sensor, gate: Gate::default() }))
}

/// The same motion, seen from its end: x = u⁻¹, Σ_x = J Σ_u Jᵀ with the derivatives J of x by u.
fn turned(u: &Displacement) -> Displacement {
    let mean = u.mean.between(&Pose2::default());
    let (sin, cos) = ops::sin_cos(u.mean.theta);
    let j = Matrix3::new(-cos, -sin, mean.y, sin, -cos, -mean.x, 0.0, 0.0, -1.0);
    Displacement { mean, covariance: j * u.covariance * j.transpose() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_that_is_turned_has_the_covariance_of_its_inverse() {
        let covariance = Matrix3::new(0.04, 0.01, 0.002, 0.01, 0.09, -0.003, 0.002, -0.003, 0.01);
        let u = Displacement { mean: Pose2::new(1.5, -0.4, 0.7), covariance };
        let inverse = turned(&u);
        let whole = u.mean.compose(&inverse.mean);
        assert!(whole.minus(&Pose2::default()).amax() < 1e-12);
        // By differences of the inverse along each axis.
        let j = Matrix3::from_fn(|row, axis| {
            let mut moved = [u.mean.x, u.mean.y, u.mean.theta];
            moved[axis] += 1e-6;
            let moved = Pose2::new(moved[0], moved[1], moved[2]).between(&Pose2::default());
            moved.minus(&inverse.mean)[row] / 1e-6
        });
        assert!((inverse.covariance - j * covariance * j.transpose()).amax() < 1e-6);
    }
}
