//! `fastslam landmarks`: FastSLAM 1.0 and 2.0 on simulated courses and recorded logs.

use crate::settings::SettingsOptions;
use crate::{landmark_graph, mrclam, picture, print, print_json, progress, victoria, whole};
use anyhow::Result;
use fastslam::motion::Motion;
use fastslam::resampling::ResamplePolicy;
use fastslam_lab::experiment::ErrorSummary;
use fastslam_lab::experiment::ProposalKind;
use fastslam_lab::experiment::landmarks::{
    self, CorrespondenceKind, Course, LandmarkLog, LandmarkReport, LandmarkRun, LandmarkSetup, Tuning,
};
use fastslam_lab::experiment::{camera, car};
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;

/// Run FastSLAM among landmarks, and report its error
#[derive(clap::Args)]
pub struct Arguments {
    /// Number of particles M, 1 to 100000
    #[arg(long, value_name = "M", default_value_t = LandmarkSetup::default().particles, value_parser = whole(landmarks::PARTICLES), allow_negative_numbers = true)]
    particles: usize,
    /// Seed of the world's noise and of the filter's
    #[arg(long, default_value_t = LandmarkSetup::default().seed)]
    seed: u64,
    /// FastSLAM 1.0 (poses from the motion model) or 2.0 (from the measurement too)
    #[arg(long, default_value = "2.0", value_parser = version)]
    proposal: ProposalKind,
    /// Whether the filter may read which landmark it sees: known or unknown
    #[arg(long, default_value_t = LandmarkSetup::default().correspondence)]
    association: CorrespondenceKind,
    /// When to resample: never, always or neff:F, where N_eff < F M
    #[arg(long, default_value_t = LandmarkSetup::default().policy)]
    policy: ResamplePolicy,
    /// The simulated course: eight, tags (the setting of PythonRobotics) or wings (two that look the same)
    #[arg(long, default_value_t = Course::Eight)]
    course: Course,
    /// Read a UTIAS MRCLAM log instead: PREFIX-robot1-odometry.dat, -robot1-measurement.dat, -robot1-groundtruth.dat,
    /// PREFIX-barcodes.dat, PREFIX-landmarks.dat
    #[arg(long, value_name = "PREFIX", conflicts_with = "course")]
    mrclam: Option<PathBuf>,
    /// Read the log of a car instead, as that of Victoria Park is passed on: a folder with DRS.txt, GPS.txt, and LASER.txt or SIGHTINGS.txt
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["course", "mrclam"])]
    victoria: Option<PathBuf>,
    /// Read a landmark graph in the format of g2o instead
    #[arg(long, value_name = "FILE", conflicts_with_all = ["course", "mrclam", "victoria"])]
    g2o: Option<PathBuf>,
    /// Also run FastSLAM 2.0 that draws its poses late: so many together, when so many steps after them are seen. With known correspondence particles
    /// so outlive a loop even if a single step's sightings say little
    #[arg(long, value_name = "DRAWN,AHEAD", num_args = 0..=1, value_parser = late)]
    late: Option<Option<[u32; 2]>>,
    /// Run seeds 1 to N, and report median, 90th percentile and worst
    #[arg(long, value_name = "N", conflicts_with_all = ["seed", "png"], value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: Option<u64>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    settings: SettingsOptions,
    /// Draw the end of the run into this file
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
}

/// How many poses are drawn together, and how many steps are seen before.
fn late(text: &str) -> Result<[u32; 2], &'static str> {
    let numbers = text.split_once(',').map(|(drawn, ahead)| (drawn.trim().parse(), ahead.trim().parse()));
    match numbers {
        Some((Ok(drawn @ 1..=1000), Ok(ahead @ 0..=1000))) => Ok([drawn, ahead]),
        _ => Err("must be two whole numbers, the first from 1 to 1000, the second from 0 to 1000, as 4,4"),
    }
}

/// The proposal of a version of FastSLAM.
fn version(text: &str) -> Result<ProposalKind, &'static str> {
    match text {
        "1.0" => Ok(ProposalKind::Motion),
        "2.0" => Ok(ProposalKind::Improved),
        _ => Err("must be 1.0 or 2.0"),
    }
}

/// What `--json` prints of one run.
#[derive(Serialize)]
struct Output {
    /// Where the noises that the filters are told come from.
    noises: String,
    /// Of the best particle's path at the end \[m\].
    rms_best: f64,
    /// \[m\]
    rms_best_aligned: f64,
    /// \[m\]
    rms_odometry: f64,
    /// RMS over the steps of the errors of the weighted mean, each when it was made \[m\].
    rms_online: f64,
    /// The same of EKF-SLAM on the same drive \[m\].
    rms_ekf: f64,
    /// The same of FastSLAM 2.0 that draws late \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    rms_late: Option<f64>,
    /// In the best particle's map.
    landmarks: u32,
    /// Share of the steps that resampled.
    resampled_fraction: f64,
    map_bytes_unique: u64,
    map_bytes_dense: u64,
    steps: Vec<LandmarkReport>,
}

