//! `fastslam log`: a recorded log, mapped; `fastslam example-log`: one of our own.

mod choices;
mod drawn;
mod localize;
mod outputs;
mod progress;
mod recording;
mod sense;
mod session;
mod sqlite;
mod summary;

use self::choices::{Choices, by_flag, listed};
use self::outputs::Outputs;
use self::progress::Progress;
use self::recording::{named, read, said};
use self::sense::{
    bring_to_one_unit, leave_constants_out, leave_repeated_out, put_right, ranges_in_metres, say_beyond, say_blind,
};
use self::summary::{Output, loops, summary};
use crate::{Usage, in_file, print, print_json};
use anyhow::{Context, Result, bail};
use cpu_time::ProcessTime;
use fastslam::error::Range;
use fastslam::geometry::Pose2;
use fastslam::mapper::{
    LaserMapper, LaserMapperSettings, Localizer, OdometryFault, OdometryInnovations, Pushed, Remark as MapRemark,
};
use fastslam_lab::experiment::log::{Example, digest};
use fastslam_log::{LaserLog, Relation, parse_relations, relation_errors, write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Map a recorded log of a robot with a laser: a ROS 2 bag (MCAP), a ROS 1 bag, CARMEN's format, or scans as JSON lines
#[derive(clap::Args)]
pub struct Arguments {
    /// The log; what it is its content tells, not its name. Any of them may be compressed by gzip or zstd. Several files are parts of one recording, in the
    /// order of the numbers in their names, and a folder is the recording that its metadata.yaml tells of. It is read piece by piece: of a bag the
    /// scans and the odometry stay in memory, of a log in plain text about as much as it has bytes
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Read options from this file, in TOML, by their names without dashes before them (particles = 4, scan-topic = "/front"); an option stands over the file
    #[arg(long, value_name = "FILE")]
    settings: Option<PathBuf>,
    #[command(flatten)]
    choices: Choices,
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
    /// Go on from the session in this file, if it is there, and save it at the end and when the run is stopped. Scans up to the last one of the session are passed
    /// over: a run that was stopped goes on with the same log, and a building is mapped on with the next
    #[arg(long, value_name = "FILE")]
    session: Option<PathBuf>,
    /// Only find the robot in the map of the session, or of --in-map, which stays as it is: paths are written, and no map
    #[arg(long, conflicts_with_all = ["map", "checkpoint", "relations"])]
    localize: bool,
    /// With --localize: in place of a session, a map that was drawn, as map_server of ROS reads it: the YAML file, which names a picture in PGM. The settings of this
    /// run count then, but for the size of the cells
    #[arg(long, value_name = "YAML", requires = "localize", conflicts_with = "session")]
    in_map: Option<PathBuf>,
    /// With --localize: about where the robot is at the first scan, in the frame of the map, x and y [m] and heading [deg]; it is searched for within
    /// 1.5 m and 43° [default: where the session ended; in a map that was drawn 0,0,0]
    #[arg(long, value_name = "X,Y,DEG", requires = "localize", allow_hyphen_values = true)]
    start: Option<localize::Start>,
    /// Write what is asked for, and the session, every so many minutes as well, 0.001 to 10000
    #[arg(long, value_name = "MINUTES", allow_negative_numbers = true)]
    checkpoint: Option<f64>,
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

/// Steps between two looks at the memory of the maps, each of which takes as long as some steps: by every 50th, a fifteenth of the time on a campus.
const LOOK_EVERY: u32 = 200;

/// A map is not to be trusted where it contradicts more than this share of what is seen again: three recorded logs have 0.01 to 0.13 with one particle.
const DISPUTED: f64 = 0.25;

/// End points of places seen again below which their share says little: one look back at the last metres compares as many.
const SEEN_AGAIN: u32 = 400;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let name = named(&arguments.files);
    let choices = arguments.choices.clone().read(arguments.settings.as_deref())?;
    if arguments.localize && arguments.session.is_none() && arguments.in_map.is_none() {
        bail!(Usage("--localize needs a map: that of a session (--session), or one that was drawn (--in-map)".into()));
    }
    let session = arguments.session.as_deref().map(session::read).transpose()?.flatten();
    let drawn = arguments.in_map.as_deref().map(drawn::read).transpose()?;
    let begun = session.as_ref().map(|mapper| *mapper.settings());
    let of_drawn = drawn
        .as_ref()
        .map(|(_, reading)| LaserMapperSettings { cell_size: reading.resolution, ..LaserMapperSettings::default() });
    let (settings, rules) = (choices.mapper(begun.or(of_drawn).unwrap_or_default()), choices.map());
    settings.validate().and_then(|()| rules.validate()).map_err(by_flag)?;
    let checkpoint = arguments.checkpoint.map(|minutes| CHECKPOINT.check("checkpoint", minutes)).transpose()?;
    if let (Some(path), Some(begun)) = (&arguments.session, begun.filter(|begun| *begun != settings)) {
        let goes_on = format!("the session was begun with {}, and goes on with these alone", listed(&begun));
        bail!(Usage::of_file(path, goes_on));
    }
    if let (Some(path), Some(of_drawn)) = (&arguments.in_map, of_drawn.filter(|of| of.cell_size != settings.cell_size))
    {
        bail!(Usage::of_file(path, format_args!("its cells are of {} m, and no others (--cell)", of_drawn.cell_size)));
    }
    let mut log = read(&arguments.files, choices.bag())?;
    let relations = relations(arguments.relations.as_deref(), &log)?;
    let scans = log.scans.len();
    say_beyond(&log, &name);
    bring_to_one_unit(&mut log, &name);
    leave_constants_out(&mut log, &name);
    ranges_in_metres(&mut log, &settings, &name);
    let blind = say_blind(&log, &settings, &name);
    let repeated = leave_repeated_out(&mut log, &name);
    let faults = put_right(&mut log, &settings, &name);
    if let Some((image, reading)) = drawn {
        let begin = |start| Localizer::in_drawn(&image, &reading, settings.for_scans(&log.scans), start);
        return localize::run(arguments, &name, &log, Pose2::default(), begin);
    }
    let mut mapper = match (session, &arguments.session) {
        (Some(mapper), _) if arguments.localize => {
            return localize::run(arguments, &name, &log, mapper.pose(), |start| Localizer::new(&mapper, start));
        }
        (None, Some(path)) if arguments.localize => bail!(Usage::of_file(path, "there is no session to localize in")),
        (Some(mapper), _) => mapper,
        (None, _) => LaserMapper::new(settings.for_scans(&log.scans))?,
    };
    let had = session::had(&mapper, &log.scans);
    if had > 0 {
        eprintln!("fastslam: {name}: the session has {had} of {} scans already", log.scans.len());
    }
    let taken = |mapper: &LaserMapper| mapper.steps() + u32::from(!mapper.path().is_empty());
    let taken_before = taken(&mapper);
    let stopped = stopped_by_signal()?;
    // Before minutes of work: whether the results can be written.
    let outputs = Outputs::open(arguments)?;

    let mut progress = Progress::new(&name, log.scans.len() - had);
    let (mut saved, mut longest) = (Duration::ZERO, Duration::ZERO);
    let (mut peak, mut kept) = (mapper.footprint(), 0);
    let mut look = |mapper: &LaserMapper| {
        let now = mapper.footprint();
        if now.unique > peak.unique {
            peak = now;
        }
        kept = kept.max(mapper.footprint_with_kept().unique - now.unique);
    };
    let (mut scans_unexplained, mut innovations) = (0, OdometryInnovations::default());
    for scan in &log.scans[had..] {
        if stopped.load(Ordering::Relaxed) {
            break;
        }
        let before = progress.elapsed();
        let pushed = mapper.push(scan);
        longest = longest.max(progress.elapsed() - before);
        progress.scans += 1;
        let Pushed::Step(report) = pushed else { continue };
        if report.step.is_multiple_of(LOOK_EVERY) {
            look(&mapper);
        }
        scans_unexplained += u32::from(!report.explained());
        mapper.predicted().into_iter().for_each(|predicted| innovations.add(predicted, &report));
        progress.tell(mapper.filter(), report.selection_ess);
        if checkpoint.is_some_and(|minutes| progress.elapsed() >= saved + Duration::from_secs_f64(60.0 * minutes)) {
            Outputs::open(arguments)?.write(&mapper, &mapper.path(), &rules)?;
            save_session(arguments, &mapper)?;
            saved = progress.elapsed();
        }
    }
    look(&mapper);
    // The session goes on as one run would, with what is under way; what is written is of the whole log.
    let session = mapper.clone();
    mapper.finish();
    let elapsed = progress.finish();
    let stopped = (progress.scans < progress.all).then_some(had + progress.scans);
    if mapper.path().is_empty() && stopped.is_some() {
        bail!(Stopped(format!("{name}: stopped before the first scan")));
    }

    let path = mapper.path();
    outputs.write(&mapper, &path, &rules)?;
    save_session(arguments, &session)?;
    let (doubts, remarks): (Vec<_>, Vec<_>) = mapper.remarks().into_iter().partition(|remark| match remark {
        MapRemark::OpenLoops { .. } | MapRemark::NothingMet => true,
        MapRemark::Contradicted { steps, .. } => *steps > mapper.steps() as usize / 3,
        _ => false,
    });
    for remark in remarks {
        eprintln!("fastslam: {name}: {remark}");
    }
    let memory = mapper.memory();
    let used = taken(&mapper) - taken_before;
    let cpu = ProcessTime::now().as_duration();
    let output = Output {
        scans: scans as u32,
        scans_used: used,
        elapsed_s: elapsed.as_secs_f64(),
        scans_per_s: progress.scans as f64 / elapsed.as_secs_f64().max(1e-3),
        longest_scan_s: longest.as_secs_f64(),
        ms_per_scan_particle: 1e3 * cpu.as_secs_f64() / f64::from(used.max(1)) / settings.particles as f64,
        peak_process_bytes: peak_process_bytes(),
        peak_map_bytes: peak.unique,
        dense_map_bytes: peak.dense,
        kept_map_bytes: kept,
        kept_scans: memory.kept_scans,
        scan_bytes: memory.scan_bytes,
        path_bytes: memory.path_bytes,
        errors: relations.and_then(|relations| relation_errors(&path, &log.odometry, &relations)),
        resampled_fraction: mapper.resampled_fraction(),
        steps_contradicted: mapper.unbelieved().len() as u32,
        odometry_innovation: innovations.mean(),
        odometry_innovations_beyond: innovations.share_beyond(),
        odometry_fault: faults.iter().map(ToString::to_string).reduce(|one, other| format!("{one}; {other}")),
        scans_unexplained,
        paths_bent: mapper.closings(),
        loops: loops(&mapper),
        loops_open: mapper.open_loops().count() as u32,
        disputed_fraction: mapper.disputed_fraction(),
        lineage_one_scan: mapper.single_lineage_since(),
        wheel_drift_deg_per_m: mapper.wheels().drift().to_degrees(),
        wheel_heading_std_deg_per_m: mapper.wheels().heading_std().to_degrees(),
        digest: format!("{:016x}", digest(&mapper).value()),
    };
    if arguments.json {
        print_json(&output)?
    } else {
        print(&summary(&settings, &log, &output))?
    }
    let of_fault = "the map may be wrong in size or shape, as scans and odometry contradict each other throughout";
    let of_fault = faults.iter().any(OdometryFault::doubts_scans).then(|| of_fault.into());
    let of_repeated =
        (repeated > scans / 2).then(|| "the map is one of few places, as most scans repeat another".into());
    let of_blind =
        (blind > scans / 3).then(|| "the map is one of a part of the way, as many scans have no range".into());
    let disputed = mapper.disputed_fraction();
    let of_disputed = (disputed > DISPUTED && mapper.seen_again() >= SEEN_AGAIN).then(|| {
        format!("of what is seen again, {:.0} % contradicts the map of before: the path may be wrong", 100.0 * disputed)
    });
    let of_lost = log.notes.lost.first().map(|first| {
        format!(
            "scans that fit nowhere upon those before: {}, the first at {first:.3} s; without odometry, the path may be wrong from there on",
            log.notes.lost.len()
        )
    });
    let doubt = doubts
        .iter()
        .map(ToString::to_string)
        .chain(of_fault)
        .chain(of_repeated)
        .chain(of_lost)
        .chain(of_blind)
        .chain(of_disputed)
        .next();
    if let Some(scans) = stopped {
        bail!(Stopped(format!(
            "{name}: stopped after {scans} of {} scans; what was asked for is written up to there",
            log.scans.len()
        )));
    }
    doubt.map_or(Ok(()), |doubt| Err(Doubtful(format!("{name}: {doubt}")).into()))
}

/// The most that this process had of memory so far; `None` where the system is not Linux.
fn peak_process_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"))?;
    Some(1024 * kilobytes.parse::<u64>().ok()?)
}

