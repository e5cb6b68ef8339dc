//! One proposal's samples on the posterior, as near as the motion prior lets them be, and what they are worth.

use super::{
    contour::covered,
    ghost,
    knob::{self, Noise, Track},
    layout::Panel,
    model::ProposalModel,
    zoom,
};
use crate::{
    decimal::{fixed, write},
    font::{self, Weight},
    marks::Place,
    robot::{Poses, Robots},
    scene::{
        Cells, Handle, LINE, Mark, NINE_TENTHS, Plane, Point, Rect, Role, Scene, Shading, clip_polyline, joined, plain,
        strong,
    },
    words::proposal,
};
use fastslam::geometry::Pose2;
use fastslam_lab::{
    baseline::one_step::{Area, Posterior},
    experiment::proposal::{CONTROL, Cloud, FROM, TWIN},
};

/// From a robot's centre to its nose \[css px\].
const ROBOT: f64 = 9.0;

/// A proposal, as it is named and drawn.
pub struct Drawn<'a> {
    /// Its name, and what it does in fewer and fewer words.
    pub name: &'static str,
    pub what: [&'static str; 2],
    /// What it drew.
    pub cloud: &'a Cloud,
    /// Colour of its samples.
    pub role: Role,
    /// The noises that are set in its panel.
    pub noises: Vec<Noise>,
}

/// Draws all of one proposal's part.
pub fn panel(scene: &mut Scene, model: &ProposalModel, panel: &Panel, drawn: &Drawn) {
    scene.heading_fit(&panel.header, (drawn.name, Role::Ink), &drawn.what);
    samples(scene, model, panel, drawn);
    counters(scene, model, panel, drawn.cloud);
}

/// Radius of a sample \[css px\]: the finer, the more there are, so that the density behind them is seen.
fn dot(samples: usize) -> f64 {
    (700.0 / samples as f64).sqrt().clamp(0.7, 1.8)
}

fn samples(scene: &mut Scene, model: &ProposalModel, panel: &Panel, drawn: &Drawn) {
    let (found, setup, area, role) = (model.proposals(), model.setup(), &panel.view, drawn.role);
    let plane = zoom::plane(area, setup.odometry_scale);
    scene.marks.extend(density(&found.exact, &plane));

    // What was known before the sighting, and the sighting.
    let straight = |a: Point, b: Point| clip_polyline(&[a, b], area);
    scene.lines(straight(plane.position(&FROM), plane.position(&CONTROL.apply(&FROM))), 1.25, Role::Muted);
    let landmarks: Vec<Point> = found.landmarks.iter().map(|l| plane.point([l.mean.x, l.mean.y])).collect();
    scene.dashed(straight(plane.position(&found.truth), landmarks[0]), 1.25, [2.0, 4.0], Role::Feature);
    for (landmark, at) in found.landmarks.iter().zip(&landmarks) {
        let reach = plane.region([landmark.mean.x, landmark.mean.y], landmark.covariance.into(), NINE_TENTHS);
        scene.lines(reach, 1.25, Role::Feature);
        if area.inset(7.0).contains(*at) {
            scene.filled_diamond(*at, 6.0, Role::Feature);
        }
    }

    let radius = dot(drawn.cloud.poses.len());
    ghost::panel(scene, model, usize::from(role == Role::Posterior), &plane, area, radius);
    let samples = drawn.cloud.poses.iter().map(|pose| plane.position(pose));
    scene.cloud(samples, &area.inset(radius), radius, role);

    // Where the robot is if the sighting is of A, or of B: the same sighting of another place is made from another place.
    let other = Pose2::new(found.truth.x + TWIN[0], found.truth.y + TWIN[1], found.truth.theta);
    let poses = if setup.twins { vec![found.truth, other] } else { vec![found.truth] };
    let mut noise =
        if drawn.noises.contains(&Noise::Odometry) { knob::prior(&plane, setup.odometry_scale) } else { vec![] };
    let seen = poses.iter().filter(|_| drawn.noises.contains(&Noise::Range));
    noise.extend(joined(seen, |pose| knob::sensor(&plane, found, setup, pose)));
    let region = joined(model.outline().iter(), |line| {
        clip_polyline(&line.iter().map(|place| plane.point(*place)).collect::<Vec<_>>(), area)
    });
    let gaussian = match role {
        Role::Posterior => {
            let covariance = found.gaussian.covariance.fixed_view::<2, 2>(0, 0).into_owned();
            plane.region([found.gaussian.mean.x, found.gaussian.mean.y], covariance.into(), NINE_TENTHS)
        }
        _ => Vec::new(),
    };
    // With a rim each, so that they are seen on samples too.
    for lines in [&region, &gaussian] {
        scene.lines(lines.clone(), 3.5, Role::Paper);
    }
    scene.lines(region, 1.75, Role::Ink);
    scene.dashed(gaussian, 1.75, [5.0, 3.0], role);
    scene.lines(noise, 1.25, Role::Accent);
    scene.rimmed_robot(&plane, &found.truth, ROBOT, Role::Ink);

    let around = |[x, y]: Point| Rect::new(x - 8.0, y - 8.0, 16.0, 16.0);
    let mut taken: Vec<Rect> = poses.iter().map(|pose| around(plane.position(pose))).collect();
    taken.push(scale(scene, &plane));
    let knobs = drawn.noises.iter().map(|noise| {
        let track = Track::of(*noise, found, setup, area);
        (*noise, track, track.at(noise.value(setup)))
    });
    let knobs: Vec<_> = knobs.collect();
    taken.extend(knobs.iter().map(|(_, _, at)| around(*at)));
    for (noise, track, at) in knobs {
        grip(scene, noise, &track, at, noise.value(setup));
        scene.label(&mut taken, area, at, &noise.words(), noise.places());
    }
    if setup.twins {
        for (pose, words) in poses.iter().zip([proposal::if_a(), proposal::if_b()]) {
            let places = [Place::Below(12.0), Place::Above(12.0)];
            scene.label(&mut taken, area, plane.position(pose), &[words], &places);
        }
    }
    scene.frame(*area, 1.0, Role::Frame);
}