/// What `--json` prints of many: errors of position \[m\].
#[derive(Serialize)]
struct Summary {
    seeds: usize,
    /// Where the noises that the filters are told come from.
    noises: String,
    /// RMS over the steps of the errors of the weighted mean, each when it was made.
    online: ErrorSummary,
    /// The same of EKF-SLAM on the same drives.
    ekf: ErrorSummary,
    /// The same of FastSLAM 2.0 that draws late.
    #[serde(skip_serializing_if = "Option::is_none")]
    late: Option<ErrorSummary>,
    /// RMS of the best particle's path at the end.
    best: ErrorSummary,
    /// The same after the best rigid alignment.
    best_aligned: ErrorSummary,
    /// RMS of raw odometry.
    odometry: ErrorSummary,
    /// How many landmarks the best particle's map has at the end.
    landmarks: ErrorSummary,
}

/// What a command runs: a log for each seed, and what the filters are told.
struct Task<D: Motion, F> {
    log: F,
    tuning: Tuning<D>,
    /// Whether every seed has the same log.
    recorded: bool,
    /// Where the tuning comes from.
    noises: String,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let noises = arguments.settings.read()?;
    let told = |from: &str| if noises.is_empty() { from.into() } else { format!("{from}, and as set") };
    if let Some(prefix) = &arguments.mrclam {
        let log = Arc::new(mrclam::read(prefix)?);
        let tuning = noises.adjust(camera::tuning())?;
        return Task { log: |_| Arc::clone(&log), tuning, recorded: true, noises: told(mrclam::NOISES) }.run(arguments);
    }
    if let Some(folder) = &arguments.victoria {
        let tuning = noises.adjust(car::tuning())?;
        let named = arguments.association == CorrespondenceKind::Known;
        let log = Arc::new(victoria::read(folder, &tuning.motion, named)?);
        return Task { log: |_| Arc::clone(&log), tuning, recorded: true, noises: told(victoria::NOISES) }
            .run(arguments);
    }
    if let Some(path) = &arguments.g2o {
        let (log, tuning) = landmark_graph::read(path)?;
        let (log, tuning) = (Arc::new(log), noises.adjust(tuning)?);
        let noises = told(landmark_graph::NOISES);
        return Task { log: |_| Arc::clone(&log), tuning, recorded: true, noises }.run(arguments);
    }
    let course = arguments.course;
    let tuning = noises.adjust(course.tuning())?;
    let log = |seed| Arc::new(course.simulate(seed));
    Task { log, tuning, recorded: false, noises: told("those of the course") }.run(arguments)
}

impl<D, F> Task<D, F>
where
    D: Motion + Clone + Send,
    D::Control: Clone + Send,
    F: Fn(u64) -> Arc<LandmarkLog<D::Control>> + Sync,
{
    fn run(&self, arguments: &Arguments) -> Result<()> {
        let setup = |seed| LandmarkSetup {
            particles: arguments.particles,
            seed,
            proposal: arguments.proposal,
            correspondence: arguments.association,
            policy: arguments.policy,
            ..LandmarkSetup::default()
        };
        let run = |seed| LandmarkRun::new(&setup(seed), &self.tuning, (self.log)(seed));
        let late = arguments.late.map(|window| window.unwrap_or(car::WINDOW));
        let rms_late =
            |run: &LandmarkRun<D>, setup: &_| late.map(|window| run.rms_late(setup, &self.tuning, window)).transpose();
        let Some(seeds) = arguments.seeds else {
            let run = run(arguments.seed)?;
            let setup = setup(arguments.seed);
            let others = Others { ekf: run.rms_ekf(&setup, &self.tuning), late: rms_late(&run, &setup)? };
            return one(arguments, run, others, &self.noises);
        };
        let first = run(1)?; // refused before anything is run, if it is
        // EKF-SLAM draws nothing: on a recorded log it is the same for every seed.
        let recorded = self.recorded.then(|| first.rms_ekf(&setup(1), &self.tuning));
        let seeds: Vec<u64> = (1..=seeds).collect();
        let errors: Result<Vec<Errors>> = seeds
            .par_iter()
            .progress_with(progress(seeds.len(), "runs"))
            .map(|seed| {
                let mut run = run(*seed)?;
                while run.step().is_some() {}
                let others = Others {
                    ekf: recorded.unwrap_or_else(|| run.rms_ekf(&setup(*seed), &self.tuning)),
                    late: rms_late(&run, &setup(*seed))?,
                };
                let path = [run.rms_best(), run.rms_best_aligned(), run.rms_odometry()];
                let landmarks = run.particles()[run.best()].map.iter().count() as f64;
                Ok(Errors { online: run.rms_online(), others, path, landmarks })
            })
            .collect();
        many(arguments, &errors?, &self.noises)
    }
}

