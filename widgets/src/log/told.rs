//! What is told of a log: the sentence, the readouts and the data.

use super::{
    challenges,
    model::{LogModel, Moment},
    opened::Opened,
};
use crate::challenge::Challenge;
use crate::decimal::{fixed, write};
use crate::model::{Column, Model, Readout, Series, Tells};
use crate::told::megabytes;
use crate::told::unexplained;
use crate::unread;
use crate::words::{common, log as words};
use fastslam::mapper::{LaserMapper, Replay};
use fastslam_lab::experiment::log::digest;
use fastslam_log::LaserLog;

impl Tells for LogModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let (m, step) = (self.setup().particles, self.step());
        let moment = self.history().last();
        let of_m = |x: Option<f64>, decimals| {
            let x = x.unwrap_or(f64::NAN);
            (x, common::Of { n: &fixed(x, decimals), all: &m }.say())
        };
        let (ess, ess_text) = of_m(moment.map(|moment| moment.ess), 1);
        let (lineage, lineage_text) = of_m(moment.map(|moment| moment.lineage.into()), 0);
        let resampled = self.history().iter().filter(|moment| moment.resampled).count();
        let apart = self.apart().unwrap_or(f64::NAN);
        let scan = if self.opened().is_some() { f64::from(step) } else { f64::NAN };
        let shared = moment.map_or(f64::NAN, |moment| moment.shared.into());
        let memory = |name, title, bytes: f64, help| {
            let bytes = if bytes > 0.0 { bytes } else { f64::NAN };
            Readout::new(name, title, bytes / 1e6, megabytes(bytes), "MB", help)
        };
        let done = step > 0 && step == self.step_count();
        let digest =
            self.mapper().filter(|_| done).map_or("–".into(), |mapper| format!("{:016x}", digest(mapper).value()));
        vec![
            Readout::new(
                "scan",
                words::scan(),
                scan,
                common::Of { n: &step, all: &self.step_count() }.say(),
                "",
                words::scan_help(),
            ),
            Readout::new("ess", "N_eff", ess, ess_text, "", common::n_eff_help()),
            Readout::new("apart", words::apart(), apart, fixed(apart, 2), "m", words::apart_help()),
            Readout::new("lineage", words::lineage(), lineage, lineage_text, "", words::lineage_help()),
            Readout::new("shared", words::one_path(), shared, fixed(shared, 0), "", words::one_path_help()),
            Readout::new(
                "resampled",
                words::resampled(),
                if step > 0 { resampled as f64 } else { f64::NAN },
                common::Of { n: &resampled, all: &step }.say(),
                "",
                words::resampled_help(),
            ),
            memory("estimate", words::estimate(), self.estimate().unwrap_or(0.0), words::estimate_help()),
            memory("map_unique", common::memory(), self.peak().unique as f64, words::memory_help()),
            memory("map_dense", common::dense(), self.peak().dense as f64, words::dense_help()),
            Readout {
                name: "digest",
                title: words::fingerprint(),
                value: None,
                text: digest,
                unit: "",
                help: words::fingerprint_help(),
                drawn: false,
            },
        ]
    }

    /// A row for each scan that is mapped, whichever is shown.
    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("scan", "number of the scan, the first being 0"),
            Column::new("time_s", "its stamp in the log [s]"),
            Column::new("x_m", "best path at the end [m]"),
            Column::new("y_m", "best path at the end [m]"),
            Column::new("theta_rad", "best path at the end [rad]"),
            Column::new(
                "mean_increment_nats",
                "log of the weighted mean of what the universes pay for the scan [nats]: of a score, not evidence",
            ),
            Column::new("ess", "effective number of universes before resampling"),
            Column::new("resampled", "1 where the step resampled"),
            Column::new("died_out", "universes without offspring at this resampling"),
            Column::new("lineage_20", "distinct ancestors 20 scans ago"),
            Column::new("shared", "latest scan up to which all universes share one path"),
        ];
        let path = self.mapper().map(LaserMapper::path).unwrap_or_default();
        let row = |(k, (time, pose)): (usize, &(f64, fastslam::geometry::Pose2))| {
            let of = |value: fn(&Moment) -> f64| {
                k.checked_sub(1).and_then(|k| self.all_history().get(k)).map_or(f64::NAN, value)
            };
            vec![
                k as f64,
                *time,
                pose.x,
                pose.y,
                pose.theta,
                of(|m| m.log_evidence),
                of(|m| m.ess),
                of(|m| f64::from(u8::from(m.resampled))),
                of(|m| m.died.into()),
                of(|m| m.lineage.into()),
                of(|m| m.shared.into()),
            ]
        };
        Series { columns: COLUMNS.into(), rows: path.iter().enumerate().map(row).collect() }
    }

    fn describe(&self) -> String {
        match (self.replay(), self.opened()) {
            (Some(replay), _) if self.step() > 0 || self.all_history().is_empty() => progress(self, replay),
            (_, Some(opened)) => told(self, opened),
            _ => words::none_open().into(),
        }
    }
}

