//! What is told of a log: the sentence, the readouts and the data.

use super::{
    model::{LogModel, Moment},
    opened::Opened,
};
use crate::decimal::{fixed, write};
use crate::model::{Column, Model, Readout, Series, unexplained};
use fastslam::mapper::{LaserMapper, Replay};
use fastslam_lab::experiment::log::digest;

/// What is shown now.
pub fn sentence(model: &LogModel) -> String {
    match (model.replay(), model.opened()) {
        (Some(replay), _) => progress(model, replay),
        (None, Some(opened)) => told(model, opened),
        _ => "No log is open yet. Run the example, or choose or drop a log of your own: a CARMEN log, as text or compressed by gzip.".into(),
    }
}

/// The log in words, before it is mapped.
fn told(model: &LogModel, opened: &Opened) -> String {
    let (log, setup) = (&opened.log, model.setup());
    let minutes = (log.scans[log.scans.len() - 1].time - log.scans[0].time) / 60.0;
    let mut text = format!(
        "{} scans of up to {} beams, over {} m by raw odometry and {} min. ",
        log.scans.len(),
        log.scans.iter().map(|scan| scan.ranges.len()).max().unwrap_or(0),
        fixed(opened.way, 0),
        fixed(minutes, 0)
    );
    let notes = &log.notes;
    let unknown: u32 = notes.unknown.iter().map(|(_, count)| count).sum();
    for (count, what) in [
        (notes.malformed, "malformed lines"),
        (unknown, "messages of other kinds"),
        (notes.rear, "scans of a rear laser"),
    ] {
        if count > 0 {
            text += &format!("Left out: {what}, {count}. ");
        }
    }
    let estimate = model.estimate().unwrap_or(0.0);
    text += &format!(
        "{} universes with cells of {} m take at most {} MB of memory.",
        setup.particles,
        write(setup.cell_size),
        megabytes(estimate)
    );
    text
}

/// How far it is mapped, in words.
fn progress(model: &LogModel, replay: &Replay) -> String {
    let (step, last) = (model.history().len() as u32, replay.step_count());
    let m = model.setup().particles;
    let start = if step == last { "All scans are mapped".into() } else { format!("Scan {step} of {last} is mapped") };
    let Some(moment) = model.history().last() else { return "All universes start alike, with the first scan.".into() };
    let mut text = format!(
        "{start}. {}N_eff is {} of {m}; all universes share one path up to scan {}. ",
        unexplained(moment.log_evidence).map_or_else(String::new, |sentence| sentence + " "),
        fixed(moment.ess, 1),
        moment.shared
    );
    text += &match model.history().iter().rposition(|moment| moment.died > 0) {
        Some(last) => {
            format!("At the last resampling, at scan {}, {} of {m} died out.", last + 1, model.history()[last].died)
        }
        None => "None has died out.".into(),
    };
    text
}

/// The numbers of the state shown.
pub fn readouts(model: &LogModel) -> Vec<Readout> {
    let (m, step) = (model.setup().particles, model.step());
    let moment = model.history().last();
    let of_m = |x: Option<f64>, decimals| {
        let x = x.unwrap_or(f64::NAN);
        (x, format!("{} of {m}", fixed(x, decimals)))
    };
    let (ess, ess_text) = of_m(moment.map(|moment| moment.ess), 1);
    let (lineage, lineage_text) = of_m(moment.map(|moment| moment.lineage.into()), 0);
    let resampled = model.history().iter().filter(|moment| moment.resampled).count();
    let scan = if model.opened().is_some() { f64::from(step) } else { f64::NAN };
    let shared = moment.map_or(f64::NAN, |moment| moment.shared.into());
    let memory = |name, title, bytes: f64, help| {
        let bytes = if bytes > 0.0 { bytes } else { f64::NAN };
        Readout::new(name, title, bytes / 1e6, megabytes(bytes), "MB", help)
    };
    let done = step > 0 && step == model.step_count();
    let digest =
        model.mapper().filter(|_| done).map_or("–".into(), |mapper| format!("{:016x}", digest(mapper).value()));
    vec![
        Readout::new(
            "scan",
            "Scan",
            scan,
            format!("{step} of {}", model.step_count()),
            "",
            "Scans that are mapped, after the first, and all of them.",
        ),
        Readout::new(
            "ess",
            "N_eff",
            ess,
            ess_text,
            "",
            "Effective number of universes before resampling: M if all weigh the same, 1 if one has all the weight.",
        ),
        Readout::new(
            "lineage",
            "Lineage, 20 scans back",
            lineage,
            lineage_text,
            "",
            "Distinct ancestors of the universes 20 scans ago.",
        ),
        Readout::new(
            "shared",
            "One path up to scan",
            shared,
            fixed(shared, 0),
            "",
            "The latest scan at which all universes have one ancestor: up to there they share one path.",
        ),
        Readout::new(
            "resampled",
            "Resampled",
            if step > 0 { resampled as f64 } else { f64::NAN },
            format!("{resampled} of {step}"),
            "",
            "Scans after which the universes were resampled.",
        ),
        memory(
            "estimate",
            "Memory at most",
            model.estimate().unwrap_or(0.0),
            "What maps and paths may take, reckoned from the area that the beams sweep along raw odometry, M and the policy.",
        ),
        memory(
            "map_unique",
            "Memory of the maps",
            model.peak().unique as f64,
            "What all maps held together at the most, shared tiles counted once; looked at every 20 scans.",
        ),
        memory(
            "map_dense",
            "… as dense arrays",
            model.peak().dense as f64,
            "What the maps would have held then if each were an array of its own.",
        ),
        Readout {
            name: "digest",
            title: "Fingerprint",
            value: None,
            text: digest,
            unit: "",
            help: "Of all weights, paths and maps at the end, bit for bit: the command line gives the same for the same log and settings.",
        },
    ]
}

/// A row for each scan that is mapped.
pub fn series(model: &LogModel) -> Series {
    const COLUMNS: &[Column] = &[
        Column::new("scan", "number of the scan, the first being 0"),
        Column::new("time_s", "its stamp in the log [s]"),
        Column::new("x_m", "best path at the end [m]"),
        Column::new("y_m", "best path at the end [m]"),
        Column::new("theta_rad", "best path at the end [rad]"),
        Column::new(
            "log_evidence_nats",
            "log of the evidence as the filter estimates it, by the matcher's score [nats]",
        ),
        Column::new("ess", "effective number of universes before resampling"),
        Column::new("resampled", "1 where the step resampled"),
        Column::new("died_out", "universes without offspring at this resampling"),
        Column::new("lineage_20", "distinct ancestors 20 scans ago"),
        Column::new("shared", "latest scan up to which all universes share one path"),
    ];
    let path = model.mapper().map(LaserMapper::path).unwrap_or_default();
    let row = |(k, (time, pose)): (usize, &(f64, fastslam::geometry::Pose2))| {
        let of =
            |value: fn(&Moment) -> f64| k.checked_sub(1).and_then(|k| model.history().get(k)).map_or(f64::NAN, value);
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

/// In whole MB, or tenths where there are few.
pub fn megabytes(bytes: f64) -> String {
    let megabytes = bytes / 1e6;
    if megabytes < 10.0 { fixed(megabytes, 1) } else { fixed(megabytes, 0) }
}
