//! The noises as ellipses in the panels, each with a knob at its end: what is drawn is what is dragged.
//!
//! The motion prior's is the region of drives that holds 90 %. The sensor's is the same of a sighting from where the robot is: the range
//! along the line of sight, the bearing across it. A knob of the sensor stands a little beyond the end of its axis, so that it can be
//! grasped however sharp the sensor is; and what is too large for the panel is drawn together towards its edge.

use super::zoom::{self, HALF};
use crate::{
    marks::Place,
    robot::Poses,
    scene::{NINE_TENTHS, Plane, Point, Rect, clip_polyline},
    words::proposal,
};
use fastslam::{
    geometry::Pose2,
    motion::{Odometry, OdometryModel},
    ops,
};
use fastslam_lab::experiment::proposal::{ALPHAS, CONTROL, FROM, Proposals, ProposalsSetup};

/// From the end of an axis of the sensor to its knob \[css px\].
const STEM: f64 = 20.0;

/// From a knob to the edge of the panel, at least \[css px\].
const EDGE: f64 = 12.0;

/// Share of the room towards the edge in which a length is drawn as long as it is.
const TRUE: f64 = 0.5;

/// Nearer than this \[m\], a bearing's knob would hardly move: it moves as if the landmark were so far away.
const NEAREST: f64 = 0.25;

/// A noise with a knob.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Noise {
    /// Of the wheels.
    Odometry,
    /// Of the measured range.
    Range,
    /// Of the measured bearing.
    Bearing,
}

impl Noise {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Odometry, Self::Range, Self::Bearing];

    /// The parameter that its knob sets, which is also the knob's name.
    pub fn name(self) -> &'static str {
        self.axes()[0]
    }

    /// The same as the axes of a handle.
    pub fn axes(self) -> &'static [&'static str] {
        match self {
            Self::Odometry => &["odometry"],
            Self::Range => &["range-std"],
            Self::Bearing => &["bearing-std"],
        }
    }

    /// What an arrow key changes it by, and how many decimals a drag gives it.
    pub fn step(self) -> (f64, i32) {
        match self {
            Self::Odometry => (0.05, 2),
            Self::Range => (0.005, 3),
            Self::Bearing => (0.01, 3),
        }
    }

    /// Its name beside the knob, in fewer and fewer words.
    pub fn words(self) -> [&'static str; 2] {
        match self {
            Self::Odometry => [proposal::odometry_knob(), proposal::odometry_knob_short()],
            Self::Range => [proposal::range_knob(), proposal::range_knob_short()],
            Self::Bearing => [proposal::bearing_knob(), proposal::bearing_knob_short()],
        }
    }

    /// Where that name stands, if there is room: outside of what the knob is the end of.
    pub fn places(self) -> &'static [Place] {
        match self {
            Self::Odometry => &[Place::Right(11.0), Place::Above(10.0), Place::Left(11.0)],
            Self::Range => &[Place::Right(11.0), Place::Below(10.0)],
            Self::Bearing => &[Place::Right(11.0), Place::Left(11.0), Place::Above(10.0)],
        }
    }

    /// What its knob is called where it cannot be seen, and the unit of its value.
    pub fn told(self) -> (&'static str, &'static str) {
        match self {
            Self::Odometry => (proposal::odometry_handle(), "×"),
            Self::Range => (proposal::range_handle(), "m"),
            Self::Bearing => (proposal::bearing_handle(), "rad"),
        }
    }

    /// Its value.
    pub fn value(self, setup: &ProposalsSetup) -> f64 {
        match self {
            Self::Odometry => setup.odometry_scale,
            Self::Range => setup.range_std,
            Self::Bearing => setup.bearing_std,
        }
    }

    /// Gives it another value.
    pub fn set(self, setup: &mut ProposalsSetup, value: f64) {
        let field = match self {
            Self::Odometry => &mut setup.odometry_scale,
            Self::Range => &mut setup.range_std,
            Self::Bearing => &mut setup.bearing_std,
        };
        *field = value;
    }
}

/// The line that a knob is moved along.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Track {
    /// The middle of the ellipse \[css px\].
    pub from: Point,
    /// Unit vector towards the knob.
    along: Point,
    /// How a value becomes a distance from the middle.
    scale: Scale,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Scale {
    /// `per` · value / (HALF\[0\] + HALF\[1\] · value): the panel shows more of the world as the value grows.
    Zoomed { per: f64 },
    /// STEM and `per` · value, which is drawn together towards STEM and `room`.
    Within { per: f64, room: f64 },
}

