//! The tree of ancestry of the policy that is chosen, and the steps below all charts.

use super::{
    charts::{Picture, SIZE},
    stroke,
};
use crate::{
    font::{self, Weight},
    scene::{Point, Rect, Role, Sample, Scene, plain},
    words::{self, resampling},
};

/// Strength of a branch that died out, of 255.
pub const DEAD: u8 = 25;

/// A line of descent in the tree.
#[derive(Clone)]
struct Line {
    points: Vec<Point>,
    lives: bool,
}

impl Line {
    /// On to a point; what goes straight on in its slot is one piece.
    fn go(&mut self, [x, y]: Point) {
        match &mut self.points[..] {
            [.., [_, y0], last @ [_, _]] if *y0 == y && last[1] == y => last[0] = x,
            _ => self.points.push([x, y]),
        }
    }
}

impl Picture<'_> {
    /// Who descends from whom: every edge once.
    pub fn tree(&self, scene: &mut Scene) {
        let policy = self.chosen();
        let items = vec![
            (Sample::line(stroke::role(policy), 2.0, None), resampling::lives_on().to_string()),
            (Sample::line(Role::Level(DEAD), 1.0, None), words::common::died_out().to_string()),
        ];
        // On a phone there is no room for whose it is, and the tabs say it.
        let of_policy = || resampling::TreeOf { policy: &stroke::NAMES[policy]() }.say();
        let name = if self.wide { of_policy() } else { resampling::tree().into() };
        self.label(scene, 3, &name, items);

        let alive = self.model.alive(policy);
        let [mut dead, mut living] = [Vec::new(), Vec::new()];
        let mut close = |line: Line| if line.lives { living.push(line.points) } else { dead.push(line.points) };
        // The lines that end at the step before, by slot: one child of each goes on with its line.
        let mut open: Vec<Option<Line>> = vec![None; self.particles()];
        for ((before, step), alive) in self.model.history(policy).zip(1..).zip(&alive[1..]) {
            let mut longer = vec![None; self.particles()];
            for (to, &lives) in alive.iter().enumerate() {
                let from = before.copied_from(to);
                let line = open[from].take_if(|line| line.lives == lives);
                let mut line = line.unwrap_or_else(|| Line { points: vec![self.node(step - 1, from)], lives });
                line.go(self.node(step, to));
                longer[to] = Some(line);
            }
            core::mem::replace(&mut open, longer).into_iter().flatten().for_each(&mut close);
        }
        open.into_iter().flatten().for_each(close);
        let apart = self.parts.charts[3].h / self.particles() as f64;
        scene.lines(dead, (0.16 * apart).clamp(0.6, 1.0), Role::Level(DEAD));
        scene.lines(living, (0.3 * apart).clamp(1.0, 2.0), stroke::role(policy));
        self.coalescence(scene, &alive);
    }

    /// The latest common ancestor of all particles.
    fn coalescence(&self, scene: &mut Scene, alive: &[Vec<bool>]) {
        let Some(step) = self.model.now(self.chosen()).report.descent.coalescence() else { return };
        let Some(slot) = alive[step as usize].iter().position(|alive| *alive) else { return };
        let at = self.node(step, slot);
        scene.disc(at, 6.0, Role::Paper);
        common(scene, at);
    }

    /// Where a particle of a step is drawn.
    fn node(&self, step: u32, slot: usize) -> Point {
        let area = &self.parts.charts[3];
        [self.x(step), area.y + area.h * (slot as f64 + 0.5) / self.particles() as f64]
    }

    /// Steps below the charts: the one that is read, where it is not the newest, that of the common ancestor, and those with a name.
    pub fn axis(&self, scene: &mut Scene) {
        let Rect { x, y, w, h } = self.parts.axis;
        let mut taken: Vec<[f64; 2]> = Vec::new();
        let last = self.model.course_steps();
        let named = |step: u32| resampling::StepIs { step: &step }.say();
        let back = self.model.looks_back().then(|| self.model.cursor());
        let back = back.map(|step| (step, named(step), Role::Accent));
        let tree = self.parts.charts[3].h > 0.0;
        let ancestor = self.model.now(self.chosen()).report.descent.coalescence().filter(|_| tree);
        let ancestor = ancestor.map(|step| (step, named(step), Role::Ink));
        let [start, end] = [(0, named(0)), (last, last.to_string())].map(|(step, name)| (step, name, Role::Muted));
        let events = self.events().into_iter().map(|(step, name)| (step, name.to_string(), Role::Muted));
        for (step, label, role) in back.into_iter().chain(ancestor).chain([start]).chain(events).chain([end]) {
            let ring = role == Role::Ink;
            let room = if ring { 12.0 } else { 0.0 };
            let width = room + font::measure(&label, SIZE, Weight::Regular) + 0.01;
            // A ring stands below the one in the tree, with its step beside it.
            let wanted = self.x(step) - if ring { 4.5 } else { 0.5 * width };
            let left = wanted.min(x + w - width).max(x);
            if taken.iter().any(|[from, to]| left < *to + 6.0 && *from < left + width + 6.0) {
                continue;
            }
            taken.push([left, left + width]);
            if ring {
                common(scene, [left + 4.5, y + 0.5 * h]);
            }
            scene.text(Rect::new(left + room, y, width - room, h), plain(SIZE, role), &label);
        }
    }
}

/// The mark of a common ancestor.
pub fn common(scene: &mut Scene, at: Point) {
    scene.disc(at, 4.5, Role::Ink);
    scene.disc(at, 2.5, Role::Paper);
}
