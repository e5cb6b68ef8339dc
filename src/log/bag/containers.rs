//! The two kinds of files: records in chunks, which may be compressed, and channels of a topic and a type each.

use super::messages::Encoding;
use crate::LogProblem;
use lz4_flex::frame::FrameDecoder;
use mcap::records::Record;
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use ruzstd::decoding::StreamingDecoder;
use std::collections::BTreeMap;
use std::io::Read;

/// Largest record and largest chunk that is read, unpacked too \[bytes\]: recorders write chunks of about one million.
const LARGEST: usize = 256 << 20;

/// A channel, as a container tells of it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Channel {
    pub topic: String,
    /// As `sensor_msgs/LaserScan`, also where ROS 2 writes `sensor_msgs/msg/LaserScan`.
    pub kind: String,
    pub encoding: Encoding,
}

/// Who is told of channels and messages.
pub trait Sink {
    /// There is such a channel.
    fn channel(&mut self, channel: &Channel);
    /// A message, and when it was recorded \[s\].
    fn message(&mut self, channel: &Channel, recorded: f64, bytes: &[u8]) -> Result<(), LogProblem>;
}

/// A file that is read piece by piece.
pub trait Container {
    /// The next bytes, cut anywhere.
    fn push(&mut self, bytes: &[u8], sink: &mut dyn Sink) -> Result<(), LogProblem>;
    /// The file's end.
    fn finish(&mut self, sink: &mut dyn Sink) -> Result<(), LogProblem>;
}

/// What only those who know the format can make something of.
fn damaged(what: impl Into<String>) -> LogProblem {
    LogProblem::Damaged(what.into())
}

/// A ROS 2 bag.
pub struct Mcap {
    reader: LinearReader,
    known: Known,
    ended: bool,
}

#[derive(Default)]
struct Known {
    /// Names of types.
    schemas: BTreeMap<u16, String>,
    channels: BTreeMap<u16, Channel>,
}

impl Default for Mcap {
    fn default() -> Self {
        let options = LinearReaderOptions::default().with_emit_chunks(true).with_record_length_limit(LARGEST);
        Self { reader: LinearReader::new_with_options(options), known: Known::default(), ended: false }
    }
}

impl Container for Mcap {
    fn push(&mut self, mut bytes: &[u8], sink: &mut dyn Sink) -> Result<(), LogProblem> {
        while !self.ended {
            match self.reader.next_event() {
                None => self.ended = true,
                Some(Ok(LinearReadEvent::ReadRequest(_))) if bytes.is_empty() => break,
                Some(Ok(LinearReadEvent::ReadRequest(wanted))) => {
                    let (now, later) = bytes.split_at(wanted.min(bytes.len()));
                    self.reader.insert(now.len()).copy_from_slice(now);
                    self.reader.notify_read(now.len());
                    bytes = later;
                }
                Some(Ok(LinearReadEvent::Record { opcode, data })) => {
                    self.known.record(mcap::parse_record(opcode, data).map_err(told)?, sink)?;
                }
                Some(Err(error)) => return Err(told(error)),
            }
        }
        Ok(())
    }

    fn finish(&mut self, sink: &mut dyn Sink) -> Result<(), LogProblem> {
        self.push(&[], sink)?;
        if self.ended { Ok(()) } else { Err(LogProblem::Truncated) }
    }
}

