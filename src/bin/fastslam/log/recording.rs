//! Recorded logs as files: of any kind, packed or not, in one part or in several.

use super::sqlite;
use crate::{Usage, in_file};
use anyhow::{Context, Error, Result, bail};
use fastslam_log::{BagOptions, BagReader, LaserLog, LogError, LogProblem, LogReader, Notes, is_bag};
use flate2::read::MultiGzDecoder;
use ruzstd::decoding::{FrameDecoder, StreamingDecoder};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Reads a recording of one file, or of several that are its parts, and says on standard error what of it is not used. No file is ever whole in
/// memory, but for a database that is packed.
pub fn read(paths: &[PathBuf], options: BagOptions) -> Result<LaserLog> {
    let BagOptions { scan_topic, odometry_topic, odometry_frame, lenient } = &options;
    let (lenient, names_topics) =
        (*lenient, scan_topic.is_some() || odometry_topic.is_some() || odometry_frame.is_some());
    let (mut bag, mut text) = (BagReader::new(options), LogReader::new(lenient));
    let files = files(paths)?;
    let (mut of_bags, mut piece) = (false, vec![0; 1 << 16]);
    for (number, path) in files.iter().enumerate() {
        let mut file = Opened::new(path)?;
        if let Some(cure) = cure(&file.start) {
            bail!(Usage::of_file(path, cure));
        }
        let of_sqlite = file.start.starts_with(sqlite::MAGIC);
        let of_bag = of_sqlite || is_bag(&file.start);
        if number > 0 && of_bag != of_bags {
            bail!(Usage::of_file(
                path,
                "it is of another kind than the file before it: bags and other logs are mapped apart"
            ));
        }
        if names_topics && !of_bag {
            let flags = "--scan-topic, --odometry-topic and --odometry-frame";
            bail!(Usage::of_file(path, format_args!("{flags} are for bags, which it is not")));
        }
        of_bags = of_bag;
        let refused = |error: LogError, text: &LogReader| refusal(path, error, lenient, of_bag || text.scans() > 0);
        if of_sqlite {
            file.database(&mut bag)?.map_err(|error| refused(error, &text))?;
        } else {
            while let count @ 1.. = file.read(&mut piece)? {
                let piece = &piece[..count];
                if of_bag { bag.push(piece) } else { text.push(piece) }.map_err(|error| refused(error, &text))?;
            }
        }
        if number + 1 < files.len() {
            if of_bag { bag.end_part() } else { text.end_part() }.map_err(|error| refused(error, &text))?;
        }
    }
    let is_known = of_bags || text.scans() > 0;
    let log = if of_bags { bag.finish() } else { text.finish() };
    let log = log.map_err(|error| refusal(&files[files.len() - 1], error, lenient, is_known))?;
    for note in notes(&log.notes, of_bags) {
        eprintln!("fastslam: {}: {note}", named(paths));
    }
    Ok(log)
}

/// What files are called together.
pub fn named(paths: &[PathBuf]) -> String {
    let first = paths.first().map_or(String::new(), |path| path.display().to_string());
    if paths.len() > 1 { format!("{first} and {} more", paths.len() - 1) } else { first }
}

/// What is wrong with a file that cannot be read, and what will help: of one of which nothing `is_known`, which kinds can be read.
fn refusal(path: &Path, error: LogError, lenient: bool, is_known: bool) -> Usage {
    let said = said(&error);
    let of_nothing = matches!(
        error.problem,
        LogProblem::LongLine
            | LogProblem::Binary
            | LogProblem::UnknownMessage(_)
            | LogProblem::NoMessage(_)
            | LogProblem::NoPose
            | LogProblem::Field { message: None, .. }
            | LogProblem::NoScan { .. }
            | LogProblem::NoScanSoon { .. }
    );
    let is_graph = |kind: &str| kind.starts_with("VERTEX") || kind.starts_with("EDGE") || kind == "FIX";
    let more = match &error.problem {
        LogProblem::NoScan { but: Some(kind) } if is_graph(kind) => {
            ": `fastslam landmarks --g2o` reads graphs, or `fastslam-lab lap --method graph --from-g2o`"
        }
        LogProblem::Json(what) if what.contains("NaN") => " (sed 's/-Infinity/0/g; s/Infinity/null/g; s/NaN/0/g')",
        _ if of_nothing && !is_known => {
            "; logs that can be read are ROS 2 bags (MCAP), ROS 1 bags, CARMEN's format, and scans as JSON lines"
        }
        // A step that a robot can make between two scans, if it is told in millimetres.
        LogProblem::Jump { kilometres, .. } | LogProblem::OdometryJumps { kilometres, .. } if *kilometres < 20.0 => {
            ": is odometry in millimetres?"
        }
        LogProblem::Truncated if !lenient => " (--lenient reads it up to there)",
        LogProblem::Message { .. } if !lenient => " (--lenient passes such messages over)",
        _ if error.line > 0 && !lenient && is_known => " (--lenient passes such lines over)",
        _ => "",
    };
    Usage::of_file(path, format_args!("{said}{more}"))
}

