//! Robots and their paths in a picture: the words of drawing know of no pose.

use crate::scene::{Plane, Point, RIM, Role, Sample, Scene};
use fastslam::{geometry::Pose2, ops};

/// A robot: an arrow head of this length from centre to nose \[css px\], which points along `theta` \[rad\], counter-clockwise from
/// the right.
pub fn robot([x, y]: Point, theta: f64, length: f64) -> Vec<Point> {
    let (sin, cos) = ops::sin_cos(theta);
    let corner = |[along, across]: [f64; 2]| {
        [x + length * (along * cos - across * sin), y - length * (along * sin + across * cos)]
    };
    [[1.0, 0.0], [-0.8, 0.75], [-0.4, 0.0], [-0.8, -0.75]].map(corner).to_vec()
}

/// A robot that looks to the right, for a legend.
pub fn sample(role: Role) -> Sample<'static> {
    Sample::at(move |scene, [x, y]| scene.polygon(robot([x - 1.0, y], 0.0, 7.0), role))
}

/// Poses of the world in a picture of a part of it.
pub trait Poses {
    /// Where a pose of the world is.
    fn position(&self, pose: &Pose2) -> Point;

    /// The positions of a path, cut at the edges. Points nearer than `least` \[css px\] to the one before are left out.
    fn path(&self, poses: &[Pose2], least: f64) -> Vec<Vec<Point>>;

    /// A robot of this length from centre to nose \[css px\]; `None` where not all of it is in the area.
    fn robot(&self, pose: &Pose2, length: f64) -> Option<Vec<Point>>;
}

impl Poses for Plane {
    fn position(&self, pose: &Pose2) -> Point {
        self.point([pose.x, pose.y])
    }

    fn path(&self, poses: &[Pose2], least: f64) -> Vec<Vec<Point>> {
        self.way(&mut poses.iter().map(|pose| [pose.x, pose.y]), least)
    }

    fn robot(&self, pose: &Pose2, length: f64) -> Option<Vec<Point>> {
        let (corners, view) = (robot(self.position(pose), pose.theta, length), self.area.inset(RIM));
        corners.iter().all(|corner| view.contains(*corner)).then_some(corners)
    }
}

/// Drawing robots.
pub trait Robots {
    /// A robot of this length \[css px\] with a rim; nothing where it is out of view.
    fn rimmed_robot(&mut self, plane: &Plane, pose: &Pose2, length: f64, role: Role);
}

impl Robots for Scene {
    fn rimmed_robot(&mut self, plane: &Plane, pose: &Pose2, length: f64, role: Role) {
        if let Some(corners) = plane.robot(pose, length) {
            self.rimmed_polygon(corners, role);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Rect;

    #[test]
    fn a_robot_that_looks_up_points_up_and_one_out_of_view_is_not_drawn() {
        let plane = Plane::centred(Rect::new(100.0, 50.0, 400.0, 300.0), [0.0; 2], 10.0);
        let corners = plane.robot(&Pose2::new(1.0, 1.0, core::f64::consts::FRAC_PI_2), 10.0).unwrap();
        assert!(corners[1..].iter().all(|corner| corner[1] > corners[0][1]));
        assert_eq!(plane.robot(&Pose2::new(90.0, 0.0, 0.0), 10.0), None);
    }
}
