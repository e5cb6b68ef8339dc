//! The score surface of a scan: flat over a fresh map, and a hill as soon as there are walls to fit. The hill is what the proposal of grids
//! looks at, at thirteen points, if it is clearly higher than the average.

use super::{Kind, cells, label};
use crate::{
    decimal::fixed,
    robot::{Poses, robot},
    scene::{Anchor, Cells, LINE, Plane, RIM, Rect, Role, Scene, Shading},
    words::vignette::{self, SurfaceTold},
};
use fastslam::{
    geometry::{Gaussian3, Pose2},
    map::grid::Grid,
    matching::Matcher,
    nalgebra::{Matrix3, Vector3},
    ops,
    sensor::Scan,
};
use fastslam_lab::experiment::{close_up, lap::FROM_SCAN};

/// Where the robot truly is, in the apartment's corridor \[m\], and where its odometry leads.
const PLACE: [f64; 2] = [4.7, 4.65];
const ODOMETRY: [f64; 2] = [4.58, 4.56];

/// Standard deviations of the motion \[m, m, rad\].
const MOTION_STDS: [f64; 3] = [0.12, 0.12, 0.04];

const BEAMS: u32 = 36;

/// Half of the surface's height \[m\], and how many poses and cells of the map there are from top to bottom.
const HALF: f64 = 0.25;
const ROWS: usize = 36;
const CELLS: i32 = 13;

/// What fills the bar \[nats\].
const MOST: f64 = 6.0;

pub const KIND: Kind = Kind {
    name: "surface",
    handle: vignette::surface_handle,
    last: BEAMS,
    value: |beams| (beams.to_string(), ""),
    number: vignette::surface_number,
    result: |beams| {
        let gain = Search::of(beams).gain;
        (gain, fixed(gain, 2), "nats")
    },
    told,
    draw,
};

fn motion() -> Gaussian3 {
    let [x, y] = ODOMETRY;
    let covariance = Matrix3::from_diagonal(&Vector3::from(MOTION_STDS.map(|std| std * std)));
    Gaussian3::new(Pose2::new(x, y, 0.0), covariance).expect("its diagonal is positive")
}

/// What the proposal finds, where the map has so many beams of an earlier scan.
struct Search {
    map: Grid,
    mode: Pose2,
    /// How much better the scan fits at the mode than on average over the search \[nats\].
    gain: f64,
    /// The thirteen poses that the fit looks at; none where the mode is not trusted.
    points: Vec<Pose2>,
}

impl Search {
    fn of(beams: u32) -> Self {
        let mut map = close_up::map();
        close_up::see(&mut map, &Pose2::new(PLACE[0], PLACE[1], 0.0), &seen(beams));
        let motion = motion();
        let found = close_up::find(&motion, &map, &seen(BEAMS));
        let top = found.tops[0];
        let gain = top.value - motion.log_density(&top.pose) - found.log_mean;
        let points = found.hills.first().map_or_else(Vec::new, |(_, fit)| fit.points.to_vec());
        Self { map, mode: top.pose, gain, points }
    }

    fn is_trusted(&self) -> bool {
        !self.points.is_empty()
    }

    /// Likelihood times motion about the odometry's pose, as shares of the highest, row by row from the top.
    fn shares(&self, columns: usize) -> Vec<f64> {
        let at = |k: usize, count: usize| 2.0 * HALF * (k as f64 + 0.5 - 0.5 * count as f64) / ROWS as f64;
        let pose = |k| {
            let [x, y] = [at(k % columns, columns), -at(k / columns, ROWS)];
            Pose2::new(ODOMETRY[0] + x, ODOMETRY[1] + y, self.mode.theta)
        };
        let (motion, poses) = (motion(), (0..ROWS * columns).map(pose).collect::<Vec<_>>());
        let mut values = close_up::scores(Matcher::SubCell, &self.map, &seen(BEAMS), &poses);
        values.iter_mut().zip(&poses).for_each(|(value, pose)| *value += motion.log_density(pose));
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        values.iter().map(|value| ops::exp(value - most)).collect()
    }
}

/// So many beams of a scan.
fn seen(beams: u32) -> Scan {
    close_up::scan(PLACE, BEAMS as usize, beams as usize)
}

fn told(beams: u32) -> String {
    let found = Search::of(beams);
    let [gain, least] = [found.gain, FROM_SCAN.minimum_improvement].map(|nats| fixed(nats, 2));
    let what = if found.is_trusted() { vignette::surface_fits() } else { vignette::surface_moves() };
    SurfaceTold { gain: &gain, least: &least, what: &what }.say()
}

/// The map so far with the robot in it; the surface with mode and points; and how far the mode is above the average, against the gate.
fn draw(beams: u32, whole: &Rect, scene: &mut Scene) {
    let area = &Rect { y: whole.y + LINE, h: whole.h - LINE, ..*whole };
    let w = 0.5 * (area.w - 100.0);
    let side = area.h / ROWS as f64;
    let columns = (w / side) as usize;
    let found = Search::of(beams);
    let mark = if found.is_trusted() { Role::Accent } else { Role::Extinct };

    let pitch = area.h / f64::from(CELLS);
    let wide = (w / pitch) as i32;
    let [i, j] = PLACE.map(|x| (x / found.map.cell_size()) as i32);
    let place = Rect::new(area.x, area.y, f64::from(wide) * pitch, area.h);
    cells(scene, place, &found.map, [i - wide / 2, j - CELLS / 2], [wide, CELLS]);
    let middle = [place.x + (f64::from(wide / 2) + 0.5) * pitch, place.centre()[1]];
    scene.rimmed_polygon(robot(middle, 0.0, 9.0), Role::Path);

    let area_of = Rect::new(place.right() + 10.0, area.y, columns as f64 * side, area.h);
    let plane = Plane::centred(area_of, ODOMETRY, 0.5 * area.h / HALF);
    let shades = found.shares(columns).iter().map(|share| (255.0 * share).round() as u8).collect();
    scene.raster(area_of, Cells { columns, shades }, Shading::Correlation);
    scene.frame(area_of, 1.0, Role::Frame);
    for (radius, role) in [(3.5, Role::Paper), (2.5, mark)] {
        scene.cloud(found.points.iter().map(|point| plane.position(point)), &area_of, radius, role);
    }
    let mode = Rect::around(plane.position(&found.mode), 5.0);
    scene.cross(mode, 2.0 + 2.0 * RIM, Role::Paper);
    scene.cross(mode, 2.0, mark);

    for (part, name) in [(place, vignette::surface_map()), (area_of, vignette::surface_fit())] {
        label(scene, Rect { y: whole.y, h: LINE, ..part }, Anchor::Start, Role::Muted, name);
    }

    let bar = Rect::new(area_of.right() + 12.0, area.y, 16.0, area.h);
    let high = |nats: f64| bar.h * (nats / MOST).clamp(0.0, 1.0);
    let gain = high(found.gain);
    scene.fill(Rect::new(bar.x, bar.bottom() - gain, bar.w, gain), mark);
    scene.frame(bar, 1.0, Role::Muted);
    let gate = bar.bottom() - high(FROM_SCAN.minimum_improvement);
    scene.rimmed(vec![vec![[bar.x - 4.0, gate], [bar.right() + 4.0, gate]]], 2.0, None, Role::Ink);
    let beside = Rect::new(bar.right() + 7.0, gate - LINE / 2.0, area.right() - bar.right() - 7.0, LINE);
    label(scene, beside, Anchor::Start, Role::Ink, vignette::surface_guard());
}
