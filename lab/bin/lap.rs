//! `fastslam-lab lap`: one lap of the apartment, of the ring, or of the rooms.

use crate::{Usage, graph, print, print_json, whole, write_png};
use anyhow::{Result, bail};
use fastslam::matching::Matcher;
use fastslam::resampling::{ResamplePolicy, Scheme};
use fastslam_cli::ColorType;
use fastslam_lab::experiment::ProposalKind;
use fastslam_lab::experiment::lap::{self, Course, Lap, LapSetup, ScanWeight, StepReport};
use fastslam_lab::world::Edits;
use fastslam_widgets::{paint::Theme, registry};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Drive one lap and report every step
#[derive(clap::Args)]
pub struct Arguments {
    /// Where: apartment (out along its corridor and back), ring (round a block, with a laser that sees 3 m), or rooms (once round an apartment, with the same laser)
    #[arg(long, default_value_t = LapSetup::default().course)]
    course: Course,
    /// Seed of the world's noise and of the filter's
    #[arg(long, default_value_t = LapSetup::default().seed)]
    seed: u64,
    #[command(flatten)]
    options: Options,
    #[command(flatten)]
    graph: graph::GraphOptions,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Paint the end of the lap, as the page would, into this file
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
}

/// What can be set of any lap: those of `fastslam-lab ring` as well.
#[derive(clap::Args)]
pub struct Options {
    /// Number of particles M, 1 to 4096
    #[arg(long, value_name = "M", default_value_t = LapSetup::default().particles, value_parser = whole(lap::PARTICLES), allow_negative_numbers = true)]
    pub particles: usize,
    /// Where new poses are drawn from: aware (of the scan) or motion
    #[arg(long, default_value_t = LapSetup::default().proposal)]
    proposal: ProposalKind,
    /// What a particle pays for a scan: usual (of the proposal), marginal, new-ground-free or old-map-at-draw
    #[arg(long, default_value_t = LapSetup::default().weight)]
    weight: ScanWeight,
    /// What the end point of a beam is compared with: cell or subcell
    #[arg(long, default_value_t = LapSetup::default().matcher)]
    matcher: Matcher,
    /// When to resample: never, always or neff:F, where N_eff < F M
    #[arg(long, default_value_t = LapSetup::default().policy)]
    pub policy: ResamplePolicy,
    /// How to resample: systematic, stratified, multinomial or residual
    #[arg(long, default_value_t = LapSetup::default().scheme)]
    pub scheme: Scheme,
    /// Factor on the standard deviations of the odometry's noise, 0 to 10
    #[arg(long, value_name = "FACTOR", default_value_t = LapSetup::default().odometry_scale, allow_negative_numbers = true)]
    odometry: f64,
    /// Standard deviation of a range [m], 0 to 1
    #[arg(long, value_name = "METRES", default_value_t = LapSetup::default().range_std, allow_negative_numbers = true)]
    range_std: f64,
    /// κ, the share of each beam's log-likelihood that counts, 0.01 to 1
    #[arg(long, value_name = "SHARE", default_value_t = LapSetup::default().temper, allow_negative_numbers = true)]
    temper: f64,
    /// Trust every match, however flat its hill
    #[arg(long)]
    no_guard: bool,
}

