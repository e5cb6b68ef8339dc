//! A mapper's state in a file, with which a session goes on.

use super::outputs::Pending;
use crate::{Usage, in_file};
use anyhow::{Context, Result, bail};
use fastslam::mapper::{LaserMapper, SavedMapper};
use fastslam::sensor::LaserScan;
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use std::fs::File;
use std::io::{BufReader, BufWriter, ErrorKind, Read, Write};
use std::path::Path;

/// How the file begins, before what is packed: with the form of what follows.
const HEAD: &[u8] = b"fastslam session 5\n";

/// The mapper of a session that was saved; `None` where there is no such file yet.
pub fn read(path: &Path) -> Result<Option<LaserMapper>> {
    let mut file = match File::open(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        file => BufReader::new(file.with_context(in_file(path))?),
    };
    let (mut head, mut bytes) = ([0; HEAD.len()], Vec::new());
    if file.read_exact(&mut head).is_err() || head != HEAD {
        bail!(Usage::of_file(path, "it is not a session of this version: name another file, or remove it"));
    }
    let damaged = |what: String| Usage::of_file(path, format_args!("the session is damaged: {what}"));
    GzDecoder::new(file).read_to_end(&mut bytes).map_err(|error| damaged(error.to_string()))?;
    let saved: SavedMapper = postcard::from_bytes(&bytes).map_err(|error| damaged(error.to_string()))?;
    Ok(Some(LaserMapper::restore(saved).map_err(|error| damaged(error.to_string()))?))
}

/// Saves the session of a mapper. Until all of it is written, the file stays as it was.
pub fn write(mapper: &LaserMapper, path: &Path) -> Result<()> {
    let output = Pending::new(path)?;
    let write = || -> Result<()> {
        let mut file = BufWriter::new(File::create(output.path())?);
        file.write_all(HEAD)?;
        let packed = GzEncoder::new(file, Compression::fast());
        let packed = postcard::to_io(&mapper.save(), packed)?;
        Ok(packed.finish()?.flush()?)
    };
    write().with_context(in_file(path))?;
    output.put()
}

/// How many of these scans, which are by time, a session has already: those up to its last one.
pub fn had(mapper: &LaserMapper, scans: &[LaserScan]) -> usize {
    let path = mapper.path();
    let Some((last, _)) = path.last() else { return 0 };
    let before = scans.partition_point(|scan| scan.time < *last);
    let with_it = scans[before..].iter().take_while(|scan| scan.time == *last).count();
    let of_path = path.iter().rev().take_while(|(time, _)| time == last).count();
    before + with_it.min(of_path)
}
