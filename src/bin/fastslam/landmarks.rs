//! `fastslam landmarks`: FastSLAM 1.0 and 2.0 on simulated courses and recorded logs.

mod gone;
mod many;
mod one;
mod successive;

use self::gone::gone;
use self::many::{Errors, many};
use self::one::one;
use crate::remarks::Outcome;
use crate::settings::{Adjust, SettingsOptions};
use crate::{landmark_graph, mrclam, progress, victoria, whole};
use anyhow::Result;
use fastslam::error::SettingError;
use fastslam::map::landmarks::Correspondence;
use fastslam::motion::Motion;
use fastslam::resampling::ResamplePolicy;
use fastslam_lab::experiment::ProposalKind;
use fastslam_lab::experiment::innovations::{Innovations, Predicts};
use fastslam_lab::experiment::landmarks::{
    self, AssociationSummary, CorrespondenceKind, Course, LandmarkLog, LandmarkReport, LandmarkRun, LandmarkSetup,
    Tuning, WithLandmarks,
};
use fastslam_lab::experiment::{camera, car};
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use std::collections::BTreeSet;
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
    /// Whether each particle learns the drift of the odometry along its path: learnt or none; by default learnt with --g2o, whose noise is told
    /// as if each step erred by itself, and none otherwise, where the noise that is told is wide enough for a drift
    #[arg(long, value_name = "DRIFT", value_parser = learns)]
    drift: Option<bool>,
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

/// Whether the drift of the odometry is learnt.
fn learns(text: &str) -> Result<bool, &'static str> {
    match text {
        "learnt" => Ok(true),
        "none" => Ok(false),
        _ => Err("must be learnt or none"),
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

/// What a command runs: a log for each seed, and what the filters are told.
struct Task<D: Motion, F> {
    log: F,
    tuning: Tuning<D>,
    /// Whether every seed has the same log.
    recorded: bool,
    /// Where the tuning comes from.
    noises: String,
    /// What is to be told of the log.
    remarks: Vec<String>,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let noises = arguments.settings.read()?;
    let named = arguments.association == CorrespondenceKind::Known;
    let told = |from: &str| if noises.is_empty() { from.into() } else { format!("{from}, and as set") };
    if let Some(prefix) = &arguments.mrclam {
        let tuning = noises.adjust(camera::tuning())?;
        let (log, remarks) = mrclam::read(prefix, &tuning, named)?;
        let log = Arc::new(log);
        return Task { log: |_| Arc::clone(&log), tuning, recorded: true, noises: told(mrclam::NOISES), remarks }
            .run(arguments);
    }
    if let Some(folder) = &arguments.victoria {
        let tuning = noises.adjust(car::tuning())?;
        let (log, remarks) = victoria::read(folder, &tuning.motion, &tuning.sensor, named)?;
        let log = Arc::new(log);
        return Task { log: |_| Arc::clone(&log), tuning, recorded: true, noises: told(victoria::NOISES), remarks }
            .run(arguments);
    }
    if let Some(path) = &arguments.g2o {
        let (log, tuning) = landmark_graph::read(path)?;
        let (log, tuning) = (Arc::new(log), noises.adjust(tuning)?);
        let noises = told(landmark_graph::NOISES);
        return Task { log: |_| Arc::clone(&log), tuning, recorded: true, noises, remarks: Vec::new() }.run(arguments);
    }
    let course = arguments.course;
    let tuning = noises.adjust(course.tuning())?;
    let log = |seed| Arc::new(course.simulate(seed));
    Task { log, tuning, recorded: false, noises: told("those of the course"), remarks: Vec::new() }.run(arguments)
}

impl<D, F> Task<D, F>
where
    D: Motion + Adjust + Clone + Send,
    D::Control: Clone + Send,
    F: Fn(u64) -> Arc<LandmarkLog<D::Control>> + Sync,
{
    fn run(&self, arguments: &Arguments) -> Result<()> {
        // A graph tells the noise of its odometry without the drift.
        if arguments.drift.unwrap_or(arguments.g2o.is_some()) {
            self.run_of(arguments, LandmarkRun::learning)
        } else {
            self.run_of(arguments, LandmarkRun::new)
        }
    }

    /// By how many times successive looks differ more than the noises that are told allow.
    fn excess(&self, arguments: &Arguments, log: &LandmarkLog<D::Control>) -> f64 {
        // Where landmarks have names, innovations tell it.
        let is_asked = arguments.association == CorrespondenceKind::Unknown;
        if is_asked { successive::excess(log, &self.tuning.motion, &self.tuning.sensor) } else { 1.0 }
    }

    /// Runs the command with filters that begin by this function.
    fn run_of<M, P>(
        &self,
        arguments: &Arguments,
        begin: impl Fn(
            &LandmarkSetup,
            &Tuning<D>,
            Arc<LandmarkLog<D::Control>>,
        ) -> Result<LandmarkRun<D, M, P>, SettingError>
        + Sync,
    ) -> Result<()>
    where
        M: WithLandmarks,
        P: Predicts<M, Control = D::Control>,
    {
        let setup = |seed| LandmarkSetup {
            particles: arguments.particles,
            seed,
            proposal: arguments.proposal,
            correspondence: arguments.association,
            policy: arguments.policy,
            ..LandmarkSetup::default()
        };
        let run = |seed| begin(&setup(seed), &self.tuning, (self.log)(seed));
        let late = arguments.late.map(|window| window.unwrap_or(car::WINDOW));
        let rms_late = |run: &LandmarkRun<D, M, P>, setup: &_| {
            late.map(|window| run.rms_late(setup, &self.tuning, window)).transpose()
        };
        let Some(seeds) = arguments.seeds else {
            let run = run(arguments.seed)?;
            let setup = setup(arguments.seed);
            let others = Others {
                ekf: run.rms_ekf(&setup, &self.tuning),
                late: rms_late(&run, &setup)?,
                excess: self.excess(arguments, run.log()),
            };
            return one(arguments, run, others, (&self.noises, &self.remarks));
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
                let (mut innovations, mut steps) = (Innovations::default(), Steps::default());
                while let Some(report) = innovations.step(&mut run) {
                    steps.add(&report);
                }
                let others = Others {
                    ekf: recorded.unwrap_or_else(|| run.rms_ekf(&setup(*seed), &self.tuning)),
                    late: rms_late(&run, &setup(*seed))?,
                    excess: self.excess(arguments, run.log()),
                };
                let path = [run.rms_best(), run.rms_best_aligned(), run.rms_odometry()];
                let outcome = Outcome { ekf: others.ekf, excess: others.excess, ..outcome(&run, &innovations, steps) };
                Ok(Errors { online: run.rms_online(), others, path, outcome })
            })
            .collect();
        many(arguments, &errors?, (&self.noises, &self.remarks), D::NAMES)
    }
}

