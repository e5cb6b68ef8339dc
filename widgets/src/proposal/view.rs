//! What is to be seen of the step: both clouds on the posterior, what they are worth, and the scale of ratios.

use super::{
    gauge,
    layout::{AWARE, Layout, MOTION, NARROWEST, Panel, RATIO},
    model::ProposalModel,
    recipe::Recipe,
};
use crate::decimal::{fixed, rounded, write};
use crate::{
    font::{self, Weight},
    model::Declared,
    panels::Panels,
    scene::{
        Anchor, Cells, Handle, LINE, Mark, NINE_TENTHS, Plane, Point, Rect, Role, Sample, Scene, Shading, bar,
        clip_polyline, closed, cloud, diamond, ellipse, heading, legend, rimmed_robot, text,
    },
    view::View,
    words::proposal,
};
use fastslam::geometry::Pose2;
use fastslam_lab::{
    baseline::one_step::{Area, Posterior},
    experiment::proposals::{CONTROL, Cloud, FROM, TWIN},
};

/// What an arrow key moves the landmark by \[m\].
const STEP: f64 = 0.05;

/// The landmark, in the panel of the motion prior and in the other.
pub const LANDMARK: &str = "landmark";
pub const LANDMARK_AGAIN: &str = "landmark-again";
/// The guess on the scale of ratios.
pub const GUESS: &str = "guess";

/// From a robot's centre to its nose \[css px\].
const ROBOT: f64 = 9.0;

/// Radius of a sample \[css px\]: the finer, the more there are, so that the density behind them is seen.
fn dot(samples: usize) -> f64 {
    (700.0 / samples as f64).sqrt().clamp(0.7, 1.8)
}

/// Figure w17.3, as it is seen.
#[derive(Default)]
pub struct ProposalView;

impl View for ProposalView {
    type Model = ProposalModel;
    type Layout = Layout;
    const NARROWEST: f64 = NARROWEST;
    const PANELS: &'static [&'static str] = &[MOTION, AWARE, RATIO];

    fn layout(width: f64, panels: &Panels) -> Layout {
        Layout::of(width, panels)
    }

    fn draw(&self, model: &ProposalModel, layout: &Layout, scene: &mut Scene) {
        let found = model.proposals();
        let shown = |name: &str| layout.shown.has(name);
        let proposals = [
            (MOTION, "FastSLAM 1.0", proposal::motion_prior(), &found.motion, Role::Prior),
            (AWARE, "FastSLAM 2.0", proposal::aware(), &found.aware, Role::Posterior),
        ];
        for (panel, (key, name, what, cloud, role)) in layout.panels.iter().zip(proposals) {
            if shown(key) {
                heading(scene, &panel.header, (name, Role::Ink), what);
                panel_view(scene, model, panel, cloud, role);
                counters(scene, model, panel, cloud);
            }
        }
        let [x, y] = model.setup().landmark;
        for (panel, (key, name)) in layout.panels.iter().zip([(MOTION, LANDMARK), (AWARE, LANDMARK_AGAIN)]) {
            if shown(key) {
                scene.handles.push(Handle {
                    name,
                    title: if name == LANDMARK || !shown(MOTION) {
                        proposal::landmark_handle().into()
                    } else {
                        proposal::landmark_again().into()
                    },
                    at: panel.plane().point([x, y]),
                    axes: &["landmark-x", "landmark-y"],
                    value: x,
                    text: proposal::Place { x: &write(x), y: &write(y) }.say(),
                    hover: None,
                });
            }
        }
        if shown(RATIO) {
            ratio(scene, model, layout);
        }
        if layout.legend.h > 0.0 {
            names(scene, model, layout);
        }
    }

    fn drag(&self, model: &mut ProposalModel, layout: &Layout, handle: &str, to: Point) {
        match handle {
            LANDMARK | LANDMARK_AGAIN => {
                let place = layout.panels[usize::from(handle == LANDMARK_AGAIN)].plane().world(to);
                model.put_landmark(place.map(|c| rounded(c, 2)));
            }
            GUESS => model.guess_at(rounded(gauge::ratio(&layout.axis, to[0]), 1)),
            _ => (),
        }
    }

    fn nudge(&self, model: &mut ProposalModel, handle: &str, [right, up]: [f64; 2]) {
        let Recipe { setup, guess, .. } = model.recipe();
        let ([x, y], guess) = (setup.landmark, *guess);
        match handle {
            LANDMARK | LANDMARK_AGAIN => {
                model.put_landmark([x + STEP * right, y + STEP * up].map(|c| rounded(c, 3)));
            }
            GUESS => model.guess_at(rounded(guess + 0.1 * (right + up), 2)),
            _ => (),
        }
    }
}

