//! What is to be seen of the step: both clouds on the posterior, what they are worth, and the scale of ratios.

use super::{
    gauge,
    layout::{LINE, Layout, NARROWEST, Panel},
    model::ProposalModel,
};
use crate::decimal::{fixed, write};
use crate::{
    font::{self, Weight},
    model::Model,
    scene::{
        Anchor, Cells, Handle, Mark, Point, Rect, Role, Scene, Shading, Text, clip_polyline, closed, ellipse, heading,
        text,
    },
};
use fastslam::geometry::Pose2;
use fastslam_lab::{
    baseline::one_step::{Area, Posterior},
    experiment::proposals::{CONTROL, Cloud, FROM, TWIN},
};

/// The landmark, in the panel of the motion prior and in the other.
pub const LANDMARK: &str = "landmark";
pub const LANDMARK_AGAIN: &str = "landmark-again";
/// The guess on the scale of ratios.
pub const GUESS: &str = "guess";

/// Radius of a sample \[css px\]: the finer, the more there are, so that the density behind them is seen.
fn dot(samples: usize) -> f64 {
    (700.0 / samples as f64).sqrt().clamp(0.7, 1.8)
}

/// √χ²₂,₀.₉: how many deviations an ellipse of 90 % reaches.
const NINE_TENTHS: f64 = 2.145_966_026_289_347;

/// The whole figure at this size \[css px\].
pub fn build(model: &ProposalModel, width: f64, height: f64) -> Scene {
    let layout = Layout::new(width);
    let mut scene = Scene::new(width.max(NARROWEST), height.max(layout.height), model.describe());
    let found = model.proposals();
    let proposals = [
        ("FastSLAM 1.0", "motion prior, then weigh", &found.motion, Role::Prior),
        ("FastSLAM 2.0", "measurement-aware", &found.aware, Role::Posterior),
    ];
    for (panel, (name, what, cloud, role)) in layout.panels.iter().zip(proposals) {
        heading(&mut scene, &panel.header, (name, Role::Ink), what);
        view(&mut scene, model, panel, cloud, role);
        counters(&mut scene, model, panel, cloud);
    }
    let [x, y] = model.setup().landmark;
    for (panel, name) in layout.panels.iter().zip([LANDMARK, LANDMARK_AGAIN]) {
        scene.handles.push(Handle {
            name,
            title: if name == LANDMARK { "Landmark".into() } else { "Landmark, second panel".into() },
            at: panel.at([x, y]),
            value: x,
            text: format!("{} m ahead of the start, {} m to the left", write(x), write(y)),
            hover: None,
        });
    }
    ratio(&mut scene, model, &layout);
    legend(&mut scene, model, &layout.legend);
    scene
}

