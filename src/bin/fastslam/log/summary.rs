//! What a run prints of the map and of its path: for programs, and in words.

use fastslam::mapper::{LaserMapper, LaserMapperSettings, Loop, LoopEnd};
use fastslam_log::{LaserLog, RelationErrors};
use serde::Serialize;
use std::fmt::Write as _;

/// What `--json` prints.
#[derive(Serialize)]
pub(super) struct Output {
    /// In the log.
    pub scans: u32,
    /// That the filter took.
    pub scans_used: u32,
    /// From the first scan to the last \[s\].
    pub elapsed_s: f64,
    /// Scans of the log a second, over that time.
    pub scans_per_s: f64,
    /// What the scan took that took longest \[s\]: by that, and `--remapped-per-scan`, one sees whether a robot can map as it drives.
    pub longest_scan_s: f64,
    /// CPU time of the whole process, from reading the log to writing the results, for each scan taken and particle \[ms\].
    pub ms_per_scan_particle: f64,
    /// What the whole process took of memory at most, from reading the log to writing the results; null where the system does not tell.
    pub peak_process_bytes: Option<u64>,
    /// Of the particles' maps, where one looked.
    pub peak_map_bytes: u64,
    /// At the same time, if every map were kept whole and apart.
    pub dense_map_bytes: u64,
    /// What the maps of before that are kept to find loops by take besides, at their peak.
    pub kept_map_bytes: u64,
    /// Number of the scans that are kept by the end, by which a path that is bent is mapped again.
    pub kept_scans: u32,
    /// What these take.
    pub scan_bytes: u64,
    /// What the paths of all particles and the times of all scans take by the end.
    pub path_bytes: u64,
    #[serde(flatten)]
    pub errors: Option<RelationErrors>,
    pub resampled_fraction: f64,
    /// Steps of odometry that the clock or the scans contradict: they are matched with the scans before.
    pub steps_contradicted: u32,
    /// Mean normalised innovation squared of odometry, against the drift and noise learnt so far: 3 where they are right, less where scans tell less;
    /// null where no scan was matched.
    pub odometry_innovation: Option<f64>,
    /// Share of the steps whose innovation is beyond the 99 % bound.
    pub odometry_innovations_beyond: f64,
    /// What is wrong with the odometry as a whole, or with what is said of the laser; null where nothing is.
    pub odometry_fault: Option<String>,
    /// Scans that no particle explains.
    pub scans_unexplained: u32,
    /// How many times a particle's path was bent, to close a loop that no particle had closed by itself.
    pub paths_bent: u32,
    /// Loops of the best path, in the order in which they were found.
    pub loops: Vec<LoopOutput>,
    /// Number of loops of the best path that stay open.
    pub loops_open: u32,
    /// Share of what the best path saw of places that it came back to that the map of before contradicts.
    pub disputed_fraction: f64,
    /// First scan at which all particles descend from one; null if they never do.
    pub lineage_one_scan: Option<u32>,
    /// By how much more than odometry tells the robot turns to the left \[deg/m\], as it was learnt by the end.
    pub wheel_drift_deg_per_m: f64,
    /// What the heading's standard deviation is after a metre \[deg/m\], likewise.
    pub wheel_heading_std_deg_per_m: f64,
    /// Of the weights and of every particle's path and map.
    pub digest: String,
}

/// A loop of the best path, as it is printed.
#[derive(Default, Serialize)]
pub(super) struct LoopOutput {
    /// Stamp of the scan at which the robot was there first \[s\].
    from: f64,
    /// Stamp of the scan at which it was back \[s\].
    to: f64,
    /// met, bent or open.
    end: &'static str,
    /// How far the later end was moved \[m\].
    shift: Option<f64>,
    /// How much better the scans fit there \[nats an end point\].
    gain: Option<f64>,
    /// Gain at the second-best place \[nats an end point\].
    second: Option<f64>,
    /// Share of the end points that the map of before contradicts.
    disputed: Option<f64>,
}

/// The loops of the best path.
pub(super) fn loops(mapper: &LaserMapper) -> Vec<LoopOutput> {
    let output = |one: &Loop| {
        let time = |step| mapper.at_step(step).map_or(f64::NAN, |(time, _)| time);
        let back = LoopOutput { from: time(one.from), to: time(one.to), ..LoopOutput::default() };
        match one.end {
            LoopEnd::Met => LoopOutput { end: "met", ..back },
            LoopEnd::Bent { shift, gain, second } => {
                LoopOutput { end: "bent", shift: Some(shift), gain: Some(gain), second: Some(second), ..back }
            }
            LoopEnd::Open { disputed } => LoopOutput { end: "open", disputed: Some(disputed), ..back },
        }
    };
    mapper.loops().iter().map(output).collect()
}