impl Track {
    /// Of a noise, in a panel.
    pub fn of(noise: Noise, found: &Proposals, setup: &ProposalsSetup, view: &Rect) -> Self {
        let plane = zoom::plane(view, setup.odometry_scale);
        if noise == Noise::Odometry {
            let (sin, cos) = ops::sin_cos(FROM.theta + CONTROL.rot1);
            let [_, drive, _] = OdometryModel { alphas: ALPHAS }.stds(&CONTROL);
            let per = NINE_TENTHS * drive * zoom::half(view);
            return Self { from: plane.at, along: [cos, -sin], scale: Scale::Zoomed { per } };
        }
        let (from, [x, y]) = (plane.position(&found.truth), sight(found));
        // To the right and up, as the arrow keys do.
        let (along, metres) = match noise {
            Noise::Bearing => ([-y, -x], found.z.x.max(NEAREST)),
            _ => ([x, -y], 1.0),
        };
        let room = (way_to_edge(from, along, view) - EDGE - STEM).max(1.0);
        Self { from, along, scale: Scale::Within { per: NINE_TENTHS * metres * plane.scale, room } }
    }

    /// Where its knob stands for a value \[css px\].
    pub fn at(&self, value: f64) -> Point {
        let distance = match self.scale {
            Scale::Zoomed { per } => per * value / (HALF[0] + HALF[1] * value),
            Scale::Within { per, room } => STEM + drawn_together(per * value, room),
        };
        [0, 1].map(|k| self.from[k] + distance * self.along[k])
    }

    /// The value of a knob that is dragged to a point \[css px\], or to the nearest on its line; infinite where no value is so far.
    pub fn value(&self, to: Point) -> f64 {
        let distance: f64 = [0, 1].map(|k| (to[k] - self.from[k]) * self.along[k]).iter().sum();
        match self.scale {
            Scale::Zoomed { per } if HALF[1] * distance >= per => f64::INFINITY,
            Scale::Zoomed { per } => HALF[0] * distance / (per - HALF[1] * distance),
            Scale::Within { per, room } => drawn_apart(distance - STEM, room) / per,
        }
    }
}

/// A length as it is drawn where there is only so much room: as it is, and beyond half of the room ever shorter.
fn drawn_together(length: f64, room: f64) -> f64 {
    let (kept, rest) = (TRUE * room, (1.0 - TRUE) * room);
    let over = length - kept;
    if over <= 0.0 { length } else { kept + rest * over / (over + rest) }
}

/// The length that is drawn so long.
fn drawn_apart(drawn: f64, room: f64) -> f64 {
    let (kept, rest) = (TRUE * room, (1.0 - TRUE) * room);
    let over = drawn - kept;
    match over {
        _ if over <= 0.0 => drawn,
        _ if over >= rest => f64::INFINITY,
        _ => kept + rest * over / (rest - over),
    }
}

/// How far it is to the edge of an area in a direction.
fn way_to_edge(from: Point, along: Point, area: &Rect) -> f64 {
    let ways = [(from[0], along[0], area.x, area.right()), (from[1], along[1], area.y, area.bottom())];
    let way = |(from, along, low, high): (f64, f64, f64, f64)| match along {
        _ if along > 0.0 => (high - from) / along,
        _ if along < 0.0 => (low - from) / along,
        _ => f64::INFINITY,
    };
    ways.map(way).into_iter().fold(f64::INFINITY, f64::min)
}

/// The direction between robot and landmark, whichever of the two points to the right.
fn sight(found: &Proposals) -> [f64; 2] {
    let mean = found.landmarks[0].mean;
    let (dx, dy) = (mean.x - found.truth.x, mean.y - found.truth.y);
    let length = ops::hypot(dx, dy);
    match length {
        _ if length < 1e-9 => [1.0, 0.0],
        _ if dx < 0.0 => [-dx / length, -dy / length],
        _ => [dx / length, dy / length],
    }
}

/// The region of drives that holds 90 %, cut at the edges.
pub fn prior(plane: &Plane, odometry_scale: f64) -> Vec<Vec<Point>> {
    let [turn, drive, _] = OdometryModel { alphas: ALPHAS }.scaled(odometry_scale).stds(&CONTROL);
    let end = |k: u32| {
        let (sin, cos) = ops::sin_cos(core::f64::consts::TAU * f64::from(k) / 96.0);
        let Odometry { rot1, trans, rot2 } = CONTROL;
        let driven = Odometry { rot1: rot1 + NINE_TENTHS * turn * sin, trans: trans + NINE_TENTHS * drive * cos, rot2 };
        plane.position(&driven.apply(&FROM))
    };
    clip_polyline(&(0..=96).map(end).collect::<Vec<_>>(), &plane.area)
}

