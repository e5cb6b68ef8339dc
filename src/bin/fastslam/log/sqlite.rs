//! ROS 2 bags in SQLite (`.db3`), the default of recorders up to Humble, told as MCAP.
//!
//! Two tables of the file are walked in the order of recording, page by page: no database is opened, and nothing of the file is kept.
//! Reference: <https://www.sqlite.org/fileformat2.html>, and the tables of rosbag2's `sqlite_storage.cpp`.

use anyhow::{Result, anyhow, ensure};
use std::collections::BTreeMap;
use std::io::{Read, Seek, SeekFrom};

/// How a database begins.
pub const MAGIC: &[u8] = b"SQLite format 3\0";

/// Types of messages whose content is of use: those that the reader of bags looks at.
const USED: [&str; 3] = ["sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"];

/// Levels of a tree: a table of 2⁶⁴ rows has fewer.
const DEEPEST: u32 = 40;

/// Largest row \[bytes\].
const LARGEST: u64 = 256 << 20;

/// Tells a recording to `push`, as MCAP.
pub fn read<E>(file: impl Read + Seek, mut push: impl FnMut(&[u8]) -> Result<(), E>) -> Result<Result<(), E>> {
    let mut database = Database::new(file)?;
    let tables = database.tables()?;
    let table = |name: &str| tables.get(name).ok_or_else(|| anyhow!("it has no table {name}: it is no ROS 2 bag"));
    let (topics, messages) = (table("topics")?, table("messages")?);
    let (name, kind, format) =
        (topics.column("name")?, topics.column("type")?, topics.column("serialization_format").ok());
    let (topic, stamp, data) = (messages.column("topic_id")?, messages.column("timestamp")?, messages.column("data")?);

    let mut used = BTreeMap::new();
    let mut told = Vec::from(MCAP);
    record(&mut told, HEADER, &[text("ros2"), text("fastslam")].concat());
    database.rows(topics.root, &mut |id, row| {
        let (name, kind) = (row.text(name)?, row.text(kind)?);
        let format = format.map_or(Ok("cdr".into()), |column| row.text(column))?;
        let number = u16::try_from(id).map_err(|_| anyhow!("a topic has the number {id}"))?.to_le_bytes();
        // No topic's type has the number 0.
        let schema = u16::try_from(id + 1)?.to_le_bytes();
        record(&mut told, SCHEMA, &[&schema[..], &text(&kind), &text("ros2msg"), &text("")].concat());
        record(&mut told, CHANNEL, &[&number[..], &schema, &text(&name), &text(&format), &text("")].concat());
        used.insert(id, USED.contains(&kind.as_str()));
        Ok(true)
    })?;
    ensure!(!used.is_empty(), "there is no topic in it");
    let mut refused = push(&told);
    database.rows(messages.root, &mut |_, row| {
        if refused.is_err() {
            return Ok(false);
        }
        let (topic, stamp) = (row.number(topic)?, row.number(stamp)?);
        let is_used =
            *used.get(&topic).ok_or_else(|| anyhow!("a message is of topic {topic}, of which nothing is told"))?;
        // Of other messages it is told that they are there.
        let data = if is_used { row.bytes(data)? } else { &[] };
        let (number, stamp) = ((topic as u16).to_le_bytes(), stamp.to_le_bytes());
        told.clear();
        record(&mut told, MESSAGE, &[&number[..], &[0; 4], &stamp, &stamp, data].concat());
        refused = push(&told);
        Ok(true)
    })?;
    told.clear();
    record(&mut told, DATA_END, &[0; 4]);
    record(&mut told, FOOTER, &[0; 20]);
    told.extend_from_slice(MCAP);
    Ok(refused.and_then(|()| push(&told)))
}

const MCAP: &[u8] = b"\x89MCAP0\r\n";
const HEADER: u8 = 0x01;
const FOOTER: u8 = 0x02;
const SCHEMA: u8 = 0x03;
const CHANNEL: u8 = 0x04;
const MESSAGE: u8 = 0x05;
const DATA_END: u8 = 0x0f;

