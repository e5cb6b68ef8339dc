//! N_eff, lineage and errors of all three filters over one axis of time.

use super::{
    layout::{CHARTS, Parts, SCALE},
    model::{Moment, ResamplingModel},
    stroke,
};
use crate::decimal::{fixed, rounded, write};
use crate::{
    font::{self, Weight},
    panels::Panels,
    scene::{Chart, LINE, Letters, Point, Rect, Role, Sample, Scene, legend, plain, strong},
    words::{common, resampling},
};

/// Font size of what is written at the charts \[css px\].
pub const SIZE: f64 = 11.5;
const NAME: Letters = plain(SIZE, Role::Muted);

/// Dash and gap of the second curve of the policy that is chosen, and of the threshold, and from dot to dot where something happens
/// \[css px\].
const SECOND: [f64; 2] = [4.0, 3.0];
const THRESHOLD: [f64; 2] = [3.0, 3.0];
const EVENT: f64 = 4.0;

/// Between a name and what is told of it in the same line \[css px\].
const APART: f64 = 14.0;

/// The end of the axis for errors up to this \[m\]: a round number.
pub fn error_scale(largest: f64) -> f64 {
    [0.2, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0]
        .into_iter()
        .find(|end| largest <= *end)
        .unwrap_or(50.0)
}

/// The figure on its course.
pub struct Picture<'a> {
    pub model: &'a ResamplingModel,
    pub parts: &'a Parts,
    /// Whether the maps of all policies are there.
    pub wide: bool,
    /// End of the axis of errors \[m\].
    pub error_scale: f64,
}

