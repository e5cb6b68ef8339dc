//! Pictures for files, by the painter of the figures.

use crate::in_file;
use anyhow::{Context, Result};
use fastslam::geometry::Pose2;
use fastslam::map::grid::MapImage;
use fastslam::map::landmarks::Landmark;
use fastslam::motion::Motion;
use fastslam::proposal::Proposal;
use fastslam_cli::{ColorType, write_png};
use fastslam_lab::experiment::landmarks::{LandmarkRun, WithLandmarks};
use fastslam_widgets::paint::{Canvas, Theme};
use fastslam_widgets::scene::{Point, Rect, Role, Scene, closed, ellipse, plain};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Width of a drawing \[px\].
const WIDTH: f64 = 1200.0;

/// Largest height of a drawing, for drives that go far one way only \[px\].
const HEIGHT: f64 = 2400.0;

/// √χ²₂,₀.₉₅: standard deviations to which an ellipse of 95 % reaches.
const CHI_95: f64 = 2.447_746_830_680_816;

/// Room around what is drawn \[px\].
const MARGIN: f64 = 80.0;

/// What a run ends with: truth, raw odometry, the best particle's path and its landmarks with their 95 % ellipses.
pub fn of_landmarks<D, M, P>(run: &LandmarkRun<D, M, P>) -> Canvas
where
    D: Motion + Clone,
    M: WithLandmarks,
    P: Proposal<M, Control = D::Control>,
{
    let (log, best) = (run.log(), run.best());
    let path = run.path(best);
    let place = |p: &Pose2| [p.x, p.y];
    let truth: Vec<Point> = log.truth.iter().map(place).collect();
    let odometry: Vec<Point> = log.odometry.iter().map(place).collect();
    let path: Vec<Point> = path.iter().map(place).collect();
    let landmarks: Vec<Point> = log.landmarks.iter().map(|m| [m.x, m.y]).collect();

    // Odometry drifts anywhere: it is cut where it leaves the picture.
    let shown = || truth.iter().chain(&path).chain(&landmarks);
    let extent = |axis: usize| {
        let values = || shown().map(|p| p[axis]);
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    };
    let ([x0, x1], [y0, y1]) = (extent(0), extent(1));
    let scale = ((WIDTH - 2.0 * MARGIN) / (x1 - x0).max(1e-3)).min((HEIGHT - 2.0 * MARGIN) / (y1 - y0).max(1e-3));
    let height = (scale * (y1 - y0) + 2.0 * MARGIN).round();
    let at = |[x, y]: Point| [MARGIN + (x - x0) * scale, height - MARGIN - (y - y0) * scale];
    let line = |points: &[Point]| points.iter().map(|p| at(*p)).collect::<Vec<_>>();
    let ellipses = run.particles()[best].map.landmarks().iter().map(|(_, Landmark { mean, covariance: c, .. })| {
        let pixels = [[c.m11, -c.m12], [-c.m12, c.m22]].map(|row| row.map(|x| x * scale * scale));
        closed(ellipse(at([mean.x, mean.y]), pixels, CHI_95))
    });
    let mut scene = Scene::new(WIDTH, height, String::new());
    scene.dash(&line(&odometry), 1.5, [7.0, 5.0], Role::Raw);
    scene.line(&line(&truth), 4.0, Role::Truth);
    scene.line(&line(&path), 2.0, Role::Path);
    scene.discs(line(&landmarks), 4.0, Role::Truth);
    scene.lines(ellipses.collect(), 1.5, Role::Path);
    let names = [
        (Role::Truth, "truth"),
        (Role::Path, "path and landmarks of the best particle, 95 %"),
        (Role::Raw, "raw odometry"),
    ];
    for (k, (role, name)) in names.into_iter().enumerate() {
        let y = 8.0 + 20.0 * k as f64;
        scene.line(&[[8.0, y + 10.0], [38.0, y + 10.0]], 3.0, role);
        scene.text(Rect::new(46.0, y, 400.0, 20.0), plain(14.0, Role::Ink), name);
    }
    let mut canvas = Canvas::default();
    canvas.paint(&scene, WIDTH as u32, height as u32, Theme::Light);
    canvas
}

/// Writes what was painted last as PNG.
pub fn save(canvas: &Canvas, path: &Path) -> Result<()> {
    write_png(path, canvas.size(), ColorType::Rgba, |file| file.write_all(canvas.pixels()))
}

/// Rows of a map that are drawn at a time.
pub const ROWS: u32 = 256;

/// Writes a map, of which the whole has no greys yet, as PGM, and with the path on it as PNG, one pixel a cell; where a loop stays open there is a ring of a
/// metre.
pub fn save_map(
    whole: &MapImage,
    strips: impl Iterator<Item = MapImage>,
    path: &[(f64, Pose2)],
    open: &[Pose2],
    [pgm, png]: [&Path; 2],
) -> Result<()> {
    let mut grey = BufWriter::new(File::create(pgm).with_context(in_file(pgm))?);
    let mut written = grey.write_all(&whole.pgm());
    write_png(png, [whole.width, whole.height], ColorType::Rgb, |file| {
        for strip in strips {
            file.write_all(&coloured(&strip, path, open))?;
            if written.is_ok() {
                written = grey.write_all(&strip.grey);
            }
        }
        Ok(())
    })?;
    written.and_then(|()| grey.flush()).with_context(in_file(pgm))
}

/// Red, green and blue of a part of a map with what is drawn on it.
fn coloured(map: &MapImage, path: &[(f64, Pose2)], open: &[Pose2]) -> Vec<u8> {
    /// Red, green, blue of the path, and of what is open.
    const PATH: [u8; 3] = [190, 60, 30];
    const OPEN: [u8; 3] = [220, 0, 160];
    /// Radius of a ring, and how wide it is drawn \[m\].
    const RING: [f64; 2] = [1.0, 0.15];
    let [width, height] = [map.width, map.height].map(|side| side as usize);
    let mut pixels: Vec<u8> = map.grey.iter().flat_map(|grey| [*grey; 3]).collect();
    let at = |pose: &Pose2| {
        let [x, y] = [pose.x - map.origin[0], pose.y - map.origin[1]].map(|metres| metres / map.cell_size);
        [x, height as f64 - y]
    };
    let mut paint = |[x, y]: [f64; 2], colour: [u8; 3]| {
        if (0.0..width as f64).contains(&x) && (0.0..height as f64).contains(&y) {
            let first = 3 * (y as usize * width + x as usize);
            pixels[first..first + 3].copy_from_slice(&colour);
        }
    };
    for leg in path.windows(2) {
        let (a, b) = (at(&leg[0].1), at(&leg[1].1));
        let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs()).ceil().max(1.0);
        for k in 0..=(steps as u32).min(10_000) {
            let share = f64::from(k) / steps;
            paint([0, 1].map(|k: usize| a[k] + share * (b[k] - a[k])), PATH);
        }
    }
    let [inner, outer] = [RING[0] - RING[1], RING[0]].map(|metres| metres / map.cell_size);
    let reach = outer.ceil() as i32;
    for centre in open.iter().map(at) {
        for (dx, dy) in (-reach..=reach).flat_map(|dy| (-reach..=reach).map(move |dx| (f64::from(dx), f64::from(dy)))) {
            if (inner..=outer).contains(&fastslam::ops::hypot(dx, dy)) {
                paint([centre[0] + dx, centre[1] + dy], OPEN);
            }
        }
    }
    pixels
}
