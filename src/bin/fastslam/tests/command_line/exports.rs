//! Maps and paths as other programs read them. The readers are written here, from the documentation of the formats: a file that only its writer
//! understands is of no use.

use super::{json, short_log};
use fastslam::geometry::Pose2;
use fastslam::map::grid::{MapImage, MapImageSettings};
use fastslam::mapper::{LaserMapper, LaserMapperSettings, Map, Replay};
use fastslam::ops;
use fastslam_log::parse;
use std::collections::BTreeMap;
use std::sync::Arc;
use tempfile::tempdir;

/// An occupancy grid as `map_server` publishes it.
struct OccupancyGrid {
    width: usize,
    resolution: f64,
    origin: [f64; 2],
    /// 100 for occupied, 0 for free, −1 for unknown cells; rows from the bottom.
    data: Vec<i8>,
}

impl OccupancyGrid {
    /// The rule of `map_server` (wiki.ros.org/map_server, section *Value Interpretation*, mode trinary; Nav2's is the same): a grey x is
    /// p = (255 − x) / 255, or x / 255 with `negate`; p > occupied_thresh is 100, p < free_thresh is 0, and all else is −1.
    fn read(pgm: &[u8], yaml: &str) -> Self {
        let fields: BTreeMap<&str, &str> = yaml.lines().map(|line| line.split_once(": ").unwrap()).collect();
        let number = |name: &str| fields[name].parse::<f64>().unwrap();
        let list = fields["origin"].trim_matches(['[', ']']).split(", ");
        let origin: Vec<f64> = list.map(|word| word.parse().unwrap()).collect();
        assert_eq!((fields["mode"], origin[2]), ("trinary", 0.0));
        let header = pgm.splitn(4, |byte| *byte == b'\n').collect::<Vec<_>>();
        let words = |k: usize| std::str::from_utf8(header[k]).unwrap().split(' ').collect::<Vec<_>>();
        assert_eq!((words(0), words(2)), (vec!["P5"], vec!["255"]));
        let [width, height] = [0, 1].map(|k| words(1)[k].parse::<usize>().unwrap());
        let greys = header[3];
        assert_eq!(greys.len(), width * height);
        let read = |grey: &u8| {
            let p = if number("negate") == 0.0 { f64::from(255 - grey) } else { f64::from(*grey) } / 255.0;
            if p > number("occupied_thresh") {
                100
            } else if p < number("free_thresh") {
                0
            } else {
                -1
            }
        };
        let meaning: Vec<i8> = (0..=255).map(|grey| read(&grey)).collect();
        let rows = greys.chunks(width).rev(); // the first row of a picture is the top one
        let data = rows.flatten().map(|grey| meaning[usize::from(*grey)]).collect();
        Self { width, resolution: number("resolution"), origin: [origin[0], origin[1]], data }
    }

    /// What is read of a cell of the map; −1 outside of the picture, where nothing is known.
    fn cell(&self, i: i32, j: i32) -> i8 {
        let [i0, j0] = self.origin.map(|metres| (metres / self.resolution).round() as i32);
        let (column, row) = (i - i0, j - j0);
        let inside = (0..self.width as i32).contains(&column) && row >= 0;
        let place = inside.then(|| row as usize * self.width + column as usize);
        place.and_then(|place| self.data.get(place)).copied().unwrap_or(-1)
    }
}