/// The log in words, before it is mapped.
fn told(model: &LogModel, opened: &Opened) -> String {
    let (log, setup) = (&opened.log, model.setup());
    let minutes = (log.scans[log.scans.len() - 1].time - log.scans[0].time) / 60.0;
    let scans = words::Scans {
        n: &log.scans.len(),
        beams: &log.scans.iter().map(|scan| scan.ranges.len()).max().unwrap_or(0),
        way: &fixed(opened.way, 0),
        minutes: &fixed(minutes, 0),
    };
    let notes = &log.notes;
    let unknown: u32 = notes.unknown.iter().map(|(_, count)| count).sum();
    let left_out =
        [(notes.malformed, words::malformed()), (unknown, words::other_kinds()), (notes.rear, words::rear_scans())];
    let left_out = left_out.into_iter().filter(|(n, _)| *n > 0);
    let memory = words::TakeAtMost {
        m: &setup.particles,
        cell: &write(setup.cell_size),
        megabytes: &megabytes(model.estimate().unwrap_or(0.0)),
    };
    let mut sentences = vec![scans.say()];
    sentences.extend(left_out.map(|(n, what)| words::LeftOut { what: &what, n: &n }.say()));
    // Of a bag; in the words of whoever read it.
    sentences.extend(notes.remarks.iter().map(|remark| words::Remark { remark: &unread::remark(remark) }.say()));
    sentences.push(memory.say());
    sentences.join(" ")
}

/// How far it is mapped, in words.
fn progress(model: &LogModel, replay: &Replay<LaserLog>) -> String {
    let (step, last) = (model.step(), replay.step_count());
    let m = model.setup().particles;
    let noted = replay.mapper().remarks();
    let noted = noted.iter().map(|remark| words::Remark { remark: &unread::mapped(remark) }.say());
    let Some(moment) = model.history().last() else {
        return [words::start_alike().into()].into_iter().chain(noted).collect::<Vec<String>>().join(" ");
    };
    let mapped =
        if step == last { words::all_mapped().into() } else { words::ScanMapped { step: &step, last: &last }.say() };
    let shared = words::Shared { ess: &fixed(moment.ess, 1), m: &m, shared: &moment.shared }.say();
    let died = match model.history().iter().rposition(|moment| moment.died > 0) {
        Some(last) => words::DiedAt { scan: &(last + 1), dead: &model.history()[last].died, m: &m }.say(),
        None => words::none_died().into(),
    };
    let apart = model.apart().filter(|_| model.compared().is_some());
    let apart = apart.map(|metres| words::OdometryApart { metres: &fixed(metres, 2) }.say());
    let sentences = [Some(mapped), apart, unexplained(moment.log_evidence), Some(shared), Some(died)];
    sentences.into_iter().flatten().chain(noted).collect::<Vec<_>>().join(" ")
}