/// Adds a record of MCAP.
fn record(told: &mut Vec<u8>, kind: u8, content: &[u8]) {
    told.push(kind);
    told.extend_from_slice(&(content.len() as u64).to_le_bytes());
    told.extend_from_slice(content);
}

/// A text of MCAP, or a map or bytes that are empty.
fn text(text: &str) -> Vec<u8> {
    [&(text.len() as u32).to_le_bytes(), text.as_bytes()].concat()
}

/// A table: the first page of its tree, and what its columns are called.
struct Table {
    root: u32,
    columns: Vec<String>,
}

impl Table {
    fn column(&self, name: &str) -> Result<usize> {
        self.columns.iter().position(|column| column == name).ok_or_else(|| anyhow!("a table has no column {name}"))
    }
}

struct Database<F> {
    file: F,
    page_size: usize,
    /// Bytes of a page that are used.
    usable: usize,
}

impl<F: Read + Seek> Database<F> {
    fn new(mut file: F) -> Result<Self> {
        let mut head = [0; 100];
        file.rewind()?;
        file.read_exact(&mut head)?;
        let page_size = match u16::from_be_bytes([head[16], head[17]]) {
            1 => 1 << 16,
            size => usize::from(size),
        };
        ensure!(page_size.is_power_of_two() && page_size >= 512, "it has pages of {page_size} bytes");
        Ok(Self { file, page_size, usable: page_size - usize::from(head[20]).min(32) })
    }

    /// All tables, by name.
    fn tables(&mut self) -> Result<BTreeMap<String, Table>> {
        let mut tables = BTreeMap::new();
        // The schema's columns: type, name, table's name, first page, SQL.
        self.rows(1, &mut |_, row| {
            if row.text(0)? == "table" {
                let sql = row.text(4)?;
                let columns = sql.split_once('(').map_or("", |(_, columns)| columns);
                let first_word = |column: &str| {
                    let word = column.split_whitespace().next().unwrap_or_default();
                    word.trim_matches(['"', '`', '[', ']']).to_owned()
                };
                let root = u32::try_from(row.number(3)?)?;
                tables.insert(row.text(1)?, Table { root, columns: columns.split(',').map(first_word).collect() });
            }
            Ok(true)
        })?;
        Ok(tables)
    }

    /// Goes through the rows of a table, with their numbers, as long as `each` returns true.
    fn rows(&mut self, root: u32, each: &mut impl FnMut(i64, Row<'_>) -> Result<bool>) -> Result<()> {
        self.walk(root, DEEPEST, each).map(drop)
    }

    fn walk(&mut self, number: u32, levels: u32, each: &mut impl FnMut(i64, Row<'_>) -> Result<bool>) -> Result<bool> {
        ensure!(levels > 0, "its tables are deeper than any");
        let page = self.page(number)?;
        // The first page begins with the file's head.
        let head = if number == 1 { 100 } else { 0 };
        let is_leaf = match page[head] {
            0x0d => true,
            0x05 => false,
            _ => return Err(anyhow!("page {number} is not of a table")),
        };
        let count = usize::from(short(&page, head + 3)?);
        let first = head + if is_leaf { 8 } else { 12 };
        for k in 0..count {
            let cell = usize::from(short(&page, first + 2 * k)?);
            let goes_on = if is_leaf {
                let mut rest = page.get(cell..self.usable).ok_or_else(damaged)?;
                let (length, id) = (varint(&mut rest)?, varint(&mut rest)?);
                let payload = self.payload(length, rest)?;
                each(id as i64, Row::new(&payload)?)?
            } else {
                self.walk(long(&page, cell)?, levels - 1, each)?
            };
            if !goes_on {
                return Ok(false);
            }
        }
        if is_leaf { Ok(true) } else { self.walk(long(&page, head + 8)?, levels - 1, each) }
    }

    /// A row of so many bytes, which begins here and may go on in other pages.
    fn payload(&mut self, length: u64, rest: &[u8]) -> Result<Vec<u8>> {
        ensure!(length <= LARGEST, "a row of it has {length} bytes; at most {LARGEST} can be read");
        let (length, usable) = (length as usize, self.usable);
        let (most, least) = (usable - 35, (usable - 12) * 32 / 255 - 23);
        let local = match least + (length.max(least) - least) % (usable - 4) {
            _ if length <= most => length,
            local if local <= most => local,
            _ => least,
        };
        let mut payload = rest.get(..local).ok_or_else(damaged)?.to_vec();
        let mut next = if local < length { long(rest, local)? } else { 0 };
        while payload.len() < length {
            let page = self.page(next)?;
            next = long(&page, 0)?;
            payload.extend_from_slice(&page[4..usable.min(4 + length - payload.len())]);
        }
        Ok(payload)
    }

    /// A page, the first of which is number 1.
    fn page(&mut self, number: u32) -> Result<Vec<u8>> {
        let before = number.checked_sub(1).ok_or_else(damaged)?;
        let mut page = vec![0; self.page_size];
        self.file.seek(SeekFrom::Start(u64::from(before) * self.page_size as u64))?;
        self.file.read_exact(&mut page)?;
        Ok(page)
    }
}

/// The values of a row.
struct Row<'a>(Vec<(u64, &'a [u8])>);