/// Distance of a point from a polyline, whose legs are short \[m\].
fn distance(path: &[(f64, Pose2)], [x, y]: [f64; 2]) -> f64 {
    let legs = path.windows(2).map(|leg| {
        let [a, b] = [leg[0].1, leg[1].1];
        let (way, off) = ([b.x - a.x, b.y - a.y], [x - a.x, y - a.y]);
        let square = way[0] * way[0] + way[1] * way[1];
        let share = if square > 0.0 { ((off[0] * way[0] + off[1] * way[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
        ops::hypot(off[0] - share * way[0], off[1] - share * way[1])
    });
    legs.fold(f64::INFINITY, f64::min)
}

/// Compares every cell that is read with the map, and returns how many are occupied, free and unknown.
fn read_is_the_map(grid: &OccupancyGrid, map: &Map, path: &[(f64, Pose2)], settings: &MapImageSettings) -> [usize; 3] {
    let MapImageSettings { occupied_threshold, free_threshold, footprint_radius: radius } = *settings;
    let (cells, mut counts) = (map.bounds(), [0; 3]);
    let margin = 1 + (radius / map.cell_size()).ceil() as i32; // the robot's circle may reach beyond all that was seen
    for (i, j) in
        (cells.j0 - margin..cells.j1 + margin).flat_map(|j| (cells.i0 - margin..cells.i1 + margin).map(move |i| (i, j)))
    {
        let log_odds = map.log_odds(i, j);
        let p = 1.0 / (1.0 + ops::exp(-log_odds));
        let seen = if p > occupied_threshold {
            100
        } else if log_odds != 0.0 && p < free_threshold {
            0
        } else {
            -1
        };
        let away = distance(path, [i, j].map(|k| (f64::from(k) + 0.5) * map.cell_size()));
        let read = grid.cell(i, j);
        // The circle is drawn at places half a cell apart, and not everywhere between: a millimetre for cells of 5 cm.
        let expected = if away > radius - 1e-3 && away <= radius {
            read
        } else if away <= radius {
            0
        } else {
            seen
        };
        assert_eq!(read, expected, "cell ({i}, {j}): log-odds {log_odds}, {away} m from the path");
        counts[[100, 0, -1].iter().position(|value| *value == read).unwrap()] += 1;
    }
    counts
}

/// The log that the program mapped, mapped here.
fn mapped(log: &str) -> LaserMapper {
    let log = Arc::new(parse(&std::fs::read(log).unwrap(), false).unwrap());
    let settings = LaserMapperSettings { particles: 2, seed: 2, ..LaserMapperSettings::default() };
    let mut replay = Replay::new(settings, log).unwrap();
    replay.by_ref().for_each(drop);
    replay.mapper().clone()
}

/// The fields of CDR, low bytes first: each number at a multiple of its size, counted from behind the first four bytes.
struct Cdr<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Cdr<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        self.at = self.at.next_multiple_of(N);
        let taken = self.bytes[self.at..self.at + N].try_into().unwrap();
        self.at += N;
        taken
    }

    fn integer(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    fn number(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    /// `std_msgs/Header`: when \[s\], and the frame.
    fn header(&mut self) -> (f64, String) {
        let [sec, nanosec, length] = [(); 3].map(|()| self.integer());
        let text = &self.bytes[self.at..self.at + length as usize];
        self.at += length as usize;
        (f64::from(sec) + 1e-9 * f64::from(nanosec), std::str::from_utf8(text).unwrap().trim_end_matches('\0').into())
    }
}

/// The one `nav_msgs/msg/Path` of an MCAP file: numbers x y z qx qy qz qw of each pose with its time.
fn path_of(mcap: &[u8]) -> Vec<(f64, [f64; 7])> {
    let messages: Vec<mcap::Message> = mcap::MessageStream::new(mcap).unwrap().map(Result::unwrap).collect();
    let [message] = messages.as_slice() else { panic!("{} messages", messages.len()) };
    let schema = message.channel.schema.as_ref().unwrap();
    assert_eq!((schema.name.as_str(), schema.encoding.as_str()), ("nav_msgs/msg/Path", "ros2msg"));
    assert_eq!((message.channel.topic.as_str(), message.channel.message_encoding.as_str()), ("/path", "cdr"));
    let (representation, bytes) = message.data.split_at(4);
    assert_eq!(representation[..2], [0, 1], "CDR, low bytes first");
    let mut cdr = Cdr { bytes, at: 0 };
    let (stamp, frame) = cdr.header();
    let count = cdr.integer();
    let pose = |_| {
        let (time, frame) = cdr.header();
        assert_eq!(frame, "map");
        (time, core::array::from_fn(|_| cdr.number()))
    };
    let path: Vec<(f64, [f64; 7])> = (0..count).map(pose).collect();
    assert_eq!((cdr.at, frame.as_str()), (bytes.len(), "map"));
    assert!((stamp - path.last().unwrap().0).abs() < 1e-9 && (message.log_time as f64 * 1e-9 - stamp).abs() < 1e-6);
    path
}

/// A path that is read, beside the one that was written. Times: half a microsecond, the last digit of TUM's. Positions and headings: within `places`.
fn is_the_path(read: &[(f64, [f64; 7])], path: &[(f64, Pose2)], places: [f64; 2]) {
    assert_eq!(read.len(), path.len());
    for ((read, [x, y, z, qx, qy, qz, qw]), (time, pose)) in read.iter().zip(path) {
        let off = Pose2::new(*x, *y, 2.0 * ops::atan2(*qz, *qw)).minus(pose);
        assert_eq!([z, qx, qy], [&0.0; 3]);
        assert!((read - time).abs() < 6e-7, "{read} s for {time}");
        assert!(
            off.x.abs() <= places[0] && off.y.abs() <= places[0] && off.z.abs() <= places[1],
            "{off} from {pose:?}"
        );
    }
}

/// `free_thresh: 0.25` with a grey of 205 made all unknown space free: this test read it so.
#[test]
fn what_map_server_and_evo_and_ros_2_read_is_the_map_and_the_path() {
    let folder = tempdir().unwrap();
    let log = short_log(&folder, 60);
    let mapper = mapped(&log);
    let (map, path) = (mapper.map(), mapper.path());
    let file = |name: &str| folder.path().join(name).display().to_string();
    let outputs = format!("--map {} --trajectory {} --path-mcap {}", file("map"), file("path.tum"), file("path.mcap"));
    json(&format!("log {log} --particles 2 --seed 2 --json {outputs}"));
    let bytes = |name: &str| std::fs::read(file(name)).unwrap();
    let text = |name: &str| String::from_utf8(bytes(name)).unwrap();

    let written = OccupancyGrid::read(&bytes("map.pgm"), &text("map.yaml"));
    let [occupied, free, unknown] = read_is_the_map(&written, map, &path, &MapImageSettings::default());
    // None of the three is so rare that it was not tested.
    assert!(occupied > 100 && free > 1000 && unknown > 1000, "{occupied}, {free}, {unknown}");
    let radius = MapImageSettings::default().footprint_radius;
    assert!(
        path.iter().all(|(_, pose)| written.cell((pose.x / 0.05).floor() as i32, (pose.y / 0.05).floor() as i32) == 0),
        "{radius}"
    );

    let tum = text("path.tum")
        .lines()
        .map(|line| {
            let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
            (numbers[0], numbers[1..].try_into().unwrap())
        })
        .collect::<Vec<_>>();
    is_the_path(&tum, &path, [5.1e-7, 3e-9]);
    is_the_path(&path_of(&bytes("path.mcap")), &path, [0.0, 1e-12]);
}

/// Thresholds and radius are obeyed, and each is tried where it changes something.
#[test]
fn thresholds_and_footprint_of_a_map_are_as_they_were_set() {
    let folder = tempdir().unwrap();
    let mapper = mapped(&short_log(&folder, 40));
    let (map, path) = (mapper.map(), mapper.path());
    let counts = |settings: MapImageSettings| {
        let image = MapImage::of(map, &path, &settings).unwrap();
        read_is_the_map(&OccupancyGrid::read(&image.pgm(), &image.yaml("map.pgm")), map, &path, &settings)
    };
    let bare = MapImageSettings { footprint_radius: 0.0, ..MapImageSettings::default() };
    let [occupied, free, unknown] = counts(bare);
    let twice = counts(MapImageSettings { occupied_threshold: 0.75, ..bare });
    assert!(twice[0] < occupied && twice[1] == free, "one hit is not enough: {twice:?}, {occupied} before");
    let thrice = counts(MapImageSettings { free_threshold: 0.25, ..bare });
    assert!(thrice[0] == occupied && thrice[1] < free && thrice[2] > unknown, "one pass is not enough: {thrice:?}");
    for radius in [0.1, 0.2, 0.5] {
        let cleared = counts(MapImageSettings { footprint_radius: radius, ..bare });
        assert!(cleared[1] > free, "{radius} m: {cleared:?}, {free} before");
    }
}