/// What a noise is set with, and the semi-axis that it is the end of.
fn grip(scene: &mut Scene, noise: Noise, track: &Track, at: Point, value: f64) {
    if noise != Noise::Odometry {
        scene.line(&[track.from, at], 1.25, Role::Accent);
    }
    scene.disc(at, 6.0, Role::Paper);
    scene.ring(at, 5.0);
    let (title, unit) = noise.told();
    scene.handles.push(Handle {
        name: noise.name(),
        title: title.into(),
        at,
        axes: noise.axes(),
        value,
        text: format!("{} {unit}", write(value)),
        hover: None,
    });
}

/// A fifth of a metre, in the lower left corner. Returns where it is.
fn scale(scene: &mut Scene, plane: &Plane) -> Rect {
    let (x, y, length) = (plane.area.x + 8.0, plane.area.bottom() - 7.0, 0.2 * plane.scale);
    let name = Rect::new(x, y - 16.0, length.max(40.0), 14.0);
    scene.bar([x, y], length);
    scene.text(name, plain(11.0, Role::Ink), "0.2 m");
    Rect { h: 20.0, ..name }
}

/// The posterior's cells that lie wholly in the panel.
fn density(posterior: &Posterior, plane: &Plane) -> Option<Mark> {
    let (Posterior { cells, densities, .. }, area) = (posterior, &plane.area);
    let (Area { low, .. }, size) = (cells.area, cells.size());
    let (left_below, right_above) = (plane.world([area.x, area.bottom()]), plane.world([area.right(), area.y]));
    let first = [0, 1].map(|a| ((left_below[a] - low[a]) / size[a]).ceil().max(0.0) as usize);
    let end = [0, 1].map(|a| (((right_above[a] - low[a]) / size[a]).floor().max(0.0) as usize).min(cells.side));
    if first[0] >= end[0] || first[1] >= end[1] {
        return None;
    }
    let peak = densities.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let shade = |k: usize| (255.0 * densities[k] / peak).round() as u8;
    let rows = (first[1]..end[1]).rev();
    let shades = rows.flat_map(|j| (first[0]..end[0]).map(move |i| j * cells.side + i)).map(shade).collect();
    let corner = |i: usize, j: usize| plane.point([low[0] + i as f64 * size[0], low[1] + j as f64 * size[1]]);
    let ([x, bottom], [right, y]) = (corner(first[0], first[1]), corner(end[0], end[1]));
    let cells = Cells { columns: end[0] - first[0], shades };
    Some(Mark::Raster { area: Rect::new(x, y, right - x, bottom - y), cells, shading: Shading::Density })
}

fn counters(scene: &mut Scene, model: &ProposalModel, panel: &Panel, cloud: &Cloud) {
    let ess = cloud.ess();
    let few = i32::from(ess < 99.95);
    let n_eff = proposal::NEffOf { m: &model.setup().samples }.say();
    let numbers = [
        (
            format!("{} %", fixed(100.0 * cloud.share_inside(None), 1)),
            [proposal::samples_inside().to_string(), proposal::samples_inside_short().into()],
        ),
        (fixed(ess, few), [n_eff.clone(), n_eff]),
    ];
    for (area, (number, what)) in panel.counters.iter().zip(numbers) {
        let Rect { x, y, w, .. } = *area;
        // One size for all numbers, whatever they are.
        let fits = |size: &f64| font::measure("100.0 %", *size, Weight::SemiBold) <= w - 4.0;
        let size = [24.0, 20.0, 17.0].into_iter().find(fits).unwrap_or(15.0);
        let small = if w < 80.0 { 11.0 } else { 12.0 };
        scene.text(Rect::new(x, y, w, 26.0), strong(size, Role::Ink), &number);
        scene.fit(Rect::new(x, y + 26.0, w, LINE), plain(small, Role::Muted), &what);
    }
    let weights = cloud.weights.as_slice();
    let note = if model.setup().twins {
        let [a, b] = [0, 1].map(|k| fixed(100.0 * cloud.share_inside(Some(k)), 0));
        let [p, q] = [0, 1].map(|k| fixed(100.0 * model.proposals().exact.candidates[k], 0));
        [
            proposal::Inside { a: &a, b: &b, p: &p, q: &q }.say(),
            proposal::InsideShort { a: &a, b: &b, p: &p, q: &q }.say(),
            proposal::InsideTiny { a: &a, b: &b, p: &p, q: &q }.say(),
        ]
    } else if weights.iter().all(|w| w.to_bits() == weights[0].to_bits()) {
        // A share of samples says nothing of what they leave out.
        let found = model.proposals();
        let share = fixed(100.0 * covered(&found.exact, &found.gaussian), 0);
        let short = proposal::CoveredShort { share: &share }.say();
        [proposal::Covered { share: &share }.say(), short, proposal::CoveredTiny { share: &share }.say()]
    } else {
        let heaviest = weights[cloud.weights.heaviest()] * weights.len() as f64;
        let share = fixed(heaviest, 1);
        let short = proposal::LargestShort { share: &share }.say();
        [proposal::Largest { share: &share }.say(), short.clone(), short]
    };
    scene.fit(panel.note, plain(if panel.note.w < 160.0 { 11.0 } else { 12.0 }, Role::Muted), &note);
}