impl Picture<'_> {
    /// A chart, by its rank.
    pub fn chart(&self, rank: usize) -> Chart {
        Chart { area: self.parts.charts[rank], last: self.model.course_steps() }
    }

    /// Where a step is on the one axis of time \[css px\].
    pub fn x(&self, step: u32) -> f64 {
        Chart { area: self.parts.first_chart(), last: self.model.course_steps() }.x(step)
    }

    pub fn particles(&self) -> usize {
        self.model.setup().particles
    }

    /// The policy whose tree and whose second curves are shown.
    pub fn chosen(&self) -> usize {
        self.model.chosen()
    }

    /// The policies, the one that is chosen last: it covers the others.
    fn in_order(&self) -> [usize; 3] {
        [1, 2, 3].map(|k| (self.chosen() + k) % 3)
    }

    /// The charts that are shown, and what goes through all of them.
    pub fn charts(&self, scene: &mut Scene, panels: &Panels) {
        self.cursor(scene);
        let draw = [Self::ess, Self::lineage, Self::errors, Self::tree];
        for (draw, _) in draw.iter().zip(CHARTS).filter(|(_, name)| panels.has(name)) {
            draw(self, scene);
        }
        self.axis(scene);
    }

    /// A line through all charts at the step read, and at what happens on the course.
    fn cursor(&self, scene: &mut Scene) {
        let last_tick = self.parts.ticks[2].bottom();
        let ends = |chart: &Rect| (chart.y, if chart.y < last_tick { last_tick } else { chart.bottom() });
        let charts: Vec<_> = self.parts.charts.iter().filter(|chart| chart.h > 0.0).map(ends).collect();
        let through = |step: u32| charts.iter().map(move |&(y0, y1)| (self.x(step), y0, y1));
        let events = self.events().into_iter().flat_map(|(step, _)| through(step));
        let dots = events.flat_map(|(x, y0, y1)| {
            let count = ((y1 - y0) / EVENT) as usize;
            (0..count).map(move |k| y0 + EVENT * k as f64).map(move |y| vec![[x, y], [x, y + 1.0]])
        });
        scene.lines(dots.collect(), 1.0, Role::Muted);
        let role = if self.model.looks_back() { Role::Accent } else { Role::Muted };
        scene.lines(through(self.model.cursor()).map(|(x, y0, y1)| vec![[x, y0], [x, y1]]).collect(), 1.0, role);
    }

    /// Steps of the course that have a name.
    pub fn events(&self) -> Vec<(u32, &'static str)> {
        let run = self.model.run();
        let named = [(run.lost_from(), resampling::lost()), (run.evidence_at(), resampling::sign())];
        named.into_iter().filter_map(|(step, name)| Some((step?, name))).collect()
    }

    /// The name of a chart above it, and after it samples of marks with what they mean, as far as there is room.
    pub fn label(&self, scene: &mut Scene, rank: usize, name: &str, items: Vec<(Sample<'_>, String)>) {
        scene.text(self.line(rank), plain(SIZE, Role::Muted), name);
        self.items(scene, rank, font::measure(name, SIZE, Weight::Regular), items);
    }

    /// The line above a chart, as high as one of a legend.
    fn line(&self, rank: usize) -> Rect {
        Rect { h: LINE, ..self.parts.labels[rank] }
    }

    /// Samples with their meanings in the line above a chart, so far from its start.
    fn items(&self, scene: &mut Scene, rank: usize, used: f64, mut items: Vec<(Sample<'_>, String)>) {
        let Rect { x, y, w, h } = self.line(rank);
        let area = Rect::new(x + used + APART, y, w - used - APART, h);
        let width = |items: &[(Sample<'_>, String)]| -> f64 {
            items.iter().map(|(_, name)| 35.0 + font::measure(name, SIZE, Weight::Regular)).sum()
        };
        while width(&items) > area.w + 12.0 {
            items.pop();
        }
        legend(scene, &area, items);
    }

    /// The ends of a chart's scale, and its edges.
    fn scale(&self, scene: &mut Scene, rank: usize, most: String) {
        let Rect { x, y, h, .. } = self.parts.charts[rank];
        let taken = if rank == 0 { self.threshold_y() } else { f64::INFINITY };
        // Inside of the edges: names stand above.
        for (y, number) in [(y + 6.0, most), (y + h - 5.0, "0".into())] {
            if (y - taken).abs() > 13.0 {
                let area = Rect::new(x - SCALE, y - 7.0, SCALE - 10.0, 14.0);
                scene.text(area, plain(SIZE, Role::Muted).end(), &number);
            }
        }
        self.chart(rank).edges(scene);
    }

    /// Where N_eff calls for resampling \[css px\].
    pub fn threshold_y(&self) -> f64 {
        self.chart(0).y(self.model.setup().threshold)
    }

    /// That line, with its handle and its number at the left.
    fn threshold(&self, scene: &mut Scene) {
        let (Rect { x, y: top, w, h }, y) = (self.parts.charts[0], self.threshold_y());
        scene.dash(&[[x, y], [x + w, y]], 1.5, THRESHOLD, Role::Accent);
        scene.polygon(vec![[x + 3.0, y], [x - 7.0, y - 6.0], [x - 7.0, y + 6.0]], Role::Accent);
        let number = resampling::ShareOfM { share: &write(rounded(self.model.setup().threshold, 2)) }.say();
        // Inside of the edges, as the ends of the scale are.
        let middle = y.min(top + h - 5.0).max(top + 6.0);
        scene.text(Rect::new(x - SCALE, middle - 7.0, SCALE - 9.0, 14.0), strong(11.0, Role::Accent).end(), &number);
    }

    /// A curve over the steps shown, by the share of the chart's height.
    fn curve(&self, rank: usize, policy: usize, height: &dyn Fn(&Moment) -> f64) -> Vec<Point> {
        self.chart(rank).curve(self.model.history(policy).map(|moment| (moment.report.step, height(moment))))
    }

    /// A curve of each policy and a second one of the one that is chosen, with dots where the cursor cuts them, and beside them what it
    /// reads.
    fn curves(
        &self,
        scene: &mut Scene,
        rank: usize,
        first: &dyn Fn(&Moment) -> f64,
        second: Option<&dyn Fn(&Moment) -> f64>,
        value: &dyn Fn(&Moment) -> String,
    ) {
        let scale = if rank == 2 { self.error_scale } else { 1.0 };
        self.chart(rank).ghost(scene, self.model.pinned(rank).iter().map(|value| value / scale));
        if let Some(second) = second {
            scene.dash(&self.curve(rank, self.chosen(), second), 1.0, SECOND, stroke::role(self.chosen()));
        }
        for policy in self.in_order() {
            let curve = self.curve(rank, policy, first);
            let dot = curve[self.model.cursor() as usize];
            stroke::lines(scene, policy, policy == self.chosen(), vec![curve]);
            scene.disc(dot, 3.0, stroke::role(policy));
        }
        let place = self.parts.values[if rank == 0 { 0 } else { rank + 1 }];
        let read = |policy| self.model.read(policy);
        self.values(scene, &place, &|policy| value(read(policy)), &|policy| self.chart(rank).y(first(read(policy))));
    }

    /// N_eff, the threshold, and the steps that resampled.
    fn ess(&self, scene: &mut Scene) {
        let m = self.particles() as f64;
        let end = scene.n_eff(&self.line(0), NAME);
        let tick = |scene: &mut Scene, [x, y]: Point| {
            let ticks = [-5.0, 0.0, 5.0].map(|dx| vec![[x + dx, y - 4.0], [x + dx, y + 4.0]]);
            scene.lines(ticks.into(), 1.5, stroke::role(self.chosen()));
        };
        let items = vec![
            (Sample::line(Role::Accent, 1.5, Some(THRESHOLD)), resampling::threshold().to_string()),
            (Sample::at(tick), common::resampled().to_string()),
        ];
        self.items(scene, 0, end - self.parts.labels[0].x, items);
        self.threshold(scene);
        self.scale(scene, 0, self.particles().to_string());
        self.curves(scene, 0, &|moment| moment.report.ess / m, None, &|moment| fixed(moment.report.ess, 1));
        self.ticks(scene);
    }

    /// A row for each policy, with a tick wherever it resampled.
    fn ticks(&self, scene: &mut Scene) {
        for (policy, row) in self.parts.ticks.iter().enumerate() {
            let rows = self.model.history(policy).filter(|moment| moment.report.resampled());
            let x = |moment: &Moment| self.x(moment.report.step);
            let lines = rows.map(x).map(|x| vec![[x, row.y + 2.0], [x, row.bottom() - 2.0]]).collect();
            scene.lines(lines, if policy == self.chosen() { 2.0 } else { 1.25 }, stroke::role(policy));
            let times = resampling::Times { n: &self.model.read(policy).resampled }.say();
            self.value(scene, policy, &Rect { y: row.y, h: row.h, ..self.parts.values[1] }, &times);
        }
    }

    /// Distinct ancestors at the start, and of the policy that is chosen some steps back.
    fn lineage(&self, scene: &mut Scene) {
        let (m, back) = (self.particles() as f64, self.model.back());
        let of = |moment: &Moment, back: u32| moment.report.descent.lineage(back);
        let n = of(self.model.read(self.chosen()), back);
        let sample = Sample::line(stroke::role(self.chosen()), 1.0, Some(SECOND));
        let items = vec![(sample, resampling::StepsBack { back: &back, n: &n }.say())];
        self.label(scene, 1, resampling::ancestors(), items);
        self.scale(scene, 1, self.particles().to_string());
        let second = |moment: &Moment| f64::from(of(moment, back)) / m;
        let value = |moment: &Moment| of(moment, u32::MAX).to_string();
        self.curves(scene, 1, &|moment| f64::from(of(moment, u32::MAX)) / m, Some(&second), &value);
        self.predicted(scene);
    }

    /// Position errors of the best particle, and of the policy that is chosen those of the weighted mean.
    fn errors(&self, scene: &mut Scene) {
        // Three digits, for want of room.
        let metres = |x: f64| fixed(x, if x < 10.0 { 2 } else { 1 });
        let mean = metres(self.model.read(self.chosen()).report.error_mean);
        let sample = Sample::line(stroke::role(self.chosen()), 1.0, Some(SECOND));
        self.label(scene, 2, resampling::error(), vec![(sample, resampling::MeanIs { error: &mean }.say())]);
        self.scale(scene, 2, write(self.error_scale));
        let second = |moment: &Moment| moment.report.error_mean / self.error_scale;
        let first = |moment: &Moment| moment.report.error_best / self.error_scale;
        self.curves(scene, 2, &first, Some(&second), &|moment| metres(moment.report.error_best));
    }
}