impl Known {
    fn record(&mut self, record: Record<'_>, sink: &mut dyn Sink) -> Result<(), LogProblem> {
        match record {
            Record::Schema { header, .. } => {
                self.schemas.insert(header.id, header.name.replace("/msg/", "/"));
            }
            Record::Channel(channel) => {
                let encoding = match channel.message_encoding.as_str() {
                    "cdr" => Encoding::Cdr,
                    "ros1" => Encoding::Ros1,
                    other => Encoding::Other(other.into()),
                };
                let kind = self.schemas.get(&channel.schema_id).cloned().unwrap_or_default();
                let known = Channel { topic: channel.topic, kind, encoding };
                sink.channel(&known);
                self.channels.insert(channel.id, known);
            }
            Record::Message { header, data } => {
                let id = header.channel_id;
                let channel = self
                    .channels
                    .get(&id)
                    .ok_or_else(|| damaged(format!("a message is of channel {id}, of which nothing was told")))?;
                let (seconds, nanoseconds) = (header.log_time / 1_000_000_000, header.log_time % 1_000_000_000);
                sink.message(channel, seconds as f64 + 1e-9 * nanoseconds as f64, &data)?;
            }
            Record::Chunk { header, data } => {
                let unpacked = unpacked(&header.compression, &data, header.uncompressed_size)?;
                if header.uncompressed_crc != 0 && crc32fast::hash(&unpacked) != header.uncompressed_crc {
                    return Err(damaged("a chunk does not have the checksum that is written beside it"));
                }
                for record in mcap::read::LinearReader::sans_magic(&unpacked) {
                    self.record(record.map_err(told)?, sink)?;
                }
            }
            _ => {}
        }
        Ok(())
    }
}

fn told(error: mcap::McapError) -> LogProblem {
    match error {
        mcap::McapError::UnexpectedEof | mcap::McapError::UnexpectedEoc => LogProblem::Truncated,
        error => damaged(format!("it is no MCAP file as it should be: {error}")),
    }
}

/// A ROS 1 bag, of format 2.0: <http://wiki.ros.org/Bags/Format/2.0>.
#[derive(Default)]
pub struct Ros1 {
    /// What is read of a record that is not complete.
    begun: Vec<u8>,
    started: bool,
    channels: BTreeMap<u32, Channel>,
}

/// The first line of a ROS 1 bag.
pub const ROS1_MAGIC: &[u8] = b"#ROSBAG V2.0\n";

impl Container for Ros1 {
    fn push(&mut self, bytes: &[u8], sink: &mut dyn Sink) -> Result<(), LogProblem> {
        self.begun.extend_from_slice(bytes);
        let begun = core::mem::take(&mut self.begun);
        let mut rest = begun.as_slice();
        if !self.started {
            let Some(after) = rest.get(ROS1_MAGIC.len()..) else {
                self.begun = begun;
                return Ok(());
            };
            (rest, self.started) = (after, true);
        }
        while let Some((header, data, after)) = self::record(rest)? {
            self.record(&Fields::of(header)?, data, sink)?;
            rest = after;
        }
        self.begun = rest.to_vec();
        Ok(())
    }

    fn finish(&mut self, _: &mut dyn Sink) -> Result<(), LogProblem> {
        if self.started && self.begun.is_empty() { Ok(()) } else { Err(LogProblem::Truncated) }
    }
}

impl Ros1 {
    fn record(&mut self, header: &Fields<'_>, data: &[u8], sink: &mut dyn Sink) -> Result<(), LogProblem> {
        match header.get("op")? {
            [MESSAGE] => {
                let id = header.number("conn")?;
                let channel = self
                    .channels
                    .get(&id)
                    .ok_or_else(|| damaged(format!("a message is of connection {id}, of which nothing was told")))?;
                let time = header.get("time")?;
                let [seconds, nanoseconds] = [number(time)?, number(time.get(4..).unwrap_or_default())?];
                sink.message(channel, f64::from(seconds) + 1e-9 * f64::from(nanoseconds), data)
            }
            [CONNECTION] => {
                let about = Fields::of(data)?;
                let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
                let (topic, kind) = (text(header.get("topic")?), text(about.get("type")?));
                let channel = Channel { topic, kind, encoding: Encoding::Ros1 };
                sink.channel(&channel);
                self.channels.insert(header.number("conn")?, channel);
                Ok(())
            }
            [CHUNK] => {
                let compression = String::from_utf8_lossy(header.get("compression")?).into_owned();
                let compression = if compression == "none" { "" } else { &compression };
                let unpacked = unpacked(compression, data, header.number("size")?.into())?;
                let mut rest = unpacked.as_slice();
                while let Some((header, data, after)) = self::record(rest)? {
                    self.record(&Fields::of(header)?, data, sink)?;
                    rest = after;
                }
                if rest.is_empty() { Ok(()) } else { Err(damaged("a chunk ends in the middle of a record")) }
            }
            _ => Ok(()), // indices
        }
    }
}