impl<'a> Row<'a> {
    fn new(payload: &'a [u8]) -> Result<Self> {
        let mut head = payload;
        let length = varint(&mut head)? as usize;
        let of_length = payload.len() - head.len();
        let mut kinds = payload.get(of_length..length).ok_or_else(damaged)?;
        let mut rest = &payload[length..];
        let mut values = Vec::new();
        while !kinds.is_empty() {
            let kind = varint(&mut kinds)?;
            let size = match kind {
                0 | 8 | 9 => 0,
                1..=4 => kind,
                5 => 6,
                6 | 7 => 8,
                10 | 11 => return Err(damaged()),
                _ => (kind - 12) / 2,
            };
            let (value, after) = rest.split_at_checked(usize::try_from(size)?).ok_or_else(damaged)?;
            values.push((kind, value));
            rest = after;
        }
        Ok(Self(values))
    }

    fn value(&self, column: usize) -> Result<(u64, &'a [u8])> {
        self.0.get(column).copied().ok_or_else(damaged)
    }

    fn number(&self, column: usize) -> Result<i64> {
        match self.value(column)? {
            (8, _) => Ok(0),
            (9, _) => Ok(1),
            (1..=6, bytes) => {
                let sign = if bytes[0] & 0x80 > 0 { -1 } else { 0 };
                Ok(bytes.iter().fold(sign, |number, byte| (number << 8) | i64::from(*byte)))
            }
            _ => Err(damaged()),
        }
    }

    fn bytes(&self, column: usize) -> Result<&'a [u8]> {
        match self.value(column)? {
            (12.., bytes) => Ok(bytes),
            _ => Err(damaged()),
        }
    }

    fn text(&self, column: usize) -> Result<String> {
        Ok(String::from_utf8_lossy(self.bytes(column)?).into_owned())
    }
}

fn damaged() -> anyhow::Error {
    anyhow!("its database is damaged")
}

fn short(bytes: &[u8], at: usize) -> Result<u16> {
    Ok(u16::from_be_bytes(*bytes.get(at..).and_then(<[u8]>::first_chunk).ok_or_else(damaged)?))
}

fn long(bytes: &[u8], at: usize) -> Result<u32> {
    Ok(u32::from_be_bytes(*bytes.get(at..).and_then(<[u8]>::first_chunk).ok_or_else(damaged)?))
}

/// A number of one to nine bytes of seven bits each, the ninth of eight.
fn varint(bytes: &mut &[u8]) -> Result<u64> {
    let mut number = 0;
    for k in 0..9 {
        let (first, rest) = bytes.split_first().ok_or_else(damaged)?;
        *bytes = rest;
        if k == 8 {
            return Ok((number << 8) | u64::from(*first));
        }
        number = (number << 7) | u64::from(first & 0x7f);
        if first & 0x80 == 0 {
            break;
        }
    }
    Ok(number)
}