/// A problem with its line; 0 is the file as a whole. What reads JSON tells a line as well, which is always the first: each is read by itself.
pub fn said(error: &LogError) -> String {
    let said = if error.line == 0 { error.problem.to_string() } else { error.to_string() };
    said.replace(" at line 1 column ", " at column ")
}

/// A file that is read, unpacked where it is packed by gzip or zstd.
struct Opened<'a> {
    path: &'a Path,
    is_packed: bool,
    /// How it begins.
    start: Vec<u8>,
    bytes: Box<dyn Read>,
}

/// How files begin that are packed.
const GZIP: &[u8] = &[0x1f, 0x8b];
const ZSTD: &[u8] = &[0x28, 0xb5, 0x2f, 0xfd];

impl<'a> Opened<'a> {
    fn new(path: &'a Path) -> Result<Self> {
        /// What kinds of files are told by.
        const START: u64 = 512;
        let mut file = BufReader::new(File::open(path).with_context(in_file(path))?);
        let start = file.fill_buf().with_context(in_file(path))?;
        let (of_gzip, of_zstd) = (start.starts_with(GZIP), start.starts_with(ZSTD));
        let bytes: Box<dyn Read> = match (of_gzip, of_zstd) {
            (true, _) => Box::new(MultiGzDecoder::new(file)),
            (_, true) => Box::new(Frames { rest: Some(file), frame: None }),
            _ => Box::new(file),
        };
        let mut opened = Self { path, is_packed: of_gzip || of_zstd, start: Vec::new(), bytes };
        let mut start = Vec::new();
        opened.bytes.by_ref().take(START).read_to_end(&mut start).map_err(|error| opened.failed(error))?;
        opened.bytes = Box::new(Cursor::new(start.clone()).chain(opened.bytes));
        Ok(Self { start, ..opened })
    }

    /// Tells all of a database to a reader.
    fn database(&mut self, bag: &mut BagReader) -> Result<Result<(), LogError>> {
        let push = |bytes: &[u8]| bag.push(bytes);
        let read = if self.is_packed {
            let mut bytes = Vec::new();
            self.bytes.read_to_end(&mut bytes).map_err(|error| self.failed(error))?;
            sqlite::read(Cursor::new(bytes), push)
        } else {
            let mut journal = self.path.as_os_str().to_owned();
            journal.push("-wal");
            if std::fs::metadata(&journal).is_ok_and(|journal| journal.len() > 0) {
                let what = "was its recording broken off? Not all is in it yet: sqlite3 FILE 'PRAGMA wal_checkpoint(TRUNCATE)'";
                bail!(Usage::of_file(self.path, what));
            }
            sqlite::read(File::open(self.path).with_context(in_file(self.path))?, push)
        };
        let cure = "a ROS 2 bag in SQLite that can be read becomes MCAP by `ros2 bag convert`";
        read.map_err(|error| Usage::of_file(self.path, format_args!("{error:#}; {cure}")).into())
    }

    fn read(&mut self, piece: &mut [u8]) -> Result<usize> {
        loop {
            match self.bytes.read(piece) {
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                read => return read.map_err(|error| self.failed(error)),
            }
        }
    }

    fn failed(&self, error: io::Error) -> Error {
        if self.is_packed {
            return Usage::of_file(self.path, format_args!("cannot be unpacked: {error}")).into();
        }
        Error::new(error).context(self.path.display().to_string())
    }
}

