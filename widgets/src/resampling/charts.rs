//! One filter in its column: its name, and N_eff, lineage and errors over the steps.

use super::{
    layout::{CHARTS, Column},
    model::{Moment, ResamplingModel, SELECTIVE},
};
use crate::decimal::{fixed, write};
use crate::{
    font::{self, Weight},
    model::Model,
    panels::Panels,
    scene::{Anchor, Chart, Mark, Point, Rect, Role, Scene, heading, n_eff, text},
    words::{common, resampling},
};

/// Font size of what is written above the charts \[css px\].
pub const SIZE: f64 = 11.5;

/// Dash and gap of the second curve of a chart and of the threshold, and from dot to dot where something happens \[css px\].
pub const SECOND: [f64; 2] = [4.0, 3.0];
pub const THRESHOLD: [f64; 2] = [2.0, 2.0];
const EVENT: f64 = 4.0;

/// The end of the axis for errors up to this \[m\]: a round number.
pub fn error_scale(largest: f64) -> f64 {
    [0.2, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0]
        .into_iter()
        .find(|end| largest <= *end)
        .unwrap_or(50.0)
}

/// Names of the filters.
pub const NAMES: [fn() -> &'static str; 3] = [resampling::never, resampling::every_step, resampling::selective];

/// One filter in its column.
pub struct Filter<'a> {
    pub model: &'a ResamplingModel,
    pub policy: usize,
    pub column: &'a Column,
    /// End of the axis of errors \[m\].
    pub error_scale: f64,
}

