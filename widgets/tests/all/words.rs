//! Figures in other languages: every word is of the language, and nothing else changes.

use fastslam_figures_catalogue::build::read;
use fastslam_log::{BagOptions, BagReader, Beyond, Field, LaserLog, LogProblem, MessageProblem, Remark, Topics, parse};
use fastslam_widgets::{
    fastslam::mapper,
    figure::Figure,
    model::{ParamSpec, Readout},
    registry::{self, FIGURES},
    scene::Mark,
    unread,
    words::Language,
};
use std::path::Path;

const LAP: &str = "fastslam-lap";

/// A catalogue as the page hands it to a figure: what the kit says, and what the figures say.
pub fn lines(language: &str) -> String {
    let mut lines = String::new();
    for folder in ["words", "kit/words"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).join(format!("{language}.json"));
        for (section, messages) in read(&path) {
            lines.extend(messages.iter().map(|(key, text)| format!("{section}.{key}={text}\n")));
        }
    }
    lines
}

fn figure(tag: &str, language: &str) -> Figure {
    let mut figure = registry::figure(tag).unwrap();
    if language != "en" {
        figure.set_words(&lines(language));
    }
    if tag == LAP {
        assert_eq!(figure.load("course=apartment"), []);
    }
    if tag == "fastslam-log" {
        figure.open(include_bytes!("../../../tests/figures/golden/tiny.clf")).unwrap();
        figure.set("cell", "0.2").unwrap();
    }
    // Words do not depend on how many there are.
    if ["fastslam-joint", "fastslam-em"].contains(&tag) {
        figure.set("particles", "50").unwrap();
    }
    figure.model_mut().seek(4);
    figure.model_mut().settle();
    figure
}

/// What is written in the picture, in order.
fn written(figure: &Figure) -> Vec<String> {
    let scene = figure.scene(1000.0, 600.0);
    let text = |mark| if let Mark::Text(text) = mark { Some(text.text) } else { None };
    scene.marks.into_iter().filter_map(text).collect()
}

/// All that it says, in order.
fn said(figure: &Figure) -> Vec<String> {
    let spec = |ParamSpec { title, unit, help, choices, .. }: ParamSpec| {
        [title, unit, help].into_iter().chain(choices.into_iter().map(|c| c.title)).map(String::from).collect()
    };
    let readout = |Readout { title, unit, help, text, .. }: Readout| {
        [title, unit, help].map(String::from).into_iter().chain([text]).collect()
    };
    let specs: Vec<Vec<String>> = figure.params().into_iter().map(spec).collect();
    let readouts: Vec<Vec<String>> = figure.readouts().into_iter().map(readout).collect();
    let handles = figure.scene(1000.0, 600.0).handles.into_iter().flat_map(|handle| [handle.title, handle.text]);
    specs.concat().into_iter().chain(readouts.concat()).chain(handles).chain([figure.describe()]).collect()
}

#[test]
fn the_lap_speaks_german_once_it_has_the_words() {
    let mut lap = figure(LAP, "de");
    assert!(
        lap.describe().starts_with("Schritt 4 von 90, 16 Universen. Groß gezeigt ist Universum "),
        "{}",
        lap.describe()
    );
    let universes = &lap.params()[0];
    assert_eq!((universes.name, universes.title), ("universes", "Universen M"));
    let params = lap.params();
    let policy = params.iter().find(|spec| spec.name == "policy").unwrap();
    assert_eq!((policy.choices[1].value.as_str(), policy.choices[1].title), ("always", "bei jedem Schritt"));
    assert_eq!(lap.readouts()[1].title, "RMS-Fehler, bestes Universum");
    assert!(written(&lap).contains(&"Pfade der anderen".into()), "{:?}", written(&lap));
    assert_eq!(
        lap.set("universes", "0").unwrap_err().message,
        "universes = \"0\": erlaubt ist eine ganze Zahl von 1 bis 256"
    );
    assert!(lap.load("colour=red")[0].message.contains("ist kein Parameter dieser Abbildung"));
}

#[test]
fn a_language_changes_nothing_but_words_and_can_be_changed_back() {
    for entry in FIGURES {
        let (english, mut other) = (figure(entry.tag, "en"), figure(entry.tag, "de"));
        assert_eq!(other.query(), english.query());
        let values = |figure: &Figure| figure.readouts().into_iter().map(|r| (r.name, r.value)).collect::<Vec<_>>();
        assert_eq!(format!("{:?}", values(&other)), format!("{:?}", values(&english)), "{}", entry.tag);
        assert_ne!(other.describe(), english.describe());
        other.set_words("");
        assert_eq!(said(&other), said(&english));
        assert_eq!(written(&other), written(&english));
    }
}