/// What the errors of the mean as it went are held against \[m\].
struct Others {
    ekf: f64,
    late: Option<f64>,
    /// [`Outcome::excess`].
    excess: f64,
}

/// What is counted of the steps of a run.
#[derive(Clone, Copy, Default)]
struct Steps {
    taken: u32,
    /// Landmarks that were founded, by the best particles.
    founded: u32,
    /// Most successive steps, and those up to now, without a landmark of the map in view.
    blind: u32,
    blind_now: u32,
}

impl Steps {
    fn add(&mut self, report: &LandmarkReport) {
        let AssociationSummary { again, first, .. } = report.best;
        self.taken += 1;
        self.founded += first;
        self.blind = self.blind.max(self.blind_now);
        self.blind_now = if again > 0 { 0 } else { self.blind_now + 1 };
    }
}

/// What is known of a run at its end.
fn outcome<D, M, P>(run: &LandmarkRun<D, M, P>, innovations: &Innovations, steps: Steps) -> Outcome
where
    D: Motion + Clone,
    M: WithLandmarks,
    P: Predicts<M, Control = D::Control>,
{
    let map = run.particles()[run.best()].map.landmarks();
    let sighted = run.log().sightings.iter().flatten();
    let names: Vec<u32> = sighted.clone().filter_map(|feature| feature.signature).collect();
    let (named, seen) = (names.len(), names.into_iter().collect::<BTreeSet<u32>>());
    // Where most have no name, names do not tell what was there.
    let seen = if 2 * named < sighted.count() { BTreeSet::new() } else { seen };
    let unknown = matches!(map.correspondence(), Correspondence::Unknown(_));
    // Only by their names are those of the map known to be those that were seen; else the filter strikes them off by itself.
    let named_map = map.iter().filter(|_| !unknown).map(|(index, landmark)| (index, landmark.mean));
    let gone = gone(&run.path(run.best()), &run.log().sightings, named_map, map.sensor());
    let count = |features: u32| f64::from(features);
    Outcome {
        innovations: (innovations.count(), innovations.mean(), innovations.share_beyond()),
        unknown,
        drift: run.drift(),
        left: map.iter().count() as f64,
        founded: f64::from(steps.founded),
        blind: f64::from(steps.blind.max(steps.blind_now)) / f64::from(steps.taken.max(1)),
        errors: [run.rms_online(), run.rms_odometry()],
        there: seen.len() as f64,
        contradicting: if unknown { 0.0 } else { count(innovations.contradicting()) },
        gone: gone as f64,
        founded_again: count(innovations.founded().values().sum()) - innovations.founded().len() as f64,
        named: named as f64,
        range_std: map.sensor().range_std,
        ..Outcome::default()
    }
}

/// Says remarks on standard error: they leave the exit status as it is.
fn say(remarks: &[String]) {
    remarks.iter().for_each(|remark| eprintln!("fastslam: {remark}"));
}

fn drift_row(drift: Option<[f64; 2]>) -> String {
    let row = |[a_metre, a_turn]: [f64; 2]| {
        let (degrees, share) = (a_metre.to_degrees(), 100.0 * a_turn);
        format!("drift of the odometry, learnt     {degrees:+8.3} °/m, {share:+.1} % of turns\n")
    };
    drift.map(row).unwrap_or_default()
}

fn innovation_row(innovation: Option<f64>) -> String {
    let row = |mean| format!("mean normalised innovation²       {mean:8.2} (2 is expected)\n");
    innovation.map(row).unwrap_or_default()
}