impl Options {
    /// The lap of a seed.
    pub fn setup(&self, course: Course, seed: u64) -> LapSetup {
        let &Self { particles, proposal, weight, matcher, policy, scheme, odometry, range_std, temper, no_guard } =
            self;
        let (odometry_scale, guard) = (odometry, !no_guard);
        LapSetup {
            course,
            particles,
            seed,
            proposal,
            weight,
            matcher,
            policy,
            scheme,
            odometry_scale,
            range_std,
            temper,
            guard,
            edits: Edits::default(),
        }
    }
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output {
    steps: Vec<StepReport>,
    /// \[m\]
    rms_best: f64,
    /// \[m\]
    rms_best_aligned: f64,
    /// \[m\]
    rms_odometry: f64,
    /// Of the whole trace: every weight, path, map and report.
    digest: String,
    /// Bytes that went into the digest.
    digest_size: u64,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let setup = arguments.options.setup(arguments.course, arguments.seed);
    if arguments.graph.method == graph::Method::Graph {
        if arguments.png.is_some() {
            bail!(Usage("--png paints the particle filter: not with --method graph".into()));
        }
        return graph::run(&setup, &arguments.graph, arguments.json);
    }
    arguments.graph.only_of_graphs()?;
    let lap = Lap::new(&setup)?;
    if let Some(path) = &arguments.png {
        paint(&setup, path)?;
    }
    let mut steps = Vec::new();
    let (lap, digest) = lap.run(|report| steps.push(report.clone()));
    let report = lap.report();
    let output = Output {
        steps,
        rms_best: report.rms_best,
        rms_best_aligned: report.rms_best_aligned,
        rms_odometry: report.rms_odometry,
        digest: format!("{:016x}", digest.value()),
        digest_size: digest.size(),
    };
    if arguments.json { print_json(&output) } else { print(&summary(&setup, &output)) }
}

fn summary(setup: &LapSetup, output: &Output) -> String {
    let last = &output.steps[output.steps.len() - 1];
    let resampled = output.steps.iter().filter(|step| step.ancestors.is_some()).count();
    let LapSetup { course, particles, seed, proposal, matcher, policy, scheme, .. } = setup;
    format!(
        "{course}, {} steps: {particles} particles, seed {seed}, proposal {proposal}, matcher {matcher}, policy {policy} ({scheme})\n\
         RMS position error of the best    {:8.3} m\n\
         the same after rigid alignment    {:8.3} m\n\
         RMS position error of odometry    {:8.3} m\n\
         N_eff at the end                  {:8.1} of {particles}\n\
         steps that resampled              {resampled:8}\n\
         lineage (ancestors of the start)  {:8}\n\
         maps                              {:8.1} kB, {:.1} kB as dense copies\n\
         digest                            {}\n",
        output.steps.len() - 1,
        output.rms_best,
        output.rms_best_aligned,
        output.rms_odometry,
        last.ess,
        last.lineage,
        last.map_bytes_unique as f64 / 1e3,
        last.map_bytes_dense as f64 / 1e3,
        output.digest,
    )
}

/// Paints the figure `<fastslam-lap>` at the end of this lap.
fn paint(setup: &LapSetup, path: &Path) -> Result<()> {
    let mut figure = registry::figure("fastslam-lap")?;
    // The figure has the two parts of neff:F apart.
    let policy = setup.policy.to_string();
    let (policy, threshold) =
        policy.split_once(':').map_or((&*policy, None), |(word, fraction)| (word, Some(fraction)));
    for (name, value) in [
        ("course", setup.course.to_string()),
        ("universes", setup.particles.to_string()),
        ("seed", setup.seed.to_string()),
        ("proposal", setup.proposal.to_string()),
        ("matcher", setup.matcher.to_string()),
        ("policy", policy.to_owned()),
        ("scheme", setup.scheme.to_string()),
        ("odometry", setup.odometry_scale.to_string()),
        ("range-std", setup.range_std.to_string()),
        ("temper", setup.temper.to_string()),
        ("guard", if setup.guard { "on" } else { "off" }.to_owned()),
        ("overlay", "off".to_owned()),
        ("truth", "on".to_owned()),
        ("raw", "on".to_owned()),
    ] {
        figure.set(name, &value)?;
    }
    if let Some(threshold) = threshold {
        figure.set("threshold", threshold)?;
    }
    let last = figure.model().step_count();
    figure.model_mut().seek(last);
    while figure.model().pending() > 0 {
        figure.model_mut().work();
    }
    const WIDTH: u32 = 1280;
    const DPR: u32 = 2;
    let height = figure.height(f64::from(WIDTH / DPR)) as u32 * DPR;
    figure.paint(WIDTH, height, f64::from(DPR), Theme::named("light"));
    let canvas = figure.canvas();
    write_png(path, canvas.size(), ColorType::Rgba, |file| file.write_all(canvas.pixels()))
}