/// Words that are the same in both languages, and what stands for itself.
const SAME: &[&str] = &[
    "FastSLAM",
    "N_eff",
    "RMS",
    "Iteration",
    "Scan",
    "Scans",
    "Pose",
    "nats",
    "Filter",
    "Innovation",
    "multinomial",
    "landmarks",
    "EKF",
    "SLAM",
    "FastSLAM",
    "min",
    "rad",
    "det",
    "exp",
    "eff",
    "πS",
];

#[test]
fn every_word_of_every_figure_is_of_the_language() {
    for entry in FIGURES {
        let (english, german) = (figure(entry.tag, "en"), figure(entry.tag, "de"));
        let pairs =
            said(&english).into_iter().zip(said(&german)).chain(written(&english).into_iter().zip(written(&german)));
        for (english, german) in pairs {
            if english != german {
                continue;
            }
            let words =
                english.split(|c: char| !(c.is_alphabetic() || c == '_')).filter(|word| word.chars().count() > 2);
            let left: Vec<&str> = words.filter(|word| !SAME.contains(word)).collect();
            assert!(left.is_empty() || english.chars().all(|c| c.is_ascii_hexdigit()), "{}: {english}", entry.tag);
        }
    }
}

#[test]
fn what_a_catalogue_lacks_or_garbles_is_said_in_english() {
    let english = figure(LAP, "en").describe();
    for bad in [
        "nonsense",
        "=",
        "lap.shown_best={step",
        "lap.shown_best={nobody}",
        "lap.shown_best={m:one}",
        "lap.errors=",
        "\n\n",
    ] {
        let mut lap = figure(LAP, "en");
        lap.set_words(bad);
        assert_eq!(lap.describe(), english, "{bad}");
    }
    let mut lap = figure(LAP, "en");
    lap.set_words("lap.universes=\ncommon.universes=Welten M\n");
    assert_eq!(lap.params()[0].title, "Welten M");
    assert_eq!(lap.describe(), english);
}

#[test]
fn figures_side_by_side_speak_different_languages() {
    let (english, german) = (figure(LAP, "en"), figure(LAP, "de"));
    for _ in 0..2 {
        assert!(english.describe().starts_with("Step 4 of 90"));
        assert!(german.describe().starts_with("Schritt 4 von 90"));
    }
}

/// Of a log that cannot be read, all that a reader may meet.
fn problems() -> Vec<LogProblem> {
    use LogProblem as P;
    let field = |field| P::Field { message: Some("FLASER"), field, found: Some("“wall”".into()) };
    let message =
        |problem| P::Message { topic: "/scan".into(), number: 3, kind: "sensor_msgs/LaserScan".into(), problem };
    let topics =
        |listed: &[&str], more| P::NoScanTopic(Topics { listed: listed.iter().map(|t| t.to_string()).collect(), more });
    let fields = [
        Field::Named("tv"),
        Field::Time,
        Field::Metres,
        Field::Name,
        Field::RangeCount,
        Field::RemissionCount,
        Field::Remission,
        Field::Range { number: 2, of: 180 },
    ];
    let messages = [
        MessageProblem::Short,
        MessageProblem::Pose,
        MessageProblem::Transform,
        MessageProblem::NoRanges,
        MessageProblem::Angles { first: -90.0, step: 0.5 },
        MessageProblem::Encoding("protobuf".into()),
        MessageProblem::Encapsulation([0, 7]),
    ];
    let others = [
        P::LongLine,
        P::Binary,
        P::UnknownMessage("“x”".into()),
        P::NoMessage("“<html>”".into()),
        P::Field { message: None, field: Field::Named("qx"), found: None },
        P::NoRanges { message: "FLASER" },
        P::OtherRanges { message: "FLASER", before: 180, found: 3 },
        P::Angles { message: "ROBOTLASER1", first: -90.0, step: 1.0 },
        P::Jump { message: "FLASER", kilometres: 5.04 },
        P::Far { message: "ODOM", names: "x, y, theta", found: [1e300, -0.5, 2.0] },
        P::NoPose,
        P::Json("EOF while parsing a value at line 1 column 0".into()),
        P::JsonLacks("time"),
        P::JsonAngles { first: -90.0, step: 1.0 },
        P::JsonNoRanges,
        P::JsonFar,
        P::NoScan { but: None },
        P::NoScan { but: Some("SYNC".into()) },
        P::NoScanSoon { megabytes: 64, but: None },
        P::NoReading { readings: 12, beyond: Beyond::default() },
        P::NoReading { readings: 12, beyond: Beyond { count: 9, shortest: 1033.0, max_range: 12.0 } },
        P::NoCommonTime { scans: [9.0, 9.5], odometry: [2.0, 3.25] },
        P::OdometryJumps { kilometres: 2.35, time: 7.125 },
        P::NoBag,
        P::OldBag,
        topics(&[], 0),
        topics(&["/odom (1 × nav_msgs/Odometry)", "/tf (2 × tf2_msgs/TFMessage)"], 0),
        topics(&["/odom (1 × nav_msgs/Odometry)"], 3),
        P::Tilted { laser: "laser".into(), robot: "base_link".into() },
        P::Truncated,
        P::Compression("xz".into()),
        P::Damaged("a chunk ends in the middle of a record".into()),
    ];
    fields.map(field).into_iter().chain(messages.map(message)).chain(others).collect()
}