/// A log was mapped, and its map is not to be trusted: it contradicts itself, is empty, or scans contradict the log as a whole. Exit status 3.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Doubtful(String);

/// The run was stopped by a signal, after which the results so far were written. Exit status 130.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Stopped(String);

/// Set by Ctrl-C, and by whoever asks the program to end. Who asks a second time does not wait for the results.
fn stopped_by_signal() -> Result<Arc<AtomicBool>> {
    let stopped = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&stopped);
    ctrlc::set_handler(move || {
        if set.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    })?;
    Ok(stopped)
}

/// The relations of a file, some of which are of the time of the log. Before minutes of work: whether there is anything to judge.
fn relations(path: Option<&Path>, log: &LaserLog) -> Result<Option<Vec<Relation>>> {
    let Some(path) = path else { return Ok(None) };
    let bytes = std::fs::read(path).with_context(in_file(path))?;
    let relations = parse_relations(&bytes).map_err(|error| Usage::of_file(path, said(&error)))?;
    // Times are all that this asks of the odometry.
    if relation_errors(&log.odometry, &log.odometry, &relations).is_none() {
        let count = relations.len();
        let message =
            format_args!("none of its {count} relations is within the time of the log: are they of another one?");
        bail!(Usage::of_file(path, message));
    }
    Ok(Some(relations))
}

/// Minutes between two checkpoints.
const CHECKPOINT: Range = Range::number(0.001, 10_000.0, "min");

fn save_session(arguments: &Arguments, mapper: &LaserMapper) -> Result<()> {
    arguments.session.as_deref().map_or(Ok(()), |path| session::write(mapper, path))
}

/// Writes the example.
pub fn example(arguments: &ExampleArguments) -> Result<()> {
    let example = Example::new(usize::MAX);
    let save = |path: &Path, text: &str| std::fs::write(path, text).with_context(in_file(path));
    let heading =
        "# A simulated building of our own, free to use. CARMEN log: raw odometry, 180 beams over 180 deg, metres.\n";
    save(&arguments.file, &(heading.to_owned() + &write(&example.log)))?;
    if let Some(path) = &arguments.relations {
        let line = |relation: &Relation| {
            let ([t1, t2], Pose2 { x, y, theta }) = (relation.times, relation.first_from_second);
            format!("{t1:.2} {t2:.2} {x:.6} {y:.6} 0 0 0 {theta:.6}\n")
        };
        save(path, &example.relations.iter().map(line).collect::<String>())?;
    }
    Ok(())
}