const MESSAGE: u8 = 0x02;
const CHUNK: u8 = 0x05;
const CONNECTION: u8 = 0x07;

/// Two pieces of a slice, and three.
type Halves<'a> = (&'a [u8], &'a [u8]);
type Thirds<'a> = (&'a [u8], &'a [u8], &'a [u8]);

/// A record's header and data, and what follows; `None` where it is not there to its end.
fn record(bytes: &[u8]) -> Result<Option<Thirds<'_>>, LogProblem> {
    let Some((header, rest)) = sized(bytes)? else { return Ok(None) };
    let Some((data, rest)) = sized(rest)? else { return Ok(None) };
    Ok(Some((header, data, rest)))
}

/// A length of four bytes, so many bytes, and what follows.
fn sized(bytes: &[u8]) -> Result<Option<Halves<'_>>, LogProblem> {
    let Some((length, rest)) = bytes.split_at_checked(4) else { return Ok(None) };
    let length = number(length)? as usize;
    if length > LARGEST {
        return Err(damaged(format!("a record of it has {length} bytes; at most {LARGEST} can be read")));
    }
    Ok(rest.split_at_checked(length))
}

fn number(bytes: &[u8]) -> Result<u32, LogProblem> {
    let four = bytes.first_chunk().ok_or_else(|| damaged("a field of a record is too short"))?;
    Ok(u32::from_le_bytes(*four))
}

/// The fields of a header: `name=value` each.
struct Fields<'a>(BTreeMap<&'a [u8], &'a [u8]>);

impl<'a> Fields<'a> {
    fn of(mut bytes: &'a [u8]) -> Result<Self, LogProblem> {
        let mut fields = BTreeMap::new();
        while !bytes.is_empty() {
            let (field, rest) = sized(bytes)?.ok_or_else(|| damaged("a record's header is longer than the record"))?;
            let equals = field
                .iter()
                .position(|byte| *byte == b'=')
                .ok_or_else(|| damaged("a field of a record has no name"))?;
            fields.insert(&field[..equals], &field[equals + 1..]);
            bytes = rest;
        }
        Ok(Self(fields))
    }

    fn get(&self, name: &str) -> Result<&'a [u8], LogProblem> {
        self.0.get(name.as_bytes()).copied().ok_or_else(|| damaged(format!("a record has no field “{name}”")))
    }

    fn number(&self, name: &str) -> Result<u32, LogProblem> {
        number(self.get(name)?)
    }
}

/// A chunk as it was before it was compressed.
fn unpacked(compression: &str, data: &[u8], size: u64) -> Result<Vec<u8>, LogProblem> {
    if size > LARGEST as u64 {
        return Err(damaged(format!("a chunk of it has {size} bytes; at most {LARGEST} can be read")));
    }
    let bad = |error: &dyn core::fmt::Display| damaged(format!("a chunk cannot be unpacked ({compression}): {error}"));
    let mut reader: Box<dyn Read + '_> = match compression {
        "" => Box::new(data),
        "zstd" => Box::new(StreamingDecoder::new(data).map_err(|error| bad(&error))?),
        "lz4" => Box::new(FrameDecoder::new(data)),
        "bz2" => Box::new(bzip2_rs::DecoderReader::new(data)),
        other => return Err(LogProblem::Compression(other.into())),
    };
    let mut unpacked = Vec::new();
    reader.by_ref().take(size + 1).read_to_end(&mut unpacked).map_err(|error| bad(&error))?;
    if unpacked.len() as u64 == size {
        Ok(unpacked)
    } else {
        Err(bad(&format_args!("expected {size} bytes, found {}", unpacked.len())))
    }
}
