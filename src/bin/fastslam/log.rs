//! `fastslam log`: a recorded log, mapped.

use crate::{Failure, print, print_json};
use fastslam::experiment::log::{LogRun, LogSetup};
use fastslam::log::{parse, parse_relations, relation_errors};
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;

/// Map a recorded log of a robot with a laser (CARMEN format)
#[derive(clap::Args)]
pub struct Arguments {
    /// The log, as text or compressed by gzip
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Number of particles M, 1 to 4096
    #[arg(long, value_name = "M", default_value_t = LogSetup::default().particles)]
    particles: usize,
    /// Seed of the filter's draws
    #[arg(long, default_value_t = LogSetup::default().seed)]
    seed: u64,
    /// True relations between poses to hold the path against
    #[arg(long, value_name = "FILE")]
    relations: Option<PathBuf>,
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Output {
    scans: u32,
    ms_per_scan_particle: f64,
    peak_map_bytes: u64,
    dense_map_bytes: u64,
    translation_mean: f64,
    translation_std: f64,
    rotation_mean_deg: f64,
    resampled_fraction: f64,
    lineage_one_scan: f64,
    digest: String,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let bytes = std::fs::read(&arguments.file).map_err(|e| Failure::file(&arguments.file, e))?;
    let log = Arc::new(parse(&bytes, false).map_err(|e| Failure::usage_of(&arguments.file, e))?);
    let setup = LogSetup { particles: arguments.particles, seed: arguments.seed, ..LogSetup::default() };
    let mut run = LogRun::new(&setup, log.clone())?;
    let cpu = cpu_time::ProcessTime::now();
    let mut peak = run.footprint();
    let mut lineage = 0.0;
    let mut steps = 0;
    let mut matched = 0;
    while let Some(step) = run.step() {
        steps += 1;
        matched += step.matched;
        lineage += f64::from(run.filter().descent().lineage(1));
        if steps % 50 == 0 || steps == run.step_count() {
            let f = run.footprint();
            if f.unique > peak.unique {
                peak = f;
            }
        }
    }
    let ms = cpu.elapsed().as_secs_f64() * 1e3 / f64::from(steps) / arguments.particles as f64;
    eprintln!("matched {:.3} surf", f64::from(matched) / f64::from(steps) / arguments.particles as f64);
    let errors = match &arguments.relations {
        Some(path) => {
            let bytes = std::fs::read(path).map_err(|e| Failure::file(path, e))?;
            relation_errors(
                &run.path(),
                &log.odometry,
                &parse_relations(&bytes).map_err(|e| Failure::usage_of(path, e))?,
            )
        }
        None => Default::default(),
    };
    let output = Output {
        scans: log.scans.len() as u32,
        ms_per_scan_particle: ms,
        peak_map_bytes: peak.unique,
        dense_map_bytes: peak.dense,
        translation_mean: errors.translation_mean,
        translation_std: errors.translation_std,
        rotation_mean_deg: errors.rotation_mean_deg,
        resampled_fraction: f64::from(run.resampled()) / f64::from(steps),
        lineage_one_scan: lineage / f64::from(steps),
        digest: format!("{:016x}", run.digest().value()),
    };
    print_json(&output)?;
    print("")
}