/// The sensor's region that holds 90 %, about a pose from which the sighting is what it is, cut at the edges.
pub fn sensor(plane: &Plane, found: &Proposals, setup: &ProposalsSetup, pose: &Pose2) -> Vec<Vec<Point>> {
    let ([x, y], [along, across]) =
        (sight(found), [setup.range_std, setup.bearing_std * found.z.x].map(|std| std * std));
    let covariance = [
        [along * x * x + across * y * y, (along - across) * x * y],
        [(along - across) * x * y, along * y * y + across * x * x],
    ];
    plane.region([pose.x, pose.y], covariance, NINE_TENTHS)
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: Rect = Rect::new(356.0, 24.0, 336.0, 201.0);

    fn track(noise: Noise, setup: &ProposalsSetup) -> Track {
        Track::of(noise, &Proposals::new(&ProposalsSetup { samples: 1, ..setup.clone() }).unwrap(), setup, &VIEW)
    }

    #[test]
    fn a_value_is_read_where_its_knob_was_put_and_the_knob_is_in_the_panel() {
        for landmark in [[2.7, -0.1], [-0.1, 0.75], [0.99, 0.15], [1.0, -0.75]] {
            for (noise, values) in [
                (Noise::Odometry, [0.25, 1.0, 2.0]),
                (Noise::Range, [0.005, 0.05, 0.5]),
                (Noise::Bearing, [0.01, 0.05, 0.3]),
            ] {
                for (value, twins) in values.into_iter().flat_map(|value| [(value, false), (value, true)]) {
                    let mut setup = ProposalsSetup { landmark, twins, ..Default::default() };
                    let before = track(noise, &setup);
                    noise.set(&mut setup, value);
                    let at = track(noise, &setup).at(value);
                    assert!(VIEW.inset(6.0).contains(at), "{noise:?} {value}: {at:?}");
                    // Where it was when the knob was grasped is of no matter.
                    let read = before.value(at);
                    assert!((read / value - 1.0).abs() < 1e-9, "{noise:?} {value}: {read}, {landmark:?}");
                }
            }
        }
    }

    #[test]
    fn a_knob_moves_away_from_the_middle_as_its_noise_grows() {
        for noise in Noise::ALL {
            let track = track(noise, &ProposalsSetup::default());
            let way = |value: f64| ops::hypot(track.at(value)[0] - track.from[0], track.at(value)[1] - track.from[1]);
            assert!((1..100).all(|k| way(0.005 * f64::from(k)) < way(0.005 * f64::from(k + 1))), "{noise:?}");
        }
    }

    #[test]
    fn the_odometry_s_knob_is_on_the_prior_s_outline_and_the_sensor_s_beyond_the_ends_of_its_ellipse() {
        let setup = ProposalsSetup { landmark: [2.0, 0.6], ..Default::default() };
        let found = Proposals::new(&ProposalsSetup { samples: 1, ..setup.clone() }).unwrap();
        let plane = zoom::plane(&VIEW, 1.0);
        let outline = prior(&plane, 1.0);
        let knob = track(Noise::Odometry, &setup).at(1.0);
        assert!(ops::hypot(outline[0][0][0] - knob[0], outline[0][0][1] - knob[1]) < 1e-9);
        let ellipse = sensor(&plane, &found, &setup, &found.truth);
        for noise in [Noise::Range, Noise::Bearing] {
            let track = track(noise, &setup);
            let along = |p: &Point| (p[0] - track.from[0]) * track.along[0] + (p[1] - track.from[1]) * track.along[1];
            let end = ellipse[0].iter().map(along).fold(0.0, f64::max);
            assert!((along(&track.at(noise.value(&setup))) - end - STEM).abs() < 0.1, "{noise:?}");
        }
    }

    #[test]
    fn knobs_are_apart_where_the_figure_opens() {
        let setup = ProposalsSetup::default();
        // As small as the panels are on a phone, where fingers need 44 px.
        let view = Rect::new(0.0, 0.0, 170.0, 132.0);
        let found = Proposals::new(&ProposalsSetup { samples: 1, ..setup.clone() }).unwrap();
        let [a, b] =
            [Noise::Range, Noise::Bearing].map(|noise| Track::of(noise, &found, &setup, &view).at(noise.value(&setup)));
        assert!(ops::hypot(a[0] - b[0], a[1] - b[1]) >= 44.0, "{a:?} {b:?}");
    }
}
