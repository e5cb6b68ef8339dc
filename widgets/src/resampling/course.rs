//! Where the particles of each policy are, and the robot; a click there chooses the policy.

use super::{
    charts::Picture,
    model::{Moment, ResamplingModel},
    stroke,
};
use crate::{
    font::{self, Weight},
    robot::Poses,
    scene::{
        Anchor, Letters, Plane, Point, Rect, Region, Role, Scene, clip_polyline, closed, diamond, joined, plain, strong,
    },
    words::resampling,
};
use fastslam::ops;

/// Font size of a policy's name, and of what is said of its particles \[css px\].
const NAME: f64 = 13.0;
const SIZE: f64 = 11.5;
/// Width of the piece of a policy's line after its name, and what is free around it \[css px\].
const PIECE: f64 = 24.0;
const APART: f64 = 8.0;

impl Picture<'_> {
    /// Name and map of each policy; on a phone the names as tabs, and the map of the one that is chosen.
    pub fn maps(&self, scene: &mut Scene) {
        for (policy, &tab) in self.parts.tabs.iter().enumerate() {
            if self.wide {
                self.title(scene, policy, &tab);
                self.map(scene, policy);
                let map = self.parts.map(policy);
                let area = Rect::new(tab.x, tab.y, tab.w, map.bottom() - tab.y);
                scene.regions.push(Region { area, target: policy as u32 });
            } else {
                self.tab(scene, policy, &tab);
                scene.regions.push(Region { area: tab, target: policy as u32 });
            }
        }
        if !self.wide {
            self.map(scene, self.chosen());
        }
    }

    /// A policy's name above its map, a piece of its line, and whether it still holds the right explanation.
    fn title(&self, scene: &mut Scene, policy: usize, line: &Rect) {
        let name = self.policy_name(scene, policy, line, Anchor::Start);
        let piece = Rect::new(line.x + name + APART, line.y, PIECE, line.h);
        stroke::sample(scene, policy, policy == self.chosen(), &piece);
        let rest = Rect::new(piece.right() + APART, line.y, line.right() - piece.right() - APART, line.h);
        if let Some((role, says)) = self.right_wing(policy) {
            scene.text(rest, strong(SIZE, role).end(), &says);
        }
    }

    /// The same for a finger.
    fn tab(&self, scene: &mut Scene, policy: usize, tab: &Rect) {
        let chosen = policy == self.chosen();
        let Rect { x, y, w, h } = *tab;
        let said = self.right_wing(policy);
        let name = if said.is_some() { Rect::new(x, y + 3.0, w, 16.0) } else { Rect::new(x, y + 7.0, w, 18.0) };
        self.policy_name(scene, policy, &name, Anchor::Middle);
        if let Some((role, says)) = said {
            scene.text(Rect::new(x + 4.0, name.bottom(), w - 8.0, 14.0), plain(SIZE, role).middle(), &says);
        }
        let piece = Rect::new(x + 10.0, y + h - 8.0, w - 20.0, 4.0);
        stroke::sample(scene, policy, chosen, &piece);
        self.frame(scene, policy, *tab);
    }

    /// Writes it, and says how wide it is.
    fn policy_name(&self, scene: &mut Scene, policy: usize, line: &Rect, anchor: Anchor) -> f64 {
        let weight = if policy == self.chosen() { Weight::SemiBold } else { Weight::Regular };
        let name = stroke::NAMES[policy]();
        scene.text(*line, Letters { weight, ..plain(NAME, stroke::role(policy)) }.at(anchor), name);
        font::measure(name, NAME, weight)
    }

    /// Around what belongs to a policy: stronger around the one that is chosen.
    fn frame(&self, scene: &mut Scene, policy: usize, area: Rect) {
        let chosen = policy == self.chosen();
        let (width, role) = if chosen { (2.0, stroke::role(policy)) } else { (1.0, Role::Frame) };
        scene.frame(area, width, role);
    }

    /// What is said of the particles that hold the right explanation; nothing on a course that has only one.
    fn right_wing(&self, policy: usize) -> Option<(Role, String)> {
        let (m, right) = (self.particles(), self.model.read(policy).report.right);
        let Some(n) = right else {
            let before = self.model.run().lost_from().is_some();
            return before.then(|| (Role::Muted, resampling::not_lost_yet().into()));
        };
        let says = match (self.long_titles(), n) {
            (true, 0) => resampling::wing_lost().into(),
            (true, _) => resampling::WingHas { n: &n, m: &m }.say(),
            (false, _) => resampling::WingHasShort { n: &n, m: &m }.say(),
        };
        Some((if n == 0 { Role::Extinct } else { Role::Accent }, says))
    }

    /// Whether there is room for what is said of the particles in full, beside every name.
    fn long_titles(&self) -> bool {
        let m = self.particles();
        let says = [resampling::wing_lost().into(), resampling::WingHas { n: &m, m: &m }.say()];
        let widest = |words: &[String], size| {
            words.iter().map(|words| font::measure(words, size, Weight::SemiBold)).fold(0.0, f64::max)
        };
        let names = stroke::NAMES.map(|name| name().to_string());
        self.wide && widest(&names, NAME) + PIECE + 3.0 * APART + widest(&says, SIZE) <= self.parts.tabs[0].w
    }

    /// Where the particles of a policy are, and the robot.
    fn map(&self, scene: &mut Scene, policy: usize) {
        let (model, area) = (self.model, self.parts.map(policy));
        let Moment { report, poses, best, .. } = model.read(policy);
        let particle = stroke::role(policy);
        let plane = whole(model, area);
        let role = Role::Muted;
        if let Some(world) = model.run().lap_world() {
            scene.lines(world.plan.walls.iter().map(|s| vec![plane.point(s.a), plane.point(s.b)]).collect(), 1.0, role);
        }
        if let Some(log) = model.run().wings_log() {
            let diamonds = log.landmarks.iter().map(|m| diamond(plane.point([m.x, m.y]), 2.75)).collect();
            scene.polygons(diamonds, Role::Feature);
        }
        let truth = &model.run().truth()[..=report.step as usize];
        let path: Vec<Point> = truth.iter().map(|p| plane.position(p)).collect();
        scene.dash(&path, 1.0, [2.0, 3.0], Role::Truth);
        let noses = poses.iter().map(|pose| nose(plane.position(pose), pose.theta, 6.0));
        scene.lines(joined(noses, |line| clip_polyline(&line, &area)), 1.0, particle);
        scene.cloud(poses.iter().map(|p| plane.position(p)), &area.inset(2.0), 2.0, particle);
        scene.lines(plane.robot(&truth[truth.len() - 1], 9.0).into_iter().map(closed).collect(), 1.5, Role::Truth);
        scene.polygons(plane.robot(&poses[*best], 6.0).into_iter().collect(), particle);
        self.frame(scene, policy, area);
    }
}

/// The whole course at a place in the figure.
fn whole(model: &ResamplingModel, area: Rect) -> Plane {
    let run = model.run();
    let mut points: Vec<[f64; 2]> = run.truth().iter().map(|pose| [pose.x, pose.y]).collect();
    points.extend(run.wings_log().iter().flat_map(|log| log.landmarks.iter().map(|m| [m.x, m.y])));
    points.extend(run.lap_world().iter().flat_map(|world| [[0.0, 0.0], world.plan.size]));
    let end = |pick: fn(f64, f64) -> f64, start| [0, 1].map(|k| points.iter().map(|p| p[k]).fold(start, pick));
    Plane::around(area, [end(f64::min, f64::INFINITY), end(f64::max, f64::NEG_INFINITY)], 6.0)
}

/// From a pose to where it looks.
fn nose([x, y]: Point, theta: f64, length: f64) -> Vec<Point> {
    let (sin, cos) = ops::sin_cos(theta);
    vec![[x, y], [x + length * cos, y - length * sin]]
}
