//! What became of the explanations since the ride: a row for each, as dark as its share of the weight; and the one of EKF-SLAM.

use super::{
    layout::{Layout, MOST_OFF},
    model::DoorsModel,
    strip::EKF,
    told,
};
use crate::{
    decimal::fixed,
    model::Model,
    scene::{Cells, GHOST, Letters, Point, Rect, Role, Sample, Scene, Shading, legend, plain, strong},
    words::{common, doors as words},
};
use fastslam_lab::experiment::doors::{DoorsReport, FARTHEST, HELD};

const SIZE: f64 = 11.5;
const NAME: Letters = plain(SIZE, Role::Muted);

/// The history as it is drawn.
pub struct History<'a> {
    pub model: &'a DoorsModel,
    pub layout: &'a Layout,
}

impl History<'_> {
    /// The first step that it shows: the one before the ride.
    fn first(&self) -> u32 {
        self.model.ride().saturating_sub(1)
    }

    /// Steps that it shows.
    fn columns(&self) -> u32 {
        self.model.step_count() - self.first() + 1
    }

    /// The middle of a step's column \[css px\].
    fn x(&self, step: u32) -> f64 {
        let area = self.layout.history;
        area.x + area.w * (f64::from(step - self.first()) + 0.5) / f64::from(self.columns())
    }

    /// The middle of an explanation's row \[css px\]: those beyond the truth above.
    fn y(&self, off: f64) -> f64 {
        let Rect { y, h, .. } = self.layout.history;
        let rows = f64::from(2 * MOST_OFF + 1);
        y + h * (f64::from(MOST_OFF) - off.clamp(-f64::from(MOST_OFF), f64::from(MOST_OFF)) + 0.5) / rows
    }

    /// What has been simulated of it, up to the step shown.
    fn reports(&self) -> impl Iterator<Item = &DoorsReport> {
        self.model.history().iter().skip(self.first() as usize)
    }

    pub fn draw(&self, scene: &mut Scene) {
        self.header(scene);
        self.cells(scene);
        self.rows(scene);
        self.axis(scene);
        self.lines(scene);
        self.shares(scene);
    }

    fn header(&self, scene: &mut Scene) {
        let area = self.layout.history_header;
        let title = words::history();
        scene.text(Rect { h: 18.0, ..area }, strong(SIZE, Role::Ink), title);
        let used = strong(SIZE, Role::Ink).width(title) + 16.0;
        let dark = Sample::new(|scene, place| {
            let area = Rect { h: 10.0, y: place.y + 1.0, ..*place };
            scene.raster(area, Cells::row(&[20, 60, 105, 150, 205, 255]), Shading::Correlation);
        });
        let wide = self.layout.wide;
        let mut items = vec![
            (dark.wide(if wide { 36.0 } else { 20.0 }), words::share()),
            (Sample::line(EKF, 3.0, None), "EKF-SLAM"),
        ];
        // A phone has one line for all of them.
        if wide {
            items.push((Sample::line(Role::Truth, 1.5, None), common::truth()));
        }
        if !self.model.pinned().is_empty() {
            let name = if wide { common::pinned_run() } else { common::pinned_mark() };
            items.push((Sample::line(GHOST, 3.0, None), name));
        }
        let place =
            if wide { Rect { x: area.x + used, w: area.w - used, ..area } } else { Rect { y: area.y + 18.0, ..area } };
        legend(scene, &place, items);
    }

    fn cells(&self, scene: &mut Scene) {
        let (columns, rows) = (self.columns() as usize, (2 * MOST_OFF + 1) as usize);
        let mut shades = vec![0; columns * rows];
        for report in self.reports() {
            let (column, shares) = ((report.step - self.first()) as usize, report.shares(self.model.setup()));
            for row in 0..rows {
                let share = shares[(FARTHEST + MOST_OFF) as usize - row];
                // Square roots: that an explanation is alive at all must be seen.
                let shade = if share < HELD { 0.0 } else { 255.0 * share.min(1.0).sqrt() };
                shades[row * columns + column] = shade as u8;
            }
        }
        scene.raster(self.layout.history, Cells { columns, shades }, Shading::Correlation);
        let Rect { x, y, w, h } = self.layout.history;
        let between = (1..rows).map(|row| y + h * row as f64 / rows as f64).map(|y| vec![[x, y], [x + w, y]]);
        scene.lines(between.collect(), 1.5, Role::Paper);
        scene.frame(self.layout.history, 1.0, Role::Frame);
    }

    /// What each row is called, and the one of the truth between two lines.
    fn rows(&self, scene: &mut Scene) {
        let Rect { x, w, h, .. } = self.layout.history;
        let row = h / f64::from(2 * MOST_OFF + 1);
        for off in (-MOST_OFF..=MOST_OFF).filter(|off| off % 2 == 0) {
            let area = Rect::new(self.layout.names.x, self.y(f64::from(off)) - 8.0, self.layout.names.w - 5.0, 16.0);
            scene.text(area, if off == 0 { strong(SIZE, Role::Truth) } else { NAME }.end(), &told::off(off));
        }
        let edges = [-0.5, 0.5].map(|k| self.y(0.0) + k * row).map(|y| vec![[x, y], [x + w, y]]);
        scene.lines(edges.into(), 1.5, Role::Truth);
    }

    /// The explanation of EKF-SLAM, a line that never lets go; and that of the run that is pinned.
    fn lines(&self, scene: &mut Scene) {
        let ride = self.model.ride();
        let pinned = (ride..=self.model.step_count()).zip(self.model.pinned());
        let pinned: Vec<Point> = pinned.map(|(step, off)| [self.x(step), self.y(*off)]).collect();
        if pinned.len() > 1 {
            scene.line(&pinned, 3.0, GHOST);
        }
        let setup = self.model.setup();
        let at =
            |report: &DoorsReport| [self.x(report.step), self.y(f64::from(setup.off(report.ekf_place, report.truth)))];
        let line: Vec<Point> = self.reports().map(at).collect();
        if let Some(end) = line.last().copied() {
            scene.rimmed(vec![line], 3.0, None, EKF);
            scene.disc(end, 4.0, EKF);
        }
    }

    /// Steps that have a name.
    fn axis(&self, scene: &mut Scene) {
        let (axis, history) = (self.layout.axis, self.layout.history);
        let [ride, first_door, sign] = self.model.run().events();
        let mut free = axis.x;
        for (step, name) in [(ride, words::ride_mark()), (first_door, words::first_door()), (sign, words::sign())] {
            if step <= self.first() {
                continue; // it never came in sight
            }
            let x = self.x(step);
            scene.dash(&[[x, history.y], [x, axis.y + 4.0]], 1.0, [1.0, 3.0], Role::Muted);
            let w = NAME.width(name) + 0.01;
            let left = (x - 0.5 * w).max(free).min(axis.right() - w);
            if left >= free {
                let area = Rect::new(left, axis.y + 2.0, w, 16.0);
                scene.text(area, NAME, name);
                free = area.right() + 10.0;
            }
        }
    }

    /// The share of every explanation now.
    fn shares(&self, scene: &mut Scene) {
        let (area, now) = (self.layout.shares, self.model.now());
        let (row, numbers) = (area.h / f64::from(2 * MOST_OFF + 1), 42.0);
        let shares = now.shares(self.model.setup());
        for off in -MOST_OFF..=MOST_OFF {
            let share = shares[(FARTHEST + off) as usize];
            if share < HELD {
                continue;
            }
            let y = self.y(f64::from(off));
            let w = ((area.w - numbers - 4.0) * share.min(1.0)).max(1.5);
            let role = if off == 0 { Role::Truth } else { Role::Path };
            scene.fill(Rect::new(area.x, y - 0.5 * row + 1.5, w, row - 3.0), role);
            let number = Rect::new(area.x + w + 4.0, y - 8.0, numbers, 16.0);
            scene.text(number, plain(11.0, Role::Ink), &format!("{} %", fixed(100.0 * share, 0)));
        }
    }
}