/// The same in words.
pub(super) fn summary(settings: &LaserMapperSettings, log: &LaserLog, output: &Output) -> String {
    let mut text = format!(
        "{} scans, of which {} taken: {} particles, seed {}, cells of {} m\n\
         time                              {:8.1} s, {:.0} scans/s\n\
         the scan that took longest        {:8.0} ms\n\
         CPU time per scan and particle    {:8.3} ms\n\
         maps at their peak                {:8.1} MB, {:.1} MB as dense copies, {:.1} MB estimated\n\
         maps of before, to find loops by  {:8.1} MB more\n\
         scans kept, to bend paths by      {:8.1} MB more, of {} scans\n\
         paths of all particles            {:8.1} MB more\n\
         steps that resampled              {:8.0} %\n",
        output.scans,
        output.scans_used,
        settings.particles,
        settings.seed,
        settings.cell_size,
        output.elapsed_s,
        output.scans_per_s,
        1e3 * output.longest_scan_s,
        output.ms_per_scan_particle,
        output.peak_map_bytes as f64 / 1e6,
        output.dense_map_bytes as f64 / 1e6,
        settings.memory_estimate(&log.scans) as f64 / 1e6,
        output.kept_map_bytes as f64 / 1e6,
        output.scan_bytes as f64 / 1e6,
        output.kept_scans,
        output.path_bytes as f64 / 1e6,
        100.0 * output.resampled_fraction,
    );
    if let Some(bytes) = output.peak_process_bytes {
        _ = writeln!(text, "memory of the whole process       {:8.1} MB at its peak", bytes as f64 / 1e6);
    }
    _ = writeln!(
        text,
        "wheels, as learnt: heading drifts by {:.1}° a metre, ± {:.1}°",
        output.wheel_drift_deg_per_m, output.wheel_heading_std_deg_per_m
    );
    if let Some(mean) = output.odometry_innovation {
        _ = writeln!(
            text,
            "odometry against scans: mean normalised innovation squared {mean:.1} (3 where noises are right), {:.1} % of the steps beyond the 99 % bound",
            100.0 * output.odometry_innovations_beyond
        );
    }
    if output.scans_unexplained > 0 {
        _ = writeln!(text, "scans that no particle explains   {:8}", output.scans_unexplained);
    }
    if output.paths_bent > 0 {
        _ = writeln!(text, "paths bent to close a loop        {:8}", output.paths_bent);
    }
    if !output.loops.is_empty() {
        let count = |end| output.loops.iter().filter(|one| one.end == end).count();
        let [met, bent, open] = ["met", "bent", "open"].map(count);
        _ = writeln!(text, "loops of the best path                   met {met}, bent {bent}, open {open}");
        _ = writeln!(text, "of what is seen again, contradicted {:6.1} %", 100.0 * output.disputed_fraction);
    }
    for LoopOutput { from, to, shift, gain, second, disputed, .. } in &output.loops {
        if let (Some(shift), Some(gain), Some(second)) = (shift, gain, second) {
            _ = writeln!(
                text,
                "  bent at {to:.3} s, back where it was at {from:.3} s: by {shift:.2} m; an end point fits better by {gain:.2} nats, at the next best place by {second:.2}"
            );
        }
        if let Some(disputed) = disputed {
            _ = writeln!(
                text,
                "  open at {to:.3} s, near where it was at {from:.3} s: {:.0} % of what is seen contradicts the map",
                100.0 * disputed
            );
        }
    }
    match output.lineage_one_scan {
        Some(scan) => _ = writeln!(text, "all descend from one particle from scan {scan} on"),
        None => text.push_str("the particles never come to descend from one\n"),
    }
    if let Some(errors) = &output.errors {
        _ = writeln!(
            text,
            "errors over {} relations: translation {:.4} ± {:.4} m, rotation {:.2} ± {:.2}°",
            errors.relations,
            errors.translation_mean,
            errors.translation_std,
            errors.rotation_mean_deg,
            errors.rotation_std_deg
        );
    }
    _ = writeln!(text, "fingerprint of paths and maps {}", output.digest);
    text
}