/// Frames of zstd, one after the other: a decoder reads one.
struct Frames<R: BufRead> {
    frame: Option<StreamingDecoder<R, FrameDecoder>>,
    /// What follows it; nothing while it is read.
    rest: Option<R>,
}

impl<R: BufRead> Read for Frames<R> {
    fn read(&mut self, piece: &mut [u8]) -> io::Result<usize> {
        loop {
            if let Some(frame) = &mut self.frame {
                let count = frame.read(piece)?;
                if count > 0 || piece.is_empty() {
                    return Ok(count);
                }
            }
            self.rest = self.frame.take().map(StreamingDecoder::into_inner).or(self.rest.take());
            let Some(mut rest) = self.rest.take() else { return Ok(0) };
            if rest.fill_buf()?.is_empty() {
                return Ok(0);
            }
            self.frame = Some(StreamingDecoder::new(rest).map_err(io::Error::other)?);
        }
    }
}

/// How a file that begins so becomes one that can be read, if it is of a kind that cannot.
fn cure(start: &[u8]) -> Option<&'static str> {
    const KINDS: [(usize, &[u8], &str); 25] = [
        (0, b"rosbag2_bagfile_information:", "it tells of a ROS 2 bag: name the folder that it is in"),
        (0, b"PK\x03\x04", "it is a zip archive: unpack it first (unzip)"),
        (0, b"PK\x05\x06", "it is an empty zip archive"),
        (0, b"BZh", "it is compressed by bzip2: unpack it first (bunzip2)"),
        (0, b"\xfd7zXZ\0", "it is compressed by xz: unpack it first (xz -d)"),
        (0, b"\x5d\0\0", "it is compressed by lzma: unpack it first (xz -d)"),
        (0, b"\x04\x22\x4d\x18", "it is compressed by lz4: unpack it first (lz4 -d)"),
        (0, b"\x1f\x9d", "it is compressed by compress: unpack it first (uncompress)"),
        (0, b"\x1f\x8b", "it is compressed twice: unpack it first (gzip -d)"),
        (0, b"\x28\xb5\x2f\xfd", "it is compressed twice: unpack it first (zstd -d)"),
        (0, b"7z\xbc\xaf\x27\x1c", "it is an archive of 7-Zip: unpack it first (7z x)"),
        (0, b"Rar!", "it is a rar archive: unpack it first (unrar x)"),
        (257, b"ustar", "it is a tar archive: unpack it first (tar -xf)"),
        (0, b"\xff\xfe", "it is text in UTF-16: convert it to UTF-8 first (iconv -f UTF-16 -t UTF-8)"),
        (0, b"\xfe\xff", "it is text in UTF-16: convert it to UTF-8 first (iconv -f UTF-16 -t UTF-8)"),
        (0, b"\0\0\xfe\xff", "it is text in UTF-32: convert it to UTF-8 first (iconv -f UTF-32 -t UTF-8)"),
        (
            0,
            b"version https://git-lfs",
            "it is what Git LFS has in place of a file: fetch the file first (git lfs pull)",
        ),
        (0, b"<!DOCTYPE", "it is a web page: was the log to be downloaded from there?"),
        (0, b"<!doctype", "it is a web page: was the log to be downloaded from there?"),
        (0, b"<html", "it is a web page: was the log to be downloaded from there?"),
        (0, b"\x89PNG", "it is a picture"),
        (0, b"P5\n", "it is a map: the log that it was made of is needed"),
        (0, b"\x89HDF", "it is an HDF5 file: write its scans as JSON lines"),
        (0, b"\x93NUMPY", "it is an array of NumPy: write its scans as JSON lines"),
        (
            0,
            b"VERTEX",
            "it is a graph of g2o: `fastslam landmarks --g2o` reads it, or `fastslam-lab lap --method graph --from-g2o`",
        ),
    ];
    let known = KINDS.iter().find(|(at, begins, _)| start.get(*at..).is_some_and(|rest| rest.starts_with(begins)));
    known.map(|(_, _, cure)| *cure).or_else(|| of_text(start))
}

