//! A drive: a smooth path through way points, sampled at even distances.

use fastslam::geometry::Pose2;
use fastslam::ops;

/// Rounds of corner cutting: three leave arcs of about a third of the shorter leg at each corner.
const ROUNDS: usize = 3;

/// `steps` + 1 poses at even distances along the way points \[m\], corners rounded by cutting (Chaikin 1974), heading along the
/// path.
///
/// # Panics
/// For fewer than two way points or no step.
pub fn drive(way_points: &[[f64; 2]], steps: usize) -> Vec<Pose2> {
    assert!(way_points.len() >= 2 && steps > 0, "a drive needs two way points and one step");
    let mut curve = way_points.to_vec();
    for _ in 0..ROUNDS {
        let mut cut = vec![curve[0]];
        for leg in curve.windows(2) {
            cut.extend([0.25, 0.75].map(|t| between(leg[0], leg[1], t)));
        }
        cut.push(curve[curve.len() - 1]);
        curve = cut;
    }
    let lengths: Vec<f64> = curve.windows(2).map(|l| ops::hypot(l[1][0] - l[0][0], l[1][1] - l[0][1])).collect();
    let total: f64 = lengths.iter().sum();
    let (mut leg, mut before) = (0, 0.0);
    (0..=steps)
        .map(|k| {
            let travelled = total * k as f64 / steps as f64;
            while leg + 1 < lengths.len() && before + lengths[leg] < travelled {
                before += lengths[leg];
                leg += 1;
            }
            let (a, b) = (curve[leg], curve[leg + 1]);
            let [x, y] = between(a, b, ((travelled - before) / lengths[leg]).min(1.0));
            Pose2::new(x, y, ops::atan2(b[1] - a[1], b[0] - a[0]))
        })
        .collect()
}

/// The same way points with two more on every long leg, `near` \[m\] from its ends: [`drive`] then leaves the legs there, and not
/// half-way, to round a corner.
///
/// A leg of up to 2.5 × `near` stays as it is.
pub fn corners_cut_short(way_points: &[[f64; 2]], near: f64) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for leg in way_points.windows(2) {
        let [a, b] = [leg[0], leg[1]];
        let length = ops::hypot(b[0] - a[0], b[1] - a[1]);
        let at = |along: f64| [0, 1].map(|k: usize| a[k] + along / length * (b[k] - a[k]));
        points.push(a);
        if length > 2.5 * near {
            points.extend([at(near), at(length - near)]);
        }
    }
    points.extend(way_points.last());
    points
}

fn between(a: [f64; 2], b: [f64; 2], t: f64) -> [f64; 2] {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_of_one_length_along_the_path() {
        let poses = drive(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]], 40);
        assert_eq!(poses.len(), 41);
        assert_eq!((poses[0], poses[40].distance(&Pose2::new(4.0, 3.0, 0.0))), (Pose2::default(), 0.0));
        let lengths: Vec<f64> = poses.windows(2).map(|p| p[0].distance(&p[1])).collect();
        assert!(lengths.iter().all(|l| (l - lengths[0]).abs() < 0.01 * lengths[0]), "{lengths:?}");
    }

    #[test]
    fn corners_are_cut_where_they_are_asked_to_be() {
        let way_points = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [6.0, 7.0]];
        let points = corners_cut_short(&way_points, 1.0);
        assert_eq!(
            points,
            [[0.0, 0.0], [1.0, 0.0], [5.0, 0.0], [6.0, 0.0], [6.0, 1.0], [6.0, 5.0], [6.0, 6.0], [6.0, 7.0]]
        );
        // An arc may begin half-way between two points: from there on, the corner's leg is left.
        let straight = |pose: &Pose2| pose.y == 0.0;
        let leaves =
            |points: &[[f64; 2]]| drive(points, 100).iter().take_while(|pose| straight(pose)).last().unwrap().x;
        assert!((5.0..5.6).contains(&leaves(&points)) && leaves(&way_points) < 4.0);
    }
}
