//! What is to be seen of the graphical model: its graph, and beside it the covariance of the map.

use super::{
    layout::{LINE, Layout, MARGIN, NARROWEST},
    model::ConditioningModel,
};
use crate::{
    font::{self, Weight},
    model::Model,
    scene::{
        Anchor, Cells, Handle, Mark, Point, Rect, Role, Scene, Shading, Text, clip_polyline, closed, ellipse, heading,
        text,
    },
};
use fastslam_lab::experiment::conditioning::SIZE;

/// Name of the handle that chooses an entry of the matrix.
pub const ENTRY: &str = "entry";

/// Radius of a region of 90 % of a Gaussian of the plane, in standard deviations: √(−2 ln 0.1).
const REGION: f64 = 2.145_966_026_289_347;

/// |ρ| is drawn in so many steps of width and strength: no eye sees more.
const LEVELS: usize = 32;

/// Segments of an arc, and how far it bows out, as a share of its length.
const SEGMENTS: usize = 12;
const BOW: f64 = 0.16;

/// Dash and gap of a sighting \[css px\].
const SIGHTING: [f64; 2] = [2.0, 3.0];

/// The whole figure at this size \[css px\].
pub fn build(model: &ConditioningModel, width: f64, height: f64) -> Scene {
    let layout = Layout::new(width);
    let mut scene = Scene::new(width.max(NARROWEST), height.max(layout.height), model.describe());
    let (title, rest, role) = if model.conditioned() {
        ("Given the path", "every landmark stands alone", Role::Accent)
    } else {
        ("Path unknown", "its errors are shared by the map", Role::Ink)
    };
    heading(&mut scene, &layout.graph_header, (title, role), rest);
    Graph::new(model, &layout.graph).draw(&mut scene);
    legend(&mut scene, model, &layout);
    matrix(&mut scene, model, &layout);
    notes(&mut scene, model, &layout.notes);
    scene
}

/// The graph at a place in the figure.
struct Graph<'a> {
    model: &'a ConditioningModel,
    area: &'a Rect,
    /// Css px per metre.
    scale: f64,
}

impl<'a> Graph<'a> {
    fn new(model: &'a ConditioningModel, area: &'a Rect) -> Self {
        Self { model, area, scale: area.w / (SIZE[0] + 2.0 * MARGIN) }
    }

    /// A point of the world \[m\].
    fn point(&self, [x, y]: [f64; 2]) -> Point {
        [self.area.x + (x + MARGIN) * self.scale, self.area.bottom() - (y + MARGIN) * self.scale]
    }

    fn pose(&self, t: usize) -> Point {
        let pose = &self.model.drive().path()[t];
        self.point([pose.x, pose.y])
    }

    fn landmark(&self, j: usize) -> Point {
        self.point(self.model.drive().landmarks()[j])
    }

    /// Radius of a pose's node \[css px\].
    fn node(&self) -> f64 {
        (0.095 * self.scale).clamp(4.0, 7.0)
    }

    fn font_size(&self) -> f64 {
        (0.18 * self.scale).clamp(8.5, 12.0)
    }

    /// Width of an arc of |ρ| = 1 \[css px\]: less for many, so that they can be told apart.
    fn full(&self) -> f64 {
        full_width(self.model, self.area)
    }

