//! `fastslam log`: a recorded log, mapped; `fastslam example-log`: one of our own.

use crate::{Usage, in_file, picture, print, print_json, progress, whole};
use anyhow::{Context, Result, bail};
use cpu_time::ProcessTime;
use fastslam::error::SettingError;
use fastslam::geometry::Pose2;
use fastslam::log::{
    BagOptions, BagReader, LaserLog, LogError, LogReader, Notes, RelationErrors, Remark, is_bag, parse_relations,
    relation_errors, write, write_path, write_tum,
};
use fastslam::map::grid::{MapImage, MapImageSettings};
use fastslam::mapper::{
    LaserMapper, LaserMapperSettings, Loop, LoopEnd, OdometryCheck, OdometryFault, OdometryInnovations, Replay,
};
use fastslam::proposal::IncrementalWeight;
use fastslam_lab::experiment::log::{Example, digest};
use flate2::read::MultiGzDecoder;
use serde::Serialize;
use std::fmt::Write as _;
use std::io::{BufRead as _, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Map a recorded log of a robot with a laser: a ROS 2 bag (MCAP), a ROS 1 bag, CARMEN's format, or scans as JSON lines
#[derive(clap::Args)]
pub struct Arguments {
    /// The log; what it is its content tells, not its name. Any of them may be compressed by gzip. It is read piece by piece: of a bag the
    /// scans and the odometry stay in memory, of a log in plain text about as much as it has bytes
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Number of particles M, 1 to 4096. One maps a building of which there is a scan every half metre as well as sixteen, in an eighth of the time;
    /// outdoors, or where scans are a metre apart, sixteen leave the fewest loops open
    #[arg(long, value_name = "M", default_value_t = LaserMapperSettings::default().particles, value_parser = whole(LaserMapperSettings::PARTICLES), allow_negative_numbers = true)]
    particles: usize,
    /// Seed of the filter's draws
    #[arg(long, default_value_t = LaserMapperSettings::default().seed)]
    seed: u64,
    /// What a particle pays for a scan: marginal, new-ground-free or old-map-at-draw
    #[arg(long, default_value_t = LaserMapperSettings::default().weight)]
    weight: IncrementalWeight,
    /// Side of a cell of the map [m], 0.02 to 0.2
    #[arg(long, value_name = "METRES", default_value_t = LaserMapperSettings::default().cell_size, allow_negative_numbers = true)]
    cell: f64,
    /// Ranges beyond this [m], 0.5 to 200, are not matched
    #[arg(long, value_name = "METRES", default_value_t = LaserMapperSettings::default().max_range, allow_negative_numbers = true)]
    max_range: f64,
    /// How far the way is free [m] where nothing is in reach, 0 to 200: a range of +inf in a bag, null in JSON lines. 0: such a beam says
    /// nothing, as what it passed may be glass
    #[arg(long, value_name = "METRES", default_value_t = LaserMapperSettings::default().clear_range, allow_negative_numbers = true)]
    clear_range: f64,
    /// Pass scans over until the robot has driven this far [m], or turned by as many radians, 0 to 5
    #[arg(long, value_name = "METRES", default_value_t = LaserMapperSettings::default().min_travel, allow_negative_numbers = true)]
    min_travel: f64,
    /// Pass malformed lines and messages over, and count them; read a bag that breaks off up to there
    #[arg(long)]
    lenient: bool,
    /// Topic of a bag's scans (sensor_msgs/LaserScan): needed where several have some
    #[arg(long, value_name = "TOPIC")]
    scan_topic: Option<String>,
    /// Topic of a bag's odometry (nav_msgs/Odometry, or tf with a frame odom): needed where several have some
    #[arg(long, value_name = "TOPIC")]
    odometry_topic: Option<String>,
    /// True relations between poses (t1 t2 x y z roll pitch yaw) to hold the path against. A time takes the pose within 0.1 s as
    /// it stands, else the nearest one moved by raw odometry: the rule of the published figures
    #[arg(long, value_name = "FILE")]
    relations: Option<PathBuf>,
    /// Write the best path into this file, in TUM format: time x y z qx qy qz qw
    #[arg(long, value_name = "FILE")]
    trajectory: Option<PathBuf>,
    /// Write the best path into this file as nav_msgs/Path, an MCAP file for Foxglove and ROS 2
    #[arg(long, value_name = "FILE")]
    path_mcap: Option<PathBuf>,
    /// Write the best map as NAME.png, and as the pair NAME.pgm and NAME.yaml that ROS reads
    #[arg(long, value_name = "NAME")]
    map: Option<PathBuf>,
    /// Cells of the written map whose probability of being occupied is above this are occupied, 0.5 to 1: one hit alone gives 0.71
    #[arg(long, value_name = "P", default_value_t = MapImageSettings::default().occupied_threshold, allow_negative_numbers = true)]
    occupied_threshold: f64,
    /// Cells of the written map whose probability of being occupied is below this are free, 0 to 0.5: one pass alone gives 0.40. Cells
    /// between the two thresholds are unknown
    #[arg(long, value_name = "P", default_value_t = MapImageSettings::default().free_threshold, allow_negative_numbers = true)]
    free_threshold: f64,
    /// Radius of the robot [m], 0 to 5: a circle of this size is free in the written map wherever the robot has been; 0: no circle
    #[arg(long, value_name = "METRES", default_value_t = MapImageSettings::default().footprint_radius, allow_negative_numbers = true)]
    footprint_radius: f64,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// Write the example log: our own building, simulated
#[derive(clap::Args)]
pub struct ExampleArguments {
    /// The log to write (CARMEN format)
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Write its true relations into this file
    #[arg(long, value_name = "FILE")]
    relations: Option<PathBuf>,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output {
    /// In the log.
    scans: u32,
    /// That the filter took.
    scans_used: u32,
    /// CPU time of the whole process, from reading the log to writing the results, for each scan taken and particle \[ms\].
    ms_per_scan_particle: f64,
    /// Of the particles' maps, where one looked.
    peak_map_bytes: u64,
    /// At the same time, if every map were kept whole and apart.
    dense_map_bytes: u64,
    /// What the maps of before that are kept to find loops by take besides, at their peak.
    kept_map_bytes: u64,
    #[serde(flatten)]
    errors: Option<RelationErrors>,
    resampled_fraction: f64,
    /// Steps of odometry that the clock or the scans contradict: they are matched with the scans before.
    steps_contradicted: u32,
    /// Mean normalised innovation squared of odometry, against the drift and noise learnt so far: 3 where they are right, less where scans tell less;
    /// null where no scan was matched.
    odometry_innovation: Option<f64>,
    /// Share of the steps whose innovation is beyond the 99 % bound.
    odometry_innovations_beyond: f64,
    /// What is wrong with the odometry as a whole, or with what is said of the laser; null where nothing is.
    odometry_fault: Option<String>,
    /// Scans that no particle explains.
    scans_unexplained: u32,
    /// How many times a particle's path was bent, to close a loop that no particle had closed by itself.
    paths_bent: u32,
    /// Loops of the best path, in the order in which they were found.
    loops: Vec<LoopOutput>,
    /// Number of loops of the best path that stay open.
    loops_open: u32,
    /// Share of what the best path saw of places that it came back to that the map of before contradicts.
    disputed_fraction: f64,
    /// First scan at which all particles descend from one; null if they never do.
    lineage_one_scan: Option<u32>,
    /// By how much more than odometry tells the robot turns to the left \[deg/m\], as it was learnt by the end.
    wheel_drift_deg_per_m: f64,
    /// What the heading's standard deviation is after a metre \[deg/m\], likewise.
    wheel_heading_std_deg_per_m: f64,
    /// Of the weights and of every particle's path and map.
    digest: String,
}

/// Steps between two looks at the memory of the maps, each of which takes as long as some steps: by every 50th, a fifteenth of the time on a campus.
const LOOK_EVERY: u32 = 200;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let Arguments { scan_topic, odometry_topic, lenient, .. } = arguments;
    let options =
        BagOptions { scan_topic: scan_topic.clone(), odometry_topic: odometry_topic.clone(), lenient: *lenient, ..BagOptions::default() };
    let mut log = read(&arguments.file, options)?;
    let relations = match &arguments.relations {
        Some(path) => Some(parse_relations(&bytes_of(path)?).map_err(|error| what(path, error))?),
        None => None,
    };
    // Before minutes of work: whether there is anything to judge. Times are all that this asks of the odometry.
    if let (Some(path), Some(relations)) = (&arguments.relations, &relations)
        && relation_errors(&log.odometry, &log.odometry, relations).is_none()
    {
        let count = relations.len();
        let message =
            format_args!("none of its {count} relations is within the time of the log: are they of another one?");
        bail!(Usage::of_file(path, message));
    }
    let settings = LaserMapperSettings {
        particles: arguments.particles,
        seed: arguments.seed,
        cell_size: arguments.cell,
        max_range: arguments.max_range,
        clear_range: arguments.clear_range,
        min_travel: arguments.min_travel,
        weight: arguments.weight,
        ..LaserMapperSettings::default()
    };
    settings.validate().map_err(by_flag)?;
    let (scans, file) = (log.scans.len(), &arguments.file);
    let repeated = leave_repeated_out(&mut log, file);
    let fault = put_right(&mut log, &settings, file);
    let log = Arc::new(log);
    let mut replay = Replay::new(settings, Arc::clone(&log)).map_err(by_flag)?;
    let rules = MapImageSettings {
        occupied_threshold: arguments.occupied_threshold,
        free_threshold: arguments.free_threshold,
        footprint_radius: arguments.footprint_radius,
    };
    rules.validate().map_err(by_flag)?;
    // Before minutes of work: whether the results can be written.
    let outputs = Outputs::open(arguments)?;

    let bar = progress(replay.len(), "scans").with_style(
        indicatif::ProgressStyle::with_template("{wide_bar} {pos}/{len} scans, {per_sec}, {eta} to go, {msg}")
            .expect("the template is right"),
    );
    let (mut peak, mut kept) = (replay.mapper().footprint(), 0);
    let (mut resampled, mut scans_unexplained, mut innovations) = (0, 0, OdometryInnovations::default());
    while let Some(report) = replay.next() {
        if report.step.is_multiple_of(LOOK_EVERY) || report.step == replay.step_count() {
            let now = replay.mapper().footprint();
            if now.unique > peak.unique {
                peak = now;
            }
            kept = kept.max(replay.mapper().footprint_with_kept().unique - now.unique);
        }
        resampled += u32::from(report.resampled());
        scans_unexplained += u32::from(!report.explained());
        replay.mapper().predicted().into_iter().for_each(|predicted| innovations.add(predicted, &report));
        let lineage = replay.mapper().filter().lineage();
        bar.set_message(format!("N_eff {:.1}, {resampled} resamplings, lineage {lineage}", report.selection_ess));
        bar.inc(1);
    }
    bar.finish_and_clear();

    let mapper = replay.mapper();
    let path = mapper.path();
    outputs.write(mapper, &path, &rules)?;
    let (doubts, remarks): (Vec<_>, Vec<_>) = mapper.remarks().into_iter().partition(|remark| match remark {
        Remark::OpenLoops { .. } | Remark::NothingMet => true,
        Remark::Contradicted { steps, .. } => *steps > mapper.steps() as usize / 3,
        _ => false,
    });
    for remark in remarks {
        eprintln!("fastslam: {}: {remark}", arguments.file.display());
    }
    let steps = mapper.steps();
    let cpu = ProcessTime::now().as_duration();
    let output = Output {
        scans: scans as u32,
        scans_used: steps + 1,
        ms_per_scan_particle: 1e3 * cpu.as_secs_f64() / f64::from(steps + 1) / settings.particles as f64,
        peak_map_bytes: peak.unique,
        dense_map_bytes: peak.dense,
        kept_map_bytes: kept,
        errors: relations.and_then(|relations| relation_errors(&path, &log.odometry, &relations)),
        resampled_fraction: mapper.resampled_fraction(),
        steps_contradicted: mapper.unbelieved().len() as u32,
        odometry_innovation: innovations.mean(),
        odometry_innovations_beyond: innovations.share_beyond(),
        odometry_fault: fault.map(|fault| fault.to_string()),
        scans_unexplained,
        paths_bent: mapper.closings(),
        loops: loops(mapper),
        loops_open: mapper.open_loops().count() as u32,
        disputed_fraction: mapper.disputed_fraction(),
        lineage_one_scan: mapper.single_lineage_since(),
        wheel_drift_deg_per_m: mapper.wheels().drift().to_degrees(),
        wheel_heading_std_deg_per_m: mapper.wheels().heading_std().to_degrees(),
        digest: format!("{:016x}", digest(mapper).value()),
    };
    if arguments.json {
        print_json(&output)?
    } else {
        print(&summary(&settings, &log, &output))?
    }
    let of_fault = "the map may be wrong in size or shape, as scans and odometry contradict each other throughout";
    let of_fault = fault.filter(OdometryFault::doubts_scans).map(|_| of_fault.into());
    let of_repeated =
        (repeated > scans / 2).then(|| "the map is one of few places, as most scans repeat another".into());
    let doubt = doubts.iter().map(ToString::to_string).chain(of_fault).chain(of_repeated).next();
    doubt.map_or(Ok(()), |doubt| Err(Doubtful(format!("{}: {doubt}", arguments.file.display())).into()))
}

/// A log was mapped, and its map is not to be trusted: it contradicts itself, is empty, or scans contradict the log as a whole. Exit status 3.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Doubtful(String);

/// Leaves out the scans that repeat the one before while the robot drives, and says so: how many there were.
fn leave_repeated_out(log: &mut LaserLog, file: &Path) -> usize {
    let Some((count, time)) = log.leave_repeated_out() else { return 0 };
    eprintln!(
        "fastslam: {}: scans that repeat the one before, to the last digit, while odometry moves: {count}, the first at {time:.3} s; they are left out",
        file.display()
    );
    count
}

/// Puts odometry right that scans contradict throughout, and says so: what is wrong with it.
fn put_right(log: &mut LaserLog, settings: &LaserMapperSettings, file: &Path) -> Option<OdometryFault> {
    if log.notes.remarks.iter().any(|remark| matches!(remark, Remark::NoOdometry | Remark::StillOdometry)) {
        return None;
    }
    let fault = OdometryCheck::of(log, settings)?.fault()?;
    fault.put_right(log);
    let done = match fault {
        OdometryFault::Unrelated { .. } => "is taken for none, and each scan is matched with those before",
        _ => "is corrected by that",
    };
    eprintln!("fastslam: {}: {fault} Odometry {done}", file.display());
    Some(fault)
}

/// A loop of the best path, as it is printed.
#[derive(Default, Serialize)]
struct LoopOutput {
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
fn loops(mapper: &LaserMapper) -> Vec<LoopOutput> {
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

/// A refusal by the flag that its reader gave.
fn by_flag(error: SettingError) -> SettingError {
    match error.field() {
        "cell_size" => error.called("cell"),
        "max_range" => error.called("max-range"),
        "clear_range" => error.called("clear-range"),
        "min_travel" => error.called("min-travel"),
        "occupied_threshold" => error.called("occupied-threshold"),
        "free_threshold" => error.called("free-threshold"),
        "footprint_radius" => error.called("footprint-radius"),
        _ => error,
    }
}

/// Writes the example.
pub fn example(arguments: &ExampleArguments) -> Result<()> {
    let example = Example::new(usize::MAX);
    let save = |path: &Path, text: &str| std::fs::write(path, text).with_context(in_file(path));
    let heading =
        "# A simulated building of our own, free to use. CARMEN log: raw odometry, 180 beams over 180 deg, metres.\n";
    save(&arguments.file, &(heading.to_owned() + &write(&example.log)))?;
    if let Some(path) = &arguments.relations {
        let line = |relation: &fastslam::log::Relation| {
            let ([t1, t2], Pose2 { x, y, theta }) = (relation.times, relation.first_from_second);
            format!("{t1:.2} {t2:.2} {x:.6} {y:.6} 0 0 0 {theta:.6}\n")
        };
        save(path, &example.relations.iter().map(line).collect::<String>())?;
    }
    Ok(())
}

fn bytes_of(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).with_context(in_file(path))
}

fn what(path: &Path, error: LogError) -> Usage {
    // Line 0 is the file as a whole.
    if error.line == 0 { Usage::of_file(path, error.problem) } else { Usage::of_file(path, error) }
}

/// Reads a log of any kind, which may be compressed, and says on standard error what of it is not used. The file itself is never whole in
/// memory.
fn read(path: &Path, options: BagOptions) -> Result<LaserLog> {
    if path.is_dir() {
        bail!(Usage::of_file(path, parts(path)));
    }
    let mut file = std::io::BufReader::new(std::fs::File::open(path).with_context(in_file(path))?);
    let compressed = file.fill_buf().with_context(in_file(path))?.starts_with(&[0x1f, 0x8b]);
    let bytes: Box<dyn Read> = if compressed { Box::new(MultiGzDecoder::new(file)) } else { Box::new(file) };
    let failed = |error: std::io::Error| match compressed {
        true => Usage::of_file(path, format_args!("cannot be unpacked: {error}")).into(),
        false => anyhow::Error::new(error).context(path.display().to_string()),
    };
    let mut bytes = std::io::BufReader::new(bytes);
    if let Some(cure) = cure(bytes.fill_buf().map_err(failed)?) {
        bail!(Usage::of_file(path, cure));
    }
    let of_bag = is_bag(bytes.fill_buf().map_err(failed)?);
    let (lenient, bag_topics) = (options.lenient, options.scan_topic.is_some() || options.odometry_topic.is_some());
    let (mut bag, mut text) = (BagReader::new(options), LogReader::new(lenient));
    if bag_topics && !of_bag {
        bail!(Usage::of_file(path, "--scan-topic and --odometry-topic are for bags, which it is not"));
    }
    let mut piece = vec![0; 1 << 16];
    loop {
        match bytes.read(&mut piece) {
            Ok(0) => break,
            Ok(count) if of_bag => bag.push(&piece[..count]),
            Ok(count) => text.push(&piece[..count]),
            Err(error) if error.kind() == ErrorKind::Interrupted => Ok(()),
            Err(error) => return Err(failed(error)),
        }
        .map_err(|error| what(path, error))?;
    }
    let log = if of_bag { bag.finish() } else { text.finish() }.map_err(|error| what(path, error))?;
    for note in notes(&log.notes, of_bag) {
        eprintln!("fastslam: {}: {note}", path.display());
    }
    Ok(log)
}

/// How a file that begins with these bytes becomes one that can be read, if it is of a kind that cannot.
fn cure(bytes: &[u8]) -> Option<&'static str> {
    let kinds: [(&[u8], &str); 2] = [
        (&[0x28, 0xb5, 0x2f, 0xfd], "it is compressed by zstd: unpack it first (zstd -d)"),
        (b"SQLite format 3", "it is a ROS 2 bag in SQLite: convert it to MCAP first (ros2 bag convert)"),
    ];
    kinds.into_iter().find(|(begins, _)| bytes.starts_with(begins)).map(|(_, cure)| cure)
}

/// What is said of a folder: a ROS 2 bag is one.
fn parts(path: &Path) -> String {
    let files = std::fs::read_dir(path).into_iter().flatten().flatten().map(|entry| entry.file_name());
    let mut bags: Vec<String> = files.map(|name| name.to_string_lossy().into_owned()).collect();
    bags.retain(|name| [".mcap", ".db3", ".bag"].iter().any(|end| name.ends_with(end)));
    bags.sort();
    match bags.is_empty() {
        true => "it is a folder without a bag in it; name a file".into(),
        false => format!("it is a folder; name one of the bags in it: {}", bags.join(", ")),
    }
}

fn notes(notes: &Notes, of_bag: bool) -> Vec<String> {
    let Notes { rear, unknown, malformed, first_malformed, out_of_order, remarks, .. } = notes;
    let mut said: Vec<String> = remarks.iter().map(ToString::to_string).collect();
    if *rear > 0 {
        said.push(format!("{rear} messages of a rear laser are passed over"));
    }
    if !unknown.is_empty() {
        let kinds: Vec<String> = unknown.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        said.push(format!("messages that are not known here are passed over: {}", kinds.join(", ")));
    }
    if let Some(first) = first_malformed {
        said.push(match of_bag {
            true => format!("malformed messages passed over: {malformed}, the first of them: {}", first.problem),
            false => format!("malformed lines passed over: {malformed}, the first of them {first}"),
        });
    }
    if *out_of_order > 0 {
        said.push(format!("scans whose stamps go back: {out_of_order}; they were put in order"));
    }
    said
}

fn summary(settings: &LaserMapperSettings, log: &LaserLog, output: &Output) -> String {
    let mut text = format!(
        "{} scans, of which {} taken: {} particles, seed {}, cells of {} m\n\
         CPU time per scan and particle    {:8.3} ms\n\
         maps at their peak                {:8.1} MB, {:.1} MB as dense copies, {:.1} MB estimated\n\
         maps of before, to find loops by  {:8.1} MB more\n\
         steps that resampled              {:8.0} %\n",
        output.scans,
        output.scans_used,
        settings.particles,
        settings.seed,
        settings.cell_size,
        output.ms_per_scan_particle,
        output.peak_map_bytes as f64 / 1e6,
        output.dense_map_bytes as f64 / 1e6,
        settings.memory_estimate(log) as f64 / 1e6,
        output.kept_map_bytes as f64 / 1e6,
        100.0 * output.resampled_fraction,
    );
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
    _ = writeln!(text, "digest {}", output.digest);
    text
}

/// The files that results go to.
struct Outputs {
    trajectory: Option<PathBuf>,
    path_mcap: Option<PathBuf>,
    /// png, pgm and yaml.
    map: Option<[PathBuf; 3]>,
}

impl Outputs {
    /// Creates them, empty.
    fn open(arguments: &Arguments) -> Result<Self> {
        let named = |name: &PathBuf| {
            ["png", "pgm", "yaml"].map(|extension| {
                let mut file = name.clone().into_os_string();
                file.push(".");
                file.push(extension);
                PathBuf::from(file)
            })
        };
        let Arguments { trajectory, path_mcap, map, .. } = arguments;
        let outputs =
            Self { trajectory: trajectory.clone(), path_mcap: path_mcap.clone(), map: map.as_ref().map(named) };
        let files = outputs.trajectory.iter().chain(&outputs.path_mcap).chain(outputs.map.iter().flatten());
        for path in files {
            std::fs::File::create(path).with_context(in_file(path))?;
        }
        Ok(outputs)
    }

    fn write(&self, mapper: &LaserMapper, path: &[(f64, Pose2)], rules: &MapImageSettings) -> Result<()> {
        let save = |path: &Path, bytes: &[u8]| std::fs::write(path, bytes).with_context(in_file(path));
        if let Some(file) = &self.trajectory {
            save(file, write_tum(path).as_bytes())?;
        }
        if let Some(file) = &self.path_mcap {
            save(file, &write_path(path).map_err(anyhow::Error::msg)?)?;
        }
        if let Some([png, pgm, yaml]) = &self.map {
            let map = MapImage::of(mapper.map(), path, rules)?;
            let open = mapper.open_loops().filter_map(|one| mapper.at_step(one.to));
            picture::save_map(&map, path, &open.map(|(_, pose)| pose).collect::<Vec<_>>(), png)?;
            save(pgm, &map.pgm())?;
            save(yaml, map.yaml(&pgm.file_name().unwrap_or_default().to_string_lossy()).as_bytes())?;
        }
        Ok(())
    }
}
