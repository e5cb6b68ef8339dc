//! How far a run is.

use fastslam::mapper::Filter;
use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// How far a run is: a bar on a terminal, and elsewhere a line every ten seconds.
pub struct Progress<'a> {
    name: &'a str,
    bar: ProgressBar,
    /// Scans so far, and in all.
    pub scans: usize,
    pub all: usize,
    /// When a line was last written.
    told: Duration,
}

impl<'a> Progress<'a> {
    pub fn new(name: &'a str, all: usize) -> Self {
        let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} scans, {msg}").expect("the template is right");
        let bar = ProgressBar::new(all as u64).with_style(style);
        Self { name, bar, scans: 0, all, told: Duration::ZERO }
    }

    /// Scans a second.
    fn rate(&self) -> f64 {
        self.scans as f64 / self.bar.elapsed().as_secs_f64().max(1e-3)
    }

    pub fn tell(&mut self, filter: &Filter, effective: f64) {
        /// Between two lines.
        const EVERY: Duration = Duration::from_secs(10);
        let rate = self.rate();
        let to_go = (self.all - self.scans) as f64 / rate;
        let said = || format!("{rate:.0} scans/s, {to_go:.0} s to go");
        if !self.bar.is_hidden() {
            let lineage = filter.lineage();
            let of_particles = format!("{effective:.1} effective particles, which descend from {lineage}");
            self.bar.set_position(self.scans as u64);
            self.bar.set_message(format!("{}; {of_particles}", said()));
        } else if self.bar.elapsed() >= self.told + EVERY {
            self.told = self.bar.elapsed();
            eprintln!("fastslam: {}: {} of {} scans, {}", self.name, self.scans, self.all, said());
        }
    }

    /// How long it has taken so far.
    pub fn elapsed(&self) -> Duration {
        self.bar.elapsed()
    }

    /// How long it took.
    pub fn finish(&self) -> Duration {
        self.bar.finish_and_clear();
        self.bar.elapsed()
    }
}