    fn draw(&self, scene: &mut Scene) {
        let (model, now) = (self.model, self.model.step() as usize);
        let seen = &model.covariances().seen;
        let sightings = (1..=now).flat_map(|t| model.drive().sightings(t).into_iter().map(move |j| (t, j)));
        let lines = sightings.flat_map(|(t, j)| dashes(self.pose(t), self.landmark(j))).collect();
        scene.marks.push(Mark::Strands { lines, width: 1.0, role: Role::Muted });
        self.arcs(scene);

        let last = model.drive().path().len() - 1;
        let line = |from, to| (from..=to).map(|t| self.pose(t)).collect::<Vec<_>>();
        let ahead = Mark::Lines { lines: vec![line(now, last)], width: 1.0, dash: Some([1.0, 4.0]), role: Role::Muted };
        let driven = Mark::Lines { lines: vec![line(0, now)], width: 2.0, dash: None, role: Role::Path };
        scene.marks.extend([ahead, driven]);

        // What is written stands on paper: arcs run everywhere.
        let mut names: Vec<Text> = (0..model.drive().landmarks().len()).map(|j| self.landmark_name(j)).collect();
        names.extend((0..=last).map(|t| self.pose_name(t)));
        for name in &names {
            let [x, y] = name.area.centre();
            let (w, h) = (name.width() + 2.0, name.size);
            scene.marks.push(Mark::Fill { area: Rect::new(x - 0.5 * w, y - 0.5 * h, w, h), role: Role::Paper });
        }

        if !model.conditioned() {
            let regions = model.covariances().path.iter().enumerate();
            let lines = regions.flat_map(|(k, p)| self.region(self.pose(k + 1), [p.m11, p.m12, p.m22])).collect();
            scene.marks.push(Mark::Lines { lines, width: 1.0, dash: Some([4.0, 3.0]), role: Role::Path });
        }
        let regions = seen.iter().enumerate().flat_map(|(k, &j)| {
            let block = model.map().block(k, k);
            self.region(self.landmark(j), [block.m11, block.m12, block.m22])
        });
        scene.marks.push(Mark::Lines { lines: regions.collect(), width: 1.5, dash: None, role: Role::Landmark });
        self.nodes(scene, now, last);
        scene.marks.extend(names.into_iter().map(Mark::Text));
    }

    fn nodes(&self, scene: &mut Scene, now: usize, last: usize) {
        let (model, radius) = (self.model, self.node());
        let mut discs = |poses: core::ops::RangeInclusive<usize>, radius: f64, role: Role| {
            let centres = poses.map(|t| self.pose(t)).collect();
            scene.marks.push(Mark::Discs { centres, radius, role });
        };
        discs(now + 1..=last, 2.0, Role::Muted);
        discs(0..=now, radius, Role::Path);
        if !model.conditioned() {
            // Not observed: an open node. The start is known.
            discs(1..=now, radius - 2.0, Role::Paper);
        }
        let side = |j: usize| if model.place(j).is_some() { radius } else { 0.7 * radius };
        let diamonds = (0..model.drive().landmarks().len()).map(|j| (j, diamond(self.landmark(j), side(j))));
        let (seen, unseen): (Vec<_>, Vec<_>) = diamonds.partition(|(j, _)| model.place(*j).is_some());
        let corners = |diamonds: Vec<(usize, Vec<Point>)>| diamonds.into_iter().map(|(_, corners)| corners);
        scene.marks.push(Mark::Polygons { polygons: corners(seen).collect(), role: Role::Landmark });
        let lines = corners(unseen).map(closed).collect();
        scene.marks.push(Mark::Lines { lines, width: 1.0, dash: None, role: Role::Muted });
        let rings = chosen(model).map(|j| closed(diamond(self.landmark(j), radius + 3.5)));
        scene.marks.push(Mark::Lines { lines: rings.collect(), width: 2.0, dash: None, role: Role::Accent });
    }

    /// The outline of the 90 % region of a Gaussian, by Σ_xx, Σ_xy and Σ_yy \[m²\], cut at the edge of the graph.
    fn region(&self, centre: Point, covariance: [f64; 3]) -> Vec<Vec<Point>> {
        let [xx, xy, yy] = covariance.map(|c| c * self.scale * self.scale);
        clip_polyline(&closed(ellipse(centre, [[xx, -xy], [-xy, yy]], REGION)), self.area)
    }

