//! The graph: poses, landmarks, sightings, and what couples them.

use super::{layout::MARGIN, matrix, model::ConditioningModel, recipe::Given};
use crate::{
    font::{self, Weight},
    model::Model,
    robot::Poses,
    scene::{Anchor, Mark, NINE_TENTHS, Plane, Point, Rect, Role, Scene, Text, closed, diamond, joined},
};
use fastslam_lab::experiment::conditioning::SIZE;

/// |ρ| is drawn in so many steps of width and strength: no eye sees more.
pub const LEVELS: usize = 32;

/// Segments of an arc, and how far it bows out, as a share of its length.
const SEGMENTS: usize = 12;
const BOW: f64 = 0.16;

/// Dash and gap of a sighting \[css px\].
pub const SIGHTING: [f64; 2] = [2.0, 3.0];

/// The graph at a place in the figure.
pub struct Graph<'a> {
    model: &'a ConditioningModel,
    plane: Plane,
}

impl<'a> Graph<'a> {
    /// In an area.
    pub fn new(model: &'a ConditioningModel, area: &Rect) -> Self {
        let scale = area.w / (SIZE[0] + 2.0 * MARGIN);
        Self { model, plane: Plane::from_lower_left(*area, [-MARGIN; 2], scale) }
    }

    fn pose(&self, t: usize) -> Point {
        self.plane.position(&self.model.drive().path()[t])
    }

    fn landmark(&self, j: usize) -> Point {
        self.plane.point(self.model.drive().landmarks()[j])
    }

    /// Radius of a pose's node \[css px\].
    fn node(&self) -> f64 {
        (0.095 * self.plane.scale).clamp(4.0, 7.0)
    }

    fn font_size(&self) -> f64 {
        (0.18 * self.plane.scale).clamp(8.5, 12.0)
    }

    /// Width of an arc of |ρ| = 1 \[css px\]: less for many, so that they can be told apart.
    fn full(&self) -> f64 {
        full_width(self.model, &self.plane.area)
    }

    /// Draws all of it.
    pub fn draw(&self, scene: &mut Scene) {
        let (model, now) = (self.model, self.model.step() as usize);
        let seen = &model.covariances().seen;
        let sightings = |t| joined(model.drive().sightings(t).into_iter(), |j| dashes(self.pose(t), self.landmark(j)));
        scene.lines(joined(1..=now, sightings), 1.0, Role::Muted);
        self.arcs(scene);

        let last = model.drive().path().len() - 1;
        let line = |from, to| (from..=to).map(|t| self.pose(t)).collect::<Vec<_>>();
        scene.dash(&line(now, last), 1.0, [1.0, 4.0], Role::Muted);
        scene.line(&line(0, now), 2.0, Role::Path);

        // What is written stands on paper: arcs run everywhere.
        let mut names: Vec<Text> = (0..model.drive().landmarks().len()).map(|j| self.landmark_name(j)).collect();
        names.extend((0..=last).map(|t| self.pose_name(t)));
        for name in &names {
            let [x, y] = name.area.centre();
            let (w, h) = (name.width() + 2.0, name.size);
            scene.fill(Rect::new(x - 0.5 * w, y - 0.5 * h, w, h), Role::Paper);
        }

        let open = match model.given() {
            Given::Nothing => &model.covariances().path[..],
            Given::LastPose => &model.covariances().path_given_last,
            Given::Path => &[],
        };
        if !open.is_empty() {
            let lines = joined(open.iter().enumerate(), |(k, p)| {
                let pose = &model.drive().path()[k + 1];
                self.plane.region([pose.x, pose.y], [[p.m11, p.m12], [p.m12, p.m22]], NINE_TENTHS)
            });
            scene.dashed(lines, 1.0, [4.0, 3.0], Role::Path);
        }
        let regions = joined(seen.iter().enumerate(), |(k, &j)| {
            let block = model.map().block(k, k);
            self.plane.region(model.drive().landmarks()[j], block.into(), NINE_TENTHS)
        });
        scene.lines(regions, 1.5, Role::Feature);
        self.nodes(scene, now, last);
        scene.marks.extend(names.into_iter().map(Mark::Text));
    }

    fn nodes(&self, scene: &mut Scene, now: usize, last: usize) {
        let (model, radius) = (self.model, self.node());
        let mut discs = |poses: core::ops::RangeInclusive<usize>, radius: f64, role: Role| {
            scene.discs(poses.map(|t| self.pose(t)).collect(), radius, role);
        };
        discs(now + 1..=last, 2.0, Role::Muted);
        discs(0..=now, radius, Role::Path);
        // Not observed: an open node.
        let open = (1..=now).filter(|&t| !model.knows(t)).count();
        discs(1..=open, radius - 2.0, Role::Paper);
        let side = |j: usize| if model.place(j).is_some() { radius } else { 0.7 * radius };
        let diamonds = (0..model.drive().landmarks().len()).map(|j| (j, diamond(self.landmark(j), side(j))));
        let (seen, unseen): (Vec<_>, Vec<_>) = diamonds.partition(|(j, _)| model.place(*j).is_some());
        let corners = |diamonds: Vec<(usize, Vec<Point>)>| diamonds.into_iter().map(|(_, corners)| corners);
        scene.polygons(corners(seen).collect(), Role::Feature);
        scene.lines(corners(unseen).map(closed).collect(), 1.0, Role::Muted);
        let rings = chosen(model).map(|j| closed(diamond(self.landmark(j), radius + 3.5)));
        scene.lines(rings.collect(), 2.0, Role::Accent);
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
            scene.lines(lines, width, role);
        }
        if let Some((level, arc)) = accent {
            let width = strength(level, self.full()).0.max(1.0);
            scene.line(&arc, width + 3.0, Role::Paper);
            scene.line(&arc, width, Role::Accent);
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
        let way = self.model.drive().path().iter().map(|pose| self.plane.position(pose));
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
        let x = matrix::within(x - 0.5 * w, self.plane.area.x + 1.0, self.plane.area.right() - w - 1.0);
        let y = matrix::within(y - 0.5 * h, self.plane.area.y, self.plane.area.bottom() - h);
        Text::new(Rect::new(x, y, w, h), Anchor::Middle, size, weight, role, name)
    }
}

/// The landmarks of the entry.
fn chosen(model: &ConditioningModel) -> impl Iterator<Item = usize> {
    let [a, b] = model.entry().map(|k| k / 2);
    core::iter::once(a).chain((a != b).then_some(b))
}

pub fn full_width(model: &ConditioningModel, area: &Rect) -> f64 {
    let n = model.drive().landmarks().len() as f64;
    (area.w / (5.5 * n * n.sqrt())).clamp(0.6, 5.0)
}

/// Width \[css px\] and strength of an arc.
pub fn strength(level: usize, full: f64) -> (f64, Role) {
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

fn squared(a: Point, b: Point) -> f64 {
    let [dx, dy] = [a[0] - b[0], a[1] - b[1]];
    dx * dx + dy * dy
}