fn panel_view(scene: &mut Scene, model: &ProposalModel, panel: &Panel, drawn: &Cloud, role: Role) {
    let (found, plane, area) = (model.proposals(), panel.plane(), &panel.view);
    scene.marks.extend(density(&found.exact, &plane));

    // What was known before the sighting, and the sighting.
    let landmarks: Vec<Point> = found.landmarks.iter().map(|l| plane.point([l.mean.x, l.mean.y])).collect();
    let line = |a: Point, b: Point| clip_polyline(&[a, b], area);
    let odometry = CONTROL.apply(&FROM);
    let drive = line(plane.position(&FROM), plane.position(&odometry));
    scene.marks.push(Mark::Lines { lines: drive, width: 1.25, dash: None, role: Role::Muted });
    let sight = line(plane.position(&found.truth), landmarks[0]);
    scene.marks.push(Mark::Lines { lines: sight, width: 1.25, dash: Some([2.0, 4.0]), role: Role::Landmark });

    let radius = dot(drawn.poses.len());
    let samples = drawn.poses.iter().map(|pose| plane.position(pose));
    scene.marks.push(cloud(samples, &area.inset(radius), radius, role));
    let outline = model.outline().iter();
    let region: Vec<_> = outline
        .flat_map(|line| clip_polyline(&line.iter().map(|place| plane.point(*place)).collect::<Vec<_>>(), area))
        .collect();
    let gaussian = match role {
        Role::Posterior => {
            let covariance = found.gaussian.covariance.fixed_view::<2, 2>(0, 0).into_owned();
            plane.region([found.gaussian.mean.x, found.gaussian.mean.y], covariance.into(), NINE_TENTHS)
        }
        _ => Vec::new(),
    };
    // With a rim each, so that they are seen on samples too.
    for lines in [&region, &gaussian] {
        scene.marks.push(Mark::Lines { lines: lines.clone(), width: 3.5, dash: None, role: Role::Paper });
    }
    scene.marks.push(Mark::Lines { lines: region, width: 1.75, dash: None, role: Role::Ink });
    scene.marks.push(Mark::Lines { lines: gaussian, width: 1.75, dash: Some([5.0, 3.0]), role });
    for (k, (landmark, at)) in found.landmarks.iter().zip(&landmarks).enumerate() {
        let reach = plane.region([landmark.mean.x, landmark.mean.y], landmark.covariance.into(), NINE_TENTHS);
        scene.marks.push(Mark::Lines { lines: reach, width: 1.25, dash: None, role: Role::Landmark });
        if area.inset(8.0).contains(*at) {
            if k == 0 {
                scene.marks.push(ring(*at, 10.0));
            }
            scene.marks.push(filled_diamond(*at, 6.0, Role::Landmark));
        }
    }
    rimmed_robot(scene, &plane, &FROM, ROBOT, Role::Muted);
    rimmed_robot(scene, &plane, &found.truth, ROBOT, Role::Ink);
    if let [[ax, ay], [bx, by]] = landmarks[..] {
        // Where the robot is if the sighting is of A, or of B: the same sighting of another place is made from another place.
        let other = Pose2::new(found.truth.x + TWIN[0], found.truth.y + TWIN[1], found.truth.theta);
        let below = |pose: &Pose2| plane.point([pose.x, pose.y - 0.42]);
        for (label, [x, y]) in [
            ("A", [ax, ay - 19.0]),
            ("B", [bx, by - 19.0]),
            (proposal::if_a(), below(&found.truth)),
            (proposal::if_b(), below(&other)),
        ] {
            let half = 0.5 * font::measure(label, 12.0, Weight::SemiBold) + 2.0;
            let plate = Rect::new(x - half, y - 7.0, 2.0 * half, 14.0);
            if area.inset(2.0).encloses(&plate) {
                scene.marks.push(Mark::Fill { area: plate, role: Role::Paper });
                scene.marks.push(text(plate, Anchor::Middle, 12.0, Weight::SemiBold, Role::Ink, label));
            }
        }
    }
    // Half a metre, in the lower left corner.
    let (x, y, length) = (area.x + 10.0, area.bottom() - 8.0, 0.5 * plane.scale);
    scene.marks.push(bar([x, y], length));
    let name = Rect::new(x, y - 14.0, length, 12.0);
    scene.marks.push(text(name, Anchor::Middle, 9.5, Weight::Regular, Role::Ink, "0.5 m"));
    scene.marks.push(Mark::Frame { area: *area, width: 1.0, role: Role::Frame });
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

fn filled_diamond(at: Point, r: f64, role: Role) -> Mark {
    Mark::Polygons { polygons: vec![diamond(at, r)], role }
}

/// Around what can be moved.
fn ring(centre: Point, radius: f64) -> Mark {
    let circle = closed(ellipse(centre, [[1.0, 0.0], [0.0, 1.0]], radius));
    Mark::Lines { lines: vec![circle], width: 2.0, dash: None, role: Role::Accent }
}

fn counters(scene: &mut Scene, model: &ProposalModel, panel: &Panel, cloud: &Cloud) {
    let ess = cloud.ess();
    let few = i32::from(ess < 99.95);
    let numbers = [
        (format!("{} %", fixed(100.0 * cloud.share_inside(None), 1)), proposal::samples_inside().to_string()),
        (fixed(ess, few), proposal::NEffOf { m: &model.setup().samples }.say()),
    ];
    for (area, (number, what)) in panel.counters.iter().zip(numbers) {
        let Rect { x, y, w, .. } = *area;
        scene.marks.push(text(Rect::new(x, y, w, 28.0), Anchor::Start, 24.0, Weight::SemiBold, Role::Ink, number));
        scene.marks.push(text(
            Rect::new(x, y + 28.0, w, LINE),
            Anchor::Start,
            12.0,
            Weight::Regular,
            Role::Muted,
            what,
        ));
    }
    let weights = cloud.weights.as_slice();
    let note = if model.setup().twins {
        let [a, b] = [0, 1].map(|k| fixed(100.0 * cloud.share_inside(Some(k)), 0));
        let [p, q] = [0, 1].map(|k| fixed(100.0 * model.proposals().exact.candidates[k], 0));
        [
            proposal::Inside { a: &a, b: &b, p: &p, q: &q }.say(),
            proposal::InsideShort { a: &a, b: &b, p: &p, q: &q }.say(),
        ]
    } else if weights.iter().all(|w| w.to_bits() == weights[0].to_bits()) {
        [proposal::exactly_equal().into(), proposal::equal().into()]
    } else {
        let heaviest = weights[cloud.weights.heaviest()] * weights.len() as f64;
        let share = fixed(heaviest, 1);
        [proposal::Largest { share: &share }.say(), proposal::LargestShort { share: &share }.say()]
    };
    line(scene, &panel.note, 12.0, Weight::Regular, Role::Muted, note);
}

/// The first of two wordings if it fits, else the second.
fn line(scene: &mut Scene, area: &Rect, size: f64, weight: Weight, role: Role, [long, short]: [String; 2]) {
    let words = if font::measure(&long, size, weight) <= area.w { long } else { short };
    scene.marks.push(text(*area, Anchor::Start, size, weight, role, words));
}

/// The ratio in words and on a scale, with the reader's guess.
fn ratio(scene: &mut Scene, model: &ProposalModel, layout: &Layout) {
    let (now, [words, question], axis) = (model.proposals().ratio(), layout.ratio, layout.axis);
    let times = fixed(now, 1);
    let wordings = match model.lost().map(|lost| ["A", "B"][lost]) {
        Some(lost) => [
            proposal::RatioLost { times: &times, lost: &lost }.say(),
            proposal::RatioLostShort { times: &times, lost: &lost }.say(),
        ],
        None => [proposal::RatioIs { times: &times }.say(), proposal::RatioShort { times: &times }.say()],
    };
    line(scene, &words, 14.0, Weight::SemiBold, Role::Ink, wordings);

    let half = model.half();
    let asked = match (model.guess(), model.at_half()) {
        (None, _) => [proposal::and_half().to_string(), proposal::and_half_short().into()],
        (Some(guess), None) => {
            let guess = &write(guess);
            [proposal::YourGuess { half: &half, guess }.say(), proposal::YourGuessShort { half: &half, guess }.say()]
        }
        (Some(guess), Some(ratio)) => {
            let (ratio, guess) = (&fixed(ratio, 1), &write(guess));
            [
                proposal::YouGuessed { half: &half, ratio, guess }.say(),
                proposal::YouGuessedShort { half: &half, ratio, guess }.say(),
            ]
        }
    };
    line(scene, &question, 13.0, Weight::Regular, Role::Ink, asked);

    // The scale, with a tick and a name at every round ratio.
    let y = axis.y + 24.0;
    let at = |ratio: f64| gauge::position(&axis, ratio);
    let ticks = gauge::TICKS.iter().map(|&tick| vec![[at(tick), y], [at(tick), y + 5.0]]);
    let lines = ticks.chain([vec![[axis.x, y], [axis.right(), y]]]).collect();
    scene.marks.push(Mark::Lines { lines, width: 1.0, dash: None, role: Role::Muted });
    for tick in gauge::TICKS {
        let name = Rect::new(at(tick) - 15.0, y + 6.0, 30.0, 13.0);
        scene.marks.push(text(name, Anchor::Middle, 10.5, Weight::Regular, Role::Muted, format!("{}×", write(tick))));
    }
    if let (Some(guess), Some(ratio)) = (model.guess(), model.at_half()) {
        let between = vec![[at(guess), y - 9.0], [at(ratio), y - 9.0]];
        scene.marks.push(Mark::Lines { lines: vec![between], width: 2.0, dash: Some([3.0, 3.0]), role: Role::Accent });
        scene.marks.push(filled_diamond([at(ratio), y - 9.0], 7.0, Role::Ink));
    }
    scene.marks.push(Mark::Discs { centres: vec![[at(now), y]], radius: 5.0, role: Role::Ink });
    if let Some(guess) = model.guess() {
        scene.marks.push(pointer([at(guess), y - 2.0], 8.0));
        scene.handles.push(Handle {
            name: GUESS,
            title: proposal::guess_handle().into(),
            at: [at(guess), y - 9.0],
            axes: &[GUESS],
            value: guess,
            text: proposal::TimesOf { n: &write(guess) }.say(),
            hover: None,
        });
    }
}

/// A triangle that points down at its place.
fn pointer([x, y]: Point, r: f64) -> Mark {
    Mark::Polygons { polygons: vec![vec![[x, y], [x - r, y - 1.7 * r], [x + r, y - 1.7 * r]]], role: Role::Accent }
}

fn names(scene: &mut Scene, model: &ProposalModel, layout: &Layout) {
    let line = |role, dash| Sample::line(role, 1.75, dash);
    let density = |place: &Rect| {
        let cells = Cells { columns: 3, shades: vec![90, 255, 90] };
        vec![Mark::Raster { area: *place, cells, shading: Shading::Density }]
    };
    let samples = |place: &Rect| {
        let [x, y] = place.centre();
        let dot = |(dx, role)| Mark::Discs { centres: vec![[x + dx, y]], radius: 1.8, role };
        [(-4.0, Role::Prior), (4.0, Role::Posterior)].map(dot).into()
    };
    let landmark = |place: &Rect| vec![ring(place.centre(), 7.0), filled_diamond(place.centre(), 4.0, Role::Landmark)];
    let [aware, ratio] = [AWARE, RATIO].map(|name| layout.shown.has(name));
    let mut items =
        vec![(Sample::new(density), proposal::posterior()), (line(Role::Ink, None), proposal::its_region())];
    if aware {
        items.push((line(Role::Posterior, Some([5.0, 3.0])), proposal::gaussian()));
    }
    items.extend([
        (Sample::new(samples), proposal::samples_drawn()),
        (Sample::new(landmark), proposal::landmark()),
        (Sample::robot(Role::Muted), proposal::robot_before()),
        (Sample::robot(Role::Ink), proposal::robot_after()),
    ]);
    if ratio {
        items.push((Sample::dot(Role::Ink, 4.5), proposal::ratio_mark()));
    }
    if ratio && model.guess().is_some() {
        items.push((Sample::at(|[x, y]| pointer([x, y + 6.0], 6.0)), proposal::guess_mark()));
    }
    if ratio && model.at_half().is_some() {
        items.push((Sample::at(|at| filled_diamond(at, 5.5, Role::Ink)), proposal::at_half()));
    }
    legend(scene, &layout.legend, items);
}