    /// An arc between any two landmarks seen: as wide and as strong as |ρ|, and none where that is 0.
    fn arcs(&self, scene: &mut Scene) {
        let (map, seen) = (self.model.map(), &self.model.covariances().seen);
        let mut levels: Vec<Vec<Vec<Point>>> = vec![Vec::new(); LEVELS + 1];
        let mut accent = None;
        for b in 0..seen.len() {
            for a in 0..b {
                let level = (map.coupling(a, b) * LEVELS as f64).ceil() as usize;
                let arc = arc(self.landmark(seen[a]), self.landmark(seen[b]));
                if level > 0 && chosen(self.model).all(|j| j == seen[a] || j == seen[b]) && !self.same() {
                    accent = Some((level, arc.clone()));
                }
                levels[level].push(arc);
            }
        }
        // The weakest first: what is strong is seen.
        for (level, lines) in levels.into_iter().enumerate().skip(1).filter(|(_, lines)| !lines.is_empty()) {
            let (width, role) = strength(level, self.full());
            scene.marks.push(Mark::Strands { lines, width, role });
        }
        if let Some((level, arc)) = accent {
            let width = strength(level, self.full()).0.max(1.0);
            let rim = Mark::Lines { lines: vec![arc.clone()], width: width + 3.0, dash: None, role: Role::Paper };
            scene.marks.extend([rim, Mark::Lines { lines: vec![arc], width, dash: None, role: Role::Accent }]);
        }
    }

    /// Whether the entry is of one landmark with itself.
    fn same(&self) -> bool {
        let [a, b] = self.model.entry();
        a / 2 == b / 2
    }

    /// Beside its landmark, away from the way.
    fn landmark_name(&self, j: usize) -> Text {
        let at = self.landmark(j);
        let way = self.model.drive().path().iter().map(|pose| self.point([pose.x, pose.y]));
        let nearest = way.min_by(|a, b| squared(*a, at).total_cmp(&squared(*b, at))).unwrap_or(at);
        let role = if self.model.place(j).is_some() { Role::Ink } else { Role::Muted };
        let weight = if chosen(self.model).any(|k| k == j) { Weight::SemiBold } else { Weight::Regular };
        self.name(format!("m{}", j + 1), at, [at[0] - nearest[0], at[1] - nearest[1]], weight, role)
    }

    /// Beside its pose, on the right of the drive: there the way back does not come by.
    fn pose_name(&self, t: usize) -> Text {
        let theta = self.model.drive().path()[t].theta;
        let (sin, cos) = fastslam::ops::sin_cos(theta);
        let role = if t <= self.model.step() as usize { Role::Path } else { Role::Muted };
        self.name(format!("x{t}"), self.pose(t), [sin, cos], Weight::Regular, role)
    }

    /// A name a little away from a node in a direction, inside the graph.
    fn name(&self, name: String, at: Point, towards: Point, weight: Weight, role: Role) -> Text {
        let size = self.font_size();
        let (w, h) = (font::measure(&name, size, weight) + 0.01, size + 1.0);
        let length = squared(towards, [0.0; 2]).sqrt().max(1e-9);
        let away = [0.5 * w, 0.5 * h].map(|half| self.node() + 5.0 + half);
        let [x, y] = [0, 1].map(|k| at[k] + towards[k] / length * away[k]);
        let x = within(x - 0.5 * w, self.area.x + 1.0, self.area.right() - w - 1.0);
        let y = within(y - 0.5 * h, self.area.y, self.area.bottom() - h);
        Text::new(Rect::new(x, y, w, h), Anchor::Middle, size, weight, role, name)
    }
}

/// The landmarks of the entry.
fn chosen(model: &ConditioningModel) -> impl Iterator<Item = usize> {
    let [a, b] = model.entry().map(|k| k / 2);
    core::iter::once(a).chain((a != b).then_some(b))
}

fn full_width(model: &ConditioningModel, area: &Rect) -> f64 {
    let n = model.drive().landmarks().len() as f64;
    (area.w / (5.5 * n * n.sqrt())).clamp(0.6, 5.0)
}