/// What the errors of the mean as it went are held against \[m\].
struct Others {
    ekf: f64,
    late: Option<f64>,
}

/// What is kept of one of many runs \[m\].
struct Errors {
    online: f64,
    others: Others,
    /// Of the best particle's path at the end, of the same aligned, and of raw odometry.
    path: [f64; 3],
    /// Landmarks in the best particle's map at the end.
    landmarks: f64,
}

fn one<D: Motion + Clone>(arguments: &Arguments, mut run: LandmarkRun<D>, others: Others, noises: &str) -> Result<()> {
    let mut steps = Vec::new();
    while let Some(report) = run.step() {
        steps.push(report);
    }
    if let Some(path) = &arguments.png {
        picture::save(&picture::of_landmarks(&run), path)?;
    }
    let footprint = run.footprint();
    let resampled = steps.iter().filter(|step| step.ancestors.is_some()).count();
    let output = Output {
        noises: noises.into(),
        rms_best: run.rms_best(),
        rms_best_aligned: run.rms_best_aligned(),
        rms_odometry: run.rms_odometry(),
        rms_online: run.rms_online(),
        rms_ekf: others.ekf,
        rms_late: others.late,
        landmarks: run.particles()[run.best()].map.iter().count() as u32,
        resampled_fraction: resampled as f64 / steps.len().max(1) as f64,
        map_bytes_unique: footprint.unique,
        map_bytes_dense: footprint.dense,
        steps,
    };
    if arguments.json {
        return print_json(&output);
    }
    let late =
        output.rms_late.map(|late| format!("the same, where poses are drawn late{late:6.3} m\n")).unwrap_or_default();
    print(&format!(
        "{} steps, {} particles; noises {noises}\n\
         RMS error as it went, of the mean {:8.3} m, of EKF-SLAM {:.3} m\n\
         {late}\
         the best path at the end          {:8.3} m\n\
         the same after rigid alignment    {:8.3} m\n\
         raw odometry                      {:8.3} m\n\
         landmarks in the best map         {:8} (there are {})\n\
         steps that resampled              {:8.0} %\n\
         maps                              {:8.1} kB, {:.1} kB as dense copies\n",
        output.steps.len(),
        arguments.particles,
        output.rms_online,
        output.rms_ekf,
        output.rms_best,
        output.rms_best_aligned,
        output.rms_odometry,
        output.landmarks,
        run.log().landmarks.len(),
        100.0 * output.resampled_fraction,
        output.map_bytes_unique as f64 / 1e3,
        output.map_bytes_dense as f64 / 1e3,
    ))
}

fn many(arguments: &Arguments, errors: &[Errors], noises: &str) -> Result<()> {
    let spread = |of: &dyn Fn(&Errors) -> f64| ErrorSummary::of(&errors.iter().map(of).collect::<Vec<f64>>());
    let summary = Summary {
        seeds: errors.len(),
        noises: noises.into(),
        online: spread(&|errors| errors.online),
        ekf: spread(&|errors| errors.others.ekf),
        late: arguments.late.map(|_| spread(&|errors| errors.others.late.unwrap_or(f64::NAN))),
        best: spread(&|errors| errors.path[0]),
        best_aligned: spread(&|errors| errors.path[1]),
        odometry: spread(&|errors| errors.path[2]),
        landmarks: spread(&|errors| errors.landmarks),
    };
    if arguments.json {
        return print_json(&summary);
    }
    let row = |name: &str, ErrorSummary { median, p90, worst, .. }: &ErrorSummary| {
        format!("{name:34}{median:8.3} m median, {p90:.3} m p90, {worst:.3} m worst\n")
    };
    print(
        &[
            format!("{} seeds, {} particles; noises {noises}\n", summary.seeds, arguments.particles),
            row("RMS error as it went, of the mean", &summary.online),
            summary.late.as_ref().map(|late| row("of the mean, poses drawn late", late)).unwrap_or_default(),
            row("of EKF-SLAM as it went", &summary.ekf),
            row("the best path at the end", &summary.best),
            row("the same after rigid alignment", &summary.best_aligned),
            row("raw odometry", &summary.odometry),
            format!(
                "{:34}{:8.0} median, {:.0} p90, {:.0} worst\n",
                "landmarks in the best map", summary.landmarks.median, summary.landmarks.p90, summary.landmarks.worst,
            ),
        ]
        .concat(),
    )
}