/// The same of text that begins so.
fn of_text(start: &[u8]) -> Option<&'static str> {
    // Text in UTF-16 without a mark: every other byte is zero.
    let zeros = |from: usize| start.iter().skip(from).step_by(2).take(8).filter(|byte| **byte == 0).count();
    if let ([0, 8] | [8, 0], 16..) = ([zeros(0), zeros(1)], start.len()) {
        return Some("it is text in UTF-16: convert it to UTF-8 first (iconv -f UTF-16LE -t UTF-8, or -f UTF-16BE)");
    }
    let text = start.trim_ascii_start();
    let line = text.split(|byte| *byte == b'\n').next().unwrap_or_default().trim_ascii_end();
    match line {
        [b'[', ..] => Some("it is one array in JSON: write its scans one a line first (jq -c '.[]')"),
        [b'{'] => Some("its scans in JSON are spread over lines: write them one a line first (jq -c .)"),
        _ => None,
    }
}

/// The files of a recording in their order: of a folder those that are its parts.
fn files(paths: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for path in paths {
        match path.is_dir() {
            true => files.extend(parts(path)?),
            false => files.push(path.clone()),
        }
    }
    // The second part comes before the tenth, whatever a shell makes of it.
    files.sort_by_cached_key(|path| by_number(&path.to_string_lossy()));
    Ok(files)
}

/// A name's texts and the numbers between them, to sort by.
fn by_number(name: &str) -> Vec<(String, u64)> {
    let mut parts = vec![(String::new(), 0_u64)];
    let mut of_digits = false;
    for character in name.chars() {
        match character.to_digit(10) {
            Some(digit) => {
                let number = &mut parts.last_mut().expect("never empty").1;
                *number = number.saturating_mul(10).saturating_add(digit.into());
                of_digits = true;
            }
            None => {
                if core::mem::take(&mut of_digits) {
                    parts.push((String::new(), 0));
                }
                parts.last_mut().expect("never empty").0.push(character);
            }
        }
    }
    parts
}

/// How the names of bags end.
const BAGS: [&str; 7] = [".mcap", ".db3", ".bag", ".mcap.zstd", ".mcap.zst", ".db3.zstd", ".mcap.gz"];

/// The files of a folder that is a ROS 2 bag: those that its metadata.yaml names, or all that differ in their number alone.
fn parts(folder: &Path) -> Result<Vec<PathBuf>> {
    let listed = std::fs::read_to_string(folder.join("metadata.yaml")).map(|text| listed(&text)).unwrap_or_default();
    if !listed.is_empty() {
        let place = |name: &String| {
            // Some recorders write the folder's name before that of the file.
            let file = Path::new(name).file_name().unwrap_or_default();
            match folder.join(file) {
                path if path.exists() => Ok(path),
                _ => {
                    Err(Usage::of_file(folder, format_args!("its metadata.yaml names {name}, which is not there"))
                        .into())
                }
            }
        };
        return listed.iter().map(place).collect();
    }
    let entries = std::fs::read_dir(folder).with_context(in_file(folder))?;
    let mut bags: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    bags.retain(|name| BAGS.iter().any(|end| name.ends_with(end)));
    bags.sort_by_cached_key(|name| by_number(name));
    let stem = |name: &String| {
        let name = BAGS.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name);
        name.trim_end_matches(|character: char| character.is_ascii_digit()).to_owned()
    };
    match &bags[..] {
        [] => bail!(Usage::of_file(folder, "it is a folder without a bag in it; name a file")),
        [first, others @ ..] if others.iter().all(|other| stem(other) == stem(first)) => {
            Ok(bags.iter().map(|name| folder.join(name)).collect())
        }
        _ => {
            let bags = bags.join(", ");
            bail!(Usage::of_file(
                folder,
                format_args!("it is a folder; name one of the bags in it, or the parts of one: {bags}")
            ))
        }
    }
}

/// The files that a metadata.yaml names.
fn listed(text: &str) -> Vec<String> {
    let lines = text.lines().map(str::trim).skip_while(|line| *line != "relative_file_paths:").skip(1);
    let names = lines.map_while(|line| line.strip_prefix("- "));
    names.map(|name| name.trim_matches(['"', '\'', ' ']).to_owned()).collect()
}

/// What is said of what a log has besides what is used.
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

#[cfg(test)]
mod tests;