/// Width \[css px\] and strength of an arc.
fn strength(level: usize, full: f64) -> (f64, Role) {
    let t = level as f64 / LEVELS as f64;
    (t * full, Role::Level((255.0 * t).round() as u8))
}

/// From one point to another, bowed to the left.
fn arc([x0, y0]: Point, [x1, y1]: Point) -> Vec<Point> {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let at = |k: usize| {
        let t = k as f64 / SEGMENTS as f64;
        let out = 4.0 * BOW * t * (1.0 - t);
        [x0 + t * dx + out * dy, y0 + t * dy - out * dx]
    };
    (0..=SEGMENTS).map(at).collect()
}

/// A dashed line, dash by dash.
fn dashes([x0, y0]: Point, [x1, y1]: Point) -> Vec<Vec<Point>> {
    let length = squared([x0, y0], [x1, y1]).sqrt();
    let [dash, gap] = SIGHTING;
    let at = |along: f64| {
        let t = (along / length).min(1.0);
        [x0 + t * (x1 - x0), y0 + t * (y1 - y0)]
    };
    let count = ((length / (dash + gap)).ceil() as usize).min(1000); // whatever the width of the figure
    (0..count).map(|k| k as f64 * (dash + gap)).map(|along| vec![at(along), at(along + dash)]).collect()
}

/// As `clamp`, whose panic would bring all that writes numbers into the page.
fn within(x: f64, least: f64, most: f64) -> f64 {
    x.min(most).max(least)
}

fn diamond([x, y]: Point, r: f64) -> Vec<Point> {
    vec![[x - r, y], [x, y - r], [x + r, y], [x, y + r]]
}

fn squared(a: Point, b: Point) -> f64 {
    let [dx, dy] = [a[0] - b[0], a[1] - b[1]];
    dx * dx + dy * dy
}

/// What a legend's sample looks like.
#[derive(Clone, Copy)]
enum Sample {
    Pose { known: bool },
    Line(Role, f64, Option<[f64; 2]>),
    Arcs,
    Landmark,
    Region,
}

fn legend(scene: &mut Scene, model: &ConditioningModel, layout: &Layout) {
    let known = model.conditioned();
    let items = [
        (Sample::Pose { known }, if known { "pose, known" } else { "pose, unknown" }),
        (Sample::Line(Role::Path, 2.0, None), "odometry"),
        (Sample::Landmark, "landmark"),
        (Sample::Line(Role::Muted, 1.0, Some(SIGHTING)), "sighting"),
        (Sample::Region, "90 % region"),
        (Sample::Arcs, "|ρ| = ¼, ½, 1"),
    ];
    let (area, size, gap) = (&layout.legend, 11.5, 12.0);
    let [mut x, mut y] = [area.x, area.y];
    for (sample, name) in items {
        let width = if let Sample::Arcs = sample { 48.0 } else { 18.0 };
        let name_width = font::measure(name, size, Weight::Regular) + 0.01;
        if x > area.x && x + width + 5.0 + name_width > area.right() {
            (x, y) = (area.x, y + LINE);
        }
        draw_sample(scene, sample, &Rect::new(x, y, width, LINE), full_width(model, &layout.graph));
        let place = Rect::new(x + width + 5.0, y, name_width, LINE);
        scene.marks.push(text(place, Anchor::Start, size, Weight::Regular, Role::Muted, name));
        x = place.right() + gap;
    }
}