impl Filter<'_> {
    /// A chart, by its rank.
    pub fn chart(&self, rank: usize) -> Chart {
        Chart { area: self.column.charts[rank], last: self.model.step_count() }
    }

    pub fn particles(&self) -> usize {
        self.model.setup().particles
    }

    /// Its name, and the charts that are shown.
    pub fn charts(&self, scene: &mut Scene, panels: &Panels) {
        if CHARTS.iter().any(|name| panels.has(name)) {
            self.header(scene);
            self.cursor(scene);
        }
        let draw = [Self::ess, Self::lineage, Self::errors, Self::tree];
        for (draw, _) in draw.iter().zip(CHARTS).filter(|(_, name)| panels.has(name)) {
            draw(self, scene);
        }
        if CHARTS.iter().any(|name| panels.has(name)) {
            self.axis(scene);
        }
    }

    fn header(&self, scene: &mut Scene) {
        let Rect { x, y, w, h } = self.column.header;
        let step = resampling::StepIs { step: &self.model.cursor() }.say();
        let role = if self.model.looks_back() { Role::Accent } else { Role::Muted };
        let step_width = font::measure(&step, 12.5, Weight::Regular) + 2.0;
        let rest = match self.policy {
            0 => resampling::only_multiply().into(),
            1 => resampling::weights_reset().into(),
            _ => resampling::Below { threshold: &write(self.model.setup().threshold) }.say(),
        };
        let title = Rect::new(x, y, w - step_width - 8.0, h);
        let name = NAMES[self.policy]();
        let room = title.w - font::measure(name, 13.5, Weight::SemiBold) - 8.0;
        let rest = if font::measure(&rest, 12.5, Weight::Regular) < room { &rest } else { "" };
        heading(scene, &title, (name, Role::Ink), rest);
        let area = Rect::new(x + w - step_width, y, step_width, h);
        scene.marks.push(text(area, Anchor::End, 12.5, Weight::Regular, role, step));
    }

    /// A line through all charts at the step read, and at what happens on the course.
    fn cursor(&self, scene: &mut Scene) {
        let through = |step: u32| {
            let x = self.chart(0).x(step);
            self.column.charts.iter().filter(|chart| chart.h > 0.0).map(move |chart| (x, chart.y, chart.bottom()))
        };
        let events = self.events().into_iter().flat_map(|(step, _)| through(step));
        let dots = events.flat_map(|(x, y0, y1)| {
            let count = ((y1 - y0) / EVENT) as usize;
            (0..count).map(move |k| y0 + EVENT * k as f64).map(move |y| vec![[x, y], [x, y + 1.0]])
        });
        scene.marks.push(Mark::Lines { lines: dots.collect(), width: 1.0, dash: None, role: Role::Muted });
        let role = if self.model.looks_back() { Role::Accent } else { Role::Muted };
        let lines = through(self.model.cursor()).map(|(x, y0, y1)| vec![[x, y0], [x, y1]]).collect();
        scene.marks.push(Mark::Lines { lines, width: 1.0, dash: None, role });
    }

    /// Steps of the course that have a name.
    pub fn events(&self) -> Vec<(u32, &'static str)> {
        let run = self.model.run();
        let named = [(run.lost_from(), resampling::lost()), (run.evidence_at(), resampling::sign())];
        named.into_iter().filter_map(|(step, name)| Some((step?, name))).collect()
    }

    /// Name of a chart at the left of its line, and at the right what is written beside its curves.
    pub(super) fn label(&self, scene: &mut Scene, chart: usize, values: &[(String, Weight, Role)]) -> Rect {
        let Rect { x, y, w, h } = self.column.labels[chart];
        let mut right = x + w;
        for (value, weight, role) in values.iter().rev() {
            let width = font::measure(value, SIZE, *weight) + 0.01;
            scene.marks.push(text(
                Rect::new(right - width, y, width, h),
                Anchor::Start,
                SIZE,
                *weight,
                *role,
                value.clone(),
            ));
            right -= width + 8.0;
        }
        Rect::new(x, y, right - x, h)
    }

    pub(super) fn name(&self, scene: &mut Scene, area: &Rect, name: &str) {
        scene.marks.push(text(*area, Anchor::Start, SIZE, Weight::Regular, Role::Muted, name));
    }

    /// A curve over the steps shown, by the share of the chart's height.
    fn curve(&self, chart: usize, height: impl Fn(&Moment) -> f64) -> Vec<Point> {
        self.chart(chart).curve(self.model.history(self.policy).map(|moment| (moment.report.step, height(moment))))
    }

    /// Where N_eff calls for resampling.
    fn threshold(&self, scene: &mut Scene) {
        let Rect { x, w, h, .. } = self.column.charts[0];
        let y = self.column.charts[0].bottom() - h * self.model.setup().threshold;
        let [dash, gap] = THRESHOLD;
        let count = ((w / (dash + gap)) as usize).min(1000); // whatever the width of the figure
        let dashes = (0..count).map(|k| x + (dash + gap) * k as f64);
        let lines = dashes.map(|x| vec![[x, y], [x + dash, y]]).collect();
        let role = if self.policy == SELECTIVE { Role::Accent } else { Role::Muted };
        scene.marks.push(Mark::Lines { lines, width: 1.0, dash: None, role });
    }

    /// Two curves, the second dashed below the first, and dots where the cursor cuts them.
    fn curves(&self, scene: &mut Scene, first: Vec<Point>, second: Option<Vec<Point>>) {
        let at = self.model.cursor() as usize;
        let mut dots = vec![first[at]];
        if let Some(second) = second {
            dots.push(second[at]);
            scene.marks.push(Mark::Lines { lines: vec![second], width: 1.25, dash: Some(SECOND), role: Role::Muted });
        }
        scene.marks.push(Mark::Lines { lines: vec![first], width: 1.5, dash: None, role: Role::Ink });
        scene.marks.push(Mark::Discs { centres: dots, radius: 3.0, role: Role::Ink });
    }

    /// N_eff, the threshold, and the steps that resampled.
    fn ess(&self, scene: &mut Scene) {
        let (m, Moment { report, resampled, .. }) = (self.particles() as f64, self.model.read(self.policy));
        let times = resampling::ResampledTimes { n: resampled }.say();
        let values = [
            (times, Weight::Regular, if *resampled > 0 { Role::Copied } else { Role::Muted }),
            (common::Of { n: &fixed(report.ess, 1), all: &self.particles() }.say(), Weight::SemiBold, Role::Ink),
        ];
        let rest = self.label(scene, 0, &values);
        n_eff(scene, &rest, SIZE, Weight::Regular, Role::Muted);
        scene.marks.extend(self.chart(0).edges());
        self.threshold(scene);
        let curve = self.curve(0, |moment| moment.report.ess / m);
        let history = self.model.history(self.policy).zip(&curve);
        let centres = history.filter(|(moment, _)| moment.report.resampled()).map(|(_, at)| *at).collect();
        self.curves(scene, curve.clone(), None);
        scene.marks.push(Mark::Discs { centres, radius: 1.75, role: Role::Copied });
    }

    /// Distinct ancestors at the start, and some steps back.
    fn lineage(&self, scene: &mut Scene) {
        let (m, back) = (self.particles() as f64, self.model.back());
        let Moment { report, .. } = self.model.read(self.policy);
        let values = [
            (
                resampling::StepsBack { back: &back, n: &report.descent.lineage(back) }.say(),
                Weight::Regular,
                Role::Muted,
            ),
            (resampling::AtStartAre { n: &report.descent.lineage(report.step) }.say(), Weight::SemiBold, Role::Ink),
        ];
        let rest = self.label(scene, 1, &values);
        self.name(scene, &rest, resampling::ancestors());
        scene.marks.extend(self.chart(1).edges());
        let of = |back: u32| self.curve(1, |moment| f64::from(moment.report.descent.lineage(back)) / m);
        self.curves(scene, of(u32::MAX), Some(of(back)));
    }

    /// Position errors of the best particle and of the weighted mean.
    fn errors(&self, scene: &mut Scene) {
        let Moment { report, .. } = self.model.read(self.policy);
        // Three digits, for want of room.
        let metres = |x: f64| fixed(x, if x < 10.0 { 2 } else { 1 });
        let values = [
            (resampling::MeanIs { error: &metres(report.error_mean) }.say(), Weight::Regular, Role::Muted),
            (resampling::BestIs { error: &metres(report.error_best) }.say(), Weight::SemiBold, Role::Ink),
        ];
        let rest = self.label(scene, 2, &values);
        self.name(scene, &rest, &resampling::ErrorTo { metres: &write(self.error_scale) }.say());
        scene.marks.extend(self.chart(2).edges());
        let best = self.curve(2, |moment| moment.report.error_best / self.error_scale);
        let mean = self.curve(2, |moment| moment.report.error_mean / self.error_scale);
        self.curves(scene, best, Some(mean));
    }
}