fn remarks() -> [Remark; 8] {
    [
        Remark::NoOdometry,
        Remark::StillOdometry,
        Remark::HeadingsInDegrees,
        Remark::SomeHeadingsInDegrees { from: 1029.6, to: 1112.4 },
        Remark::ClockSetBack { seconds: 10.07, time: 1029.6 },
        Remark::Copied { stretch: [[461, 520], [401, 460]], count: 60 },
        Remark::Beyond(2),
        Remark::NoTransform { laser: "laser".into(), robot: "base_link".into() },
    ]
}

fn remarks_on_maps() -> [mapper::Remark; 4] {
    use mapper::Remark;
    [
        Remark::Contradicted { steps: 3, time: 1029.6, told: [10.166, 2.309], elapsed: 0.37 },
        Remark::NeverMoved(160),
        Remark::NothingMet,
        Remark::OpenLoops { loops: 2, time: 512.25 },
    ]
}

/// The words of a text but for numbers, what begins with a capital, and those of both languages: names, and what is cited.
fn words_of(text: &str) -> impl Iterator<Item = &str> {
    const BOTH: &str = "angle base cdr convert html in increment km laser link m max migrate min msgs nav odom protobuf qx range ranges rosbag \
        rosbags s scan sensor tf theta time tv wall x xz y zstd";
    text.split(|c: char| !c.is_alphanumeric()).filter(|word| {
        !word.is_empty() && word.chars().all(char::is_lowercase) && BOTH.split(' ').all(|both| both != *word)
    })
}

#[test]
fn what_is_wrong_with_a_log_is_said_in_english_as_the_library_says_it_and_in_german_in_german() {
    let german = Language::learnt(&lines("de"));
    // What is wrong in JSON, and inside a bag, is told by those who know the format: in English.
    let cited = |problem: &LogProblem| matches!(problem, LogProblem::Json(_) | LogProblem::Damaged(_));
    let mut said: Vec<([String; 3], bool)> = Vec::new();
    for problem in problems() {
        let english = unread::problem(&problem);
        let _spoken = german.spoken();
        said.push(([problem.to_string(), english, unread::problem(&problem)], cited(&problem)));
    }
    for remark in remarks() {
        let english = unread::remark(&remark);
        let _spoken = german.spoken();
        said.push(([remark.to_string(), english, unread::remark(&remark)], false));
    }
    for remark in remarks_on_maps() {
        let english = unread::mapped(&remark);
        let _spoken = german.spoken();
        said.push(([remark.to_string(), english, unread::mapped(&remark)], false));
    }
    for ([told, english, german], cites) in said {
        assert_eq!(told, english);
        assert_ne!(german, english);
        let own = if cites { german.split(['(', ':']).next().unwrap() } else { &german };
        let left: Vec<&str> = words_of(own).filter(|word| words_of(&english).any(|other| other == *word)).collect();
        assert!(left.is_empty(), "{left:?} of {english:?} in {german:?}");
    }
}