fn draw_sample(scene: &mut Scene, sample: Sample, place: &Rect, full: f64) {
    let ([cx, cy], marks) = (place.centre(), &mut scene.marks);
    let across = |from: f64, to: f64| vec![vec![[from, cy], [to, cy]]];
    match sample {
        Sample::Pose { known } => {
            marks.push(Mark::Discs { centres: vec![[cx, cy]], radius: 5.5, role: Role::Path });
            if !known {
                marks.push(Mark::Discs { centres: vec![[cx, cy]], radius: 3.5, role: Role::Paper });
            }
        }
        Sample::Line(role, width, dash) => {
            marks.push(Mark::Lines { lines: across(place.x, place.right()), width, dash, role })
        }
        Sample::Arcs => {
            for (k, share) in [0.25, 0.5, 1.0].into_iter().enumerate() {
                let x = place.x + 16.0 * k as f64;
                let (width, role) = strength((share * LEVELS as f64) as usize, full);
                marks.push(Mark::Lines { lines: across(x + 1.0, x + 13.0), width, dash: None, role });
            }
        }
        Sample::Landmark => marks.push(Mark::Polygons { polygons: vec![diamond([cx, cy], 5.5)], role: Role::Landmark }),
        Sample::Region => {
            let lines = vec![closed(ellipse([cx, cy], [[16.0, 0.0], [0.0, 6.0]], 2.0))];
            marks.push(Mark::Lines { lines, width: 1.5, dash: None, role: Role::Landmark });
        }
    }
}

fn matrix(scene: &mut Scene, model: &ConditioningModel, layout: &Layout) {
    let (n, area) = (model.drive().landmarks().len(), layout.matrix);
    scale(scene, &layout.matrix_header);
    let places: Vec<Option<usize>> = (0..n).map(|j| model.place(j)).collect();
    let shade = |row: usize, column: usize| match (places[row / 2], places[column / 2]) {
        (Some(i), Some(j)) => {
            let rho = model.map().correlation(2 * i + row % 2, 2 * j + column % 2);
            // Rounded up: an entry that is not 0 is never drawn as one that is.
            (255.0 * rho.abs()).ceil() as u8
        }
        _ => 0,
    };
    let shades = (0..2 * n).flat_map(|row| (0..2 * n).map(move |column| (row, column))).map(|(r, c)| shade(r, c));
    let cells = Cells { columns: 2 * n, shades: shades.collect() };
    scene.marks.push(Mark::Raster { area, cells, shading: Shading::Correlation });

    let block = area.w / n as f64;
    for along in (1..n).map(|k| k as f64 * block) {
        for area in [Rect::new(area.x, area.y + along, area.w, 1.0), Rect::new(area.x + along, area.y, 1.0, area.h)] {
            scene.marks.push(Mark::Fill { area, role: Role::Frame });
        }
    }
    // A landmark without a row and a column yet: struck through.
    let (mut struck, inset) = (Vec::new(), 0.15 * block);
    for j in (0..n).filter(|&j| places[j].is_none()) {
        let at = (j as f64 + 0.5) * block;
        struck.push(vec![[area.x + inset, area.y + at], [area.right() - inset, area.y + at]]);
        struck.push(vec![[area.x + at, area.y + inset], [area.x + at, area.bottom() - inset]]);
    }
    scene.marks.push(Mark::Lines { lines: struck, width: 1.0, dash: Some([1.0, 3.0]), role: Role::Muted });
    scene.marks.push(Mark::Frame { area, width: 1.0, role: Role::Muted });
    names(scene, model, layout, block);
    cursor(scene, model, &area, 0.5 * block);
}

/// What the shades mean, at the right end of the header, and the header.
fn scale(scene: &mut Scene, header: &Rect) {
    let Rect { x, y, w, h } = *header;
    let bar = Rect::new(x + w - 72.0, y + 0.5 * (h - 11.0), 56.0, 11.0);
    let cells = Cells { columns: 14, shades: (0..14).map(|k| (k * 255 / 13) as u8).collect() };
    scene.marks.push(Mark::Raster { area: bar, cells, shading: Shading::Correlation });
    scene.marks.push(Mark::Frame { area: bar, width: 1.0, role: Role::Muted });
    for (end, label) in [(bar.x - 14.0, "0"), (bar.right() + 4.0, "1")] {
        let area = Rect::new(end, y, 10.0, h);
        scene.marks.push(text(area, Anchor::Middle, 11.5, Weight::Regular, Role::Muted, label));
    }
    heading(scene, &Rect::new(x, y, w - 94.0, h), ("Covariance of the map", Role::Ink), "|ρ|");
}