fn view(scene: &mut Scene, model: &ProposalModel, panel: &Panel, cloud: &Cloud, role: Role) {
    let (found, area) = (model.proposals(), &panel.view);
    scene.marks.extend(density(&found.exact, panel));

    // What was known before the sighting, and the sighting.
    let robot_at = |pose: &Pose2| panel.at([pose.x, pose.y]);
    let landmarks: Vec<Point> = found.landmarks.iter().map(|l| panel.at([l.mean.x, l.mean.y])).collect();
    let line = |a: Point, b: Point| clip_polyline(&[a, b], area);
    let odometry = CONTROL.apply(&FROM);
    let drive = line(robot_at(&FROM), robot_at(&odometry));
    scene.marks.push(Mark::Lines { lines: drive, width: 1.25, dash: None, role: Role::Muted });
    let sight = line(robot_at(&found.truth), landmarks[0]);
    scene.marks.push(Mark::Lines { lines: sight, width: 1.25, dash: Some([2.0, 4.0]), role: Role::Landmark });

    let radius = dot(cloud.poses.len());
    let centres = cloud.poses.iter().map(robot_at).filter(|place| area.inset(radius).contains(*place)).collect();
    scene.marks.push(Mark::Discs { centres, radius, role });
    let outline = model.outline().iter();
    let region: Vec<_> = outline
        .flat_map(|line| clip_polyline(&line.iter().map(|place| panel.at(*place)).collect::<Vec<_>>(), area))
        .collect();
    let gaussian = match role {
        Role::Posterior => {
            let covariance = found.gaussian.covariance.fixed_view::<2, 2>(0, 0).into_owned();
            oval(panel, [found.gaussian.mean.x, found.gaussian.mean.y], &covariance.into())
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
        let reach = oval(panel, [landmark.mean.x, landmark.mean.y], &landmark.covariance.into());
        scene.marks.push(Mark::Lines { lines: reach, width: 1.25, dash: None, role: Role::Landmark });
        if area.inset(8.0).contains(*at) {
            if k == 0 {
                scene.marks.push(ring(*at, 10.0));
            }
            scene.marks.push(diamond(*at, 6.0, Role::Landmark));
        }
    }
    robot(scene, panel, &FROM, Role::Muted);
    robot(scene, panel, &found.truth, Role::Ink);
    if let [[ax, ay], [bx, by]] = landmarks[..] {
        // Where the robot is if the sighting is of A, or of B: the same sighting of another place is made from another place.
        let other = Pose2::new(found.truth.x + TWIN[0], found.truth.y + TWIN[1], found.truth.theta);
        let below = |pose: &Pose2| panel.at([pose.x, pose.y - 0.42]);
        for (label, [x, y]) in
            [("A", [ax, ay - 19.0]), ("B", [bx, by - 19.0]), ("if A", below(&found.truth)), ("if B", below(&other))]
        {
            let half = 0.5 * font::measure(label, 12.0, Weight::SemiBold) + 2.0;
            let plate = Rect::new(x - half, y - 7.0, 2.0 * half, 14.0);
            if area.inset(2.0).encloses(&plate) {
                scene.marks.push(Mark::Fill { area: plate, role: Role::Paper });
                scene.marks.push(text(plate, Anchor::Middle, 12.0, Weight::SemiBold, Role::Ink, label));
            }
        }
    }
    scale_bar(scene, panel);
    scene.marks.push(Mark::Frame { area: *area, width: 1.0, role: Role::Frame });
}

/// The posterior's cells that lie wholly in the panel.
fn density(posterior: &Posterior, panel: &Panel) -> Option<Mark> {
    let Posterior { cells, densities, .. } = posterior;
    let (Area { low, .. }, size) = (cells.area, cells.size());
    let (left_below, right_above) =
        (panel.place([panel.view.x, panel.view.bottom()]), panel.place([panel.view.right(), panel.view.y]));
    let first = [0, 1].map(|a| ((left_below[a] - low[a]) / size[a]).ceil().max(0.0) as usize);
    let end = [0, 1].map(|a| (((right_above[a] - low[a]) / size[a]).floor().max(0.0) as usize).min(cells.side));
    if first[0] >= end[0] || first[1] >= end[1] {
        return None;
    }
    let peak = densities.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let shade = |k: usize| (255.0 * densities[k] / peak).round() as u8;
    let rows = (first[1]..end[1]).rev();
    let shades = rows.flat_map(|j| (first[0]..end[0]).map(move |i| j * cells.side + i)).map(shade).collect();
    let corner = |i: usize, j: usize| panel.at([low[0] + i as f64 * size[0], low[1] + j as f64 * size[1]]);
    let ([x, bottom], [right, y]) = (corner(first[0], first[1]), corner(end[0], end[1]));
    let cells = Cells { columns: end[0] - first[0], shades };
    Some(Mark::Raster { area: Rect::new(x, y, right - x, bottom - y), cells, shading: Shading::Density })
}

/// The ellipse that holds 90 % of a Gaussian of the world, cut at the panel's edge.
fn oval(panel: &Panel, mean: [f64; 2], covariance: &[[f64; 2]; 2]) -> Vec<Vec<Point>> {
    let [[xx, xy], [_, yy]] = *covariance;
    let square = panel.scale() * panel.scale();
    let [xx, xy, yy] = [xx * square, -xy * square, yy * square];
    clip_polyline(&closed(ellipse(panel.at(mean), [[xx, xy], [xy, yy]], NINE_TENTHS)), &panel.view)
}

/// A triangle that points where the robot looks.
fn robot(scene: &mut Scene, panel: &Panel, pose: &Pose2, role: Role) {
    let length = 9.0 / panel.scale();
    let corners = [[1.0, 0.0], [-0.6, 0.6], [-0.6, -0.6]].map(|c| panel.at(pose.transform(c.map(|x| x * length))));
    if corners.iter().all(|corner| panel.view.contains(*corner)) {
        let rim = Mark::Lines { lines: vec![closed(corners.to_vec())], width: 2.5, dash: None, role: Role::Paper };
        scene.marks.extend([rim, Mark::Polygons { polygons: vec![corners.to_vec()], role }]);
    }
}

fn diamond([x, y]: Point, r: f64, role: Role) -> Mark {
    Mark::Polygons { polygons: vec![vec![[x, y - r], [x + r, y], [x, y + r], [x - r, y]]], role }
}

/// Around what can be moved.
fn ring(centre: Point, radius: f64) -> Mark {
    let circle = closed(ellipse(centre, [[1.0, 0.0], [0.0, 1.0]], radius));
    Mark::Lines { lines: vec![circle], width: 2.0, dash: None, role: Role::Accent }
}

/// Half a metre, in the lower left corner.
fn scale_bar(scene: &mut Scene, panel: &Panel) {
    let (x, y, length) = (panel.view.x + 10.0, panel.view.bottom() - 8.0, 0.5 * panel.scale());
    let bar = vec![[x, y - 3.0], [x, y], [x + length, y], [x + length, y - 3.0]];
    scene.marks.push(Mark::Lines { lines: vec![bar], width: 1.0, dash: None, role: Role::Ink });
    let area = Rect::new(x, y - 14.0, length, 12.0);
    scene.marks.push(text(area, Anchor::Middle, 9.5, Weight::Regular, Role::Ink, "0.5 m"));
}

fn counters(scene: &mut Scene, model: &ProposalModel, panel: &Panel, cloud: &Cloud) {
    let ess = cloud.ess();
    let few = i32::from(ess < 99.95);
    let numbers = [
        (format!("{} %", fixed(100.0 * cloud.share_inside(None), 1)), "samples in 90 %".to_string()),
        (fixed(ess, few), format!("N_eff of {}", model.setup().samples)),
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
            format!("in 90 %: if A {a} %, if B {b} % (posterior {p} %, {q} %)"),
            format!("if A {a} %, if B {b} % (posterior {p}, {q} %)"),
        ]
    } else if weights.iter().all(|w| w.to_bits() == weights[0].to_bits()) {
        ["all weights are exactly equal".into(), "all weights are equal".into()]
    } else {
        let heaviest = weights[cloud.weights.heaviest()] * weights.len() as f64;
        let share = fixed(heaviest, 1);
        [format!("largest weight: {share} times its share"), format!("largest weight: {share}/M")]
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
            format!("N_eff ratio {times}, but 2.0 has lost {lost}, and N_eff cannot tell"),
            format!("N_eff ratio {times}, but 2.0 lost {lost}"),
        ],
        None => {
            [format!("N_eff ratio {times}: one sample of 2.0 is worth {times} of 1.0"), format!("N_eff ratio {times}")]
        }
    };
    line(scene, &words, 14.0, Weight::SemiBold, Role::Ink, wordings);

    let half = model.half();
    let asked = match (model.guess(), model.at_half()) {
        (None, _) => ["And at half the range noise? Predict first.".to_string(), "And at half? Predict first.".into()],
        (Some(guess), None) => [
            format!(
                "And at half this range noise, {half} m? Your guess: {}. Drag the marker, then run it.",
                write(guess)
            ),
            format!("At half, {half} m? Your guess: {}.", write(guess)),
        ],
        (Some(guess), Some(ratio)) => {
            let ratio = fixed(ratio, 1);
            [
                format!("At half the range noise, {half} m, it is {ratio} times. You guessed {}.", write(guess)),
                format!("At {half} m: {ratio}. You guessed {}.", write(guess)),
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
        scene.marks.push(diamond([at(ratio), y - 9.0], 7.0, Role::Ink));
    }
    scene.marks.push(Mark::Discs { centres: vec![[at(now), y]], radius: 5.0, role: Role::Ink });
    if let Some(guess) = model.guess() {
        scene.marks.push(pointer([at(guess), y - 2.0], 8.0));
        scene.handles.push(Handle {
            name: GUESS,
            title: "Your guess at half the range noise".into(),
            at: [at(guess), y - 9.0],
            value: guess,
            text: format!("{} times", write(guess)),
            hover: None,
        });
    }
}

/// A triangle that points down at its place.
fn pointer([x, y]: Point, r: f64) -> Mark {
    Mark::Polygons { polygons: vec![vec![[x, y], [x - r, y - 1.7 * r], [x + r, y - 1.7 * r]]], role: Role::Accent }
}

/// What a legend's sample looks like.
#[derive(Clone, Copy)]
enum Sample {
    Dots,
    Density,
    Line(Role, Option<[f64; 2]>),
    Landmark,
    Robot(Role),
    Now,
    Guess,
    Half,
}

fn legend(scene: &mut Scene, model: &ProposalModel, area: &Rect) {
    let mut items = vec![
        (Sample::Density, "posterior"),
        (Sample::Line(Role::Ink, None), "its 90 %"),
        (Sample::Line(Role::Posterior, Some([5.0, 3.0])), "Gaussian of 2.0"),
        (Sample::Dots, "samples"),
        (Sample::Landmark, "landmark"),
        (Sample::Robot(Role::Muted), "robot before,"),
        (Sample::Robot(Role::Ink), "after"),
        (Sample::Now, "ratio"),
    ];
    if model.guess().is_some() {
        items.push((Sample::Guess, "guess"));
    }
    if model.at_half().is_some() {
        items.push((Sample::Half, "at half"));
    }
    let (size, width, gap) = (11.5, 18.0, 12.0);
    let [mut x, mut y] = [area.x, area.y];
    for (sample, name) in items {
        let words = font::measure(name, size, Weight::Regular) + 0.01;
        if x > area.x && x + width + 5.0 + words > area.right() {
            (x, y) = (area.x, y + LINE);
        }
        let place = Rect::new(x, y + 0.5 * (LINE - 12.0), width, 12.0);
        draw_sample(scene, sample, &place);
        let line = Text::new(
            Rect::new(place.right() + 5.0, y, words, LINE),
            Anchor::Start,
            size,
            Weight::Regular,
            Role::Muted,
            name,
        );
        x = place.right() + 5.0 + words + gap;
        scene.marks.push(Mark::Text(line));
    }
}

fn draw_sample(scene: &mut Scene, sample: Sample, place: &Rect) {
    let [cx, cy] = place.centre();
    let marks = &mut scene.marks;
    match sample {
        Sample::Dots => {
            for (dx, role) in [(-4.0, Role::Prior), (4.0, Role::Posterior)] {
                marks.push(Mark::Discs { centres: vec![[cx + dx, cy]], radius: 1.8, role });
            }
        }
        Sample::Density => {
            let cells = Cells { columns: 3, shades: vec![90, 255, 90] };
            marks.push(Mark::Raster { area: *place, cells, shading: Shading::Density });
        }
        Sample::Line(role, dash) => {
            let lines = vec![vec![[place.x, cy], [place.right(), cy]]];
            marks.push(Mark::Lines { lines, width: 1.75, dash, role });
        }
        Sample::Landmark => marks.extend([ring([cx, cy], 7.0), diamond([cx, cy], 4.0, Role::Landmark)]),
        Sample::Robot(role) => {
            let polygons = vec![vec![[cx + 7.0, cy], [cx - 4.5, cy + 4.5], [cx - 4.5, cy - 4.5]]];
            marks.push(Mark::Polygons { polygons, role });
        }
        Sample::Now => marks.push(Mark::Discs { centres: vec![[cx, cy]], radius: 4.5, role: Role::Ink }),
        Sample::Guess => marks.push(pointer([cx, cy + 6.0], 6.0)),
        Sample::Half => marks.push(diamond([cx, cy], 5.5, Role::Ink)),
    }
}