#[test]
fn a_log_that_cannot_be_opened_is_refused_in_the_language_of_its_figure() {
    let mut figure = figure("fastslam-log", "de");
    let scan = |ranges: &str| format!("FLASER {ranges} 0 0 0 0 0 0 1 h 1\n");
    for (file, says) in [
        (String::new(), "die Datei ist leer"),
        ("name,x,y\n1,2,3\n".into(), "Zeile 1: erwartet ist der Name einer Nachricht, gefunden “name,x,y”"),
        ("ODOM 0 0 0 0 0 0 1 h 1\n".into(), "sie enthält keine Nachricht FLASER oder ROBOTLASER1"),
        ("SYNC 1\n".into(), "sie enthält keine Nachricht FLASER oder ROBOTLASER1 (aber SYNC)"),
        ("ODOM nan 0 0 0 0 0 1 h 1\n".into(), "Zeile 1: ODOM: erwartet x, y, theta, gefunden “nan”"),
        ("FLASER 3 1 2".into(), "Zeile 1: FLASER: erwartet Entfernung 3 von 3, gefunden das Ende der Zeile"),
        (scan("0"), "Zeile 1: FLASER: erwartet Entfernungen, gefunden keine"),
        (scan("2 nan nan").repeat(2), "keiner der 4 Messwerte ist eine Entfernung: eine endliche Zahl über 0"),
        (scan("1 2"), "sie hat nur einen Scan, und damit ist nichts zu kartieren"),
    ] {
        assert_eq!(figure.open(file.as_bytes()).unwrap_err().message, says);
    }
    figure.open([scan("2 1 1"), scan("3 1 1 1"), scan("2 1 1")].concat().as_bytes()).unwrap();
    let unfit = figure.ready().unwrap_err().message;
    assert_eq!(unfit, "Zeile 2: FLASER: erwartet 2 Entfernungen wie in den Scans davor, gefunden 3");
    figure.set_words("");
    let unfit = figure.ready().unwrap_err().message;
    assert_eq!(unfit, "line 2: FLASER: expected 2 ranges as in the scans before, found 3", "and when the page says so");
}

#[test]
fn what_another_program_notes_of_a_log_is_told_in_the_language_in_which_it_was_read() {
    let bag = include_bytes!("../../../tests/bags/odometry-zstd.mcap");
    let read = |bytes: &[u8]| {
        let mut reader = BagReader::new(BagOptions { lenient: true, ..BagOptions::default() });
        reader.push(bytes).and_then(|()| reader.finish())
    };
    let mut log = read(&bag[..bag.len() / 2]).unwrap();
    log.notes.remarks = remarks().into();
    let spoken = Language::learnt(&lines("de")).spoken();
    let again = LaserLog::from_bytes(&unread::in_words(log).to_bytes()).unwrap();
    let nothing = unread::error(&read(b"#ROSBAG V2.0\n").unwrap_err()).message;
    assert_eq!(nothing, "sie enthält kein Topic mit sensor_msgs/LaserScan; vorhanden: kein einziges");
    let german = remarks().map(|remark| unread::remark(&remark));
    drop(spoken);
    let first = unread::error(&again.notes.first_malformed.unwrap()).message;
    assert_eq!(first, "sie endet mitten in einem Datensatz: Wurde die Aufnahme abgebrochen?");
    let noted: Vec<String> = again.notes.remarks.iter().map(unread::remark).collect();
    assert_eq!(noted, german);
    assert!(noted[0].starts_with("es gibt keine Odometrie"));
}

#[test]
fn a_log_of_json_lines_is_opened_as_it_was_read_with_what_is_wrong_in_its_place() {
    let scan = |time: u32, x: u32| {
        format!(
            "{{\"time\": {time}, \"angle_min\": -1, \"angle_increment\": 1, \"ranges\": [1, null, {x}], \"odometry\": [{x}, 0, 0]}}\n"
        )
    };
    let lacks = "a scan in JSON: expected \"angle_min\", found none";
    let why = unread::text(b"{\"time\": 1}\n", parse).unwrap_err().message;
    assert_eq!(why, format!("line 1: {lacks}"));
    let text = [scan(1, 1), "{\"time\": 1}\n".into(), scan(2, 2)].concat();
    let read = unread::in_words(unread::text(text.as_bytes(), parse).unwrap());
    let mut figure = figure("fastslam-log", "en");
    assert!(figure.open(&read.to_bytes()).is_err(), "a reader's file is never taken for what a program has read");
    figure.take(&read.to_bytes()).unwrap();
    assert_eq!(figure.ready().unwrap_err().message, format!("line 2: {lacks}"));
    assert!(figure.describe().contains("2 scans of up to 3 beams"), "{}", figure.describe());
    assert!(figure.open(text.as_bytes()).is_err(), "JSON itself is read by another program");
}