/// Names of the landmarks along the matrix: as many as fit, and always those of the entry.
fn names(scene: &mut Scene, model: &ConditioningModel, layout: &Layout, block: f64) {
    let Layout { rows, columns, matrix, .. } = layout;
    let ([row, column], size) = (model.entry().map(|k| k / 2), 10.0);
    let widest = font::measure("m24", size, Weight::SemiBold) + 4.0;
    let down = (row, true, size + 1.0, [matrix.y, rows.y, rows.bottom()]);
    let across = (column, false, widest, [matrix.x, columns.x, columns.right()]);
    for (chosen, is_row, room, [origin, start, end]) in [down, across] {
        let apart = (room / block).ceil() as usize;
        for j in 0..model.drive().landmarks().len() {
            let wanted = origin + (j as f64 + 0.5) * block - 0.5 * room;
            let at = within(wanted, start, end - room);
            if j != chosen && (at != wanted || j % apart != 0 || j.abs_diff(chosen) < apart) {
                continue;
            }
            let area = if is_row {
                Rect::new(rows.x, at, rows.w - 2.0, room)
            } else {
                Rect::new(at, columns.y, room, columns.h)
            };
            let (weight, role) =
                if j == chosen { (Weight::SemiBold, Role::Accent) } else { (Weight::Regular, Role::Muted) };
            scene.marks.push(text(area, Anchor::Middle, size, weight, role, format!("m{}", j + 1)));
        }
    }
}

/// The entry that is named.
fn cursor(scene: &mut Scene, model: &ConditioningModel, area: &Rect, cell: f64) {
    let [row, column] = model.entry();
    let at = Rect::new(area.x + column as f64 * cell, area.y + row as f64 * cell, cell, cell);
    scene.marks.push(Mark::Frame { area: at.inset(-3.5), width: 3.5, role: Role::Paper });
    scene.marks.push(Mark::Frame { area: at.inset(-3.0), width: 2.0, role: Role::Accent });
    scene.handles.push(Handle {
        name: ENTRY,
        title: "Entry of the covariance".into(),
        at: at.centre(),
        value: model.correlation().unwrap_or(0.0),
        text: model.entry_text(),
        hover: Some(*area),
    });
}

fn notes(scene: &mut Scene, model: &ConditioningModel, area: &Rect) {
    let [a, b] = model.entry().map(|k| k / 2);
    let together = match (model.place(a).and(model.place(b)), model.seen_together(a, b)) {
        _ if a == b => "A landmark with itself: in its own block".into(),
        (None, _) => "Not both of them seen yet".into(),
        (_, 0) => "No pose saw both".into(),
        (_, 1) => "One pose saw both".into(),
        (_, n) => format!("{n} poses saw both"),
    };
    let off_block =
        format!("Off the blocks: {} of {} entries ≠ 0", model.map().off_block_nonzeros(), model.off_block());
    let size = 2 * model.drive().landmarks().len() + 3;
    let touched = format!("EKF {size}² = {}, FastSLAM 2² = 4 a particle", model.ekf_entries());
    let lines = [
        (model.entry_text(), Weight::SemiBold, Role::Accent),
        (together, Weight::Regular, Role::Muted),
        (off_block, Weight::SemiBold, Role::Ink),
        ("Entries that one sighting changes:".into(), Weight::Regular, Role::Muted),
        (touched, Weight::SemiBold, Role::Ink),
    ];
    for (k, (line, weight, role)) in lines.into_iter().enumerate() {
        let place = Rect::new(area.x, area.y + k as f64 * LINE, area.w, LINE);
        scene.marks.push(text(place, Anchor::Start, 12.0, weight, role, line));
    }
}
